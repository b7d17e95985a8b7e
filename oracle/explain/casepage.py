"""One case as an HTML page that needs nothing else: pictures, answers, derivation.

What implementations said, and what a golden file says, is cleaned; the template escapes it besides.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from raycert.cases.levels import LEVELS
from raycert.oracle.explain.casepicture import NAME, Said, closeups, lists, wholes
from raycert.oracle.explain.casepicture import numbers as drawable
from raycert.oracle.explain.derive import Derivation
from raycert.oracle.explain.form import Fact, Note, Step, Table, numbers, shorten
from raycert.oracle.explain.one_case import Asked
from raycert.oracle.explain.text import case_lines
from raycert.oracle.judge.answer import First, YesNo
from raycert.oracle.reports.page import render
from raycert.oracle.reports.reading import clean, number

Json = dict[str, Any]
LONG = 4000
"""Characters of an exact number that a page holds; a power of two can have any number."""
ACCEPTED = "stable"
"""The level whose lists are drawn."""


def case_page(derivation: Derivation, answers: Sequence[Asked], repeat: str) -> str:
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


def _drawn(asked: Asked, name: str) -> Said:
    """Return an answer as it is drawn; a first hit is a list of one point."""
    grade = asked.grade
    if grade is None or grade.said is None:
        return Said(name, None, "no answer")
    match grade.said:
        case First(t):
            pairs = None if t is None else drawable(((t, t),))
            return Said(name, pairs, "no hit" if t is None else "no number", True)
        case YesNo(hit):
            return Said(name, None, f"hit: {str(hit).lower()}")
    return Said(name, drawable(grade.answer), "not numbers" if grade.answer else "no interval")


def _answer(asked: Asked, name: str, derivation: Derivation) -> Json:
    """Return an answer as a row of the table: its words, its errors, the levels it holds."""
    grade = asked.grade
    form: Json = {
        "label": clean(name, 30),
        "name": clean(asked.name, 60) if asked.name != asked.word else "",
        "reason": clean(asked.reason),
        "levels": [],
    }
    if grade is None:
        return form | {"said": "", "errors": []}
    match grade.said:
        case None:
            said = "no answer"
        case First(t):
            said = "first: " + ("null" if t is None else repr(t))
        case YesNo(hit):
            said = f"hit: {str(hit).lower()}"
        case _:
            said = numbers(grade.answer or (), derivation.format)
    errors = [number(x) for x in (grade.ulps, grade.strict, grade.squared)]
    failed = {**grade.faults, **grade.outside}
    levels = [
        ("failed" if level in failed else "passed", level in grade.row.decisive) for level in LEVELS
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
    """Return the end of the word that names an implementation: `trace` of `my.code:trace`."""
    return re.split(r"[:/]", word.strip().rstrip("/"))[-1]


def _step(step: Step) -> Json:
    return {"heading": clean(step.heading), "lines": [_line(line) for line in step.lines]}


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
