"""Time per ray of several ways to answer the same rays, in one run, as ratios.

Machines are shared and noisy: only ratios from one run mean much. The methods answer the same rays
in turn, several times over; the minimum is a method's price, the median beside it tells the noise.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from statistics import median
from typing import Any

from cases.dice import Dice
from cases.formats import BINARY64
from cases.model import Cylinder, Ray, Vector
from oracle.rounding import expected
from oracle.trace import trace

Scene = tuple[Cylinder, Ray]
Intersect = Callable[[Cylinder, Ray], Sequence[tuple[float, float]]]
Number = Any
"""A number of whatever library is timed."""
REPEATS = 5


@dataclass(frozen=True, slots=True)
class Method:
    """A way to answer; `fresh` forgets what was cached, so that every pass is a first one."""

    name: str
    intersect: Intersect
    fresh: Callable[[], None] = lambda: None


@dataclass(frozen=True, slots=True)
class Timing:
    """Seconds of one thing timed, and how many of the rays came out correctly rounded."""

    name: str
    best: float
    median: float
    exact: int = 0


def scenes(count: int) -> list[Scene]:
    """Return random capped cylinders and rays that cross them, both ends ahead; always the same."""
    dice = Dice("benchmark")
    found: list[Scene] = []
    while len(found) < count:
        p, q, u, v = (dice.vector(BINARY64, -2, 2) for _ in range(4))
        scene = Cylinder(p, q, dice.real(BINARY64, 0.2, 2)), Ray((3 * u[0], 3 * u[1], 3 * u[2]), v)
        exact = trace(*scene).intervals
        if exact and exact[0][0].sign() > 0:
            found.append(scene)
    return found


def race(methods: Sequence[Method], rays: Sequence[Scene], repeats: int = REPEATS) -> list[Timing]:
    """Return the time per ray of each method, all on the same rays, pass by pass in turn."""
    seconds: dict[str, list[float]] = {method.name: [] for method in methods}
    for _ in range(repeats):
        for method in methods:
            method.fresh()
            began = time.perf_counter()
            for solid, ray in rays:
                method.intersect(solid, ray)
            seconds[method.name].append((time.perf_counter() - began) / len(rays))
    return [
        Timing(m.name, min(seconds[m.name]), median(seconds[m.name]), correct(m, rays))
        for m in methods
    ]


def correct(method: Method, rays: Sequence[Scene]) -> int:
    """Return how many rays a method answers with the correctly rounded list."""
    return sum(tuple(method.intersect(*scene)) == exact(*scene) for scene in rays)


def exact(solid: Cylinder, ray: Ray) -> tuple[tuple[float, float], ...]:
    """Return the oracle's answer: the exact list, both endpoints correctly rounded."""
    return expected(trace(solid, ray).intervals, BINARY64)[1]


def methods() -> Iterator[Method]:
    """Yield the methods that can run here, the oracle first; what is not installed is left out."""
    yield Method("oracle, correctly rounded", exact)
    yield Method("reference tracer, float64", import_module("reference.tracer").intersect)
    mpmath = import_module("mpmath")
    yield Method("mpmath, 50 digits", lambda *scene: _with_mpmath(mpmath, *scene))
    try:
        sympy = import_module("sympy")
    except ImportError:
        return
    forget = import_module("sympy.core.cache").clear_cache
    yield Method("SymPy, exact to 40 digits", lambda *scene: _with_sympy(sympy, *scene), forget)


def _with_mpmath(mpmath: Any, solid: Cylinder, ray: Ray) -> list[tuple[float, float]]:
    with mpmath.workdps(50):
        return [(float(a), float(b)) for a, b in seed(solid, ray, mpmath.mpf, mpmath.sqrt)]


def _with_sympy(sympy: Any, solid: Cylinder, ray: Ray) -> list[tuple[float, float]]:
    def number(x: float) -> Number:
        return sympy.Rational(*x.as_integer_ratio())

    pairs = seed(solid, ray, number, sympy.sqrt)
    return [(float(a.evalf(40)), float(b.evalf(40))) for a, b in pairs]


def seed(
    solid: Cylinder,
    ray: Ray,
    number: Callable[[float], Number],
    root: Callable[[Number], Number],
) -> list[tuple[Number, Number]]:
    """Return the list of a capped cylinder by the seed's tables, over any numbers; v.w != 0.

    The quadratic of Problem 1 (times |w|^2), the two planes of Problem 2, max and min of Problem 3.
    """

    def exactly(x: Vector) -> tuple[Number, Number, Number]:
        return number(x[0]), number(x[1]), number(x[2])

    p, q, u, v = map(exactly, (solid.p, solid.q, ray.origin, ray.direction))
    w, y, z = _sub(q, p), _sub(u, p), _sub(u, q)
    vw, yw = _cross(v, w), _cross(y, w)
    a, b = _dot(vw, vw), _dot(vw, yw)
    disc = b * b - a * (_dot(yw, yw) - number(solid.radius) ** 2 * _dot(w, w))
    if disc < 0:
        return []
    t1, t2 = (-b - root(disc)) / a, (-b + root(disc)) / a
    planes = -_dot(y, w) / _dot(v, w), -_dot(z, w) / _dot(v, w)
    zero = number(0.0)
    enter, leave = max(t1, min(planes), zero), min(t2, max(planes))
    return [(enter, leave)] if enter <= leave else []


def _dot(a: Sequence[Number], b: Sequence[Number]) -> Number:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Sequence[Number], b: Sequence[Number]) -> tuple[Number, Number, Number]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _sub(a: Sequence[Number], b: Sequence[Number]) -> tuple[Number, Number, Number]:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


COMMANDS: tuple[tuple[str, int], ...] = (
    ("--help", REPEATS),
    ("golden write --golden {folder}/golden", 1),
    ("certify reference --level stable --out {folder}/certificate.json", 1),
    ("certify oracle --level exact --out {folder}/certificate.json", 1),
)
"""The commands that are timed whole, and how often."""


def command(line: str, repeats: int) -> Timing:
    """Return the wall time of one command of raycert, start-up included."""
    seconds = []
    with tempfile.TemporaryDirectory() as folder:
        words = line.format(folder=Path(folder).as_posix()).split()
        for _ in range(repeats):
            began = time.perf_counter()
            subprocess.run(
                [sys.executable, "-m", "oracle.commands.main", *words],
                check=True,
                capture_output=True,
            )
            seconds.append(time.perf_counter() - began)
    return Timing("raycert " + line.partition(" --")[0], min(seconds), median(seconds))
