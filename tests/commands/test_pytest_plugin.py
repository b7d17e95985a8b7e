"""The pytest plugin, run by pytest: a test for each family, a subtest for each failure."""

import sys
from functools import cache
from importlib.metadata import entry_points

import pytest

from raycert.cases.corpus import encode_rows, manifest
from raycert.cases.formats import BINARY64
from raycert.oracle.client.smoke import EASY
from shared.corpus import golden

pytest_plugins = ["pytester"]

FAMILIES = ("behind", "rim", "start-inside")
CLIENT = """
import pathlib, sys
from raycert.cases.protocol import Hello
from raycert.cases.protocol import serve
from raycert.oracle.zoo.inhabitants import BY_NAME
from raycert.oracle.zoo.tracer import BASE

log = pathlib.Path(__file__).with_name("log")
trace = BY_NAME[sys.argv[1]].make() if len(sys.argv) > 1 else BASE
log.open("a").write("start\\n")

def counted(solid, ray):
    log.open("a").write("asked\\n")
    return trace(solid, ray)

serve(counted, Hello("planted"))
"""
INSTALLED = any(point.name == "raycert" for point in entry_points(group="pytest11"))
PLUGIN = ("-p", "raycert.oracle.commands.pytest_plugin")
GOOD = "client.py"
BAD = "client.py no-clip"
"""Tells of what is behind: fails on some rows of `behind` and `start-inside`, on none of others."""


@cache
def files() -> dict[str, bytes]:
    """Return a small corpus: the first rows of a few families."""
    rows = golden().rows
    found = {}
    for family in FAMILIES:
        first = [row for row in rows if row.family == family][:25]
        found[f"binary64/{family}.jsonl"] = encode_rows(first, BINARY64)
    return found


@pytest.fixture
def tester(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> pytest.Pytester:
    """Return a folder with a client and a small corpus."""
    monkeypatch.delenv("PYTEST_ADDOPTS", raising=False)
    for name, data in files().items():
        path = pytester.path / "golden" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    (pytester.path / "golden" / "manifest.json").write_bytes(manifest(files()))
    (pytester.path / "client.py").write_text(CLIENT)
    return pytester


def run(
    tester: pytest.Pytester, client: str, *options: str, alone: bool = True
) -> pytest.RunResult:
    target = f"{sys.executable} {tester.path}/{client}"
    return raw(tester, "--raycert", target, *options, alone=alone)


def raw(tester: pytest.Pytester, *options: str, alone: bool = True) -> pytest.RunResult:
    """Run pytest with this plugin alone, which starts fast, or with all that are installed.

    It refuses a plugin that it finds under two names.
    """
    plugin = () if INSTALLED and not alone else PLUGIN
    with pytest.MonkeyPatch.context() as patch:
        if alone:
            patch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
        words = (*plugin, "-p", "no:cacheprovider", "--raycert-golden", str(tester.path / "golden"))
        return tester.runpytest_subprocess(*words, *options)


def logged(tester: pytest.Pytester) -> list[str]:
    return (tester.path / "log").read_text().split()


def test_without_a_target_nothing_is_loaded_and_nothing_done(tester: pytest.Pytester) -> None:
    tester.makepyfile(
        """
        import sys

        def test_nothing_is_loaded():
            ours = {n for n in sys.modules if n.partition(".")[0] == "raycert"}
            assert ours == {"raycert", "raycert.cases", "raycert.cases.levels", "raycert.oracle",
                "raycert.oracle.commands", "raycert.oracle.commands.pytest_plugin"}
            assert not {"numpy", "sympy", "mpmath", "rich", "click"} & set(sys.modules)
        """
    )
    raw(tester, alone=False).assert_outcomes(passed=1)


def test_a_good_target_passes_one_test_for_each_family(tester: pytest.Pytester) -> None:
    tester.makepyfile("def test_of_my_own(): pass")
    result = run(tester, GOOD, "--raycert-level", "stable", "-v")
    result.assert_outcomes(passed=4)
    result.stdout.fnmatch_lines([f"*raycert*{family}*PASSED*" for family in FAMILIES])
    assert logged(tester).count("start") == 3, "the hello, the easy cases, and all families at once"


def test_each_failing_row_is_a_failed_subtest(tester: pytest.Pytester) -> None:
    result = run(tester, BAD)
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    result.stdout.fnmatch_lines(
        [
            "*[[]behind/*[]]*",
            "sound: *",
            "answered [[][[]-*",
            "expected []",
            "repeat *--id behind/*",
        ]
    )
    assert "Traceback" not in result.stdout.str()
    assert result.parseoutcomes()["passed"] == 1


def test_without_subtests_one_test_lists_the_rows(tester: pytest.Pytester) -> None:
    result = run(tester, BAD, "-p", "no:subtests", "-k", "behind")
    result.assert_outcomes(failed=1, deselected=2)
    assert result.stdout.str().count("behind/") > 5


def test_only_what_is_left_is_asked(tester: pytest.Pytester) -> None:
    run(tester, GOOD, "-k", "rim").assert_outcomes(passed=1, deselected=2)
    one = logged(tester).count("asked")
    (tester.path / "log").unlink()
    run(tester, GOOD, "--raycert-family", "rim").assert_outcomes(passed=1)
    assert logged(tester).count("asked") == one <= 25 + len(EASY)
    (tester.path / "log").unlink()
    raw(tester, "--raycert", f"{sys.executable} {tester.path}/{GOOD}", "--collect-only")
    assert logged(tester) == ["start"]


def test_workers_ask_for_their_own_families(tester: pytest.Pytester) -> None:
    run(tester, GOOD, "-p", "xdist", "-n", "2").assert_outcomes(passed=3)


def known(tester: pytest.Pytester, *entries: str) -> tuple[str, str]:
    lines = (f'[[expect]]\n{entry}\nreason = "it is known"\nlink = ""\n' for entry in entries)
    (tester.path / "known.toml").write_text("".join(lines))
    return "--raycert-expect", str(tester.path / "known.toml")


def test_known_failures_are_expected(tester: pytest.Pytester) -> None:
    expect = known(tester, 'family = "behind"', 'family = "start-inside"')
    result = run(tester, BAD, *expect, "-rx")
    result.assert_outcomes(passed=2, xfailed=2)
    result.stdout.fnmatch_lines(["*known failures: it is known*"])
    assert result.ret == 0


def test_known_failures_that_pass_or_are_of_nothing_fail(tester: pytest.Pytester) -> None:
    expect = known(tester, 'family = "behind"', 'id = "rim/no-such-row"')
    result = run(tester, GOOD, *expect, "-p", "no:subtests")
    result.assert_outcomes(passed=2, failed=2)
    result.stdout.fnmatch_lines(["*family behind: passes sound*take it from the file*"])
    result.stdout.fnmatch_lines(["*rim/no-such-row: no such id is asked*"])


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--raycert", "./no-such-tracer"), "*cannot start*"),
        (("--raycert", "cat", "--raycert-family", "no-such"), "*hello*"),
        (("--raycert", "x", "--raycert-convention", "open"), "*convention is not any, closed*"),
        (("--raycert", "x", "--raycert-expect", "none.toml"), "*none.toml*"),
    ],
)
def test_what_cannot_be_tested_is_an_error_with_a_reason(
    tester: pytest.Pytester, options: tuple[str, ...], words: str
) -> None:
    result = raw(tester, *options)
    assert result.ret not in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED)
    text = result.stdout.str() + result.stderr.str()
    pytest.LineMatcher(text.splitlines()).fnmatch_lines([words])
    assert "Traceback" not in text


def test_a_python_callable_is_a_target(tester: pytest.Pytester) -> None:
    target = "raycert.oracle.zoo.tracer:BASE"
    raw(tester, "--raycert", target, "--raycert-level", "stable").assert_outcomes(passed=3)


def test_a_fresh_block_is_a_family(tester: pytest.Pytester) -> None:
    result = run(tester, GOOD, "--raycert-seed", "3", "--raycert-fresh", "20", "-k", "fresh-3")
    result.assert_outcomes(passed=1, deselected=3)
