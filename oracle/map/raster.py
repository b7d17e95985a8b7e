"""What the cells of a map are: the case with some inputs moved, each to a number of the format.

Inputs are the numbers of a case, named by the paths that refusals use: `ray.origin[1]`,
`solid.radius`, `solid.of[1].center[2]`. A direction is a list `path=weight,...`; a path alone has
the weight 1.

In ulps an input moves along the grid of the format, number by number, through 0 and to the next
power of two as the grid goes; from 0 itself it moves in steps of 2^-precision, since the smallest
numbers tell nothing. In units and relatively it moves to the number nearest to the exact place.
Where both axes move an input, their moves add.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from fractions import Fraction
from functools import cached_property
from math import copysign, inf, ldexp
from typing import Any, Literal

from raycert.cases.formats import BINARY64, Format
from raycert.cases.forms import Json, read_ray, read_solid, write_ray, write_solid
from raycert.cases.model import Ray, Refused, Solid
from raycert.cases.numbers import Probe
from raycert.oracle.exact.surd import enclose, fraction

Unit = Literal["ulps", "units", "relative"]
UNITS: tuple[Unit, ...] = ("ulps", "units", "relative")
At = tuple[int, int]
"""The place of a cell, counted from the case in the middle: to the right, and up."""
STEP = re.compile(r"\.?([a-z_]+)|\[(\d+)\]")


@dataclass(frozen=True, slots=True)
class Direction:
    """A direction in the space of inputs: so much of each path."""

    terms: tuple[tuple[str, Fraction], ...]

    def __str__(self) -> str:
        """Return it as it is written, without the weight where that is 1 and alone."""
        if len(self.terms) == 1 and self.terms[0][1] == 1:
            return self.terms[0][0]
        words = ((path, w if w.denominator == 1 else float(w)) for path, w in self.terms)
        return ",".join(f"{path}={word}" for path, word in words)


Axes = tuple[Direction, Direction]


class Inputs:
    """A case as a form whose numbers can be replaced."""

    def __init__(self, solid: Solid, ray: Ray, fmt: Format = BINARY64) -> None:
        self.format = fmt
        self.form: Json = {"solid": write_solid(solid), "ray": write_ray(ray)}
        self._numbers = dict(_numbers(self.form, ""))

    @property
    def paths(self) -> tuple[str, ...]:
        return tuple(self._numbers)

    def __getitem__(self, path: str) -> float:
        """Return the input with a path. Raises `Refused` where there is none."""
        if path not in self._numbers:
            near = get_close_matches(path, self.paths, n=3, cutoff=0.5) or self.paths[:12]
            raise Refused(path, f"is no number of this case; there are {', '.join(near)}")
        return self._numbers[path]

    def direction(self, text: str) -> Direction:
        """Return the direction that a text spells. Raises `Refused` for what is none here."""
        terms: dict[str, Fraction] = {}
        for term in text.split(","):
            path, equals, word = (part.strip() for part in term.partition("="))
            self[path]
            if path in terms:
                raise Refused(path, "stands twice in one direction")
            try:
                terms[path] = Fraction(word) if equals else Fraction(1)
            except (ValueError, ZeroDivisionError):
                raise Refused(path, f"has a weight that is no number: {word!r:.40}") from None
            if not terms[path]:
                raise Refused(path, "has the weight 0")
        return Direction(tuple(terms.items()))

    def probe(self, values: Mapping[str, float]) -> Probe:
        """Return the case with other numbers at some paths. Raises `Refused` where it is none."""
        form: Any = self.form
        for path, value in values.items():
            keys = [int(i) if i else name for name, i in STEP.findall(path)]
            form = _replaced(form, keys, value)
        solid = read_solid(form["solid"], fmt=self.format)
        return Probe(solid, read_ray(form["ray"], fmt=self.format))


def _numbers(form: Any, path: str) -> Iterator[tuple[str, float]]:
    """Yield each number of a form with its path."""
    if isinstance(form, dict):
        for name, value in form.items():
            yield from _numbers(value, f"{path}.{name}" if path else name)
    elif isinstance(form, list):
        for i, value in enumerate(form):
            yield from _numbers(value, f"{path}[{i}]")
    elif not isinstance(form, str):
        yield path, form


def _replaced(form: Any, keys: list[str | int], value: float) -> Any:
    """Return a form with one number replaced; what it shares with the old one is not copied."""
    if not keys:
        return value
    new = form.copy()
    new[keys[0]] = _replaced(form[keys[0]], keys[1:], value)
    return new


@dataclass(frozen=True)
class Raster:
    """The cells: `half` of them on each side of the case, `step` apart, in both directions."""

    inputs: Inputs
    x: Direction
    y: Direction
    unit: Unit
    step: Fraction
    half: int

    @classmethod
    def of(cls, inputs: Inputs, axes: Axes, unit: Unit, span: Fraction, most: int) -> Raster:
        """Return the raster that reaches `span` on each side with about `most` cells on an axis.

        In ulps all steps are whole: where the span has more numbers than cells, every second or
        third, ..., number is a cell. Raises `Refused` for what cannot be moved so.
        """
        if span <= 0:
            raise Refused("span", "is not positive")
        if axes[0] == axes[1]:
            raise Refused("y", "is the same direction as x")
        if unit == "ulps" and span.denominator != 1:
            raise Refused("span", f"is not a whole number of ulps: {float(span)!r}")
        for path, weight in (*axes[0].terms, *axes[1].terms):
            if unit == "ulps" and weight.denominator != 1:
                raise Refused(path, "has a weight that is not whole; ulps are counted")
            if unit == "relative" and not inputs[path]:
                raise Refused(path, "is 0 and has no relative change; choose ulps or units")
        half = max(most // 2, 1)
        if unit == "ulps":
            step = max(-(-int(span) // half), 1)
            return cls(inputs, *axes, unit, Fraction(step), max(int(span) // step, 1))
        return cls(inputs, *axes, unit, span / half, half)

    @property
    def places(self) -> list[At]:
        """Return the places of all cells, from the middle outward in squares."""
        line = range(-self.half, self.half + 1)
        square = [(i, j) for j in line for i in line]
        return sorted(square, key=lambda at: (max(map(abs, at)), at[1], at[0]))

    @cached_property
    def paths(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(path for path, _ in (*self.x.terms, *self.y.terms)))

    def values(self, at: At) -> dict[str, float]:
        """Return the inputs of a cell that are moved; one beyond the format is infinite."""
        moves = dict.fromkeys(self.paths, Fraction(0))
        for direction, count in zip((self.x, self.y), at, strict=True):
            for path, weight in direction.terms:
                moves[path] += weight * count * self.step
        fmt = self.inputs.format
        return {path: moved(self.inputs[path], by, self.unit, fmt) for path, by in moves.items()}

    def probe(self, at: At) -> Probe:
        return self.inputs.probe(self.values(at))


def moved(x: float, by: Fraction, unit: Unit, fmt: Format) -> float:
    """Return a number of the format moved by so many ulps or units, or by a share of itself."""
    if unit == "ulps":
        return on_grid(x, int(by), fmt)
    exact = Fraction(x) + (by if unit == "units" else by * Fraction(x))
    return enclose(fraction(exact.numerator, exact.denominator), fmt).nearest


def on_grid(x: float, steps: int, fmt: Format) -> float:
    """Return the number so many places above x on the grid; infinite beyond its ends.

    >>> from raycert.cases.formats import BINARY64
    >>> on_grid(1.0, 1, BINARY64) == 1 + 2**-52, on_grid(1.0, -1, BINARY64) == 1 - 2**-53
    (True, True)
    """
    if not x:
        return ldexp(float(steps), -fmt.precision)
    size, last = (int(fmt.bits(number), 16) for number in (abs(x), inf))
    place = (size if x > 0 else -size) + steps
    return copysign(fmt.from_bits(f"{min(abs(place), last):0{fmt.digits}x}"), place)
