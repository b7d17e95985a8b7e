"""Marks do not overlap, nothing is dropped, what loses rays is hollow, the bytes come again."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from math import hypot, inf
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("matplotlib")
from raycert.oracle.measure.catalog import BY_NAME, WAYS
from raycert.oracle.measure.clock import Time
from raycert.oracle.measure.errors import Error
from raycert.oracle.measure.race import Figures, figures
from raycert.oracle.plots.pareto import MARK, draw
from raycert.oracle.plots.style import LOOKS, PAPER, SERIES, apart, figure, pictures, plain, styled

GOOD, LOST = Error(1.5), Error(inf, -1)


def plot(rows: list[Figures], folder: Path, name: str, about: str) -> list[Path]:
    with styled():
        files = pictures(draw(rows, about), name)
    for file, data in files.items():
        (folder / file).write_bytes(data)
    return [folder / file for file in files]


def made(name: str, best: float, errors: list[Error], k: float = 0.5) -> Figures:
    time = Time(best, 1.5 * best, 0.1 * best, 5, 40)
    plain = figures("far", BY_NAME[name], time, errors, (), ([k] * 4, [k] * 4))
    return replace(plain, ratio=best / 1e-4)


def all_rows() -> list[Figures]:
    """A crowd: every method, many at one place, some with losses, one with nothing but."""
    found = []
    for i, way in enumerate(WAYS):
        errors = [GOOD, *[LOST] * 100] if i % 5 == 2 else [LOST] if i == 8 else [GOOD]
        found.append(made(way.name, 1e-5 if i < 8 else 1e-6 * (i + 1), errors, 10.0 ** (i % 4)))
    return found


places = st.tuples(st.floats(0, 60), st.floats(0, 60))


@given(st.lists(places, max_size=25))
def test_marks_are_moved_apart_and_the_first_stays(crowd: list[tuple[float, float]]) -> None:
    moved = apart(crowd, 12)
    assert len(moved) == len(crowd)
    assert moved[:1] == crowd[:1]
    for (a, b), (c, d) in combinations(moved, 2):
        assert hypot(a - c, b - d) >= 12 * (1 - 1e-6)


def test_what_is_apart_stays() -> None:
    crowd = [(0.0, 0.0), (20.0, 0.0), (0.0, 30.0)]
    assert apart(crowd, 12) == crowd


def texts(drawn: Any) -> list[str]:
    return [text.get_text() for axes in drawn.axes for text in axes.texts]


def marks(axes: Any) -> list[Any]:
    """Return the numbered marks of an axes: lines of one point, larger than a dot."""
    return [line for line in axes.lines if len(line.get_xdata()) == 1 and line.get_markersize() > 8]


def test_every_method_stands_in_both_panels_and_in_the_list() -> None:
    rows = all_rows()
    named = [r for r in rows if r.way.precision != "mesh"]
    with styled():
        drawn = draw(rows, "about")
    left, right, listed = drawn.axes
    assert len(marks(left)) == len(marks(right)) == len(marks(listed)) == len(named)
    said = texts(drawn)
    for r in named:
        assert r.way.name in said
    assert {str(i + 1) for i in range(len(named))} <= set(said)
    assert {"trimesh n=4096", "embree n=4096"} <= set(said)


def test_marks_do_not_overlap_and_stay_in_the_figure() -> None:
    with styled():
        drawn = draw(all_rows(), "about")
        drawn.canvas.draw()
        width, height = drawn.canvas.get_width_height()
        for axes in drawn.axes[:2]:
            at = [axes.transData.transform(line.get_xydata()[0]) for line in marks(axes)]
            for (a, b), (c, d) in combinations(at, 2):
                assert hypot(a - c, b - d) > MARK * drawn.dpi / 72
            assert all(0 < x < width and 0 < y < height for x, y in at)


def test_words_of_the_list_do_not_run_into_each_other() -> None:
    with styled():
        drawn = draw(all_rows(), "about")
        drawn.canvas.draw()
        texts = [t for t in drawn.axes[2].texts if t.get_text()]
        boxes = [t.get_window_extent() for t in texts]
        for (one, a), (two, b) in combinations(zip(texts, boxes, strict=True), 2):
            assert not a.shrunk(0.97, 0.7).overlaps(b), (one.get_text(), two.get_text())
        width = drawn.canvas.get_width_height()[0]
        assert all(box.x1 <= width for box in boxes)


def test_what_loses_rays_is_hollow_and_what_loses_all_stands_at_the_edge() -> None:
    rows = [
        made("oracle", 1e-4, [GOOD] * 3, 0.25),
        made("textbook", 2e-5, [GOOD, GOOD, LOST], 1e6),
        made("sympy", 1e-2, [LOST] * 3, inf),
    ]
    with styled():
        drawn = draw(rows, "about")
    left, right = drawn.axes[:2]
    fills = [line.get_markerfacecolor() for line in marks(left)]
    assert fills == [PAPER, LOOKS["exact"].color, PAPER]
    for axes in (left, right):
        x = {line.get_markeredgecolor(): line.get_xdata()[0] for line in marks(axes)}
        lost, others = x.pop(LOOKS["symbolic"].color), x.values()
        assert lost > 5 * max(others)


def test_nothing_lost_and_nothing_measured_can_be_drawn(tmp_path: Path) -> None:
    bare = figures("ties", BY_NAME["oracle"], Time(1e-4, 1e-4, 0.0, 1, 4), [LOST])
    assert [path.suffix for path in plot([bare], tmp_path, "bare", "")] == [".svg", ".png"]


@pytest.mark.parametrize("k", [1e300, inf])
def test_errors_beyond_all_bounds_can_be_drawn(tmp_path: Path, k: float) -> None:
    wild = [made("oracle", 1e-4, [GOOD], 0.5), made("textbook", 1e-5, [Error(1e307)], k)]
    assert len(plot(wild, tmp_path, "wild", "")) == 2


def test_the_same_rows_give_the_same_bytes(tmp_path: Path) -> None:
    (tmp_path / "again").mkdir()
    one = plot(all_rows()[:12], tmp_path, "far", "about")
    two = plot(all_rows()[:12], tmp_path / "again", "far", "about")
    assert [path.read_bytes() for path in one] == [path.read_bytes() for path in two]
    assert b"<dc:date>" not in one[0].read_bytes()


def test_the_users_own_settings_change_nothing(tmp_path: Path) -> None:
    import matplotlib as mpl

    def picture(name: str) -> bytes:
        with styled():
            drawn = figure(2, 1)
            drawn.add_axes((0.2, 0.2, 0.7, 0.7)).set_title("x")
            return pictures(drawn, name)[f"{name}.png"]

    plain_settings = picture("one")
    with mpl.rc_context({"font.size": 30, "axes.facecolor": "red"}):
        assert picture("two") == plain_settings


def grey(color: str) -> float:
    r, g, b = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return (0.299 * r + 0.587 * g + 0.114 * b) / 255


def test_looks_are_told_apart_without_colour() -> None:
    assert len({look.mark for look in SERIES}) == len({str(look.dash) for look in SERIES}) == 10
    for one, two in combinations(LOOKS.values(), 2):
        assert one.mark != two.mark or abs(grey(one.color) - grey(two.color)) > 0.1
    assert all(grey(look.color) < 0.75 for look in (*LOOKS.values(), *SERIES))


def test_powers_of_ten_are_spelled_shortly() -> None:
    assert [plain(x) for x in (1e-6, 0.01, 1, 100, 1e3, 1e15)] == [
        "1e-6", "0.01", "1", "100", "1e3", "1e15"
    ]  # fmt: skip
