"""The case tables are complete and exclusive: proved by satisfiability, in SymPy's logic.

Each quantity has three atoms, one for each sign, of which exactly one holds. What the quantities
have to do with each other is stated as axioms, each a consequence of the derivation.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from sympy import And, Implies, Not, Or, Symbol
from sympy.logic.boolalg import Boolean
from sympy.logic.inference import satisfiable

from raycert.cases.table import HALF_SPACE, HOLDS, PROBLEM_1, PROBLEM_2, PROBLEM_3, Row

Rows = tuple[Row, ...]


def holds(quantity: str, relation: str) -> Boolean:
    """Return the formula that a quantity stands in a relation to zero."""
    return Or(*(Symbol(f"{quantity}[{'-0+'[sign + 1]}]") for sign in HOLDS[relation]))


def _one_sign(quantity: str) -> Boolean:
    atoms = [holds(quantity, relation) for relation in ("< 0", "= 0", "> 0")]
    return And(Or(*atoms), *(Not(And(a, b)) for a, b in combinations(atoms, 2)))


AXIOMS: dict[str, tuple[tuple[str, Boolean], ...]] = {
    "Problem 1": (
        ("vv = |vbar|^2 >= 0", holds("vv", ">= 0")),
        ("t1 <= t2, so t2 < 0 means t1 < 0", Implies(holds("t2", "< 0"), holds("t1", "< 0"))),
        ("t1 <= t2, so t1 > 0 means t2 > 0", Implies(holds("t1", "> 0"), holds("t2", "> 0"))),
    ),
    "Problem 2 (c)": (),
    "Problem 2": (
        (
            "up - uq = -l < 0, so up >= 0 means uq > 0",
            Implies(holds("up", ">= 0"), holds("uq", "> 0")),
        ),
        (
            "up - uq = -l < 0, so uq <= 0 means up < 0",
            Implies(holds("uq", "<= 0"), holds("up", "< 0")),
        ),
    ),
    "Problem 3": (
        ("no count is negative", And(holds("pairs_1", ">= 0"), holds("pairs_2", ">= 0"))),
    ),
}
"""What each table takes from the derivation."""

TABLES: dict[str, Rows] = {
    "Problem 1": PROBLEM_1,
    "Problem 2 (c)": HALF_SPACE,
    "Problem 2": PROBLEM_2,
    "Problem 3": PROBLEM_3,
}


def table_proofs() -> Iterator[tuple[str, str, bool]]:
    """Yield (title, text, proved) for each table: complete, and exclusive."""
    for name, table in TABLES.items():
        rows = ", ".join(row.name for row in table)
        given = "; ".join(text for text, _ in AXIOMS[name])
        why = f" (with {given})" if given else ""
        yield f"{name}, complete", f"one of {rows} always holds{why}", complete(table, name)
        yield f"{name}, exclusive", f"no two of {rows} hold at once{why}", exclusive(table, name)


def complete(table: Rows, name: str) -> bool:
    """Tell whether the axioms leave no situation without a row."""
    return not satisfiable(And(_axioms(table, name), Not(Or(*map(_condition, table)))))


def exclusive(table: Rows, name: str) -> bool:
    """Tell whether the axioms leave no situation with two rows, and each row with one."""
    axioms = _axioms(table, name)
    return not any(
        satisfiable(And(axioms, _condition(one), _condition(two)))
        for one, two in combinations(table, 2)
    ) and all(satisfiable(And(axioms, _condition(row))) for row in table)


def _axioms(table: Rows, name: str) -> Boolean:
    quantities = sorted({quantity for row in table for quantity, _ in row.condition})
    return And(*map(_one_sign, quantities), *(axiom for _, axiom in AXIOMS[name]))


def _condition(row: Row) -> Boolean:
    return And(*(holds(quantity, relation) for quantity, relation in row.condition))
