"""Faults of convention: strict comparisons, each of which drops one kind of touch."""

from __future__ import annotations

from raycert.cases.model import Vector
from raycert.oracle.zoo.fault import Fault, fault
from raycert.oracle.zoo.lists import Pairs
from raycert.oracle.zoo.numbers import cross, norm
from raycert.oracle.zoo.tracer import Sight, Tracer, ahead, can, chord, plane


def _secants(y: Vector, v: Vector, r: float) -> Pairs:
    return chord(y, v, r) if norm(cross(v, y)) < r * norm(v) or not any(v) else []


def _off_wall(y: Vector, v: Vector, r: float) -> Pairs:
    return chord(y, v, r) if any(v) or norm(y) < r else []


def _off_plane(height: float, climb: float) -> Pairs:
    return plane(height, climb) if climb or height < 0 else []


def _off_rim(self: Tracer, s: Sight) -> Pairs:
    return [(a, b) for a, b in can(self, s) if a < b]


STRICT = "a student's slip: > for >=, RayTracing/raytracing.github.io #110"
FAULTS: tuple[Fault, ...] = (
    fault(
        "tangents-dropped", "asks for a discriminant > 0", STRICT,
        "tangent-exact", "touch dropped", "stable", chord=_secants,
    ),
    fault(
        "wall-outside", "asks for |y| < r where the ray runs along the axis", STRICT,
        "in-the-wall", "touch dropped", "stable", chord=_off_wall,
    ),
    fault(
        "cap-outside", "asks for a height < 0 where the ray runs along a plane", STRICT,
        "in-the-cap-plane", "touch dropped", "stable", plane=_off_plane,
    ),
    fault(
        "rim-dropped", "asks for enter < leave where wall and caps meet", STRICT,
        "rim", "touch dropped", "stable", can=_off_rim,
    ),
    fault(
        "start-dropped", "asks for leave > 0", STRICT, "start-on-surface", "touch dropped",
        "stable", ahead=lambda pairs: ahead([(a, b) for a, b in pairs if b > 0]),
    ),
)  # fmt: skip
