"""Faults of size: scales, units of t, precision, and where a tracer stops looking."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from math import hypot, inf, ldexp
from typing import Any
from zlib import crc32

from raycert.cases.formats import BINARY32
from raycert.cases.model import Leaf, Ray, Solid, Vector
from raycert.oracle.zoo.fault import Fault, fault
from raycert.oracle.zoo.lists import Pairs
from raycert.oracle.zoo.numbers import single
from raycert.oracle.zoo.plain import each_leaf, unscaled
from raycert.oracle.zoo.tracer import ahead

Tell = Callable[[Solid, Ray, Pairs], Pairs]
LEAST = sys.float_info.min


def every(change: Callable[[float], float]) -> Tell:
    """Return the step that changes every endpoint."""
    return lambda solid, ray, pairs: [(change(a), change(b)) for a, b in pairs]


def numbers(change: Callable[[float], float]) -> Callable[[Solid, Ray], tuple[Solid, Ray]]:
    """Return the step that changes every number of the question."""

    def moved(x: Vector) -> Vector:
        return (change(x[0]), change(x[1]), change(x[2]))

    def leaf(solid: Leaf) -> Leaf:
        values = {name: getattr(solid, name) for name in solid.__slots__}
        changed: dict[str, Any] = {
            name: moved(x) if isinstance(x, tuple) else change(x) for name, x in values.items()
        }
        return replace(solid, **changed)

    read = each_leaf(leaf)
    return lambda solid, ray: read(solid, Ray(moved(ray.origin), moved(ray.direction)))


def _in_lengths(solid: Solid, ray: Ray, pairs: Pairs) -> Pairs:
    length = hypot(*ray.direction) or 1.0
    return [(a * length, b * length) for a, b in pairs]


def _short(solid: Solid, ray: Ray) -> tuple[Solid, Ray]:
    return solid, ray if hypot(*ray.direction) >= 1e-8 else Ray(ray.origin, (0.0, 0.0, 0.0))


def _welded(leaf: Any) -> Leaf:
    if hasattr(leaf, "q") and max(abs(a - b) for a, b in zip(leaf.p, leaf.q, strict=True)) < 1e-8:
        raise ValueError("degenerate axis: p and q are the same vertex")
    welded: Leaf = leaf
    return welded


def _noisy(t: float) -> float:
    """Return t with its last 20 bits drawn from a hash."""
    if t == 0 or t == inf:
        return t
    noise = (crc32(t.hex().encode()) & 0xFFFFF) - 0x80000
    return t * (1 + ldexp(noise, -52))


def _flushed(x: float) -> float:
    return x if abs(x) >= LEAST else 0.0


def _until(far: float) -> Callable[[Pairs], Pairs]:
    return lambda pairs: [(a, min(b, far)) for a, b in ahead(pairs) if a <= far]


FAULTS: tuple[Fault, ...] = (
    fault(
        "normalised-direction", "normalises the direction, and gives t in lengths",
        "SlimDX #493; GeometricTools GTE #20; moveit/geometric_shapes #115",
        "direction-scale", "phantom", tell=_in_lengths,
    ),
    fault(
        "short-direction", "takes a direction shorter than 1e-8 for zero", "failures M9: MuJoCo",
        "direction-scale", "missed", read=_short,
    ),
    fault(
        "far-clip", "looks no farther than t = 1e7", "godot #72338; a far plane", "far-deep",
        "missed", ahead=_until(1e7),
    ),
    fault(
        "endless-cut", "ends at t = 1e6 what never ends", "the habit of a largest t",
        "half-space-rows", "wrong end", tell=every(lambda t: 1e6 if t == inf else t),
    ),
    fault(
        "endless-huge", "ends at the largest number what never ends", "OpenMOC #457: tan(pi/2)",
        "half-space-rows", "wrong end", tell=every(lambda t: sys.float_info.max if t == inf else t),
    ),
    fault(
        "single-inside", "computes in binary32", "pbrt-v4 5f7a6068; mitsuba3 #512",
        "random-cylinder", "wrong end", number=single,
    ),
    fault(
        "single-question", "stores its scene in binary32", "JoltPhysics #1818; bullet3 #1947",
        "start-near-surface", "wrong end", read=numbers(BINARY32.nearest),
    ),
    fault(
        "single-answer", "gives t in binary32", "Embree's and OptiX's rays", "random-cylinder",
        "wrong end", tell=every(BINARY32.nearest),
    ),
    fault(
        "nine-decimals", "rounds t to nine decimals", "the habit of comparing to 1e-9",
        "random-cylinder", "wrong end", tell=every(lambda t: round(t, 9)),
    ),
    fault(
        "six-digits", "prints six digits", "printf and iostream by default", "random-cylinder",
        "wrong end", tell=every(lambda t: float(f"{t:g}")),
    ),
    fault(
        "noise", "gives noise in the last twenty bits", "memory that was never set",
        "random-cylinder", "wrong end", tell=every(_noisy),
    ),
    fault(
        "welded", "refuses an axis shorter than 1e-8 as a point", "failures K67: trimesh",
        "scene-scale", "crash", read=each_leaf(_welded),
    ),
    fault(
        "flushed", "flushes subnormal numbers to zero", "-ffast-math", "range-subnormal",
        "crash", "stable", read=numbers(_flushed), tell=every(_flushed),
    ),
    fault(
        "overflow", "squares lengths as they are", "aardvark-platform/aardvark.base #127",
        "range-scenes", "wrong end", "stable", scale=unscaled,
    ),
)  # fmt: skip
