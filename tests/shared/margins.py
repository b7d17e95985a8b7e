"""How far trimesh's caster seems to move a face, measured against exact integers.

A cast at a convex body M answers a chord. The seeming move is the least m for which that chord
lies in the exact chord of M with its face planes moved out by m, and holds the one of M with its
planes moved in by m. With L(tau) the least depth of the point of parameter tau below the planes of
M, which is concave and piecewise linear in tau, for the chord [a, b]

    m = max(-L(a), -L(b), the greatest L outside of [a, b])

and the greatest L anywhere for a miss. The doubles of body and cast are taken as exact, so nothing
is rounded but the norms of the planes' normals, by a relative 2^-64. Half of the casts aim where a
caster is weak: at edges and vertices, along faces and axes, at tangents.

`PYTHONPATH=tests python -m shared.margins 40000 1` (casts, seed)
prints in 5 minutes the greatest move:

    prism n = 8      40000 casts   2.0e-13   4164 unsure
    prism n = 64     40000 casts   2.3e-13   3938 unsure
    prism n = 256    20000 casts   1.6e-12   1920 unsure
    prism n = 4096     625 casts   1.0e-10   66 unsure
    ball level 1     40000 casts   3.7e-14   4140 unsure
    ball level 4      1250 casts   5.1e-15   69 unsure

It grows as n^2, with the slenderness of the triangles, whose barycentric coordinates trimesh takes
from a determinant. `MARGIN`, 2^-30 = 9.3e-10, is 580 times the worst of n <= 256, which the witness
uses, and 9 times that of n = 4096, which only the curve of convergence does.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

import numpy as np

from raycert.oracle.witness.bodies import Body, Fineness, Floats, Side, Unsure, ball, chord, prism
from raycert.oracle.witness.placement import AWAY, ONE, ZERO, CastLine

GRID = 110
"""Bits of the grid 2^-GRID on which the doubles of bodies and casts lie: those above 2^-57 do."""

Lines = tuple[np.ndarray, np.ndarray]
"""Depths below all planes as k + s tau, in integers of one unit: the arrays of k and of s."""


@dataclass(frozen=True, slots=True)
class Planes:
    """The face planes of a body in integers: depth of x is (offset - normal . x) * weight."""

    normals: np.ndarray
    offsets: np.ndarray
    weights: np.ndarray

    @classmethod
    def of(cls, body: Body) -> Planes:
        """Return the planes of a body's faces, each once as far as their corners tell."""
        a, b, c = (on_grid(body.vertices)[body.faces[:, k]] for k in range(3))
        p, q = b - a, c - a
        normals = np.stack(
            [p[:, i - 2] * q[:, i - 1] - p[:, i - 1] * q[:, i - 2] for i in range(3)], axis=1
        )
        squares = (normals * normals).sum(axis=1)
        weights = [(1 << 5 * GRID) // isqrt(square) for square in squares]
        return cls(normals, (normals * a).sum(axis=1), np.array(weights, dtype=object))

    def depths(self, line: CastLine) -> Lines:
        """Return the depths along a cast, in units of 2^-6 GRID."""
        start, direction = on_grid(np.array(line.start)), on_grid(np.array(line.direction))
        return (
            (self.offsets - self.normals @ start) * self.weights,
            -(self.normals @ direction) * self.weights,
        )


def on_grid(x: Floats) -> np.ndarray:
    """Return doubles in units of 2^-GRID, exactly."""
    scaled = [Fraction(float(v)) * 2**GRID for v in x.ravel()]
    if any(v.denominator != 1 for v in scaled):
        raise ArithmeticError("a coordinate lies off the grid")
    return np.array([int(v) for v in scaled], dtype=object).reshape(x.shape)


def least(lines: Lines, tau: Fraction) -> tuple[Fraction, int]:
    """Return the least depth at tau, and which plane it belongs to."""
    values = lines[0] * tau.denominator + lines[1] * tau.numerator
    k = int(np.argmin(values))
    return Fraction(int(values[k]), tau.denominator), k


def greatest(lines: Lines, low: Fraction, high: Fraction) -> Fraction:
    """Return the greatest of the least depths for low <= tau <= high, exactly.

    The least of lines is concave: where the line that is least at one end rises and the one at the
    other falls, their crossing bounds the peak, and its own least line replaces one of them.
    """
    at_low, a = least(lines, low)
    at_high, b = least(lines, high)
    while True:
        if lines[1][a] <= 0:
            return at_low
        if lines[1][b] >= 0:
            return at_high
        tau = Fraction(int(lines[0][b] - lines[0][a]), int(lines[1][a] - lines[1][b]))
        value, k = least(lines, tau)
        if value == lines[0][a] + lines[1][a] * tau or not lines[1][k]:
            return value
        if lines[1][k] > 0:
            a, at_low = k, value
        else:
            b, at_high = k, value


def seeming_move(body: Body, planes: Planes, line: CastLine) -> float:
    """Return the least move of the faces that explains a cast. Raises `Unsure` as `chord` does."""
    found = chord(body, line)
    lines, first, last = planes.depths(line), ZERO, Fraction(2 * AWAY)
    if found is None:
        moves = [greatest(lines, first, last)]
    else:
        a, b = (Fraction(end.tau) for end in found)
        moves = [-least(lines, a)[0], -least(lines, b)[0]]
        moves += [greatest(lines, first, a), greatest(lines, b, last)]
    return float(max(ZERO, *moves) / 2 ** (6 * GRID))


def casts(body: Body, count: int, seed: int) -> Iterator[CastLine]:
    """Yield casts past a body, half of them aimed where a caster is weak."""
    random = np.random.default_rng(seed)
    for number in range(count):
        corners = body.vertices[body.faces[random.integers(len(body.faces))]]
        aim = random.uniform(-1.2, 1.2, 3)
        d = random.normal(size=3)
        weak = number % 8
        if weak in (1, 2, 3):  # a vertex, an edge, a face
            aim = random.dirichlet(np.ones(weak)) @ corners[:weak]
        if weak in (2, 4):  # along a face, by a tilt of any size
            d = random.dirichlet(np.ones(2)) @ (corners[1:] - corners[0]) + _small(random)
            aim = corners.mean(axis=0) + _small(random)
        if number % 16 == 7:  # along an axis
            d = np.roll((1.0, 0.0, 0.0), random.integers(3)) + _small(random)
        yield _through(aim, d)


def _small(random: np.random.Generator) -> Floats:
    return np.asarray(random.normal(size=3) * 10 ** random.uniform(-16, 0))


def _through(aim: Floats, d: Floats) -> CastLine:
    """Return the cast through a point, of a length that `frame.line` may give it."""
    d = d / np.linalg.norm(d) * 1.3
    d[np.abs(d) < 2.0**-50] = 0
    aim = aim - (aim @ d) / (d @ d) * d
    x, y, z = (float(c) for c in aim - AWAY * d)
    return CastLine((x, y, z), (float(d[0]), float(d[1]), float(d[2])), ZERO, ONE)


@dataclass(frozen=True, slots=True)
class Measured:
    """The greatest seeming move over a number of casts, and how many of them said nothing."""

    casts: int
    worst: float
    unsure: int


def measure(body: Body, count: int, seed: int) -> Measured:
    """Return the greatest seeming move of a body's faces over a seeded sample of casts."""
    planes, worst, unsure = Planes.of(body), 0.0, 0
    for line in casts(body, count, seed):
        try:
            worst = max(worst, seeming_move(body, planes, line))
        except Unsure:
            unsure += 1
    return Measured(count, worst, unsure)


def main(count: int, seed: int) -> None:
    """Print one line for each kind of body: `count` casts at the coarse, fewer at the fine."""
    for n, share in ((8, 1), (64, 1), (256, 2), (4096, 64)):
        body = prism(Fineness(n, 0), Side.OUTER)
        _print(f"prism n = {n}", measure(body, count // share, seed))
    for level, share in ((1, 1), (4, 32)):
        body = ball(Fineness(8, level), Side.OUTER)
        _print(f"ball level {level}", measure(body, count // share, seed))


def _print(name: str, found: Measured) -> None:
    sys.stdout.write(
        f"    {name:<16}{found.casts:>6} casts   {found.worst:.1e}   {found.unsure} unsure\n"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
