"""The pictures of one case: ray and solid over the intervals in t, and a close look in ulps."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from math import frexp
from typing import Any
from xml.etree.ElementTree import Element

from raycert.cases.formats import FORMATS
from raycert.cases.forms import read_ray, read_solid
from raycert.cases.model import Refused
from raycert.oracle.reports.numberline import (
    GUTTER,
    MIDDLE,
    PLOT,
    ROW,
    WIDTH,
    CaseLists,
    Close,
    Ruler,
    bars,
    close,
    drawing,
    el,
    label,
    path,
    spelled,
    ticks,
    whole,
)
from raycert.oracle.reports.reading import clean
from raycert.oracle.reports.section import ASPECT, Slice, section

Json = dict[str, Any]
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
    return label(GUTTER + 4, y + 9, f"\u2190 end at {far}", "off")
