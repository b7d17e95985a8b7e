"""Which rows are sent: shards part the corpus, and options say how to select the same again."""

from dataclasses import replace

import pytest

from raycert.cases.corpus import read_corpus
from raycert.cases.protocol import Hello
from raycert.oracle.certify.selection import (
    MOST_SHARDS,
    BadShard,
    Selection,
    Shard,
    able,
    select,
    types,
)
from shared.corpus import golden

CORPUS = golden()
EVERY = Hello("every")
IDS = [row.id for row in CORPUS.rows]


@pytest.mark.parametrize("of", [1, 2, 3, 5, 8])
def test_every_row_is_in_exactly_one_shard(of: int) -> None:
    shards = [Shard(number, of) for number in range(1, of + 1)]
    assert all(sum(shard.takes(id) for shard in shards) == 1 for id in IDS)


@pytest.mark.parametrize("of", [2, 5, 8])
def test_shards_are_balanced(of: int) -> None:
    """A binomial share: four standard deviations."""
    share = len(IDS) / of
    for number in range(1, of + 1):
        size = sum(Shard(number, of).takes(id) for id in IDS)
        assert abs(size - share) < 4 * share**0.5


def test_a_row_that_comes_or_goes_moves_no_other() -> None:
    shard = Selection(shard=Shard(2, 3))
    before, _ = select(CORPUS, EVERY, shard)
    fewer = replace(CORPUS, rows=CORPUS.rows[1::2])
    after, _ = select(fewer, EVERY, shard)
    left = {row.id for row in fewer.rows}
    assert after == [row for row in before if row.id in left]


def test_shards_are_where_they_were() -> None:
    """The hash is a contract: with another, the shards of an old certificate cannot be repeated."""
    first = [Shard(1, 2).takes(id) for id in ("far-deep/across-1e1", "rim/enters-p", "x/y", "x/z")]
    assert first == [False, False, False, True]


def test_all_shards_together_are_the_whole_selection() -> None:
    whole, _ = select(CORPUS, EVERY, Selection(solids=("sphere",)))
    parts = [
        select(CORPUS, EVERY, Selection(solids=("sphere",), shard=Shard(number, 4)))
        for number in range(1, 5)
    ]
    assert sorted(row.id for rows, _ in parts for row in rows) == sorted(r.id for r in whole)
    assert all(len(rows) + left.rows == len(IDS) for rows, left in parts)


@pytest.mark.parametrize("text", ["1/1", "2/5", f"{MOST_SHARDS}/{MOST_SHARDS}"])
def test_a_shard_is_spelled_as_it_is_read(text: str) -> None:
    assert str(Shard.parse(text)) == text


@pytest.mark.parametrize(
    "text",
    ["", "1", "0/5", "6/5", "1/0", "-1/5", "1/5/5", "a/b", "1 / 5", " 1/5", "1/5\n", "1.0/5"],
)
def test_what_is_no_shard_is_refused(text: str) -> None:
    with pytest.raises(BadShard, match="as 2/5 is"):
        Shard.parse(text)


@pytest.mark.parametrize("text", ["1/1001", "\u0661/\u0665", "9" * 10_000 + "/1"])
def test_what_only_looks_like_a_shard_is_refused(text: str) -> None:
    with pytest.raises(BadShard, match="as 2/5 is"):
        Shard.parse(text)


def test_the_options_name_every_narrowing() -> None:
    assert Selection().options() == ()
    full = Selection(("sphere",), ("stiff",), ("far-deep", "rim"), ("x/y",), Shard(2, 5))
    assert " ".join(full.options()) == (
        "--solid sphere --tier stiff --family far-deep --family rim --id x/y --shard 2/5"
    )


def test_what_is_not_declared_is_not_sent() -> None:
    hello = Hello("balls", solids=("sphere", "union"))
    rows, left = select(CORPUS, hello, Selection())
    assert rows == able(CORPUS.rows, hello)
    assert rows
    assert all(types(row.solid) <= {"sphere", "union"} for row in rows)
    others = {name for row in CORPUS.rows for name in types(row.solid)} - {"sphere", "union"}
    assert set(left.solids) == others
    assert left.rows == len(IDS) - len(rows)


def test_fresh_rows_are_narrowed_like_the_others() -> None:
    fresh = [replace(row, id=f"fresh-1/{n}") for n, row in enumerate(CORPUS.rows[:40])]
    rows, _ = select(CORPUS, EVERY, Selection(families=("fresh-1",)), fresh)
    assert rows == fresh
    half, _ = select(CORPUS, EVERY, Selection(families=("fresh-1",), shard=Shard(1, 2)), fresh)
    assert 0 < len(half) < len(fresh)


def test_what_is_nowhere_is_missing() -> None:
    wanted = Selection(("cone",), (), ("far-deep", "fresh-1"), ("no/row",))
    assert wanted.missing(CORPUS) == ["cone", "fresh-1", "no/row"]
    assert wanted.missing(CORPUS, [replace(CORPUS.rows[0], id="fresh-1/0")]) == ["cone", "no/row"]


def test_what_is_not_read_is_counted_and_known() -> None:
    hello, some = Hello("x", solids=("sphere",)), read_corpus(solids=("sphere",))
    assert len(some.rows) < len(CORPUS.rows)
    assert select(some, hello, Selection()) == select(CORPUS, hello, Selection())
    wanted = Selection(solids=("slab",), ids=(CORPUS.rows[0].id, CORPUS.rows[-1].id, "no/row"))
    assert wanted.missing(some) == ["no/row"]
