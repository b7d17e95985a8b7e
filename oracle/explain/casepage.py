"""One case as an HTML page that needs nothing else: pictures, answers, derivation.

Each implementation is asked that case alone. What it answered, and what a golden file says, is
cleaned; the template escapes it besides.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from raycert.cases.levels import LEVELS
from raycert.cases.model import types
from raycert.cases.protocol import Hello
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.client.dialogue import Limits, Question, Target, Unusable
from raycert.oracle.client.replay import greet, run
from raycert.oracle.explain.casepicture import NAME, AnswerLine, closeups, lists, wholes
from raycert.oracle.explain.casepicture import numbers as drawable
from raycert.oracle.explain.console import case_lines
from raycert.oracle.explain.derive import Derivation
from raycert.oracle.explain.wording import Fact, Note, Passage, Table, numbers, shorten
from raycert.oracle.judge.answer import First, YesNo
from raycert.oracle.reports.page import render
from raycert.oracle.reports.reading import clean, number

Json = dict[str, Any]
LONG = 4000
"""Characters of an exact number that a page holds; a power of two can have any number."""
ACCEPTED = "stable"
"""The level whose lists are drawn."""


@dataclass(frozen=True, slots=True)
class Response:
    """What an implementation answers to one case: None as `grade` if not asked, for the `reason`.

    `word` is what the person called it, `name` what it calls itself.
    """

    word: str
    name: str
    grade: Grade | None
    reason: str = ""


def ask(word: str, target: Sequence[str] | Target, row: GoldenRow, precision: str) -> Response:
    """Return the graded answer of an implementation that is asked this case alone.

    One that cannot be run, or does not take the case, is no error: the reason stands in place of
    its answer.
    """
    limits = Limits()
    try:
        hello = greet(target, limits)
        name = f"{hello.name} {hello.version}".strip() or word
        if reason := _unasked(row, hello, precision):
            return Response(word, name, None, reason)
        ran = run(target, [Question(row.id, row.solid, row.ray)], limits)
    except Unusable as error:
        return Response(word, word, None, f"could not be run: {error}")
    return Response(word, name, grade(row, ran.outcomes[row.id], ran.hello))


def _unasked(row: GoldenRow, hello: Hello, precision: str) -> str:
    if hello.precision != precision:
        return f"not asked: it computes in {hello.precision}; see: --precision {hello.precision}"
    missing = sorted(types(row.solid) - set(hello.solids))
    return f"not asked: it does not declare {', '.join(missing)}" if missing else ""


def case_page(derivation: Derivation, answers: Sequence[Response], repeat: str) -> str:
    """Return the page of a case and of the answers to it; `repeat` is the command that makes it."""
    row, fmt = derivation.row, derivation.format
    names = _names([one.word for one in answers])
    said = [_drawn(one, name) for one, name in zip(answers, names, strict=True)]
    exact = lists(row, row.accept[ACCEPTED])
    lines = [line.plain.rstrip() for line in case_lines(row, fmt, 10**9)]
    return render(
        "casepage.html",
        ("page.css", "casepage.css"),
        {"clean": clean},
        id=clean(row.id if row.why else row.id.rpartition("/")[2].replace("_", " ")),
        why=clean(row.why),
        facts=[row.tier, fmt.name, *((f"source {clean(row.source)}",) if row.why else ())],
        flags=[clean(flag) for flag in row.flags],
        inputs=[clean(line, LONG) for line in (lines[4:] if row.why else lines)],
        rows=[clean(name) for name in row.rows],
        exact=numbers(row.expected, fmt),
        level=ACCEPTED,
        levels=LEVELS,
        decisive=row.decisive,
        wholes=wholes(row, exact, said),
        closeups=closeups(row, exact, said, fmt),
        answers=[_answer(*named, derivation) for named in zip(answers, names, strict=True)],
        steps=[_step(step) for step in derivation.steps],
        repeat=clean(repeat, LONG),
    )


def _drawn(one: Response, name: str) -> AnswerLine:
    graded = one.grade
    if graded is None or graded.said is None:
        return AnswerLine(name, None, "no answer")
    match graded.said:
        case First(t):
            pairs = None if t is None else drawable(((t, t),))
            return AnswerLine(name, pairs, "no hit" if t is None else "no number", True)
        case YesNo(hit):
            return AnswerLine(name, None, f"hit: {str(hit).lower()}")
    return AnswerLine(
        name, drawable(graded.answer), "not numbers" if graded.answer else "no interval"
    )


def _answer(one: Response, name: str, derivation: Derivation) -> Json:
    """Return an answer as a row of the table: its words, its errors, the levels it holds."""
    graded = one.grade
    form: Json = {
        "label": clean(name, 30),
        "name": clean(one.name, 60) if one.name != one.word else "",
        "reason": clean(one.reason),
        "levels": [],
    }
    if graded is None:
        return form | {"said": "", "errors": []}
    match graded.said:
        case None:
            said = "no answer"
        case First(t):
            said = "first: " + ("null" if t is None else repr(t))
        case YesNo(hit):
            said = f"hit: {str(hit).lower()}"
        case _:
            said = numbers(graded.answer or (), derivation.format)
    errors = [number(x) for x in (graded.ulps, graded.strict, graded.squared)]
    failed = {**graded.faults, **graded.outside}
    levels = [
        ("failed" if level in failed else "passed", level in graded.row.decisive)
        for level in LEVELS
    ]
    first = next((f"{level}: {failed[level]}" for level in LEVELS if level in failed), "")
    return form | {
        "said": clean(said, 400),
        "errors": errors,
        "levels": levels,
        "reason": clean(first),
    }


def _names(words: Sequence[str]) -> list[str]:
    """Return short names of implementations, numbered where they look the same beside a line."""
    tails = [_tail(word) for word in words]
    if len({clean(tail, NAME) for tail in tails}) == len(tails):
        return tails
    return [f"{i} {tail}" for i, tail in enumerate(tails, 1)]


def _tail(word: str) -> str:
    return re.split(r"[:/]", word.strip().rstrip("/"))[-1]


def _step(passage: Passage) -> Json:
    return {"heading": clean(passage.heading), "lines": [_line(line) for line in passage.lines]}


def _line(line: Fact | Table | Note) -> Json:
    match line:
        case Note():
            return {"form": "note", "text": clean(line.text, LONG)}
        case Table():
            return {"form": "table", "table": line}
    value = clean(shorten(line.value), LONG)
    return {
        "form": "fact",
        "name": clean(line.name),
        "sign": line.sign,
        "value": value,
        "full": "" if value == line.value else clean(line.value, LONG),
        "about": clean(line.about),
        "note": clean(line.note),
    }
