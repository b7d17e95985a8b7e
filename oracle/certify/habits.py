"""What an implementation does with degenerate inputs, in words: NaN for a direction of zero, ...

The certificate counts what is answered, refused and wrong (`degenerate` of each solid); this says
what the wrong and refused ones are, where most of them are alike.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from math import isnan

from raycert.cases.degenerate import DEGENERACIES, Degeneracy, degenerate
from raycert.oracle.certify.grading import Grade
from raycert.oracle.certify.verdict import by_solid
from raycert.oracle.judge.answer import First, Listed, YesNo

INPUTS: dict[Degeneracy, str] = {
    "zero_direction": "a direction of zero",
    "zero_radius": "a radius of zero",
    "flat_box": "a flat box",
}
MOST = 0.75
"""A part of the failures; what fewer of them do is no habit."""


def habits(grades: Sequence[Grade]) -> list[str]:
    """Return what is done to each kind of degenerate input, solids that are alike in one line."""
    said: dict[str, list[str]] = {}
    kinds = [degenerate(g.row.solid, g.row.ray) for g in grades]
    plain = by_solid(g for g, of in zip(grades, kinds, strict=True) if not of)
    usual = {group.name: Counter(map(_does, _failing(group.grades))) for group in plain}
    for kind in DEGENERACIES:
        for group in by_solid(g for g, of in zip(grades, kinds, strict=True) if kind in of):
            for habit in _habit(group.grades, usual.get(group.name, Counter())):
                said.setdefault(f"{INPUTS[kind]}: it {habit}", []).append(group.name)
    return [f"{', '.join(solids)} with {text}" for text, solids in said.items()]


def _failing(grades: Sequence[Grade]) -> list[Grade]:
    return [g for g in grades if g.fare("sound") != "right"]


def _habit(grades: Sequence[Grade], usual: Counter[str]) -> Iterator[str]:
    """Yield what most of the rows that fail have in common, and not with most others that fail."""
    failing = _failing(grades)
    if not failing:
        return
    [(does, times)] = Counter(map(_does, failing)).most_common(1)
    if times >= MOST * len(failing) and not 2 * usual[does] > usual.total():
        every = "always" if times == len(grades) else "mostly"
        aside = all(g.place == "degenerate" for g in grades)
        yield f"{every} {does}{' (part of no level: not declared)' if aside else ''}"


def _does(grade: Grade) -> str:
    said = grade.said
    if said is None:
        return f"ends in {grade.fault('sound') or 'no answer'}"
    numbers: list[float] = []
    if isinstance(said, Listed):
        numbers = [x for pair in said.pairs for x in pair]
    elif isinstance(said, First) and said.t is not None:
        numbers = [said.t]
    if any(map(isnan, numbers)):
        return "answers NaN"
    hit = said.hit if isinstance(said, YesNo) else bool(numbers)
    if hit == bool(grade.row.expected):
        return "answers other numbers than are right"
    return "answers a hit where there is none" if hit else "misses what it starts in"
