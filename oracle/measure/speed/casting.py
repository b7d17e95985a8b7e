"""What the ray casters are asked: one solid, rays that start outside of it, and the exact hits.

    scattered   each ray has its own origin, all about the solid
    camera      all rays start at one eye, pixel by pixel
    pipe        scattered, at a cylinder with a hole along its axis

Two questions: the `first` hit, and `all` of them, each as the t where the ray meets the surface. A
ray that starts inside has no first hit that all agree on, and is left out.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from raycert.cases.model import Cylinder, Difference, Solid, Vector
from raycert.cases.scene import Camera, Scene, frame, pixel_ray

if TYPE_CHECKING:
    from raycert.oracle.batch.lanes import Floats
    from raycert.oracle.batch.trace import Batch

CASTS = ("scattered", "camera", "pipe")
QUESTIONS = ("first", "all")
DISTANCE, ANGLE = 9.0, 24.0
"""Of the camera: from the middle of the cylinder, and degrees across the picture's height."""


class Hits(NamedTuple):
    """The hits of all rays: the number of the ray, and the t."""

    ray: Any
    t: Any


@dataclass(frozen=True)
class Cast:
    """Rays at a cylinder, with a hole if `inner` is there; `scene` where a camera sends them."""

    name: str
    outer: Cylinder
    inner: Cylinder | None
    origins: Floats
    directions: Floats
    scene: Scene | None
    truth: Batch

    @property
    def solid(self) -> Solid:
        """Return what the rays are cast at."""
        return self.outer if self.inner is None else Difference((self.outer, self.inner))

    def exact(self, question: str) -> Hits:
        """Return the correctly rounded hits."""
        import numpy as np

        ray = np.repeat(np.arange(len(self.origins)), self.truth.counts)
        if question == "first":
            leading = np.diff(ray, prepend=-1) != 0
            return Hits(ray[leading], self.truth.enter[leading])
        return Hits(
            np.repeat(ray, 2), np.column_stack([self.truth.enter, self.truth.leave]).ravel()
        )


def cast(name: str, size: tuple[int, int], seed: int) -> Cast:
    """Return a cast of as many rays as a picture of a size has pixels, or a few less."""
    from raycert.oracle.batch.trace import trace_batch
    from raycert.oracle.measure.scenarios import rays

    some = rays("cylinder", "random", size[0] * size[1], seed)
    outer = some.solid
    assert isinstance(outer, Cylinder)
    origins, directions, scene = some.origins, some.directions, None
    if name == "camera":
        scene = Scene((("cylinder", outer),), camera(outer), size)
        origins, directions = _pixels(scene)
    inner = hole(outer) if name == "pipe" else None
    solid = outer if inner is None else Difference((outer, inner))
    found = trace_batch(solid, origins, directions, engine="numpy")
    inside = found.enter[found.offsets[:-1].clip(max=max(len(found.enter) - 1, 0))] == 0
    keep = ~(inside & (found.counts > 0))
    if not keep.all():
        origins, directions = origins[keep], directions[keep]
        found = trace_batch(solid, origins, directions, engine="numpy")
    return Cast(name, outer, inner, origins, directions, scene, found)


def hole(outer: Cylinder) -> Cylinder:
    """Return a cylinder of half the radius through both caps."""
    p, q = outer.p, outer.q
    beyond = [(b - a) / 4 for a, b in zip(p, q, strict=True)]
    low = tuple(a - c for a, c in zip(p, beyond, strict=True))
    high = tuple(b + c for b, c in zip(q, beyond, strict=True))
    return Cylinder((low[0], low[1], low[2]), (high[0], high[1], high[2]), outer.radius / 2)


def camera(outer: Cylinder) -> Camera:
    """Return an eye in front of a cylinder."""
    middle = tuple((a + b) / 2 for a, b in zip(outer.p, outer.q, strict=True))
    at: Vector = (middle[0], middle[1], middle[2])
    way = (0.5, -0.75, 0.25)
    eye = tuple(m + DISTANCE * c for m, c in zip(at, way, strict=True))
    return Camera("perspective", (eye[0], eye[1], eye[2]), at, (0.0, 0.0, 1.0), ANGLE)


def _pixels(scene: Scene) -> tuple[Floats, Floats]:
    import numpy as np

    seen_from, (width, height) = frame(scene.camera), scene.size
    rays = [pixel_ray(seen_from, scene.size, i, j) for j in range(height) for i in range(width)]
    return np.array([ray.origin for ray in rays]), np.array([ray.direction for ray in rays])
