"""Which rows are sent: what the client declared, narrowed by what the person asks.

A shard is chosen by a hash of the row's id, not by its place: a row that comes or goes moves no
other, and every row is in exactly one shard.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from hashlib import sha256

from raycert.cases.corpus import Corpus, Heading
from raycert.cases.hints import near
from raycert.cases.model import type_of, types
from raycert.cases.protocol import Hello
from raycert.cases.row import GoldenRow
from raycert.oracle.zoo.smoke import smoke

MOST_SHARDS = 1000


class BadShard(ValueError):
    """A text that names no shard; the text says what one looks like."""


@dataclass(frozen=True, slots=True)
class Shard:
    """The `number`-th of `of` parts, counted from 1."""

    number: int
    of: int

    @classmethod
    def parse(cls, text: str) -> Shard:
        """Return the shard that `2/5` names. Raises `BadShard`."""
        found = re.fullmatch(r"([0-9]{1,4})/([0-9]{1,4})", text, re.ASCII)
        number, of = (int(group) for group in found.groups()) if found else (0, 0)
        if not 1 <= number <= of <= MOST_SHARDS:
            raise BadShard(
                f"is not N/OF with 1 <= N <= OF <= {MOST_SHARDS}, as 2/5 is: {text!r:.40}"
            )
        return cls(number, of)

    def __str__(self) -> str:
        return f"{self.number}/{self.of}"

    def takes(self, id: str) -> bool:
        digest = sha256(id.encode()).digest()
        return int.from_bytes(digest[:8], "big") % self.of == self.number - 1


NAMES = {"solids": "--solid", "tiers": "--tier", "families": "--family", "ids": "--id"}
"""The fields of a selection that list values, each with its option."""


def _values(row: Heading) -> dict[str, str]:
    return {"solids": row.solid, "tiers": row.tier, "families": row.family, "ids": row.id}


@dataclass(frozen=True, slots=True)
class Left:
    """What was not tested: solids the client did not declare, and rows outside the selection."""

    solids: tuple[str, ...]
    rows: int


@dataclass(frozen=True, slots=True)
class Selection:
    """The options that narrow a run; an empty one narrows nothing."""

    solids: tuple[str, ...] = ()
    tiers: tuple[str, ...] = ()
    families: tuple[str, ...] = ()
    ids: tuple[str, ...] = ()
    shard: Shard | None = None
    smoke: bool = False
    """Only the smoke rows, which `select` knows."""

    def takes(self, row: GoldenRow) -> bool:
        values = _values(Heading.of(row)).items()
        named = all(value in (getattr(self, name) or (value,)) for name, value in values)
        return named and (self.shard is None or self.shard.takes(row.id))

    def options(self) -> tuple[str, ...]:
        named = tuple(
            word
            for field, option in NAMES.items()
            for value in getattr(self, field)
            for word in (option, value)
        )
        shard = () if self.shard is None else ("--shard", str(self.shard))
        return (*named, *shard, *(("--smoke",) if self.smoke else ()))

    def missing(self, corpus: Corpus, fresh: Sequence[GoldenRow] = ()) -> list[str]:
        """Return what is asked for and neither in the corpus nor among the fresh rows.

        Each with what was meant, if that can be told.
        """
        known = {name: set[str]() for name in NAMES}
        for row in _headings(corpus, fresh):
            for name, value in _values(row).items():
                known[name].add(value)
        return [
            f"{value:.80} ({hint})" if (hint := near(value, known[name])) else f"{value:.80}"
            for name in NAMES
            for value in getattr(self, name)
            if value not in known[name]
        ]


def _headings(corpus: Corpus, fresh: Sequence[GoldenRow]) -> list[Heading]:
    return [*corpus.headings, *map(Heading.of, fresh)]


def able(rows: Iterable[GoldenRow], hello: Hello) -> list[GoldenRow]:
    """Return the rows of solids that are declared, every part of them."""
    declared = set(hello.solids)
    return [row for row in rows if types(row.solid) <= declared]


def select(
    corpus: Corpus, hello: Hello, selection: Selection, fresh: Sequence[GoldenRow] = ()
) -> tuple[list[GoldenRow], Left]:
    """Return the rows to send, and what is left out because it was not declared or selected.

    `fresh` rows are asked beside those of the corpus, and narrowed like them.
    """
    golden = corpus.rows
    if selection.smoke:  # in their own order; those that another corpus lacks are left out
        by_id = {row.id: row for row in corpus.rows}
        golden = tuple(by_id[id] for id in smoke(corpus.precision) if id in by_id)
    rows = [row for row in able((*golden, *fresh), hello) if selection.takes(row)]
    every = _headings(corpus, fresh)
    left = {row.solid for row in every} - {type_of(row.solid) for row in rows}
    return rows, Left(tuple(sorted(left)), len(every) - len(rows))
