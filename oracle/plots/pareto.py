"""Error against run time, one plot a scenario: ulps on the left, backward error k on the right.

Time per ray is shared by both panels. A mark is filled where every count of pairs is right, hollow
where rays are lost; numbers name the methods in the list on the right. Marks that would overlap are
moved apart, with a line to where they belong. What is lost altogether stands at the right edge.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from textwrap import fill, shorten
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from raycert.oracle.measure.race import Figures, pareto
from raycert.oracle.measure.rays import SETS
from raycert.oracle.plots.style import FAINT, INK, LOOKS, PAPER, apart, decades, figure

LEAST_ULPS, LEAST_K = 0.5, 1 / 16
FARTHEST = 1e24
"""What is larger, as what cannot be told at all, stands at the right edge."""
MARK = 13.0
"""The size of a mark with a number, in points."""
COLUMNS = (0.70, 0.815, 1.0)
"""Where the figures of the list end: correctly rounded, lost, time over the oracle's."""
CASTERS = {"trimesh": "s", "embree": "o"}
READING = (
    "mark: least time; upright line: to the median",
    "filled: every count of pairs is right",
    "hollow: rays lost (wrong count or failure)",
    "steps: the front of what loses none,",
    "full one ray at a time, dashed in batches",
    "grey lines: prisms of n sides and more",
)
SIZES = {"D": 0.92, "^": 1.4, "v": 1.4, "p": 1.12, "h": 1.12}


def draw(rows: Sequence[Figures], about: str) -> Figure:
    """Return the plot of one scenario's rows, one at least. Within `styled`."""
    rows = sorted(rows, key=lambda r: -r.time.best)
    numbers = {r.way.name: i + 1 for i, r in enumerate(r for r in rows if not _mesh(r))}
    drawn = figure(11.0, 6.9)
    left = drawn.add_axes((0.07, 0.13, 0.335, 0.77))
    right = drawn.add_axes((0.425, 0.13, 0.335, 0.77), sharey=left)
    right.tick_params(labelleft=False)
    _panel(left, rows, numbers, [_ulps(r) for r in rows], LEAST_ULPS)
    _panel(right, rows, numbers, [_strict(r) for r in rows], LEAST_K)
    left.set_xlabel("forward error in ulps, 99 of 100 rays (right counts only)")
    sampled = max(r.sample for r in rows)
    right.set_xlabel(f"backward error k, 99 of 100 of {sampled} rays")
    left.set_ylabel("microseconds per ray")
    right.axvline(64, color=FAINT, linewidth=0.9, linestyle=(0, (1, 1.5)), zorder=1)
    _above(right, 64, "stable to 64")
    _above(left, LEAST_ULPS, "0.5 ulp")
    scenario = rows[0].scenario
    drawn.text(0.07, 0.945, f"{scenario}: {SETS[scenario][0]}", size=12, color=INK)
    _names(drawn, rows, numbers)
    drawn.text(0.07, 0.02, fill(about, 170), size=7.5, color=FAINT)
    return drawn


def _mesh(row: Figures) -> bool:
    return row.way.precision == "mesh"


def _ulps(row: Figures) -> float:
    return max(row.ulps_counted.p99, LEAST_ULPS) if row.ulps_counted else inf


def _strict(row: Figures) -> float:
    return max(row.strict.p99, LEAST_K) if row.strict else inf


def _above(axes: Axes, x: float, text: str) -> None:
    """Write a small word above the panel, where a line or a strip begins."""
    axes.annotate(
        text, (x, 1.0), xycoords=("data", "axes fraction"), xytext=(2, 3),
        textcoords="offset points", size=7.5, color=FAINT,
    )  # fmt: skip


def _panel(
    axes: Axes, rows: Sequence[Figures], numbers: dict[str, int], errors: list[float], least: float
) -> None:
    errors = [x if x < FARTHEST else inf for x in errors]
    finite = [x for x in errors if x < inf]
    most = max(max(finite, default=1.0), 200 * least)
    share = most / least
    beyond, lost = most * share**0.16, len(finite) < len(errors)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(least / share**0.16, most * share ** (0.26 if lost else 0.1))
    times = [r.time.best * 1e6 for r in rows]
    axes.set_ylim(min(times) / 2, max(times) * 2.5)
    decades(axes.xaxis)
    decades(axes.yaxis)
    axes.axvspan(axes.get_xlim()[0], least, color="#f3f3f3", zorder=0)
    if lost:
        axes.axvspan(most * share**0.09, axes.get_xlim()[1], color="#f3f3f3", zorder=0)
        _above(axes, most * share**0.09, "beyond")
    places = [(min(x, beyond), y) for x, y in zip(errors, times, strict=True)]
    _fronts(axes, rows, errors)
    _meshes(axes, rows, places)
    _marks(axes, rows, numbers, places)


def _fronts(axes: Axes, rows: Sequence[Figures], errors: list[float]) -> None:
    """Draw the front of batches, and that of one ray at a time; what loses rays is on neither."""
    for batch, dash in ((True, (0, (4, 2))), (False, "-")):
        kind = [
            (r.time.best * 1e6, x if not r.lost else inf)
            for r, x in zip(rows, errors, strict=True)
            if r.way.batch == batch
        ]
        on = sorted(p for p, front in zip(kind, pareto(kind), strict=True) if front)
        if on:
            low, high = axes.get_ylim()[1], axes.get_xlim()[1]
            xs = [high, *(x for _, x in on), on[-1][1]]
            ys = [on[0][0], *(y for y, _ in on), low]
            axes.step(xs, ys, where="post", color=FAINT, linewidth=1.1, linestyle=dash, zorder=1.5)


def _meshes(axes: Axes, rows: Sequence[Figures], places: list[tuple[float, float]]) -> None:
    """Draw the prisms of each caster as one line, from few sides to many."""
    look = LOOKS["mesh"]
    for caster, shape in CASTERS.items():
        line = [
            (_sides(r), place, r)
            for r, place in zip(rows, places, strict=True)
            if r.way.name.startswith(caster + "-") and _mesh(r)
        ]
        line.sort(key=lambda item: item[0])
        if not line:
            continue
        xs, ys = zip(*(place for _, place, _ in line), strict=True)
        axes.plot(xs, ys, color=look.color, linewidth=1.0, linestyle=look.dash, zorder=2)
        for _, (x, y), r in line:
            inside = PAPER if r.lost else look.color
            axes.plot(
                [x], [y], shape, color=look.color, markersize=4.5, markerfacecolor=inside,
                zorder=2.1,
            )  # fmt: skip
        n, (x, y), _ = line[0]
        axes.annotate(
            f"n={n}", (x, y), xytext=(5, -2.5), textcoords="offset points", size=7,
            color=look.color, zorder=1.9,
        )  # fmt: skip


def _marks(
    axes: Axes, rows: Sequence[Figures], numbers: dict[str, int], places: list[tuple[float, float]]
) -> None:
    named = [(r, place) for r, place in zip(rows, places, strict=True) if not _mesh(r)]
    to_points = 72 / axes.figure.dpi
    pixels = axes.transData.transform([place for _, place in named]) * to_points
    moved = apart([(float(x), float(y)) for x, y in pixels], MARK + 2.5)
    back = axes.transData.inverted()
    for (r, (x, y)), at in zip(named, moved, strict=True):
        look = LOOKS[r.way.precision]
        axes.plot([x, x], [y, r.time.median * 1e6], color=look.color, linewidth=1.2, zorder=2.5)
        u, v = back.transform((at[0] / to_points, at[1] / to_points))
        axes.plot([x, u], [y, v], color=INK, linewidth=0.6, zorder=2.6)
        axes.plot([x], [y], ".", color=INK, markersize=2.5, zorder=2.7)
        _numbered(axes, (float(u), float(v)), numbers[r.way.name], r)


def _numbered(axes: Any, place: tuple[float, float], number: int, row: Figures) -> None:
    look = LOOKS[row.way.precision]
    inside, ink = (PAPER, look.color) if row.lost else (look.color, PAPER)
    ink = INK if row.lost else ink
    size = MARK * SIZES.get(look.mark, 1.0)
    shared: dict[str, Any] = {"transform": axes.transData, "clip_on": False}
    axes.plot(
        [place[0]], [place[1]], look.mark, markersize=size * 0.86, color=look.color,
        markerfacecolor=inside, markeredgewidth=1.2, zorder=3, **shared,
    )  # fmt: skip
    shift = {"^": -0.1, "v": 0.1}.get(look.mark, 0.0) * size
    axes.annotate(
        str(number), place, xytext=(0, shift - 0.3), textcoords="offset points", size=7,
        color=ink, ha="center", va="center", zorder=4, weight="bold",
        annotation_clip=False,
    )  # fmt: skip


def _names(drawn: Any, rows: Sequence[Figures], numbers: dict[str, int]) -> None:
    """List the numbered methods, slow ones first, with what they get right, lose and cost."""
    axes = drawn.add_axes((0.768, 0.10, 0.23, 0.82))
    axes.set_axis_off()
    axes.set_xlim(0, 1)
    named, meshes = [r for r in rows if not _mesh(r)], [r for r in rows if _mesh(r)]
    axes.set_ylim(len(named) + 6.6, -1.2)
    for x, word in ((0.12, "method"), *zip(COLUMNS, ("rounded", "lost", "ratio"), strict=True)):
        axes.text(x, -0.7, word, size=7.5, color=FAINT, ha="left" if x == 0.12 else "right")
    for i, r in enumerate(named):
        _numbered(axes, (0.05, i), numbers[r.way.name], r)
        _line(axes, i, r, shorten(r.way.name, 22, placeholder=" ..."))
    at = len(named)
    for caster, mark in CASTERS.items():
        each = [r for r in meshes if r.way.name.startswith(caster + "-")]
        if each:
            finest = max(each, key=_sides)
            axes.plot(
                [0.02, 0.08], [at, at], color=LOOKS["mesh"].color, linestyle="--", linewidth=1
            )
            axes.plot([0.05], [at], mark, color=LOOKS["mesh"].color, markersize=4.5)
            _line(axes, at, finest, f"{caster} n={_sides(finest)}")
            at += 1
    for i, text in enumerate(READING):
        axes.text(0.0, at + 0.6 + 0.75 * i, text, size=7.3, color=FAINT, va="center")


def _line(axes: Any, y: float, r: Figures, name: str) -> None:
    ratio = "" if r.ratio is None else f"{r.ratio:.0f}" if r.ratio >= 10 else f"{r.ratio:.2g}"
    figures = f"{100 * r.exact // r.rays}%", str(r.lost or ""), ratio
    axes.text(0.12, y, name, size=7.8, color=INK, va="center")
    for x, figure_ in zip(COLUMNS, figures, strict=True):
        axes.text(x, y, figure_, size=8, color=INK, va="center", ha="right")


def _sides(row: Figures) -> int:
    return int(row.way.name.rpartition("-")[2])
