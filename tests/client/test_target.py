"""What the words of a target mean, and that code in a worker is graded as a program is."""

from __future__ import annotations

import os
import sys
import threading
import time
from pathlib import Path

import pytest

from raycert.cases.model import Cylinder, Ray
from raycert.cases.protocol import Hello, Reply
from raycert.oracle.client.dialogue import Command, Limits, Question, Unusable
from raycert.oracle.client.inprocess import InProcess
from raycert.oracle.client.process import Failure
from raycert.oracle.client.replay import Run, greet, run
from raycert.oracle.client.target import load, target
from raycert.reference import tracer
from shared.places import CLIENTS

CAN = Cylinder((0, 0, 0), (0, 0, 1), 1)
SHORT = Limits(case=0.6)


@pytest.fixture(autouse=True)
def _here(monkeypatch: pytest.MonkeyPatch) -> None:
    """The planted callables are found in the current directory."""
    monkeypatch.chdir(CLIENTS)
    monkeypatch.syspath_prepend("")


def questions(count: int) -> list[Question]:
    return [Question(f"family/{n}", CAN, Ray((n, 0, 0), (0, 0, 1))) for n in range(count)]


def ask(name: str, count: int, limits: Limits = SHORT) -> Run:
    return run(target([f"planted:{name}"]), questions(count), limits)


def failures(result: Run) -> dict[int, Failure]:
    """Return the failures by number, after checking that every other answer is the right one."""
    found = {}
    for n, (id, outcome) in enumerate(result.outcomes.items()):
        assert id == f"family/{n}"
        if isinstance(outcome, Failure):
            found[n] = outcome
        else:
            assert outcome == Reply(id, intervals=((n, n + 1),))
    return found


# The words


def test_the_words_decide(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("tracer.so", "a:b", "x.dylib"):
        (tmp_path / name).write_text("")
    assert target(["./tracer.so"]) == InProcess("library", "./tracer.so")
    assert target(["x.dylib"]) == InProcess("library", "x.dylib")
    assert target(["tracer:intersect"]) == InProcess("callable", "tracer:intersect")
    assert target(["a.b.c:D.e"]) == InProcess("callable", "a.b.c:D.e")
    for words in (["a:b"], ["./a:b"], ["a.b"], ["C:\\tracer.exe"], ["x:y", "z"], ["1:2"], ["a:"]):
        assert target(words) == Command(tuple(words))


def test_a_function_of_a_file_of_any_name(tmp_path: Path) -> None:
    """It finds what lies beside it, also what is called as a module of ours or a loaded one."""
    folder = tmp_path / "M\u00fcller, Anna: 2"
    folder.mkdir()
    (folder / "vectors.py").write_text("beside = True\n")
    text = "import vectors\nassert vectors.beside\nfrom planted import steady\n"
    for name in ("tracer-v2.py", "json.py"):
        (folder / name).write_text(f"import sys; sys.path.append({str(CLIENTS)!r})\n{text}")
        word = f"{folder / name}:steady"
        assert target([word]) == InProcess("callable", word)
        result = run(target([word]), questions(2))
        assert list(result.outcomes.values()) == [
            Reply(f"family/{n}", intervals=((n, n + 1),)) for n in range(2)
        ]
        assert result.hello.name == word
    with pytest.raises(Unusable, match=r"cannot import '.*/none.py': FileNotFoundError"):
        greet(target([f"{folder}/none.py:steady"]))


def test_a_library_that_is_not_there_is_told() -> None:
    with pytest.raises(Unusable, match=r"no file './no\.so'"):
        target(["./no.so"])


@pytest.mark.parametrize(
    ("word", "says"),
    [
        ("no_such_module:f", "cannot import 'no_such_module': ModuleNotFoundError"),
        ("planted:no_such", "has no 'no_such' \\(it is .*planted.py\\)"),
        ("planted:number", "is a int, and not a function"),
        ("planted:strange", "gave a bad hello: hello.solids has an unknown type 'cone'"),
        ("planted:unsaid", "is not JSON"),
        ("planted:wordy", "is a str: it has to be a dict"),
    ],
)
def test_what_cannot_be_loaded_says_what_was_seen(word: str, says: str) -> None:
    with pytest.raises(Unusable, match=says):
        greet(target([word]))
    with pytest.raises(Unusable, match=says):
        load([word])


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("import os; os._exit(9)", "exit status 9"),
        ("raise SystemExit('no licence')", "SystemExit: no licence"),
        ("1 / 0", "ZeroDivisionError"),
        ("def f(:", "SyntaxError"),
        ("import time; time.sleep(60)", "no answer for 0.5 s"),
    ],
)
def test_a_module_that_fails_on_import(
    text: str, says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bad.py").write_text(text)
    with pytest.raises(Unusable, match=says):
        greet(target(["bad:f"]), Limits(hello=0.5 if "sleep" in text else 10))


JUNK = """import contextlib, os
for fd in range(3, 20):
    with contextlib.suppress(OSError):
        os.write(fd, b"junk{0}")
def f(solid, ray): return []
"""
PRINTS = """import os, subprocess, sys
def speak():
    print("one", flush=True)
    os.write(1, b"two\\n")
    subprocess.run([sys.executable, "-c", "print('three')"])
speak()
def f(solid, ray):
    speak()
    return [(ray.origin[0], ray.origin[0] + 1)]
"""
FORKS = """import os
{0}
def f(solid, ray):
    if ray.origin[0] == 2:
        os.fork()
    return [(ray.origin[0], ray.origin[0] + 1)]
"""


@pytest.mark.parametrize("end", ["\\n", ""])
def test_a_module_that_writes_into_the_pipe_of_its_worker_is_told(
    end: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Once that was the traceback of a reader of JSON."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bad.py").write_text(JUNK.format(end))
    with pytest.raises(Unusable, match=r"'bad:f' spoiled the pipe of .*, which wrote 'junk"):
        greet(target(["bad:f"]))


@pytest.mark.parametrize("text", [PRINTS, FORKS.format(""), FORKS.format("os.fork()")])
def test_what_code_prints_and_what_it_forks_is_kept_apart(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A copy of the worker took its questions once, and answered some of them twice."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "loud.py").write_text(text)
    assert failures(run(target(["loud:f"]), questions(4), SHORT)) == {}


def test_folders_of_the_names_of_ours_are_no_trouble(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A user's own `cases` folder is not taken for ours."""
    monkeypatch.chdir(tmp_path)
    for name in ("cases", "oracle"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("raise ImportError('not this one')")
    (tmp_path / "json.py").write_text("raise ImportError('nor this one')")
    (tmp_path / "mine.py").write_text("def f(solid, ray): return []")
    assert greet(target(["mine:f"])) == Hello("mine:f")


# What is declared


def test_a_callable_declares_itself() -> None:
    assert greet(target(["planted:steady"])) == Hello(
        "planted callable", "3", solids=("cylinder", "sphere")
    )
    assert greet(target(["planted:nearest"])).precision == "binary32"
    assert greet(target(["raycert.reference.tracer:intersect"])) == Hello(
        "raycert.reference.tracer:intersect"
    )


def test_a_command_is_a_target_too() -> None:
    program = target([sys.executable, "steady.py"])
    assert greet(program).name == "planted"
    assert failures(run(program, questions(20), SHORT)) == {}


DECLARES = """
from types import SimpleNamespace
from raycert.cases.protocol import Hello

class Tracer:
    class hello:
        name, solids = "class attribute", {"sphere", "cylinder"}
    def intersect(self, solid, ray):
        return [(ray.origin[0], ray.origin[0] + 1)]
    def __call__(self, solid, ray):
        return self.intersect(solid, ray)

class Needy(Tracer):
    def __init__(self, scene): pass

class Bare:
    pass

def plain(solid, ray): return []
def narrow(radius, origin, direction): return []
def loose(*args): return []
tracer = Tracer()
own = Tracer()
own.hello = SimpleNamespace(name="object's own", solids=("slab",))
plain.hello = Hello("a Hello", solids=("sphere",))
hello = {"name": "module"}
"""


@pytest.fixture
def declares(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "declares.py").write_text(DECLARES)
    return "declares.py"


@pytest.mark.parametrize(
    ("path", "name", "solids"),
    [
        ("plain", "a Hello", ("sphere",)),
        ("loose", "module", None),
        ("tracer", "class attribute", ("cylinder", "sphere")),
        ("tracer.intersect", "class attribute", ("cylinder", "sphere")),
        ("Tracer.intersect", "class attribute", ("cylinder", "sphere")),
        ("Tracer", "class attribute", ("cylinder", "sphere")),
        ("own.intersect", "object's own", ("slab",)),
    ],
)
def test_a_hello_is_of_the_function_or_else_of_what_holds_it(
    declares: str, path: str, name: str, solids: tuple[str, ...] | None
) -> None:
    found = load([f"{declares}:{path}"])
    assert found.hello == (Hello(name, solids=solids) if solids else Hello(name))
    if "racer" in path:
        assert found(CAN, Ray((2, 0, 0), (0, 0, 1))) == Reply("", intervals=((2.0, 3.0),))


@pytest.mark.parametrize(
    ("path", "says"),
    [
        ("plian", r"Did you mean declares\.py:plain\? It has Tracer, Needy, Bare, plain, narrow"),
        ("Tracer.intersekt", r"Did you mean declares\.py:Tracer\.intersect\?"),
        ("tracer.x.y", r"has no 'tracer\.x\.y'"),
        ("narrow", r"narrow\(radius, origin, direction\) cannot be called as narrow\(solid, ray\)"),
        ("Needy.intersect", r"the class of .* cannot be made: TypeError"),
        ("Bare", r"is a class, .* A method of it is a target: declares\.py:Bare\.intersect"),
    ],
)
def test_what_was_meant_is_told(declares: str, path: str, says: str) -> None:
    with pytest.raises(Unusable, match=says):
        load([f"{declares}:{path}"])


@pytest.mark.parametrize(
    ("text", "function"),
    [
        ("def intersect(solid, ray): return []\n", "intersect"),
        ("def help(a, b): pass\ndef intersect(solid, ray): return []\n", "intersect"),
        ("def helper(): pass\ndef trace(solid, ray): return []\n", "trace"),
        ("def broken(:\n", "FUNCTION"),
    ],
)
def test_a_file_of_python_is_told_what_to_write_instead(
    text: str, function: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "s_ok.py").write_text(text)
    for word in ("s_ok.py", "./s_ok.py", "s_ok"):
        says = f"write s_ok.py:{function}; .* write -- python3 s_ok.py$"
        with pytest.raises(Unusable, match=says):
            target([word])
    with pytest.raises(Unusable, match=r"a target of its own: s_ok\.py:intersect|SyntaxError"):
        greet(target([sys.executable, "s_ok.py"]))
    (tmp_path / "s_ok.py").chmod(0o755)
    assert target(["./s_ok.py"]) == Command(("./s_ok.py",)), "it may be a program"


# Answers


def test_a_callable_is_heard_out_in_one_process() -> None:
    told: list[int] = []
    result = run(target(["planted:steady"]), questions(1000), SHORT, told.append)
    assert failures(result) == {}
    assert (len(result.outcomes), result.restarts, result.notes) == (1000, 0, ())
    assert told == sorted(told)
    assert told[-1] == 1000


def test_first_and_any_are_heard() -> None:
    first = ask("nearest", 3).outcomes
    assert first["family/0"] == Reply("family/0", first=None)
    assert first["family/1"] == Reply("family/1", first=1.100000023841858)
    assert ask("kept", 2).outcomes == {
        "family/0": Reply("family/0", hit=False),
        "family/1": Reply("family/1", hit=True),
    }


def test_prints_do_no_harm() -> None:
    result = ask("talks", 200)
    assert failures(result) == {}
    assert result.restarts == 0


def test_crashes_exits_and_hangs_are_pinned_and_all_else_is_graded() -> None:
    threads, pipes = threading.active_count(), len(os.listdir("/dev/fd"))
    found = failures(ask("crashes", 520))
    kinds = {n: failure.kind for n, failure in found.items()}
    crashes = {*range(100, 500, 100), *range(130, 520, 130), *range(170, 520, 170)}
    assert kinds == {500: "hang"} | dict.fromkeys(crashes, "crash")
    assert "SIGSEGV" in found[100].detail
    assert "exit status 7" in found[130].detail
    assert "enough" in found[170].detail
    assert (threading.active_count(), len(os.listdir("/dev/fd"))) == (threads, pipes)


def test_a_value_of_no_meaning_costs_no_restart() -> None:
    result = ask("odd", 300)
    found = failures(result)
    assert sorted(found) == [n for n in range(300) if n % 3]
    assert {failure.kind for failure in found.values()} == {"bad-line"}
    assert "None" in found[1].detail
    assert "the str 'x' where a number has to be" in found[2].detail
    assert result.restarts == 0


def test_exceptions_are_replies() -> None:
    outcomes = ask("refuses", 2).outcomes
    assert outcomes["family/0"] == Reply(
        "family/0", error="ZeroDivisionError: float division by zero"
    )
    assert outcomes["family/1"] == Reply("family/1", unsupported="NotImplementedError: odd")


def test_a_crash_that_depends_on_the_count_is_unrepeatable() -> None:
    found = failures(ask("counted", 15))
    assert found
    assert {failure.kind for failure in found.values()} == {"unrepeatable"}


def test_code_that_writes_into_our_pipe_is_found_out() -> None:
    found = failures(ask("spoils", 6))
    assert {n: failure.kind for n, failure in found.items()} == {3: "crash"}
    assert "spoiled its memory or its pipes" in found[3].detail


def test_no_worker_outlives_a_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sleeper.py").write_text(
        "import os, subprocess, time\n"
        "child = subprocess.Popen(['sleep', '600'])\n"
        "open('pids', 'a').write(f'{os.getpid()} {child.pid} ')\n"
        "def f(solid, ray):\n    time.sleep(600)\n"
    )
    result = run(target(["sleeper:f"]), questions(2), Limits(case=0.2, in_a_row=2))
    assert {outcome.kind for outcome in result.outcomes.values()} == {"hang"}  # type: ignore[union-attr]
    pids = [int(word) for word in (tmp_path / "pids").read_text().split()]
    assert len(pids) >= 4
    deadline = time.monotonic() + 5
    while any(map(alive, pids)) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not any(map(alive, pids))


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
        state = Path(f"/proc/{pid}/stat")
        return not state.exists() or state.read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except (ProcessLookupError, FileNotFoundError):
        return False


# Direct calls


def test_code_can_be_called_directly() -> None:
    loaded = load(["raycert.reference.tracer:intersect"])
    ray = Ray((-3, 0, 0.5), (1, 0, 0))
    assert loaded(CAN, ray) == Reply("", intervals=((2.0, 4.0),))
    assert loaded.raw is tracer.intersect
    assert loaded.hello == Hello("raycert.reference.tracer:intersect")
    with pytest.raises(Unusable, match="is a program"):
        load(["python3", "tracer.py"])
