"""Faults in Problems 1 to 3: in walls and spheres; in planes, caps and rims.

Those of convention come last: strict comparisons, each of which drops one kind of touch.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import copysign, hypot, inf, nan, sqrt
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
    ahead,
    ball,
    can,
    caps,
    chord,
    coefficients,
    common,
    crossed,
    each_leaf,
    fault,
    norm,
    plane,
    projected,
    quadratic,
    roots,
    share,
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


# Planes, the slab, the caps and rims of the cylinder.

Caps = tuple[Pairs, Pairs]


def between(low: float, high: float) -> Callable[[Tracer, Sight], Caps]:
    def moved(self: Tracer, s: Sight) -> Caps:
        climb, height, length = dot(s.v, s.w), dot(s.y, s.w), dot(minus(s.y, s.z), s.w)
        above = self.plane(low * length - height, -climb)
        return above, self.plane(height - high * length, climb)

    return moved


def _either_end(self: Tracer, s: Sight) -> Pairs:
    wall, (above, below) = self.wall(self, s), self.caps(self, s)
    within = common(above, below)
    if wall == LINE:
        return within
    return [(a, b) for a, b in wall if any(c <= a <= d or c <= b <= d for c, d in within)]


def hits(margin: float, paired: Callable[[list[float]], Pairs]) -> Step:
    """Return the cylinder by its hits: on the wall between the caps, on a cap within the wall.

    A hit counts if it is inside by the margin, a share of the radius or of the length; `paired`
    makes the answer of the hits in order.
    """

    def cylinder(self: Tracer, s: Sight) -> Pairs:
        wall, (above, below) = self.wall(self, s), self.caps(self, s)
        within = common(above, below)
        if wall == LINE or within == LINE or not wall or not within:
            return common(wall, within)
        (a, b), (c, d) = wall[0], within[0]
        slack, play = margin * (d - c), margin * (b - a)
        ts = [t for t in (a, b) if c + slack <= t <= d - slack]
        return paired(sorted(ts + [t for t in (c, d) if a + play <= t <= b - play]))

    return cylinder


def _climbing(self: Tracer, s: Sight, climb: float) -> Caps:
    return self.plane(-dot(s.y, s.w), -climb), self.plane(dot(s.z, s.w), climb)


def _level(self: Tracer, s: Sight) -> Caps:
    climb = dot(s.v, s.w)
    return _climbing(self, s, 0.0 if abs(climb) < 1e-6 * norm(s.v) * norm(s.w) else climb)


def _unscaled_heights(self: Tracer, s: Sight) -> Caps:
    climb, height = dot(s.v, s.w), dot(s.y, s.w)
    return self.plane(-height, -climb), self.plane(height - norm(s.w), climb)


def _signed(self: Tracer, s: Sight) -> Caps:
    """By 1 / climb and the sign test climb >= 0, along the one axis where that keeps -0."""
    parts = [i for i in range(3) if s.w[i]]
    climb = s.v[parts[0]] * s.w[parts[0]] if len(parts) == 1 else dot(s.v, s.w)
    if climb or copysign(1, climb) > 0:
        return _climbing(self, s, climb)
    near = -inf if dot(s.y, s.w) < 0 else inf
    return [(near, inf)], [(-inf, -near)]


def _surface(self: Tracer, s: Sight) -> Pairs:
    return [(t, t) for a, b in plane(dot(s.y, s.w), dot(s.v, s.w)) for t in (a, b) if abs(t) < inf]


def off_wall(y: Vector, v: Vector, r: float) -> Pairs:
    """Return the chord without a ray in the wall."""
    return chord(y, v, r) if any(v) or norm(y) < r else []


def off_plane(height: float, climb: float) -> Pairs:
    """Return the half-space without a ray in its plane."""
    return plane(height, climb) if climb or height < 0 else []


STRICT = "a student's slip: > for >=, RayTracing/raytracing.github.io #110"
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
          "random-infinite-cylinder", "wrong end",
          chord=quadratic(lambda a, b, c: [(t / 2, s / 2) for t, s in roots(a, 2 * b, c)])),
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
    fault("caps-forgotten", "leaves the caps out: the cylinder goes on beyond them",
          "a student's Problem 3 left out", "perpendicular", "phantom",
          can=lambda self, s: self.wall(self, s)),
    fault("top-forgotten", "leaves the cap at q out", "a student's slip", "perpendicular",
          "phantom", can=lambda self, s: common(self.wall(self, s), self.caps(self, s)[0])),
    fault("caps-endless", "does not ask whether a cap is hit within the radius",
          "dartsim/dart #3359; a student's slip", "table-along-outside", "phantom",
          can=lambda self, s: share([self.wall(self, s) or LINE, *self.caps(self, s)])),
    fault("cap-sign", "puts the far cap at p - (q - p)", "mccode-dev/McCode a205f116b",
          "table-through", "missed", caps=between(-1.0, 0.0)),
    fault("centred", "takes p for the middle of the axis", "the habit of other formats",
          "table-through", "wrong end", caps=between(-0.5, 0.5)),
    fault("either-end", "keeps both hits of the wall if one or the other is between the caps",
          "doyubkim/fluid-engine-dev #251: || for &&", "table-through", "wrong end",
          can=_either_end),
    fault("unit-length", "gives every cylinder the length one", "a local frame left unscaled",
          "random-cylinder", "wrong end", **PLAIN,
          can=lambda self, s: can(self, s._replace(z=minus(s.y, unit(s.w))))),
    fault("thin-lost", "sees nothing of a disk thinner than 1e-9 of its radius",
          "the habit of a least thickness", "disk", "missed",
          can=lambda self, s: [] if norm(minus(s.y, s.z)) < 1e-9 * s.r else can(self, s)),
    fault("rim-crack", "drops a hit within 1e-3 of the rim, on the wall and on the cap",
          "Geant4 CSG/History 2002-06-26; dartsim/dart #3359", "rim-near", "missed",
          can=hits(1e-3, lambda ts: [(ts[0], ts[-1])] if len(ts) > 1 else [])),
    fault("rim-twice", "counts a hit on the rim twice, for the wall and for the cap",
          "moveit/geometric_shapes a627e6f", "rim", "missed",
          can=hits(0.0, lambda ts: list(zip(ts[::2], ts[1::2], strict=False)))),
    fault("plane-nan", "multiplies 0 by infinity where a ray lies in a plane",
          "BRL-CAD/brlcad 871aacbd2a", "in-the-cap-plane", "malformed",
          plane=lambda height, climb: NAN if height == 0 == climb else plane(height, climb)),
    fault("nearly-level", "takes a climb below 1e-6 for none", "celeritas-project/celeritas #1902",
          "planes-near-parallel", "missed", caps=_level),
    fault("flipped-normal", "takes the normal of a half-space for inward", "dimforge/parry PR #183",
          "half-space-rows", "missed", below=lambda self, s: plane(-dot(s.y, s.w), -dot(s.v, s.w))),
    fault("no-exit", "sees only the planes that face the ray", "the habit of culling back faces",
          "half-space-rows", "wrong end",
          plane=lambda h, c: plane(h, c) if c < 0 else LINE if h <= 0 or c > 0 else []),
    fault("plane-as-surface", "takes a half-space for its plane", "the habit of surfaces",
          "half-space-rows", "missed", below=_surface),
    fault("p-first", "takes the plane through p for the one that is entered",
          "a student's slip: near and far not put in order", "slab-rows", "missed",
          caps=lambda self, s: caps(self, s) if dot(s.v, s.w) >= 0 else ([], [])),
    fault("unscaled-heights", "compares (x - p) . (q - p) with |q - p|",
          "a student's slip: w for n", "random-slab", "wrong end", scale=unscaled,
          caps=_unscaled_heights),
    fault("signed-zero", "divides by a direction of -0 and asks whether it is >= 0",
          "the slab method before Williams et al. 2005", "signed-zero", "missed", caps=_signed),
    fault("tangents-dropped", "asks for a discriminant > 0", STRICT, "tangent-exact",
          "touch dropped", "stable", chord=lambda y, v, r:
          chord(y, v, r) if norm(cross(v, y)) < r * norm(v) or not any(v) else []),
    fault("wall-outside", "asks for |y| < r where the ray runs along the axis", STRICT,
          "in-the-wall", "touch dropped", "stable", chord=off_wall),
    fault("cap-outside", "asks for a height < 0 where the ray runs along a plane", STRICT,
          "in-the-cap-plane", "touch dropped", "stable", plane=off_plane),
    fault("rim-dropped", "asks for enter < leave where wall and caps meet", STRICT, "rim",
          "touch dropped", "stable",
          can=lambda self, s: [(a, b) for a, b in can(self, s) if a < b]),
    fault("start-dropped", "asks for leave > 0", STRICT, "start-on-surface", "touch dropped",
          "stable", ahead=lambda pairs: ahead([(a, b) for a, b in pairs if b > 0])),
)  # fmt: skip
