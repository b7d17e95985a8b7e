"""Ways take turns and the least time counts: never a time itself."""

from __future__ import annotations

from math import inf
from types import SimpleNamespace

import numpy as np
import pytest

from raycert.oracle.measure import clock
from raycert.oracle.measure.clock import FEWEST, THREADS, Race, Time, Timed, processor, wall


def test_ways_take_turns_and_the_last_answer_is_kept() -> None:
    seen: list[str] = []

    def way(name: str) -> int:
        seen.append(name)
        return len(seen)

    advanced: list[None] = []
    race = Race({"a": lambda: way("a"), "b": lambda: way("b")})
    race.run(3, advance=lambda: advanced.append(None))
    assert seen == ["a", "b"] * 3
    assert len(advanced) == 6
    assert race.answers == {"a": 5, "b": 6}
    assert all(0 <= race.least(name) < inf for name in "ab")


def timed(*seconds: float) -> Race:
    passes = iter(seconds)
    return Race({"a": lambda: Timed(next(passes), "answer")})


def test_a_way_that_has_had_its_seconds_stops_after_the_fewest() -> None:
    assert len(timed(*[10.0] * 9).run(9, 5.0).seconds["a"]) == FEWEST
    assert len(timed(*[0.1] * 9).run(9, 5.0).seconds["a"]) == 9
    assert len(timed(*[1.0] * 9).run(9, 5.0).seconds["a"]) == 5


def test_the_least_time_counts_and_the_noise_is_told() -> None:
    race = timed(8.0, 2.0, 4.0, 6.0, 10.0).run(5)
    assert race.least("a") == 2.0
    assert race.answers["a"] == "answer"
    assert Time.of(race.seconds["a"], 2) == Time(1.0, 3.0, 2.0, 5, 2)
    assert Time.of([3.0]) == Time(3.0, 3.0, 0.0, 1, 1)


def test_an_interruption_loses_no_pass() -> None:
    def stop() -> None:
        raise KeyboardInterrupt

    race = Race({"a": lambda: Timed(1.0), "b": stop})
    with pytest.raises(KeyboardInterrupt):
        race.run(3)
    assert race.seconds == {"a": [1.0], "b": []}


def test_the_processors_time_is_not_that_on_the_wall(monkeypatch: pytest.MonkeyPatch) -> None:
    ticks = iter([1.0, 3.5])
    monkeypatch.setattr(clock, "process_time", lambda: next(ticks))
    assert processor(lambda: "x") == Timed(2.5, "x")
    assert wall(lambda: "x").answer == "x"


@pytest.mark.parametrize("loaded", [True, False])
def test_threads_are_set_only_before_anybody_reads_them(
    loaded: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    environ: dict[str, str] = {}
    monkeypatch.setattr(clock, "os", SimpleNamespace(environ=environ))
    modules = {"numpy": np} if loaded else {}
    monkeypatch.setattr(clock, "sys", SimpleNamespace(modules=modules))
    clock.one_thread()
    assert environ == ({} if loaded else dict.fromkeys(THREADS, "1"))
