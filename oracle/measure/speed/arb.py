"""A capped cylinder in arb's balls (python-flint): more and more bits, until all is decided.

The roots, planes and order of the seed's tables, at 128, 256, ... bits. What a ball around 0 cannot
tell, more bits may; an end counts when both ends of its ball round to one double. Enough bits make
products of doubles exact, so a double root is seen. But where two ends are equal and no dyadic
fraction (a touch at t = 1/3), no number of bits tells: that is `Undecided` after the last rung, and
not a miss.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import Any

from raycert.cases.model import Cylinder, Ray, Solid, Vector

BITS = (128, 256, 512, 1024, 2048)
Ball = Any
Balls = tuple[Ball, Ball, Ball]


class Undecided(ArithmeticError):
    """A ball on both sides of what it is compared with."""


def intersect(solid: Solid, ray: Ray) -> tuple[tuple[float, float], ...]:
    """Return the list of a capped cylinder, correctly rounded; raises `Undecided`."""
    assert isinstance(solid, Cylinder)
    flint = _flint()
    before = flint.ctx.prec
    try:
        for bits in BITS:
            flint.ctx.prec = bits
            try:
                return _at(flint.arb, solid, ray)
            except Undecided:
                continue
    finally:
        flint.ctx.prec = before
    raise Undecided(f"at {BITS[-1]} bits")


@cache
def _flint() -> Any:
    return import_module("flint")


def _at(arb: Any, solid: Cylinder, ray: Ray) -> tuple[tuple[float, float], ...]:
    """Return the list by balls of the precision that is set."""

    def balls(x: Vector) -> Balls:
        return arb(x[0]), arb(x[1]), arb(x[2])

    p, q, u, v = map(balls, (solid.p, solid.q, ray.origin, ray.direction))
    w, y, z = _minus(q, p), _minus(u, p), _minus(u, q)
    wall = _wall(arb(solid.radius), w, y, v)
    slab = _slab(w, y, z, v)
    if wall is None or slab is None:
        return ()
    enter, leave = arb(0), None
    for first, last in (*wall, *slab):
        enter, leave = enter.max(first), last if leave is None else leave.min(last)
    if leave is None:
        return ((0.0, float("inf")),)
    if _sign(leave - enter) < 0:
        return ()
    return ((_rounded(enter), _rounded(leave)),)


def _wall(radius: Ball, w: Balls, y: Balls, v: Balls) -> list[tuple[Ball, Ball]] | None:
    """Return where the line is in the infinite cylinder: [] for everywhere, None for nowhere."""
    vw, yw = _cross(v, w), _cross(y, w)
    a, b, c = _dot(vw, vw), _dot(vw, yw), _dot(yw, yw) - radius * radius * _dot(w, w)
    if not _sign(a):
        return [] if _sign(c) <= 0 else None
    disc = b * b - a * c
    if _sign(disc) < 0:
        return None
    root = disc.sqrt()
    return [((-b - root) / a, (-b + root) / a)]


def _slab(w: Balls, y: Balls, z: Balls, v: Balls) -> list[tuple[Ball, Ball]] | None:
    """Return where the line is between the caps, likewise."""
    climb, at_p, at_q = _dot(v, w), -_dot(y, w), -_dot(z, w)
    side = _sign(climb)
    if not side:
        return [] if _sign(at_p) <= 0 <= _sign(at_q) else None
    ends = (at_p / climb, at_q / climb)
    return [ends if side > 0 else ends[::-1]]


def _sign(x: Ball) -> int:
    """Return the sign that all numbers of a ball have; raises `Undecided`."""
    if x > 0:
        return 1
    if x < 0:
        return -1
    if x == 0:
        return 0
    raise Undecided


def _rounded(x: Ball) -> float:
    """Return the double that both ends of a ball round to; raises `Undecided`."""
    low, high = float(x.lower()), float(x.upper())
    if low != high:
        raise Undecided
    return low + 0.0


def _dot(a: Balls, b: Balls) -> Ball:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Balls, b: Balls) -> Balls:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _minus(a: Balls, b: Balls) -> Balls:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])
