"""Faults in Problems 2 and 3: planes, the slab, the caps and rims of the cylinder.

Those of convention come last: strict comparisons, each of which drops one kind of touch.
"""

from __future__ import annotations

from collections.abc import Callable
from math import copysign, inf

from raycert.cases.model import Vector
from raycert.cases.vectors import cross, dot, minus
from raycert.oracle.zoo.tracer import (
    LINE,
    NAN,
    PLAIN,
    Fault,
    Pairs,
    Sight,
    Step,
    Tracer,
    ahead,
    can,
    chord,
    common,
    fault,
    norm,
    plane,
    share,
    unit,
    unscaled,
)

Caps = tuple[Pairs, Pairs]


def between(low: float, high: float) -> Callable[[Tracer, Sight], Caps]:
    def caps(self: Tracer, s: Sight) -> Caps:
        climb, height, length = dot(s.v, s.w), dot(s.y, s.w), dot(minus(s.y, s.z), s.w)
        above = self.plane(low * length - height, -climb)
        return above, self.plane(height - high * length, climb)

    return caps


def _caps_endless(self: Tracer, s: Sight) -> Pairs:
    wall = self.wall(self, s)
    return share([wall or LINE, *self.caps(self, s)])


def _either_end(self: Tracer, s: Sight) -> Pairs:
    wall, (above, below) = self.wall(self, s), self.caps(self, s)
    within = common(above, below)
    if wall == LINE:
        return within
    return [(a, b) for a, b in wall if any(c <= a <= d or c <= b <= d for c, d in within)]


def _thin(self: Tracer, s: Sight) -> Pairs:
    return [] if norm(minus(s.y, s.z)) < 1e-9 * s.r else can(self, s)


def _first_and_last(ts: list[float]) -> Pairs:
    return [(ts[0], ts[-1])] if len(ts) > 1 else []


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


def _two_by_two(ts: list[float]) -> Pairs:
    return list(zip(ts[::2], ts[1::2], strict=False))


def _nan_in_plane(height: float, climb: float) -> Pairs:
    return NAN if height == 0 == climb else plane(height, climb)


def _climbing(self: Tracer, s: Sight, climb: float) -> Caps:
    return self.plane(-dot(s.y, s.w), -climb), self.plane(dot(s.z, s.w), climb)


def _level(self: Tracer, s: Sight) -> Caps:
    climb = dot(s.v, s.w)
    return _climbing(self, s, 0.0 if abs(climb) < 1e-6 * norm(s.v) * norm(s.w) else climb)


def _unscaled_heights(self: Tracer, s: Sight) -> Caps:
    climb, height = dot(s.v, s.w), dot(s.y, s.w)
    return self.plane(-height, -climb), self.plane(height - norm(s.w), climb)


def _p_first_caps(self: Tracer, s: Sight) -> Caps:
    climb = dot(s.v, s.w)
    return _climbing(self, s, climb) if climb >= 0 else ([], [])


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


def _unit_axis(self: Tracer, s: Sight) -> Pairs:
    return can(self, s._replace(z=minus(s.y, unit(s.w))))


def _secants(y: Vector, v: Vector, r: float) -> Pairs:
    return chord(y, v, r) if norm(cross(v, y)) < r * norm(v) or not any(v) else []


def off_wall(y: Vector, v: Vector, r: float) -> Pairs:
    """Return the chord without a ray in the wall."""
    return chord(y, v, r) if any(v) or norm(y) < r else []


def off_plane(height: float, climb: float) -> Pairs:
    """Return the half-space without a ray in its plane."""
    return plane(height, climb) if climb or height < 0 else []


def _off_rim(self: Tracer, s: Sight) -> Pairs:
    return [(a, b) for a, b in can(self, s) if a < b]


STRICT = "a student's slip: > for >=, RayTracing/raytracing.github.io #110"
FAULTS: tuple[Fault, ...] = (
    fault("caps-forgotten", "leaves the caps out: the cylinder goes on beyond them",
          "a student's Problem 3 left out", "perpendicular", "phantom",
          can=lambda self, s: self.wall(self, s)),
    fault("top-forgotten", "leaves the cap at q out", "a student's slip", "perpendicular",
          "phantom", can=lambda self, s: common(self.wall(self, s), self.caps(self, s)[0])),
    fault("caps-endless", "does not ask whether a cap is hit within the radius",
          "dartsim/dart #3359; a student's slip", "table-along-outside", "phantom",
          can=_caps_endless),
    fault("cap-sign", "puts the far cap at p - (q - p)", "mccode-dev/McCode a205f116b",
          "table-through", "missed", caps=between(-1.0, 0.0)),
    fault("centred", "takes p for the middle of the axis", "the habit of other formats",
          "table-through", "wrong end", caps=between(-0.5, 0.5)),
    fault("either-end", "keeps both hits of the wall if one or the other is between the caps",
          "doyubkim/fluid-engine-dev #251: || for &&", "table-through", "wrong end",
          can=_either_end),
    fault("unit-length", "gives every cylinder the length one", "a local frame left unscaled",
          "random-cylinder", "wrong end", **PLAIN, can=_unit_axis),
    fault("thin-lost", "sees nothing of a disk thinner than 1e-9 of its radius",
          "the habit of a least thickness", "disk", "missed", can=_thin),
    fault("rim-crack", "drops a hit within 1e-3 of the rim, on the wall and on the cap",
          "Geant4 CSG/History 2002-06-26; dartsim/dart #3359", "rim-near", "missed",
          can=hits(1e-3, _first_and_last)),
    fault("rim-twice", "counts a hit on the rim twice, for the wall and for the cap",
          "moveit/geometric_shapes a627e6f", "rim", "missed", can=hits(0.0, _two_by_two)),
    fault("plane-nan", "multiplies 0 by infinity where a ray lies in a plane",
          "BRL-CAD/brlcad 871aacbd2a", "in-the-cap-plane", "malformed", plane=_nan_in_plane),
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
          caps=_p_first_caps),
    fault("unscaled-heights", "compares (x - p) . (q - p) with |q - p|",
          "a student's slip: w for n", "random-slab", "wrong end", scale=unscaled,
          caps=_unscaled_heights),
    fault("signed-zero", "divides by a direction of -0 and asks whether it is >= 0",
          "the slab method before Williams et al. 2005", "signed-zero", "missed", caps=_signed),
    fault("tangents-dropped", "asks for a discriminant > 0", STRICT, "tangent-exact",
          "touch dropped", "stable", chord=_secants),
    fault("wall-outside", "asks for |y| < r where the ray runs along the axis", STRICT,
          "in-the-wall", "touch dropped", "stable", chord=off_wall),
    fault("cap-outside", "asks for a height < 0 where the ray runs along a plane", STRICT,
          "in-the-cap-plane", "touch dropped", "stable", plane=off_plane),
    fault("rim-dropped", "asks for enter < leave where wall and caps meet", STRICT, "rim",
          "touch dropped", "stable", can=_off_rim),
    fault("start-dropped", "asks for leave > 0", STRICT, "start-on-surface", "touch dropped",
          "stable", ahead=lambda pairs: ahead([(a, b) for a, b in pairs if b > 0])),
)  # fmt: skip
