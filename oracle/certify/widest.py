"""The measured domain: the widest ranges around the ordinary in which nothing fails.

A case is a point of seven numbers, each a quantity (cases/domain.py) on the side on which it may be
bounded: direction and size below and above, distance, offset and aspect above. A domain is a bound
of each. It shuts a case out that lies beyond one of its bounds, and no bound may cut into ORDINARY.
So a row that fails with ordinary numbers is shut out by none: there is no such domain, and what
fails is no limit. Of the domains that shut out every row that fails, the best keeps the most rows
that decide, and of those it is the widest. It is found by trying, for a row that is still inside,
each of its bounds; only rows matter that no other row that fails is less far out than, in all
numbers. Where that takes more than MOST steps, the best so far is taken: the first one is greedy.

Numbers are rounded away from the ordinary, to BITS bits, so that a bound that holds one row and
not the next is a number of the format.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import ROUND_CEILING, Context
from fractions import Fraction
from math import inf, ldexp, log2
from typing import Any, NamedTuple

from raycert.cases.domain import PAIRS, QUANTITIES, Domain, joint, quantities, read_domain
from raycert.cases.levels import Level, upto
from raycert.oracle.certify.grading import Grade, counting
from raycert.oracle.judge.levels import MEASURES

MOST = 20_000
"""Steps of the search."""
BITS = 40
ORDINARY = {
    "direction": (2.0**-8, 2.0**8),
    "size": (2.0**-8, 2.0**8),
    "distance": (0.0, 64.0),
    "offset": (0.0, 64.0),
    "aspect": (0.0, 64.0),
}
"""What every implementation is asked to hold. All of the corpus lies within that is not there for
one of these quantities: a step of a ladder, a thin or a distant solid, a report of such a bug. Rows
have no value of exactly 1 in common, and whoever fails at 2 or at 50 sizes has a fault and no
limit."""


class Flank(NamedTuple):
    """A quantity on the side on which it is bounded."""

    quantity: str
    low: bool

    @property
    def name(self) -> str:
        return "low" if self.low else "high"

    @property
    def ordinary(self) -> float:
        """Return how far out is ordinary."""
        low, high = ORDINARY[self.quantity]
        return -low if self.low else high


FLANKS = (
    *(Flank(name, low) for name in PAIRS for low in (True, False)),
    *(Flank(name, False) for name in QUANTITIES if name not in PAIRS),
)
Point = tuple[float, ...]
"""How far out a case is on each side: a number that grows outward, of low sides the negative one;
-infinity where it has no such quantity."""
Cuts = tuple[float, ...]
"""For each side the least that is shut out; infinity for no bound."""
WHOLE: Cuts = (inf,) * len(FLANKS)


def point(grade: Grade) -> Point:
    spans = quantities(grade.row.solid, grade.row.ray).spans()
    return tuple(
        _outward(spans[flank.quantity][not flank.low], flank.low)
        if flank.quantity in spans
        else -inf
        for flank in FLANKS
    )


def _outward(x: Fraction, low: bool) -> float:
    """Return x as a number of BITS bits that is no nearer to the ordinary; -x on a low side."""
    if not x:
        return -0.0
    exponent = x.numerator.bit_length() - x.denominator.bit_length() - BITS
    scaled = x / Fraction(2) ** exponent
    return -ldexp(scaled // 1, exponent) if low else ldexp(-(-scaled // 1), exponent)


@dataclass(frozen=True, slots=True)
class Edge:
    """A bound, and the first row that fails beyond it and within all the others."""

    flank: Flank
    bound: float
    grade: Grade


@dataclass(frozen=True, slots=True)
class Measured:
    """The widest domain in which a level would be granted.

    `rows` decide inside and pass, `left` decide outside. `ordinary` are the rows that fail at
    ordinary numbers: where there are any, there is no domain. `exhaustive` tells that no better one
    was left untried.
    """

    domain: Domain | None
    rows: int
    left: int
    edges: tuple[Edge, ...] = ()
    ordinary: tuple[Grade, ...] = ()
    exhaustive: bool = True


def measured_domain(grades: Iterable[Grade], level: Level) -> Measured | None:
    """Return the measured domain of a level for the grades of one type of solid.

    None where it would hold no row that decides. The grades are of all rows that would count if
    they lay inside.
    """
    rows = [Row(g, point(g)) for g in counting(grades, "inside", "outside") if _decides(g, level)]
    failing = [row for row in rows if _fails(row.grade, level)]
    if ordinary := tuple(row.grade for row in failing if not row.ways):
        return Measured(None, 0, len(rows), (), ordinary)
    passing = [row for row in rows if not _fails(row.grade, level)]
    cuts, exhaustive = best(passing, failing)
    kept = [row for row in passing if not row.beyond(cuts)]
    if not all(any(row.grade.counts(low) for row in kept) for low in upto(level)):
        return None
    bounds = [bound(i, cut, rows) for i, cut in enumerate(cuts)]
    edges = [
        Edge(FLANKS[i], abs(bounds[i]), min(alone, key=lambda row: row.at[i]).grade)
        for i in range(len(FLANKS))
        if (alone := [row for row in failing if row.beyond(cuts) == [i]])
    ]
    left = len(rows) - len(kept)
    return Measured(_domain(bounds), len(kept), left, tuple(edges), (), exhaustive)


def _decides(grade: Grade, level: Level) -> bool:
    return any(grade.counts(low) for low in upto(level))


def _fails(grade: Grade, level: Level) -> bool:
    return any(grade.fault(low) for low in upto(level))


class Row(NamedTuple):
    """A row as a point."""

    grade: Grade
    at: Point

    @property
    def ways(self) -> list[int]:
        """Return the sides on which it can be shut out."""
        return [i for i, flank in enumerate(FLANKS) if self.at[i] > flank.ordinary]

    def beyond(self, cuts: Cuts) -> list[int]:
        """Return the sides on which it is shut out."""
        return [i for i, cut in enumerate(cuts) if self.at[i] >= cut]


def best(passing: Sequence[Row], failing: Sequence[Row]) -> tuple[Cuts, bool]:
    """Return the cuts that shut out all that fails, and whether none better was left untried."""
    hard, lost_by = minimal(failing), Loss(passing)
    found, fewest, widest, seen = WHOLE, len(passing) + 1, -inf, set[Cuts]()
    pending = [WHOLE]
    while pending and (len(seen) < MOST or found is WHOLE):
        cuts = pending.pop()
        if cuts in seen or lost_by(cuts) > fewest:
            continue
        seen.add(cuts)
        row = next((row for row in hard if not row.beyond(cuts)), None)
        if row is None:
            cuts = widened(cuts, hard)
            lost, width = lost_by(cuts), _width(cuts)
            if (lost, -width) < (fewest, -widest):
                found, fewest, widest = cuts, lost, width
            continue
        ways = [(*cuts[:i], row.at[i], *cuts[i + 1 :]) for i in row.ways]
        pending += sorted(ways, key=lost_by, reverse=True)
    return found, not pending


class Loss:
    """How many of some rows are shut out: a number for each cut, a bit for each row."""

    def __init__(self, rows: Sequence[Row]) -> None:
        self.rows = rows
        self.beyond: dict[tuple[int, float], int] = {}

    def __call__(self, cuts: Cuts) -> int:
        lost = 0
        for key in enumerate(cuts):
            if key[1] < inf:
                lost |= self._mask(*key)
        return lost.bit_count()

    def _mask(self, i: int, cut: float) -> int:
        if (i, cut) not in self.beyond:
            bits = "".join("01"[row.at[i] >= cut] for row in self.rows)
            self.beyond[i, cut] = int(bits or "0", 2)
        return self.beyond[i, cut]


def minimal(failing: Sequence[Row]) -> list[Row]:
    """Return the rows with the fewest ways first; none is at least as far out as another in all."""
    found: list[tuple[Row, dict[int, float]]] = []
    for row in sorted(failing, key=lambda row: sum(map(_out, row.at, range(len(FLANKS))))):
        own = {i: row.at[i] for i in row.ways}
        if not any(all(own.get(i, -inf) >= x for i, x in other.items()) for _, other in found):
            found.append((row, own))
    return sorted((row for row, _ in found), key=lambda row: len(row.ways))


def widened(cuts: Cuts, hard: Sequence[Row]) -> Cuts:
    """Return the cuts as far out as they can be, one after the other."""
    for i in range(len(cuts)):
        alone = [row.at[i] for row in hard if row.beyond(cuts) == [i]]
        cuts = (*cuts[:i], min(alone, default=inf), *cuts[i + 1 :])
    return cuts


def _width(cuts: Cuts) -> float:
    return sum(map(_out, cuts, range(len(cuts))))


def _out(x: float, i: int) -> float:
    """Return how many times 2 a number is beyond what is ordinary on a side, 0 within."""
    ordinary = FLANKS[i].ordinary
    if x <= ordinary:
        return 0.0
    return FREE if x == inf or not x else abs(log2(abs(x)) - log2(abs(ordinary)))


FREE = 4096.0
"""The width of a side without a bound: more than that of any bound."""


def bound(i: int, cut: float, rows: Iterable[Row]) -> float:
    """Return a bound that holds what is not cut off: a round number, if one lies between.

    That is a power of ten, or of two; else the decimal with the fewest digits. A bound below is
    negative; infinity is none.
    """
    if cut == inf:
        return inf
    last = max([row.at[i] for row in rows if row.at[i] < cut] + [FLANKS[i].ordinary])
    clear = cut - abs(cut) * 2.0 ** (2 - BITS)
    for base in (10, 2):
        sign = 1 if cut > 0 else -1
        power = round(log2(abs(cut)) / log2(base))
        near = [sign * float(f"1e{n}") if base == 10 else sign * 2.0**n for n in _around(power)]
        if between := [x for x in near if last <= x < clear]:
            return max(between)
    digits = (_decimal(last, n) for n in range(1, 17))
    return next((x for x in digits if last <= x < clear), last)


def _around(n: int) -> range:
    return range(n - 1, n + 2)


def _decimal(x: float, digits: int) -> float:
    """Return x rounded up to so many decimal digits."""
    rounding = Context(prec=digits, rounding=ROUND_CEILING)
    return float(rounding.create_decimal_from_float(x))


def _domain(bounds: Sequence[float]) -> Domain:
    """Return the domain of the bounds of all sides."""
    found: dict[str, list[float | None]] = {}
    for flank, x in zip(FLANKS, bounds, strict=True):
        found.setdefault(flank.quantity, []).append(None if x == inf else abs(x))
    pairs: dict[str, Any] = {name: tuple(x) if len(x) > 1 else x[0] for name, x in found.items()}
    return Domain(**pairs)


def writable(certificate: Mapping[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """Return the fields of a hello with the domain in which all solids are granted that can be.

    It is that for the level asked, for `stable` where a higher one is, within what was declared.
    Then a sentence for each solid of which no domain is granted.
    """
    asked = certificate["asked"]["level"]
    level = asked if asked in MEASURES else "stable"
    domain, without = read_domain(certificate["domain"]["declared"]), []
    for name, solid in certificate["solids"].items():
        found = solid["measured"].get(level)
        if found and found["domain"] is not None:
            domain = joint(domain, read_domain(found["domain"]))
        elif level in solid["measured"]:
            failed = found["ordinary"]["failed"] if found else 0
            why = f"fails on {failed} ordinary cases" if failed else f"has no row that is {level}"
            without.append(f"{name} {why}: it is granted {level} in no domain")
    return {"domain": domain.form()}, without
