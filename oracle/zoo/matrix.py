"""The kill matrix: which family refuses which fault, on what level, and how.

In process, and by the rows' own `accept` lists, as any reader would: no error is measured. Only an
answer that differs from the base's can be refused, for the base is granted every row.

The smoke rows are few golden rows that still refuse all that the corpus refuses. For every fault
and type of solid, one row that refuses the fault on the lowest level that any row of that type
does; and a row of every family. Chosen greedily, the row that serves most first; equals in the
order of the corpus, so that the choice is the same everywhere. The rows of the range tier, part of
no level, come last, so that a fault at the n-th question strikes one that counts.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from raycert.cases.accept import Numbers, Pairs
from raycert.cases.corpus import Corpus
from raycert.cases.formats import BINARY64, Format
from raycert.cases.levels import Level
from raycert.cases.model import type_of
from raycert.cases.row import GoldenRow
from raycert.oracle.judge.levels import Judge
from raycert.oracle.zoo.inhabitants import FAULTS
from raycert.oracle.zoo.tracer import BASE, Fault, Intersect, Kind

LEVELS = ("sound", "stable", "closed", "faithful")
"""What may refuse a row, in this order; `faithful` by the number of pairs only."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """An answer, or why there is none."""

    answer: Numbers | None
    error: str = ""

    @classmethod
    def of(cls, intersect: Intersect, row: GoldenRow, fmt: Format) -> Outcome:
        """Ask a tracer. Whatever it raises is a crash."""
        try:
            pairs = [(a + 0.0, b + 0.0) for a, b in intersect(row.solid, row.ray)]
            if fmt is not BINARY64:
                pairs = [(fmt.nearest(a), fmt.nearest(b)) for a, b in pairs]
            return cls(tuple(pairs))
        except Exception as error:
            return cls(None, f"{type(error).__name__}: {error}")


@dataclass(frozen=True, slots=True)
class Refusal:
    """A row that refuses an answer: the first level that does, how, and the judge's words."""

    row: GoldenRow
    outcome: Outcome
    level: str
    kind: Kind
    reason: str


@dataclass(frozen=True)
class Trials:
    """The rows that all faults are tried on, with what the base answers."""

    rows: Sequence[GoldenRow]
    format: Format
    judges: dict[str, Judge] = field(default_factory=dict)

    @cached_property
    def base(self) -> list[Outcome]:
        return [Outcome.of(BASE, row, self.format) for row in self.rows]

    def malformed(self, row: GoldenRow, answer: Numbers) -> str | None:
        if row.id not in self.judges:
            self.judges[row.id] = Judge(row.solid, row.ray, self.format, row.tier)
        return self.judges[row.id].malformed(answer)

    def tried(self, fault: Fault) -> Iterator[tuple[Outcome, Refusal | None]]:
        """Yield what a fault answers to each row, and how the row refuses it.

        Where a fresh tracer, asked this alone, answers otherwise, the kind is `unrepeated`.
        """
        tracer = fault.make()
        for row, base in zip(self.rows, self.base, strict=True):
            outcome = Outcome.of(tracer, row, self.format)
            refusal = None if outcome == base else self.refusal(row, outcome, base)
            if refusal and fault.stateful:
                again = Outcome.of(fault.make(), row, self.format)
                refusal = refusal if again == outcome else replace(refusal, kind="unrepeated")
            yield outcome, refusal

    def refusal(self, row: GoldenRow, outcome: Outcome, base: Outcome) -> Refusal | None:
        """Return how a row refuses an outcome, or None."""
        if outcome.answer is None:
            return Refusal(row, outcome, "sound", "crash", outcome.error)
        reason = self.malformed(row, outcome.answer)
        if reason:
            return Refusal(row, outcome, "sound", "malformed", reason)
        levels: tuple[Level, ...] = ("sound", "stable")
        for level in levels:
            reason = row.accept[level].fault(outcome.answer) if level in row.decisive else None
            if reason:
                how = kind(row.accept[level].outer, row.accept[level].inner, outcome.answer)
                return Refusal(row, outcome, level, how, reason)
        return _by_number(row, outcome, base)


def _by_number(row: GoldenRow, outcome: Outcome, base: Outcome) -> Refusal | None:
    """Return how a row refuses an answer whose number of pairs is wrong, and the base's right."""
    answer = outcome.answer or ()
    if len(answer) == len(row.expected) or len(base.answer or ()) != len(row.expected):
        return None
    reason = f"{len(answer)} pairs, {len(row.expected)} expected"
    if row.tier == "lattice" and not answer and any(span.touch for span in row.intervals):
        return Refusal(row, outcome, "closed", "touch dropped", reason)
    how: Kind = "missed" if len(answer) < len(row.expected) else "phantom"
    return Refusal(row, outcome, "faithful", how, reason) if "faithful" in row.decisive else None


def kind(outer: Pairs, inner: Pairs, answer: Pairs) -> Kind:
    """Return how a list between which and the answer there is no room is missed.

    phantom    a pair meets nothing of the outer list
    missed     an interval of the inner list is met by no pair
    count      every pair is where it may be, and there are too many
    wrong end  every pair meets what it ought to, and ends too early or too late
    """
    if any(not any(_meets(pair, o) for o in outer) for pair in answer):
        return "phantom"
    if any(not any(_meets(pair, i) for pair in answer) for i in inner):
        return "missed"
    fits = all(any(o[0] <= a and b <= o[1] for o in outer) for a, b in answer)
    covers = all(any(a <= i[0] and i[1] <= b for a, b in answer) for i in inner)
    parts = any(sum(_meets(pair, i) for pair in answer) > 1 for i in inner)
    return "count" if fits and (covers or parts) else "wrong end"


def _meets(one: tuple[float, float], other: tuple[float, float]) -> bool:
    return one[0] <= other[1] and other[0] <= one[1]


@dataclass(frozen=True)
class MatrixLine:
    """A fault and all its refusals: one line of the matrix."""

    fault: Fault
    refusals: tuple[Refusal, ...]

    @property
    def families(self) -> dict[str, Counter[str]]:
        """Return, for each family that refuses the fault, the refusals by level."""
        found: dict[str, Counter[str]] = {}
        for refusal in self.refusals:
            found.setdefault(refusal.row.family, Counter())[refusal.level] += 1
        return found

    @property
    def at_home(self) -> list[Refusal]:
        """Return the refusals of the family made for the fault, on the first level with any."""
        here = [r for r in self.refusals if r.row.family == self.fault.home]
        first = min((LEVELS.index(r.level) for r in here), default=0)
        return [r for r in here if LEVELS.index(r.level) == first]

    @property
    def kind(self) -> Kind | None:
        """Return how most of the refusals at home are."""
        kinds = Counter(refusal.kind for refusal in self.at_home)
        return kinds.most_common(1)[0][0] if kinds else None

    @property
    def granted(self) -> str | None:
        """Return the highest level, of sound and stable, that is still granted.

        The range tier is part of no level.
        """
        levels = {r.level for r in self.refusals if r.row.tier != "range"}
        return None if "sound" in levels else "sound" if "stable" in levels else "stable"

    @property
    def first(self) -> Refusal | None:
        """Return the refusal to show: of the most common kind at home, else the first."""
        shown = [refusal for refusal in self.at_home if refusal.kind == self.kind]
        return next(iter(shown or self.refusals), None)

    @property
    def trouble(self) -> str | None:
        """Return what is wrong with the corpus, or with what is said of the fault; or None."""
        fault = self.fault
        if not self.refusals:
            return "no golden row refuses it"
        if not self.at_home:
            return f"the family made for it, {fault.home}, does not refuse it"
        if self.kind != fault.kind:
            return f"{fault.home} finds {self.kind}, not {fault.kind}"
        if self.granted != fault.granted:
            return f"it is granted {self.granted}, not {fault.granted}"
        return None


def line(trials: Trials, fault: Fault) -> MatrixLine:
    return MatrixLine(fault, tuple(refusal for _, refusal in trials.tried(fault) if refusal))


def form(corpus: Corpus, lines: Sequence[MatrixLine]) -> dict[str, Any]:
    return {
        "corpus": {"version": corpus.version, "manifest_sha256": corpus.sha256},
        "rows": len(corpus.rows),
        "families": sorted({row.family for row in corpus.rows}),
        "faults": [_fault_form(line) for line in lines],
    }


def _fault_form(line: MatrixLine) -> dict[str, Any]:
    fault, first = line.fault, line.first
    words = {name: getattr(fault, name) for name in ("name", "does", "origin", "home")}
    return words | {
        "kind": line.kind,
        "granted": line.granted,
        "trouble": line.trouble,
        "refused": {family: dict(levels) for family, levels in line.families.items()},
        "first": first and {"id": first.row.id, "level": first.level, "reason": first.reason},
    }


MOST = 200
"""More rows than these are no smoke test; tests/zoo/test_zoo_cover.py counts them."""

Need = tuple[str, str]
"""What a row can serve: (fault, type of solid), or ("", family)."""


def chosen(corpus: Corpus, advance: Callable[[], object] = lambda: None) -> list[str]:
    """Return the ids to put into the file of a corpus."""
    trials = Trials(corpus.rows, corpus.format)
    serves: dict[str, set[Need]] = {row.id: {("", row.family)} for row in corpus.rows}
    for fault in FAULTS:
        for id, need in served(fault, line(trials, fault).refusals):
            serves[id].add(need)
        advance()
    picked = set(greedy(serves))
    rows = sorted(corpus.rows, key=lambda row: row.tier == "range")
    return [row.id for row in rows if row.id in picked]


def served(fault: Fault, refusals: Sequence[Refusal]) -> list[tuple[str, Need]]:
    """Return the rows that refuse a fault on the lowest level of their type, with what they serve.

    Rows of the range tier are part of no level: they count only where there is no other.
    """
    ranked = [
        (type_of(r.row.solid), (r.row.tier == "range", LEVELS.index(r.level)), r.row.id)
        for r in refusals
    ]
    least: dict[str, tuple[bool, int]] = {}
    for name, rank, _ in ranked:
        least[name] = min(least.get(name, rank), rank)
    return [(id, (fault.name, name)) for name, rank, id in ranked if rank == least[name]]


def greedy(serves: Mapping[str, set[Need]]) -> list[str]:
    """Return keys whose values together are all there is: the largest remainder first.

    >>> greedy({"a": {("", "1")}, "b": {("", "1"), ("", "2")}})
    ['b']
    """
    left = {need for needs in serves.values() for need in needs}
    picked = []
    while left:
        best = max(serves, key=lambda id: len(serves[id] & left))
        picked.append(best)
        left -= serves[best]
    return picked
