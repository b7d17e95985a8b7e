"""A fresh block: golden rows made anew from a seed, so that nobody can tune to the files.

The same seed gives the same rows on every machine and Python. Half of them are scenes drawn from a
pool of shared points, axes and radii, as `crosscheck --fresh` draws them; half are steps of the
golden ladders, drawn between and beside the published ones. Each passes the usual witnesses first.
No row is on the lattice tier, so none is graded on the convention.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from itertools import islice

from raycert.cases.case import Case, Family
from raycert.cases.formats import Format
from raycert.cases.model import SOLIDS, Tree, types
from raycert.cases.row import GoldenRow
from raycert.oracle.corpus.golden import USUAL, golden_row

COUNT = 500
"""Rows of a block, if nobody says otherwise."""


@dataclass(frozen=True, slots=True)
class Fresh:
    """Which block: its seed, and how many rows."""

    seed: int
    count: int = COUNT

    def options(self) -> tuple[str, ...]:
        """Return the command-line options that draw the same block."""
        size = () if self.count == COUNT else ("--fresh", str(self.count))
        return ("--seed", str(self.seed), *size)


def fresh_rows(
    seed: int, count: int, fmt: Format, solids: Collection[str]
) -> tuple[GoldenRow, ...]:
    """Return `count` rows of a seed for these types of solid; none if no leaf is among them.

    A larger count begins with the same rows. A row's id says what it is, `fresh-SEED/far-12`: the
    same in every block of the seed and format. Raises `Contradiction` if a witness disagrees.
    """
    if not possible(solids):
        return ()
    family = Family(f"fresh-{seed}", "Drawn anew from a seed.", lambda _: ())
    cases = islice(fresh_cases(seed, fmt, solids), count)
    return tuple(golden_row(family, case, fmt, USUAL) for case in cases)


def possible(solids: Collection[str]) -> bool:
    """Whether cases can be drawn of these types: a tree needs leaves."""
    return any(name in solids and not issubclass(kind, Tree) for name, kind in SOLIDS.items())


def fresh_cases(seed: int, fmt: Format, solids: Collection[str]) -> Iterator[Case]:
    """Yield cases without end, all of whose solids are among these."""
    from raycert.cases.draw import jittered, sampled  # loads all families: only who draws pays

    declared, number = set(solids), 0
    while True:
        scene = replace(sampled(number, seed, fmt), slug=f"scene-{number}")
        for case in (scene, jittered(seed, number, fmt)):
            if types(case.solid) <= declared:
                yield case
        number += 1
