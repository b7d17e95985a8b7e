"""The page of a case: drawn, lit, right to the pixel, unharmed by what others say, and it fits."""

import re
from fractions import Fraction
from math import inf
from pathlib import Path

import pytest

import shared.certificates as made_up
from raycert.cases.case import Case
from raycert.cases.formats import BINARY64
from raycert.cases.model import Cylinder, HalfSpace, Intersection, Ray, Slab, Solid, Sphere
from raycert.cases.protocol import Hello, Reply
from raycert.cases.row import GoldenRow
from raycert.cases.vectors import dot
from raycert.oracle.certify.grading import grade
from raycert.oracle.explain.casepage import (
    NAME,
    AnswerLine,
    Response,
    _names,
    case_page,
    closeups,
    drawable,
    lists,
    wholes,
)
from raycert.oracle.explain.derive import Derivation, as_given, derive, given
from raycert.oracle.reports.section import views
from shared.browser import probed
from shared.corpus import golden

CAN = Cylinder((0.0, 0.0, 0.0), (0.0, 0.0, 2.0), 1.0)
RAY = Ray((-3.0, 0.3, 0.2), (1.0, 0.0, 0.3))
ENDS = [Fraction(2), Fraction(4)]
HELLO = Hello(name=made_up.HOSTILE)


def derived(solid: Solid = CAN, ray: Ray = RAY) -> Derivation:
    return derive(given(solid, ray), BINARY64)


def asked(row: GoldenRow, outcome: made_up.Outcome, hello: Hello = HELLO) -> Response:
    return Response("my.code:trace", hello.name, grade(row, outcome, hello))


def drawings(derivation: Derivation, *said: AnswerLine) -> tuple[str, str]:
    """Return the whole ones and the close ones, as text."""
    row = derivation.row
    exact = lists(row, row.accept["stable"])
    drawn = wholes(row, exact, said), closeups(row, exact, said, BINARY64)
    one, other = ("".join(text for _, text in found) for found in drawn)
    return one, other


def test_the_page_has_the_derivation_with_the_taken_rows_lit() -> None:
    derivation = derived()
    text = case_page(derivation, [], "raycert explain")
    for step in derivation.steps:
        assert step.heading.replace("<", "&lt;").replace(">", "&gt;") in text
    lit = re.findall(r'<tr class="taken"><th><code>([^<]+)</code>', text)
    assert lit == ["through", "AF", "meet"]
    assert "Seen along the axis" in text
    assert "enter at t = 2.046" in text


def test_a_cylinder_has_a_view_along_and_one_across() -> None:
    along, across = views(CAN, RAY, ENDS)
    axis = (0.0, 0.0, 1.0)
    assert abs(dot(across.section.ahead, axis)) < 1e-15
    assert abs(dot(across.section.plane.up, axis)) < 1e-15
    assert abs(dot(along.section.plane.up, axis)) > 0.9
    sizes = [b - a for _, a, b in across.section.filled()]
    [outline] = across.section.outlines()
    heights = [y for _, y in outline]
    assert max(sizes) == pytest.approx(max(heights) - min(heights), rel=0.02)  # a circle


def test_the_circle_is_met_where_the_wall_is() -> None:
    across = views(CAN, RAY, ENDS)[1].section
    [(a, b)] = across.across(across.solid, 0.0)
    t = [float(across.middle) + x / float(across.speed) for x in (a, b)]
    half = (1 - 0.3**2) ** 0.5
    assert t == pytest.approx([3 - half, 3 + half], abs=1e-12)


@pytest.mark.parametrize(
    ("solid", "ray", "count", "still"),
    [
        (CAN, Ray((0.2, 0.3, -2.0), (0.0, 0.0, 1.0)), 2, [False, True]),
        (CAN, Ray((0.0, 0.0, -2.0), (0.0, 0.0, 1.0)), 2, [False, True]),
        (CAN, Ray((0.2, 0.3, 1.0), (0.0, 0.0, 0.0)), 2, [True, True]),
        (Sphere((0.0, 0.0, 0.0), 1.0), RAY, 1, [False]),
        (Sphere((0.0, 0.0, 0.0), 1.0), Ray((0.5, 0.0, 0.0), (0.0, 0.0, 0.0)), 1, [True]),
        (Slab((0.0, 0.0, 0.0), (0.0, 0.0, 2.0)), RAY, 1, [False]),
        (HalfSpace((0.0, 0.0, 0.0), (0.0, 0.0, 2.0)), RAY, 1, [False]),
        (Intersection((CAN, Sphere((0.0, 0.0, 0.0), 3.0))), RAY, 2, [False, False]),
    ],
)
def test_every_solid_has_its_views(solid: Solid, ray: Ray, count: int, still: list[bool]) -> None:
    found = views(solid, ray, ENDS)
    assert len(found) == count
    assert [view.still for view in found] == still
    assert all(any(view.section.filled()) for view in found)
    whole, _ = drawings(derived(solid, ray))
    assert whole.count("<svg") == count
    assert ('class="tip"' in whole) == (not all(still))


def test_a_ray_a_long_way_off_looks_the_same_across() -> None:
    """The projection is exact: 1e9 radii away the circle is met where it is met nearby."""
    near = views(CAN, Ray((-4.0, 0.5, -4.0), (1.0, 0.0, 1.0)), [])[1].section
    far = Ray((-(2.0**30), 0.5, -(2.0**30)), (1.0, 0.0, 1.0))
    away = views(CAN, far, [Fraction(2**30 - 1), Fraction(2**30 + 1)])[1].section
    for view in (near, away):
        [(a, b)] = view.across(view.solid, 0.0)
        assert (b - a) / float(view.speed) == pytest.approx(3**0.5, abs=1e-9)


def test_each_end_has_a_close_look_at_which_an_ulp_is_seen() -> None:
    derivation = derived()
    [(enter, leave)] = derivation.row.expected
    said = AnswerLine("off", drawable(((enter - 2**-51, leave + 2**-40),)))
    _, close = drawings(derivation, said)
    assert close.count("<svg") == 2
    assert close.count('class="unit"') >= 10
    assert "ulps \u2192" in close
    far = AnswerLine("far", drawable(((enter, 1e300),)))
    assert "end at +1e300 ulps \u2192" in drawings(derivation, far)[1]


def test_a_planted_ulp_is_seen_at_its_place() -> None:
    """The bar of an answer begins so many units from the bar of the right one."""
    derivation = derived()
    [(enter, leave)] = derivation.row.expected

    def begins(steps: int) -> float:
        said = AnswerLine("off", drawable(((enter + steps * 2**-51, leave),)))
        first = drawings(derivation, said)[1].partition("</svg>")[0]
        [x] = re.findall(r'<rect x="([\d.]+)"[^>]*class="said"', first)
        return float(x)

    lines = re.findall(r'<line x1="([\d.]+)"[^>]*class="unit"', drawings(derivation)[1])
    one = float(lines[1]) - float(lines[0])
    assert one > 20
    assert begins(1) - begins(0) == pytest.approx(one, abs=0.2)
    assert begins(0) - begins(-2) == pytest.approx(2 * one, abs=0.2)


def test_ends_at_0_and_beyond_have_none_and_a_touch_has_one() -> None:
    inside = derived(CAN, Ray((0.0, 0.0, 1.0), (0.0, 0.0, 0.0)))
    assert drawings(inside)[1] == ""
    touch = derived(CAN, Ray((-3.0, 1.0, 1.0), (1.0, 0.0, 0.0)))
    whole, close = drawings(touch)
    assert close.count("<svg") == 1
    assert re.search(r'<circle [^>]*class="exact"', whole)


@pytest.mark.parametrize(
    "pairs", [((float("nan"), 1.0),), ((0.0, inf), (-1.0, -inf)), ((1e300, 1.5e300),), ()]
)
def test_any_answer_is_drawn(pairs: tuple[tuple[float, float], ...]) -> None:
    derivation = derived()
    one = asked(derivation.row, Reply("", intervals=pairs), Hello(name="odd"))
    assert "<bdi>trace</bdi>" in case_page(derivation, [one], "again")
    drawn = "".join(drawings(derivation, AnswerLine("odd", drawable(pairs))))
    assert not re.search(r'="-?(nan|inf)"', drawn)


def test_every_tier_and_type_of_the_corpus_has_a_page() -> None:
    rows = {(row.tier, type(row.solid)): row for row in golden().rows}
    assert len(rows) > 20
    for row in rows.values():
        derivation = derive(as_given(row), BINARY64, row.family)
        answer = asked(row, Reply("", intervals=row.expected))
        assert derivation.row.id in case_page(derivation, [answer], "again")


def sorts(row: GoldenRow) -> list[Response]:
    """Return answers of every sort, with hostile words."""
    outcomes = [made_up.hostile(row, n) for n in range(8)]
    first, yes = Hello(name="f", answers="first"), Hello(name="a", answers="any")
    return [
        *(asked(row, outcome) for outcome in outcomes),
        asked(row, Reply("", first=2.0), first),
        asked(row, Reply("", first=None), first),
        asked(row, Reply("", hit=True), yes),
        Response("none", "none", None, f"could not be run: {made_up.HOSTILE}"),
    ]


def hostile() -> str:
    case = as_given(derived().row)
    case = Case(
        case.slug, made_up.HOSTILE, CAN, RAY, "generic", (made_up.HOSTILE,), made_up.HOSTILE
    )
    derivation = derive(case, BINARY64, made_up.HOSTILE)
    return case_page(derivation, sorts(derivation.row), made_up.HOSTILE)


def test_hostile_text_does_no_harm() -> None:
    text = hostile()
    assert "<script" not in text
    assert "<img" not in text
    assert not re.search("[\x00\x1b\u202e\ud800]", text)
    text.encode()


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (["reference"], [("reference", "reference")]),
        (["my.code:trace", "./other"], [("trace", "trace"), ("other", "other")]),
        (["a:hit", "b:hit"], [("a:hit", "a:hit"), ("b:hit", "b:hit")]),
        (
            ["one:intersect", "my.two:intersect", "./intersect"],
            [
                ("one:inter\u2026", "one:intersect"),
                ("two:inter\u2026", "two:intersect"),
                (".:intersect"[:9] + "\u2026", ".:intersect"),
            ],
        ),
        (
            ["a.t:intersect", "b.t:intersect"],
            [("1 a.t", "1 a.t:intersect"), ("2 b.t", "2 b.t:intersect")],
        ),
    ],
)
def test_targets_carry_their_own_names(words: list[str], names: list[tuple[str, str]]) -> None:
    """Three functions called `intersect` are told apart, in the pictures and in the table."""
    assert _names(words) == names


def test_names_are_never_alike_and_fit_beside_a_line() -> None:
    words = [f"{'x' * 40}{i}:{'y' * 40}{i}" for i in range(12)]
    for each in zip(*_names(words), strict=True):
        assert len(set(each)) == len(words)
    assert max(len(name) for name, _ in _names(words)) <= NAME


@pytest.mark.parametrize("make", [hostile, lambda: case_page(derived(), [], "raycert explain")])
def test_the_page_fits_in_a_browser_and_nothing_runs(
    make: "made_up.Callable[[], str]", tmp_path: Path
) -> None:
    for width, seen in probed(make(), tmp_path).items():
        assert seen["room"] == int(width)
        assert seen["width"] <= seen["room"], "the page scrolls sideways"
        assert seen["outside"] == 0, "text runs out of the page"
        assert seen["drawings"] >= 4
        assert seen["collide"] == 0, "labels lie on one another"
        assert seen["scripts"] == seen["requests"] == 0
