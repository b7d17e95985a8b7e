"""The derivation of one case with this case's numbers, as data; and a golden row as it stands.

A leaf goes through its vectors, Problem 1, Problem 2 and Problem 3 (leaf_steps); a tree through
each leaf by path and then through the algebra of lists. Then come the exact endpoints in every
form, and how answers measure there. Everything is computed anew; nothing is taken from a file. Only
`row_passages` says what a row of a file holds, with nothing computed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import isinf, log2
from typing import Any

from raycert.cases.accept import Pairs
from raycert.cases.case import Case, Family
from raycert.cases.flags import FLAGS
from raycert.cases.formats import Format
from raycert.cases.lattice import is_lattice
from raycert.cases.levels import LEVELS
from raycert.cases.model import Difference, Intersection, Ray, Solid, Tree, Union, leaves, type_of
from raycert.cases.row import End, GoldenRow, write_row
from raycert.oracle.corpus.golden import golden_row
from raycert.oracle.exact.condition import kappa
from raycert.oracle.exact.grid import Grid
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.rounding import decimal
from raycert.oracle.exact.surd import Surd
from raycert.oracle.exact.trace import combine, solve_leaf
from raycert.oracle.explain.leaf_steps import leaf_steps
from raycert.oracle.explain.wording import (
    Fact,
    Note,
    Passage,
    accepting,
    as_json,
    brief,
    enclosing,
    endpoint,
    listed,
    numbers,
    tidy,
)
from raycert.oracle.judge.levels import Judge
from raycert.oracle.zoo.textbook import textbook

POWERS = ("", " t", " t^2")


@dataclass(frozen=True, slots=True)
class Derivation:
    """A case as its golden row is or would be, and the passages that lead to it."""

    row: GoldenRow
    format: Format
    steps: tuple[Passage, ...]


def derive(case: Case, fmt: Format, family: str = "given") -> Derivation:
    row = golden_row(Family(family, "", lambda _: ()), case, fmt)
    judge = Judge(case.solid, case.ray, fmt, case.tier)
    answers = (*_answers(row, judge), judgement(row, judge))
    return Derivation(row, fmt, (*solid_steps(case.solid, case.ray), *answers))


def given(solid: Solid, ray: Ray) -> Case:
    """Return the case of a solid and a ray that come from no family."""
    return Case(type_of(solid), "", solid, ray, "lattice" if is_lattice(solid, ray) else "generic")


def as_given(row: GoldenRow) -> Case:
    slug = row.id.partition("/")[2]
    return Case(slug, row.why, row.solid, row.ray, row.tier, row.flags, row.source)


def to_json(derivation: Derivation) -> dict[str, Any]:
    """Return the derivation as a JSON object: the whole golden row, and the steps."""
    steps = [as_json(passage) for passage in derivation.steps]
    return {"row": write_row(derivation.row, derivation.format), "steps": steps}


def solid_steps(solid: Solid, ray: Ray) -> Iterator[Passage]:
    if not isinstance(solid, Tree):
        yield from leaf_steps(solid, ray)
        return
    for path, leaf in leaves(solid):
        for passage in leaf_steps(leaf, ray):
            yield replace(passage, heading=f"{path} ({type_of(leaf)}): {passage.heading}")
    facts: list[Fact | Note] = []
    _lists(solid, Grid.of(solid, ray), "", facts)
    yield Passage("The lists of the tree, from the leaves up", tuple(facts))


def _lists(solid: Solid, grid: Grid, path: str, facts: list[Fact | Note]) -> Intervals:
    """Return the list of a node, after adding a fact for each node below it and for itself."""
    if not isinstance(solid, Tree):
        found = solve_leaf(solid, grid, path, [])
        facts.append(Fact(path, listed(found), note=type_of(solid)))
        return found
    paths = [f"{path}.of[{i}]" if path else f"of[{i}]" for i in range(len(solid.of))]
    lists = [_lists(part, grid, at, facts) for part, at in zip(solid.of, paths, strict=True)]
    found = combine(solid, lists)
    facts.append(Fact(path or "the solid", listed(found), note=_words(solid, paths)))
    return found


def _words(tree: Union | Intersection | Difference, paths: list[str]) -> str:
    match tree:
        case Union():
            return f"{' or '.join(paths)}"
        case Intersection():
            return f"{' and '.join(paths)}"
        case Difference():
            rest = f", less {' and '.join(paths[1:])}" if paths[1:] else ""
            return f"{paths[0]}{rest}"


def _answers(row: GoldenRow, judge: Judge) -> Iterator[Passage]:
    """Yield a passage for each endpoint of the exact list; one sentence where there is none."""
    if not row.intervals:
        yield Passage("Answer: no pair", (Note("The ray is never in the solid."),))
    for i, (span, interval) in enumerate(zip(row.intervals, judge.exact, strict=True), 1):
        count = f"Answer {i} of {len(row.intervals)}" if len(row.intervals) > 1 else "Answer"
        pair = numbers([(span.enter.nearest, span.leave.nearest)], judge.format)
        touch = f", a touch ({span.touch})" if span.touch else ""
        ends = [("enter", span.enter, interval[0]), ("leave", span.leave, interval[1])]
        if interval[0] == interval[1]:
            ends = [("t", span.enter, interval[0])]
        lines = [fact for end in ends for fact in end_facts(*end, judge)]
        yield Passage(f"{count}: {pair}{touch}", tuple(lines))


def end_facts(name: str, end: End, t: Surd, judge: Judge) -> tuple[Fact, ...]:
    """Return one endpoint: exactly, in digits and numbers, where it lies, and its condition."""
    faces = ", ".join(end.faces) or "no face"
    place = Fact("  on", faces, note=end.kind)
    if not t.finite:
        return (Fact(name, "inf", note="the ray never leaves"),)
    exact = Fact(name, endpoint(t))
    if t.sign() == 0:
        return (exact, place)
    digits = () if t.rational() and len(exact.value) < 12 else (Fact("  digits", tidy(end.digits)),)
    return (
        exact,
        *digits,
        *enclosing(end.down, end.up, end.nearest, judge.format),
        place,
        _condition(t, judge),
    )


def _condition(t: Surd, judge: Judge) -> Fact:
    size = kappa(t, judge.solid, judge.ray)
    if not size.finite:
        return Fact("  condition", "infinite", note="a double root: an error e moves it by sqrt(e)")
    if not size.sign():
        return Fact("  condition", "0", note="no input moves it")
    return Fact("  condition", brief(size, 7), note=f"2^{_log2(size):.1f}")


def _log2(v: Surd) -> float:
    """Return log2 of a number > 0 of any size, for people."""
    digits, _, power = decimal(v, 17).partition("e")
    return log2(float(digits)) + int(power) * log2(10)


def judgement(row: GoldenRow, judge: Judge) -> Passage:
    """Return what is measured here: two answers, the levels decided, the lists that accept."""
    return Passage(
        "Measured",
        (
            *_measured("rounded", judge.expected, judge, "each exact end to nearest"),
            *_measured("textbook", textbook(judge.solid, judge.ray, judge.format), judge),
            Fact("decisive for", ", ".join(row.decisive) or "no level"),
            *accepting("sound", row.accept["sound"], judge.format),
            *accepting("stable", row.accept["stable"], judge.format),
        ),
    )


def _measured(name: str, answer: Pairs, judge: Judge, note: str = "") -> Iterator[Fact]:
    """Yield an answer, its forward and backward errors, and the levels it holds here."""
    yield Fact(name, numbers(answer, judge.format), note=note)
    wrong = judge.malformed(answer)
    if wrong:
        yield Fact("", f"not well-formed: {wrong}")
        return
    forward = judge.forward_error(answer)
    error = "another number of pairs" if len(answer) != len(judge.expected) else _ulps(forward)
    k = [_k(judge.backward_error(answer, measure)) for measure in ("strict", "squared")]
    yield Fact("", f"error {error}; backward error k {k[0]} strict, {k[1]} squared")
    held = [level for level in LEVELS if judge.holds(level, answer)]
    yield Fact("", f"holds {', '.join(held)}" if held else "holds no level")


def _ulps(error: float) -> str:
    return "infinite" if isinf(error) else f"{error:.3g} ulps"


def _k(k: float) -> str:
    if isinf(k):
        return "infinite"
    return "1/16" if k <= 1 / 16 else f"{k:.2g}"


def row_passages(row: GoldenRow, fmt: Format) -> Iterator[Passage]:
    """Yield the parts of a row: what it is, each exact endpoint, the lists."""
    yield Passage("Row", tuple(_row_facts(row)))
    for i, span in enumerate(row.intervals, 1):
        touch = f", a touch ({span.touch})" if span.touch else ""
        enter, leave = _stored("enter", span.enter, fmt), _stored("leave", span.leave, fmt)
        yield Passage(f"Exact interval {i} of {len(row.intervals)}{touch}", (*enter, *leave))
    lists = [fact for level in row.accept for fact in accepting(level, row.accept[level], fmt)]
    yield Passage("Lists", (Fact("expected", numbers(row.expected, fmt)), *lists))


def _row_facts(row: GoldenRow) -> Iterator[Fact]:
    yield Fact("rows", " ".join(row.rows))
    size = "infinite, or t = 0 only" if row.condition is None else f"<= 2^{row.condition}"
    yield Fact("condition", size)
    yield Fact("decisive for", ", ".join(row.decisive) or "no level")
    for name in row.flags:
        yield Fact(f"flag {name}", FLAGS[name].trouble if name in FLAGS else "not in the legend")


def _stored(name: str, end: End, fmt: Format) -> Iterator[Fact]:
    if end.polynomial is None and end.fraction is None:
        yield Fact(name, "inf")
        return
    yield Fact(name, _exactly(end))
    yield Fact("  digits", tidy(end.digits))
    yield from enclosing(end.down, end.up, end.nearest, fmt)
    yield Fact("  on", ", ".join(end.faces) or "no face", note=end.kind)


def _exactly(end: End) -> str:
    """Return an endpoint as the row has it: a fraction, or which root of a polynomial."""
    if end.fraction:
        top, bottom = end.fraction
        return str(top) if bottom == 1 else f"{top}/{bottom}"
    coefficients = end.polynomial or ()
    degree = len(coefficients) - 1
    terms = [
        f"{'-' if c < 0 else '+'} {'' if abs(c) == 1 and degree - i else abs(c)}"
        f"{POWERS[degree - i] if abs(c) != 1 else POWERS[degree - i].strip()}"
        for i, c in enumerate(coefficients)
        if c
    ]
    which = "larger" if end.root else "smaller"
    return f"the {which} root of {' '.join(terms).removeprefix('+ ')}"
