"""The smoke rows: few golden rows that still refuse all that the corpus refuses of the zoo.

For every fault and every type of solid, one row that refuses the fault on the lowest level that any
row of that type does; and a row of every family. Chosen greedily, the row that serves most first;
equals in the order of the corpus, so that the choice is the same everywhere. The rows of the range
tier, part of no level, come last, so that a fault at the n-th question strikes one that counts.

`raycert zoo --write-smoke` writes their ids into smoke/.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from raycert.cases.corpus import Corpus
from raycert.cases.model import type_of
from raycert.oracle.zoo.fault import Fault
from raycert.oracle.zoo.inhabitants import FAULTS
from raycert.oracle.zoo.matrix import LEVELS, Refusal, Trials, line

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
    ranks: dict[str, int] = {}
    for refusal in refusals:
        kind = type_of(refusal.row.solid)
        ranks[kind] = min(ranks.get(kind, _rank(refusal)), _rank(refusal))
    return [
        (r.row.id, (fault.name, type_of(r.row.solid)))
        for r in refusals
        if _rank(r) == ranks[type_of(r.row.solid)]
    ]


def _rank(refusal: Refusal) -> int:
    return LEVELS.index(refusal.level) + len(LEVELS) * (refusal.row.tier == "range")


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
