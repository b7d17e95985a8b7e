"""The sections of `bench`: a table each, of ways that answer the same rays in one run.

`methods` and `scalar` are races of `race`; the others are below, one after the other. No way is
timed without its answers being looked at: speed with wrong answers is not speed.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice
from pathlib import Path
from shutil import which
from typing import Any

from raycert.cases.interrupts import interruptible
from raycert.cases.protocol import VERSION, ask, encode
from raycert.oracle.client.apart import ours
from raycert.oracle.client.dialogue import Question, fresh_ids
from raycert.oracle.client.process import Failure
from raycert.oracle.client.replay import greet
from raycert.oracle.client.replay import run as harness
from raycert.oracle.measure import race
from raycert.oracle.measure.catalog import BY_NAME, here
from raycert.oracle.measure.clock import Race, Time, Timed, wall
from raycert.oracle.measure.files import Effort, Report
from raycert.oracle.measure.pictures import costs, numbers
from raycert.oracle.measure.rays import ARRAYS, LEAVES, Many, arrays, rays_of
from raycert.oracle.measure.way import missing, questions
from raycert.oracle.starters import templates

Data = dict[str, Any]
Column = tuple[str, Callable[[Mapping[str, Any]], str]]
"""A title, and what stands below it for a row. Words come first, then figures."""
PATIENCE = 3.0
"""Seconds of a library at one question, the fewest passes aside."""
DIGITS = ("oracle", "arb", "mpmath-50", "mpmath-intervals", "sympy")
"""The ways of the section `scalar`."""
SINGLE_SETS = ("random", "axis-aligned", "touching")
SINGLE = 80
"""Their rays, at most."""
ENGINES = ("numpy", "numba")
AIMS = {"numba": 1.0, "numpy": 8.0}
"""How many times the naive formula an engine may cost at most, on `random` rays."""
INTEGERS, FEW_INTEGERS = {"axis-aligned": 0.01}, 0.0001
"""The share of the lanes that must stay below it at the integers: in a set, and elsewhere."""


def plain(x: float) -> str:
    """Return a figure of two or three digits: 0.021, 1.52, 312."""
    return f"{x:.3g}" if abs(x) < 1000 else f"{x:.0f}"


def percent(x: float) -> str:
    """Return a share: 0, 0.002, 12.5."""
    return "0" if x == 0 else f"{100 * x:.3g}"


# Batch.


def engines() -> list[str]:
    """Return the engines that are there and trusted."""
    from raycert.oracle.batch.engines import engine_of

    trusted = []
    for name in ENGINES:
        try:
            trusted += [name] if engine_of(name).trusted else []
        except ValueError:
            continue
    return trusted


def _batches(report: Report) -> Iterator[list[Data]]:
    some = engines()
    absent = [name for name in ENGINES if name not in some]
    report.notes += [f"batch: {name}: not installed, or not trusted here" for name in absent]
    for solid in LEAVES:
        for name in ARRAYS:
            rays = arrays(solid, name, report.effort.lanes, report.seed)
            yield [{"solid": solid, "scenario": name} | price(name, rays, some, report.effort)]


def price(name: str, rays: Many, some: Sequence[str], effort: Effort) -> Data:
    """Return what rays cost the naive formula and each engine, and the share of lanes by rung."""
    from raycert.oracle.batch.blocks import trace_batch
    from raycert.oracle.measure.arrays import naive

    def way(call: Callable[..., Any], **options: str) -> Callable[[], Any]:
        call(rays.solid, rays.origins[:64], rays.directions[:64], **options)  # loads and compiles
        return partial(call, rays.solid, rays.origins, rays.directions, **options)

    ways = {"naive": way(naive)} | {engine: way(trace_batch, engine=engine) for engine in some}
    run, count = Race(ways).run(effort.passes), len(rays.origins)
    batch = run.answers[some[-1]]
    return aimed(
        {
            "rays": count,
            "hits": float((batch.counts > 0).mean()),
            "naive_ns": run.least("naive") / count * 1e9,
            "ratios": {engine: run.least(engine) / run.least("naive") for engine in some},
            "shares": {rung: lanes / count for rung, lanes in batch.lanes.items()},
        },
        name,
    )


def aimed(row: Data, name: str) -> Data:
    """Return a row with what it has `met`: of each engine's ratio, and of `integer`, whether."""
    aims = AIMS if name == "random" else {}
    met = {key: row["ratios"][key] <= aim for key, aim in aims.items() if key in row["ratios"]}
    return row | {
        "met": met | {"integer": row["shares"]["integer"] < INTEGERS.get(name, FEW_INTEGERS)}
    }


def _marked(field: str, key: str, spell: Callable[[float], str], row: Mapping[str, Any]) -> str:
    if key not in row[field]:
        return "-"
    return ("" if row["met"].get(key, True) else "! ") + spell(row[field][key])


# Libraries.


def _libraries(report: Report) -> Iterator[list[Data]]:
    from raycert.oracle.measure.casters import CASTERS, CASTS, QUESTIONS, cast

    lacking = {caster.name: missing(caster.needs) for caster in CASTERS}
    report.notes += [
        f"libraries: {name}: not installed: {', '.join(some)}"
        for name, some in lacking.items()
        if some
    ]
    casters = [caster for caster in CASTERS if not lacking[caster.name]]
    for name in CASTS:
        asked = cast(name, report.effort.cast, report.seed)
        for question in QUESTIONS:
            yield answers(asked, question, report.effort.passes, casters)


def answers(asked: Any, question: str, passes: int, casters: Sequence[Any]) -> list[Data]:
    """Return the rows of one question, of the libraries that can be asked it.

    `wrong` is the share of the rays with another number of hits than there are, or with a t that
    is no number; `error` the largest relative error of a t elsewhere, None if there is none.
    """
    from raycert.oracle.measure.casters import check

    calls = {one.name: call for one in casters if (call := one.way(asked, question))}
    run = Race({name: call.run for name, call in calls.items()}).run(passes, PATIENCE)
    truth, count = asked.exact(question), len(asked.origins)
    base, rows = run.least(casters[0].name), []
    for name, call in calls.items():
        wrong, error = check(call.read(run.answers[name]), truth, count)
        rows.append(
            {
                "cast": asked.name,
                "question": question,
                "library": name,
                "interface": call.interface,
                "facets": call.facets,
                "rays": count,
                "ns": run.least(name) / count * 1e9,
                "ratio": run.least(name) / base,
                "wrong": wrong,
                "error": error,
            }
        )
    return rows


# Scenes.


def _scenes(report: Report) -> Iterator[list[Data]]:
    effort = report.effort
    yield from ([row] for row in costs(effort.picture, effort.solids, effort.passes))


# The pipe.

CONSTANT = """
import json, sys
print('{"hello": 1, "name": "constant"}', flush=True)
sys.stdin.readline()
for line in sys.stdin:
    print('{"id": "%s", "intervals": [[2.0, 4.0]]}' % json.loads(line)["id"], flush=True)
"""
CLIENTS = {
    "reference": ours("raycert.reference"),
    "constant": (sys.executable, "-P", "-c", CONSTANT),
}


def lines(command: Sequence[str], asked: Sequence[Question]) -> bytes:
    """Return all that the harness would write to a client."""
    hello = greet(command)
    each = (
        ask(id, question.solid, question.ray, hello.numbers, hello.format)
        for id, question in zip(islice(fresh_ids(), len(asked)), asked, strict=True)
    )
    return b"".join((encode({"hello": VERSION}), *each))


def over(command: Sequence[str], asked: Sequence[Question], passes: int) -> Race:
    """Return the race of a client alone and through the harness. `ValueError` if it fails once.

    Alone, it reads from a file the very lines that the harness would send, and its answers go to
    the null device: its start, its reading, its answers.
    """
    text = lines(command, asked)

    def bare() -> Timed:
        with tempfile.TemporaryFile() as file:
            file.write(text)
            file.seek(0)
            words = list(command)
            return wall(
                lambda: subprocess.run(words, stdin=file, stdout=subprocess.DEVNULL, check=True)
            )

    def piped() -> Timed:
        timed = wall(lambda: harness(command, asked).outcomes)
        if any(isinstance(outcome, Failure) for outcome in timed.answer.values()):
            raise ValueError(f"{command[0]!r} fails on some of the questions")
        return timed

    return Race({"bare": bare, "piped": piped}).run(passes)


def _pipe(report: Report) -> Iterator[list[Data]]:
    asked = questions(rays_of("random", report.effort.questions, report.seed))
    with tempfile.TemporaryDirectory() as folder:
        clients = CLIENTS | _compiled(Path(folder), report.notes)
        for name, command in clients.items():
            run = over(command, asked, report.effort.passes)
            bare, piped = run.least("bare"), run.least("piped")
            yield [
                {
                    "client": name,
                    "cases": len(asked),
                    "bare_us": bare / len(asked) * 1e6,
                    "piped_us": piped / len(asked) * 1e6,
                    "ratio": piped / bare,
                }
            ]


def _compiled(folder: Path, notes: list[str]) -> dict[str, tuple[str, ...]]:
    """Return the starter in C, compiled; none, and a note, where there is no compiler."""
    compiler = which("cc")
    if compiler is None:
        notes.append("pipe: C: no compiler `cc` here")
        return {}
    for name, data in templates("c"):
        (folder / name).write_bytes(data)
    program = str(folder / "client")
    sources = [str(path) for path in sorted(folder.glob("*.c"))]
    flags = ("-std=c11", "-O2", "-ffp-contract=off", "-lm")
    subprocess.run([compiler, "-o", program, *sources, *flags], check=True)
    return {"C": (program,)}


# Commands.

COMMANDS: tuple[tuple[str, int], ...] = (
    ("--help", 5),
    ("golden write --golden {folder}/golden", 1),
    ("certify reference --level stable --out {folder}/certificate.json", 1),
    ("certify oracle --level exact --out {folder}/certificate.json", 1),
)
"""The commands that are timed whole, and how often."""


def command(line: str, repeats: int) -> Data:
    """Return the wall time of one command; `CalledProcessError` if it fails."""
    with tempfile.TemporaryDirectory() as folder:
        words = line.format(folder=Path(folder).as_posix()).split()
        whole = ours("raycert", *words)

        def run() -> Timed:
            return wall(lambda: subprocess.run(whole, check=True, capture_output=True))

        time = Time.of(Race({line: run}).run(repeats).seconds[line])
    name = "raycert " + line.partition(" --")[0]
    return {"command": name, "seconds": time.best, "median": time.median}


def _commands(report: Report) -> Iterator[list[Data]]:
    yield from ([command(*each)] for each in COMMANDS)


# All of them.


def _text(name: str) -> Column:
    return name, lambda row: str(row[name])


def _number(title: str, field: str, spell: Callable[[float], str] = plain) -> Column:
    return title, lambda row: spell(row[field])


@dataclass(frozen=True)
class Section:
    """A table of measurements: the columns of its rows, and how to make those."""

    legend: str
    rows: Callable[[Report], Iterator[list[Data]]]
    steps: Callable[[Effort], int]
    words: tuple[Column, ...]
    figures: tuple[Column, ...]
    needs: tuple[str, ...] = ("numpy",)


RUNGS = ("float64", "double-double", "rational", "integer")
SECTIONS: dict[str, Section] = {
    "batch": Section(
        "naive: nanoseconds a ray of the float64 formula in NumPy; numpy, numba: the batch "
        "oracle's time over that. Then the percentage of the lanes by the highest rung that they "
        "need. Aims: on random rays numba <= 1, numpy <= 8; integer below 0.01, axis-aligned below "
        "1. A missed aim is marked !",
        _batches,
        lambda effort: len(ARRAYS) * len(LEAVES),
        (_text("solid"), _text("scenario"), _text("rays")),
        (
            _number("naive", "naive_ns"),
            *((name, partial(_marked, "ratios", name, plain)) for name in ENGINES),
            *((name, partial(_marked, "shares", name, percent)) for name in RUNGS),
        ),
    ),
    "libraries": Section(
        "a capped cylinder; pipe: with a hole along its axis. ratio: time over that of the "
        "reference tracer; a number after a library: facets around its mesh. wrong: rays with "
        "another number of hits than there are; error: largest relative error of a t on the other "
        "rays. MuJoCo has first hits and no Booleans, embreex alone has first hits.",
        _libraries,
        lambda effort: 6,
        (
            ("rays", lambda row: f"{row['cast']}, {row['rays']}"),
            ("hits", lambda row: str(row["question"])),
            ("library", lambda row: row["library"] + (f", {f}" if (f := row["facets"]) else "")),
            ("by", lambda row: str(row["interface"])),
        ),
        (
            _number("ns/ray", "ns"),
            _number("ratio", "ratio"),
            _number("wrong %", "wrong", percent),
            ("error", lambda row: "-" if row["error"] is None else f"{row['error']:.1e}"),
        ),
    ),
    "scenes": Section(
        "the whole picture (depth) of a crowd of spheres and cylinders, plan included; same: "
        "whether the two pictures have the same bits.",
        _scenes,
        lambda effort: len(numbers(effort.solids)),
        (("size", lambda row: "x".join(map(str, row["size"]))),),
        (
            _text("solids"),
            _number("us/ray planned", "planned_us"),
            _number("with nothing left out", "plain_us"),
            _number("ratio", "ratio"),
            ("same", lambda row: "yes" if row["same"] else "NO"),
        ),
    ),
    "pipe": Section(
        "the reference, a client that answers a constant, and the starter in C: microseconds a "
        "case, by the wall, alone and through the harness.",
        _pipe,
        lambda effort: len(CLIENTS) + 1,
        (_text("client"), _text("cases")),
        (
            _number("us/case alone", "bare_us"),
            _number("harness", "piped_us"),
            _number("ratio", "ratio"),
        ),
        (),
    ),
    "commands": Section(
        "seconds by the wall: the least, and the median.",
        _commands,
        lambda effort: len(COMMANDS),
        (_text("command"),),
        (_number("seconds", "seconds"), _number("median", "median")),
        (),
    ),
}


def run_scalar(report: Report, advance: Callable[[], None] = lambda: None) -> None:
    """Add the section `scalar` to a report: few rays and ways, and no backward errors."""
    ways, notes = here([BY_NAME[name] for name in DIGITS])
    report.notes += [f"scalar: {note}" for note in notes]
    effort = replace(report.effort, rays=min(report.effort.rays, SINGLE), sample=0)
    own = replace(report, effort=effort)
    race.run(SINGLE_SETS, ways, own, advance, "scalar")
    report.interrupted = own.interrupted


def run(name: str, report: Report, advance: Callable[[], None] = lambda: None) -> None:
    """Add a section to a report; partial after KeyboardInterrupt."""
    if name == "scalar":
        run_scalar(report, advance)
        return
    rows = report.sections.setdefault(name, [])
    try:
        with interruptible():
            for some in SECTIONS[name].rows(report):
                rows += some
                advance()
    except KeyboardInterrupt:
        report.interrupted = True


def steps(name: str, effort: Effort) -> int:
    """Return how often a section that is not of methods advances."""
    if name == "scalar":
        return race.steps(SINGLE_SETS, [BY_NAME[one] for one in DIGITS], effort)
    return SECTIONS[name].steps(effort)
