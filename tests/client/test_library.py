"""A shared library behind raycert.h: asked to the bit, certified, and survived."""

from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from raycert.cases.model import SOLIDS, Cylinder, Difference, HalfSpace, Ray, Slab, Sphere, Union
from raycert.cases.protocol import Hello, Reply
from raycert.oracle.certify.grading import grade
from raycert.oracle.certify.verdict import verdict
from raycert.oracle.client.dialogue import Limits, Question, Unusable
from raycert.oracle.client.process import Failure
from raycert.oracle.client.replay import Run, greet, run
from raycert.oracle.client.target import load, target
from raycert.oracle.client.worker import CODES, flat
from raycert.oracle.commands import export
from raycert.oracle.starters import __file__ as starters
from raycert.oracle.starters import templates
from shared.corpus import golden

LIBRARY = Path(starters).parent / "library"
"""With the header, which is no template."""
FLAGS = ["-std=c11", "-shared", "-fPIC", "-O2", "-ffp-contract=off", "-Wall", "-Wextra"]
CAN = Cylinder((0, 0, 0), (0, 0, 1), 1)


def build(folder: Path, *sources: str, name: str = "tracer.so") -> str:
    """Build a library. Where there is no compiler, skip; on CI, fail."""
    if shutil.which("cc") is None:
        (pytest.fail if os.environ.get("CI") == "true" else pytest.skip)("cc is not installed")
    command = ["cc", *FLAGS, f"-I{LIBRARY}", "-o", name, *sources, "-lm"]
    built = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert built.returncode == 0, built.stderr
    assert built.stderr == ""
    return str(folder / name)


def body(folder: Path, text: str, hello: str = "") -> str:
    """Build a library whose function has this body; n is the x of the origin."""
    said = f"const char *raycert_hello(void) {{ return {json.dumps(hello)}; }}" if hello else ""
    unused = "(void)solid; (void)words; (void)numbers; (void)count; (void)direction;"
    (folder / "planted.c").write_text(
        '#include "raycert.h"\n#include <stdio.h>\n#include <stdlib.h>\n#include <unistd.h>\n'
        "int raycert_intersect(const int32_t *solid, int32_t words, const double *numbers,\n"
        "    int32_t count, const double origin[3], const double direction[3], double *out,\n"
        f"    int32_t capacity)\n{{\n    {unused}\n    int n = (int)origin[0];\n"
        "    if (capacity > 0) { out[0] = n; out[1] = n + 1; }\n"
        f"    {text}\n    return 1;\n}}\n{said}\n"
    )
    return build(folder, "planted.c")


def questions(count: int) -> list[Question]:
    return [Question(f"family/{n}", CAN, Ray((n, 0, 0), (0, 0, 1))) for n in range(count)]


def failures(result: Run) -> dict[int, Failure]:
    """Return the failures by number, after checking that every other answer is the right one."""
    found = {}
    for n, (id, outcome) in enumerate(result.outcomes.items()):
        if isinstance(outcome, Failure):
            found[n] = outcome
        else:
            assert outcome == Reply(id, intervals=((n, n + 1),))
    return found


# The question


def test_the_codes_are_those_of_the_header() -> None:
    header = (LIBRARY / "raycert.h").read_text()
    for name, code in CODES.items():
        assert f"RAYCERT_{name.upper()} = {code}" in header
    assert set(CODES) == set(SOLIDS)


def test_the_order_is_that_of_the_export() -> None:
    """Token by token: names are codes, digits are numbers, the rest counts parts."""
    corpus = golden()
    for row in corpus.rows[::37]:
        tokens = export._solid(row.solid, corpus.format).split()
        words, numbers = [], []
        for token in tokens:
            if len(token) == 16 and token not in CODES:
                numbers.append(corpus.format.from_bits(token))
            else:
                words.append(CODES[token] if token in CODES else int(token))
        assert tuple(map(list, flat(row.solid))) == (words, numbers)


def test_a_tree_is_flat() -> None:
    tree = Difference((Sphere((1, 2, 3), 4), Slab((5, 6, 7), (8, 9, 10))))
    words, numbers = flat(Difference((HalfSpace((0, 0, 0), (0, 0, 1)), tree)))
    assert list(words) == [8, 2, 1, 8, 2, 2, 4]
    assert list(numbers) == [0, 0, 0, 0, 0, 1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10]


# The starter


@pytest.fixture(scope="module")
def starter(tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("library")
    for name, data in templates("library"):
        (folder / name).write_bytes(data)
    return build(folder, "library.c", "tracer.c")


def test_the_starter_is_stable(starter: str) -> None:
    rows = golden().rows[::29]
    ran = run(target([starter]), [Question(row.id, row.solid, row.ray) for row in rows])
    assert (ran.restarts, ran.notes) == (0, ())
    assert ran.hello.solids == tuple(SOLIDS)
    grades = [grade(row, ran.outcomes[row.id], ran.hello) for row in rows]
    judged = verdict(grades, "stable", "closed")
    assert judged.granted, judged.reasons
    assert {row.tier for row in rows} == {"lattice", "generic", "stiff", "range"}


def test_direct_calls_are_those_of_the_worker(starter: str) -> None:
    loaded = load([starter])
    assert loaded.hello.name == "reference tracer, in C"
    assert loaded(CAN, Ray((-3, 0, 0.5), (1, 0, 0))) == Reply("", intervals=((2.0, 4.0),))
    far = loaded(HalfSpace((0, 0, 0), (0, 0, 1)), Ray((0, 0, -1), (0, 0, -1)))
    assert far == Reply("", intervals=((0.0, math.inf),))


def test_the_readme_says_how_to_build_and_certify() -> None:
    readme = dict(templates("library"))["README.md"].decode()
    assert "\ncc -std=c11 -shared -fPIC -O2 -ffp-contract=off -o tracer.so library.c" in readme
    assert "\nraycert certify --level stable -- ./tracer.so\n" in readme


def test_the_header_is_good_in_c_plus_plus() -> None:
    if shutil.which("c++") is None:
        pytest.skip("c++ is not installed")
    check = ["c++", "-x", "c++", "-fsyntax-only", "-Wall", "-Wextra", str(LIBRARY / "raycert.h")]
    assert subprocess.run(check, capture_output=True, text=True).stderr == ""


# Answers


def test_crashes_and_hangs_are_pinned_and_all_else_is_graded(tmp_path: Path) -> None:
    library = body(
        tmp_path,
        "switch (n) {\n"
        "case 40: abort();\n"
        "case 70: return *(volatile int *)(intptr_t)(capacity - 64);\n"
        "case 90: for (;;) sleep(1);\n"
        "case 110: exit(5);\n"
        'case 130: printf("[]\\n"); fflush(stdout);\n'
        "}",
    )
    found = failures(run(target([library]), questions(200), Limits(case=0.6)))
    kinds = {n: failure.kind for n, failure in found.items()}
    assert kinds == {40: "crash", 70: "crash", 90: "hang", 110: "crash"}
    assert "SIGABRT" in found[40].detail
    assert "SIGSEGV" in found[70].detail
    assert "exit status 5" in found[110].detail


def test_a_library_without_a_hello_has_defaults(tmp_path: Path) -> None:
    assert greet(target([body(tmp_path, "")])) == Hello("tracer.so")


def test_more_pairs_than_room_are_asked_for_again(tmp_path: Path) -> None:
    library = body(
        tmp_path,
        "int most = n == 1 ? 60 : n == 2 ? 96 : n == 3 ? 97 : n == 4 ? 1 << 30 : 0;"
        "for (int i = 0; i < most && i < capacity; i++) { out[2 * i] = i; out[2 * i + 1] = i; }"
        "return n == 5 && capacity > 64 ? 3 : n == 5 ? 65 : most;",
    )
    asked = [replace(question, solid=Union((CAN,) * 20)) for question in questions(6)]
    outcomes = list(run(target([library]), asked).outcomes.values())
    lists = [outcome.intervals for outcome in outcomes[:3] if isinstance(outcome, Reply)]
    assert lists == [tuple((float(i), float(i)) for i in range(most)) for most in (0, 60, 96)]
    details = [outcome.detail for outcome in outcomes[3:] if isinstance(outcome, Failure)]
    assert "97 pairs, and 96 is the most" in details[0]
    assert "1073741824" in details[1]
    assert len(details) == 2 or "when asked again" in details[2]


@pytest.mark.parametrize(
    ("returned", "hello", "outcome"),
    [
        ("-1", "", Reply("", unsupported="NotImplementedError: raycert_intersect returned -1")),
        ("-2", "", Reply("", error="LibraryError: raycert_intersect returned -2")),
        ("-3", "", None),
        ("1", "first", Reply("", first=3.0)),
        ("0", "first", Reply("", first=None)),
        ("2", "first", None),
        ("1", "any", Reply("", hit=True)),
        ("0", "any", Reply("", hit=False)),
        ("7", "any", None),
    ],
)
def test_what_a_returned_number_means(
    returned: str, hello: str, outcome: Reply | None, tmp_path: Path
) -> None:
    said = json.dumps({"hello": 1, "name": "x", "answers": hello}) if hello else ""
    loaded = load([body(tmp_path, f"return {returned};", said)])
    answer = loaded(CAN, Ray((3, 0, 0), (0, 0, 1)))
    if outcome is None:
        assert isinstance(answer, Failure)
        assert returned in answer.detail
    else:
        assert answer == outcome


def test_what_is_not_written_is_nan(tmp_path: Path) -> None:
    loaded = load([body(tmp_path, "return n == 1 ? 1 : 2;")])
    loaded(CAN, Ray((1, 0, 0), (0, 0, 1)))
    reply = loaded(CAN, Ray((2, 0, 0), (0, 0, 1)))
    assert isinstance(reply, Reply)
    assert repr(reply.intervals) == "((2.0, 3.0), (nan, nan))"


def test_a_binary32_library_is_rounded(tmp_path: Path) -> None:
    said = '{"hello": 1, "name": "x", "precision": "binary32"}'
    loaded = load([body(tmp_path, "out[0] = 0.1; out[1] = 1e300;", said)])
    assert loaded(CAN, Ray((1, 0, 0), (0, 0, 1))) == Reply(
        "", intervals=((0.10000000149011612, math.inf),)
    )


def test_what_cannot_be_loaded_says_what_was_seen(tmp_path: Path) -> None:
    (tmp_path / "text.so").write_text("not a library")
    with pytest.raises(Unusable, match=r"cannot load .*text\.so"):
        greet(target([str(tmp_path / "text.so")]))
    (tmp_path / "empty.c").write_text("int nothing;")
    with pytest.raises(Unusable, match="no symbol raycert_intersect"):
        greet(target([build(tmp_path, "empty.c", name="empty.so")]))
    with pytest.raises(Unusable, match=r"gave a bad hello: hello\.name is missing"):
        greet(target([body(tmp_path, "", '{"hello": 1}')]))
