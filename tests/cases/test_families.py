"""The golden families: well named, representable, deterministic, in their tier, and complete."""

from __future__ import annotations

import re
from collections import Counter
from fractions import Fraction
from functools import cache

import pytest

from raycert.cases.case import TIERS, Case, Family
from raycert.cases.families import adopted
from raycert.cases.families.catalog import FAMILIES
from raycert.cases.families.frames import ALIGNED, OBLIQUE, frames_for
from raycert.cases.families.shots import Shot, family
from raycert.cases.families.sketch import (
    ALWAYS,
    MISS,
    Pairs,
    between,
    cylinder,
    later,
    pair,
    spans,
    touch,
)
from raycert.cases.formats import BINARY32, BINARY64, FORMATS, Format
from raycert.cases.lattice import is_lattice
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Ray,
    Slab,
    Solid,
    Sphere,
    Tree,
    Union,
    leaves,
    type_of,
)
from raycert.cases.numbers import Probe
from raycert.cases.numbers import numbers as numbers_of
from raycert.cases.table import cells
from raycert.oracle.corpus.golden import known as exactly
from raycert.oracle.exact.faces import place
from raycert.oracle.exact.faces import touch as touch_of
from raycert.oracle.exact.intervals import expected
from raycert.oracle.exact.trace import trace
from shared.corpus import golden

SLUG = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
MODAL = re.compile(r"\b(should|must|can|could|may|might|shall|will|would|ought|cannot)\b", re.I)
WHOSE = re.compile(r"; ([^;]+ chosen here|numbers as given)(, (axis|z) along [^;]+)?\.$")
PLANE_AND_ROUND = {"half_space", "slab", "infinite_cylinder", "cylinder"}
ADDED = {"sphere", "union", "intersection", "difference"}

by_family = pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
by_format = pytest.mark.parametrize("fmt", FORMATS.values(), ids=FORMATS)


@cache
def rows(family: Family, fmt: Format) -> tuple[Case, ...]:
    return tuple(family.cases(fmt))


def every(fmt: Format) -> list[Case]:
    return [case for family in FAMILIES for case in rows(family, fmt)]


def numbers(case: Case) -> tuple[float, ...]:
    """Return every number of a case."""
    return numbers_of(Probe(case.solid, case.ray))


def shape(solid: Solid) -> str:
    """Return the types of a solid and of all its parts."""
    name = type_of(solid)
    return f"{name}({','.join(map(shape, solid.of))})" if isinstance(solid, Tree) else name


def test_there_are_enough_rows_in_enough_families() -> None:
    assert len(FAMILIES) >= 24
    assert len(every(BINARY64)) >= 2500
    assert len(every(BINARY32)) >= 1500


@pytest.mark.parametrize(("fmt", "least"), [(BINARY64, 1500), (BINARY32, 1000)])
def test_spheres_and_booleans_have_enough_rows(fmt: Format, least: int) -> None:
    count = Counter(type_of(case.solid) for case in every(fmt))
    assert sum(count[kind] for kind in ADDED) >= least
    assert all(count[kind] >= 150 for kind in ADDED), count


def test_the_names_of_families_are_unique_and_plain() -> None:
    names = [family.name for family in FAMILIES]
    assert len(set(names)) == len(names)
    assert all(SLUG.fullmatch(name) for name in names)


@by_family
def test_a_family_states_its_reason(family: Family) -> None:
    assert family.reason.endswith(".")
    assert not MODAL.search(family.reason)


@by_family
@by_format
def test_slugs_are_unique_and_plain(family: Family, fmt: Format) -> None:
    slugs = [case.slug for case in rows(family, fmt)]
    assert slugs or family in adopted.FAMILIES  # what was found in one format is kept in it
    assert len(set(slugs)) == len(slugs)
    assert all(SLUG.fullmatch(slug) for slug in slugs)


@by_family
@by_format
def test_each_why_is_one_short_sentence_of_fact(family: Family, fmt: Format) -> None:
    whys = [case.why for case in rows(family, fmt)]
    assert len(set(whys)) == len(whys)
    for why in whys:
        assert len(why) <= 110, why
        assert why[0].isupper() or why[0].isdigit() or why.startswith("vx"), why
        assert why.endswith("."), why
        assert not why.endswith(".."), why
        assert why.isascii(), why
        assert not MODAL.search(why), why


@by_family
@by_format
def test_every_number_is_one_of_the_format(family: Family, fmt: Format) -> None:
    for case in rows(family, fmt):
        assert all(fmt.holds(x) for x in numbers(case)), case.slug


@by_family
@by_format
def test_no_question_is_asked_twice_in_a_family(family: Family, fmt: Format) -> None:
    spelled = [(shape(case.solid), *(x.hex() for x in numbers(case))) for case in rows(family, fmt)]
    assert len(set(spelled)) == len(spelled)


@by_family
@by_format
def test_a_family_makes_the_same_cases_each_time(family: Family, fmt: Format) -> None:
    again = tuple(family.cases(fmt))
    assert again == rows(family, fmt)
    assert repr(again) == repr(rows(family, fmt))


@by_family
@by_format
def test_a_case_is_on_the_lattice_tier_if_and_only_if_it_is_on_the_lattice(
    family: Family, fmt: Format
) -> None:
    for case in rows(family, fmt):
        assert case.tier in TIERS
        if case.tier != "range":
            assert (case.tier == "lattice") == is_lattice(case.solid, case.ray), case.slug


@by_family
@by_format
def test_known_lists_are_well_formed_and_say_so(family: Family, fmt: Format) -> None:
    for case in rows(family, fmt):
        if case.known is None:
            assert case.source != "construction", case.slug
            continue
        assert case.source != "oracle", case.slug
        last: Fraction | None = Fraction(-1)
        for enter, leave in case.known:
            assert isinstance(enter, int | Fraction), case.slug
            assert last is not None, case.slug
            assert last < enter, case.slug
            assert enter >= 0, case.slug
            assert leave is None or enter <= leave, case.slug
            last = None if leave is None else Fraction(leave)
        assert len(case.known) <= 1 or isinstance(case.solid, Tree), case.slug


@by_format
def test_reported_cases_name_their_source(fmt: Format) -> None:
    for case in every(fmt):
        reported = case.source not in ("oracle", "construction")
        assert reported == ("reported" in case.flags), case.slug


@by_format
def test_reported_cases_say_whose_numbers_they_hold(fmt: Format) -> None:
    for case in every(fmt):
        if "reported" in case.flags:
            assert WHOSE.search(case.why), case.why


@by_format
def test_each_solid_has_each_tier(fmt: Format) -> None:
    found = {(type_of(case.solid), case.tier) for case in every(fmt)}
    assert found == {(kind, tier) for kind in PLANE_AND_ROUND | ADDED for tier in TIERS}


@by_format
def test_every_cell_of_the_case_table_is_taken(fmt: Format) -> None:
    taken = {trace(case.solid, case.ray).rows for case in every(fmt)}
    assert set(cells()) <= taken


@by_format
def test_every_cell_without_an_oblique_ray_has_a_lattice_row(fmt: Format) -> None:
    """Without one means: along the axis or square to it, and not at rest."""
    lattice = {trace(c.solid, c.ray).rows for c in every(fmt) if c.tier == "lattice"}
    along = ("along-inside", "along-outside")
    straight = {
        cell
        for cell in cells()
        if (cell[0] in along and cell[1] != "AE") or (cell[0] not in along and cell[1] == "AE")
    }
    assert straight <= lattice


def test_frames_are_square_and_of_one_length() -> None:
    for frame in (*ALIGNED, *OBLIQUE):
        columns = (frame.lateral, frame.across, frame.axis)
        for i, a in enumerate(columns):
            for j, b in enumerate(columns):
                dot = sum(x * y for x, y in zip(a, b, strict=True))
                assert dot == (frame.stretch**2 if i == j else 0), frame.name


def test_frames_drawn_by_a_name_stay_the_same() -> None:
    assert [frame.name for frame in frames_for("a name", 2, 2)] == [
        frame.name for frame in frames_for("a name", 2, 2)
    ]
    drawn = {frame.name for n in range(200) for frame in frames_for(str(n))}
    assert drawn == {frame.name for frame in (*ALIGNED, *OBLIQUE)}


def test_a_sketch_that_the_format_cannot_hold_is_another_scene_with_no_known_answer() -> None:
    third = Fraction(1, 3)
    for x, known in ((Fraction(1, 4), touch(2)), (third, None)):
        [case] = Shot("s", "W", cylinder(1, 4), (-2, x, 1), (1, 0, 0), touch(2)).cases(BINARY64)
        assert case.known == known
        assert case.source == ("oracle" if known is None else "construction")
        assert case.ray.origin[1] == float(x)


def test_a_frame_adds_its_name_to_slug_and_sentence() -> None:
    shot = Shot("s", "A fact", cylinder(1, 4), (0, 0, 0), (1, 0, 0), frame=ALIGNED[1])
    [case] = shot.cases(BINARY32)
    assert case.slug == "s-on-x"
    assert case.why == "A fact, axis along +x."
    assert case.solid == Cylinder((0, 0, 0), (4, 0, 0), 1)


@pytest.mark.parametrize(
    ("start", "speed", "known"),
    [
        (-2, 2, pair(1, 3)),
        (5, -1, pair(1, 5)),
        (2, 1, pair(0, 2)),
        (4, 1, touch(0)),
        (5, 1, MISS),
        (4, 0, ALWAYS),
        (5, 0, MISS),
    ],
)
def test_between_clips_at_the_start(start: int, speed: int, known: Pairs) -> None:
    assert between(start, speed, 0, 4) == known


def test_a_list_moved_along_its_ray_is_cut_off_at_the_start() -> None:
    known = spans((-5, -3), (-1, 1), (3, None))
    assert later(known, 2) == spans((1, 3), (5, None))
    assert later(known, 3) == spans((0, 0), (2, 4), (6, None))
    assert later(touch(0), -1) == MISS


def test_a_shot_is_moved_and_scaled_with_its_answer() -> None:
    aim = Shot("aim", "at it", cylinder(4, 8), (0, 0, 4), (2, 0, 0), pair(-2, 2))
    assert aim.back(5).but(slug="") == aim.but(slug="", origin=(-10, 0, 4), known=pair(3, 7))
    assert aim.back(1).faster(Fraction(1, 2)).known == pair(0, 6)
    for shot in (aim.back(5), aim.back(1).faster(Fraction(4)), aim.back(3).larger(Fraction(2))):
        [case] = shot.cases(BINARY64)
        assert exactly(shot.known) == trace(case.solid, case.ray).intervals


def test_a_family_says_what_its_table_leaves_out() -> None:
    line = Shot("a", "the wall", cylinder(4, 8), (4, 0, 1), (1, 3, 0), flags=("rim",))
    own = line.but(slug="b", frame=OBLIQUE[0], tier="range")
    made = family("f", "R.", (line, own), "Starts on {}", ("x",), frame=ALIGNED[:2], tier="stiff")
    cases = list(made.cases(BINARY64))
    assert [case.slug for case in cases] == ["a-on-z", "a-on-x", "b-fifths"]
    assert [case.tier for case in cases] == ["stiff", "stiff", "range"]
    assert cases[0].why == "Starts on the wall, axis along +z."
    assert {case.flags for case in cases} == {("x", "rim")}


AXIS = Ray((-8, 4, 3), (4, 0, 0))


@pytest.mark.parametrize(
    ("solid", "ray", "on"),
    [
        (Cylinder((0, 0, 0), (0, 0, 8), 4), AXIS, True),
        (Cylinder((0, 0, 0), (0, 0, 8), 0.5), AXIS, True),
        (Cylinder((0, 0, 0), (0, 0, 8), 5), AXIS, False),
        (Cylinder((0, 0, 0), (0, 0, 6), 4), AXIS, False),
        (Cylinder((0, 0, 0), (0, 4, 8), 4), AXIS, False),
        (Cylinder((0, 0, 0), (0, 0, 8), 0), AXIS, False),
        (Cylinder((0, 0, 0.5), (0, 0, 8.5), 4), AXIS, False),
        (Cylinder((0, 0, 0), (0, 0, 8), 4), Ray((-8, 4, 3), (3, 4, 0)), False),
        (Cylinder((0, 0, 0), (0, 0, 8), 4), Ray((-8, 4, 3), (3, 0, 0)), False),
        (Cylinder((0, 0, 0), (0, 0, 8), 4), Ray((-8, 4, 3), (0, 0, 0)), False),
        (Cylinder((0, 0, 0), (0, 0, 8), 4), Ray((-2047, 4, 3), (4, 0, 0)), True),
        (Cylinder((0, 0, 0), (0, 0, 8), 4), Ray((-2048, 4, 3), (4, 0, 0)), False),
        (Cylinder((0, 0, 0), (0, 0, 8), 4), Ray((-8, 4, 3), (2.0**40, 0, 0)), False),
        (Cylinder((10**12, 0, 0), (10**12, 0, 8), 4), Ray((10**12 - 8, 4, 3), (-1, 0, 0)), True),
        (InfiniteCylinder((0, 0, 0), (0, -2, 0), 1), AXIS, True),
        (Slab((0, 0, 0), (1, 0, 0)), AXIS, True),
        (Slab((0, 0, 0), (1, 1, 0)), AXIS, False),
        (HalfSpace((0, 0, 0), (0, 0, -0.25)), AXIS, True),
        (HalfSpace((0, 0, 0), (0, 1, 1)), AXIS, False),
        (Sphere((0, 0, 3), 4), AXIS, True),
        (Sphere((0, 0, 3), 5), AXIS, False),
        (Sphere((0, 0, 0.5), 4), AXIS, False),
        (Union((Slab((0, 0, 0), (1, 0, 0)),)), AXIS, True),
        (Union((Sphere((0, 0, 3), 4), Sphere((0, 2000, 3), 4))), AXIS, True),
        (Union((Sphere((0, -1000, 3), 4), Sphere((0, 2000, 3), 4))), AXIS, False),
        (Difference((Sphere((0, 0, 3), 4), Union((Sphere((0, 0, 3), 5),)))), AXIS, False),
        (Union((Slab((0, 4, 0), (0, 8, 0)),)), AXIS, False),
        (Union((Slab((0, 8, 0), (0, 4, 0)),)), AXIS, False),
        (Union((Slab((0, 3, 0), (0, 5, 0)),)), AXIS, True),
        (Union((HalfSpace((0, 4, 0), (0, -2, 0)),)), AXIS, False),
        (HalfSpace((0, 4, 0), (0, -2, 0)), AXIS, True),
        (Union((InfiniteCylinder((0, 0, 3), (1, 0, 3), 4),)), AXIS, False),
        (Union((InfiniteCylinder((0, 0, 3), (1, 0, 3), 8),)), AXIS, True),
        (Union((InfiniteCylinder((0, 0, 3), (0, 0, 4), 4),)), AXIS, True),
        (Union((Cylinder((0, 0, 3), (1, 0, 3), 4),)), AXIS, True),
    ],
)
def test_the_lattice_is_what_it_says(solid: Solid, ray: Ray, on: bool) -> None:
    assert is_lattice(solid, ray) is on


@pytest.mark.parametrize("precision", FORMATS)
def test_a_touch_on_the_lattice_is_the_whole_of_its_list(precision: str) -> None:
    """So that keeping or dropping it shows as a pair or none, whatever else is answered."""
    for known in golden(precision).rows:
        if known.tier == "lattice" and any(span.touch for span in known.intervals):
            assert len(known.intervals) == len(known.expected) == 1, known.id


def test_in_a_tree_no_leaf_of_the_lattice_ends_elsewhere_for_who_drops_touches() -> None:
    """There, leave is infinite exactly where the exact one is, whatever the convention."""
    for case in every(BINARY64):
        if case.tier == "lattice" and isinstance(case.solid, Tree):
            for path, leaf in leaves(case.solid):
                for interval in trace(leaf, case.ray).intervals:
                    endless = not interval[1].finite
                    assert not (endless and touch_of(interval, leaf, case.ray)), (case.slug, path)


@by_format
def test_endpoints_name_the_faces_of_all_parts_that_coincide_there(fmt: Format) -> None:
    """In A u A, A n A and the like, every face of one part is the same face of each other."""
    (family,) = (family for family in FAMILIES if family.name == "csg-identical")
    seen = 0
    for case in rows(family, fmt):
        paths = [path for path, _ in leaves(case.solid)]
        for interval in trace(case.solid, case.ray).intervals:
            for t in interval:
                faces = place(t, case.solid, case.ray).faces
                found = {path: {f for f in faces if f.startswith(f"{path}:")} for path in paths}
                sides = [{f.partition(":")[2] for f in named} for named in found.values()]
                assert sides[0], case.slug
                assert all(one == sides[0] for one in sides), case.slug
                seen += 1
    assert seen > 50


@by_format
def test_gaps_below_half_an_ulp_merge_in_the_expected_list(fmt: Format) -> None:
    merged = [c for c in every(fmt) if "merged-by-rounding" in c.flags and len(c.known or ()) == 2]
    assert len(merged) >= 10
    for case in merged:
        exact = trace(case.solid, case.ray).intervals
        assert len(expected(exact, fmt)[1]) == len(exact) - 1, case.slug
