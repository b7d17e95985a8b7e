"""What SymPy proves: the derivation's formulas, equal to the oracle's; the case tables, complete.

A statement is an equation written as text and executed: both sides are evaluated in components,
and their difference is shown to be the zero polynomial modulo h.h = 1, where h is the unit vector
along the axis. `a @ b` is the scalar product, `a ^ b` the vector product. The oracle's forms are
those of its own code (`raycert.oracle.exact.leaf`), run on symbols.

That the tables are complete and exclusive is proved by satisfiability: each quantity has three
atoms, one for each sign, of which exactly one holds, and what the quantities have to do with each
other is stated as axioms, each a consequence of the derivation.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import combinations
from types import SimpleNamespace
from typing import Any

import sympy as sp
from sympy.logic.boolalg import Boolean

from raycert.cases.table import HALF_SPACE, HOLDS, PROBLEM_1, PROBLEM_2, PROBLEM_3, Row
from raycert.oracle.exact.leaf import ball, caps, half_space, wall
from raycert.oracle.witness.symbols import RADIUS, S_AXIS, T, globe, named, plane, rod

LEGEND = (
    "x, u, v, p, q, r: a point, the ray u + t v, the axis and the radius",
    "y = u - p, w = q - p = l h with h.h = 1, n = (p - q)/|p - q| = -h",
    "vbar = v x h, ybar = y x h; S: the square root of the discriminant",
    "D(s) = |p + s h - x|^2, with its derivatives dD, ddD and its least value Dmin at s0",
    "F, G, H: the conditions derived here for an infinite cylinder, a sphere about p and a plane",
    "wall, ball, cap_p, cap_q, half, roots, cross_p, cross_q: what the oracle's code finds:",
    "wall.a t^2 + 2 wall.b t + wall.c <= 0, cap_p.c + cap_p.b t <= 0, and so on",
)
"""What the names in the statements stand for."""


@dataclass(frozen=True, slots=True)
class Statement:
    """A claim in the derivation's terms, and whether SymPy proved it."""

    title: str
    text: str
    proved: bool


class _Number:
    """A symbol that passes for a float where the oracle asks a number for its integer ratio."""

    def __init__(self, value: Any) -> None:
        self.value = value

    def as_integer_ratio(self) -> tuple[_Number, int]:
        return self, 1

    def __lshift__(self, bits: int) -> Any:
        assert bits == 0  # the unit is 1, so nothing is ever shifted
        return self.value


@cache
def _names() -> dict[str, Any]:
    """Return what the texts of the statements may name."""
    u, v, p, x, h, a, b = (named(name) for name in ("u", "v", "p", "x", "h", "a", "b"))
    big, root, r = sp.symbols("l S r", positive=True)
    w, y = big * h, u - p
    q, away = p + w, p + S_AXIS * h - x
    known = {"u": u, "v": v, "p": p, "q": q, "x": x, "h": h, "a": a, "b": b, "w": w, "y": y}
    known |= {"n": -h, "r": r, "l": big, "S": root, "t": T, "s": S_AXIS}
    known |= {"vbar": v ^ h, "ybar": y ^ h, "D": away @ away}
    slope = sp.diff(known["D"], S_AXIS)
    # Solved with h.h = 1 put in, as the derivation does: the slope is 2 s - 2 (x - p).h.
    (least,) = sp.solve(slope.subs(h.z**2, 1 - h.x**2 - h.y**2).expand(), S_AXIS)
    known |= {"dD": slope, "ddD": sp.diff(slope, S_AXIS), "s0": least}
    known["Dmin"] = known["D"].subs(S_AXIS, least)
    swap = dict(zip(named("y").parts + named("w").parts, y.parts + w.parts, strict=True))
    for name, poly in (("F", rod()), ("G", globe()), ("H", plane())):
        known[name] = poly.as_expr().subs(RADIUS, r).subs(swap, simultaneous=True)
    return known | _oracle_names(known)


def _oracle_names(known: dict[str, Any]) -> dict[str, Any]:
    """Return what the oracle's code makes of namespaces that pass for its grid and its leaves.

    The grid's unit is 1, and S the root of what `surd` takes it of.
    """

    def surd(x: Any, y: Any, d: Any, z: Any) -> Any:
        return (x + y * known["S"]) / z if d != 0 else x / z

    u, v, p, q, w = (known[name].parts for name in "uvpqw")
    grid: Any = SimpleNamespace(u=u, v=v, point=lambda x: x, scalar=lambda x: x, surd=surd)
    axial: Any = SimpleNamespace(p=p, q=q, radius=known["r"])
    sphere: Any = SimpleNamespace(center=p, radius=known["r"])
    half: Any = SimpleNamespace(point=p, normal=tuple(map(_Number, w)))
    quadric, (low, high) = wall(axial, grid), caps(axial, grid)
    names: dict[str, Any] = {"wall": quadric, "roots": quadric.roots(grid, quadric.disc)}
    names |= {"ball": ball(sphere, grid), "half": half_space(half, grid)}
    names |= {"cap_p": low, "cross_p": low.crossing(grid)}
    return names | {"cap_q": high, "cross_q": high.crossing(grid)}


PROOFS: tuple[tuple[str, str], ...] = (
    ("Lagrange's identity, the tip of 1 (b)", "(a @ b)**2 + (a ^ b) @ (a ^ b) = (a @ a) * (b @ b)"),
    ("1 (a) the slope of D(s) = |p + s h - x|^2", "dD = 2*s - 2*((x - p) @ h)"),
    ("1 (a) is zero at", "s0 = (x - p) @ h"),
    ("1 (a) which is a minimum", "ddD = 2"),
    ("1 (a) the squared distance", "Dmin = (x - p) @ (x - p) - ((x - p) @ h)**2"),
    ("1 (a) by Lagrange", "Dmin = ((x - p) ^ h) @ ((x - p) ^ h)"),
    ("1 (c) the witness's derived condition F",
     "F = l**2 * (((y + t*v) ^ h) @ ((y + t*v) ^ h) - r**2)"),
    ("1 (c) the quadratic",
     "F = l**2 * (t**2*(vbar @ vbar) + 2*t*(vbar @ ybar) + ybar @ ybar - r**2)"),
    ("1 (c) the discriminant",
     "(vbar @ ybar)**2 - (ybar @ ybar - r**2)*(vbar @ vbar)"
     " = r**2*(vbar @ vbar) - (vbar ^ ybar) @ (vbar ^ ybar)"),
    ("1 (c) vbar and ybar are square to the axis",
     "(vbar ^ ybar) @ (vbar ^ ybar) = ((v ^ h) @ y)**2"),
    ("1 (f) both roots, with S^2 the discriminant",
     "(vbar @ vbar)*((-(vbar @ ybar) + S) / (vbar @ vbar))**2"
     " + 2*(vbar @ ybar)*((-(vbar @ ybar) + S) / (vbar @ vbar)) + ybar @ ybar - r**2"
     " = (S**2 - (r**2*(vbar @ vbar) - (vbar ^ ybar) @ (vbar ^ ybar))) / (vbar @ vbar)"),
    ("the oracle's quadratic is l^2 times the derivation's: t^2", "wall.a = l**2 * (vbar @ vbar)"),
    ("the oracle's quadratic: 2 t", "wall.b = l**2 * (vbar @ ybar)"),
    ("the oracle's quadratic: 1", "wall.c = l**2 * (ybar @ ybar - r**2)"),
    ("the oracle's quadratic is the witness's", "wall.a*t**2 + 2*wall.b*t + wall.c = F"),
    ("the oracle's discriminant, factored",
     "wall.disc = (w @ w) * (r**2*((v ^ w) @ (v ^ w)) - ((v ^ w) @ y)**2)"),
    ("the oracle's discriminant is l^4 times the derivation's",
     "wall.disc = l**4 * (r**2*(vbar @ vbar) - (vbar ^ ybar) @ (vbar ^ ybar))"),
    ("the oracle's first root, its S being l^2 times the derivation's",
     "roots[0] = (-l**2*(vbar @ ybar) - S) / (l**2*(vbar @ vbar))"),
    ("the oracle's second root", "roots[1] = (-l**2*(vbar @ ybar) + S) / (l**2*(vbar @ vbar))"),
    ("2 (b) n points out at p", "(p - q) @ n = l"),
    ("2 (d) (u-p).n > 0 and (u-q).n < 0 exclude each other", "(u - p) @ n - (u - q) @ n = -l"),
    ("2 (c) the crossing tp", "(u + (-((u - p) @ n)/(v @ n))*v - p) @ n = 0"),
    ("2 (c) the crossing tq", "(u + (-((u - q) @ n)/(v @ n))*v - q) @ n = 0"),
    ("the oracle's plane at p is l times the derivation's",
     "cap_p.c + cap_p.b*t = l*((u + t*v - p) @ n)"),
    ("the oracle's plane at q", "cap_q.c + cap_q.b*t = -l*((u + t*v - q) @ n)"),
    ("the oracle's tp", "cross_p = -((u - p) @ n)/(v @ n)"),
    ("the oracle's tq", "cross_q = -((u - q) @ n)/(v @ n)"),
    ("the oracle's half-space is the witness's, normal w", "half.c + half.b*t = H"),
    ("the oracle's sphere is the witness's, center p", "ball.a*t**2 + 2*ball.b*t + ball.c = G"),
    ("a sphere's discriminant, as in 1 (c)", "ball.disc = r**2*(v @ v) - (v ^ y) @ (v ^ y)"),
)  # fmt: skip
"""What is proved: a title and an equation, which is executed as it stands."""


def equal(text: str) -> bool:
    """Whether an equation between expressions holds wherever h.h = 1."""
    left, right = (eval(side, {"__builtins__": {}}, _names()) for side in text.split(" = "))
    return vanishes(left - right)


def vanishes(expression: sp.Expr) -> bool:
    """Whether the numerator is the zero polynomial modulo h.h - 1.

    As a polynomial in h3 the divisor h3^2 + h1^2 + h2^2 - 1 is monic, so the remainder is zero if
    and only if the numerator is a multiple of it.
    """
    numerator, _ = sp.fraction(sp.together(expression))
    h = named("h")
    return bool(sp.Poly(sp.expand(numerator), h.z).rem(sp.Poly(h @ h - 1, h.z)).is_zero)


def derivation() -> list[Statement]:
    """Return every statement, in the order of the derivation, each proved now."""
    algebra = [Statement(title, pretty(text), equal(text)) for title, text in PROOFS]
    return [*algebra, *table_proofs()]


def pretty(text: str) -> str:
    """Return an equation as people write it."""
    for code, sign in ((" ^ ", " x "), (" @ ", "."), (" * ", " "), ("**", "^"), ("*", " ")):
        text = text.replace(code, sign)
    return text


Rows = tuple[Row, ...]


def holds(quantity: str, relation: str) -> Boolean:
    """Return the formula that a quantity stands in a relation to zero."""
    return sp.Or(*(sp.Symbol(f"{quantity}[{'-0+'[sign + 1]}]") for sign in HOLDS[relation]))


def _one_sign(quantity: str) -> Boolean:
    atoms = [holds(quantity, relation) for relation in ("< 0", "= 0", "> 0")]
    return sp.And(sp.Or(*atoms), *(sp.Not(sp.And(a, b)) for a, b in combinations(atoms, 2)))


TABLES: dict[str, tuple[Rows, tuple[tuple[str, Boolean], ...]]] = {
    "Problem 1": (PROBLEM_1, (
        ("vv = |vbar|^2 >= 0", holds("vv", ">= 0")),
        ("t1 <= t2, so t2 < 0 means t1 < 0", sp.Implies(holds("t2", "< 0"), holds("t1", "< 0"))),
        ("t1 <= t2, so t1 > 0 means t2 > 0", sp.Implies(holds("t1", "> 0"), holds("t2", "> 0"))),
    )),
    "Problem 2 (c)": (HALF_SPACE, ()),
    "Problem 2": (PROBLEM_2, (
        ("up - uq = -l < 0, so up >= 0 means uq > 0",
         sp.Implies(holds("up", ">= 0"), holds("uq", "> 0"))),
        ("up - uq = -l < 0, so uq <= 0 means up < 0",
         sp.Implies(holds("uq", "<= 0"), holds("up", "< 0"))),
    )),
    "Problem 3": (PROBLEM_3, (
        ("no count is negative", sp.And(holds("pairs_1", ">= 0"), holds("pairs_2", ">= 0"))),
    )),
}  # fmt: skip
"""Each table, and what it takes from the derivation."""


def table_proofs() -> Iterator[Statement]:
    """Yield two statements for each table: that it is complete, and exclusive."""
    for name, (table, axioms) in TABLES.items():
        rows = ", ".join(row.name for row in table)
        given = "; ".join(text for text, _ in axioms)
        why = f" (with {given})" if given else ""
        some = f"one of {rows} always holds{why}"
        yield Statement(f"{name}, complete", some, complete(table, name))
        once = f"no two of {rows} hold at once{why}"
        yield Statement(f"{name}, exclusive", once, exclusive(table, name))


def complete(table: Rows, name: str) -> bool:
    """Whether the axioms leave no situation without a row."""
    return not sp.satisfiable(sp.And(_axioms(table, name), sp.Not(sp.Or(*map(_condition, table)))))


def exclusive(table: Rows, name: str) -> bool:
    """Whether the axioms leave no situation with two rows, and each row with one."""
    axioms = _axioms(table, name)
    return not any(
        sp.satisfiable(sp.And(axioms, _condition(one), _condition(two)))
        for one, two in combinations(table, 2)
    ) and all(sp.satisfiable(sp.And(axioms, _condition(row))) for row in table)


def _axioms(table: Rows, name: str) -> Boolean:
    quantities = sorted({quantity for row in table for quantity, _ in row.condition})
    return sp.And(*map(_one_sign, quantities), *(axiom for _, axiom in TABLES[name][1]))


def _condition(row: Row) -> Boolean:
    return sp.And(*(holds(quantity, relation) for quantity, relation in row.condition))
