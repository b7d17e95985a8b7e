"""What an implementation is for: the quantities of a case, what a domain holds, and its words."""

from __future__ import annotations

from fractions import Fraction
from math import inf, isqrt, nan
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raycert.cases.domain import (
    EVERYWHERE,
    Domain,
    Tolerance,
    quantities,
    read_domain,
    read_tolerance,
    short,
)
from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Ray,
    Refused,
    Slab,
    Solid,
    Sphere,
    Union,
    leaves,
)
from raycert.cases.strategies import scenes

AT_1 = Ray((1, 0, 0), (0, 3, 4))
FLOOR = HalfSpace((0, 0, 1e9), (0, 0, 1e9))


def length(*x: Fraction) -> Fraction:
    """Return |x| where it is rational, else N(x) as the contract has it."""
    square = sum(part * part for part in x)
    if not square:
        return Fraction(0)
    root = Fraction(isqrt(square.numerator), isqrt(square.denominator))
    if root * root == square:
        return root
    e = (square.numerator.bit_length() - square.denominator.bit_length()) // 2 - 64
    four, two = Fraction(4) ** e, Fraction(2) ** e
    return (isqrt(int(square / four // 1)) + 1) * two


def apart(x: Any, y: Any) -> Fraction:
    return length(*(Fraction(a) - Fraction(b) for a, b in zip(x, y, strict=True)))


def expected(solid: Solid, ray: Ray) -> dict[str, tuple[Fraction, Fraction]]:
    """Return the least and the most of each quantity, by the contract's table."""
    rest = (0, 0, 0)
    found: dict[str, list[Fraction]] = {"direction": [apart(ray.direction, rest)]}
    for _, leaf in leaves(solid):
        sizes = []
        places: list[Any] = []
        match leaf:
            case Sphere(center, radius):
                sizes, places = [Fraction(radius)], [center]
            case InfiniteCylinder(p, q, radius):
                sizes, places = [Fraction(radius)], [p, q]
            case Slab(p, q):
                sizes, places = [apart(q, p)], [p, q]
            case Cylinder(p, q, radius):
                sizes, places = [apart(q, p), Fraction(radius)], [p, q]
        sizes = [size for size in sizes if size]
        if sizes:
            least = min(sizes)
            found.setdefault("size", []).extend(sizes)
            found.setdefault("distance", []).append(apart(ray.origin, places[0]) / least)
            largest = max(abs(Fraction(x)) for place in places for x in place)
            found.setdefault("offset", []).append(largest / least)
            found.setdefault("aspect", []).append(max(sizes) / least)
    if not any(found["direction"]):
        del found["direction"]
    return {
        name: (min(some) if name == "size" else max(some), max(some))
        for name, some in found.items()
    }


@given(scenes())
def test_quantities_are_those_of_the_contract(scene: Any) -> None:
    solid, ray = scene[:2]
    assert quantities(solid, ray).spans() == expected(solid, ray)


def test_quantities_by_hand() -> None:
    can = Cylinder((4, 0, 0), (4, 0, 8), 2)
    found = quantities(Union((can, FLOOR, Sphere((0, 0, 0), 16))), AT_1)
    assert [float(x) for x in (found.direction, *found.size)] == [5, 2, 16]  # type: ignore[arg-type, misc]
    assert [float(x) for x in found[2:]] == [1.5, 4, 4]  # type: ignore[arg-type]
    assert quantities(FLOOR, AT_1)[1:] == (None,) * 4
    assert quantities(FLOOR, Ray((0, 0, 0), (0, 0, 0))).direction is None
    assert quantities(Sphere((5, 0, 0), 0), AT_1).size is None


@pytest.mark.parametrize(
    ("domain", "holds"),
    [
        (Domain(), True),
        (Domain(direction=(5, 5)), True),
        (Domain(direction=(5.0000001, None)), False),
        (Domain(direction=(None, 4.9)), False),
        (Domain(size=(2, 8)), True),
        (Domain(size=(2.1, None)), False),
        (Domain(size=(None, 7.9)), False),
        (Domain(distance=1.5), True),
        (Domain(distance=1.4), False),
        (Domain(offset=4), True),
        (Domain(offset=3.9), False),
        (Domain(aspect=4), True),
        (Domain(aspect=3.9), False),
        (Domain((1, 9), (1, 9), 2, 5, 3.9), False),
    ],
)
def test_a_bound_shuts_out_what_lies_beyond_it(domain: Domain, holds: bool) -> None:
    """Of a can 8 high at 4, of radius 2; what is met exactly is held."""
    can = Cylinder((4, 0, 0), (4, 0, 8), 2)
    assert domain.holds(quantities(can, AT_1)) == holds


BOUNDS = st.none() | st.floats(1e-300, 1e300)
PAIRS = st.tuples(BOUNDS, BOUNDS).filter(lambda x: None in x or x[0] <= x[1])  # type: ignore[operator]
DOMAINS = st.builds(Domain, PAIRS, PAIRS, BOUNDS, BOUNDS, BOUNDS)


@given(DOMAINS)
def test_a_domain_survives_its_form(domain: Domain) -> None:
    assert read_domain(domain.form()) == domain
    assert bool(domain) == bool(domain.form()) == bool(domain.words())
    for number in (x for pair in domain.bounds() for x in pair[1:] if x is not None):
        assert short(number) in domain.words()


def test_words() -> None:
    assert EVERYWHERE.words() == ""
    whole = Domain((1e-3, None), (1e-4, 1e4), 1e6, 64, 2.0**20)
    assert whole.words() == (
        "starts within 1e6 sizes, sizes 1e-4 to 1e4, directions from 1e-3 long, "
        "coordinates within 64 sizes, aspects up to 2^20"
    )


@given(st.floats(1e-300, 1e300))
def test_short_loses_nothing(number: float) -> None:
    text = short(number)
    assert (2.0 ** int(text[2:]) if text.startswith("2^") else float(text)) == number


@pytest.mark.parametrize(
    ("form", "says"),
    [
        ([], "domain: is not an object of bounds"),
        ({"radius": 1}, "domain.radius: is not a quantity"),
        ({"size": 1}, r"domain.size: is not \[low, high\]"),
        ({"size": [1, 2, 3]}, r"domain.size: is not \[low, high\]"),
        ({"size": [2, 1]}, "domain.size: has its low bound above the high one"),
        ({"size": [0, 1]}, r"domain.size\[0\]: is not a number > 0"),
        ({"distance": "far"}, "domain.distance: is not a number"),
        ({"distance": -1}, "domain.distance: is not a number > 0"),
        ({"distance": inf}, "domain.distance: is infinite"),
        ({"aspect": nan}, "domain.aspect: is NaN"),
        ({"offset": True}, "domain.offset: is not a number"),
    ],
)
def test_what_is_no_domain_is_refused_with_its_place(form: Any, says: str) -> None:
    with pytest.raises(Refused, match=says):
        read_domain(form)


def test_tolerances() -> None:
    assert read_tolerance(0.5) == Tolerance(0.5)
    assert read_tolerance({"relative": 1e-3}) == Tolerance(0.0, 1e-3)
    assert read_tolerance(Tolerance(1, 2).form()) == Tolerance(1, 2)
    assert Tolerance(0.5).form() == 0.5
    assert Tolerance(1e-3, 1e-4).words() == "1e-3 and 1e-4 of the size"
    assert not Tolerance()
    for form in ({"size": 1}, {"relative": -1}, {"absolute": "1"}, -1, nan, "0", True):
        with pytest.raises(Refused, match="tolerance"):
            read_tolerance(form)
