"""A scene: solids, a camera and a size, as plain data; and the ray of each pixel, to the bit.

    {"about": "one sentence, optional",
     "solids": a solid, or {"name": a solid, ...}, or [{"name": ..., "solid": ...}, ...],
     "camera": {"type": "perspective", "eye": [...], "look_at": [...], "up": [...], "fov": 40},
     "size": [640, 480]}

An `orthographic` camera has `height`, what it sees from bottom to top, in place of `fov`, the
vertical angle in degrees. Several solids are seen as their union. Refusals name the field.

The ray of the pixel in column i and row j, from the top left, of a picture of w x h:

    x = (2 i + 1 - w) / h              y = (h - 1 - 2 j) / h
    perspective     eye                         forward + (x s) right + (y s) top
    orthographic    eye + (x s) right + (y s) top         forward

with s = tan(fov / 2) or height / 2, in binary64, from left to right, as `pixel_ray` spells it.
`Frame` has the three unit vectors, made once. The direction is not normalised.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Literal

from raycert.cases.files import read_as, read_file
from raycert.cases.forms import Json, fields_of, read_solid, type_in, write_solid
from raycert.cases.model import Ray, Refused, Solid, Union, Vector, real, vector
from raycert.cases.vectors import cross, minus

Kind = Literal["perspective", "orthographic"]
EXTENT: dict[str, str] = {"perspective": "fov", "orthographic": "height"}
"""The field by which each kind of camera says how much it sees."""
LARGEST = 1 << 14
"""The most pixels in a row or a column."""
FLATTEST = 2.0**-40
"""The least sine of the angle between the line of sight and `up`: below it is only rounding."""
SHIPPED = files("raycert.cases") / "scenes"


@dataclass(frozen=True, slots=True)
class Camera:
    """Where the rays come from; `extent` is the field of view in degrees, or the height."""

    kind: Kind
    eye: Vector
    look_at: Vector
    up: Vector
    extent: float


@dataclass(frozen=True, slots=True)
class Scene:
    """Named solids, seen by a camera in a picture of `size` = (width, height)."""

    solids: tuple[tuple[str, Solid], ...]
    camera: Camera
    size: tuple[int, int]
    about: str = ""

    @property
    def solid(self) -> Solid:
        """Return what is seen: the one solid, or the union of all."""
        parts = tuple(solid for _, solid in self.solids)
        return parts[0] if len(parts) == 1 else Union(parts)


@dataclass(frozen=True, slots=True)
class Frame:
    """The camera's unit vectors and its scale s: all that the rays are made of."""

    kind: Kind
    eye: Vector
    forward: Vector
    right: Vector
    top: Vector
    scale: float


def frame(camera: Camera) -> Frame:
    """Return the vectors of a camera, or refuse one that has none."""
    forward = _unit(minus(camera.look_at, camera.eye), "camera.look_at", "is at the eye")
    across = cross(forward, _unit(camera.up, "camera.up", "is zero"))
    if math.hypot(*across) < FLATTEST:
        raise Refused("camera.up", "is along the line of sight")
    right = _unit(across, "camera.up", "is zero")
    half = camera.extent / 2
    scale = math.tan(math.radians(half)) if camera.kind == "perspective" else half
    return Frame(camera.kind, camera.eye, forward, right, cross(right, forward), scale)


def pixel_ray(frame: Frame, size: tuple[int, int], column: int, row: int) -> Ray:
    """Return the ray of a pixel: the formula of the module's docstring, and the only one."""
    width, height = size
    a = (2 * column + 1 - width) / height * frame.scale
    b = (height - 1 - 2 * row) / height * frame.scale
    base = frame.forward if frame.kind == "perspective" else frame.eye
    x, y, z = (c + a * r + b * t for c, r, t in zip(base, frame.right, frame.top, strict=True))
    if frame.kind == "perspective":
        return Ray(frame.eye, (x, y, z))
    return Ray((x, y, z), frame.forward)


def read_scene(form: object) -> Scene:
    """Return the scene that a JSON object describes, or refuse it."""
    fields = fields_of(form, "", ("solids", "camera", "size"), ("about",))
    about = fields.get("about", "")
    if not isinstance(about, str) or not about.isprintable():
        raise Refused("about", f"is not a line of text: {about!r:.40}")
    scene = Scene(
        _solids(fields["solids"]), _camera(fields["camera"]), read_size(fields["size"]), about
    )
    _check_rays(scene)
    return scene


def write_scene(scene: Scene) -> Json:
    """Return the scene as a JSON object; its solids as a list, in their order."""
    camera = scene.camera
    return {
        "about": scene.about,
        "solids": [{"name": name, "solid": write_solid(solid)} for name, solid in scene.solids],
        "camera": {
            "type": camera.kind,
            "eye": list(camera.eye),
            "look_at": list(camera.look_at),
            "up": list(camera.up),
            EXTENT[camera.kind]: camera.extent,
        },
        "size": list(scene.size),
    }


def read_size(value: object, path: str = "size") -> tuple[int, int]:
    """Return [width, height] as two whole numbers of pixels, or refuse it."""
    if not isinstance(value, list | tuple) or len(value) != 2:
        raise Refused(path, f"is not [width, height]: {value!r:.40}")
    for i, pixels in enumerate(value):
        whole = isinstance(pixels, int) and not isinstance(pixels, bool)
        if not whole or not 1 <= pixels <= LARGEST:
            raise Refused(f"{path}[{i}]", f"is not a whole number from 1 to {LARGEST}: {pixels!r}")
    return (value[0], value[1])


def shipped() -> tuple[str, ...]:
    names = (item.name for item in SHIPPED.iterdir())
    return tuple(sorted(name.removesuffix(".json") for name in names if name.endswith(".json")))


def load(name: str) -> Scene:
    """Return the scene of that name, or in the file of that path.

    Raises `BadFile` for what is no scene or cannot be read.
    """
    if name in shipped():
        return read_as(name, (SHIPPED / f"{name}.json").read_bytes(), read_scene)
    return read_as(name, read_file(Path(name)), read_scene)


def _check_rays(scene: Scene) -> None:
    """Refuse a camera whose outermost rays overflow; those between them then do not."""
    seen, (width, height) = frame(scene.camera), scene.size
    for column, row in ((0, 0), (width - 1, 0), (0, height - 1), (width - 1, height - 1)):
        try:
            pixel_ray(seen, scene.size, column, row)
        except Refused:
            name = EXTENT[scene.camera.kind]
            raise Refused(f"camera.{name}", "makes rays beyond binary64") from None


def _solids(form: object) -> tuple[tuple[str, Solid], ...]:
    if isinstance(form, Mapping):
        if isinstance(form.get("type"), str):
            return (("solid", read_solid(form, "solids")),)
        named = [(name, solid, f"solids.{name}") for name, solid in form.items()]
    elif isinstance(form, list):
        named = []
        for i, item in enumerate(form):
            part = fields_of(item, f"solids[{i}]", ("name", "solid"))
            named.append((part["name"], part["solid"], f"solids[{i}].solid"))
    else:
        raise Refused("solids", f"is neither a solid, nor named solids: {form!r:.40}")
    if not named:
        raise Refused("solids", "is empty")
    seen = set[str]()
    for i, (name, _, _) in enumerate(named):
        if not isinstance(name, str) or not name or not name.isprintable():
            raise Refused(f"solids[{i}].name", f"is not a name: {name!r:.40}")
        if name in seen:
            raise Refused(f"solids[{i}].name", f"is the name of an earlier solid: {name!r:.40}")
        seen.add(name)
    return tuple((name, read_solid(solid, path)) for name, solid, path in named)


def _camera(form: object) -> Camera:
    kind = type_in(form, "camera", EXTENT)
    name = EXTENT[kind]
    fields = fields_of(form, "camera", ("type", "eye", "look_at", "up", name))
    eye, look_at, up = (vector(fields[x], f"camera.{x}") for x in ("eye", "look_at", "up"))
    extent = real(fields[name], f"camera.{name}")
    if extent <= 0:
        raise Refused(f"camera.{name}", f"is not positive: {extent!r}")
    if kind == "perspective" and extent >= 180:
        raise Refused("camera.fov", f"is not below 180 degrees: {extent!r}")
    return Camera(
        "perspective" if kind == "perspective" else "orthographic", eye, look_at, up, extent
    )


def _unit(a: Vector, path: str, what: str) -> Vector:
    """Return a / |a|, or refuse the field by which a is zero."""
    length = math.hypot(*a)
    if not length:
        raise Refused(path, what)
    if not math.isfinite(length):
        raise Refused(path, "is too far from the eye")
    return (a[0] / length, a[1] / length, a[2] / length)
