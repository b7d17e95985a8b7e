"""`raycert export`: the golden rows as flat TSV, for readers with no JSON or hex-float parser."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import click

from raycert.cases.corpus import Corpus
from raycert.cases.formats import Format
from raycert.cases.model import SOLIDS, Solid, Tree, type_of, types
from raycert.cases.numbers import leaf_numbers
from raycert.cases.row import End, GoldenRow
from raycert.oracle.commands.listing import select
from raycert.oracle.commands.options import (
    FILE_OR_DASH,
    BadInput,
    family_option,
    golden_option,
    out_option,
    precision_option,
    read,
    repeatable,
    solid_option,
    statuses,
    tier_option,
    unknown,
    write_out,
)
from raycert.oracle.reports.foreign import clean, say

HEADER = """id tier type solid ray expected down up decisive
sound_inner sound_outer sound_most stable_inner stable_outer stable_most touches"""
COLUMNS = HEADER.split()

GRAMMAR = """\
Lines that begin with # are comments. Every other line is a row: tabs between
columns, blanks between tokens, no column empty. Each list begins with its length,
so that a row can be read token by token, whatever separates them (scanf %s).

number    {digits} hex digits: the {name} bit pattern, most
          significant first; {inf} is infinity
pairs     N, then N times: enter leave
type      and solid, together in prefix notation:
            half_space  point normal               6 numbers
            sphere  center radius                  4 numbers
            slab  p q                              6 numbers
            infinite_cylinder  p q radius          7 numbers
            cylinder  p q radius                   7 numbers
            union, intersection, difference        N, then N times: type solid
ray       origin direction                         6 numbers
expected  pairs: the exact list, every end rounded to nearest; what touches is merged
down      pairs      up      pairs: the ends of expected, rounded down and rounded up
decisive  N, then N levels that the row decides: sound stable faithful exact
inner     pairs      outer   pairs      most   N, then a count for each outer pair
touches   N, then a word for each exact interval: none tangent wall cap rim start

An answer, a list of pairs, is well-formed if 0 <= enter <= leave < the next enter,
no number is NaN and no enter infinite (but where one of up is); and, on the lattice
tier, if it is empty or its last leave is infinite just where that of down is.

It is sound (stable) if it is well-formed and
  each pair of the answer lies in a pair of sound_outer (stable_outer),
  each pair of sound_inner lies in a pair of the answer,
  each pair of sound_outer holds at most its sound_most pairs of the answer.
It is exact if it is expected, and faithful if it has as many pairs and each end is
that of down or that of up. What a tracer declares to drop is left out of these three,
where there is a word of touches for each pair of expected.

A level counts the rows that are decisive for it, none of the range tier, and none with
a zero direction or a radius of 0, unless a tracer is for those. A row that is not
well-formed, or not answered, fails every level; a row that fails a level that it
decides fails the stronger ones that it decides.
"""


EXAMPLES = """\b
Examples:
  raycert export --out golden.tsv
  raycert export --precision binary32 --declared cylinder --tier lattice
"""


def _help() -> str:
    """Return examples and grammar as blocks that --help leaves as they are."""
    names = {"digits": "16 (8)", "name": "binary64 (binary32)", "inf": "7ff0000000000000"}
    blocks = GRAMMAR.format(**names).strip().split("\n\n")
    return "\n\n".join((EXAMPLES, *(f"\b\n{block}" for block in blocks), statuses()))


@click.command(epilog=_help())
@out_option(FILE_OR_DASH, "- is standard output.", default="-", show_default=True)
@family_option
@tier_option
@solid_option
@repeatable("--declared", "declared", "Only rows for who declares this solid, and the others given")
@precision_option
@golden_option
def export(
    out: str, declared: tuple[str, ...], precision: str, golden: Path | None, **rows: Any
) -> None:
    """Write golden rows as flat TSV with bit patterns: no JSON, no decimal to parse."""
    corpus = read(precision, golden)
    chosen = select(corpus, **rows)
    chosen = _made_of(chosen, declared) if declared else chosen
    if not chosen:
        raise BadInput("no row is such; see: raycert list --families")
    if write_out(out, "".join(f"{line}\n" for line in lines(chosen, corpus))) and out != "-":
        say(f"{len(chosen)} rows written to {out}", err=True)


def _made_of(rows: list[GoldenRow], declared: tuple[str, ...]) -> list[GoldenRow]:
    """Return the rows whose solids are made of the declared types alone."""
    for name in declared:
        if name not in SOLIDS:
            unknown("solid", name, SOLIDS)
    return [row for row in rows if types(row.solid) <= set(declared)]


def lines(rows: list[GoldenRow], corpus: Corpus) -> Iterator[str]:
    fmt = corpus.format
    yield f"# raycert golden rows, {fmt.name}, corpus {clean(corpus.version, 80)}, data CC0"
    yield f"# manifest sha256 {corpus.sha256}"
    grammar = GRAMMAR.format(digits=fmt.digits, name=fmt.name, inf=fmt.bits(float("inf")))
    for line in grammar.splitlines():
        yield f"# {line}".rstrip()
    yield from ("#", "# " + "\t".join(COLUMNS))
    for row in rows:
        yield "\t".join(cells(row, fmt))


def cells(row: GoldenRow, fmt: Format) -> Iterator[str]:
    kind, _, solid = _solid(row.solid, fmt).partition(" ")
    yield from (row.id, row.tier, kind, solid, _numbers((*row.ray.origin, *row.ray.direction), fmt))
    yield _pairs(row.expected, fmt)
    enclosing = merged_ends(row)
    yield _pairs([(enter.down, leave.down) for enter, leave in enclosing], fmt)
    yield _pairs([(enter.up, leave.up) for enter, leave in enclosing], fmt)
    yield _words(row.decisive)
    for level in ("sound", "stable"):
        accept = row.accept[level]
        yield _pairs(accept.inner, fmt)
        yield _pairs(accept.outer, fmt)
        yield _words(accept.most)
    yield _words([span.touch or "none" for span in row.intervals])


def merged_ends(row: GoldenRow) -> list[tuple[End, End]]:
    """Return the exact ends of each pair of the expected list, as merging leaves them.

    Intervals touch after rounding if an enter is not beyond the leave before it.
    """
    ends: list[tuple[End, End]] = []
    for span in row.intervals:
        if ends and span.enter.nearest <= ends[-1][1].nearest:
            ends[-1] = (ends[-1][0], span.leave)
        else:
            ends.append((span.enter, span.leave))
    return ends


def _solid(solid: Solid, fmt: Format) -> str:
    """Return a solid in prefix notation."""
    if isinstance(solid, Tree):
        return f"{type_of(solid)} {_words([_solid(part, fmt) for part in solid.of])}"
    return f"{type_of(solid)} {_numbers(leaf_numbers(solid), fmt)}"


def _numbers(values: Iterable[float], fmt: Format) -> str:
    return " ".join(map(fmt.bits, values))


def _pairs(pairs: Sequence[tuple[float, float]], fmt: Format) -> str:
    return _words([_numbers(pair, fmt) for pair in pairs])


def _words(words: Sequence[object]) -> str:
    """Return their number and the words."""
    return " ".join(map(str, (len(words), *words)))
