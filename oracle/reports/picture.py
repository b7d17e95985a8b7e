"""The pictures of one case: ray and solid over the intervals in t, and a close look in ulps.

Intervals are drawn over a line of t, exact to the pixel: what is accepted, what is exact, what was
said. Two scales: the whole of it, and close to the end that is farthest off, in ulps, where the
difference is too small to see. Numbers are fractions until they are pixels.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor, frexp, inf, isfinite, log10
from xml.etree.ElementTree import Element, tostring

from raycert.cases.formats import FORMATS, Format
from raycert.cases.forms import read_ray, read_solid
from raycert.cases.model import Refused
from raycert.oracle.reports.foreign import clean
from raycert.oracle.reports.reading import Json
from raycert.oracle.reports.section import ASPECT, Slice, section

WIDTH, GUTTER = 480, 84
"""Width of a drawing, and of the column at its left that names the lines."""
PLOT = WIDTH - GUTTER
MIDDLE = GUTTER + PLOT / 2


def el(tag: str, *children: Element, text: str | None = None, **attributes: str | float) -> Element:
    """Return an element; `_` in the name of an attribute is `-`, and `kind` is its class."""
    names = {name: "class" if name == "kind" else name.replace("_", "-") for name in attributes}
    element = Element(tag, {names[name]: spelled(x) for name, x in attributes.items()})
    element.text = text
    element.extend(children)
    return element


def spelled(x: str | float) -> str:
    """Return an attribute's value; a number to a tenth of a pixel."""
    return x if isinstance(x, str) else f"{x:.1f}".removesuffix(".0")


def path(points: Iterable[tuple[float, float]], closed: bool = False) -> str:
    steps = " ".join(f"{spelled(x)},{spelled(y)}" for x, y in points)
    return f"M{steps}{'Z' if closed else ''}"


def drawing(height: float, title: str, *children: Element) -> str:
    """Return a drawing of the common width, as text for a page; `title` is read aloud."""
    box = f"0 0 {WIDTH} {spelled(height)}"
    named = el("title", text=title)
    return tostring(el("svg", named, *children, viewBox=box, role="img"), encoding="unicode")


def label(x: float, y: float, text: str, kind: str = "label", anchor: str = "start") -> Element:
    return el("text", text=text, x=x, y=y, kind=kind, text_anchor=anchor)


Number = Fraction | float
Pairs = tuple[tuple[Number, Number], ...]
ROW, BAR = 20, 10


@dataclass(frozen=True, slots=True)
class CaseLists:
    """The lists of a case: numbers are fractions, or infinite. `said` is None without a list."""

    exact: Pairs
    inner: Pairs
    outer: Pairs
    said: Pairs | None
    point: bool = False
    """Whether what was said is a first hit: a list of one point."""

    @classmethod
    def of(cls, shown: Json) -> CaseLists:
        """Read the lists of one of the worst cases; a first hit is a list of one point."""
        accept, answer = shown["accept"], shown["answer"]
        first = (shown["reply"] or {}).get("first")
        if first is not None:
            answer = [[first, first]]
        exact = [(_read(s["enter"]["digits"]), _read(s["leave"]["digits"])) for s in shown["exact"]]
        lists = (tuple(exact), _pairs(accept["inner"]), _pairs(accept["outer"]), _said(answer))
        return cls(*lists, point=first is not None)

    def finite(self, pairs: Pairs | None) -> list[Fraction]:
        return [x for pair in pairs or () for x in pair if isinstance(x, Fraction)]


def _said(pairs: Sequence[Sequence[str]] | None) -> Pairs | None:
    """Return an answer that can be drawn: a list without NaN."""
    read = None if pairs is None else _pairs(pairs)
    return None if read is None or any(x != x for pair in read for x in pair) else read


def _pairs(pairs: Sequence[Sequence[str]]) -> Pairs:
    return tuple((hexed(a), hexed(b)) for a, b in pairs)


def hexed(text: str) -> Number:
    x = float.fromhex(text)
    return Fraction(x) if isfinite(x) else x


def _read(digits: str) -> Number:
    return inf if digits == "inf" else Fraction(digits)


@dataclass(frozen=True, slots=True)
class Ruler:
    """Where a t is on a drawing: `middle` is in the middle, `unit` of t is a pixel."""

    middle: Fraction
    unit: Fraction

    def x(self, t: Number) -> float:
        """Return the pixel of t, at most a little off the drawing."""
        low, high = GUTTER - 8.0, WIDTH + 8.0
        if not isinstance(t, Fraction):
            return high if t > 0 else low
        away = (t - self.middle) / self.unit
        x = MIDDLE + float(max(Fraction(-WIDTH), min(away, Fraction(WIDTH))))
        return max(low, min(x, high))

    def shows(self, t: Number) -> bool:
        return GUTTER <= self.x(t) <= WIDTH


def whole(lists: CaseLists) -> Ruler:
    """Return an axis that shows every list from end to end."""
    ends = lists.finite(lists.exact) or lists.finite(lists.said) or [Fraction(0)]
    low, high = min(ends), max(ends)
    span = high - low or abs(high) or Fraction(1)
    return Ruler((low + high) / 2, 2 * span / Fraction(PLOT))


@dataclass(frozen=True, slots=True)
class Lane:
    """A line of a drawing: its name, lists each with its kind, what is said where none is seen."""

    name: str
    lists: tuple[tuple[Pairs, str], ...]
    silence: str = ""


def bars(lists: CaseLists, axis: Ruler, top: float, silence: str) -> Iterator[Element]:
    """Yield the three lines: accepted, exact, answered. `silence` is said where there is no bar."""
    answered = Lane("answered", ((lists.said or (), "said"),), silence)
    yield from lanes((*known(lists), answered), axis, top)


def known(lists: CaseLists) -> tuple[Lane, Lane]:
    """Return the lines of what is accepted and of what is exact."""
    accepted = Lane("accepted", ((lists.outer, "outer"), (lists.inner, "inner")))
    return accepted, Lane("exact", ((lists.exact, "exact"),))


def lanes(drawn: Iterable[Lane], axis: Ruler, top: float) -> Iterator[Element]:
    """Yield lines, one below the other."""
    for i, lane in enumerate(drawn):
        y = top + ROW * i
        yield label(0, y + BAR - 1, lane.name, "name")
        yield el("line", x1=GUTTER, x2=WIDTH, y1=y + BAR / 2, y2=y + BAR / 2, kind="rail")
        seen = [bar for pairs, kind in lane.lists for bar in _bar(pairs, axis, y, kind)]
        yield from seen
        if not seen and lane.silence:
            yield label(GUTTER + 8, y + BAR - 1, lane.silence, "name")


def _bar(pairs: Pairs, axis: Ruler, y: float, kind: str) -> Iterator[Element]:
    for a, b in pairs:
        left, right = axis.x(a), axis.x(b)
        if right < GUTTER or left > WIDTH:
            continue
        left, right = max(left, GUTTER), min(right, WIDTH)
        if right - left < 1.5:
            yield el("path", d=_diamond((left + right) / 2, y + BAR / 2), kind=kind)
            continue
        yield el("rect", x=left, y=y, width=right - left, height=BAR, kind=kind)
        for x in (axis.x(t) for t in (a, b) if axis.shows(t)):  # an end off the drawing runs on
            yield el("line", x1=x, x2=x, y1=y - 2, y2=y + BAR + 2, kind=f"{kind} cap")


def _diamond(x: float, y: float) -> str:
    r = BAR / 2 + 1
    return f"M{x - r:.1f},{y:.1f} {x:.1f},{y - r:.1f} {x + r:.1f},{y:.1f} {x:.1f},{y + r:.1f}Z"


def ticks(axis: Ruler, origin: Fraction, unit: Fraction, y: float) -> Iterator[Element]:
    """Yield a scale in units from an origin, whole and round."""
    span = float(PLOT * axis.unit / unit)
    step = round_up(span / 6)
    low = float((axis.middle - origin) / unit) - span / 2
    for n in range(ceil(low / step), floor((low + span) / step) + 1):
        x = axis.x(origin + Fraction(n) * Fraction(step) * unit)
        yield el("line", x1=x, x2=x, y1=y, y2=y + 4, kind="tick")
        if GUTTER + 14 < x < WIDTH - 14:
            yield label(x, y + 16, f"{n * step:.6g}", "number", "middle")


def round_up(x: float) -> float:
    """Return the least of 1, 2, 5 times a power of ten that is at least x.

    >>> round_up(0.3)
    0.5
    """
    power = 10.0 ** floor(log10(x))
    return next(m * power for m in (1, 2, 5, 10) if m * power >= x * 0.999)


@dataclass(frozen=True, slots=True)
class Close:
    """A look at one end: `origin` is the number nearest to it, `ulp` the unit there."""

    axis: Ruler
    origin: Fraction
    ulp: Fraction
    off: Fraction | None
    """How far the answer's end is from there, in ulps; None where there is no answer's end."""

    def unseen(self, lists: CaseLists, axis: Ruler) -> bool:
        """Whether it shows what the axis of the whole is too coarse for.

        An end that is off by less than a few pixels, or an interval as short that was not met.
        """
        if self.axis.unit * 50 > axis.unit:
            return False
        seen, ends = 3 * axis.unit, lists.finite(lists.exact)
        if not lists.said:
            return max(ends) - min(ends) < seen
        alike = lists.point or len(lists.said) == len(lists.exact)
        off = None if self.off is None else abs(self.off)
        return off is not None and off * self.ulp < seen and (alike or off > 1)


def close(lists: CaseLists, fmt: Format) -> Close | None:
    """Return a look at the end that the answer misses most; None where no end is finite."""

    def far(end: tuple[Fraction, Fraction | None]) -> Fraction:
        t, answered = end
        return Fraction(0) if answered is None else abs(answered - t) / ulp(t or answered, fmt)

    best = max(_ends(lists), key=far, default=None)
    if best is None:
        return None
    t, answered = best
    unit = ulp(t or answered or t, fmt)
    origin = Fraction(fmt.nearest(float(t)))
    off = None if answered is None else (answered - origin) / unit
    near = [_nearest(t, lists.finite(pairs)) for pairs in (lists.inner, lists.outer)]
    reach = max([Fraction(2), *(abs(x - t) / unit for x in near if x is not None)])
    if off is not None and abs(off) < 40 * reach:
        reach = max(reach, abs(off))
    return Close(Ruler(origin, reach * unit * Fraction(26, 10) / Fraction(PLOT)), origin, unit, off)


def _ends(lists: CaseLists) -> Iterator[tuple[Fraction, Fraction | None]]:
    """Yield exact ends, each with the answer's, but 0 with 0: 0 has no ulp to speak of.

    In order where the lists are as long, else with the nearest; of a first hit only its nearest.
    """
    exact, said = lists.finite(lists.exact), lists.finite(lists.said)
    if lists.point and said and exact:
        near = min(exact, key=lambda t: abs(t - said[0]))
        if near or said[0]:
            yield near, said[0]
    elif lists.said is not None and len(lists.said) == len(lists.exact):
        for one, other in zip(lists.exact, lists.said, strict=True):
            for t, answered in zip(one, other, strict=True):
                if isinstance(t, Fraction) and isinstance(answered, Fraction) and (t or answered):
                    yield t, answered
    else:
        for t in filter(None, exact):
            yield t, _nearest(t, said)


def _nearest(t: Fraction, numbers: list[Fraction]) -> Fraction | None:
    return min(numbers, key=lambda x: abs(x - t), default=None)


def ulp(t: Fraction, fmt: Format) -> Fraction:
    """Return the unit in the last place of the numbers of a format around t."""
    x = float(t)
    return Fraction(2) ** (max(frexp(x)[1] - fmt.precision, fmt.least) if x else fmt.least)


# The pictures of a case.

TALL = PLOT * ASPECT
GAP = 14


def pictures(shown: Json, precision: str) -> list[tuple[str, str]]:
    """Return (caption, drawing) for one of the worst cases: the whole, and a close look.

    The close look is left out where there is no finite end, and where it would show no more.
    """
    lists = CaseLists.of(shown)
    try:
        solid = read_solid(shown["solid"], "solid", "hex")
        ray = read_ray(shown["ray"], "ray", "hex")
    except Refused:
        return []
    view = section(solid, ray, lists.finite(lists.exact))
    axis = whole(lists) if view is None else axis_of(view)
    silence = _silence(shown)
    found = [_whole(view, lists, axis, silence)]
    near = close(lists, FORMATS[precision])
    if near is not None and near.unseen(lists, axis):
        found.append(_close(lists, near, "" if lists.said else silence))
    return found


def _silence(shown: Json) -> str:
    if (shown["reply"] or {}).get("hit") is not None:
        return f"hit: {str(shown['reply']['hit']).lower()}"
    if shown["reply"] is not None:
        return "no hit"
    if shown["answer"] == []:
        return "no interval"
    return clean(next(iter(shown["faults"].values()), "nothing"), 44)


def axis_of(view: Slice) -> Ruler:
    """Return the axis of t under a picture: the ray is its line."""
    return Ruler(view.middle, Fraction(2 * view.half / PLOT) / view.speed)


def _whole(view: Slice | None, lists: CaseLists, axis: Ruler, silence: str) -> tuple[str, str]:
    top = 4.0 if view is None else TALL + GAP
    ends = lists.finite(lists.exact)
    parts = [] if view is None else [*drawn(view, axis), *guides(ends, axis, top + ROW)]
    foot = top + 3 * ROW
    if lists.said:
        silence = f"elsewhere, from t = {float(lists.said[0][0]):.6g}"
    base = base_of(axis)
    parts += [*bars(lists, axis, top, silence), *ticks(axis, base, Fraction(1), foot)]
    parts.append(label(0, foot + 16, "t" if not base else "t - c", "name"))
    name = "The intervals" if view is None else view.plane.name
    caption = f"{name}, over t" + (f" - c, c = {float(base):.17g}" if base else "")
    return caption, drawing(foot + 20, caption, *parts)


def base_of(axis: Ruler) -> Fraction:
    """Return what is taken off the labels: 0, or a round t near the middle if that is far away."""
    span = axis.unit * PLOT
    if abs(axis.middle) < 5000 * span:
        return Fraction(0)
    power = Fraction(2) ** frexp(float(span))[1]
    return Fraction(float(round(axis.middle / power) * power))


def drawn(view: Slice, axis: Ruler, still: bool = False) -> Iterator[Element]:
    """Yield the solid, its leaves' outlines and the ray, in the frame of a picture.

    A `still` ray is its start alone.
    """
    scale = PLOT / (2 * view.half)

    def pixel(x: float, y: float) -> tuple[float, float]:
        return MIDDLE + x * scale, TALL / 2 - (y - view.rise) * scale

    thick = max(TALL / 90, 1.5)
    lines = [(*pixel(a, y), pixel(b, y)[0]) for y, a, b in view.filled()]
    strokes = "".join(f"M{spelled(x)},{spelled(y)}H{spelled(end)}" for x, y, end in lines)
    yield el("rect", x=GUTTER, y=0, width=PLOT, height=TALL, kind="frame")
    if strokes:
        yield el("path", d=strokes, kind="solid", stroke_width=thick)
    outlines = list(view.outlines())
    for outline in outlines:
        yield el("path", d=path((pixel(*p) for p in outline), closed=True), kind="leaf")
    if not outlines:
        yield label(MIDDLE, 20, "the solid is out of the picture", "name", "middle")
    start = axis.x(Fraction(0))
    height = ray_height(view)
    if not still:
        left = max(start, GUTTER)
        yield el("line", x1=left, x2=WIDTH - 6, y1=height, y2=height, kind="ray")
        yield el("path", d=f"M{WIDTH - 9},{height - 4:.1f}l8,4l-8,4Z", kind="tip")
    if start >= GUTTER:
        yield el("circle", cx=start, cy=height, r=3.5, kind="start")
    else:
        yield label(GUTTER + 6, height - 6, "\u2190 start", "name")


def ray_height(view: Slice) -> float:
    return TALL / 2 + view.rise * PLOT / (2 * view.half)


def guides(ends: Iterable[Fraction], axis: Ruler, foot: float) -> Iterator[Element]:
    """Yield a line from each exact end on the ray down to the intervals."""
    for t in ends:
        if axis.shows(t):
            yield el("line", x1=axis.x(t), x2=axis.x(t), y1=0, y2=foot, kind="guide")


def _close(lists: CaseLists, near: Close, silence: str) -> tuple[str, str]:
    top, foot = 4.0, 4.0 + 3 * ROW
    parts = [*bars(lists, near.axis, top, silence), *ticks(near.axis, near.origin, near.ulp, foot)]
    parts.append(label(0, foot + 16, "ulps", "name"))
    if near.off is not None and not near.axis.shows(near.origin + near.off * near.ulp):
        parts.append(pointer(near.off, top + 2 * ROW))
    caption = f"Close to t = {float(near.origin)!r}, in ulps of {float(near.ulp):.2g}"
    return caption, drawing(foot + 20, caption, *parts)


def pointer(off: Fraction, y: float) -> Element:
    """Return what points to an answer's end that is not on the drawing, so many ulps away."""
    ulps = max(Fraction(-(10**300)), min(off, Fraction(10**300)))
    far = f"{float(ulps):+.3g} ulps".replace("e+", "e")
    if off > 0:
        return label(WIDTH - 4, y + 9, f"end at {far} \u2192", "off", "end")
    return label(GUTTER + 10, y + 9, f"\u2190 end at {far}", "off")
