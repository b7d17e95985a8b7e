"""Each starter as a user gets it: written, built with its toolchain, certified, to the bit."""

from __future__ import annotations

import json
import os
import runpy
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from importlib.resources import files
from itertools import cycle, groupby
from math import frexp, inf, ldexp, sqrt
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from raycert.cases.corpus import MANIFEST, encode_rows, manifest, write_whole
from raycert.cases.degenerate import DEGENERACIES
from raycert.cases.formats import BINARY64
from raycert.cases.model import SOLIDS, Cylinder, Sphere, Vector
from raycert.cases.protocol import FROM_INSIDE, Hello, Pairs, Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.certify.verdict import verdict
from raycert.oracle.client.dialogue import Outcome, Question
from raycert.oracle.client.replay import run
from raycert.oracle.client.target import target
from raycert.oracle.commands.certify import certify
from raycert.oracle.commands.harness import harness
from raycert.oracle.starters import FUNCTION, MARK, READERS, STARTERS, templates
from raycert.reference import quadratic, tracer
from shared.corpus import golden

each = pytest.mark.parametrize("lang", STARTERS)
END = b"---- to here ----"


def write(lang: str, folder: Path, *options: str) -> str:
    """Write a client as the command does, and return what the command says."""
    result = CliRunner().invoke(harness, [lang, "--out", str(folder), *options])
    assert result.exit_code == 0, result.output
    return result.output


def needs(tool: str) -> str:
    """Return the path of a tool. Where it is missing, skip and name it; on CI, fail."""
    path = sys.executable if tool == "python3" else shutil.which(tool)
    if path is None:
        missing = f"{tool} is not installed: this starter was not built"
        if os.environ.get("CI") == "true":
            pytest.fail(missing)
        pytest.skip(missing)
    return path


def build(lang: str, folder: Path) -> list[str]:
    """Build a client with the command of its README; return the command that runs it, anywhere."""
    if STARTERS[lang].build:
        tool, *rest = shlex.split(STARTERS[lang].build)
        built = subprocess.run([needs(tool), *rest], cwd=folder, capture_output=True, text=True)
        assert built.returncode == 0, built.stderr
        assert "warning" not in built.stderr, built.stderr
    program, *arguments = shlex.split(STARTERS[lang].run)
    if "/" in program:
        return [str(folder / program)]
    if lang == "java":
        return [needs(program), "-cp", str(folder), *arguments]
    return [needs(program), *(str(folder / argument) for argument in arguments)]


SIDES = dict(zip(STARTERS, cycle(FROM_INSIDE)))
KIT = (
    "table-through",
    "perpendicular",
    "tilt",
    "rim",
    "behind",
    "zero-direction",
    "tangent-start",
    "sphere-rows",
)
"""Families that found what a pairing of crossings can do wrong."""


def refused(command: list[str], hello: Hello, every: int) -> tuple[str, ...]:
    """Return why a client is not `stable` on some rows: those that try the kit, and a part."""
    asked = [
        row
        for i, row in enumerate(golden(hello.precision).rows)
        if i % every == 0 or (row.family in KIT and isinstance(row.solid, Cylinder | Sphere))
    ]
    ran = run(target(command), [Question(row.id, row.solid, row.ray) for row in asked])
    assert (ran.restarts, ran.notes) == (0, ())
    assert replace(hello, name=ran.hello.name, version="1", numbers=ran.hello.numbers) == ran.hello
    return verdict(
        [grade(row, ran.outcomes[row.id], hello) for row in asked], "stable", "closed"
    ).reasons


ANSWERED = ("zero_direction", "zero_radius")


@each
def test_an_adapter_that_goes_through_the_kit_is_stable(lang: str, tmp_path: Path) -> None:
    """Frame, shift, unit direction, far end, pairing for cylinders; unit, clip for spheres."""
    write(lang, tmp_path, "--adapter")
    assert refused(build(lang, tmp_path), Hello("", degenerate=ANSWERED), 19) == ()


SLOW = {"cpp": "first", "rust": "floats", "java": "any"}
"""Languages whose builds take seconds, and the one of the other options that each is built for."""


def for_option(option: str) -> pytest.MarkDecorator:
    langs = [lang for lang in STARTERS if SLOW.get(lang, option) == option]
    return pytest.mark.parametrize("lang", langs)


@for_option("first")
def test_a_first_hit_of_each_side_is_stable(lang: str, tmp_path: Path) -> None:
    side = SIDES[lang]
    options = ["--answers", "first", "--from-inside", side, "--precision", "binary32", "--adapter"]
    write(lang, tmp_path, *options)
    hello = Hello("", "", "first", precision="binary32", from_inside=side, degenerate=ANSWERED)
    assert refused(build(lang, tmp_path), hello, 29) == ()


@for_option("any")
def test_a_hit_or_none_is_stable(lang: str, tmp_path: Path) -> None:
    write(lang, tmp_path, "--answers", "any")
    hello = Hello("", answers="any", degenerate=ANSWERED)
    assert refused(build(lang, tmp_path), hello, 59) == ()


@for_option("floats")
def test_a_list_of_floats_is_stable(lang: str, tmp_path: Path) -> None:
    """Pairs that touch only once they are floats are one: csg-gap."""
    write(lang, tmp_path, "--precision", "binary32")
    hello = Hello("", precision="binary32", degenerate=ANSWERED)
    assert refused(build(lang, tmp_path), hello, 19) == ()


PLANTED = {
    "frame: x is not turned back": ("s * a * b * k, -s * a)", "s * a * b * k, s * a)"),
    "frame: z is not normalised": ("unit((q[0]", "(lambda v: (v, hypot(*v)))((q[0]"),
    "shifted: by the whole height": ("f.height / 2)", "f.height)"),
    "unit: |v| is left in": ("else v), length", "else v), 1.0"),
    "rescaled: by |v| the wrong way": ("(a / length, b / length)", "(a * length, b * length)"),
    "far_end: before the solid": ("ldexp(2.0,", "ldexp(0.125,"),
    "paired: every gap is inside": ("for part in (0.375, 0.625)", "for part in ()"),
    "paired: a crossing outside is a touch": ("a in ends and inside(a)", "a in ends"),
    "paired: touches are lost": ("elif not before and a in ends and inside(a)", "elif False"),
    "clipped: what lies behind is kept": ("if b >= 0]", "]"),
    "clipped: a start inside is not cut": ("a if a > 0 else 0.0", "a"),
}
"""A fault in each piece of the kit: what it is, and what is put in place of what."""


@pytest.mark.parametrize("fault", PLANTED)
def test_a_fault_in_any_piece_of_the_kit_is_refused(fault: str, tmp_path: Path) -> None:
    write("python", tmp_path, "--adapter")
    kit, (sound, wrong) = tmp_path / "kit.py", PLANTED[fault]
    assert kit.read_text().count(sound) == 1
    kit.write_text(kit.read_text().replace(sound, wrong))
    command = [sys.executable, str(tmp_path / "tracer.py")]
    assert refused(command, Hello("", degenerate=ANSWERED), 59)


def test_crossings_pair_where_a_library_rounds_the_other_way(tmp_path: Path) -> None:
    """In the plane of a cap an entry may come late, and the points before it are inside."""
    write("python", tmp_path)
    paired = runpy.run_path(str(tmp_path / "kit.py"))["paired"]
    assert paired([2.9, 3.0], 8.0, lambda s: 1 <= s <= 3) == [(2.9, 3.0)]
    assert paired([4.0, 1.0, 2.0, 3.0], 8.0, lambda s: s <= 1 or s >= 3) == [(0, 1), (3, inf)]
    assert paired([2.0, 2.0, -1.0], 8.0, lambda s: s == 2) == [(2, 2)]
    assert paired([1.0, 3.0], 8.0, lambda s: s == 2) == []
    assert paired([1.0, 1.0], 8.0, lambda s: s != 1) == [(0, inf)]


@cache
def graded(row: str, pairs: Pairs) -> Grade:
    """Return the grade of an answer; the starters answer alike, so few rows are graded twice."""
    return grade(
        rows()[row], Reply(row, intervals=pairs), Hello("a starter", degenerate=DEGENERACIES)
    )


@cache
def rows() -> dict[str, GoldenRow]:
    return {row.id: row for row in golden().rows}


def answers(command: list[str]) -> dict[str, Pairs]:
    """Return what an implementation answers to the whole corpus, through the protocol."""
    ran = run(target(command), [Question(row.id, row.solid, row.ray) for row in golden().rows])
    assert not ran.restarts
    assert not ran.notes
    assert ran.hello.solids == tuple(SOLIDS)
    return {id: listed(outcome) for id, outcome in ran.outcomes.items()}


def listed(outcome: Outcome) -> Pairs:
    assert isinstance(outcome, Reply), outcome
    assert outcome.intervals is not None, outcome
    return outcome.intervals


def scaled_norm(a: Vector) -> float:
    """Return |a| as the starters do that have no hypot of three numbers as good as Python's."""
    e = max((frexp(x)[1] for x in a if x), default=0)
    x, y, z = (ldexp(component, -e) for component in a)
    return ldexp(sqrt(x * x + y * y + z * z), e)


@cache
def reference(norm: Callable[[Vector], float]) -> dict[str, Pairs]:
    """Return the answers of the reference with its norm as it is now, which is this one."""
    assert norm == quadratic.norm == tracer.norm
    return {row.id: tuple(tracer.intersect(row.solid, row.ray)) for row in golden().rows}


def unlike(subject: dict[str, Pairs]) -> dict[str, tuple[Pairs, Pairs]]:
    """Return where answers are not those of the reference, bit for bit (-0 is never answered)."""
    truth = reference(quadratic.norm)
    return {
        id: (truth[id], pairs) for id, pairs in subject.items() if repr(truth[id]) != repr(pairs)
    }


@each
def test_a_starter_is_stable_and_is_the_reference_to_the_bit(
    lang: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(lang, tmp_path)
    command = build(lang, tmp_path)
    answered = answers(command)
    grades = [graded(id, pairs) for id, pairs in answered.items()]
    judged = verdict(grades, "stable", "closed")
    assert judged.granted, judged.reasons
    assert {row.tier for row in golden().rows} == {"lattice", "generic", "stiff", "range"}
    if lang != "python":
        monkeypatch.setattr(quadratic, "norm", scaled_norm)
        monkeypatch.setattr(tracer, "norm", scaled_norm)
    assert unlike(answered) == {}
    if lang != "library":
        check_every_line(command)


def test_the_printed_command_certifies(tmp_path: Path) -> None:
    """Against a corpus of every fortieth row, so that it is a certificate."""
    command = build("c", tmp_path) if write("c", tmp_path) else []
    families = groupby(golden().rows[::40], lambda row: row.family)
    few = {f"binary64/{name}.jsonl": encode_rows(list(rows), BINARY64) for name, rows in families}
    for name, data in (few | {MANIFEST: manifest(few)}).items():
        write_whole(tmp_path / "golden" / name, data)
    certificate = tmp_path / "certificate.json"
    options = ["--level", "stable", "--golden", str(tmp_path / "golden")]
    options += ["--out", str(certificate), "--", *command]
    result = CliRunner().invoke(certify, options)
    assert result.exit_code == 0, result.output
    form = json.loads(certificate.read_text())
    assert form["granted"]
    assert form["tested"] == len(golden().rows[::40])


def talk(command: list[str], lines: list[str]) -> list[dict[str, Any]]:
    """Return the replies to lines that end with the input, not with a newline."""
    said = subprocess.run(
        command, input="\n".join(lines).encode(), capture_output=True, timeout=30, check=True
    )
    *replies, rest = said.stdout.decode().split("\n")
    assert rest == ""
    return [json.loads(line) for line in replies]


def check_every_line(command: list[str]) -> None:
    """Odd but good lines are answered, bad ones get an error, and the next one is answered."""
    [hello] = talk(command, ['{ "hello" :\t1 }'])
    bits = hello["numbers"] == "bits"
    zero, one, far = (
        ('"0000000000000000"', '"3ff0000000000000"', '"C008000000000000"')
        if bits
        else ("0", "1.0", "-3e0")
    )
    wanted = [["4000000000000000", "4010000000000000"]] if bits else [[2, 4]]
    ray = f'"ray": {{"direction": [{one}, {zero},{zero}], "origin":[{far},{zero} , {zero}]}}'
    ball = f'{{"radius": {one}, "\\u0074ype":"sph\\u0065re", "center": [{zero}, {zero}, {zero}]}}'
    tree = '{"of": [' * 150 + ball + '], "type": "union"}' * 150
    many = '{"type": "union", "of": [' + ", ".join([ball] * 5000) + "]}"
    id = r'"a \"quoted\" \\ \u00e9\/<>&\u2028 id"'
    more = '"more": [{}, [], null, true, -1.5e-3, "]}"]'
    good = {
        f'{{{ray},"solid" :{ball},\t{more}, "id": {id}}}': id,
        f'{{"id": "deep", "solid": {tree}, {ray}}}\r': '"deep"',
        f'{{"id": "many", "solid": {many}, {ray}}}': '"many"',
    }
    torus = f'{{"id": "torus", "solid": {{"type": "torus"}}, {ray}}}'
    no_radius = ball.replace('"radius"', '"diameter"')
    short = ball.replace(f"{zero}, {zero}, {zero}", f"{zero}, {zero}")
    null = ball.replace(one, "null")
    bad = [
        f'{{"id": "bad", "solid": {solid}, {ray}}}'
        for solid in (no_radius, short, null, '{"type": "union", "of": []}', "{}")
    ]
    broken = ["", "{", "[1", '{"id": "x",', '{"id": "x}', "[" * 100_000, "{} {}"]
    replies = talk(command, [*broken, *bad, torus, *good])
    assert len(replies) == len(broken) + len(bad) + 1 + len(good)
    for line in broken:
        assert set(replies.pop(0)) == {"error"}, line
    for line in bad:
        reply = replies.pop(0)
        assert (set(reply), reply["id"]) == ({"id", "error"}, "bad"), line
    assert set(replies[0]) == {"id", "unsupported"}
    assert "torus" in replies.pop(0)["unsupported"]
    for reply, id in zip(replies, good.values(), strict=True):
        assert reply == {"id": json.loads(id), "intervals": wanted}


@each
def test_one_place_is_marked_and_the_readme_says_the_commands(lang: str) -> None:
    found = dict(templates(lang))
    readme = found.pop("README.md").decode()
    marked = [name for name, data in found.items() if MARK in data]
    assert len(marked) == 1
    text = found[marked[0]]
    assert text.count(MARK) == text.count(END) == 1
    assert text.index(MARK) < text.index(b"intersect") < text.index(END)
    starter = STARTERS[lang]
    assert starter.build in readme
    assert f"\nraycert certify --level stable -- {starter.run}\n" in readme
    assert marked[0] in readme
    for name, data in found.items():
        assert data.isascii(), name
        assert max(map(len, data.decode().split("\n"))) <= 100, name


def test_the_command_says_what_to_type_next(tmp_path: Path) -> None:
    folder = tmp_path / "my tracer"
    said = write("cpp", folder)
    assert f"cd '{folder}' && {STARTERS['cpp'].build}\n" in said
    assert "raycert certify --level stable -- ./tracer\n" in said
    assert "tracer.cpp" in said
    written = {str(path.relative_to(folder)): path.read_bytes() for path in folder.iterdir()}
    assert written == dict(templates("cpp"))


def test_a_file_that_is_there_is_not_overwritten(tmp_path: Path) -> None:
    mine = tmp_path / "tracer.go"
    mine.write_text("mine")
    result = CliRunner().invoke(harness, ["go", "--out", str(tmp_path)])
    assert result.exit_code == 2
    assert "tracer.go" in result.output
    assert "--force" in result.output
    assert [path.name for path in tmp_path.iterdir()] == ["tracer.go"]
    assert mine.read_text() == "mine"
    forced = CliRunner().invoke(harness, ["go", "--force", "--out", str(tmp_path)])
    assert forced.exit_code == 0, forced.output
    assert MARK in mine.read_bytes()


@pytest.mark.parametrize("arguments", [["perl"], [], ["C"], [".."]])
def test_an_unknown_language_gets_the_list(arguments: list[str]) -> None:
    result = CliRunner().invoke(harness, arguments)
    assert result.exit_code == 2
    listed = result.output.rpartition(":")[2].replace(",", " ").split()
    assert {*STARTERS, READERS} == set(listed)


def test_a_side_belongs_to_the_first_hit() -> None:
    result = CliRunner().invoke(harness, ["c", "--from-inside", "exit"])
    assert result.exit_code == 2
    assert "--answers first" in result.output


def test_a_function_in_process_is_granted_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    said = write("python", tmp_path / "mine", "--in-process")
    command = said.splitlines()[-1].removeprefix("  raycert certify ")
    assert command == "--level stable tracer.py:intersect"
    monkeypatch.chdir(tmp_path / "mine")
    result = CliRunner().invoke(certify, shlex.split(command))
    assert result.exit_code == 0, result.output
    for lang, *options in (("c",), ("python", "--answers", "first"), ("readers",)):
        refused = CliRunner().invoke(harness, [lang, "--in-process", *options])
        assert refused.exit_code == 2, lang


def test_the_list_is_the_folders() -> None:
    result = CliRunner().invoke(harness, ["--list"])
    assert result.exit_code == 0
    listed = [line.split()[0] for line in result.output.splitlines()]
    folders = {entry.name for entry in files("raycert.oracle.starters").iterdir() if entry.is_dir()}
    assert set(listed) == {*STARTERS, READERS} == folders - {"__pycache__", FUNCTION}


def test_a_missing_toolchain_is_a_skip_and_on_ci_a_failure(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.delenv("CI", raising=False)
    with pytest.raises(pytest.skip.Exception, match="no-such-compiler"):
        needs("no-such-compiler")
    monkeypatch.setenv("CI", "true")
    with pytest.raises(pytest.fail.Exception, match="no-such-compiler"):
        needs("no-such-compiler")
