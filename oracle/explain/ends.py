"""The end of a derivation: the exact endpoints in every form, and how answers measure there."""

from __future__ import annotations

from collections.abc import Iterator
from math import isinf, log2

from raycert.cases.accept import Accept, Pairs
from raycert.cases.formats import Format
from raycert.cases.levels import LEVELS
from raycert.cases.row import End, GoldenRow
from raycert.oracle.exact.condition import kappa
from raycert.oracle.exact.rounding import decimal
from raycert.oracle.exact.surd import Surd
from raycert.oracle.explain.form import Fact, Note, Step, brief, endpoint, numbers, shortest, tidy
from raycert.oracle.judge.levels import Judge
from raycert.oracle.zoo.textbook import textbook


def answer_steps(row: GoldenRow, judge: Judge) -> Iterator[Step]:
    """Yield a step for each endpoint of the exact list; one sentence where there is none."""
    if not row.intervals:
        yield Step("Answer: no pair", (Note("The ray is never in the solid."),))
    for i, (span, interval) in enumerate(zip(row.intervals, judge.exact, strict=True), 1):
        count = f"Answer {i} of {len(row.intervals)}" if len(row.intervals) > 1 else "Answer"
        pair = f"{count}: [{_number(span.enter, judge)}, {_number(span.leave, judge)}]"
        touch = f", a touch ({span.touch})" if span.touch else ""
        if interval[0] == interval[1]:
            lines = end_facts("t", span.enter, interval[0], judge)
        else:
            lines = (
                *end_facts("enter", span.enter, interval[0], judge),
                *end_facts("leave", span.leave, interval[1], judge),
            )
        yield Step(pair + touch, lines)


def _number(end: End, judge: Judge) -> str:
    return shortest(end.nearest, judge.format)


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
    return (exact, *digits, *_neighbours(end, judge.format), place, _condition(t, judge))


def _neighbours(end: End, fmt: Format) -> Iterator[Fact]:
    """Yield the numbers below and above, or the one that the endpoint is."""
    if end.down == end.up:
        yield Fact("  number", shortest(end.down, fmt), note=f"{end.down.hex()} exactly")
        return
    for name, x in (("  down", end.down), ("  up", end.up)):
        nearest = " nearest" if x == end.nearest else ""
        yield Fact(name, shortest(x, fmt), note=x.hex() + nearest)


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


def judgement(row: GoldenRow, judge: Judge) -> Step:
    """Return what is measured here: two answers, the levels decided, the lists that accept."""
    return Step(
        "Measured",
        (
            *_measured("rounded", judge.expected, judge, "each exact end to nearest"),
            *_measured("textbook", textbook(judge.solid, judge.ray, judge.format), judge),
            Fact("decisive for", ", ".join(row.decisive) or "no level"),
            *_accepted("sound", row.accept["sound"], judge.format),
            *_accepted("stable", row.accept["stable"], judge.format),
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


def _accepted(level: str, accept: Accept, fmt: Format) -> Iterator[Fact]:
    yield Fact(f"{level} inner", numbers(accept.inner, fmt), note="each lies in a pair")
    most = ", ".join(map(str, accept.most))
    pairs = f"at most {most} {'pair' if most == '1' else 'pairs'}" if most else "no pair"
    yield Fact(f"{level} outer", numbers(accept.outer, fmt), note=pairs)
