"""The pictures are right: the drawn solid ends where the exact intervals do, to the pixel."""

import re
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import inf, log10
from xml.etree import ElementTree

import pytest

import shared.certificates as made_up
from raycert.cases.domain import quantities
from raycert.cases.formats import BINARY32, BINARY64
from raycert.cases.forms import read_ray, read_solid
from raycert.cases.model import Cylinder, Leaf, Ray, Solid, leaves, type_of
from raycert.cases.row import GoldenRow
from raycert.cases.vectors import dot, norm
from raycert.oracle.reports.bounds import (
    DecadeAxis,
    QuantityLine,
    domains,
    failures,
    quantity_lines,
)
from raycert.oracle.reports.picture import (
    GUTTER,
    MIDDLE,
    PLOT,
    WIDTH,
    CaseLists,
    Ruler,
    close,
    drawing,
    el,
    pictures,
    round_up,
    whole,
)
from raycert.oracle.reports.section import Slice, section

PIXEL = 1 / PLOT
Pairs = list[tuple[float, float]]


def ends(row: GoldenRow) -> list[Fraction]:
    return [
        Fraction(end.digits)
        for span in row.intervals
        for end in (span.enter, span.leave)
        if end.digits != "inf"
    ]


def views() -> Iterator[tuple[GoldenRow, Slice]]:
    for row in made_up.sample():
        view = section(row.solid, row.ray, ends(row))
        if view is not None:
            yield row, view


def drawn(view: Slice, height: float) -> list[tuple[float, float]]:
    """Return where a line along the ray is inside the drawn solid, as the eye sees it.

    Ahead of the start; gaps and slivers of less than half a pixel are not seen.
    """
    start = float((Fraction(0) - view.middle) * view.speed)
    least, seen = PIXEL * view.half, list[tuple[float, float]]()
    for a, b in view.across(view.solid, height):
        if seen and a - seen[-1][1] < least:
            seen[-1] = (seen[-1][0], b)
        elif b - max(a, start) >= least:
            seen.append((max(a, start, -view.half), b))
    return seen


def wanted(row: GoldenRow, view: Slice) -> list[tuple[float, float]]:
    """Return the exact list on the scale of the picture."""

    def place(digits: str) -> float:
        return inf if digits == "inf" else float((Fraction(digits) - view.middle) * view.speed)

    return [(place(span.enter.digits), place(span.leave.digits)) for span in row.intervals]


def alike(found: Pairs, inside: Pairs, least: float) -> bool:
    """Tell whether two lists have the same ends, but for `least`."""
    ends = ([x for pair in pairs for x in pair] for pairs in (found, inside))
    one, other = ends
    return len(one) == len(other) and all(
        abs(x - y) < least for x, y in zip(one, other, strict=True)
    )


def test_the_solid_on_the_ray_is_the_exact_list() -> None:
    """Of rows whose intervals and gaps are wider than a pixel, the drawing is right to a half."""
    checked = 0
    for row, view in views():
        exact, pixel = wanted(row, view), 2 * view.half * PIXEL
        ends = [x for pair in exact for x in pair]
        if view.plane.aside != (0.0, 0.0, 0.0) or not exact or row.tier == "range":
            continue
        if min(b - a for a, b in pairwise(ends)) < pixel:
            continue
        inside = [(max(a, -view.half), min(b, view.half)) for a, b in exact if a < view.half]
        beside = (0.0, pixel / 50, -pixel / 50)  # a ray in a face may be a rounding off it
        assert any(alike(drawn(view, y), inside, pixel / 2) for y in beside), row.id
        checked += 1
    assert checked > 60


def test_the_planes_are_square_to_the_ray_and_the_exact_ends_are_in_the_picture() -> None:
    for row, view in views():
        assert abs(norm(view.ahead) - 1) < 1e-12
        assert abs(norm(view.plane.up) - 1) < 1e-9
        assert abs(dot(view.ahead, view.plane.up)) < 1e-7, row.id
        for t in ends(row):
            assert abs(float((t - view.middle) * view.speed)) < view.half, row.id


def test_nearly_every_case_has_a_picture_with_something_in_it() -> None:
    rows = made_up.sample()
    moving = [row for row in rows if any(row.ray.direction)]
    seen = [view for _, view in views() if any(True for _ in view.outlines())]
    assert len(seen) > 0.95 * len(moving)


def outline_of(leaf: Leaf) -> list[tuple[float, float]]:
    view = section(leaf, Ray((-9.0, 0.0, 1.0), (1.0, 0.0, 0.0)), [Fraction(8), Fraction(10)])
    assert view is not None
    (found,) = view.outlines()
    return found


def test_an_outline_has_the_size_of_the_leaf() -> None:
    """A can of radius 1 and height 2, cut through its axis, is a square, twice the chord wide."""
    found = outline_of(Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 2.0), 1.0))
    xs, ys = [x for x, _ in found], [y for _, y in found]
    width, height = max(xs) - min(xs), max(ys) - min(ys)
    assert width == pytest.approx(height, rel=0.01)


def shown_of(form: made_up.Json) -> Iterator[tuple[made_up.Json, list[tuple[str, str]]]]:
    for shown in form["worst"]:
        yield shown, pictures(shown, form["corpus"]["precision"])


@pytest.mark.parametrize("name", ["good", "bad", "attacked"])
def test_drawings_are_well_formed_and_stay_in_their_frame(name: str) -> None:
    for shown, found in shown_of(getattr(made_up, name)()):
        assert found, shown["id"]
        for caption, text in found:
            assert caption
            root = ElementTree.fromstring(text)
            assert root.find("title") is not None
            for bar in root.iter("rect"):
                assert float(bar.get("x", "0")) >= GUTTER
                assert float(bar.get("x", "0")) + float(bar.get("width", "0")) <= WIDTH + 0.2
            numbers = re.findall(
                r"-?\d+\.?\d*", " ".join(p.get("d", "") for p in root.iter("path"))
            )
            assert all(abs(float(x)) < 2000 for x in numbers)


def test_text_in_a_drawing_is_escaped() -> None:
    text = drawing(9, "a < b", el("text", text="<script>&", kind='"x"'))
    assert "<script>" not in text
    assert ElementTree.fromstring(text).findtext("text") == "<script>&"


def one(exact: tuple[str, str], said: list[list[str]]) -> CaseLists:
    end = dict(zip(("enter", "leave"), ({"digits": x} for x in exact), strict=True))
    return CaseLists.of(
        {"exact": [end], "accept": {"inner": [], "outer": []}, "answer": said, "reply": None}
    )


def test_the_close_look_counts_ulps() -> None:
    for fmt, ulp in ((BINARY64, 2.0**-52), (BINARY32, 2.0**-23)):
        lists = one(("1", "8"), [[(1 + 7 * ulp).hex(), (8.0).hex()]])
        near = close(lists, fmt)
        assert near is not None
        assert (near.origin, near.ulp, near.off) == (1, Fraction(ulp), 7)
        assert near.unseen(lists, whole(lists))
        assert near.axis.shows(1 + 7 * Fraction(ulp))


def test_a_difference_that_is_seen_needs_no_close_look() -> None:
    lists = one(("1", "8"), [[(1.0).hex(), (6.0).hex()]])
    near = close(lists, BINARY64)
    assert near is not None
    assert near.origin == 8
    assert not near.unseen(lists, whole(lists))


def test_numbers_without_measure_are_drawn_too() -> None:
    lists = one(("0", "inf"), [["0x0.0p+0", "inf"]])
    assert close(lists, BINARY64) is None
    axis = whole(lists)
    assert axis.x(inf) > WIDTH > axis.x(Fraction(0))
    assert one(("1", "2"), [["nan", "0x1.0p+0"]]).said is None
    assert Ruler(Fraction(0), Fraction(1)).x(Fraction(10**400)) > WIDTH
    assert Ruler(Fraction(5), Fraction(1)).x(Fraction(5)) == MIDDLE


@pytest.mark.parametrize(("x", "step"), [(1, 1), (1.1, 2), (3, 5), (6, 10), (0.03, 0.05)])
def test_steps_are_round(x: float, step: float) -> None:
    assert round_up(x) == pytest.approx(step)


def test_each_type_of_solid_is_drawn() -> None:
    kinds = {type_of(view.solid) for _, view in views()}
    assert len(kinds) == 8

    def count(solid: Solid) -> int:
        return sum(1 for _ in leaves(solid))

    assert any(count(view.solid) > 4 for _, view in views())


@pytest.mark.parametrize("field", ["middle", "speed"])
def test_a_picture_that_is_off_by_a_little_is_noticed(field: str) -> None:
    """What the law above would miss is no law: two pixels of shift, or a scale off by 2 %."""
    noticed = tried = 0
    for row, view in views():
        exact = [x for pair in wanted(row, view) for x in pair]
        if len(exact) != 2 or inf in exact or exact[1] - exact[0] < view.half / 4 or 0 in ends(row):
            continue
        pixel = 2 * view.half * PIXEL
        change = {
            "middle": view.middle + 2 * Fraction(pixel) / view.speed,
            "speed": view.speed * Fraction(102, 100),
        }[field]
        off = wanted(row, replace(view, **{field: change}))  # type: ignore[arg-type]
        tried += 1
        noticed += not alike(drawn(view, 0.0), off, pixel / 2)
    assert noticed == tried > 50


def lines_of(form: made_up.Json, solid: str, level: str) -> list[QuantityLine]:
    found = form["solids"][solid]["measured"][level]
    return list(quantity_lines(form, found, failures(form, solid, level)))


def test_the_domain_of_a_solid_has_a_tick_for_each_row_that_fails() -> None:
    """Each tick is at the exact quantity of a failing row, and none is left out."""
    form = made_up.bad()
    rows = failures(form, "cylinder", "sound")
    lines = {line.name: line for line in lines_of(form, "cylinder", "sound")}
    assert len(rows) > 10
    for row in rows:
        solid, ray = read_solid(row["solid"], "", "hex"), read_ray(row["ray"], "", "hex")
        for name, span in quantities(solid, ray).spans().items():
            for x in span:
                near = min(abs(log - log10(x)) for log in lines[name].failing)
                assert near < 1e-9, (row["id"], name)
    assert all(line.measured is None for line in lines.values()), "it fails on ordinary cases"


def test_a_domain_is_drawn_where_it_ends_and_said_in_words() -> None:
    form = made_up.much()
    form["domain"] = {"declared": {"size": [0.01, 100.0]}, "words": "sizes 0.01 to 100"}
    lines = {line.name: line for line in lines_of(form, "sphere", "sound")}
    assert lines["distance"].measured == (None, 1000.0)
    assert lines["distance"].words[2] == "up to 1000"
    assert lines["distance"].is_beyond(3.1)
    assert not lines["distance"].is_beyond(2.9)
    assert lines["size"].declared == (0.01, 100.0)
    assert lines["size"].words[1] == "0.01 to 100"
    axis = DecadeAxis(-4, 4)
    assert axis.bar((None, 1.0)) == (GUTTER, MIDDLE)
    assert axis.bar((1e-2, None)) == (GUTTER + PLOT / 4, WIDTH)
    assert {0} <= set(axis.numbers()) <= set(range(-4, 5))
    (shown,) = [shown for shown in domains(form) if shown["solid"] == "sphere"]
    root = ElementTree.fromstring(shown["drawing"])
    assert "starts within 1000 sizes" in str(root.findtext("title"))
    for bar in root.iter("rect"):
        assert float(bar.get("x", "0")) >= GUTTER
        assert float(bar.get("x", "0")) + float(bar.get("width", "0")) <= WIDTH + 0.2
