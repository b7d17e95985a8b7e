"""Witness by symbols: SymPy derives each condition along the ray, and isolates its real roots.

The distance to an axis is found by minimisation, as in Problem 1 (a), and not written down. The
derived conditions are evaluated in SymPy's rationals, factored over the integers, and the real
roots of all factors are isolated together in disjoint rational intervals. Two roots are one if and
only if they are the same root of the same irreducible factor, so no radical is ever compared.
A condition has one sign on each gap; at a root of a factor that does not divide it, it has the sign
of the gaps beside.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from raycert.cases.model import (
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    Vector,
    leaves,
)
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import Surd
from raycert.oracle.witness.algebra import Vec, combine, runs
from raycert.oracle.witness.testimony import Testimony, compared

T, S_AXIS, RADIUS = sp.symbols("t s r", real=True)


def named(name: str) -> Vec:
    return Vec(*sp.symbols(f"{name}1:4", real=True))


def distance_squared(x: Vec, p: Vec, w: Vec) -> sp.Expr:
    """Return the least squared distance of x from a point p + s w of the line, by minimisation."""
    away = p + S_AXIS * w - x
    square = away @ away
    (nearest,) = sp.solve(sp.diff(square, S_AXIS), S_AXIS)
    return sp.together(square.subs(S_AXIS, nearest))


@cache
def rod() -> sp.Poly:
    """Return |w|^2 (d^2 - r^2) along the ray, in t: derived, not written down."""
    y, v, w = (named(name) for name in "yvw")
    origin = Vec(*(sp.Integer(0),) * 3)
    condition = (w @ w) * (distance_squared(y + T * v, origin, w) - RADIUS**2)
    return sp.Poly(sp.cancel(condition), T)


@cache
def globe() -> sp.Poly:
    """Return |x - center|^2 - r^2 along the ray, in t, with y for u - center."""
    x = named("y") + T * named("v")
    return sp.Poly(sp.expand(x @ x - RADIUS**2), T)


@cache
def plane() -> sp.Poly:
    """Return (x - point) . w along the ray, in t, with y for u - point."""
    return sp.Poly(sp.expand((named("y") + T * named("v")) @ named("w")), T)


Factor = tuple[int, ...]
"""An irreducible integer polynomial, primitive, the first coefficient positive."""
Name = tuple[Factor, int]
"""A real number: an irreducible factor, and which of its real roots."""
ZERO: Name = ((1, 0), 0)


@dataclass(frozen=True, slots=True)
class FactoredCondition:
    """A polynomial that is <= 0 inside, and its irreducible factors."""

    polynomial: sp.Poly
    factors: frozenset[Factor]

    @classmethod
    def of(cls, coefficients: list[Any]) -> FactoredCondition:
        """Return the condition with these rational coefficients, the highest power first."""
        _, polynomial = sp.Poly(coefficients, T, domain=sp.QQ).clear_denoms(convert=True)
        if polynomial.degree() < 1:
            return cls(polynomial, frozenset())
        _, factors = polynomial.factor_list()
        return cls(polynomial, frozenset(_coefficients(f) for f, _ in factors))


def _coefficients(polynomial: sp.Poly) -> Factor:
    sign = 1 if polynomial.LC() > 0 else -1
    return tuple(sign * int(c) for c in polynomial.all_coeffs())


def witness(solid: Solid, ray: Ray, answer: Intervals) -> Testimony:
    """Agree with the answer whose every end is the root found, by factor and index."""
    line = RealLine.of({id(leaf): list(_conditions(leaf, ray)) for _, leaf in leaves(solid)})
    return compared(
        runs(combine(solid, line.cells, len(line.names)), line.names),
        answer,
        show,
        lambda mine, t: None if mine == _name(t) else "is another",
        "every end is the same root of the same irreducible polynomial",
    )


def _name(t: Surd) -> Name | None:
    return (t.polynomial(), t.root()) if t.finite else None


def show(name: Name | None) -> str:
    """Return a number for people: its polynomial and which root, or a fraction."""
    if name is None:
        return "inf"
    factor, root = name
    if len(factor) == 2:
        return str(sp.Rational(-factor[1], factor[0]))
    return f"root {root} of {sp.Poly(factor, T).as_expr()}"


@dataclass(frozen=True, slots=True)
class RealLine:
    """The points of t >= 0 and a rational in the gap after each, for the conditions of leaves."""

    conditions: dict[int, list[FactoredCondition]]
    names: tuple[Name, ...]
    boxes: tuple[tuple[Any, Any], ...]
    samples: tuple[Any, ...]

    @classmethod
    def of(cls, conditions: dict[int, list[FactoredCondition]]) -> RealLine:
        """Return the line, 0 being a point even where no condition has a root there."""
        factors = sorted({f for c in conditions.values() for x in c for f in x.factors} | {ZERO[0]})
        isolated = sp.intervals([sp.Poly(f, T, domain=sp.ZZ) for f in factors], strict=True)
        seen: dict[Factor, int] = {}
        names, boxes = [], []
        for box, which in isolated:
            (index,) = which
            factor = factors[index]
            seen[factor] = seen.get(factor, -1) + 1
            names.append((factor, seen[factor]))
            boxes.append(box)
        start = names.index(ZERO)
        nexts = [box[0] for box in boxes[start + 1 :]] + [boxes[-1][1] + 2]
        samples = [(a[1] + b) / 2 for a, b in zip(boxes[start:], nexts, strict=True)]
        return cls(conditions, tuple(names[start:]), tuple(boxes[start:]), tuple(samples))

    def cells(self, leaf: Leaf) -> int:
        """Return the cells in which every condition of a leaf holds."""
        held = -1
        for condition in self.conditions[id(leaf)]:
            cells = 0
            beside = False
            for i, (name, sample) in enumerate(zip(self.names, self.samples, strict=True)):
                after = bool(condition.polynomial.eval(sample) <= 0)
                at = name[0] in condition.factors or after
                if i and name[0] not in condition.factors and beside != after:
                    raise ArithmeticError(f"{condition.polynomial} changes sign without a root")
                cells |= (at << 2 * i) | (after << 2 * i + 1)
                beside = after
            held &= cells
        return held


@cache
def _function(condition: Callable[[], sp.Poly]) -> Callable[..., list[Any]]:
    """Return a derived condition as a function of y, v, w and r to its coefficients."""
    names = [part for name in "yvw" for part in named(name).parts]
    # The derived polynomial, compiled: only +, -, * and integer powers, exact in any ring.
    function: Callable[..., list[Any]] = sp.lambdify(
        [*names, RADIUS], condition().all_coeffs(), modules=[{}], cse=True
    )
    return function


def _conditions(leaf: Leaf, ray: Ray) -> Iterator[FactoredCondition]:
    """Yield the conditions of a leaf, each <= 0 inside."""
    u, v = _exact(ray.origin), _exact(ray.direction)

    def condition(derived: Callable[[], sp.Poly], start: Vector, w: Vec, r: float = 0.0) -> Any:
        y, radius = u - _exact(start), sp.QQ(*r.as_integer_ratio())
        return FactoredCondition.of(_function(derived)(*y.parts, *v.parts, *w.parts, radius))

    match leaf:
        case HalfSpace():
            yield condition(plane, leaf.point, _exact(leaf.normal))
            return
        case Sphere():
            yield condition(globe, leaf.center, v, leaf.radius)
            return
    w = _exact(leaf.q) - _exact(leaf.p)
    if not isinstance(leaf, InfiniteCylinder):
        yield condition(plane, leaf.p, -w)
        yield condition(plane, leaf.q, w)
    if not isinstance(leaf, Slab):
        yield condition(rod, leaf.p, w, leaf.radius)


def _exact(vector: Vector) -> Vec:
    return Vec.of(vector, lambda x: sp.QQ(*x.as_integer_ratio()))
