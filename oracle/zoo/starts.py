"""Faults where the ray starts: what lies behind, starts inside and on the surface, self-hits."""

from __future__ import annotations

from collections.abc import Callable
from math import inf

from raycert.cases.model import Ray, Solid
from raycert.oracle.zoo.fault import Fault, fault
from raycert.oracle.zoo.lists import NAN, Pairs
from raycert.oracle.zoo.tracer import ahead


def kept(wanted: Callable[[float, float], bool]) -> Callable[[Pairs], Pairs]:
    """Return the step that cuts off at 0 and keeps the pairs of the whole line that are wanted."""
    return lambda pairs: ahead([(a, b) for a, b in pairs if wanted(a, b)])


def after(least: float) -> Callable[[Pairs], Pairs]:
    """Return the step that cuts off at a least t other than 0."""
    return lambda pairs: [(max(a, least), b) for a, b in pairs if b >= least]


def _unclipped(pairs: Pairs) -> Pairs:
    return [(0.0 if a == -inf else a, b) for a, b in pairs if a != -inf or b >= 0]


def _snap(t: float) -> float:
    return 0.0 if abs(t) < 1e-6 else t


def _mirrored(pairs: Pairs) -> Pairs:
    return [(a, b) if b >= 0 else (-b, -a) for a, b in ahead(pairs) or pairs]


def _at_rest(answer: Callable[[], Pairs]) -> Callable[[Solid, Ray, Pairs], Pairs]:
    """Return the step that answers otherwise to the zero direction."""
    return lambda solid, ray, pairs: pairs if any(ray.direction) else answer()


def _divided() -> Pairs:
    raise ZeroDivisionError("the direction has no length")


FAULTS: tuple[Fault, ...] = (
    fault(
        "no-clip", "does not cut off what lies at t < 0", "box2d #523; WickedEngine #1695",
        "behind", "malformed", ahead=_unclipped,
    ),
    fault(
        "behind-mirrored", "takes |t| of what lies behind", "NVIDIA PhysX #487",
        "behind", "phantom", ahead=_mirrored,
    ),
    fault(
        "behind-at-zero", "clamps both ends to 0: what lies behind is a hit at the start",
        "a student's slip", "behind", "phantom",
        ahead=lambda pairs: [(max(a, 0.0), max(b, 0.0)) for a, b in pairs],
    ),
    fault(
        "inside-missed", "sees nothing from inside", "bulletphysics/bullet3 #459",
        "start-inside", "missed", ahead=kept(lambda a, b: a >= 0 or b == inf),
    ),
    fault(
        "next-surface", "answers the next surface where it starts inside",
        "failures M10: first hits for intervals", "start-inside", "missed",
        ahead=lambda pairs: [(a if a >= 0 else b, b) for a, b in ahead(pairs) and pairs],
    ),
    fault(
        "surface-outside", "takes a start on the surface for one outside, and loses the solid",
        "openmc PR #3923; DART PR #3355", "start-on-surface", "missed",
        ahead=kept(lambda a, b: a != 0),
    ),
    fault(
        "self-hit", "begins at t = 1e-4 against self-hits", "the habit of a shadow epsilon",
        "start-inside", "wrong end", ahead=after(1e-4),
    ),
    fault(
        "self-hit-lost", "drops a solid whose first root is below 1e-3",
        "the habit of a shadow epsilon", "start-on-surface", "missed",
        ahead=kept(lambda a, b: not -1e-3 < a < 1e-3),
    ),
    fault(
        "large-epsilon", "drops what it leaves before t = 1.442", "RenderKit/ospray #279",
        "start-inside", "missed", ahead=kept(lambda a, b: b >= 1.442),
    ),
    fault(
        "short-dropped", "drops a stretch shorter than 1e-6 that is no point", "celeritas #480",
        "direction-scale", "missed",
        ahead=lambda pairs: [(a, b) for a, b in ahead(pairs) if not 0 < b - a < 1e-6],
    ),
    fault(
        "almost-clipped", "cuts off at t = -1e-9 what is behind by more",
        "VecGeom ba71e216: a tolerance shell", "start-near-surface", "malformed",
        ahead=lambda pairs: [(a if a > -1e-9 else 0.0, b) for a, b in pairs if b > -1e-9],
    ),
    fault(
        "snapped", "takes |t| < 1e-6 for 0", "Geant4 CSG/History 2008-06-23",
        "start-near-surface", "wrong end",
        ahead=lambda pairs: ahead([(_snap(a), _snap(b)) for a, b in pairs]),
    ),
    fault(
        "rest-crash", "divides by the length of the direction, be it zero",
        "ncollide #178; tommy-xr/shock2quest PR #409", "zero-direction", "crash",
        tell=_at_rest(_divided),
    ),
    fault(
        "rest-nan", "normalises the zero direction", "tommy-xr/shock2quest PR #409",
        "zero-direction", "malformed", tell=_at_rest(lambda: NAN),
    ),
    fault(
        "rest-missed", "sees nothing along the zero direction", "dimforge/parry #31",
        "zero-direction", "missed", tell=_at_rest(lambda: []),
    ),
)  # fmt: skip
