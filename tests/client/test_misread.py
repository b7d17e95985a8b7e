"""An adapter that misreads a question is told what it does, and what is not told fits no better.

The adapters are those that people write: around the reference tracer, with the mistake in them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from raycert.cases.model import SOLIDS, HalfSpace, Ray, Solid
from raycert.cases.protocol import FROM_INSIDE, FromInside, Hello, Pairs, Reply, first
from raycert.oracle.client.adapter import adapter_faults, misread
from raycert.oracle.client.dialogue import Outcome
from raycert.oracle.client.misread import MISREADINGS
from raycert.oracle.client.smoke import Fallen, easy, fallen
from raycert.reference.tracer import intersect

Adapter = Callable[[Any, Ray], Any]
LEAVES = ("half_space", "sphere", "infinite_cylinder", "slab", "cylinder")
AXIAL = ("cylinder", "infinite_cylinder", "slab")


def outcomes(adapter: Adapter, hello: Hello) -> dict[str, Outcome]:
    """Return what an adapter answers to the easy cases: lists, or first hits."""
    replies = {}
    for case in easy(hello):
        said = adapter(case.solid, case.ray)
        field = "first" if hello.answers == "first" else "intervals"
        told: Any = said if field == "first" else tuple(said)
        replies[case.question.id] = Reply("", **{field: told})
    return dict(replies)


def told(adapter: Adapter, *solids: str, **hello: Any) -> list[Fallen]:
    said = Hello("adapter", solids=solids, **hello)
    return fallen(easy(said), outcomes(adapter, said), said)


def moved(x: tuple[float, ...], y: tuple[float, ...], k: float = 1.0) -> Any:
    return tuple(a + k * b for a, b in zip(x, y, strict=True))


def no_center(solid: Any, ray: Ray) -> Pairs:
    return intersect(replace(solid, center=(0, 0, 0)), ray)


def no_p(solid: Any, ray: Ray) -> Pairs:
    return intersect(replace(solid, p=(0, 0, 0), q=moved(solid.q, solid.p, -1)), ray)


def always_z(solid: Any, ray: Ray) -> Pairs:
    height = math.dist(solid.p, solid.q)
    return intersect(replace(solid, q=moved(solid.p, (0, 0, height))), ray)


def q_is_the_axis(solid: Any, ray: Ray) -> Pairs:
    return intersect(replace(solid, q=moved(solid.p, solid.q)), ray)


def exchanged(solid: Any, ray: Ray) -> Pairs:
    w = moved(solid.p, solid.q, -1)
    return intersect(replace(solid, q=moved(solid.p, w)), ray)


def half_the_height(solid: Any, ray: Ray) -> Pairs:
    """Give half of |q - p| to a library that wants a height, centred."""
    w = moved(solid.q, solid.p, -1)
    middle = moved(solid.p, w, 0.5)
    return intersect(replace(solid, p=moved(middle, w, -0.25), q=moved(middle, w, 0.25)), ray)


def p_in_the_middle(solid: Any, ray: Ray) -> Pairs:
    w = moved(solid.q, solid.p, -1)
    return intersect(replace(solid, p=moved(solid.p, w, -0.5), q=moved(solid.p, w, 0.5)), ray)


def radians(solid: Any, ray: Ray) -> Pairs:
    """Turn z about z x w by an angle in radians, which a library takes for degrees."""
    x, y, z = moved(solid.q, solid.p, -1)
    size, flat = math.hypot(x, y, z), math.hypot(x, y) or 1.0
    angle = math.radians(math.acos(z / size))
    sine = math.sin(angle)
    w = (size * sine * x / flat, size * sine * y / flat, size * math.cos(angle))
    return intersect(replace(solid, q=moved(solid.p, w)), ray)


def radius(factor: float) -> Adapter:
    return lambda solid, ray: intersect(replace(solid, radius=factor * solid.radius), ray)


def inward(solid: HalfSpace, ray: Ray) -> Pairs:
    nx, ny, nz = solid.normal
    return intersect(HalfSpace(solid.point, (-nx, -ny, -nz)), ray)


def not_divided(solid: HalfSpace, ray: Ray) -> Pairs:
    """A plane of a unit normal and the offset point . normal."""
    n = solid.normal
    size, offset = math.hypot(*n), sum(a * b for a, b in zip(solid.point, n, strict=True))
    return intersect(HalfSpace(moved((0, 0, 0), n, offset / size), n), ray)


def mirrored(solid: Any, ray: Ray) -> Pairs:
    def turned(x: tuple[float, ...]) -> Any:
        return (x[0], -x[1], x[2])

    return intersect(solid, Ray(turned(ray.origin), turned(ray.direction)))


def y_is_up(solid: Any, ray: Ray) -> Pairs:
    def turned(x: tuple[float, ...]) -> Any:
        return (x[0], x[2], x[1])

    return intersect(solid, Ray(turned(ray.origin), turned(ray.direction)))


def lengths(solid: Solid, ray: Ray) -> Pairs:
    return unit(solid, ray, lambda t, size: t)


def unit(solid: Solid, ray: Ray, back: Callable[[float, float], float]) -> Any:
    size = math.hypot(*ray.direction)
    pairs = intersect(solid, Ray(ray.origin, moved((0, 0, 0), ray.direction, 1 / size)))
    return [(back(a, size), back(b, size)) for a, b in pairs]


def second_point(solid: Solid, ray: Ray) -> Pairs:
    return intersect(solid, Ray(ray.origin, moved(ray.direction, ray.origin, -1)))


def segment(solid: Solid, ray: Ray) -> Any:
    return [(a, min(b, 1.0)) for a, b in intersect(solid, ray) if a <= 1]


def line(solid: Solid, ray: Ray) -> Any:
    early = Ray(moved(ray.origin, ray.direction, -50), ray.direction)
    return [(a - 50 if a else -math.inf, b - 50) for a, b in intersect(solid, early)]


PLANTED: list[tuple[str, Adapter, tuple[str, ...]]] = [
    ("ignores `center`", no_center, ("sphere",)),
    ("ignores `p`: its axis runs from the origin along q - p", no_p, AXIAL),
    ("its axis is always z", always_z, AXIAL),
    ("takes `q` for the axis", q_is_the_axis, AXIAL),
    ("p and q exchanged", exchanged, ("cylinder", "slab")),
    ("half the height, about the middle", half_the_height, ("cylinder", "slab")),
    ("p in the middle", p_in_the_middle, ("cylinder", "slab")),
    ("radians where degrees are asked, from p", radians, AXIAL),
    ("takes `radius` for the diameter", radius(0.5), ("sphere", "cylinder", "infinite_cylinder")),
    ("doubles `radius`", radius(2.0), ("sphere", "cylinder", "infinite_cylinder")),
    ("normal turned inward", inward, ("half_space",)),
    ("divide it by |normal|", not_divided, ("half_space",)),
    ("sign of y wrong", mirrored, LEAVES),
    ("exchanges y and z", y_is_up, LEAVES),
    ("answers t * |direction|: lengths", lengths, LEAVES),
    ("takes `direction` for a second point", second_point, LEAVES),
    ("segment from t = 0 to 1", segment, LEAVES),
    ("does not cut the line at t = 0", line, LEAVES),
]
"""What is said of an adapter, the adapter, and the types of solid of which it is said."""


@pytest.mark.parametrize(
    ("says", "adapter", "solid"),
    [
        pytest.param(says, adapter, solid, id=f"{adapter.__name__}-{solid}-{says[:12]}")
        for says, adapter, solids in PLANTED
        for solid in solids
    ],
)
def test_a_misreading_is_named_for_a_solid_declared_alone(
    says: str, adapter: Adapter, solid: str
) -> None:
    [found] = told(adapter, solid)
    assert found.solid == solid
    assert any(says in text for text in found.misread), found
    assert len(found.misread) <= 2, found.misread


def test_each_solid_is_told_of_its_own() -> None:
    """Spheres are misread, and nothing else."""

    def adapter(solid: Any, ray: Ray) -> Pairs:
        return no_center(solid, ray) if hasattr(solid, "center") else intersect(solid, ray)

    hello = Hello("adapter")
    given = outcomes(adapter, hello)
    assert adapter_faults(easy(hello), given, hello) == []
    [found] = fallen(easy(hello), given, hello)
    assert misread([found]) == ["sphere: it ignores `center`."]
    assert found.form(hello) == {
        "solid": "sphere",
        "failed": 5,
        "of": 7,
        "first": {
            "id": "smoke/sphere-through",
            "solid": {"type": "sphere", "center": [1.0, 2.0, 3.0], "radius": 2.0},
            "ray": {"origin": [-7.0, 2.0, 3.0], "direction": [4.0, 0.0, 0.0]},
            "answer": "[]",
            "expected": "[[1.5, 2.5]]",
        },
        "misread": "it ignores `center`",
    }


def test_a_right_answer_speaks_against_a_misreading() -> None:
    def sometimes(solid: Any, ray: Ray) -> Pairs:
        return intersect(solid, ray) if ray.origin[1] == 2 else no_center(solid, ray)

    [found] = told(sometimes, "sphere")
    assert found.misread == ()


def test_no_misreading_is_told_of_a_tracer_that_is_merely_wrong() -> None:
    def no_caps(solid: Any, ray: Ray) -> Pairs:
        return intersect(SOLIDS["infinite_cylinder"](solid.p, solid.q, solid.radius), ray)

    [found] = told(no_caps, "cylinder")
    assert (found.failed > 2, found.misread) == (True, ())
    assert told(lambda solid, ray: intersect(solid, ray), *SOLIDS) == []


@pytest.mark.parametrize("true", FROM_INSIDE)
@pytest.mark.parametrize("declared", FROM_INSIDE)
def test_a_start_inside_is_told_from_a_negative_answer(
    declared: FromInside, true: FromInside
) -> None:
    def adapter(solid: Solid, ray: Ray) -> float | None:
        return first(intersect(solid, ray), true)

    def negative(solid: Solid, ray: Ray) -> float | None:
        return first(line(solid, ray), "zero")

    says = {"answers": "first", "from_inside": declared}
    found = told(adapter, "cylinder", **says)
    named = [text for each in found for text in each.misread]
    assert any(f'"from_inside": "{true}"' in text for text in named) == (declared != true)
    for each in told(negative, "cylinder", **says):
        assert not any("from_inside" in text for text in each.misread)
    if declared == "zero":
        [each] = told(negative, "cylinder", **says)
        assert "does not cut the line at t = 0" in " ".join(each.misread)


def test_a_miss_of_minus_one_is_told() -> None:
    def adapter(solid: Solid, ray: Ray) -> float:
        t = first(intersect(solid, ray), "zero")
        return -1.0 if t is None else t

    [found] = told(adapter, "cylinder", answers="first")
    assert found.misread == ("answers a miss with -1.0: a miss is an empty list, or no hit",)


def test_the_texts_differ() -> None:
    texts = [misreading.text for misreading in MISREADINGS]
    assert len(set(texts)) == len(texts)
