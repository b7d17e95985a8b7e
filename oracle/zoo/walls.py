"""Faults in Problem 1: where the ray is in the wall, or in a sphere."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import hypot, nan, sqrt
from typing import Any

from raycert.cases.formats import BINARY32
from raycert.cases.model import Cylinder, InfiniteCylinder, Leaf, Slab, Vector
from raycert.cases.vectors import cross, dot, minus, times
from raycert.oracle.zoo.tracer import (
    LINE,
    NAN,
    PLAIN,
    Chord,
    Fault,
    Pairs,
    Sight,
    Step,
    Tracer,
    ball,
    chord,
    coefficients,
    crossed,
    each_leaf,
    fault,
    norm,
    projected,
    quadratic,
    roots,
    unit,
    unscaled,
)


def parallel(answer: Callable[[Vector, float], Pairs]) -> Chord:
    """Return the chord that answers otherwise where the ray runs along the axis."""
    return lambda y, v, r: chord(y, v, r) if any(v) else answer(y, r)


def ends(change: Callable[[float, float], Pairs]) -> Chord:
    """Return the chord whose two roots are passed on otherwise."""

    def changed(y: Vector, v: Vector, r: float) -> Pairs:
        pairs = chord(y, v, r)
        return pairs if not any(v) else [new for a, b in pairs for new in change(a, b)]

    return changed


def lost(when: Callable[[Vector, float], bool], wall: Step = crossed) -> dict[str, Any]:
    """Return the steps that see no wall and no sphere when the start, or the radius, is such."""
    return {
        "wall": lambda self, s: [] if when(s.y, s.r) else wall(self, s),
        "ball": lambda self, s: [] if when(s.y, s.r) else ball(self, s),
    }


def _no_slope(y: Vector, v: Vector, r: float) -> Pairs:
    a, b, c = coefficients(y, v, r)
    return roots(a, b, c) if a >= 1e-8 else LINE if c <= 0 else []


def _disc(change: Callable[[float], float]) -> Chord:
    def solve(a: float, b: float, c: float) -> Pairs:
        disc = change(b * b - a * c)
        if disc != disc:
            return NAN
        return [] if disc < 0 else [((-b - sqrt(disc)) / a, (-b + sqrt(disc)) / a)]

    return quadratic(solve)


def _forgets_the_four(a: float, b: float, c: float) -> Pairs:
    return [(low / 2, high / 2) for low, high in roots(a, 2 * b, c)]


def _times_a(a: float, b: float, c: float) -> Pairs:
    disc = b * b - a * c
    return [] if disc < 0 else [((-b - sqrt(disc)) * a, (-b + sqrt(disc)) * a)]


def _newton(a: float, b: float, c: float) -> Pairs:
    """Return the roots as twenty Newton steps find them, from t far outside on either side."""
    if b * b - a * c < 0:
        return []
    reach = hypot(b, sqrt(abs(a * c))) / a
    low, high = -b / a - reach, -b / a + reach
    for _ in range(20):
        low, high = _step(a, b, c, low), _step(a, b, c, high)
    return [(low, high)]


def _step(a: float, b: float, c: float, t: float) -> float:
    slope = a * t + b
    return t - (t * (a * t + 2 * b) + c) / (2 * slope) if slope else t


def _by_pythagoras(self: Tracer, s: Sight) -> Pairs:
    n = unit(s.w)
    along, height = dot(s.v, n), dot(s.y, n)
    a = dot(s.v, s.v) - along * along
    b = dot(s.v, s.y) - along * height
    return roots(max(a, 0.0), b, dot(s.y, s.y) - height * height - s.r * s.r)


def _unscaled_axis(self: Tracer, s: Sight) -> Pairs:
    y, v = minus(s.y, times(dot(s.y, s.w), s.w)), minus(s.v, times(dot(s.v, s.w), s.w))
    return self.chord(y, v, s.r)


def _nearly_parallel(self: Tracer, s: Sight) -> Pairs:
    v, w = s.v, s.w
    tilt = norm(cross(v, w))
    if 0 < tilt < 1e-6 * norm(v) * norm(w):
        return self.chord(cross(s.y, w), (0.0, 0.0, 0.0), s.r * norm(w))
    return crossed(self, s)


def _expanded(self: Tracer, s: Sight) -> Pairs:
    p = minus(s.u, s.y)
    c = dot(s.u, s.u) - 2 * dot(s.u, p) + dot(p, p) - s.r * s.r
    return roots(dot(s.v, s.v), dot(s.v, s.u) - dot(s.v, p), c)


def _upright(leaf: Leaf) -> Leaf:
    if not isinstance(leaf, Cylinder | InfiniteCylinder | Slab):
        return leaf
    (x, y, z), length = leaf.p, hypot(*minus(leaf.q, leaf.p))
    return replace(leaf, q=(x, y, z + length)) if z + length != z else leaf


FAULTS: tuple[Fault, ...] = (
    fault("parallel-nan", "divides 0 by 0 where the ray runs along the axis",
          "mccode-dev/McCode #986; aardvark-platform/aardvark.base #123", "parallel", "malformed",
          chord=parallel(lambda y, r: NAN)),
    fault("parallel-missed", "sees nothing where the ray runs along the axis",
          "bepu/bepuphysics2 #253", "table-along-inside", "missed",
          chord=parallel(lambda y, r: [])),
    fault("parallel-always", "takes every ray along the axis for one inside the wall",
          "aardvark-platform/aardvark.base #123", "table-along-outside", "phantom",
          chord=parallel(lambda y, r: LINE)),
    fault("nearly-parallel", "takes a ray within 1e-6 of the axis for parallel",
          "celeritas-project/celeritas #621", "tilt", "wrong end", wall=_nearly_parallel),
    fault("small-a", "takes the leading coefficient for zero below 1e-8",
          "PixarAnimationStudios/OpenUSD PR #4221", "direction-scale", "missed", **PLAIN,
          chord=_no_slope),
    fault("sine-by-pythagoras", "computes the part across the axis as v.v - (v.n)^2",
          "VecGeom 35c91e81; celeritas-project/celeritas #621", "tilt", "missed",
          wall=_by_pythagoras),
    fault("small-disc", "drops roots whose discriminant is below 1e-6",
          "the habit of an epsilon against double roots", "scene-scale", "missed", **PLAIN,
          chord=_disc(lambda d: d if d > 1e-6 else -1.0)),
    fault("tolerant-disc", "takes a discriminant above -1e-6 for zero",
          "openmc-dev/openmc #80; moveit/geometric_shapes a627e6f", "tangent-gap", "phantom",
          **PLAIN, chord=_disc(lambda d: d if d > 0 else 0.0 if d > -1e-6 else -1.0)),
    fault("single-disc", "computes the discriminant in binary32", "acts-project/detray #1003",
          "tangent-gap", "wrong end", chord=_disc(BINARY32.nearest)),
    fault("absolute-disc", "takes the root of the discriminant's absolute value",
          "BRL-CAD/brlcad 14e639f671", "table-miss", "phantom", chord=_disc(abs)),
    fault("root-of-negative", "takes the root of a negative discriminant",
          "Geant4 CSG/History 2007-08-16", "table-miss", "malformed",
          chord=_disc(lambda d: d if d >= 0 else nan)),
    fault("four-forgotten", "writes b^2 - ac for b^2 - 4ac", "a student's slip",
          "random-infinite-cylinder", "wrong end", chord=quadratic(_forgets_the_four)),
    fault("over-two-a", "writes / 2 * a for / (2 * a)", "a student's slip", "direction-scale",
          "phantom", **PLAIN, chord=quadratic(_times_a)),
    fault("a-is-one", "leaves the leading coefficient out, as if the direction had length one",
          "g-truc/glm #8", "direction-scale", "wrong end", **PLAIN,
          chord=quadratic(lambda a, b, c: roots(1.0, b, c))),
    fault("minus-forgotten", "writes b for -b", "a student's slip", "behind", "phantom",
          chord=ends(lambda a, b: [(-b, -a)])),
    fault("far-root", "takes the far root for both", "mmp/pbrt-v4 5f7a6068: 12 742 km away",
          "sphere-large", "missed", chord=ends(lambda a, b: [(b, b)])),
    fault("near-root", "takes the near root for both", "the habit of returning one hit",
          "random-cylinder", "missed", chord=ends(lambda a, b: [(a, a)])),
    fault("closest-point", "stops at the closest approach", "a student's slip: half is left out",
          "table-through", "wrong end", chord=ends(lambda a, b: [((a + b) / 2, (a + b) / 2)])),
    fault("newton", "gives up its iteration after twenty steps",
          "moveit/geometric_shapes #28; the remedy for an endless loop", "tangent-gap", "wrong end",
          chord=quadratic(_newton)),
    fault("radius-unsquared", "writes r for r^2", "a student's slip", "random-infinite-cylinder",
          "wrong end", **PLAIN, chord=lambda y, v, r: roots(dot(v, v), dot(v, y), dot(y, y) - r)),
    fault("diameter", "takes the radius for the diameter", "the habit of other formats",
          "random-infinite-cylinder", "wrong end", chord=lambda y, v, r: chord(y, v, r / 2)),
    fault("padded-radius", "adds 1e-4 to every radius", "the habit of a skin against leaks",
          "needle", "wrong end", **PLAIN, chord=lambda y, v, r: chord(y, v, r + 1e-4)),
    fault("small-radius", "sees nothing of a radius below 1e-9", "moveit/geometric_shapes #28",
          "scene-scale", "missed",
          scale=unscaled, **lost(lambda y, r: r < 1e-9, projected)),
    fault("zero-radius", "sees nothing of a radius of zero", "NVIDIA/VisRTX PR #334", "zero-radius",
          "missed", "stable", **lost(lambda y, r: r == 0)),
    fault("lost-at-distance", "sees nothing from more than 1e7 radii away", "Geant4 report #1022",
          "far-deep", "missed", **lost(lambda y, r: norm(y) > 1e7 * r > 0)),
    fault("axis-length", "crosses with the axis without dividing by its length",
          "a student's slip: w for n", "random-infinite-cylinder", "wrong end", scale=unscaled,
          wall=lambda self, s: self.chord(cross(s.y, s.w), cross(s.v, s.w), s.r)),
    fault("unscaled-axis", "projects on the axis without normalising it",
          "a student's slip: w for n", "random-infinite-cylinder", "wrong end", scale=unscaled,
          wall=_unscaled_axis),
    fault("upright", "takes every axis for parallel to z", "a local frame left out",
          "random-cylinder", "missed", read=each_leaf(_upright)),
    fault("expanded", "expands |u - center|^2 about the coordinate origin", "mmp/pbrt-v3 #44",
          "sphere-displaced", "wrong end", "sound", ball=_expanded),
)  # fmt: skip
