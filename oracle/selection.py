"""Which rows of the corpus are sent: what the client declared, narrowed by what the person asks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

from cases.corpus import Corpus
from cases.model import Solid, Tree, type_of
from cases.protocol import Hello
from cases.row import GoldenRow
from oracle.certificate import Left


@dataclass(frozen=True, slots=True)
class Selection:
    """The options that narrow a run; an empty one narrows nothing."""

    solids: tuple[str, ...] = ()
    tiers: tuple[str, ...] = ()
    families: tuple[str, ...] = ()
    ids: tuple[str, ...] = ()

    def takes(self, row: GoldenRow) -> bool:
        """Tell whether a row is selected."""
        asked: tuple[tuple[tuple[str, ...], str], ...] = (
            (self.solids, type_of(row.solid)),
            (self.tiers, row.tier),
            (self.families, row.family),
            (self.ids, row.id),
        )
        return all(not wanted or value in wanted for wanted, value in asked)

    def options(self) -> tuple[str, ...]:
        """Return the command-line options that select the same."""
        names = {"solids": "--solid", "tiers": "--tier", "families": "--family", "ids": "--id"}
        return tuple(
            word
            for field in fields(self)
            for value in getattr(self, field.name)
            for word in (names[field.name], value)
        )

    def missing(self, corpus: Corpus) -> list[str]:
        """Return what is asked for and not in the corpus."""
        there: dict[str, set[str]] = {
            "solids": {type_of(row.solid) for row in corpus.rows},
            "tiers": {row.tier for row in corpus.rows},
            "families": {row.family for row in corpus.rows},
            "ids": {row.id for row in corpus.rows},
        }
        return [
            value
            for name, known in there.items()
            for value in getattr(self, name)
            if value not in known
        ]


def types(solid: Solid) -> set[str]:
    """Return the types of a solid and of all its parts."""
    found = {type_of(solid)}
    if isinstance(solid, Tree):
        found |= set().union(*(types(part) for part in solid.of))
    return found


def select(corpus: Corpus, hello: Hello, selection: Selection) -> tuple[list[GoldenRow], Left]:
    """Return the rows to send, and what is left out because it was not declared or selected."""
    declared = set(hello.solids)
    able = [row for row in corpus.rows if types(row.solid) <= declared]
    rows = [row for row in able if selection.takes(row)]
    left = sorted({type_of(row.solid) for row in corpus.rows} - _roots(rows))
    return rows, Left(tuple(left), len(corpus.rows) - len(rows))


def _roots(rows: Sequence[GoldenRow]) -> set[str]:
    return {type_of(row.solid) for row in rows}
