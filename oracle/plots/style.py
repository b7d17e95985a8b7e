"""How plots look, and how they are written: to be read in grey, and reproducible to the byte.

Every family of methods has a mark of its own and a shade; a line has a dash of its own. Text is
drawn as outlines in the font that comes with matplotlib, and no file holds a date.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from io import BytesIO
from math import cos, hypot, pi, sin
from typing import Any

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

from raycert.oracle.reports.foreign import escaped

DPI = 160
INK, FAINT, GRID, PAPER = "#1a1a1a", "#767676", "#dddddd", "#ffffff"
POWER = re.compile(r"\$\d+\^\{?-?\d+\}?\$")
UNDATED: Any = {"Date": None, "Creator": "raycert"}
RC: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 10.0,
    "axes.labelsize": 9.5,
    "axes.edgecolor": FAINT,
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "savefig.facecolor": PAPER,
    "svg.fonttype": "path",
    "svg.hashsalt": "raycert",
}


@dataclass(frozen=True)
class Stroke:
    """A colour whose grey differs from its neighbours', a mark, and a dash for lines."""

    color: str
    mark: str
    dash: Any = "-"


LOOKS: dict[str, Stroke] = {
    "exact": Stroke("#000000", "D"),
    "float64": Stroke("#0b5fa5", "o"),
    "float32": Stroke("#4a90c4", "v", (0, (1, 1))),
    "longdouble": Stroke("#2a7f62", "^", (0, (5, 1))),
    "double-double": Stroke("#145a3e", "s", (0, (4, 1, 1, 1))),
    "mpmath": Stroke("#b5651d", "s", (0, (3, 1))),
    "interval": Stroke("#7a3b0c", "p", (0, (3, 1, 1, 1))),
    "symbolic": Stroke("#8c1c5a", "h", (0, (3, 1, 1, 1, 1, 1))),
    "mesh": Stroke("#8a8a8a", "o", (0, (2, 1))),
    "client": Stroke("#c21f1f", "8", (0, (6, 2))),
}
"""By family of methods."""

SERIES: tuple[Stroke, ...] = (
    Stroke("#000000", "D", "-"),
    Stroke("#0b5fa5", "o", (0, (6, 1.5))),
    Stroke("#c2571a", "s", (0, (2, 1))),
    Stroke("#2a7f62", "^", (0, (6, 1, 1, 1))),
    Stroke("#8c1c5a", "v", (0, (1, 1))),
    Stroke("#5aa0d8", "P", (0, (4, 1, 1, 1, 1, 1))),
    Stroke("#d89a2b", "X", (0, (3, 2))),
    Stroke("#6b6b6b", "p", (0, (1, 2))),
    Stroke("#7bbf9a", "<", (0, (8, 2, 2, 2))),
    Stroke("#b87aa5", ">", (0, (2, 2, 6, 2))),
)
"""For lines of one plot, in turn: told apart by dash and mark alone."""


@contextmanager
def styled() -> Iterator[None]:
    """Draw in the style, whatever the user's own settings are."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(RC)
        yield


def figure(width: float, height: float) -> Figure:
    """Return an empty figure, in inches, with a canvas that measures text. Within `styled`."""
    drawn = Figure(figsize=(width, height), dpi=DPI, facecolor=PAPER)
    FigureCanvasAgg(drawn)
    return drawn


def pictures(drawn: Figure, name: str) -> dict[str, bytes]:
    """Return a figure as the files NAME.svg and NAME.png. Within `styled`."""
    return {f"{name}.{form}": picture(drawn, form) for form in ("svg", "png")}


def picture(drawn: Figure, form: str) -> bytes:
    """Return a figure as SVG or PNG; no date is in it. Within `styled`.

    A name may hold anything; a dollar is read as mathematics in the labels of powers alone.
    """
    for text in drawn.findobj(Text):
        text.set_text(escaped(text.get_text()))
        if "$" in text.get_text() and not POWER.fullmatch(text.get_text()):
            text.set_parse_math(False)
    data, about = BytesIO(), UNDATED if form == "svg" else {"Software": "raycert"}
    drawn.savefig(data, format=form, metadata=about, dpi=DPI)
    return data.getvalue()


def decades(axis: Any) -> None:
    """Label an axis of powers of ten plainly: 1, 10, 1e3, 1e-6."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(base=10, numticks=9))
    axis.set_major_formatter(FuncFormatter(lambda x, _: plain(x)))
    axis.set_minor_formatter(NullFormatter())


def plain(x: float) -> str:
    """Return a power of ten in few characters."""
    if 0.01 <= x < 1000:
        return f"{x:g}"
    mantissa, _, power = f"{x:.0e}".partition("e")
    return f"{mantissa}e{int(power)}"


# Marks that do not overlap: each as near to where it belongs as the others let it.

Place = tuple[float, float]
TURNS = 24


def apart(places: Sequence[Place], distance: float) -> list[Place]:
    """Return places that keep a distance from each other; the first of a crowd stays.

    Each goes to the nearest free place on circles around its own: of equals, the leftmost.
    """
    kept: list[Place] = []
    for place in places:
        kept.append(next(p for p in _around(place, distance) if _free(p, kept, distance)))
    return kept


def _free(place: Place, taken: Sequence[Place], distance: float) -> bool:
    return all(hypot(place[0] - x, place[1] - y) >= distance * (1 - 1e-9) for x, y in taken)


def _around(place: Place, distance: float) -> list[Place]:
    steps = [distance * (1 + k / 4) for k in range(40)]
    return [place] + [
        (place[0] + r * cos(2 * pi * i / TURNS), place[1] + r * sin(2 * pi * i / TURNS))
        for r in steps
        for i in range(TURNS)
    ]
