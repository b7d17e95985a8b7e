"""One case as an HTML page that needs nothing else: pictures, answers, derivation.

Each implementation is asked that case alone. What it answered, and what a golden file says, is
cleaned; the template escapes it besides. The pictures are two views, and a close look at each end,
where ticks are the numbers of the format: 0 is the one nearest to the exact end.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite, isnan
from typing import Any
from xml.etree.ElementTree import Element

from raycert.cases.accept import Accept, Numbers
from raycert.cases.formats import Format
from raycert.cases.levels import LEVELS
from raycert.cases.model import types
from raycert.cases.protocol import Hello
from raycert.cases.row import End, GoldenRow
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.client.dialogue import Limits, Question, Target, Unusable
from raycert.oracle.client.replay import greet, run
from raycert.oracle.explain.console import case_lines
from raycert.oracle.explain.derive import Derivation
from raycert.oracle.explain.wording import Fact, Note, Table, numbers, shorten
from raycert.oracle.judge.answer import First, YesNo
from raycert.oracle.reports import picture
from raycert.oracle.reports.foreign import clean
from raycert.oracle.reports.page import render
from raycert.oracle.reports.picture import GUTTER, PLOT, ROW, WIDTH, CaseLists, Lane, Pairs, Ruler
from raycert.oracle.reports.reading import number
from raycert.oracle.reports.section import Slice, View, views

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
        ran = run(target, [Question(row.id, row.solid, row.ray)], limits, hello=hello)
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
    said = [_drawn(one, name) for one, (name, _) in zip(answers, names, strict=True)]
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
        answers=[
            _answer(one, name, derivation) for one, (_, name) in zip(answers, names, strict=True)
        ],
        steps=[
            {"heading": clean(step.heading), "lines": [_line(line) for line in step.lines]}
            for step in derivation.steps
        ],
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
    graded, known_as = one.grade, clean(one.name, 60) if one.name != one.word else ""
    form: Json = {"label": clean(name, LABEL), "name": known_as, "reason": clean(one.reason)}
    if graded is None:
        return form | {"said": "", "errors": [], "levels": []}
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
    failed = {**graded.faults, **graded.beside}
    levels = [
        ("failed" if level in failed else "passed", level in graded.row.decisive)
        for level in LEVELS
    ]
    first = next((f"{level}: {failed[level]}" for level in LEVELS if level in failed), "")
    answer = {"said": clean(said, 400), "errors": errors, "levels": levels}
    return form | answer | {"reason": clean(first)}


def _names(words: Sequence[str]) -> list[tuple[str, str]]:
    """Return for each implementation a name beside its lines, and one in the table.

    The ends of the words, `trace` of `my.code:trace`, or where those are alike `code:trace`. What
    is alike or too long for a line has a number and what comes before the end, the number in both.
    """
    parts = [re.split("[:/]", word.strip().rstrip("/")) for word in words]
    tails = [clean(part[-1], LABEL) for part in parts]
    paths = [part[-2] if len(part) > 1 else part[0] for part in parts]
    owners = [path.rpartition(".")[2] or path for path in paths]
    wholes = [":".join(dict.fromkeys(pair)) for pair in zip(owners, tails, strict=True)]
    for names in (tails, wholes):
        if len({clean(name, NAME) for name in names}) == len(names):
            return [(clean(name, NAME), clean(name, LABEL)) for name in names]
    short = owners if len(set(owners)) == len(owners) else paths
    told = enumerate(zip(short, words, strict=True), 1)
    return [(clean(f"{i} {one}", NAME), clean(f"{i} {word}", LABEL)) for i, (one, word) in told]


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


ENDS = 8
"""At how many ends there is a close look."""
NAME, LABEL = 10, 30
"""Characters of a name that fit beside a line, and in a table."""
NARROW, WIDE = Fraction(5, 2), 60
"""Ulps to either side of an end: at least, and at most to have the ends of answers in."""
USUAL = 900
"""Powers of two up to this are written as numbers on a scale."""
Drawn = list[tuple[str, str]]
"""Captions, each with its drawing."""


@dataclass(frozen=True, slots=True)
class AnswerLine:
    """An answer to draw: a name, and its list, or what is said in place of one."""

    name: str
    pairs: Pairs | None
    silence: str = ""
    point: bool = False
    """Whether it is a first hit: a list of one point."""

    @property
    def lane(self) -> Lane:
        silence = "" if self.pairs else clean(self.silence, 44)
        return Lane(clean(self.name, NAME), ((self.pairs or (), "said"),), silence)


def drawable(pairs: Numbers | None) -> Pairs | None:
    """Return a list to draw; None where it has a NaN, or is none."""
    if pairs is None or any(isnan(x) for pair in pairs for x in pair):
        return None
    exact = [[Fraction(x) if isfinite(x) else x for x in pair] for pair in pairs]
    return tuple((a, b) for a, b in exact)


def lists(row: GoldenRow, accept: Accept) -> CaseLists:
    exact = tuple((_end(span.enter), _end(span.leave)) for span in row.intervals)
    return CaseLists(exact, drawable(accept.inner) or (), drawable(accept.outer) or (), None)


def _end(end: End) -> Fraction | float:
    return float("inf") if end.digits == "inf" else Fraction(end.digits)


def wholes(row: GoldenRow, all_lists: CaseLists, said: Sequence[AnswerLine]) -> Drawn:
    """Return the views of a case; under the first of them are the intervals over t."""
    found = views(row.solid, row.ray, all_lists.finite(all_lists.exact))
    shown = (*picture.known(all_lists), *(one.lane for one in said))
    first = _view(found[0] if found else None, all_lists, shown)
    return [first, *(_view(view, all_lists, ()) for view in found[1:])]


def _view(view: View | None, all_lists: CaseLists, shown: Sequence[Lane]) -> tuple[str, str]:
    """Return a view with the lines shown below it, on one scale of t; without a view the lines."""
    still = view is not None and view.still
    axis = picture.whole(all_lists) if view is None or still else picture.axis_of(view.section)
    top = 4.0 if view is None else picture.TALL + picture.GAP * bool(shown)
    parts: list[Element] = []
    if view is not None:
        parts += picture.drawn(view.section, picture.axis_of(view.section), still)
    if view is not None and not still:
        parts += picture.guides(all_lists.finite(all_lists.exact), axis, top + ROW * bool(shown))
        parts += _inside(view.section, axis, all_lists.exact)
    name = "The intervals" if view is None else view.name
    if still and not shown:
        return name, picture.drawing(picture.TALL + 4, name, *parts)
    foot = top + len(shown) * ROW
    scale, offset = _scale(axis, foot)
    caption = f"{name}, over t{offset}" if shown or offset else name
    parts += [*picture.lanes(shown, axis, top), *scale]
    return caption, picture.drawing(foot + 20, caption, *parts)


def _scale(axis: Ruler, foot: float) -> tuple[list[Element], str]:
    """Return the scale of t, and what a caption says of it: an offset, or a far power of ten."""
    span = axis.unit * PLOT
    bits = span.numerator.bit_length() - span.denominator.bit_length()
    if abs(bits) > USUAL or abs(axis.middle) > 2**USUAL:
        power = bits * 3 // 10
        name = f"t / 1e{power}"
        scale = list(picture.ticks(axis, Fraction(0), Fraction(10) ** power, foot))
        return [*scale, picture.label(0, foot + 16, name, "name")], f" / 1e{power}"
    base = picture.base_of(axis)
    scale = [*picture.ticks(axis, base, Fraction(1), foot)]
    scale.append(picture.label(0, foot + 16, "t - c" if base else "t", "name"))
    return scale, f" - c, c = {float(base):.17g}" if base else ""


def _inside(scene: Slice, axis: Ruler, exact: Pairs) -> Iterator[Element]:
    y = picture.ray_height(scene)
    for enter, leave in exact:
        a, b = (max(GUTTER, min(axis.x(t), WIDTH)) for t in (enter, leave))
        if b - a >= 1:
            yield picture.el("line", x1=a, x2=b, y1=y, y2=y, kind="inside")
        elif axis.shows(enter):
            yield picture.el("circle", cx=a, cy=y, r=4, kind="exact")


def closeups(
    row: GoldenRow, all_lists: CaseLists, said: Sequence[AnswerLine], fmt: Format
) -> Drawn:
    """Return a close look at each exact end but 0 and infinity, up to `ENDS` of them.

    An end that is on the one before is not looked at again.
    """
    found: Drawn = []
    last: Fraction | None = None
    shown = (*picture.known(all_lists), *(one.lane for one in said))
    for i, span in enumerate(row.intervals):
        for side, end in enumerate((span.enter, span.leave)):
            t = _end(end)
            if not isinstance(t, Fraction) or not t or not isfinite(end.nearest):
                continue
            same = last is not None and abs(t - last) < 2 * picture.ulp(t, fmt)
            if same or len(found) == ENDS:
                continue
            last = t
            offs = [_off(one, end, (i, side), all_lists, fmt) for one in said]
            found.append(_close(end, ("enter", "leave")[side], shown, offs, fmt))
    return found


def _close(
    end: End, name: str, shown: Sequence[Lane], offs: Sequence[Fraction | None], fmt: Format
) -> tuple[str, str]:
    origin = Fraction(end.nearest)
    unit = picture.ulp(origin, fmt)
    reach = max([NARROW, *(abs(off) for off in offs if off is not None and abs(off) <= WIDE)])
    axis = Ruler(origin, reach * unit * Fraction(26, 10) / Fraction(PLOT))
    top, foot = 4.0, 4.0 + len(shown) * ROW
    parts = [*_numbers(axis, origin, unit, foot), *picture.lanes(shown, axis, top)]
    parts += picture.ticks(axis, origin, unit, foot)
    parts.append(picture.label(0, foot + 16, "ulps", "name"))
    for i, off in enumerate(offs, 2):
        if off is not None and not axis.shows(origin + off * unit):
            parts.append(picture.pointer(off, top + i * ROW))
    caption = f"{name} at t = {end.nearest!r}, in ulps of {float(unit):.2g}"
    return caption, picture.drawing(foot + 20, caption, *parts)


def _off(
    one: AnswerLine, end: End, place: tuple[int, int], all_lists: CaseLists, fmt: Format
) -> Fraction | None:
    """Return how far an answer's end is from the number at an exact one, in ulps.

    The same end where the lists are as long, else the nearest. None where it has none that is
    finite, and for a first hit that is not near.
    """
    origin = Fraction(end.nearest)
    ends = all_lists.finite(one.pairs)
    if not one.point and len(one.pairs or ()) == len(all_lists.exact):
        same = (one.pairs or ())[place[0]][place[1]]
        ends = [same] if isinstance(same, Fraction) else []
    off = min(((x - origin) / picture.ulp(origin, fmt) for x in ends), key=abs, default=None)
    return None if off is None or (one.point and abs(off) > WIDE) else off


def _numbers(axis: Ruler, origin: Fraction, unit: Fraction, foot: float) -> Iterator[Element]:
    """Yield a line for each number, as long as they are apart."""
    count = int(PLOT * axis.unit / unit / 2)
    if count > WIDE // 2:
        return
    for n in range(-count, count + 1):
        x = axis.x(origin + n * unit)
        yield picture.el("line", x1=x, x2=x, y1=0, y2=foot, kind="unit")
