"""The judge: its theorem, its measures, and every reason to refuse an answer."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations_with_replacement, pairwise, product
from math import inf, isinf, nan, nextafter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from raycert.cases.accept import malformed
from raycert.cases.domain import Tolerance
from raycert.cases.formats import BINARY32, BINARY64, Format
from raycert.cases.levels import LEVELS
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Ray,
    Slab,
    Solid,
    Sphere,
    Tree,
    Union,
)
from raycert.cases.strategies import scenes as drawn
from raycert.oracle.exact.intervals import contains
from raycert.oracle.exact.surd import Surd, dyadic, enclose, nearest
from raycert.oracle.judge.levels import LIMIT, MEASURES, Judge, is_convex
from raycert.oracle.judge.moved import LAST_STEP, Step
from shared.grid import leaves, rays, solids

Pairs = list[tuple[float, float]]
ONE, TWO = 8, 10
"""The steps of k = 1 and k = 2."""
formats = st.sampled_from([BINARY64, BINARY32])
grid_scenes = st.tuples(solids, rays)
scenes = st.one_of(grid_scenes, drawn(3, fmt=BINARY32))


@settings(max_examples=300, deadline=None)
@given(scenes, formats)
def test_a_correctly_rounded_answer_has_k_of_1_at_most(
    scene: tuple[Solid, Ray], fmt: Format
) -> None:
    judge = Judge(*scene, fmt)
    assert judge.accepts(judge.expected, ONE, "strict")
    assert judge.accepts(judge.expected, ONE, "squared")
    assert all(judge.holds(level, judge.expected) for level in LEVELS)
    assert judge.forward_error(judge.expected) <= 0.5


@settings(max_examples=300, deadline=None)
@given(scenes, formats, st.lists(st.booleans(), min_size=12, max_size=12))
def test_a_faithful_answer_has_k_of_2_at_most(
    scene: tuple[Solid, Ray], fmt: Format, ups: list[bool]
) -> None:
    judge = Judge(*scene, fmt)
    choice = iter(ups)

    def either(t: Surd) -> float:
        rounded = enclose(t, fmt)
        return rounded.up if next(choice, True) else rounded.down

    answer = [(either(a), either(b)) for a, b in judge.merged]
    if judge.malformed(answer) is None:
        assert judge.accepts(answer, TWO, "strict")
        assert judge.accepts(answer, TWO, "squared")
        assert all(judge.holds(level, answer) for level in LEVELS[:3])
        assert judge.forward_error(answer) <= 1
        assert judge.holds("exact", answer) == (tuple(answer) == judge.expected)


def around(x: float, fmt: Format) -> list[float]:
    """Return x and its neighbours in the format, none negative."""
    if isinf(x):
        return [fmt.largest, inf]
    if fmt is BINARY64:
        below, above = nextafter(x, -inf), nextafter(x, inf)
    else:
        bits = int(fmt.bits(abs(x)), 16)
        above = fmt.from_bits(f"{bits + 1:08x}")
        below = fmt.from_bits(f"{bits - 1:08x}") if bits else -1.0
    return [y for y in (below, x, above) if y >= 0]


def edge_answers(judge: Judge, level: str) -> list[Pairs]:
    """Return answers of one and two pairs from the ends of the lists and their neighbours."""
    ends = [
        t
        for sigma in (-1, 1)
        for interval in judge.moved(LIMIT, MEASURES[level], sigma)  # type: ignore[index]
        for t in interval
    ]
    near = {x for t in ends for x in around(enclose(t, judge.format).nearest, judge.format)}
    numbers = sorted(near | {0.0, 1.0, inf})
    ones = [(a, b) for a, b in combinations_with_replacement(numbers, 2) if not isinf(a)]
    spread = ones[:: max(1, len(ones) // 12)]
    twos = [[a, b] for a, b in product(spread, spread) if a[1] < b[0]]
    return [[], *([one] for one in ones), *twos]


@settings(max_examples=60, deadline=None)
@given(scenes, formats, st.sampled_from(["sound", "stable"]))
def test_the_accept_lists_and_the_exact_judge_agree_at_the_edge(
    scene: tuple[Solid, Ray], fmt: Format, level: str
) -> None:
    judge = Judge(*scene, fmt)
    measure = MEASURES[level]  # type: ignore[index]
    accept = judge.accept(level)  # type: ignore[arg-type]
    inner, outer = (judge.moved(LIMIT, measure, sigma) for sigma in (-1, 1))
    most = judge.most(outer, LIMIT, measure)
    for i, answer in enumerate(edge_answers(judge, level)):
        given_ = tuple((dyadic(a), dyadic(b)) for a, b in answer)
        between = contains(outer, given_) and contains(given_, inner)
        counts = [sum(contains((o,), (pair,)) for pair in given_) for o in outer]
        fits = all(count <= limit for count, limit in zip(counts, most, strict=True))
        assert (accept.fault(answer) is None) == (between and fits), answer
        if i % 25 == 0:
            assert judge.accepts(answer, LIMIT, measure) == between


def to_mpf(t: Surd) -> mpf:
    with mp.workprec(800):
        return (t.x + t.y * mp.sqrt(t.d)) / t.z if t.finite else mpf(inf)


@settings(max_examples=60, deadline=None)
@given(grid_scenes, formats, st.integers(0, 119), st.sampled_from(["strict", "squared"]))
def test_the_backward_error_is_the_least_k_that_accepts(
    scene: tuple[Solid, Ray], fmt: Format, step: int, measure: str
) -> None:
    """Answers are ends of the moved lists, so that every size of k occurs."""
    judge = Judge(*scene, fmt)
    lists = judge.moved(min(step, LAST_STEP), measure, 1)  # type: ignore[arg-type]
    answer = [(nearest(a, fmt), nearest(b, fmt)) for a, b in lists]
    k = judge.backward_error(answer, measure)  # type: ignore[arg-type]
    scan = (
        float(Step.at(i))
        for i in range(LAST_STEP + 1)
        if judge.accepts(answer, i, measure)  # type: ignore[arg-type]
    )
    assert k == (next(scan, inf) if malformed(answer, True) is None else inf)


@given(scenes, formats, st.sampled_from(["strict", "squared"]))
def test_what_a_k_accepts_every_larger_one_does(
    scene: tuple[Solid, Ray], fmt: Format, measure: str
) -> None:
    judge = Judge(*scene, fmt)
    for answer in ([], [(0.0, 1.0)], list(judge.expected), [(1.0, inf)]):
        verdicts = [judge.accepts(answer, i, measure) for i in range(0, 119, 6)]  # type: ignore[arg-type]
        assert verdicts == sorted(verdicts)


CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)
ACROSS = Ray((-3, 0, 1), (1, 0, 0))


@pytest.mark.parametrize(
    ("answer", "reason"),
    [
        ([(nan, 1.0)], "NaN"),
        ([(1.0, nan)], "NaN"),
        ([(-1.0, 1.0)], "negative"),
        ([(-5e-324, 1.0)], "negative"),
        ([(4.0, 2.0)], "enter 4.0 > leave 2.0"),
        ([(inf, inf)], "enter is infinite"),
        ([(-inf, 4.0)], "negative"),
        ([(2.0, 3.0), (3.0, 4.0)], "the leave before it"),
        ([(3.0, 4.0), (1.0, 2.0)], "the leave before it"),
        ([(2.0, 4.0), (2.0, 4.0)], "the leave before it"),
        ([(0.0, inf), (inf, inf)], "infinite"),
    ],
)
def test_what_is_no_list_is_refused_on_every_level(answer: Pairs, reason: str) -> None:
    judge = Judge(CAN, ACROSS, BINARY64)
    assert reason in str(judge.malformed(answer))
    assert not any(judge.holds(level, answer) for level in LEVELS)
    if not isinf(answer[-1][0]):
        assert judge.backward_error(answer, "strict") == inf
        assert judge.forward_error(answer) == inf


@pytest.mark.parametrize(
    "answer", [[], [(-0.0, 1.0)], [(0.0, 0.0)], [(2.0, inf)], [(1, 2), (3, 4)]]
)
def test_what_is_a_list(answer: Pairs) -> None:
    assert malformed(answer) is None


def test_minus_zero_is_zero() -> None:
    judge = Judge(CAN, Ray((0, 0, 1), (1, 0, 0)), BINARY64)
    assert all(judge.holds(level, [(-0.0, 1.0)]) for level in LEVELS)
    assert judge.backward_error([(-0.0, 1.0)], "strict") == 1 / 16


def test_gross_answers_have_no_k() -> None:
    judge = Judge(CAN, ACROSS, BINARY64)
    for answer in ([], [(2.0, inf)], [(0.0, 4.0)], [(2.0, 2.5), (3.5, 4.0)], [(20.0, 40.0)]):
        assert judge.backward_error(answer, "strict") > 2.0**40
        assert not judge.holds("sound", answer)


@pytest.mark.parametrize(
    ("answer", "level"),
    [
        ([(2.0, 4.0)], "exact"),
        ([(nextafter(2.0, inf), 4.0)], "stable"),
        ([(2.0 + 2.0**-47, 4.0)], "stable"),
        ([(2.0 + 2.0**-40, 4.0)], None),
    ],
)
def test_levels_by_hand(answer: Pairs, level: str | None) -> None:
    """2 and 4 are exact, so a faithful answer is the exact one."""
    judge = Judge(CAN, ACROSS, BINARY64)
    granted = [name for name in LEVELS if judge.holds(name, answer)]
    assert granted == list(LEVELS[: LEVELS.index(level) + 1] if level else ())  # type: ignore[arg-type]


def test_sound_is_wider_than_stable_at_a_tangent() -> None:
    """The square of the distance is what the textbook discriminant keeps: d off by sqrt(u)."""
    judge = Judge(CAN, Ray((-3, 1 - 2.0**-50, 1), (1, 0, 0)), BINARY64)
    touch = [(3.0, 3.0)]
    assert judge.backward_error(touch, "squared") <= 1
    far = Judge(CAN, Ray((-(2.0**30), 0.5, 1), (1, 0, 0)), BINARY64)
    ((enter, leave),) = far.expected
    shrunk = [(enter + 0.25, leave - 0.25)]
    assert far.holds("sound", shrunk)
    assert not far.holds("stable", shrunk)


def surd_ulps(x: float, t: Surd, fmt: Format) -> float:
    """Return |x - t| in units of the last place of t, by mpmath."""
    with mp.workprec(800):
        true = to_mpf(t)
        e = mp.frexp(true)[1] - 1 if true else fmt.least
        return float(abs(mpf(x) - true) / mpf(2) ** max(e + 1 - fmt.precision, fmt.least))


@settings(max_examples=50, deadline=None)
@given(scenes, formats, st.lists(st.integers(-9, 9), min_size=4, max_size=4))
def test_the_forward_error_is_the_distance_in_ulps(
    scene: tuple[Solid, Ray], fmt: Format, moves: list[int]
) -> None:
    judge = Judge(*scene, fmt)
    if len(judge.expected) != 1:
        return
    ((a, b),), ((enter, leave),) = judge.expected, judge.exact
    answer = [(step(a, moves[0], fmt), step(b, moves[1], fmt))]
    if malformed(answer) is not None or (isinf(b) and answer[0][1] != b):
        return
    ends = zip(answer[0], (enter, leave), strict=True)
    truth = max((surd_ulps(x, t, fmt) for x, t in ends if not isinf(x)), default=0.0)
    assert judge.forward_error(answer) == pytest.approx(truth, rel=1e-6)


def step(x: float, count: int, fmt: Format) -> float:
    """Return the number `count` places above x; 0 and infinity stay."""
    if x == 0 or isinf(x):
        return x
    return fmt.from_bits(f"{int(fmt.bits(x), 16) + count:0{fmt.digits}x}")


def test_the_forward_error_near_zero_counts_subnormals() -> None:
    """At and below the least number the unit is the least number, as `math.ulp` has it."""
    judge = Judge(HalfSpace((0, 0, 0), (0, 0, 1)), Ray((0, 0, 0), (0, 0, 1)), BINARY64)
    assert judge.exact[0][0].sign() == 0
    assert judge.forward_error([(0.0, 5e-324)]) == 1
    tie = Judge(HalfSpace((0, 0, 5e-324), (0, 0, 1)), Ray((0, 0, 0), (0, 0, 2)), BINARY64)
    assert tie.expected == ((0.0, 0.0),)
    assert tie.forward_error([(0.0, 0.0)]) == 0.5
    assert tie.forward_error([(0.0, 1e-323)]) == 1.5


def test_pairs_that_touch_after_rounding_merge() -> None:
    gap = 2.0**-60
    tree = Union((Slab((1, 0, 0), (2, 0, 0)), Slab((2 + 2.0**-51, 0, 0), (3, 0, 0))))
    wide = Judge(tree, Ray((0, 0, 0), (1, 0, 0)), BINARY64)
    assert wide.expected == ((1.0, 2.0), (2 + 2.0**-51, 3.0))
    # 1 - gap/2 and 1 + gap/2 from the start: both round to 1
    tree = Union((Slab((0, 0, 0), (gap, 0, 0)), Slab((2 * gap, 0, 0), (1, 0, 0))))
    near = Judge(tree, Ray((-1, 0, 0), (1, 0, 0)), BINARY64)
    assert len(near.exact) == 2
    assert near.expected == ((1.0, 2.0),)
    assert near.forward_error([(1.0, 2.0)]) <= 0.5
    assert near.forward_error([(1.0, 1.0), (1.5, 2.0)]) == inf
    assert all(near.holds(level, [(1.0, 2.0)]) for level in LEVELS)
    assert not near.holds("faithful", [(1.0, 1.0), (nextafter(1.0, inf), 2.0)])
    assert near.holds("stable", [(1.0, 1.0), (nextafter(1.0, inf), 2.0)])


@pytest.mark.parametrize("fmt", [BINARY64, BINARY32])
def test_an_endpoint_beyond_the_format_is_infinite(fmt: Format) -> None:
    far, slow = 2.0 ** (fmt.overflow - 24), 2.0**-30
    solid = HalfSpace((0, 0, far), (0, 0, -1))  # z >= far
    judge = Judge(solid, Ray((0, 0, 0), (0, 0, slow)), fmt, "range")
    assert judge.expected == ((inf, inf),)
    assert judge.malformed([(inf, inf)]) is None
    assert all(judge.holds(level, [(inf, inf)]) for level in LEVELS)
    assert judge.forward_error([(inf, inf)]) == 0
    assert judge.holds("faithful", [(fmt.largest, inf)])
    assert not judge.holds("exact", [(fmt.largest, inf)])
    assert judge.forward_error([(fmt.largest, inf)]) == inf
    assert not judge.holds("sound", [(1.0, inf)])
    below = Judge(HalfSpace((0, 0, far), (0, 0, 1)), Ray((0, 0, 0), (0, 0, slow)), fmt, "range")
    assert below.expected == ((0.0, inf),)
    assert "infinite" in str(below.malformed([(inf, inf)]))


@pytest.mark.parametrize(
    ("ray", "endless", "ending"),
    [
        (Ray((0, 0, 1), (0, 0, 1)), [(0.0, inf)], [(0.0, 1e300)]),
        (Ray((-2, 0, 1), (1, 0, 0)), [(1.0, inf)], [(1.0, 3.0)]),
    ],
)
def test_on_the_lattice_leave_is_infinite_exactly_where_it_is(
    ray: Ray, endless: Pairs, ending: Pairs
) -> None:
    tube = InfiniteCylinder((0, 0, 0), (0, 0, 2), 1)
    judge = Judge(tube, ray, BINARY64, "lattice")
    right, wrong = (endless, ending) if judge.exact[0][1].finite is False else (ending, endless)
    assert judge.malformed(right) is None
    assert judge.malformed([]) is None
    assert "the exact one is not" in str(judge.malformed(wrong))
    assert Judge(tube, ray, BINARY64, "generic").malformed(wrong) is None


def test_how_many_pairs_may_lie_in_an_outer_interval() -> None:
    """One for what is convex; for a tree the leaves whose own outer list meets it."""
    ray = Ray((-9, 0, 1), (1, 0, 0))
    far = Slab((20, 0, 0), (21, 0, 0))
    for solid, truth in (
        (CAN, (1,)),
        (Intersection((CAN, Sphere((0, 0, 0), 3))), (1,)),
        (Union((CAN, Sphere((0, 0, 0), 3), far)), (2, 1)),
        (Difference((Slab((-2, 0, 0), (2, 0, 0)), CAN)), (2, 2)),
        (Difference((CAN, far)), (1,)),
    ):
        judge = Judge(solid, ray, BINARY64)
        for measure in MEASURES.values():
            assert judge.most(judge.moved(LIMIT, measure, 1), LIMIT, measure) == truth


def test_more_pairs_than_leaves_are_refused() -> None:
    judge = Judge(CAN, ACROSS, BINARY64)
    split = [(2.0, 3.0), (nextafter(3.0, inf), 4.0)]
    assert "nothing contains" in str(judge.accept("stable").fault(split))
    # a chord shorter than the move of its ends: nothing is asked inside, and one pair is allowed
    graze = Judge(CAN, Ray((-3, 1 - 2.0**-52, 1), (1, 0, 0)), BINARY64)
    points = [(3.0, 3.0), (nextafter(3.0, inf), nextafter(3.0, inf))]
    assert judge.accept("stable").inner
    assert graze.accept("stable").inner == ()
    for level in MEASURES:
        assert graze.holds(level, points[:1])
        assert not graze.holds(level, points)
        assert "at most 1" in str(graze.accept(level).fault(points))


@given(solids)
def test_convex_means_no_union_and_no_difference(solid: Solid) -> None:
    def kinds(part: Solid) -> list[type]:
        return [type(part), *(k for p in getattr(part, "of", ()) for k in kinds(p))]

    assert is_convex(solid) == (not {Union, Difference} & set(kinds(solid)))
    assert is_convex(solid) or isinstance(solid, Tree)


@given(leaves, rays, st.sampled_from([0.125, 2.0**-30]))
def test_a_declared_tolerance_forgives_that_much(leaf: Solid, ray: Ray, by: float) -> None:
    strict, lax = Judge(leaf, ray, BINARY64), Judge(leaf, ray, BINARY64, "generic", Tolerance(by))
    for answer in ([], [(0.0, 1.0)], strict.expected):
        assert lax.backward_error(answer, "strict") <= strict.backward_error(answer, "strict")
    inner, outer = (lax.moved(0, "strict", sigma) for sigma in (-1, 1))
    for one, two in pairwise((inner, strict.exact, outer)):
        assert len(one) <= len(two)


def test_a_tolerance_by_hand() -> None:
    answer: Sequence[tuple[float, float]] = [(2.0625, 3.9375)]
    assert not Judge(CAN, ACROSS, BINARY64).holds("sound", answer)
    assert Judge(CAN, ACROSS, BINARY64, "generic", Tolerance(0.0625)).holds("stable", answer)
    assert not Judge(CAN, ACROSS, BINARY64, "generic", Tolerance(0.06)).holds("sound", answer)
    assert Fraction(0.0625) * 16 == 1


def test_a_relative_tolerance_by_hand() -> None:
    """1/16 of the radius at the wall, 1/16 of the thickness at a cap: 1 and 4."""
    down = Ray((0, 0, -2), (0, 0, 1))
    near = Judge(CAN, ACROSS, BINARY64, "generic", Tolerance(0.0, 0.0625))
    assert near.holds("stable", [(2.0625, 3.9375)])
    assert not near.holds("sound", [(2.07, 3.9375)])
    big = Judge(
        Cylinder((0, 0, 0), (0, 0, 64), 32), down, BINARY64, "generic", Tolerance(0.0, 0.0625)
    )
    assert big.holds("stable", [(6.0, 62.0)])
    assert not big.holds("sound", [(6.1, 62.0)])
