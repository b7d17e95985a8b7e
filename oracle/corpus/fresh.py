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
from raycert.cases.forms import read_ray, read_solid, write_ray, write_solid
from raycert.cases.jitter import jittered
from raycert.cases.model import SOLIDS, Refused, Tree, types
from raycert.cases.row import GoldenRow
from raycert.cases.sample import case as sampled
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
    """Tell whether cases can be drawn of these types: a tree needs leaves."""
    return any(name in solids and not issubclass(kind, Tree) for name, kind in SOLIDS.items())


def fresh_cases(seed: int, fmt: Format, solids: Collection[str]) -> Iterator[Case]:
    """Yield cases without end, all of whose solids are among these."""
    declared, number = set(solids), 0
    while True:
        for case in (_scene(seed, number, fmt), jittered(seed, number, fmt)):
            if case is not None and types(case.solid) <= declared:
                yield case
        number += 1


def _scene(seed: int, number: int, fmt: Format) -> Case | None:
    """Return a scene of the sample in numbers of the format; None where that makes it no solid."""
    case = sampled(number, seed)
    try:
        solid = read_solid(write_solid(case.solid), fmt=fmt)
        ray = read_ray(write_ray(case.ray), fmt=fmt)
    except Refused:
        return None
    return replace(case, slug=f"scene-{number}", solid=solid, ray=ray)
