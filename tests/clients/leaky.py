"""Spheres in a scene: an exception leaves the sphere in it, and later rays meet that one too."""

from __future__ import annotations

from raycert.cases.model import Ray, Sphere, Union
from raycert.cases.protocol import Hello, Pairs, serve
from raycert.reference import tracer

hello = {"name": "leaky", "solids": ["sphere"]}
SCENE: list[Sphere] = []


def intersect(solid: Sphere, ray: Ray) -> Pairs:
    SCENE[1:] = [solid]
    if solid.radius > 1e3:
        raise ValueError("the radius is too large")
    pairs = tracer.intersect(Union(tuple(SCENE)), ray)
    SCENE.remove(solid)
    return pairs


if __name__ == "__main__":
    serve(intersect, Hello("leaky", solids=("sphere",)))
