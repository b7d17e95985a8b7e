"""How fast the inner and the outer list close in: the gap between them shrinks as 1 / n^2.

A prism of n sides keeps within 1 - cos(pi / n) = (pi / n)^2 / 2 + ... of its cylinder on either
side, so the ends of the two lists differ by about (pi / n)^2 radii over the cosine at which the ray
meets the wall. The rays are fixed and meet it at cosines of 1/2 and more; caps have no gap. From
n = 4096 on, 4 MARGIN = 4e-9 begins to show against (pi / n)^2 = 6e-7.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from time import perf_counter

from raycert.cases.dice import Dice
from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, Ray, Vector
from raycert.oracle.witness.meshes import sandwich
from raycert.oracle.witness.prism import Fineness

SIDES = tuple(2**k for k in range(3, 13))
UNIT = Cylinder((0.0, 0.0, -1.0), (0.0, 0.0, 1.0), 1.0)


@dataclass(frozen=True, slots=True)
class Row:
    """For prisms of n sides: the mean gap at one end in radii, and the seconds a ray takes."""

    n: int
    gap: float
    seconds: float

    @property
    def scaled(self) -> float:
        """Return gap * n^2, which stays near a constant."""
        return self.gap * self.n**2


def convergence(sides: Sequence[int] = SIDES, rays: int = 32) -> list[Row]:
    """Return one row for each number of sides: the gap, and the time of two casts a ray.

    Building the bodies is not timed. Raises `ArithmeticError` where a fixed ray is not settled.
    """
    return [_row(n, [_ray(i) for i in range(rays)]) for n in sides]


def _row(n: int, rays: Sequence[Ray]) -> Row:
    fineness = Fineness(n, level=0)
    sandwich(UNIT, rays[0], fineness)
    start = perf_counter()
    found = [sandwich(UNIT, ray, fineness) for ray in rays]
    seconds = (perf_counter() - start) / len(rays)
    gap = 0.0
    for one in found:
        if len(one.inner) != 1 or len(one.outer) != 1:
            raise ArithmeticError(f"n = {n} does not settle a ray of the curve: {one}")
        low, a, b, high = (x.rational() for x in (one.outer[0][0], *one.inner[0], one.outer[0][1]))
        assert low is not None
        assert a is not None
        assert b is not None
        assert high is not None
        gap += float(a - low + high - b) / 2
    return Row(n, gap / len(rays), seconds)


def _ray(number: int) -> Ray:
    """Return a ray of about unit speed through the wall on both sides, at cosines of 1/2 or more.

    It passes the axis of UNIT at a distance of at most 1/2 in the plane z = 0, and rises by at most
    1/4 of its way, so that it is within the caps where it meets the wall.
    """
    dice = Dice(f"convergence {number}")
    while True:
        x, y, rise = dice.vector(BINARY64)
        square = x * x + y * y
        if 0.9 < square < 1:
            break
    off = dice.real(BINARY64, -0.5, 0.5)
    direction: Vector = (x, y, rise / 4)
    back = 3.0
    return Ray((-off * y - back * x, off * x - back * y, -back * rise / 4), direction)
