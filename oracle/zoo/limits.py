"""Faults of reach: where a tracer starts and stops looking, its scales, units and precision."""

from __future__ import annotations

import sys
from collections.abc import Callable
from math import hypot, inf, ldexp
from typing import Any, cast
from zlib import crc32

from raycert.cases.formats import BINARY32
from raycert.cases.model import FIELDS, Leaf, Ray, Solid
from raycert.oracle.zoo.tracer import (
    NAN,
    Fault,
    Pairs,
    Read,
    Tell,
    ahead,
    each_leaf,
    fault,
    single,
    unscaled,
)


def wanted(is_wanted: Callable[[float, float], bool]) -> Callable[[Pairs], Pairs]:
    """Return the step that cuts off at 0 and keeps the pairs of the whole line that are wanted."""
    return lambda pairs: ahead([(a, b) for a, b in pairs if is_wanted(a, b)])


def _at_rest(answer: Callable[[], Pairs]) -> Tell:
    """Return the step that answers otherwise to the zero direction."""
    return lambda solid, ray, pairs: pairs if any(ray.direction) else answer()


def _divided() -> Pairs:
    raise ZeroDivisionError("the direction has no length")


def every(change: Callable[[float], float]) -> Tell:
    return lambda solid, ray, pairs: [(change(a), change(b)) for a, b in pairs]


def numbers(change: Callable[[float], float]) -> Read:
    def moved(x: Any) -> Any:
        return tuple(map(change, x)) if isinstance(x, tuple) else change(x)

    def changed(leaf: Leaf) -> Leaf:
        return type(leaf)(*(moved(getattr(leaf, name)) for name in FIELDS[type(leaf)]))

    read = each_leaf(changed)
    return lambda solid, ray: read(solid, Ray(moved(ray.origin), moved(ray.direction)))


def _in_lengths(solid: Solid, ray: Ray, pairs: Pairs) -> Pairs:
    length = hypot(*ray.direction) or 1.0
    return [(a * length, b * length) for a, b in pairs]


def _welded(leaf: Any) -> Leaf:
    if hasattr(leaf, "q") and max(abs(a - b) for a, b in zip(leaf.p, leaf.q, strict=True)) < 1e-8:
        raise ValueError("degenerate axis: p and q are the same vertex")
    return cast(Leaf, leaf)


def _noisy(t: float) -> float:
    """Return t with its last 20 bits drawn from a hash."""
    if t == 0 or t == inf:
        return t
    noise = (crc32(t.hex().encode()) & 0xFFFFF) - 0x80000
    return t * (1 + ldexp(noise, -52))


def _flushed(x: float) -> float:
    return x if abs(x) >= sys.float_info.min else 0.0


FAULTS: tuple[Fault, ...] = (
    fault("no-clip", "does not cut off what lies at t < 0",
          "erincatto/box2d #523; turanszkij/WickedEngine #1695", "behind", "malformed",
          ahead=lambda pairs: [(0.0 if a == -inf else a, b) for a, b in pairs
                               if a != -inf or b >= 0]),
    fault("behind-mirrored", "takes |t| of what lies behind", "NVIDIA PhysX #487", "behind",
          "phantom", ahead=lambda pairs:
          [(a, b) if b >= 0 else (-b, -a) for a, b in ahead(pairs) or pairs]),
    fault("behind-at-zero", "clamps both ends to 0: what lies behind is a hit at the start",
          "a student's slip", "behind", "phantom",
          ahead=lambda pairs: [(max(a, 0.0), max(b, 0.0)) for a, b in pairs]),
    fault("inside-missed", "sees nothing from inside", "bulletphysics/bullet3 #459", "start-inside",
          "missed", ahead=wanted(lambda a, b: a >= 0 or b == inf)),
    fault("next-surface", "answers the next surface where it starts inside",
          "first hits for intervals", "start-inside", "missed",
          ahead=lambda pairs: [(a if a >= 0 else b, b) for a, b in ahead(pairs) and pairs]),
    fault("surface-outside", "takes a start on the surface for one outside, and loses the solid",
          "openmc-dev/openmc PR #3923; dartsim/dart PR #3355", "start-on-surface", "missed",
          ahead=wanted(lambda a, b: a != 0)),
    fault("self-hit", "begins at t = 1e-4 against self-hits", "the habit of a shadow epsilon",
          "start-inside", "wrong end",
          ahead=lambda pairs: [(max(a, 1e-4), b) for a, b in pairs if b >= 1e-4]),
    fault("self-hit-lost", "drops a solid whose first root is below 1e-3",
          "the habit of a shadow epsilon", "start-on-surface", "missed",
          ahead=wanted(lambda a, b: not -1e-3 < a < 1e-3)),
    fault("large-epsilon", "drops what it leaves before t = 1.442", "RenderKit/ospray #279",
          "start-inside", "missed", ahead=wanted(lambda a, b: b >= 1.442)),
    fault("short-dropped", "drops a stretch shorter than 1e-6 that is no point",
          "celeritas-project/celeritas #480", "direction-scale", "missed",
          ahead=lambda pairs: [(a, b) for a, b in ahead(pairs) if not 0 < b - a < 1e-6]),
    fault("almost-clipped", "cuts off at t = -1e-9 what is behind by more",
          "VecGeom ba71e216: a tolerance shell", "start-near-surface", "malformed",
          ahead=lambda pairs: [(a if a > -1e-9 else 0.0, b) for a, b in pairs if b > -1e-9]),
    fault("snapped", "takes |t| < 1e-6 for 0", "Geant4 CSG/History 2008-06-23",
          "start-near-surface", "wrong end", ahead=lambda pairs: ahead(
              [(0.0 if abs(a) < 1e-6 else a, 0.0 if abs(b) < 1e-6 else b) for a, b in pairs])),
    fault("rest-crash", "divides by the length of the direction, be it zero",
          "dimforge/ncollide #178; tommy-xr/shock2quest PR #409", "zero-direction", "crash",
          tell=_at_rest(_divided)),
    fault("rest-nan", "normalises the zero direction", "tommy-xr/shock2quest PR #409",
          "zero-direction", "malformed", tell=_at_rest(lambda: NAN)),
    fault("rest-missed", "sees nothing along the zero direction", "dimforge/parry #31",
          "zero-direction", "missed", tell=_at_rest(lambda: [])),
    fault("normalised-direction", "normalises the direction, and gives t in lengths",
          "SlimDX/slimdx #493; davideberly/GeometricTools #20; moveit/geometric_shapes #115",
          "direction-scale", "phantom", tell=_in_lengths),
    fault("short-direction", "takes a direction shorter than 1e-8 for zero",
          "PixarAnimationStudios/OpenUSD PR #4221", "direction-scale", "missed",
          read=lambda solid, ray:
          (solid, ray if hypot(*ray.direction) >= 1e-8 else Ray(ray.origin, (0.0, 0.0, 0.0)))),
    fault("far-clip", "looks no farther than t = 1e7", "godotengine/godot #72338; a far plane",
          "far-deep", "missed",
          ahead=lambda pairs: [(a, min(b, 1e7)) for a, b in ahead(pairs) if a <= 1e7]),
    fault("endless-cut", "ends at t = 1e6 what never ends", "the habit of a largest t",
          "half-space-rows", "wrong end", tell=every(lambda t: 1e6 if t == inf else t)),
    fault("endless-huge", "ends at the largest number what never ends",
          "mit-crpg/OpenMOC PR #457: tan(pi/2)", "half-space-rows", "wrong end",
          tell=every(lambda t: sys.float_info.max if t == inf else t)),
    fault("single-inside", "computes in binary32",
          "mmp/pbrt-v4 5f7a6068; mitsuba-renderer/mitsuba3 #512", "random-cylinder", "wrong end",
          number=single),
    fault("single-question", "stores its scene in binary32",
          "jrouwe/JoltPhysics #1818; bulletphysics/bullet3 #1947", "start-near-surface",
          "wrong end", read=numbers(BINARY32.nearest)),
    fault("single-answer", "gives t in binary32", "Embree's and OptiX's rays", "random-cylinder",
          "wrong end", tell=every(BINARY32.nearest)),
    fault("nine-decimals", "rounds t to nine decimals", "the habit of comparing to 1e-9",
          "random-cylinder", "wrong end", tell=every(lambda t: round(t, 9))),
    fault("six-digits", "prints six digits", "printf and iostream by default", "random-cylinder",
          "wrong end", tell=every(lambda t: float(f"{t:g}"))),
    fault("noise", "gives noise in the last twenty bits", "memory that was never set",
          "random-cylinder", "wrong end", tell=every(_noisy)),
    fault("welded", "refuses an axis shorter than 1e-8 as a point",
          "mikedh/trimesh: tol.merge = 1e-8", "scene-scale", "crash", read=each_leaf(_welded)),
    fault("flushed", "flushes subnormal numbers to zero", "-ffast-math", "range-subnormal", "crash",
          "stable", read=numbers(_flushed), tell=every(_flushed)),
    fault("overflow", "squares lengths as they are", "aardvark-platform/aardvark.base #127",
          "range-scenes", "wrong end", "stable", scale=unscaled),
)  # fmt: skip
