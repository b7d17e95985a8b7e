"""What a hunt writes: rows that a corpus is, beside those of other hunts; a report that is JSON."""

import json
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from math import inf
from threading import Barrier

import pytest

from raycert.cases.corpus import MANIFEST, read_corpus
from raycert.cases.protocol import Reply
from raycert.oracle.certify.grading import grade
from raycert.oracle.client.inprocess import InProcess
from raycert.oracle.client.process import Failure
from raycert.oracle.hunt import keep
from raycert.oracle.hunt.executors import Here
from raycert.oracle.hunt.pursuit import work
from raycert.oracle.hunt.search import Budget, hunt
from raycert.oracle.hunt.unit import Job
from raycert.oracle.zoo.inhabitants import BY_NAME
from shared.hunted_targets import spec


def hunted(name, seed=0):
    job = Job(InProcess("callable", spec(name)), golden=None, seed=seed)
    return hunt(job, Budget(cases=160, unit=160, most=3), Here(partial(work, job)))


@pytest.fixture(scope="module")
def found():
    return hunted("no-clip")


def written(folder, found, seed=0, **asked):
    return keep.write(folder, found, {"seed": seed, **asked})


def test_each_row_that_is_read_back_fails_as_it_was_found(tmp_path, found):
    findings = written(tmp_path, found)
    rows = read_corpus("binary64", tmp_path).rows
    assert {row.id for row in rows} == set(findings)
    tracer = BY_NAME["no-clip"].make()
    for row in rows:
        reply = Reply("", intervals=tuple(tracer(row.solid, row.ray)))
        assert grade(row, reply, found.looker.hello).fault("stable")
    report = json.loads((tmp_path / "hunt-0.json").read_text())
    assert [one["id"] for one in report["findings"]] == list(findings)


def test_what_is_asked_before_is_a_row_before(tmp_path):
    found = hunted("echo")
    [(id, finding), *_] = written(tmp_path, found).items()
    ids = [row.id for row in read_corpus("binary64", tmp_path).rows]
    before = [f"{id}-before-{i}" for i in range(1, len(finding.before) + 1)]
    assert before
    assert ids[: len(before) + 1] == [*before, id]


def test_another_hunt_leaves_the_rows_of_the_first(tmp_path, found):
    written(tmp_path, found)
    first = {row.id for row in read_corpus("binary64", tmp_path).rows}
    written(tmp_path, hunted("always-empty", seed=-5), seed=-5)
    families = {row.family for row in read_corpus("binary64", tmp_path).rows}
    assert families == {"hunt-0", "hunt-minus-5"}
    written(tmp_path, replace(found, findings={}, seconds=-1.0), seed=-5)
    assert {row.id for row in read_corpus("binary64", tmp_path).rows} == first
    assert (tmp_path / MANIFEST).exists()


def test_only_the_same_hunt_again_takes_the_place_of_its_rows(tmp_path, found):
    first = written(tmp_path, found, target=["one"])
    assert {id.partition("/")[0] for id in first} == {"hunt-0"}
    for target, name in (("one", "hunt-0"), ("two", "hunt-0-2"), ("two", "hunt-0-2")):
        later = replace(found, seconds=-1.0)  # it began after all that is there
        again = written(tmp_path, later, target=[target])
        assert {id.partition("/")[0] for id in again} == {name}
    long = replace(found, seconds=60.0)  # what is there was written meanwhile
    assert next(iter(written(tmp_path, long, target=["one"]))).startswith("hunt-0-3/")
    (tmp_path / "hunt-0.json").write_text("[")
    assert next(iter(written(tmp_path, long, target=["one"]))).startswith("hunt-0-4/")
    assert len(read_corpus("binary64", tmp_path).rows) == 4 * len(first)


def test_hunts_that_write_at_once_lose_nothing(tmp_path, found):
    """Forty: five at a time, several of one seed."""
    one = replace(found, findings=dict([*found.findings.items()][:1]))
    start = Barrier(5)

    def write(number):
        start.wait()
        return set(written(tmp_path, one, seed=number % 3, target=[number]))

    with ThreadPoolExecutor(5) as pool:
        ids = [id for names in pool.map(write, range(40)) for id in names]
    assert len(ids) == len(set(ids)) == 40
    assert {row.id for row in read_corpus("binary64", tmp_path).rows} == set(ids)
    assert len(list(tmp_path.glob("hunt-*.json"))) == 40


def test_every_outcome_can_be_told():
    assert keep.answer(Reply("", intervals=((0.0, inf),))) == [[0.0, "inf"]]
    assert keep.answer(Reply("", first=None)) is None
    assert keep.answer(Reply("", hit=False)) is False
    assert keep.answer(Reply("", error="no")) == {"error": "no"}
    assert keep.answer(Failure("hang", "silent")) == {"hang": "silent"}
