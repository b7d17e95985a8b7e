"""The inputs of a case: its numbers, named by the paths that refusals use, and directions of them.

A path reads `ray.origin[1]`, `solid.radius`, `solid.of[1].center[2]`. A direction is a list
`path=weight,...`; a path alone has the weight 1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from fractions import Fraction
from typing import Any

from raycert.cases.formats import BINARY64, Format
from raycert.cases.forms import Json, read_ray, read_solid, write_ray, write_solid
from raycert.cases.model import Ray, Refused, Solid

STEP = re.compile(r"\.?([a-z_]+)|\[(\d+)\]")
Keys = tuple[str | int, ...]
Case = tuple[Solid, Ray]


@dataclass(frozen=True, slots=True)
class Direction:
    """A direction in the space of inputs: so much of each path."""

    terms: tuple[tuple[str, Fraction], ...]

    def __str__(self) -> str:
        """Return it as it is written, without the weight where that is 1 and alone."""
        if len(self.terms) == 1 and self.terms[0][1] == 1:
            return self.terms[0][0]
        return ",".join(f"{path}={_spelled(weight)}" for path, weight in self.terms)


def _spelled(weight: Fraction) -> str:
    return str(weight) if weight.denominator == 1 else repr(float(weight))


class Inputs:
    """A case as a form whose numbers can be replaced."""

    def __init__(self, solid: Solid, ray: Ray, fmt: Format = BINARY64) -> None:
        """Take the case apart."""
        self.format = fmt
        self.form: Json = {"solid": write_solid(solid), "ray": write_ray(ray)}
        self._numbers = dict(_numbers(self.form, ""))

    @property
    def paths(self) -> tuple[str, ...]:
        """Return the paths of all inputs, those of the solid first."""
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

    def case(self, values: Mapping[str, float]) -> Case:
        """Return the case with other numbers at some paths. Raises `Refused` where it is none."""
        form: Any = self.form
        for path, value in values.items():
            form = _replaced(form, _keys(path), value)
        return (
            read_solid(form["solid"], fmt=self.format),
            read_ray(form["ray"], fmt=self.format),
        )


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


def _keys(path: str) -> Keys:
    return tuple(int(i) if i else name for name, i in STEP.findall(path))


def _replaced(form: Any, keys: Keys, value: float) -> Any:
    """Return a form with one number replaced; what it shares with the old one is not copied."""
    if not keys:
        return value
    new = form.copy()
    new[keys[0]] = _replaced(form[keys[0]], keys[1:], value)
    return new
