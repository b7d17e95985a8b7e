"""JSON forms: there and back in every spelling, and every refusal names its field."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.formats import BINARY32, BINARY64, FORMATS, SPELLINGS, Format, Spelling
from raycert.cases.forms import DEEPEST, read_ray, read_solid, write_ray, write_solid
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Ray,
    Refused,
    Slab,
    Solid,
    Sphere,
    Union,
)

QUICK = settings(deadline=None, max_examples=60)
EACH = pytest.mark.parametrize("spelling", SPELLINGS)
BOTH = pytest.mark.parametrize("fmt", FORMATS.values(), ids=FORMATS)


def reals(fmt: Format) -> st.SearchStrategy[float]:
    width = 64 if fmt is BINARY64 else 32
    return st.floats(allow_nan=False, allow_infinity=False, width=width)


def rays(fmt: Format) -> st.SearchStrategy[Ray]:
    points = st.tuples(*[reals(fmt)] * 3)
    return st.builds(Ray, points, points)


def solids(fmt: Format) -> st.SearchStrategy[Solid]:
    points = st.tuples(*[reals(fmt)] * 3)
    normals = points.filter(lambda n: n != (0, 0, 0))
    axes = st.tuples(points, points).filter(lambda pq: pq[0] != pq[1])
    radii = reals(fmt).map(abs)
    leaves: st.SearchStrategy[Solid] = st.one_of(
        st.builds(HalfSpace, points, normals),
        st.builds(Sphere, points, radii),
        st.builds(lambda pq, r: InfiniteCylinder(*pq, r), axes, radii),
        axes.map(lambda pq: Slab(*pq)),
        st.builds(lambda pq, r: Cylinder(*pq, r), axes, radii),
    )

    def trees(parts: st.SearchStrategy[Solid]) -> st.SearchStrategy[Solid]:
        of = st.lists(parts, min_size=1, max_size=3).map(tuple)
        return st.sampled_from([Union, Intersection, Difference]).flatmap(
            lambda kind: of.map(lambda some: kind(some))
        )

    return st.recursive(leaves, trees, max_leaves=6)


@BOTH
@EACH
@QUICK
@given(data=st.data())
def test_a_solid_survives_its_form(fmt: Format, spelling: Spelling, data: st.DataObject):
    solid = data.draw(solids(fmt))
    text = json.dumps(write_solid(solid, spelling, fmt), allow_nan=False)
    back = read_solid(json.loads(text), "solid", spelling, fmt)
    assert back == solid
    assert json.dumps(write_solid(back, spelling, fmt)) == text  # -0 too


@BOTH
@EACH
@QUICK
@given(data=st.data())
def test_a_ray_survives_its_form(fmt: Format, spelling: Spelling, data: st.DataObject):
    ray = data.draw(rays(fmt))
    text = json.dumps(write_ray(ray, spelling, fmt), allow_nan=False)
    back = read_ray(json.loads(text), "ray", spelling, fmt)
    assert back == ray
    assert json.dumps(write_ray(back, spelling, fmt)) == text


def test_the_form_is_the_one_of_the_protocol():
    can = Cylinder((0, 0, 0), (0, 0, 2), 1)
    assert json.dumps(write_solid(Union((can,)))) == (
        '{"type": "union", "of": [{"type": "cylinder", "p": [0.0, 0.0, 0.0], '
        '"q": [0.0, 0.0, 2.0], "radius": 1.0}]}'
    )
    assert write_ray(Ray((-3, 0, 1), (1, 0, 0)), "hex") == {
        "origin": ["-0x1.8000000000000p+1", "0x0.0p+0", "0x1.0000000000000p+0"],
        "direction": ["0x1.0000000000000p+0", "0x0.0p+0", "0x0.0p+0"],
    }
    assert write_solid(Sphere((0, 0, 0), 1), "bits", BINARY32)["radius"] == "3f800000"


ZERO, X = [0, 0, 0], [1, 0, 0]
GOOD: dict[str, dict[str, Any]] = {
    "half_space": {"type": "half_space", "point": ZERO, "normal": X},
    "sphere": {"type": "sphere", "center": ZERO, "radius": 1},
    "infinite_cylinder": {"type": "infinite_cylinder", "p": ZERO, "q": X, "radius": 1},
    "slab": {"type": "slab", "p": ZERO, "q": X},
    "cylinder": {"type": "cylinder", "p": ZERO, "q": X, "radius": 1},
}
GOOD |= {
    kind: {"type": kind, "of": [GOOD["sphere"], GOOD["cylinder"]]}
    for kind in ("union", "intersection", "difference")
}


@pytest.mark.parametrize("kind", GOOD)
def test_each_good_form_is_read(kind: str):
    assert json.loads(json.dumps(write_solid(read_solid(GOOD[kind])))) == GOOD[kind]


BAD: list[tuple[Any, str, str]] = [
    (None, "solid", "not an object"),
    ([], "solid", "not an object"),
    ("sphere", "solid", "not an object"),
    ({}, "solid.type", "not one of"),
    ({"type": "cone"}, "solid.type", "'cone'"),
    ({"type": ["sphere"]}, "solid.type", "not one of"),
    ({"type": None}, "solid.type", "not one of"),
    (GOOD["slab"] | {"q": ZERO}, "solid.q", "same point as p"),
    (GOOD["slab"] | {"q": [-0.0, 0, 0]}, "solid.q", "same point as p"),
    (GOOD["infinite_cylinder"] | {"q": ZERO}, "solid.q", "same point as p"),
    (GOOD["cylinder"] | {"q": ZERO}, "solid.q", "same point as p"),
    (GOOD["half_space"] | {"normal": ZERO}, "solid.normal", "is zero"),
    (GOOD["half_space"] | {"normal": [0, -0.0, 0]}, "solid.normal", "is zero"),
    (GOOD["sphere"] | {"name": "x"}, "solid.name", "not a field"),
    (GOOD["slab"] | {"radius": 1}, "solid.radius", "not a field"),
    (GOOD["union"] | {"of": []}, "solid.of", "one or more"),
    (GOOD["union"] | {"of": GOOD["sphere"]}, "solid.of", "one or more"),
    (GOOD["union"] | {"of": None}, "solid.of", "one or more"),
    (GOOD["union"] | {"of": [1]}, "solid.of[0]", "not an object"),
]
for kind in ("sphere", "infinite_cylinder", "cylinder"):
    for radius, reason in [
        (-1, "negative"),
        (-5e-324, "negative"),
        (math.nan, "NaN"),
        (math.inf, "infinite"),
        (10**400, "beyond binary64"),
        ("1", "not a number"),
        (True, "not a number"),
        (None, "not a number"),
        ([1], "not a number"),
    ]:
        BAD.append((GOOD[kind] | {"radius": radius}, "solid.radius", reason))
for kind, name in [
    ("half_space", "point"),
    ("half_space", "normal"),
    ("sphere", "center"),
    ("infinite_cylinder", "p"),
    ("slab", "q"),
    ("cylinder", "p"),
    ("cylinder", "q"),
]:
    for value, at, reason in [
        ([1, 2], "", "has 2 numbers"),
        ([1, 2, 3, 4], "", "has 4 numbers"),
        ([], "", "has 0 numbers"),
        (7, "", "not a list"),
        (None, "", "not a list"),
        ("123", "", "not a list"),
        ({"x": 1, "y": 2, "z": 3}, "", "not a list"),
        ([1, math.nan, 3], "[1]", "NaN"),
        ([1, 2, -math.inf], "[2]", "infinite"),
        ([None, 2, 3], "[0]", "not a number"),
        ([1, [2], 3], "[1]", "not a number"),
    ]:
        BAD.append((GOOD[kind] | {name: value}, f"solid.{name}{at}", reason))
for good in GOOD.values():
    for name in good:
        if name != "type":
            form = {key: value for key, value in good.items() if key != name}
            BAD.append((form, f"solid.{name}", "is missing"))


@pytest.mark.parametrize(("form", "path", "reason"), BAD)
def test_a_bad_solid_is_refused_by_path(form: Any, path: str, reason: str):
    with pytest.raises(Refused) as caught:
        read_solid(form)
    assert caught.value.path == path
    assert reason in caught.value.reason
    assert str(caught.value) == f"{path}: {caught.value.reason}"


@pytest.mark.parametrize(("form", "path", "reason"), BAD)
def test_a_bad_part_is_refused_by_its_path_in_the_tree(form: Any, path: str, reason: str):
    tree = {"type": "difference", "of": [GOOD["slab"], {"type": "union", "of": [form]}]}
    with pytest.raises(Refused) as caught:
        read_solid(tree)
    assert caught.value.path == path.replace("solid", "solid.of[1].of[0]", 1)
    assert reason in caught.value.reason


@pytest.mark.parametrize(
    ("form", "path", "reason"),
    [
        (None, "ray", "not an object"),
        ({"origin": ZERO}, "ray.direction", "is missing"),
        ({"direction": ZERO}, "ray.origin", "is missing"),
        ({"origin": ZERO, "direction": X, "t": 1}, "ray.t", "not a field"),
        ({"origin": ZERO, "direction": X, "type": "ray"}, "ray.type", "not a field"),
        ({"origin": [0, 0], "direction": X}, "ray.origin", "has 2 numbers"),
        ({"origin": ZERO, "direction": [0, 0, math.nan]}, "ray.direction[2]", "NaN"),
        ({"origin": [math.inf, 0, 0], "direction": X}, "ray.origin[0]", "infinite"),
    ],
)
def test_a_bad_ray_is_refused_by_path(form: Any, path: str, reason: str):
    with pytest.raises(Refused) as caught:
        read_ray(form)
    assert caught.value.path == path
    assert reason in caught.value.reason


def test_the_zero_direction_is_a_ray():
    assert read_ray({"origin": ZERO, "direction": ZERO}) == Ray((0, 0, 0), (0, 0, 0))


@pytest.mark.parametrize(
    ("value", "spelling", "reason"),
    [
        (1.0, "hex", "not a string"),
        ("one", "hex", "invalid"),
        ("nan", "hex", "NaN"),
        ("-inf", "hex", "infinite"),
        (None, "hex", "infinite"),
        ("0x1p2000", "hex", ""),
        ("3ff", "bits", "16 hexadecimal digits"),
        ("3ff0 0000 0000  ", "bits", "16 hexadecimal digits"),
        ("7ff8000000000000", "bits", "NaN"),
        ("7ff0000000000000", "bits", "infinite"),
    ],
)
def test_a_bad_spelling_is_refused_by_path(value: object, spelling: Spelling, reason: str):
    good = write_solid(Sphere((0, 0, 0), 1), spelling)
    with pytest.raises(Refused) as caught:
        read_solid(good | {"radius": value}, "solid", spelling)
    assert caught.value.path == "solid.radius"
    assert reason in caught.value.reason
    with pytest.raises(Refused) as caught:
        read_solid(good | {"center": [*good["center"][:2], value]}, "solid", spelling)
    assert caught.value.path == "solid.center[2]"


def test_binary32_refuses_what_it_does_not_hold():
    form = {"type": "sphere", "center": [0, 0, 0.1], "radius": 1}
    with pytest.raises(Refused, match=r"solid\.center\[2\]: is not a binary32 number: 0\.1"):
        read_solid(form, "solid", "decimal", BINARY32)
    assert read_solid(form) == Sphere((0, 0, 0.1), 1)


def nested(depth: int) -> dict[str, Any]:
    form = GOOD["sphere"]
    for _ in range(depth):
        form = {"type": "union", "of": [form]}
    return form


def test_a_tree_may_be_deep_but_not_without_end():
    read_solid(nested(DEEPEST))
    with pytest.raises(Refused, match="nested more than"):
        read_solid(nested(DEEPEST + 1))


def test_the_path_of_a_very_deep_field_is_short_enough_to_read() -> None:
    ball: dict[str, object] = {"type": "sphere", "center": [0, 0, 0], "radius": -1}
    for _ in range(150):
        ball = {"type": "union", "of": [ball]}
    with pytest.raises(Refused) as caught:
        read_solid(ball)
    assert len(str(caught.value)) < 300
    assert str(caught.value).startswith("solid.of[0].of[0]")
    assert ".radius: is negative" in str(caught.value)
