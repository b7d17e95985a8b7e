"""Error against stiffness as a picture: one small panel a sweep.

A line is the worst strict k of a method at each step, a thin one its squared k, both on a log scale
up to `no k`: none accepts the answer. Marks stand only where k > 64. Below each panel dots show the
share of wrong counts of pairs, one row a method in the order of the legend. The grey area is the
condition number of the problem in ulps. Lines differ in their dashes and stand a little apart, so
that the picture reads in grey and where methods agree.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite, nan
from textwrap import shorten
from typing import Any, Literal, cast

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from raycert.oracle.measure.curves import Curve, Stress
from raycert.oracle.measure.facets import CASTERS, Sides, slope
from raycert.oracle.measure.ranges import MOST
from raycert.oracle.measure.sweeps import Sweep
from raycert.oracle.plots.style import FAINT, GRID, INK, SERIES, Stroke, figure

Field = Literal["strict", "ulps"]
FIRST = ("reference", "textbook", "determinant", "q-root", "shift", "oracle")
"""What shows most, for the first picture of many methods."""
MOST_LINES = 7
COLUMNS = 3
WIDTH, ROW, HEAD = 11.0, 2.3, 0.65
LOW, NONE = 1 / 32, 1e19
"""The y axis; infinity is drawn at its upper end."""
MARKS = 17
"""The most marks on a line."""
APART = 0.006
"""Of the width of a panel: how far apart lines stand that would lie on one another."""
NOTES, NOTE = 12, 112
"""The lines of notes that there is room for, and their characters."""
RC: dict[str, Any] = {
    "font.size": 8.0,
    "axes.titlesize": 9.0,
    "axes.titlelocation": "left",
    "axes.grid": False,
}
SHADE = "#e6e6e6"
TITLES: dict[Field, str] = {
    "strict": "Backward error k against stiffness: the worst of each step, strict "
    "(thin: squared). Dots below: share of wrong counts of pairs",
    "ulps": "Forward error in ulps against stiffness: the worst of each step where the count of "
    "pairs is right. Dots below: share of wrong counts",
}


@dataclass(frozen=True, slots=True)
class Axis:
    """Where the steps of a sweep stand: at their powers, and 0 a gap beyond the last."""

    sweep: Sweep
    steps: tuple[Fraction, ...]

    def at(self, x: Fraction) -> float:
        if x:
            return float(self.sweep.power(x))
        powers = [self.sweep.power(step) for step in self.steps if step]
        return min(powers) - max((max(powers) - min(powers)) / 12, 1)

    @property
    def width(self) -> float:
        """Return the signed width, from the first step to the last."""
        return self.at(self.steps[-1]) - self.at(self.steps[0]) or 1.0

    @property
    def limits(self) -> tuple[float, float]:
        """Return the limits of the axis: the first step is on the left."""
        margin = self.width / 30
        return self.at(self.steps[0]) - margin, self.at(self.steps[-1]) + margin

    def ticks(self) -> Iterator[tuple[float, str]]:
        """Yield a few places with what stands there."""
        powers = [self.sweep.power(x) for x in self.steps if x]
        low, high = min(powers), max(powers)
        every = next(n for n in (1, 2, 4, 5, 10, 20, 250, 500, 1000) if (high - low) / n <= 5)
        for power in range(-(-low // every) * every, high + 1, every):
            yield power, "1" if not power else f"${self.sweep.base}^{{{power}}}$"
        if not self.steps[-1]:
            yield self.at(self.steps[-1]), "0"


def spaced(places: Sequence[float], wanted: Sequence[bool], least: float) -> list[int]:
    """Return the numbers of the wanted places that keep the least distance from one another."""
    kept: list[int] = []
    for i, wants in enumerate(wanted):
        if wants and (not kept or abs(places[i] - places[kept[-1]]) >= least):
            kept.append(i)
    return kept


def pages(names: Sequence[str]) -> list[tuple[str, ...]]:
    """Return the methods of each picture: a few on each, those that show most on the first."""
    if len(names) <= MOST_LINES:
        return [tuple(names)]
    lead = tuple(name for name in FIRST if name in names)
    rest = [name for name in names if name not in lead]
    others = [tuple(rest[i : i + MOST_LINES]) for i in range(0, len(rest), MOST_LINES)]
    return [lead, *others] if lead else others


def draw(
    stress: Stress,
    names: Sequence[str],
    sides: Sequence[Sides] = (),
    field: Field = "strict",
    notes: Sequence[str] = (),
) -> Figure:
    """Return the picture of some methods, no more than MOST_LINES; `notes` fill the last row.

    Within `styled`.
    """
    cast("dict[str, Any]", mpl.rcParams).update(RC)
    sweeps = [sweep for sweep in stress.plan.sweeps if stress.grounds.get(sweep.name)]
    count = len(sweeps) + bool(sides)
    columns = max(min(COLUMNS, count), 1)
    lines = max(-(-count // columns), 1)
    width, height = WIDTH, lines * ROW + HEAD + 0.1
    drawing = figure(width, height)
    grid = drawing.add_gridspec(lines, columns, hspace=0.42, wspace=0.2)
    inches = (0.62, 0.5, width - 0.3, height - HEAD - 0.15)
    left, bottom, right, top = inches
    grid.update(left=left / width, bottom=bottom / height, right=right / width, top=top / height)
    for i, sweep in enumerate(sweeps):
        cell = grid[divmod(i, columns)].subgridspec(2, 1, height_ratios=[4.2, 1.0], hspace=0.06)
        upper = drawing.add_subplot(cell[0])
        lower = drawing.add_subplot(cell[1], sharex=upper)
        _panel(upper, lower, stress, sweep, names, field)
    if sides:
        _sides(drawing.add_subplot(grid[divmod(len(sweeps), columns)]), sides)
    if notes and count % columns:
        _notes(drawing.add_subplot(grid[lines - 1, count % columns :]), notes)
    _legend(drawing, names, field)
    return drawing


def _panel(
    upper: Axes, lower: Axes, stress: Stress, sweep: Sweep, names: Sequence[str], field: Field
) -> None:
    grounds = stress.grounds[sweep.name]
    axis = Axis(sweep, tuple(x for x in sweep.steps if x in grounds))
    places = [axis.at(x) for x in axis.steps]
    floor = [_shown(grounds[x].floor) for x in axis.steps]
    upper.fill_between(places, LOW, floor, color=SHADE, linewidth=0)
    upper.plot(places, floor, color=FAINT, linewidth=0.6)
    if field == "strict":
        upper.axhline(MOST, color=INK, linewidth=0.6, linestyle=(0, (2, 2)))
    for number, name in enumerate(names):
        curve, look = stress.curve(sweep.name, name), SERIES[number]
        apart = APART * axis.width * (number - (len(names) - 1) / 2)
        _lines(upper, axis, curve, look, field, apart)
        _dots(lower, axis, curve, look, number)
    _axes(upper, lower, axis, len(names), "inf" if field == "ulps" else "no k")
    dots = " (dots: not correctly rounded)" if sweep.rounding else ""
    upper.set_title(sweep.title + dots, pad=3)


def _axes(upper: Axes, lower: Axes, axis: Axis, rows: int, top: str) -> None:
    upper.set_yscale("log")
    upper.set_ylim(LOW, NONE * 10)
    upper.set_yticks([1, 64, 1e6, 1e12, NONE], ["1", "64", "$10^6$", "$10^{12}$", top])
    upper.minorticks_off()
    upper.tick_params(axis="x", length=0, labelbottom=False)
    upper.set_xlim(*axis.limits)
    lower.set_ylim(rows - 0.3, -0.7)
    lower.set_yticks([])
    lower.spines["left"].set_visible(False)
    ticks = list(axis.ticks())
    lower.set_xticks([at for at, _ in ticks], [text for _, text in ticks])
    lower.tick_params(axis="x", length=2, pad=1.5)
    lower.set_xlabel(axis.sweep.axis, labelpad=1, fontsize=8)


def _lines(upper: Axes, axis: Axis, curve: Curve, look: Stroke, field: Field, apart: float) -> None:
    """Draw the worst errors of a method, and marks where k is beyond 64."""
    known = [x for x in axis.steps if x in curve]
    places = [axis.at(x) + apart for x in known]
    if field == "ulps":
        worst = [curve[x].ulps for x in known]
        heights = [nan if value is None else _shown(value) for value in worst]
        upper.plot(places, heights, color=look.color, linestyle=look.dash, linewidth=1.3)
        return
    strict, squared = [curve[x].strict for x in known], [curve[x].squared for x in known]
    upper.plot(places, [*map(_shown, squared)], color=look.color, linewidth=0.5, alpha=0.8)
    beyond = spaced(places, [k > MOST for k in strict], abs(axis.width) / MARKS)
    upper.plot(
        places, [*map(_shown, strict)], color=look.color, linestyle=look.dash, linewidth=1.3,
        marker=look.mark, markersize=3.4, markevery=beyond,
    )  # fmt: skip


def _shown(value: float) -> float:
    return min(max(value, LOW), NONE) if isfinite(value) else NONE


def _dots(lower: Axes, axis: Axis, curve: Curve, look: Stroke, number: int) -> None:
    """Draw the share of wrong counts, missed, phantom or failed, as the area of dots."""
    lower.axhline(number, color=GRID, linewidth=0.5, zorder=0)
    known = [(axis.at(x), curve[x]) for x in axis.steps if x in curve]
    shares = [(at, p.inexact if axis.sweep.rounding else p.wrong) for at, p in known]
    wrong = [(at, share) for at, share in shares if share]
    sizes = [1.5 + 5 * share for _, share in wrong]
    places = [at for at, _ in wrong], [number] * len(wrong)
    lower.scatter(*places, s=sizes, color=look.color, linewidths=0, clip_on=False)


def _sides(axes: Axes, sides: Sequence[Sides]) -> None:
    """Draw the error of meshes against their sides, with the fitted slopes."""
    looks = (Stroke(GRID, ""), Stroke(INK, "", (0, (3, 2))))
    for caster, look, width in zip(CASTERS, looks, (4.0, 1.2), strict=True):
        found = [one for one in sides if one.caster == caster and isfinite(one.error)]
        if found:
            axes.plot(
                [one.n for one in found], [one.error for one in found], color=look.color,
                linestyle=look.dash, linewidth=width,
                label=f"{caster}: slope {slope(sides, caster):.2f}",
            )  # fmt: skip
    axes.set_title("meshes of n sides: error / radius", pad=3)
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    axes.set_xlabel("n", labelpad=1, fontsize=8)
    axes.minorticks_off()
    axes.legend(loc="upper right", handlelength=2.4)


def _notes(axes: Axes, notes: Sequence[str]) -> None:
    shown = list(notes[:NOTES])
    if len(notes) > NOTES:
        shown[-1] = f"and {len(notes) - NOTES + 1} more"
    text = "\n".join(shorten(note, NOTE) for note in shown)
    axes.set_axis_off()
    axes.text(0.0, 1.0, text, va="top", linespacing=1.35, transform=axes.transAxes)


def _legend(drawing: Figure, names: Sequence[str], field: Field) -> None:
    handles: list[Any] = [
        Line2D(
            [], [], color=look.color, linestyle=look.dash, linewidth=1.3, label=name, markersize=4,
            marker="" if field == "ulps" else look.mark,
        )
        for name, look in zip(names, SERIES, strict=False)
    ]  # fmt: skip
    handles.append(Patch(facecolor=SHADE, edgecolor=FAINT, label="condition, ulps"))
    drawing.legend(
        handles=handles, loc="upper left", bbox_to_anchor=(0.0, 1.0), ncols=len(handles),
        title=TITLES[field], alignment="left", columnspacing=1.3, handlelength=2.8,
        title_fontsize=9,
    )  # fmt: skip
