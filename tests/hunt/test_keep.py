"""What a hunt writes: rows that a corpus is, beside those of other hunts; a report that is JSON."""

import json
from functools import partial
from math import inf

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


def written(folder, found, seed=0):
    findings = keep.named(found.findings.values(), seed)
    rows = keep.rows(findings, found.looker)
    fmt = found.looker.hello.format
    keep.write(folder, seed, rows, fmt, keep.form(found, findings, {"seed": seed}))
    return findings


def test_each_row_that_is_read_back_fails_as_it_was_found(tmp_path):
    found = hunted("no-clip")
    findings = written(tmp_path, found)
    rows = read_corpus("binary64", tmp_path).rows
    assert {row.id for row in rows} == set(findings)
    tracer = BY_NAME["no-clip"].make()
    for row in rows:
        reply = Reply("", intervals=tuple(tracer(row.solid, row.ray)))
        assert grade(row, reply, found.looker.hello).fault("stable")
    report = json.loads((tmp_path / keep.REPORT).read_text())
    assert [one["id"] for one in report["findings"]] == list(findings)


def test_what_is_asked_before_is_a_row_before(tmp_path):
    found = hunted("echo")
    [(id, finding), *_] = written(tmp_path, found).items()
    ids = [row.id for row in read_corpus("binary64", tmp_path).rows]
    before = [f"{id}-before-{i}" for i in range(1, len(finding.before) + 1)]
    assert before
    assert ids[: len(before) + 1] == [*before, id]


def test_another_hunt_leaves_the_rows_of_the_first(tmp_path):
    written(tmp_path, hunted("no-clip"))
    first = {row.id for row in read_corpus("binary64", tmp_path).rows}
    written(tmp_path, hunted("always-empty", seed=-5), seed=-5)
    families = {row.family for row in read_corpus("binary64", tmp_path).rows}
    assert families == {"hunt-0", "hunt-minus-5"}
    empty = hunted("no-clip")
    empty.findings.clear()
    written(tmp_path, empty, seed=-5)
    assert {row.id for row in read_corpus("binary64", tmp_path).rows} == first
    assert (tmp_path / MANIFEST).exists()


def test_every_outcome_can_be_told():
    assert keep.answer(Reply("", intervals=((0.0, inf),))) == [[0.0, "inf"]]
    assert keep.answer(Reply("", first=None)) is None
    assert keep.answer(Reply("", hit=False)) is False
    assert keep.answer(Reply("", error="no")) == {"error": "no"}
    assert keep.answer(Failure("hang", "silent")) == {"hang": "silent"}
