"""A whole hunt: the same seed finds the same, whoever does the units; Ctrl-C keeps findings."""

from functools import partial

import pytest

from raycert.cases.numbers import numbers
from raycert.oracle.client.dialogue import Unusable
from raycert.oracle.client.inprocess import InProcess
from raycert.oracle.hunt import pursuit, search
from raycert.oracle.hunt.executors import Here, Lost, Processes
from raycert.oracle.hunt.look import UNREPEATED
from raycert.oracle.hunt.pursuit import work
from raycert.oracle.hunt.search import Budget, hunt
from raycert.oracle.hunt.unit import Job
from shared.hunted_targets import spec

SMALL = Budget(cases=360, unit=120, most=3)


def job(name, **options):
    return Job(InProcess("callable", spec(name)), golden=None, **options)


def here(name, budget=SMALL, **options):
    asked = job(name, **options)
    return hunt(asked, budget, Here(partial(work, asked)))


def found(result):
    return [(f.symptom, f.probe, f.flaw, f.first, f.before) for f in result.findings.values()]


def test_the_same_seed_finds_the_same_here_and_in_processes():
    one, asked = here("tolerant-disc"), job("tolerant-disc")
    two = hunt(asked, SMALL, Processes(partial(work, asked), 2))
    assert found(one)
    assert found(one) == found(two)


def test_causes_are_told_apart_and_simple():
    result = here("always-empty")
    causes = list(result.findings)
    assert len(causes) == len(set(causes)) >= 2
    assert any(all(x in (-1, 0, 1) for x in numbers(f.probe)) for f in result.findings.values())


class Impatient(Here):
    """Does one unit; then the person interrupts."""

    def finished(self, seconds):
        if getattr(self, "did", False):
            raise KeyboardInterrupt
        self.did = True
        return super().finished(seconds)


class Failing(Here):
    """Does one unit; then the cluster is gone."""

    def finished(self, seconds):
        if getattr(self, "did", False):
            raise Lost("no worker is left")
        self.did = True
        return super().finished(seconds)


@pytest.mark.parametrize(
    ("kind", "ended"), [(Impatient, "interrupted"), (Failing, "no worker is left")]
)
def test_what_ends_a_hunt_keeps_what_was_found(kind, ended):
    asked = job("no-clip")
    result = hunt(asked, Budget(cases=10_000, unit=160), kind(partial(work, asked)))
    assert result.ended == ended
    assert result.findings
    assert result.tried == 160


def test_a_loss_before_anything_was_tried_is_raised():
    class Gone(Here):
        def finished(self, seconds):
            raise Lost("no worker is left")

    asked = job("no-clip")
    with pytest.raises(Lost):
        hunt(asked, Budget(cases=10_000, unit=40), Gone(partial(work, asked)))


def test_a_loss_keeps_what_waits_for_a_unit_that_will_not_come(monkeypatch):
    monkeypatch.setattr(search, "WIND_UP", 600)  # a loaded machine is no loss

    class Overtaken(Here):
        """Does unit 1; unit 0 and whatever did it are gone."""

        places = 2

        def submit(self, unit):
            if unit.number == 1:
                super().submit(unit)

        def finished(self, seconds):
            if results := super().finished(seconds):
                return results
            raise Lost("no worker is left")

    asked = job("no-clip")
    result = hunt(asked, Budget(cases=320, unit=160), Overtaken(partial(work, asked)))
    assert result.lost
    assert result.findings


def test_an_interruption_in_the_middle_of_a_unit_here_ends_the_hunt(monkeypatch):
    def interrupt(_):
        raise KeyboardInterrupt

    monkeypatch.setattr(pursuit, "drawn", interrupt)  # how the second unit searches
    result = here("no-clip", Budget(cases=480, unit=160))
    assert result.ended == "interrupted"
    assert result.tried == 160


def test_an_answer_that_depends_on_the_one_before_is_kept_with_it():
    result = here("late", Budget(cases=160, unit=160, most=2))
    assert any(f.repeats for f in result.findings.values())
    result = here("echo", Budget(cases=160, unit=160, most=1))
    [finding] = result.findings.values()
    assert finding.before
    assert finding.repeats


def test_what_does_not_come_again_is_said_and_no_row():
    result = here("hundredth", Budget(cases=320, unit=320, most=3))
    [finding] = result.findings.values()
    assert finding.symptom.kind == UNREPEATED
    assert not finding.repeats


def test_a_target_that_cannot_be_run_is_said():
    asked = Job(InProcess("callable", "no_such:thing"))
    with pytest.raises(Unusable):
        hunt(asked, SMALL, Here(partial(work, asked)))


def test_time_ends_a_hunt(monkeypatch):
    """By a clock that goes on with each unit: a loaded machine changes nothing."""
    now = [0.0]

    class Slow(Here):
        def finished(self, seconds):
            results = list(super().finished(seconds))
            now[0] += 60
            return results

    monkeypatch.setattr("time.monotonic", lambda: now[0])
    asked = Job(InProcess("callable", "raycert.reference.tracer:intersect"), golden=None)
    result = hunt(asked, Budget(seconds=150, unit=10), Slow(partial(work, asked)))
    assert 0 < result.tried <= 30
    assert result.seconds == 180
    assert not result.findings
