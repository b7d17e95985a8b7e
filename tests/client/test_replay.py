"""Every question gets an outcome, each failure is pinned on its cause, and nothing is left."""

from __future__ import annotations

import contextlib
import json
import os
import resource
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from raycert.cases.model import Cylinder, Ray
from raycert.cases.protocol import Reply
from raycert.oracle.client import descendants
from raycert.oracle.client.dialogue import LEFT, Limits, Question, Unusable, fresh_ids
from raycert.oracle.client.process import Failure
from raycert.oracle.client.replay import Interrupted, Run, greet, run
from shared.places import CLIENTS
from shared.processes import alive, gone

CAN = Cylinder((0, 0, 0), (0, 0, 1), 1)
SHORT = Limits(hello=10.0, case=0.6)


def command(name: str, *words: object) -> list[str]:
    return [sys.executable, str(CLIENTS / f"{name}.py"), *map(str, words)]


def questions(count: int) -> list[Question]:
    """Return questions that hide their number in the ray's origin."""
    return [Question(f"family/{n}", CAN, Ray((n, 0, 0), (0, 0, 1))) for n in range(count)]


def answered(n: int) -> Reply:
    return Reply(f"family/{n}", intervals=((n, n + 1),))


def failures(result: Run) -> dict[int, Failure]:
    """Return the failures by number, after checking that every other answer is the right one."""
    found = {}
    for n, (id, outcome) in enumerate(result.outcomes.items()):
        assert id == f"family/{n}"
        if isinstance(outcome, Failure):
            found[n] = outcome
        else:
            assert outcome == answered(n)
    return found


def kinds(result: Run) -> dict[int, str]:
    return {n: failure.kind for n, failure in failures(result).items()}


def test_a_steady_client_is_heard_out_in_one_process():
    told: list[int] = []
    result = run(command("steady"), questions(1000), SHORT, told.append)
    assert failures(result) == {}
    assert len(result.outcomes) == 1000
    assert (result.restarts, result.notes) == (0, ())
    assert result.hello.name == "planted"
    assert told == sorted(told)
    assert told[-1] == 1000


def test_no_questions_are_no_trouble():
    assert run(command("steady"), [], SHORT).outcomes == {}


def test_two_questions_of_one_id_are_refused():
    with pytest.raises(ValueError, match="same id"):
        run(command("steady"), [*questions(2), *questions(1)], SHORT)


def test_ids_on_the_wire_are_fresh_and_tell_nothing():
    ids = fresh_ids()
    some = [next(ids) for _ in range(10_000)]
    assert len(set(some)) == len(some)
    assert sorted(some) != some
    assert next(fresh_ids()) not in some


@pytest.mark.parametrize("window", [1, 2, 7, 64])
def test_every_window_gives_the_same_outcomes(window: int):
    limits = Limits(case=0.6, window=window)
    result = run(command("faulty", "crash=10"), questions(35), limits)
    assert kinds(result) == {10: "crash", 20: "crash", 30: "crash"}


def test_crashes_and_hangs_are_pinned_and_all_else_is_graded():
    result = run(command("faulty", "hang=500", "crash=100"), questions(1201), SHORT)
    expected = {n: "hang" if n % 500 == 0 else "crash" for n in range(100, 1201, 100)}
    assert kinds(result) == expected
    crash = failures(result)[100]
    assert "exit status 3" in crash.detail
    assert "Segmentation fault (planted)" in crash.detail
    assert "no answer for 0.6 s" in failures(result)[500].detail


@pytest.mark.parametrize(
    ("fault", "kind", "says"),
    [
        ("wrong-id", "wrong-id", "'something'"),
        ("chatter", "bad-line", "is not JSON"),
        ("after", "bad-line", "traced one more"),
        ("half", "crash", "in the middle of a line"),
        ("no-newline", "hang", "without a newline"),
    ],
)
@pytest.mark.parametrize("count", [8, 12])
def test_a_fault_is_pinned_on_its_question(fault: str, kind: str, says: str, count: int):
    result = run(command("faulty", f"{fault}=7"), questions(count), SHORT)
    assert kinds(result) == {7: kind}
    assert says in failures(result)[7].detail


def test_a_death_after_an_answer_is_pinned_on_that_answer():
    result = run(command("faulty", "dies-after=7"), questions(12), SHORT)
    assert kinds(result) == {7: "crash"}
    assert "exit status 4 after its answer" in failures(result)[7].detail


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("not-json", "is not JSON"),
        ("not-object", "is not a JSON object"),
        ("flat", "not a pair"),
        ("digits", "is not JSON"),
        ("deep", "is not JSON"),
        ("deep-reason", "not a string"),
        ("million", "more than 1048576 bytes"),
        ("utf-8", "is not JSON"),
        ("blank", "is not JSON"),
        ("no-id", "has no id"),
    ],
)
def test_a_hostile_line_is_a_verdict(text: str, says: str):
    result = run(command("raw", text), questions(6), Limits(case=2.0))
    assert kinds(result) == {3: "bad-line"}
    assert says in failures(result)[3].detail
    assert len(failures(result)[3].detail) < 400


def test_a_line_over_the_limit_is_refused_though_it_comes_whole():
    def ask(most: int) -> Run:
        return run(command("raw", "long"), questions(6), Limits(case=2.0, line=most))

    assert ask(1000).outcomes["family/3"] == Reply("family/3", intervals=())
    assert kinds(ask(150)) == {3: "bad-line"}
    assert "more than 150 bytes" in failures(ask(150))[3].detail


def test_a_bad_list_in_the_promised_form_is_left_to_the_judge():
    outcome = run(command("raw", "nan"), questions(6), Limits(case=2.0)).outcomes["family/3"]
    assert isinstance(outcome, Reply)
    assert outcome.intervals is not None


def test_a_line_of_100_megabytes_takes_bounded_memory():
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    result = run(command("huge"), questions(6), Limits(case=2.0))
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert kinds(result) == {3: "bad-line"}
    unit = 1 if sys.platform == "darwin" else 1024
    assert (after - before) * unit < 40_000_000


def test_a_failure_that_depends_on_the_count_is_unrepeatable():
    result = run(command("counted"), questions(25), SHORT)
    found = failures(result)
    assert found
    assert {failure.kind for failure in found.values()} == {"unrepeatable"}
    assert 9 in found
    assert "crash: ended with exit status 0" in found[9].detail


def test_answers_out_of_order_are_unrepeatable_alone():
    result = run(command("eager"), questions(4), SHORT)
    found = failures(result)
    assert set(kinds(result).values()) == {"unrepeatable"}
    assert "in the order of questions" in found[0].detail


def test_a_client_that_never_starts_again_is_given_up(tmp_path: Path):
    result = run(command("once", tmp_path / "used"), questions(20), SHORT)
    assert kinds(result) == dict.fromkeys(range(3, 20), "crash")
    assert "3 restarts failed one after the other" in failures(result)[3].detail
    assert "licence used up" in failures(result)[19].detail
    assert result.restarts == 3
    assert "17 questions without an answer" in result.notes[0]


def test_questions_that_fail_in_a_row_end_the_run():
    limits = Limits(case=0.3, in_a_row=4)
    result = run(command("faulty", "crash=1"), questions(100), limits)
    assert kinds(result) == dict.fromkeys(range(1, 100), "crash")
    assert "4 questions in a row had failed" in failures(result)[99].detail
    assert result.restarts <= 6


def test_time_lost_in_silence_ends_the_run():
    limits = Limits(case=0.3, lost=0.5)
    result = run(command("faulty", "hang=2"), questions(100), limits)
    assert set(kinds(result).values()) == {"hang"}
    assert failures(result)[2].detail.startswith("no answer")
    assert "silence and restarts" in failures(result)[99].detail


def test_a_client_that_does_not_flush_is_found_out():
    result = run(command("swallows", "late"), questions(3), Limits(case=0.3, in_a_row=1))
    assert kinds(result)[0] == "hang"
    assert "output is not flushed" in failures(result)[0].detail


def test_a_client_that_never_reads_does_not_block_the_writer():
    began = time.monotonic()
    limits = Limits(case=0.3, in_a_row=2, window=5000)
    result = run(command("deaf"), questions(5000), limits)
    assert set(kinds(result).values()) == {"hang"}
    assert time.monotonic() - began < 10


def test_a_slow_reader_is_waited_for():
    result = run(command("slow"), questions(40), Limits(case=0.6))
    assert failures(result) == {}
    assert result.restarts == 0


def test_standard_error_is_drained():
    assert failures(run(command("noisy"), questions(20), Limits(case=2.0))) == {}


@pytest.mark.parametrize(
    ("ending", "note"),
    [("3", "exit status 3"), ("stays", "did not end within 1 s when its input ended")],
)
def test_an_odd_end_is_noted(ending: str, note: str):
    result = run(command("farewell", ending), questions(5), SHORT)
    assert failures(result) == {}
    assert note in result.notes[0]


def test_a_farewell_is_a_bad_line():
    result = run(command("farewell", "5 rays traced"), questions(5), SHORT)
    assert kinds(result) == {4: "bad-line"}
    assert "5 rays traced" in failures(result)[4].detail


@pytest.mark.parametrize("words", [[], ["dies"]])
def test_grandchildren_are_killed_too(tmp_path: Path, words: list[str]):
    pids = tmp_path / "pids"
    result = run(command("family", pids, *words), questions(6), SHORT)
    assert kinds(result) == ({3: "crash"} if words else {})
    children = [int(word) for word in pids.read_text().split()]
    assert len(children) == 1 + result.restarts
    assert gone(children)


@pytest.mark.parametrize("words", [["escapes"], ["escapes", "dies"]])
def test_a_child_that_left_the_session_holds_nobody_up_and_ends(tmp_path: Path, words: list[str]):
    pids = tmp_path / "pids"
    stranger = subprocess.Popen(["sleep", "60"], start_new_session=True)
    began = time.monotonic()
    try:
        result = run(command("family", pids, *words), questions(6), Limits(case=3.0))
        assert kinds(result) == ({3: "crash"} if "dies" in words else {})
        assert time.monotonic() - began < 10
        children = [int(word) for word in pids.read_text().split()]
        assert len(children) == 1 + result.restarts
        assert sys.platform != "linux" or gone(children)
        assert alive(stranger.pid)
    finally:
        for pid in [stranger.pid, *map(int, pids.read_text().split())]:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        stranger.wait()


def test_whom_the_system_does_not_let_us_find_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(descendants, "_found", lambda _: ())
    pids = tmp_path / "pids"
    try:
        result = run(command("family", pids, "dies", "escapes"), questions(6), Limits(case=3.0))
        assert result.notes == (LEFT,)
    finally:
        for word in pids.read_text().split():
            os.kill(int(word), signal.SIGKILL)


def test_threads_and_pipes_are_given_back():
    run(command("faulty", "crash=3"), questions(10), SHORT)
    threads = threading.active_count()
    pipes = len(os.listdir("/dev/fd"))
    run(command("faulty", "crash=3", "hang=8"), questions(10), SHORT)
    assert threading.active_count() == threads
    assert len(os.listdir("/dev/fd")) == pipes


def test_an_interrupt_keeps_what_is_known_and_kills_the_client(tmp_path: Path):
    def interrupt(known: int) -> None:
        if known >= 3:
            signal.raise_signal(signal.SIGINT)

    pids = tmp_path / "pids"
    with pytest.raises(KeyboardInterrupt) as caught:
        run(command("family", pids), questions(50), Limits(case=0.6, window=1), interrupt)
    assert isinstance(caught.value, Interrupted)
    partial = caught.value.run
    assert partial.outcomes == {f"family/{n}": answered(n) for n in range(3)}
    assert gone([int(word) for word in pids.read_text().split()])


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["dies"], ["exit status 7", "no such scene: room.xml", '{"hello": 1, "name"']),
        (["banner"], ["'My Tracer 2.1'", "standard error"]),
        (["silent"], ["no answer for 0.5 s", "has read nothing of its input", "--hello-timeout"]),
        (["nameless"], ["hello.name is missing"]),
        (["segfault"], ["was killed by SIGSEGV"]),
        (["deep", "100000"], ["is not JSON"]),
        (["deep", "900"], ["bad hello"]),
        (["deep", "950"], ["bad hello"]),
    ],
)
def test_a_bad_start_is_unusable_and_says_what_was_seen(words: list[str], says: list[str]):
    with pytest.raises(Unusable) as caught:
        run(command("hello", *words), questions(3), Limits(hello=0.5))
    for text in says:
        assert text in str(caught.value)


@pytest.mark.parametrize("moment", [0.6, 0.8])
def test_a_slow_start_is_not_taken_for_output_that_is_not_flushed(moment: float):
    """Its hello comes while it is looked at whether one waits in a buffer."""
    with pytest.raises(Unusable, match="still starting") as caught:
        greet(command("hello", "slow", moment), Limits(hello=0.5))
    assert "flush" not in str(caught.value)


def test_a_slow_end_is_waited_for():
    result = run(command("farewell", "slow"), questions(3), Limits(case=5.0))
    assert (failures(result), result.notes) == ({}, ())


def test_a_hello_that_is_not_flushed_is_told():
    with pytest.raises(Unusable, match="output is not flushed"):
        greet(command("swallows"), Limits(hello=0.5))


@pytest.mark.parametrize("target", [["/no/such/tracer"], [str(CLIENTS)], [], ["a\0b"]])
def test_a_command_that_cannot_be_started_is_unusable(target: list[str]):
    with pytest.raises(Unusable, match="cannot start"):
        greet(target)


def test_the_hello_sets_the_spelling_of_the_questions(tmp_path: Path):
    log = tmp_path / "log"
    hello = json.dumps({"hello": 1, "name": "x", "numbers": "bits", "precision": "binary32"})
    script = (
        "import sys, json\n"
        "for line in sys.stdin:\n"
        f"    open({str(log)!r}, 'a').write(line)\n"
        "    m = json.loads(line)\n"
        f"    print({hello!r} if 'hello' in m else json.dumps({{'id': m['id'], 'intervals': "
        "[['3f800000', None]]}), flush=True)\n"
    )
    result = run([sys.executable, "-c", script], questions(1), Limits(case=1.0))
    assert result.outcomes == {"family/0": Reply("family/0", intervals=((1.0, float("inf")),))}
    asked = json.loads(log.read_text().splitlines()[1])
    assert asked["ray"]["direction"] == ["00000000", "00000000", "3f800000"]
    assert "family" not in asked["id"]
