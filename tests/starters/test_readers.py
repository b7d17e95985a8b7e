"""The readers that need no raycert count on tracers of the zoo what `certify` counts."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from importlib.resources import files
from itertools import cycle
from math import inf, nan, nextafter
from pathlib import Path

import pytest
from click.testing import CliRunner

from raycert.cases.accept import Numbers
from raycert.cases.corpus import (
    GOLDEN,
    MANIFEST,
    Corpus,
    encode_rows,
    manifest,
    write_whole,
)
from raycert.cases.degenerate import DEGENERACIES
from raycert.cases.domain import Domain, Tolerance
from raycert.cases.formats import BINARY32, FORMATS
from raycert.cases.levels import LEVELS
from raycert.cases.protocol import TOUCHES, Hello, Reply, convention, encode, write_hello
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import Grade, by_convention, grade
from raycert.oracle.certify.verdict import Touches, by_solid
from raycert.oracle.commands.export import export
from raycert.oracle.commands.harness import READERS, harness
from raycert.oracle.judge.levels import Judge
from raycert.oracle.zoo.inhabitants import FAULTS, SOUND
from raycert.oracle.zoo.matrix import Outcome
from raycert.oracle.zoo.tracer import Intersect
from shared.corpus import golden

Respond = Callable[[GoldenRow], Numbers | None]


@dataclass(frozen=True)
class Subject:
    """What is judged: a tracer's hello, and its answer to a row; None where there is none."""

    hello: Hello
    respond: Respond = field(compare=False)

    @classmethod
    def of(cls, name: str, tracer: Intersect, **declared: str) -> Subject:
        hello = Hello(name, **declared)  # type: ignore[arg-type]
        return cls(hello, lambda row: Outcome.of(tracer, row, hello.format).answer)


def zoo(precision: str) -> list[Subject]:
    """Return some of the zoo, and all that is sound in the precision."""
    faults = FAULTS[::12] if precision == "binary64" else FAULTS[::15]
    spellings = cycle(("hex", "bits"))
    subjects = [
        Subject.of(f.name, f.make(), precision=precision, numbers=next(spellings)) for f in faults
    ]
    for animal in SOUND:
        if animal.precision == precision:
            declared = {"precision": precision, "convention": animal.convention, "numbers": "bits"}
            subjects.append(Subject.of(animal.name, animal.tracer, **declared))
    return subjects


CONVENTIONS = ("closed", "regularized", "closed but tangent rim", "regularized but start")


def exact_ones(precision: str) -> Iterator[Subject]:
    """Yield who answers the expected list, less what they declare to drop, or though they do."""
    for i, text in enumerate(CONVENTIONS):
        hello = Hello(f"exact-{i}", precision=precision, convention=text)

        def respond(row: GoldenRow, hello: Hello = hello) -> Numbers:
            return by_convention(row, the_judge(row, hello), hello, None)[0]

        yield Subject(hello, respond)
        yield Subject(replace(hello, name=f"other-{i}"), lambda row: row.expected)


CHANGES: tuple[Callable[[Numbers, Callable[[float, float], float]], Numbers | None], ...] = (
    lambda pairs, near: None,
    lambda pairs, near: pairs,
    lambda pairs, near: (),
    lambda pairs, near: pairs[1:],
    lambda pairs, near: (*pairs, *pairs),
    lambda pairs, near: pairs[::-1],
    lambda pairs, near: tuple((b, a) for a, b in pairs),
    lambda pairs, near: tuple((-a, b) for a, b in pairs),
    lambda pairs, near: tuple((a, nan) for a, _ in pairs),
    lambda pairs, near: tuple((near(a, inf), b) for a, b in pairs),
    lambda pairs, near: tuple((near(a, 0), b) for a, b in pairs),
    lambda pairs, near: tuple((a, near(b, inf)) for a, b in pairs),
    lambda pairs, near: tuple((a, near(b, a)) for a, b in pairs),
    lambda pairs, near: tuple(p for a, b in pairs for p in ((a, a), (near(a, inf), b)) if a < b),
    lambda pairs, near: (*pairs[:-1], *((a, inf) for a, _ in pairs[-1:])),
    lambda pairs, near: (*pairs, (inf, inf)),
    lambda pairs, near: ((0.0, inf),),
)
"""Changes to the expected list; `near(x, y)` is the number after x towards y."""


def changed_ones(precision: str) -> Iterator[Subject]:
    """Yield who between them answer every row with six changes of its expected list.

    Every change is made to a third of the rows; each of them is another in the next row.
    """
    for i in range(0, len(CHANGES), 3):
        place = {row.id: i + n for n, row in enumerate(golden(precision).rows)}

        def respond(row: GoldenRow, place: dict[str, int] = place) -> Numbers | None:
            change = CHANGES[place[row.id] % len(CHANGES)]
            return change(row.expected, NEXT[precision])

        yield Subject(Hello(f"changed-{i}", precision=precision, numbers="hex"), respond)


def next_single(x: float, y: float) -> float:
    """Return the binary32 after x towards y, both >= 0."""
    bits = int(BINARY32.bits(x), 16)
    step = (x < y) - (x > y)
    return BINARY32.from_bits(f"{bits + step:08x}")


NEXT = {"binary64": nextafter, "binary32": next_single}


def needs(tool: str) -> str:
    """Return the path of a tool. Where it is missing, skip and name it; on CI, fail."""
    path = shutil.which(tool)
    if path is None:
        missing = f"{tool} is not installed: this reader was not run"
        if os.environ.get("CI") == "true":
            pytest.fail(missing)
        pytest.skip(missing)
    return path


@cache
def judge(*case: object) -> Judge:
    return Judge(*case)  # type: ignore[arg-type]


def the_judge(row: GoldenRow, hello: Hello) -> Judge:
    return judge(row.solid, row.ray, hello.format, row.tier, hello.tolerance)


@pytest.fixture(autouse=True)
def each_row_has_one_judge(monkeypatch: pytest.MonkeyPatch) -> None:
    """The exact list of a row is computed once, not for every tracer."""
    monkeypatch.setattr("raycert.oracle.certify.grading.Judge", judge)


class Memory:
    """What follows from a row and an answer; the zoo answers alike, so little is made twice."""

    def __init__(self) -> None:
        self.grades: dict[object, Grade] = {}
        self.texts: dict[object, str] = {}
        self.lines: dict[object, bytes] = {}

    def grade(self, row: GoldenRow, answer: Numbers | None, hello: Hello) -> Grade:
        key = (row.id, answer, hello.convention)
        if key not in self.grades:
            self.grades[key] = grade(row, said(row, answer), hello)
        return self.grades[key]

    def text(self, row: GoldenRow, answer: Numbers | None, hello: Hello) -> str:
        key = (row.id, answer)
        if key not in self.texts:
            numbers = [hello.format.bits(x) for pair in answer or () for x in pair]
            words = ["-"] if answer is None else [str(len(answer)), *numbers]
            self.texts[key] = f"{row.id} {' '.join(words)}\n"
        return self.texts[key]

    def line(self, row: GoldenRow, answer: Numbers | None, hello: Hello) -> bytes:
        key = (row.id, answer, hello.numbers)
        if key not in self.lines:
            self.lines[key] = encode({"id": row.id} | reply(answer, hello))
        return self.lines[key]


def reply(answer: Numbers | None, hello: Hello) -> dict[str, object]:
    """Return a reply as a tracer might write it: NaN and -inf too, where there is a way to."""
    if answer is None:
        return {"error": "none"}
    ways: dict[str, Callable[[float], object]] = {
        "hex": float.hex,
        "bits": hello.format.bits,
        "decimal": lambda x: None if x == inf else x,
    }
    return {"intervals": [[ways[hello.numbers](x) for x in pair] for pair in answer]}


def said(row: GoldenRow, answer: Numbers | None) -> Reply:
    if answer is None:
        return Reply(row.id, error="none")
    return Reply(row.id, intervals=answer)


def counts(grades: Sequence[Grade]) -> Iterator[tuple[str, ...]]:
    """Yield what certify says of each type of solid, in the words of the readers."""
    for group in by_solid(grades):
        touches = Touches.of(group.grades)
        name = touches.name if touches.name in KNOWN else "mixed"
        tallies = [(level, group.tally(level)) for level in LEVELS]
        levels = [f"{level} {t.passed}/{t.passed + t.failed}" for level, t in tallies]
        ratios = [(kind, *touches.kept.get(kind, (0, 0))) for kind in TOUCHES]
        kinds = [f"{kind} {n}/{of}" for kind, n, of in ratios]
        granted = group.granted() or "refused"
        yield (group.name, granted, name, " ".join(levels), " ".join(kinds))


KNOWN = ("closed", "regularized", "not tested")


@dataclass
class Run:
    """Answers written down in both forms, and what certify says of them."""

    folder: Path
    corpus: Corpus
    golden: Path = GOLDEN
    """Where its files lie."""
    wanted: dict[str, set[tuple[str, ...]]] = field(default_factory=dict)
    memory: Memory = field(default_factory=Memory)

    def add(self, subject: Subject) -> None:
        """Write what a subject answers, and remember what it is granted."""
        name, hello = subject.hello.name, subject.hello
        answers = [(row, subject.respond(row)) for row in self.corpus.rows]
        dropped = [kind for kind, keeps in convention(hello.convention).items() if not keeps]
        drops = f"drops {len(dropped)} {' '.join(dropped)}\n" if dropped else ""
        texts = (self.memory.text(row, answer, hello) for row, answer in answers)
        (self.folder / f"{name}.txt").write_text(drops + "".join(texts))
        lines = (self.memory.line(row, answer, hello) for row, answer in answers)
        (self.folder / f"{name}.jsonl").write_bytes(write_hello(hello) + b"".join(lines))
        grades = [self.memory.grade(row, answer, hello) for row, answer in answers]
        self.wanted[name] = set(counts(grades))

    def add_all(self, subjects: Iterable[Subject]) -> None:
        for subject in subjects:
            self.add(subject)

    def c(self) -> dict[str, set[tuple[str, ...]]]:
        """Return what the reader in C says of each subject."""
        flat, program = self.folder / "golden.tsv", self.folder / "judge"
        words = ["--out", str(flat), "--precision", self.corpus.format.name]
        words += ["--golden", str(self.golden)]
        assert CliRunner().invoke(export, words).exit_code == 0
        compile_c(self.folder, program)
        return self._said([str(program), str(flat)], ".txt")

    def javascript(self) -> dict[str, set[tuple[str, ...]]]:
        """Return what the reader in JavaScript says of each subject."""
        return self._said(
            [needs("node"), source("judge.mjs"), str(self.golden / self.corpus.format.name)],
            ".jsonl",
        )

    def _said(self, command: list[str], ending: str) -> dict[str, set[tuple[str, ...]]]:
        paths = [str(self.folder / f"{name}{ending}") for name in self.wanted]
        ran = subprocess.run([*command, *paths], capture_output=True, text=True, timeout=120)
        assert ran.stderr == ""
        found: dict[str, set[tuple[str, ...]]] = {name: set() for name in self.wanted}
        for line in ran.stdout.splitlines():
            path, *columns = line.split("\t")
            found[Path(path).stem].add(tuple(columns))
        assert ran.returncode == (0 if all(map(is_granted, found.values())) else 1)
        return found


def is_granted(said: Iterable[tuple[str, ...]]) -> bool:
    return all(row[1] != "refused" and row[2] in ("closed", "not tested") for row in said)


def source(name: str) -> str:
    return str(files("raycert.oracle.starters") / READERS / name)


def compile_c(folder: Path, program: Path) -> None:
    flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2"]
    subprocess.run([needs("cc"), *flags, "-o", str(program), source("judge.c")], check=True)


def part(folder: Path, corpus: Corpus) -> Corpus:
    """Write a corpus of every fourth row."""
    rows = corpus.rows[::4]
    families = {f"{corpus.format.name}/{row.family}.jsonl": row.family for row in rows}
    files = {
        name: encode_rows([row for row in rows if row.family == family], corpus.format)
        for name, family in families.items()
    }
    for name, data in (files | {MANIFEST: manifest(files)}).items():
        write_whole(folder / name, data)
    return replace(corpus, rows=rows)


def check(run: Run) -> set[str]:
    """Check that both readers say what certify says; return the levels that are granted."""
    assert run.c() == run.wanted
    assert run.javascript() == run.wanted
    return {row[1] for said in run.wanted.values() for row in said}


@pytest.mark.parametrize("precision", FORMATS)
def test_the_verdicts_are_those_of_certify(precision: str, tmp_path: Path) -> None:
    """On the zoo, and on exact answers under any convention."""
    golden_part = tmp_path / "golden"
    run = Run(tmp_path, part(golden_part, golden(precision)), golden_part)
    run.add_all((*zoo(precision), *exact_ones(precision)))
    assert len(run.wanted) > 15
    assert check(run) >= {"refused", "stable", "exact"}


@pytest.mark.parametrize("precision", FORMATS)
def test_every_row_is_judged_as_certify_judges_it(precision: str, tmp_path: Path) -> None:
    """With changes of its list."""
    run = Run(tmp_path, golden(precision))
    run.add_all(changed_ones(precision))
    assert check(run) == {"refused"}


FAMILY = "random-slab"


@dataclass(frozen=True)
class Readers:
    """Both readers, built, and one family to judge answers to."""

    c: list[str]
    javascript: list[str]
    folder: Path

    def judge(self, text: str, lines: bytes) -> list[tuple[int, str]]:
        """Return, for each reader, its exit status, and the level granted or what it complains."""
        (self.folder / "answers.txt").write_text(text)
        (self.folder / "answers.jsonl").write_bytes(lines)
        return [
            ran([*self.c, str(self.folder / "answers.txt")]),
            ran([*self.javascript, str(self.folder / "answers.jsonl")]),
        ]


def ran(command: list[str]) -> tuple[int, str]:
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    return done.returncode, done.stderr or done.stdout.split("\t")[2]


@pytest.fixture(scope="module")
def readers(tmp_path_factory: pytest.TempPathFactory) -> Readers:
    folder = tmp_path_factory.mktemp("readers")
    assert CliRunner().invoke(harness, [READERS, "--out", str(folder)]).exit_code == 0
    golden = folder / "golden"
    golden.mkdir()
    shutil.copy(GOLDEN / "binary64" / f"{FAMILY}.jsonl", golden)
    words = ["--out", str(folder / "golden.tsv"), "--family", FAMILY]
    assert CliRunner().invoke(export, words).exit_code == 0
    compile_c(folder, folder / "judge")
    c = [str(folder / "judge"), str(folder / "golden.tsv")]
    return Readers(c, [needs("node"), str(folder / "judge.mjs"), str(golden)], folder)


def right(bits: bool = True) -> tuple[str, bytes]:
    """Return the expected answers to the family, in both forms."""
    hello, memory = Hello("right", numbers="bits" if bits else "decimal"), Memory()
    rows = [row for row in golden("binary64").rows if row.family == FAMILY]
    text = "".join(memory.text(row, row.expected, hello) for row in rows)
    lines = b"".join(memory.line(row, row.expected, hello) for row in rows)
    return text, write_hello(hello) + lines


def test_a_changed_digit_changes_the_verdict(readers: Readers) -> None:
    text, lines = right()
    assert readers.judge(text, lines) == [(0, "exact")] * 2
    row = next(row for row in golden("binary64").rows if row.family == FAMILY and row.expected)
    assert row.expected[0][0] > 0
    bits = Hello("x").format.bits(row.expected[0][0])
    assert text.count(bits) == 1
    for changed, said in [
        (bits[:2] + ("0" if bits[2] != "0" else "8") + bits[3:], (1, "refused")),
        (f"{int(bits, 16) + 2:016x}", (0, "stable")),
    ]:
        assert changed != bits
        got = readers.judge(
            text.replace(bits, changed), lines.replace(bits.encode(), changed.encode())
        )
        assert got == [said] * 2


def test_minus_zero_is_zero(readers: Readers) -> None:
    text, lines = right()
    assert " 0000000000000000" in text
    text = text.replace(" 0000000000000000", " 8000000000000000")
    lines = lines.replace(b'"0000000000000000"', b'"8000000000000000"')
    assert readers.judge(text, lines) == [(0, "exact")] * 2


def test_what_is_not_answered_once_is_not_answered(readers: Readers) -> None:
    text, lines = right()
    rows, replies = text.splitlines(True), lines.splitlines(True)
    twice = [*replies, replies[1]]
    assert readers.judge(text, b"".join(twice))[1] == (1, "refused")
    assert readers.judge(text, b"".join(replies[:-1]))[1] == (1, "refused")
    assert readers.judge(text, b"".join((replies[0], *replies[:0:-1])))[1] == (0, "exact")
    for wrong in (rows[:-1], rows[::-1], [*rows, rows[0]]):
        status, complaint = readers.judge("".join(wrong), lines)[0]
        assert status == 2
        assert "answer" in complaint


@pytest.mark.parametrize(
    ("old", "new"), [("4", "g"), ("4", "44"), ("1 ", "9999 "), ("1 ", "-1 "), (" 1 ", " drops ")]
)
def test_answers_that_are_none_are_refused_with_their_place(
    readers: Readers, old: str, new: str
) -> None:
    text, lines = right()
    status, complaint = readers.judge(text.replace(old, new, 1), lines)[0]
    assert status == 2
    assert FAMILY in complaint


@pytest.mark.parametrize(
    "declared",
    [
        Hello("x", tolerance=Tolerance(1e-9)),
        Hello("x", answers="any"),
        Hello("x", domain=Domain(distance=1e6)),
        Hello("x", degenerate=DEGENERACIES),
        Hello("x", convention="closed but any rim"),
    ],
)
def test_what_the_rows_have_no_lists_for_is_not_judged(readers: Readers, declared: Hello) -> None:
    text, _ = right()
    status, complaint = readers.judge(text, write_hello(declared))[1]
    assert status == 2
    assert "only lists of intervals with no tolerance" in complaint


def test_what_is_not_declared_is_not_asked(readers: Readers) -> None:
    path = readers.folder / "spheres.jsonl"
    path.write_bytes(write_hello(Hello("x", solids=("sphere", "cylinder"))))
    done = subprocess.run([*readers.javascript, str(path)], capture_output=True, check=False)
    assert (done.stdout, done.stderr) == (b"", b"")
    assert done.returncode == 1, "nothing was tested"


def test_an_empty_golden_file_grants_nothing(readers: Readers, tmp_path: Path) -> None:
    for name in ("golden.tsv", "none.txt"):
        (tmp_path / name).write_text("")
    command = [readers.c[0], str(tmp_path / "golden.tsv"), str(tmp_path / "none.txt")]
    assert subprocess.run(command, check=False).returncode == 1
