"""Faults in Problems 2 and 3: planes, the slab, and the caps and rims of the cylinder."""

from __future__ import annotations

from collections.abc import Callable
from math import inf

from raycert.oracle.zoo.fault import Fault, fault
from raycert.oracle.zoo.lists import LINE, NAN, Pairs, common, share
from raycert.oracle.zoo.numbers import dot, minus, norm, times
from raycert.oracle.zoo.plain import PLAIN, unscaled
from raycert.oracle.zoo.tracer import Sight, Tracer, can, plane

Caps = tuple[Pairs, Pairs]


def between(low: float, high: float) -> Callable[[Tracer, Sight], Caps]:
    """Return the caps at two heights above p, in lengths of pq."""

    def caps(self: Tracer, s: Sight) -> Caps:
        climb, height, length = dot(s.v, s.w), dot(s.y, s.w), dot(minus(s.y, s.z), s.w)
        return (
            self.plane(low * length - height, -climb),
            self.plane(height - high * length, climb),
        )

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
    thickness = norm(minus(s.y, s.z))
    return [] if thickness < 1e-9 * s.r else can(self, s)


def hits(margin: float) -> Callable[[Tracer, Sight], Pairs]:
    """Return the cylinder by its hits: on the wall between the caps, on a cap within the wall.

    A hit is kept if it is inside by the margin, a share of the radius or of the length; the first
    hit and the last make the answer, and fewer than two make none.
    """

    def cylinder(self: Tracer, s: Sight) -> Pairs:
        wall, (above, below) = self.wall(self, s), self.caps(self, s)
        within = common(above, below)
        if wall == LINE or within == LINE or not wall or not within:
            return common(wall, within)
        (a, b), (c, d) = wall[0], within[0]
        slack, play = margin * (d - c), margin * (b - a)
        kept = [t for t in (a, b) if c + slack <= t <= d - slack]
        kept += [t for t in (c, d) if a + play <= t <= b - play]
        return [(min(kept), max(kept))] if len(kept) > 1 else []

    return cylinder


def _rim_twice(self: Tracer, s: Sight) -> Pairs:
    wall, (above, below) = self.wall(self, s), self.caps(self, s)
    within = common(above, below)
    if wall == LINE or within == LINE or not wall or not within:
        return common(wall, within)
    (a, b), (c, d) = wall[0], within[0]
    kept = sorted([t for t in (a, b) if c <= t <= d] + [t for t in (c, d) if a <= t <= b])
    return list(zip(kept[::2], kept[1::2], strict=False))


def _nan_in_plane(height: float, climb: float) -> Pairs:
    return NAN if height == 0 == climb else plane(height, climb)


def _level(self: Tracer, s: Sight) -> Caps:
    climb = dot(s.v, s.w)
    if abs(climb) < 1e-6 * norm(s.v) * norm(s.w):
        climb = 0.0
    return self.plane(-dot(s.y, s.w), -climb), self.plane(dot(s.z, s.w), climb)


def _unscaled_heights(self: Tracer, s: Sight) -> Caps:
    climb, height = dot(s.v, s.w), dot(s.y, s.w)
    return self.plane(-height, -climb), self.plane(height - norm(s.w), climb)


def _p_first_caps(self: Tracer, s: Sight) -> Caps:
    climb = dot(s.v, s.w)
    if climb >= 0:
        return self.plane(-dot(s.y, s.w), -climb), self.plane(dot(s.z, s.w), climb)
    return [], []


def _signed(self: Tracer, s: Sight) -> Caps:
    """By 1 / climb and the sign test climb >= 0, along the one axis where that keeps -0."""
    parts = [i for i in range(3) if s.w[i]]
    climb = s.v[parts[0]] * s.w[parts[0]] if len(parts) == 1 else dot(s.v, s.w)
    if climb or str(climb)[0] != "-":
        return self.plane(-dot(s.y, s.w), -climb), self.plane(dot(s.z, s.w), climb)
    near = -inf if dot(s.y, s.w) < 0 else inf
    return [(near, inf)], [(-inf, -near)]


def _surface(self: Tracer, s: Sight) -> Pairs:
    return [(t, t) for a, b in plane(dot(s.y, s.w), dot(s.v, s.w)) for t in (a, b) if abs(t) < inf]


def _unit_axis(self: Tracer, s: Sight) -> Pairs:
    """Return the cylinder of length one along pq."""
    n = times(1 / norm(s.w), s.w)
    return can(self, s._replace(z=minus(s.y, n)))


FAULTS: tuple[Fault, ...] = (
    fault(
        "caps-forgotten", "leaves the caps out: the cylinder goes on beyond them",
        "a student's Problem 3 left out", "perpendicular", "phantom",
        can=lambda self, s: self.wall(self, s),
    ),
    fault(
        "top-forgotten", "leaves the cap at q out", "a student's slip", "perpendicular", "phantom",
        can=lambda self, s: common(self.wall(self, s), self.caps(self, s)[0]),
    ),
    fault(
        "caps-endless", "does not ask whether a cap is hit within the radius",
        "DART #3359; a student's slip", "table-along-outside", "phantom", can=_caps_endless,
    ),
    fault(
        "cap-sign", "puts the far cap at p - (q - p)", "McCode a205f116b",
        "table-through", "missed", caps=between(-1.0, 0.0),
    ),
    fault(
        "centred", "takes p for the middle of the axis", "the habit of other formats",
        "table-through", "wrong end", caps=between(-0.5, 0.5),
    ),
    fault(
        "either-end", "keeps both hits of the wall if one or the other is between the caps",
        "fluid-engine-dev #251: || for &&", "table-through", "wrong end", can=_either_end,
    ),
    fault(
        "unit-length", "gives every cylinder the length one", "a local frame left unscaled",
        "random-cylinder", "wrong end", **PLAIN, can=_unit_axis,
    ),
    fault(
        "thin-lost", "sees nothing of a disk thinner than 1e-9 of its radius",
        "failures M8: OCCT", "disk", "missed", can=_thin,
    ),
    fault(
        "rim-crack", "drops a hit within 1e-3 of the rim, on the wall and on the cap",
        "Geant4 2002-06-26; DART #3359", "rim-near", "missed", can=hits(1e-3),
    ),
    fault(
        "rim-twice", "counts a hit on the rim twice, for the wall and for the cap",
        "moveit/geometric_shapes a627e6f", "rim", "missed", can=_rim_twice,
    ),
    fault(
        "plane-nan", "multiplies 0 by infinity where a ray lies in a plane",
        "BRL-CAD 871aacbd2a", "in-the-cap-plane", "malformed", plane=_nan_in_plane,
    ),
    fault(
        "nearly-level", "takes a climb below 1e-6 for none", "celeritas #1902",
        "planes-near-parallel", "missed", caps=_level,
    ),
    fault(
        "flipped-normal", "takes the normal of a half-space for inward", "parry PR #183",
        "half-space-rows", "missed", below=lambda self, s: plane(-dot(s.y, s.w), -dot(s.v, s.w)),
    ),
    fault(
        "no-exit", "sees only the planes that face the ray", "the habit of culling back faces",
        "half-space-rows", "wrong end",
        plane=lambda h, c: plane(h, c) if c < 0 else LINE if h <= 0 or c > 0 else [],
    ),
    fault(
        "plane-as-surface", "takes a half-space for its plane", "the habit of surfaces",
        "half-space-rows", "missed", below=_surface,
    ),
    fault(
        "p-first", "takes the plane through p for the one that is entered",
        "a student's slip: near and far not put in order", "slab-rows", "missed",
        caps=_p_first_caps,
    ),
    fault(
        "unscaled-heights", "compares (x - p) . (q - p) with |q - p|", "a student's slip: w for n",
        "random-slab", "wrong end", scale=unscaled, caps=_unscaled_heights,
    ),
    fault(
        "signed-zero", "divides by a direction of -0 and asks whether it is >= 0",
        "the slab method before Williams et al. 2005", "signed-zero", "missed", caps=_signed,
    ),
)  # fmt: skip
