"""From one case to harder ones: the moves of the directed search.

A move takes a probe and dice, and returns probes of numbers of the format, in any number. Most are
ladders: steps that grow by powers of two, since nobody knows at which size a formula gives way.
`walk` looks for a place where the exact answer changes its form, a double root, a rim, faces
that coincide, and returns what lies on both sides of it, ever nearer. First come the changes that
moves and the shrinker are made of: the same probe elsewhere, in another size, turned.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from math import isinf, ldexp
from typing import Any, TypeVar

from raycert.cases.dice import Dice
from raycert.cases.formats import BINARY64, Format
from raycert.cases.model import (
    FIELDS,
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Intersection,
    Leaf,
    Ray,
    Refused,
    Slab,
    Solid,
    Sphere,
    Tree,
    Union,
    Vector,
    axis,
    leaves,
    map_leaves,
)
from raycert.cases.numbers import (
    Probe,
    at,
    is_usual,
    near,
    numbers,
    ordinal,
    rounded,
    with_number,
    with_numbers,
)
from raycert.cases.vectors import along, minus, plus, times
from raycert.oracle.exact.rounding import nearest
from raycert.oracle.exact.surd import Surd
from raycert.oracle.exact.trace import trace

T = TypeVar("T")
Move = Callable[[Probe, Dice, Format], list[Probe]]
Form = tuple[tuple[str, ...], int]
ZERO: Vector = (0.0, 0.0, 0.0)


def of_format(probes: Iterable[Probe | None], fmt: Format) -> list[Probe]:
    """Return the probes there are, in numbers of the format."""
    exact = [rounded(probe, fmt) for probe in probes if probe is not None]
    return [probe for probe in exact if probe is not None]


def axis_of(leaf: Leaf) -> Vector:
    w = axis(leaf)
    return w if w and any(w) else (0.0, 0.0, 1.0)


def changed(
    probe: Probe,
    point: Callable[[Vector], Vector] = lambda x: x,
    radius: Callable[[float], float] = lambda x: x,
    normal: Callable[[Vector], Vector] = lambda x: x,
    direction: Callable[[Vector], Vector] = lambda x: x,
) -> Probe | None:
    """Return the probe with every point, radius, ... changed; None where that makes no solid."""

    def leaf(old: Leaf) -> Leaf:
        values: dict[str, Any] = {
            name: changes.get(name, point)(getattr(old, name)) for name in FIELDS[type(old)]
        }
        return type(old)(**values)

    changes: dict[str, Callable[[Any], Any]] = {"radius": radius, "normal": normal}
    try:
        ray = Ray(point(probe.ray.origin), direction(probe.ray.direction))
        return Probe(map_leaves(leaf, probe.solid), ray)
    except Refused:
        return None


def shifted(probe: Probe, step: Vector) -> Probe | None:
    return changed(probe, lambda x: plus(x, step))


def scaled(probe: Probe, factor: float) -> Probe | None:
    """Return the probe with all lengths times a factor; the direction keeps its own."""
    return changed(probe, lambda x: times(factor, x), lambda r: r * factor)


def hastened(probe: Probe, factor: float) -> Probe | None:
    return changed(probe, direction=lambda v: times(factor, v))


def turned(probe: Probe, turn: Callable[[Vector], Vector]) -> Probe | None:
    return changed(probe, turn, normal=turn, direction=turn)


def pick(dice: Dice, items: Sequence[T]) -> T:
    return items[dice.integer(0, len(items) - 1)]


def form(probe: Probe) -> Form:
    """Return the form of the exact answer: the rows taken, with comparisons, and how many pairs."""
    answer = trace(probe.solid, probe.ray)
    return answer.rows, len(answer.intervals)


def walk(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Move one number until the answer changes its form; return both sides, ever nearer."""
    values = numbers(probe)
    slot = dice.integer(0, len(values) - 1)
    x = values[slot]
    far = pick(dice, (0.0, -x, 2 * x, x + 1, x - 1, x / 2, pick(dice, values)))
    goal = with_number(probe, slot, fmt.nearest(far))
    if goal is None or form(goal) == form(probe):
        return of_format([goal], fmt)
    low, high, path = ordinal(x, fmt), ordinal(fmt.nearest(far), fmt), [goal]
    first = form(probe)
    while abs(high - low) > 1:
        middle = (low + high) // 2
        step = with_number(probe, slot, at(middle, fmt))
        if step is None or not is_usual(step, fmt):
            break
        path.append(step)
        if form(step) == first:
            low = middle
        else:
            high = middle
    return path[:2] + path[2:-4:5] + path[-4:]


def nudge(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Move single numbers by a few steps of the format."""
    values, others = numbers(probe), list[Probe | None]()
    for _ in range(6):
        slot = dice.integer(0, len(values) - 1)
        steps = pick(dice, (1, -1, 1, -1, 2, -2, 3, -5, 16, -1024))
        others.append(with_number(probe, slot, near(values[slot], steps, fmt)))
    return of_format(others, fmt)


def simplify(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Make numbers 0, whole, or equal: what random numbers never are."""
    values = numbers(probe)
    others = [with_numbers(probe, [float(round(x)) for x in values])]
    for _ in range(6):
        slot = dice.integer(0, len(values) - 1)
        x = pick(dice, (0.0, 1.0, -1.0, float(round(values[slot])), pick(dice, values)))
        others.append(with_number(probe, slot, x))
    return of_format(others, fmt)


def retreat(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Start farther back, farther on, inside, behind."""
    ray = probe.ray
    backs = (0.5, 1.0, -1.0, 3.0, ldexp(1.0, dice.integer(4, 45)), -ldexp(1.0, dice.integer(2, 30)))
    rays = [Ray(along(ray.origin, -back, ray.direction), ray.direction) for back in backs]
    return of_format([Probe(probe.solid, other) for other in rays], fmt)


def settle(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Start on a face, and a little beside it."""
    ends = [end for pair in trace(probe.solid, probe.ray).intervals for end in pair if end.finite]
    others = []
    for end in ends[:3]:
        t = _float(end)
        for beside in (0.0, ldexp(1.0, -dice.integer(4, 50)), -ldexp(1.0, -dice.integer(4, 50))):
            origin = along(probe.ray.origin, t + beside, probe.ray.direction)
            others.append(Probe(probe.solid, Ray(origin, probe.ray.direction)))
    return of_format(others, fmt)


def turn(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Run along an axis, almost so, across it, the other way, or not at all."""
    solid, ray = probe
    w = axis_of(pick(dice, [leaf for _, leaf in leaves(solid)]))
    lean = ldexp(1.0, -dice.integer(2, 50))
    across = pick(dice, ((-w[1], w[0], 0.0), (0.0, -w[2], w[1]), (w[2], 0.0, -w[0])))
    others: list[Vector] = [
        w,
        along(w, lean, across),
        across,
        along(across, lean, w),
        times(-1.0, ray.direction),
        pick(dice, (ZERO, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, -1.0))),
    ]
    return of_format([Probe(solid, Ray(ray.origin, direction)) for direction in others], fmt)


def rescale(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Make the probe, the direction, or one radius much larger or smaller; move it far away."""
    most = 40 if fmt.precision == 53 else 12
    n, size = dice.integer(3, most), pick(dice, (1, -1))
    factor, away = ldexp(1.0, size * n), ldexp(1.0, dice.integer(2, most))
    step = (away, -away, away / 2)
    others = [scaled(probe, factor), hastened(probe, factor), shifted(probe, step)]
    return of_format([*others, _thinner(probe, dice, factor)], fmt)


def overflow(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Make all so large or small that a formula over- or underflows: cases of the range tier."""
    most = fmt.overflow - 30
    n = pick(dice, (dice.integer(most // 4, most), -dice.integer(most // 4, -fmt.least - 8)))
    factor = ldexp(1.0, n)
    return of_format([scaled(probe, factor), hastened(probe, factor)], fmt)


def build(probe: Probe, dice: Dice, fmt: Format) -> list[Probe]:
    """Make Booleans of a solid with itself, beside itself, and with what shares a face with it."""
    solid, ray = probe
    every = [leaf for _, leaf in leaves(solid)]
    leaf = pick(dice, every)
    w = axis_of(leaf)
    beside = shifted(probe, w)
    base: Vector | None = getattr(leaf, "point", getattr(leaf, "q", None))
    other: Solid = HalfSpace(base, w) if base else Sphere(ray.origin, 1.0)
    parts = [solid, beside.solid if beside else solid, other]
    one, two = pick(dice, parts), pick(dice, parts)
    trees: list[Solid] = [
        pick(dice, TREES)((one, two)),
        Difference((solid, other)),
        Union((solid, parts[1], other)),
    ]
    return of_format([Probe(tree, ray) for tree in trees], fmt) if len(every) <= 4 else []


def on_lattice(dice: Dice) -> Probe:
    """Return a leaf and a ray of the lattice, drawn anew: touches of every kind are common."""
    p, origin = _whole(dice), _whole(dice)
    w, radius = _along(dice), float(dice.integer(1, 2))
    q = plus(p, w)
    choice: tuple[Leaf, ...] = (
        HalfSpace(p, w),
        Sphere(p, radius),
        Slab(p, q),
        InfiniteCylinder(p, q, radius),
        Cylinder(p, q, radius),
    )
    return Probe(pick(dice, choice), Ray(origin, _along(dice)))


def _whole(dice: Dice) -> Vector:
    return tuple(float(dice.integer(-2, 2)) for _ in range(3))  # type: ignore[return-value]


def _along(dice: Dice) -> Vector:
    length = pick(dice, (1.0, -1.0, 2.0, -2.0))
    return pick(dice, ((length, 0.0, 0.0), (0.0, length, 0.0), (0.0, 0.0, length)))


TREES: tuple[type[Tree], ...] = (Union, Intersection, Difference)
MOVES: tuple[Move, ...] = (
    walk, walk, walk, nudge, simplify, retreat, settle, turn, rescale, build,
)  # fmt: skip


def _thinner(probe: Probe, dice: Dice, factor: float) -> Probe | None:
    """Return the probe with radii, or lengths along the axes, times a factor."""
    if dice.integer(0, 1):
        return changed(probe, radius=lambda r: r * factor)

    def longer(leaf: Leaf) -> Leaf:
        if isinstance(leaf, HalfSpace | Sphere):
            return leaf
        return replace(leaf, q=along(leaf.p, factor, minus(leaf.q, leaf.p)))

    try:
        return Probe(map_leaves(longer, probe.solid), probe.ray)
    except Refused:
        return None


def _float(end: Surd) -> float:
    t = nearest(end, BINARY64)
    return 0.0 if isinf(t) else t
