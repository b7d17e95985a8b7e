"""The fresh block: the same for a seed, fair to sound tracers, and hard on wrong ones."""

import hashlib
import json
from functools import cache

import pytest

from raycert.cases.flags import FLAGS
from raycert.cases.formats import BINARY32, BINARY64, FORMATS, Format
from raycert.cases.forms import write_ray, write_solid
from raycert.cases.levels import Level
from raycert.cases.model import SOLIDS, types
from raycert.cases.protocol import Hello, Pairs, Reply
from raycert.cases.row import GoldenRow, read_row, write_row
from raycert.oracle.certify.grading import grade
from raycert.oracle.certify.verdict import verdict
from raycert.oracle.corpus.fresh import Fresh, fresh_cases, fresh_rows
from raycert.oracle.exact.trace import trace
from raycert.oracle.zoo.inhabitants import FAULTS, SOUND
from raycert.oracle.zoo.matrix import Trials
from raycert.reference.tracer import intersect

EVERY = tuple(SOLIDS)
HELLO = Hello("a tracer")


@cache
def block(seed: int = 7, count: int = 150, fmt: Format = BINARY64) -> tuple[GoldenRow, ...]:
    return fresh_rows(seed, count, fmt, EVERY)


@pytest.mark.parametrize("fmt", FORMATS.values(), ids=lambda fmt: fmt.name)
def test_rows_are_golden_rows_of_the_format(fmt: Format) -> None:
    rows = block(fmt=fmt)
    assert len({row.id for row in rows}) == len(rows) == 150
    for row in rows:
        assert read_row(write_row(row, fmt), fmt) == row
        assert row.family == "fresh-7"
        assert row.tier in ("generic", "stiff")
        assert set(row.flags) <= set(FLAGS)


def test_a_seed_gives_the_same_rows_on_every_machine() -> None:
    """Recorded on Linux, x86-64, Python 3.11; another machine is no reason to change it."""
    questions = [
        [row.id, write_solid(row.solid, "hex"), write_ray(row.ray, "hex")] for row in block()
    ]
    digest = hashlib.sha256(json.dumps(questions).encode()).hexdigest()
    assert digest == "8770e721de9adf274895adae804cda3a3ed6e806df5a5b777adc027ae99bf10b"


def test_a_larger_block_begins_with_the_smaller_one() -> None:
    assert fresh_rows(7, 20, BINARY64, EVERY) == block()[:20]


def test_a_row_is_the_same_whatever_else_is_declared() -> None:
    every = {
        case.slug: case
        for case, _ in zip(fresh_cases(7, BINARY64, EVERY), range(300), strict=False)
    }
    some = fresh_cases(7, BINARY64, ("sphere", "union"))
    found = [case for case, _ in zip(some, range(20), strict=False)]
    assert all(types(case.solid) <= {"sphere", "union"} for case in found)
    assert {"sphere", "union"} == {name for case in found for name in types(case.solid)}
    assert all(every[case.slug] == case for case in found if case.slug in every)


def test_seeds_differ() -> None:
    questions = [{(row.solid, row.ray) for row in block(seed, 60)} for seed in (7, 8)]
    assert len(questions[0] & questions[1]) <= 2


@pytest.mark.parametrize("name", [name for name, kind in SOLIDS.items()][:5])
def test_each_leaf_alone_has_cases(name: str) -> None:
    rows = fresh_rows(3, 12, BINARY64, (name,))
    assert len(rows) == 12
    assert {kind for row in rows for kind in types(row.solid)} == {name}


def test_trees_without_leaves_have_no_cases() -> None:
    assert fresh_rows(3, 12, BINARY64, ("union", "difference")) == ()


@pytest.mark.parametrize("seed", [1, 2])
def test_the_reference_is_stable_and_the_oracle_exact(seed: int) -> None:
    rows = block(seed)
    answers: tuple[tuple[Level, list[Pairs]], ...] = (
        ("stable", [tuple(intersect(row.solid, row.ray)) for row in rows]),
        ("exact", [row.expected for row in rows]),
    )
    for level, answered in answers:
        pairs = zip(rows, answered, strict=True)
        graded = [grade(row, Reply(row.id, intervals=answer), HELLO) for row, answer in pairs]
        judged = verdict(graded, level, "closed")
        assert judged.granted, judged.reasons


def test_sound_tracers_are_granted_what_they_deserve() -> None:
    for sound in SOUND:
        if sound.precision == "binary64" and sound.deserves == "stable":
            for row in block():
                answer = tuple((a + 0.0, b + 0.0) for a, b in sound.tracer(row.solid, row.ray))
                if "stable" in row.decisive and sound.convention == "closed":
                    assert row.accept["stable"].fault(answer) is None, (sound.name, row.id)


def test_most_rows_are_decisive_and_many_hit() -> None:
    rows = block()
    assert sum("stable" in row.decisive for row in rows) > 0.9 * len(rows)
    assert sum(bool(row.expected) for row in rows) > 0.6 * len(rows)
    assert all(len(trace(row.solid, row.ray).intervals) == len(row.intervals) for row in rows[:20])


def test_most_of_the_zoo_is_refused() -> None:
    """Of a whole block, 500 rows: 111 to 113 of 117, over ten seeds."""
    bench = Trials(block(1, 250), BINARY64)
    killed = [f.name for f in FAULTS if any(refusal for _, refusal in bench.tried(f))]
    assert len(killed) > 0.8 * len(FAULTS)


def test_binary32_numbers_are_binary32_numbers() -> None:
    for row in block(fmt=BINARY32):
        assert all(BINARY32.holds(x) for x in (*row.ray.origin, *row.ray.direction))


def test_the_options_draw_the_same_block() -> None:
    assert Fresh(7).options() == ("--seed", "7")
    assert Fresh(7, 40).options() == ("--seed", "7", "--fresh", "40")
