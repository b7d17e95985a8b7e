"""Tracers that are right in other ways than the base, and what each deserves."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import Any

from raycert.cases.model import Ray, Solid, Vector
from raycert.oracle.zoo.fault import Sound
from raycert.oracle.zoo.lists import Pairs, merged
from raycert.oracle.zoo.numbers import cross, dot, fraction, minus, norm, single, times
from raycert.oracle.zoo.plain import PLAIN, discriminant, unit, unscaled
from raycert.oracle.zoo.tracer import BASE, Sight, Tracer, ahead, chord, plane


def _framed(self: Tracer, s: Sight) -> Pairs:
    """Return where the ray is in the wall, in a frame whose third axis is pq."""
    n = unit(s.w)
    least = min(range(3), key=lambda i: abs(n[i]))
    e = unit(cross(n, (float(least == 0), float(least == 1), float(least == 2))))
    f = cross(n, e)
    y, v = (dot(s.y, e), dot(s.y, f), 0.0), (dot(s.v, e), dot(s.v, f), 0.0)
    return self.chord(y, v, s.r)


def _rationally(self: Tracer, s: Sight) -> Pairs:
    """Return where the ray is in the wall: projected without a root."""
    k = 1 / dot(s.w, s.w)
    y = minus(s.y, times(dot(s.y, s.w) * k, s.w))
    return self.chord(y, minus(s.v, times(dot(s.v, s.w) * k, s.w)), s.r)


def _to_double(solid: Solid, ray: Ray, pairs: Pairs) -> Pairs:
    return merged([(_float(a), _float(b)) for a, b in pairs])


def _float(t: float) -> float:
    try:
        return float(t)
    except OverflowError:
        return inf


def _strict_chord(y: Vector, v: Vector, r: float) -> Pairs:
    return chord(y, v, r) if any(v) or norm(y) < r else []


def _strict_plane(height: float, climb: float) -> Pairs:
    return plane(height, climb) if climb or height < 0 else []


def _no_points(pairs: Pairs) -> Pairs:
    return [(a, b) for a, b in ahead(pairs) if a < b]


def _negative_zero(solid: Solid, ray: Ray, pairs: Pairs) -> Pairs:
    return [(a or -0.0, b or -0.0) for a, b in pairs]


DROPPED: dict[str, Any] = {"chord": _strict_chord, "plane": _strict_plane, "ahead": _no_points}
"""The steps of a tracer that drops what only touches."""

UNSTRESSED = ("half_space", "slab")
"""Solids with no discriminant."""

SOUND: tuple[Sound, ...] = (
    Sound("base", "crosses with the axis, and starts from the closest approach", BASE, "stable"),
    Sound(
        "projected", "projects on the plane square to the axis, and scales nothing",
        replace(BASE, **PLAIN), "stable",
    ),
    Sound(
        "local-frame", "turns the ray into a frame whose third axis is that of the solid",
        replace(BASE, scale=unscaled, wall=_framed), "stable",
    ),
    Sound(
        "textbook", "solves by the discriminant b^2 - a c", replace(BASE, chord=discriminant),
        "sound", but=tuple((name, "stable") for name in UNSTRESSED),
    ),
    Sound(
        "extended", "computes in fractions, roots to 240 bits, and rounds at the end",
        replace(
            BASE, number=fraction, scale=unscaled, wall=_rationally, chord=discriminant,
            tell=_to_double,
        ),
        "exact",
    ),
    Sound(
        "binary32", "computes in binary32, and declares it", replace(BASE, number=single),
        "stable", precision="binary32",
    ),
    Sound(
        "regularized", "drops what only touches", replace(BASE, **DROPPED), "stable",
        convention="regularized",
    ),
    Sound("negative-zero", "answers -0 for 0", replace(BASE, tell=_negative_zero), "stable"),
)  # fmt: skip
