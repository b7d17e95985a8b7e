"""Witness by symbols, on one case: isolated real roots of the polynomials that SymPy derived.

The derived conditions are evaluated in SymPy's rationals, factored over the integers, and the real
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

from sympy import QQ, ZZ, Poly, Rational, intervals, lambdify

from raycert.cases.model import (
    Cylinder,
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
from raycert.oracle.witness.cells import combine, runs
from raycert.oracle.witness.symbols_conditions import RADIUS, T, Vec, globe, plane, rod
from raycert.oracle.witness.verdict import Verdict, lengths_differ

Exact = tuple[Any, Any, Any]
"""Three of SymPy's rationals."""
Factor = tuple[int, ...]
"""An irreducible integer polynomial, primitive, the first coefficient positive."""
Name = tuple[Factor, int]
"""A real number: an irreducible factor, and which of its real roots."""
ZERO: Name = ((1, 0), 0)


@dataclass(frozen=True, slots=True)
class Condition:
    """A polynomial that is <= 0 inside, and its irreducible factors."""

    polynomial: Poly
    factors: frozenset[Factor]

    @classmethod
    def of(cls, coefficients: list[Any]) -> Condition:
        """Return the condition with these rational coefficients, the highest power first."""
        _, polynomial = Poly(coefficients, T, domain=QQ).clear_denoms(convert=True)
        if polynomial.degree() < 1:
            return cls(polynomial, frozenset())
        _, factors = polynomial.factor_list()
        return cls(polynomial, frozenset(_coefficients(f) for f, _ in factors))


def _coefficients(polynomial: Poly) -> Factor:
    sign = 1 if polynomial.LC() > 0 else -1
    return tuple(sign * int(c) for c in polynomial.all_coeffs())


def witness(solid: Solid, ray: Ray, answer: Intervals) -> Verdict:
    """Agree with the answer whose every end is the root found, by factor and index."""
    line = Line.of({id(leaf): list(_conditions(leaf, ray)) for _, leaf in leaves(solid)})
    points = len(line.names)
    found = runs(combine(solid, line.cells, points), points)
    text = "[" + ", ".join(f"[{line.show(a)}, {line.show(b)}]" for a, b in found) + "]"
    if len(found) != len(answer):
        return Verdict("disagreed", text, lengths_differ(len(found), len(answer)))
    for number, (pair, ends) in enumerate(zip(found, answer, strict=True)):
        for side, mine, t in zip(("enter", "leave"), pair, ends, strict=True):
            if line.name(mine) != _name(t):
                return Verdict("disagreed", text, f"the {side} of interval {number} is another")
    return Verdict("agreed", text, "every end is the same root of the same irreducible polynomial")


def _name(t: Surd) -> Name | None:
    return (t.polynomial(), t.root()) if t.finite else None


@dataclass(frozen=True, slots=True)
class Line:
    """The points of t >= 0 and a rational in the gap after each, for the conditions of leaves."""

    conditions: dict[int, list[Condition]]
    names: tuple[Name, ...]
    boxes: tuple[tuple[Any, Any], ...]
    samples: tuple[Any, ...]

    @classmethod
    def of(cls, conditions: dict[int, list[Condition]]) -> Line:
        """Return the line, 0 being a point even where no condition has a root there."""
        factors = sorted({f for c in conditions.values() for x in c for f in x.factors} | {ZERO[0]})
        isolated = intervals([Poly(f, T, domain=ZZ) for f in factors], strict=True)
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

    def name(self, index: int | None) -> Name | None:
        """Return the number at a point; None for infinity."""
        return None if index is None else self.names[index]

    def show(self, index: int | None) -> str:
        """Return a point for people: its polynomial and which root, or a fraction."""
        if index is None:
            return "inf"
        factor, root = self.names[index]
        if len(factor) == 2:
            return str(Rational(-factor[1], factor[0]))
        return f"root {root} of {Poly(factor, T).as_expr()}"


@cache
def _function(condition: Callable[[], Poly]) -> Callable[..., list[Any]]:
    """Return a derived condition as a function of y, v, w and r to its coefficients."""
    names = [part for name in "yvw" for part in Vec.named(name).parts]
    # The derived polynomial, compiled: only +, -, * and integer powers, exact in any ring.
    function: Callable[..., list[Any]] = lambdify(
        [*names, RADIUS], condition().all_coeffs(), modules=[{}], cse=True
    )
    return function


def _conditions(leaf: Leaf, ray: Ray) -> Iterator[Condition]:
    """Yield the conditions of a leaf, each <= 0 inside."""
    u, v = _exact(ray.origin), _exact(ray.direction)

    def condition(
        derived: Callable[[], Poly], start: Vector, w: Exact, r: float = 0.0
    ) -> Condition:
        y = _minus(u, _exact(start))
        return Condition.of(_function(derived)(*y, *v, *w, QQ(*r.as_integer_ratio())))

    match leaf:
        case HalfSpace():
            yield condition(plane, leaf.point, _exact(leaf.normal))
            return
        case Sphere():
            yield condition(globe, leaf.center, v, leaf.radius)
            return
    p, q = _exact(leaf.p), _exact(leaf.q)
    if isinstance(leaf, Slab | Cylinder):
        yield condition(plane, leaf.p, _minus(p, q))
        yield condition(plane, leaf.q, _minus(q, p))
    if isinstance(leaf, InfiniteCylinder | Cylinder):
        yield condition(rod, leaf.p, _minus(q, p), leaf.radius)


def _exact(vector: Vector) -> Exact:
    x, y, z = (QQ(*number.as_integer_ratio()) for number in vector)
    return x, y, z


def _minus(a: Exact, b: Exact) -> Exact:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]
