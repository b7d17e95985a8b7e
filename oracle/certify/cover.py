"""The fewest faults that explain the most failures: a greedy cover, and what chance would explain.

A suspect is what could explain failures: a fault of the zoo, or a signature. For a fault it is
counted on how many rows it would fail, and on how many of them the subject answers as it does. That
many agree by chance with a probability of at most 2^-bits (Chernoff, for independent rows), if the
subject failed anywhere and in any way: a row is failed in a way as often as all rows are. So a
fault that would fail many rows which the subject passes needs the more agreements, and one that
only misses needs misses where it would miss, and not elsewhere. Rows that fail are not independent:
they stand together in families, where a quantity that is too large for a tracer looks like many a
fault. So one that agrees in misses alone is not named if it would fail more rows which the subject
passes than it explains; numbers that agree speak for themselves.

To take what is least by chance first, and to judge the others by what is left, is enough: the rows
that two faults would explain are few where the faults are not the same, and the greedy cover is
never longer than the least one by more than the logarithm of the rows. What the later ones make
needless is taken out again.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import log2

from raycert.oracle.certify.alike import KINDS, Kind
from raycert.oracle.certify.grading import Grade

LEAST = 5
"""Fewer failures than these are explained by too many faults."""
PROOF = 17.0
"""Bits that a suspect has to have: once in a thousand runs any of the 120 would by chance."""
MOST = 0.9
"""The part of what is unexplained that a signature said of nearly all has to hold of."""
HALF = 0.5
"""A row is never taken to fail in one way more often than not."""
NUMBERS = 8.0
"""Of so many failures that give numbers one is expected to give those of a fault, at most."""


@dataclass(frozen=True)
class Explanation:
    """What may explain failures, their places in the list of those shown as `rows`.

    Against a fault speak `failed`, the failures that it would fail too, with the kind of its
    answers, and `passed`, by kind, how many rows it would fail and the subject passes. Where
    `telling` is not 0, each row is worth so much, whatever else it would fail; `alone` is for what
    has to hold of nearly all that is left, and `first` for what explains before all else does.
    """

    name: str
    does: str
    origin: str
    explains: Callable[[Grade], bool]
    rows: frozenset[int]
    telling: float = 0.0
    alone: bool = False
    first: bool = False
    failed: Mapping[int, Kind] = field(default_factory=dict)
    passed: Mapping[Kind, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Failures:
    """The failures shown: the kinds of their answers, and whether a miss is wrong there.

    `passing` counts the rows that pass, and `seen` those of them where a miss would be wrong.
    """

    kinds: Sequence[Kind]
    wants: Sequence[bool]
    passing: float
    seen: float

    def rates(self, left: frozenset[int]) -> dict[Kind, float]:
        """Return how often a row fails by chance with an answer of a kind that a fault gives."""
        counts, rows = Counter(self.kinds[i] for i in left), self.passing + len(left)
        counts["numbers"] /= NUMBERS  # type: ignore[assignment]
        counts["place"] = len(left)
        could: dict[Kind, float] = dict.fromkeys(KINDS, rows)
        could["miss"] = self.seen + sum(self.wants[i] for i in left)
        return {kind: min(counts[kind] / max(could[kind], 1), HALF) for kind in KINDS}


def bits(suspect: Explanation, left: frozenset[int], failures: Failures) -> float:
    """Return how little it is by chance that a suspect explains what it does of what is left."""
    explained = len(suspect.rows & left)
    if explained < LEAST:
        return 0.0
    if suspect.telling:
        enough = not suspect.alone or explained >= MOST * len(left)
        return suspect.telling * explained * enough
    rates = failures.rates(left)
    would = Counter(k for i, k in suspect.failed.items() if i in left)
    passed = sum(suspect.passed.values())
    if passed > explained and numbers(suspect.rows & left, failures) < LEAST:
        return 0.0
    total = sum(would.values()) + passed
    expected = sum(rates[k] * n for k, n in would.items())
    expected += sum(rates[k] * n for k, n in suspect.passed.items())
    return total * divergence(explained / total, expected / total)


def numbers(rows: frozenset[int], failures: Failures) -> int:
    """Return how many of these failures answer numbers."""
    return sum(failures.kinds[i] == "numbers" for i in rows)


def divergence(share: float, chance: float) -> float:
    """Return the bits that a share of successes tells above a chance; 0 where it is no larger.

    >>> divergence(1.0, 0.25), divergence(0.2, 0.25)
    (2.0, 0.0)
    """
    chance = max(chance, 1e-9)
    if share <= chance:
        return 0.0
    rest = (1 - share) * log2((1 - share) / (1 - chance)) if share < 1 else 0.0
    return share * log2(share / chance) + rest


def cover(
    suspects: Sequence[Explanation], failures: Failures, everywhere: Mapping[str, int]
) -> list[Explanation]:
    """Return the suspects that explain failures; of equals, who explains more `everywhere`."""
    left, picked = frozenset(range(len(failures.kinds))), list[Explanation]()
    while len(left) >= LEAST and suspects:
        proofs = ((round(proof(s, left, failures)), s) for s in suspects)
        proven = [(s.first, weight, everywhere[s.name], s) for weight, s in proofs if weight]
        if not proven:
            break
        *_, best = max(proven, key=lambda x: x[:3])
        picked.append(best)
        left -= best.rows
    return picked


def proof(suspect: Explanation, left: frozenset[int], failures: Failures) -> float:
    """Return the bits of a suspect, 0 where they are too few to name a fault."""
    found = bits(suspect, left, failures)
    return found if found >= PROOF or suspect.telling else 0.0


def needed(picked: Sequence[Explanation]) -> list[Explanation]:
    """Return the suspects without those whose rows, but for a few, the others explain.

    A signature says less than a fault, and makes none needless.
    """
    kept = list(picked)
    for suspect in picked:
        others = (s for s in kept if s is not suspect and (suspect.telling or not s.telling))
        if len(suspect.rows.difference(*(s.rows for s in others))) < LEAST:
            kept.remove(suspect)
    return kept


def shares(picked: Sequence[Explanation]) -> list[tuple[Explanation, frozenset[int]]]:
    """Return the suspects with the rows that are left to each, in the order of their number.

    Faults come before signatures there, and who explains most first.
    """
    found, taken = [], frozenset[int]()
    for suspect in sorted(picked, key=lambda s: (s.telling > 0, -len(s.rows))):
        found.append((suspect, suspect.rows - taken))
        taken |= suspect.rows
    return sorted(found, key=lambda x: -len(x[1]))
