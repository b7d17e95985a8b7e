"""A map as a picture: a square of cells, the curves between exact forms, the case in the middle.

Classes have pale colours, lighter for fewer pairs, so that curves stand out in grey too; numbers go
from light (right) to dark (wrong). A curve has a colour, a dash and a light border of its own. What
is no valid case is hatched; what an interrupted map has not reached stays white.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from math import ceil, isinf, log10
from textwrap import shorten, wrap
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap, LogNorm, to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import Normal, Stroke
from matplotlib.ticker import FuncFormatter, MaxNLocator

from raycert.oracle.map.legend import (
    axis_label,
    class_of,
    classes,
    edges,
    endless_text,
    extremes,
    lines,
    links,
    pairs_of,
    subtitle,
    thin,
)
from raycert.oracle.map.raster import At
from raycert.oracle.map.sampling import NUMBERS, ORDER, Cell, Kind, Map
from raycert.oracle.plots.style import FAINT, INK, PAPER, figure, picture, plain, styled

WIDTH, HEIGHT = 10.4, 6.4
SQUARE = (0.085, 0.115, 0.475, 0.772)
"""The cells, in shares of the figure: a square."""
LEGEND = 0.585
WORDS = 52
MOST = 11
"""So many classes have a colour of their own; the others, the smallest, share one."""
NONE_PALE = ("#f3f2ee", "#e6e4dc", "#dad8ce", "#cecbc0")
ONE_PALE = ("#cfe3f3", "#bfe0d0", "#a5c9e8", "#d6d2ee", "#9accb4", "#b9b4dd", "#c4dbe0", "#8db8dc")
MANY_PALE = ("#fbe3c0", "#f4c98c", "#f3cdbc", "#e9ab8e", "#eee09a", "#dcc06e")
REST, FAILED, REFUSED, ENDLESS = "#b4b4b4", "#4a1020", "#e2e2e2", "#c21f1f"
DIFFERENCES = (
    "#f3f2ee", "#d3e6f2", "#9cc3e0", "#f7dfa8", "#e3d3ee", "#3f78ad", "#d2691e", "#8c1c5a",
)  # fmt: skip
"""By class of `raycert.oracle.map.sampling.ORDER`."""
RIGHT_TO_WRONG = ("#fbf9ec", "#f5e6a9", "#eebf6b", "#d98a55", "#a8505f", "#64295f", "#2a0f3f")
CURVES: dict[Kind, tuple[str, Any]] = {
    "double root": ("#000000", "-"),
    "rim": ("#b3123a", (0, (5, 1.4))),
    "coincident faces": ("#0b4f8a", (0, (2.2, 1.1))),
    "start on a face": ("#9a4a00", (0, (5, 1.2, 1.2, 1.2))),
    "parallel to a face": ("#1c6b4e", (0, (1, 1))),
}
LEAST, LIMIT = {"k": 1 / 16, "ulps": 0.5}, {"k": 64.0, "ulps": 1.0}
"""The ends of the scales: what is less than the first is as good, what reaches the other is."""


def draw(found: Map, title: str) -> Figure:
    """Return the picture of a map with at least one cell. Within `styled`."""
    drawn = figure(WIDTH, HEIGHT)
    axes = drawn.add_axes(SQUARE)
    handles = _numbers(drawn, axes, found) if found.show in NUMBERS else _classes(axes, found)
    handles += _hatched(axes, found)
    handles += _curves(axes, found)
    handles.append(_case(axes))
    _label(axes, found)
    below = shorten(subtitle(found), 118)
    drawn.text(SQUARE[0], 0.955, title, fontsize=11.5, color=INK, weight="bold", va="center")
    drawn.text(SQUARE[0], 0.918, below, fontsize=9, color=FAINT, va="center")
    drawn.legend(
        handles=handles, loc="upper left", handlelength=2.4, labelspacing=0.75, borderaxespad=0,
        bbox_to_anchor=(LEGEND, 0.887 if found.show not in NUMBERS else 0.75),
    )  # fmt: skip
    return drawn


def save(found: Map, title: str, form: str) -> bytes:
    """Return the picture of a map as PNG or SVG; no date is in it."""
    with styled():
        return picture(draw(found, title), form)


def _extent(found: Map) -> tuple[float, float, float, float]:
    step = float(found.raster.step)
    reach = (found.raster.half + 0.5) * step
    return (-reach, reach, -reach, reach)


def _image(axes: Axes, found: Map, colour: dict[At, tuple[float, ...]]) -> None:
    """Paint cells in their colours; the others stay white."""
    half = found.raster.half
    picture = np.ones((2 * half + 1, 2 * half + 1, 3))
    for (i, j), rgb in colour.items():
        picture[j + half, i + half] = rgb[:3]
    axes.imshow(picture, origin="lower", extent=_extent(found), interpolation="nearest", zorder=0)
    axes.set_aspect("auto")


def _classes(axes: Axes, found: Map) -> list[Any]:
    """Paint the classes, and return what the legend says of them."""
    counts = [(name, count) for name, count in classes(found) if name != "no valid case"]
    largest = sorted(counts, key=lambda item: -item[1])[:MOST]
    own = [item for item in counts if item in largest]
    colours = palette([name for name, _ in own])
    cells = {at: class_of(cell) for at, cell in found.cells.items() if not cell.refused}
    _image(axes, found, {at: to_rgb(colours.get(name, REST)) for at, name in cells.items()})
    handles = [_patch(colours[name], f"{name}  [{count}]") for name, count in own]
    if rest := len(counts) - len(own):
        left = sum(count for item in counts if item not in own for count in item[1:])
        handles.append(_patch(REST, f"{rest} more forms  [{left}]"))
    return handles


def palette(names: Sequence[str]) -> dict[str, str]:
    """Return the colours of classes, as told apart by their numbers of pairs."""
    used = {0: 0, 1: 0, 2: 0}
    found = {}
    for name in names:
        if name in ORDER:
            found[name] = DIFFERENCES[ORDER.index(name)]
        elif name.startswith("no answer"):
            found[name] = FAILED
        else:
            group = min(pairs_of(name), 2)
            shades = (NONE_PALE, ONE_PALE, MANY_PALE)[group]
            found[name] = shades[used[group] % len(shades)]
            used[group] += 1
    return found


def _patch(colour: str, text: str) -> Patch:
    label = "\n".join(wrap(text, WORDS, max_lines=3, placeholder=" ..."))
    return Patch(facecolor=colour, edgecolor=FAINT, linewidth=0.5, label=label)


def _numbers(drawn: Figure, axes: Axes, found: Map) -> list[Any]:
    """Paint k or ulps with their scale, and return what the legend says besides."""
    least, limit = LEAST[found.show], LIMIT[found.show]
    ends = extremes(found)
    high = max(ends[1] if ends else limit, limit)
    shades = LinearSegmentedColormap.from_list("right to wrong", RIGHT_TO_WRONG)
    norm = LogNorm(least, high, clip=True)
    known = {at: cell for at, cell in found.cells.items() if not cell.refused}
    _image(axes, found, {at: _shade(cell, shades, norm) for at, cell in known.items()})
    bar, marks = drawn.add_axes((LEGEND, 0.825, 0.375, 0.03)), _marks(least, limit, high)
    drawn.colorbar(ScalarMappable(norm, shades), cax=bar, orientation="horizontal")
    bar.set_xticks(marks, [plain(x) for x in marks])
    bar.minorticks_off()
    bar.axvline(limit, color=INK, linewidth=1.2)
    level = "the bound of stable" if found.show == "k" else "1 ulp"
    bar.set_title(f"{found.show}; the mark is {level}", fontsize=9, loc="left", color=INK)
    handles = []
    if endless := sum(cell.value is not None and isinf(cell.value) for cell in known.values()):
        handles.append(_patch(ENDLESS, f"{endless_text(found)}  [{endless}]"))
    if silent := sum(cell.value is None for cell in known.values()):
        handles.append(_patch(FAILED, f"no answer  [{silent}]"))
    return handles


def _marks(least: float, limit: float, high: float) -> list[float]:
    """Return what is written at a scale: its ends, the limit, and some decades apart from them."""
    marks = [least, limit]
    every = max(1, round(log10(high / least) / 6))
    for power in range(ceil(log10(least)), ceil(log10(high)), every):
        x = 10.0**power
        if all(abs(log10(x / mark)) > every * 0.75 for mark in marks):
            marks.append(x)
    return sorted(marks)


def _shade(cell: Cell, shades: Any, norm: Any) -> tuple[float, ...]:
    if cell.value is None:
        return to_rgb(FAILED)
    if isinf(cell.value):
        return to_rgb(ENDLESS)
    rgb: tuple[float, ...] = shades(float(norm(max(cell.value, norm.vmin))))
    return rgb


def _hatched(axes: Axes, found: Map) -> list[Any]:
    """Hatch what is no valid case, run by run, and say why of the first."""
    step, runs = float(found.raster.step), list[Any]()
    refused = sorted((j, i) for (i, j), cell in found.cells.items() if cell.refused)
    if not refused:
        return []
    for (j, _), run in groupby(enumerate(refused), lambda at: (at[1][0], at[1][1] - at[0])):
        _, columns = zip(*(at for _, at in run), strict=True)
        left, right = (columns[0] - 0.5) * step, (columns[-1] + 0.5) * step
        low, high = (j - 0.5) * step, (j + 0.5) * step
        runs.append([(left, low), (right, low), (right, high), (left, high)])
    look: dict[str, Any] = {"facecolor": REFUSED, "edgecolor": "#9a9a9a", "hatch": "////"}
    axes.add_collection(PolyCollection(runs, linewidths=0, zorder=1, **look))
    first = next(cell.refused for cell in found.cells.values() if cell.refused)
    text = "\n".join(wrap(f"no valid case  [{len(refused)}]: {first}", WORDS))
    return [Patch(**look, linewidth=0.5, label=text)]


def _curves(axes: Axes, found: Map) -> list[Any]:
    """Draw what lies on and between cells, and return what the legend says of it."""
    handles = []
    step = float(found.raster.step)
    through, along = thin(found), edges(found)
    for kind in (kind for kind in CURVES if kind in {*through.values(), *along}):
        colour, dash = CURVES[kind]
        places = {at for at, own in through.items() if own == kind}
        linked = links(places)
        alone = places - {at for link in linked for at in link}
        _squares(axes, found, sorted(alone), colour)
        paths = [
            [((i - 0.5) * step, (j - 0.5) * step) for i, j in p] for p in lines(along.get(kind, []))
        ]
        paths += [[(i * step, j * step) for i, j in p] for p in lines(linked)]
        border = [Stroke(linewidth=3.0, foreground=PAPER, alpha=0.85), Normal()]
        for effects, style in ((border[:1], "-"), (border[1:], dash)):
            curve = LineCollection(paths, colors=colour, linewidths=1.5, linestyles=[style])
            curve.set(path_effects=effects, capstyle="butt", joinstyle="round", zorder=3)
            axes.add_collection(curve)
        handles.append(Line2D([], [], color=colour, linestyle=dash, linewidth=1.6, label=kind))
    return handles


def _squares(axes: Axes, found: Map, places: Sequence[At], colour: str) -> None:
    """Mark lone cells that lie on a curve: whole where forms are shown, else in their middle."""
    step = float(found.raster.step)
    half = step * (0.5 if found.show == "exact" else 0.25)
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    squares = [[(i * step + a * half, j * step + b * half) for a, b in corners] for i, j in places]
    axes.add_collection(
        PolyCollection(squares, facecolors=colour, edgecolors=PAPER, linewidths=0.4, zorder=2)
    )


def _case(axes: Axes) -> Line2D:
    look: dict[str, Any] = {"marker": "o", "markersize": 9, "markerfacecolor": "none"}
    axes.plot([0], [0], markeredgecolor=PAPER, markeredgewidth=4, zorder=4, **look)
    axes.plot([0], [0], markeredgecolor=INK, markeredgewidth=1.6, zorder=5, **look)
    return Line2D([], [], markeredgecolor=INK, linestyle="none", label="the case", **look)


def _label(axes: Axes, found: Map) -> None:
    left, right, low, high = _extent(found)
    axes.set_xlim(left, right)
    axes.set_ylim(low, high)
    axes.grid(visible=False)
    for spine in axes.spines.values():
        spine.set_visible(True)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(7, integer=found.raster.unit == "ulps"))
        axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:.6g}"))
    axes.set_xlabel(axis_label(found, "x"))
    axes.set_ylabel(axis_label(found, "y"))
