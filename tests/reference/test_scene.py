"""Scenes as data: what is read, what is refused and by which name, and the ray of each pixel."""

from __future__ import annotations

import json
from importlib.resources import files
from math import hypot, radians, tan
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from raycert.cases.files import BadFile
from raycert.cases.model import Refused, Sphere, Union, Vector
from raycert.cases.scene import (
    LARGEST,
    SHIPPED,
    frame,
    load,
    pixel_ray,
    read_scene,
    shipped,
    write_scene,
)

SCHEMA = Draft202012Validator(
    json.loads(
        (files("raycert.cases") / "schemas" / "scene.schema.json").read_text(encoding="utf-8")
    )
)
BALL = {"type": "sphere", "center": [0, 0, 0], "radius": 1}
HOLED = {"type": "difference", "of": [BALL, {"type": "slab", "p": [0, 0, 0], "q": [0, 0, 1]}]}
CAMERA = {
    "type": "perspective",
    "eye": [0, -4, 0],
    "look_at": [0, 0, 0],
    "up": [0, 0, 1],
    "fov": 90,
}
FLAT = {
    "type": "orthographic",
    "eye": [0, -4, 0],
    "look_at": [0, 0, 0],
    "up": [0, 0, 2],
    "height": 3,
}
HIGH = FLAT | {"eye": [0, -4, 1.7e308], "look_at": [0, 0, 1.7e308], "height": 1.7e308}
FORM: dict[str, Any] = {"solids": BALL, "camera": CAMERA, "size": [4, 2]}
NAMED = [{"name": "a", "solid": BALL}, {"name": "b", "solid": HOLED}]


def with_(path: str, value: object) -> dict[str, Any]:
    """Return a scene with something else at a path; `...` takes it away."""
    form = json.loads(json.dumps(FORM | {"solids": NAMED}))
    *inner, last = [int(word) if word.isdecimal() else word for word in path.split("/")]
    at: Any = form
    for word in inner:
        at = at[word]
    if value is ...:
        del at[last]
    else:
        at[last] = value
    return form


REFUSED = [
    ("about", 5, "about: is not a line of text"),
    ("solids", ..., "solids: is missing"),
    ("solids", 7, "solids: is neither a solid"),
    ("solids", [], "solids: is empty"),
    ("solids", {}, "solids: is empty"),
    ("solids", {"type": "cube"}, "solids.type: is not one of"),
    ("solids", {"a": 1}, "solids.a: is not an object"),
    ("solids", {"a": BALL | {"radius": -1}}, "solids.a.radius: is negative"),
    ("solids/1/solid/of/0/radius", -1, "solids[1].solid.of[0].radius: is negative"),
    ("solids/1/solid/of/1/q", [0, 0, 0], "solids[1].solid.of[1].q: is the same point as p"),
    ("solids/1/name", "a", "solids[1].name: is the name of an earlier solid"),
    ("solids/0/name", "", "solids[0].name: is not a name"),
    ("solids/0/name", 3, "solids[0].name: is not a name"),
    ("solids/0/colour", "red", "solids[0].colour: is not a field here"),
    ("solids/0/solid", ..., "solids[0].solid: is missing"),
    ("camera", ..., "camera: is missing"),
    ("camera", 1, "camera: is not an object"),
    ("camera/type", "fisheye", "camera.type: is not one of perspective, orthographic"),
    ("camera/type", "orthographic", "camera.fov: is not a field here"),
    ("camera/eye", [0, 0], "camera.eye: has 2 numbers, not three"),
    ("camera/eye", [0, 0, float("nan")], "camera.eye[2]: is NaN"),
    ("camera/eye", [0, 0, 0], "camera.look_at: is at the eye"),
    ("camera/look_at", [1.7e308, -1.7e308, 1.7e308], "camera.look_at: is too far from the eye"),
    ("camera/up", [0, 0, 0], "camera.up: is zero"),
    ("camera/up", [0, -3, 0], "camera.up: is along the line of sight"),
    ("camera/fov", 0, "camera.fov: is not positive"),
    ("camera/fov", 180, "camera.fov: is not below 180 degrees"),
    ("camera/fov", "wide", "camera.fov: is not a number"),
    ("camera/fov", ..., "camera.fov: is missing"),
    ("camera/near", 1, "camera.near: is not a field here"),
    ("camera", FLAT | {"height": 1e309}, "camera.height: is infinite"),
    ("camera", HIGH, "camera.height: makes rays beyond binary64"),
    ("size", [4], "size: is not [width, height]"),
    ("size", [4, 0], "size[1]: is not a whole number from 1 to"),
    ("size", [4.0, 2], "size[0]: is not a whole number"),
    ("size", [True, 2], "size[0]: is not a whole number"),
    ("size", [LARGEST + 1, 2], "size[0]: is not a whole number"),
    ("lights", [], "lights: is not a field here"),
]
BEYOND_THE_SCHEMA = (
    *("camera.look_at", "camera.up", "camera.height", "camera.eye[2]", "solids[1].solid.of[1].q"),
    *("solids[1].name", "size[0]: is not a whole number"),
)


@pytest.mark.parametrize(("path", "value", "message"), REFUSED)
def test_what_is_refused_is_named(path: str, value: object, message: str) -> None:
    form = with_(path, value)
    with pytest.raises(Refused) as refusal:
        read_scene(form)
    assert str(refusal.value).startswith(message)
    if not message.startswith(BEYOND_THE_SCHEMA):
        assert not SCHEMA.is_valid(form)


@pytest.mark.parametrize("solids", [BALL, HOLED, {"a": BALL, "b": HOLED}, {"type": BALL}, NAMED])
@pytest.mark.parametrize("camera", [CAMERA, FLAT])
def test_there_and_back(solids: object, camera: object) -> None:
    form = {"solids": solids, "camera": camera, "size": [4, 2], "about": "All kinds."}
    SCHEMA.validate(form)
    scene = read_scene(form)
    again = write_scene(scene)
    SCHEMA.validate(again)
    assert read_scene(json.loads(json.dumps(again))) == scene


def test_several_solids_are_a_union() -> None:
    assert read_scene(FORM).solid == Sphere((0, 0, 0), 1)
    scene = read_scene(FORM | {"solids": NAMED})
    assert [name for name, _ in scene.solids] == ["a", "b"]
    assert scene.solid == Union(tuple(solid for _, solid in scene.solids))


def test_six_scenes_are_shipped() -> None:
    assert shipped() == ("cylinder", "die", "far", "forest", "lens", "pipe")


@pytest.mark.parametrize("name", shipped())
def test_a_shipped_scene_is_as_the_schema_says(name: str) -> None:
    text = (SHIPPED / f"{name}.json").read_text(encoding="ascii")
    SCHEMA.validate(json.loads(text))
    scene = load(name)
    assert scene.size == (640, 480)
    assert scene.about.endswith(".")
    assert max(map(len, text.splitlines())) < 160


def test_a_file_is_read_and_bad_ones_say_why(tmp_path: Path) -> None:
    file = tmp_path / "own.json"
    file.write_text(json.dumps(FORM), encoding="utf-8")
    assert load(str(file)) == read_scene(FORM)
    file.write_text("{", encoding="utf-8")
    with pytest.raises(BadFile, match="is not JSON"):
        load(str(file))
    file.write_text("[" * 100_000, encoding="utf-8")
    with pytest.raises(BadFile, match="nested"):
        load(str(file))
    with pytest.raises(BadFile, match="No such file"):
        load(str(tmp_path / "none.json"))


def test_rays_by_hand() -> None:
    """4 x 2 pixels, 90 degrees: at distance 1 the picture is 4 wide and 2 high."""
    scene = read_scene(FORM)
    seen = frame(scene.camera)
    assert seen.forward == (0, 1, 0)
    assert seen.right == (1, 0, 0)
    assert seen.top == (0, 0, 1)
    s = tan(radians(45))
    assert pixel_ray(seen, (4, 2), 0, 0).direction == (-1.5 * s, 1, 0.5 * s)
    assert pixel_ray(seen, (4, 2), 3, 1).direction == (1.5 * s, 1, -0.5 * s)
    assert pixel_ray(seen, (4, 2), 3, 1).origin == (0, -4, 0)
    flat = frame(read_scene(FORM | {"camera": FLAT}).camera)
    ray = pixel_ray(flat, (4, 2), 1, 0)
    assert ray.direction == (0, 1, 0)
    assert ray.origin == (-0.75, -4, 0.75)


def test_the_middle_ray_looks_ahead_and_no_direction_is_normalised() -> None:
    seen = frame(load("cylinder").camera)
    assert pixel_ray(seen, (5, 3), 2, 1).direction == seen.forward
    assert hypot(*pixel_ray(seen, (5, 3), 0, 0).direction) > 1.01


def along(a: Vector, b: Vector) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))


@pytest.mark.parametrize("name", shipped())
def test_a_frame_is_square(name: str) -> None:
    seen = frame(load(name).camera)
    for a in (seen.forward, seen.right, seen.top):
        assert hypot(*a) == pytest.approx(1, abs=1e-15)
    assert abs(along(seen.forward, seen.right)) < 1e-15
    assert abs(along(seen.right, seen.top)) < 1e-15
    assert along(seen.top, load(name).camera.up) > 0
