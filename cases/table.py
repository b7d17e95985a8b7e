"""The case table: the three tables that cases/README.md derives, as data.

A row is a name, the steps of the problem that derive it, its condition, and the pairs it emits.
A condition is a list of (quantity, relation to zero); it holds if all of them do. `Table.decide`
asks for the sign of a quantity only once the conditions before it hold: a row never asks for a
quantity that is undefined where it stands.

Quantities of Problem 1, with vbar = v x w/|w| and ybar = y x w/|w|:

    vv      |vbar|^2
    inside  r^2 - |ybar|^2
    disc    r^2 |vbar|^2 - |vbar x ybar|^2
    t1, t2  the roots, t1 <= t2; defined where vv != 0 and disc >= 0

Quantities of Problem 2, with the outward normal n = (p - q)/|p - q| of the face through p:

    up      (u - p) . n
    uq      (u - q) . n
    vn      v . n

Quantities of Problem 3, for the pairs (a, b) of Problem 1 and (c, d) of Problem 2, with
m = max(a, c) and n = min(b, d): `pairs_1` and `pairs_2` (how many pairs each gave: 0 or 1),
`a-c`, `b-d`, `m-n` (infinity equals itself).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

Relation = str
HOLDS: dict[Relation, set[int]] = {
    "< 0": {-1}, "= 0": {0}, "> 0": {1}, "<= 0": {-1, 0}, ">= 0": {0, 1}, "!= 0": {-1, 1},
}  # fmt: skip
"""The signs for which each relation holds."""

Signs = tuple[tuple[str, int], ...]


@dataclass(frozen=True, slots=True)
class Row:
    """One row of a table: `parts` are the steps of its problem, `pairs` what it emits."""

    name: str
    parts: str
    condition: tuple[tuple[str, Relation], ...]
    pairs: str


class Table(tuple[Row, ...]):
    """The rows of a table, in the order derived; of any signs, exactly one row holds.

    That the rows exclude one another and leave nothing out is proved in tests/cases/test_table.py.
    """

    def __new__(cls, *rows: Row) -> Table:
        return super().__new__(cls, rows)

    def __init__(self, *rows: Row) -> None:
        self._next: dict[Signs, Row | str] = {}

    def decide(self, sign: Callable[[str], int]) -> tuple[Row, Signs]:
        """Return the row whose condition holds, and the signs that decided it, in the order asked.

        `sign` gives the sign (-1, 0, 1) of a quantity, and is asked for no more than is needed.
        Signs that contradict the table's axioms may reach no row: `ArithmeticError`.
        """
        known: Signs = ()
        while not isinstance(step := self._next.get(known) or self._after(known), Row):
            known = (*known, (step, sign(step)))
        return step, known

    def _after(self, known: Signs) -> Row | str:
        """Return, and remember, the row that some signs leave, or the quantity to ask for next."""
        signs = dict(known)
        for row in self:
            for quantity, relation in row.condition:
                if quantity not in signs:
                    return self._next.setdefault(known, quantity)
                if signs[quantity] not in HOLDS[relation]:
                    break
            else:
                return self._next.setdefault(known, row)
        raise ArithmeticError(f"no row holds for {signs}")


PROBLEM_1 = Table(
    Row("along-inside", "1 (d,e,l)", (("vv", "= 0"), ("inside", ">= 0")), "{(0, inf)}"),
    Row("along-outside", "1 (d,e)", (("vv", "= 0"), ("inside", "< 0")), "{}"),
    Row("miss", "1 (d,e)", (("vv", "!= 0"), ("disc", "< 0")), "{}"),
    Row("behind", "1 (f,g-I,h)", (("vv", "!= 0"), ("disc", ">= 0"), ("t2", "< 0")), "{}"),
    Row("from-inside", "1 (f,g-III,j)",
        (("vv", "!= 0"), ("disc", ">= 0"), ("t2", ">= 0"), ("t1", "< 0")), "{(0, t2)}"),
    Row("through", "1 (f,g-II,i)",
        (("vv", "!= 0"), ("disc", ">= 0"), ("t2", ">= 0"), ("t1", ">= 0")), "{(t1, t2)}"),
)  # fmt: skip
"""The infinite cylinder."""

PROBLEM_2 = Table(
    Row("AE", "2 (g)", (("up", "<= 0"), ("uq", ">= 0"), ("vn", "= 0")), "{(0, inf)}"),
    Row("BE", "2 (g)", (("up", "<= 0"), ("uq", ">= 0"), ("vn", "> 0")), "{(0, tp)}"),
    Row("AF", "2 (g)", (("up", "<= 0"), ("uq", ">= 0"), ("vn", "< 0")), "{(0, tq)}"),
    Row("AH", "2 (g)", (("uq", "< 0"), ("vn", "<= 0")), "{}"),
    Row("BG", "2 (g)", (("uq", "< 0"), ("vn", "> 0")), "{(tq, tp)}"),
    Row("DE", "2 (g)", (("up", "> 0"), ("vn", ">= 0")), "{}"),
    Row("CF", "2 (g)", (("up", "> 0"), ("vn", "< 0")), "{(tp, tq)}"),
)
"""The slab."""

HALF_SPACE = Table(
    Row("A", "2 (c)", (("up", "<= 0"), ("vn", "<= 0")), "{(0, inf)}"),
    Row("B", "2 (c)", (("up", "<= 0"), ("vn", "> 0")), "{(0, tp)}"),
    Row("C", "2 (c)", (("up", "> 0"), ("vn", "< 0")), "{(tp, inf)}"),
    Row("D", "2 (c)", (("up", "> 0"), ("vn", ">= 0")), "{}"),
)
"""One plane: the four cases of Problem 2 (c)."""

PROBLEM_3 = Table(
    Row("neither", "3 (a)", (("pairs_1", "= 0"), ("pairs_2", "= 0")), "{}"),
    Row("no-1", "3 (b)", (("pairs_1", "= 0"), ("pairs_2", "> 0")), "{}"),
    Row("no-2", "3 (c)", (("pairs_1", "> 0"), ("pairs_2", "= 0")), "{}"),
    Row("apart", "3 (d)", (("pairs_1", "> 0"), ("pairs_2", "> 0"), ("m-n", "> 0")), "{}"),
    Row("meet", "3 (d)", (("pairs_1", "> 0"), ("pairs_2", "> 0"), ("m-n", "<= 0")), "{(m, n)}"),
)
"""The capped cylinder: the intersection of the two."""

COMPARISONS = ("a-c", "b-d", "m-n")


def comparison_names(signs: dict[str, int]) -> tuple[str, ...]:
    """Return the three comparisons of Problem 3 in words: `a<c`, `b=d`, `m<n`.

    >>> comparison_names({"a-c": -1, "b-d": 0, "m-n": -1})
    ('a<c', 'b=d', 'm<n')
    """
    return tuple(
        f"{name[0]}{'<=>'[signs[name] + 1]}{name[2]}" for name in COMPARISONS if name in signs
    )


# What keeps a combination of the three comparisons from occurring, as (reason, forbids). Each
# `forbids` is given the rows of Problem 1 and 2 and the signs of a-c, b-d and m-n. That these
# leave exactly the combinations that occur is proved by exhaustion in the tests.
_START_0 = {"along-inside", "from-inside"}
_ENTERS = {"BG", "CF"}
_Forbids = Callable[[str, str, int, int, int], bool]
IMPOSSIBLE: tuple[tuple[str, _Forbids], ...] = (
    ("a = 0 in this row of Problem 1 and c = 0 in this row of Problem 2, so a = c",
     lambda one, two, ac, bd, mn: one in _START_0 and two not in _ENTERS and ac != 0),
    ("a = 0 in this row of Problem 1 and c > 0 in this row of Problem 2, so a < c",
     lambda one, two, ac, bd, mn: one in _START_0 and two in _ENTERS and ac != -1),
    ("c = 0 in this row of Problem 2 and a >= 0, so a < c cannot be",
     lambda one, two, ac, bd, mn: one == "through" and two not in _ENTERS and ac == -1),
    ("b and d are both infinite, so b = d",
     lambda one, two, ac, bd, mn: one == "along-inside" and two == "AE" and bd != 0),
    ("b is infinite and d is not, so b > d",
     lambda one, two, ac, bd, mn: one == "along-inside" and two != "AE" and bd != 1),
    ("d is infinite and b is not, so b < d",
     lambda one, two, ac, bd, mn: one != "along-inside" and two == "AE" and bd != -1),
    ("b = d = infinity and m = 0, so m < n",
     lambda one, two, ac, bd, mn: one == "along-inside" and two == "AE" and mn != -1),
    ("m and n are the ends of one and the same pair, and no pair has enter > leave",
     lambda one, two, ac, bd, mn: mn == 1 and not ac == bd != 0),
    ("m = c and n = d, and p != q keeps c < d where both are crossings, so m < n",
     lambda one, two, ac, bd, mn: two in _ENTERS and ac <= 0 <= bd and mn != -1),
)  # fmt: skip


def unreachable(one: str, two: str, signs: tuple[int, int, int]) -> str | None:
    """Return why these signs of (a-c, b-d, m-n) cannot occur in this pair of rows, or None."""
    for reason, forbids in IMPOSSIBLE:
        if forbids(one, two, *signs):
            return reason
    return None


def pairs_of_rows() -> list[tuple[str, str]]:
    """Return all 42 pairs (row of Problem 1, row of Problem 2)."""
    return [(one.name, two.name) for one, two in product(PROBLEM_1, PROBLEM_2)]


def cells() -> list[tuple[str, ...]]:
    """Return every reachable cell of the case table, named as golden rows name it.

    A cell is (row of Problem 1, row of Problem 2, row of Problem 3) and, where both gave a pair,
    the three comparisons.
    """
    found: list[tuple[str, ...]] = []
    for one, two in product(PROBLEM_1, PROBLEM_2):
        pairs = (int(one.pairs != "{}"), int(two.pairs != "{}"))
        if pairs != (1, 1):
            three = {(0, 0): "neither", (0, 1): "no-1", (1, 0): "no-2"}[pairs]
            found.append((one.name, two.name, three))
            continue
        for ac, bd, mn in product((-1, 0, 1), repeat=3):
            if unreachable(one.name, two.name, (ac, bd, mn)) is None:
                names = comparison_names({"a-c": ac, "b-d": bd, "m-n": mn})
                found.append((one.name, two.name, "apart" if mn > 0 else "meet", *names))
    return found
