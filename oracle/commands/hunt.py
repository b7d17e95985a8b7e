"""`raycert hunt`: search for cases that an implementation gets wrong, and make them simple."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from json import dumps
from typing import Any

import click

from raycert.cases.corpus import GOLDEN, MANIFEST, read_manifest
from raycert.cases.files import BadFile
from raycert.cases.interrupts import held, interruptible
from raycert.cases.model import SOLIDS
from raycert.oracle.client.dialogue import Target, Unusable
from raycert.oracle.commands.options import (
    FOLDER,
    TARGETS,
    aim,
    check_convention,
    golden_option,
    level_option,
    limits,
    limits_options,
    needs,
    out_option,
    seed_option,
    solid_option,
    spelled,
    statuses,
    stop,
    target_argument,
    workers_option,
    writing,
)
from raycert.oracle.corpus.golden import Contradiction, show
from raycert.oracle.exact.trace import trace
from raycert.oracle.hunt import keep
from raycert.oracle.hunt.executors import Cluster, Executor, Here, Lost, Processes
from raycert.oracle.hunt.keep import answer, case
from raycert.oracle.hunt.look import Criterion
from raycert.oracle.hunt.pursuit import work
from raycert.oracle.hunt.search import Budget, Finding, Hunt
from raycert.oracle.hunt.search import hunt as run
from raycert.oracle.hunt.unit import Job
from raycert.oracle.reports.foreign import say

SECONDS = 60.0

STATUSES = {
    0: "nothing was found",
    1: "something was",
    3: "the target could not be run, or the cluster was lost: what was found by then is kept",
}
EPILOG = f"""{TARGETS}
\b
How it searches: a directed search takes hard cases, and moves them along the
grid of the numbers, toward double roots, rims and coincident faces, far away,
thin, parallel, into Booleans; Hypothesis draws others, and steers toward large
errors. A failure counts only where the case decides the level, and only if it
comes again. It is then made simple: fewer parts, axes along coordinates, small
whole numbers; failures with the same cause count once.

\b
Examples:
  raycert hunt my_tracer:intersect                 a minute, level stable
  raycert hunt --time 600 --workers 4 -- ./my_tracer
  raycert hunt ./tracer.so --cases 20000 --seed 7  the same again finds the same
  raycert certify --golden hunted --out replay.json my_tracer:intersect
                                                   replay what was found
  dask scheduler & dask worker HOST:8786 --nthreads 1 &
  raycert hunt my_tracer:intersect --time 3600 --scheduler tcp://HOST:8786

\b
In --out: golden rows with a manifest, for certify --golden and explain; and
hunt-SEED.json, with the answers and what each case was before it was made
simple. The same hunt again replaces its own; another has the next free name.
Ctrl-C ends the hunt and keeps what was found.

{statuses(STATUSES)}
"""


@click.command(epilog=EPILOG)
@target_argument
@level_option("stable")
@click.option("--convention", help="Count touches against this too: closed, regularized, ...")
@click.option("--range/--no-range", "far", help="Count cases that over- or underflow too.")
@solid_option
@click.option("--time", "seconds", type=click.FloatRange(0.1), help="Seconds to hunt (60).")
@click.option("--cases", type=click.IntRange(1), help="Cases to try, instead of a time.")
@click.option("--most", type=click.IntRange(1), default=20, show_default=True, help="Causes.")
@seed_option(0, "What is drawn; the same seed finds the same.")
@workers_option(1, 256)
@click.option("--scheduler", help="Hunt on the Dask cluster with this address.")
@click.option(
    "--golden-seeds/--no-golden", "seeded", default=True, help="Move golden rows too, or none."
)
@golden_option
@click.option(
    "--examples", type=FOLDER, help="Keep Hypothesis's examples here, and try them first."
)
@out_option(FOLDER, "What was found.", default="hunted", show_default=True)
@limits_options
@held()
def hunt(target: tuple[str, ...], **options: Any) -> None:
    """Search for cases that TARGET gets wrong, beyond the golden ones, and make them simple."""
    _check(options)
    job = _job(aim(target), options)
    found = _hunt(job, options)
    report = _written(found, job, target, options)
    _print(found, report, target, options)
    if found.lost:
        stop(f"the hunt ended early: {found.ended}")
    raise SystemExit(1 if found.findings else 0)


def _check(options: dict[str, Any]) -> None:
    if options["cases"] and options["seconds"]:
        raise click.UsageError("--time and --cases exclude one another")
    if options["scheduler"] and options["workers"] > 1:
        raise click.UsageError("--workers and --scheduler exclude one another")
    if options["golden"] and not options["seeded"]:
        raise click.UsageError("--golden and --no-golden exclude one another")
    check_convention(options["convention"] or "closed")
    read = [("--golden", options["golden"])] if options["golden"] else []
    read += [("--out", options["out"])] if (options["out"] / MANIFEST).exists() else []
    for hint, folder in read:
        try:
            read_manifest(folder)
        except BadFile as error:
            raise click.BadParameter(str(error), param_hint=hint) from None


def _job(target: Target, options: dict[str, Any]) -> Job:
    needs("hunt", "hunt", "hypothesis")
    return Job(
        target,
        limits(options),
        Criterion(options["level"], options["convention"], options["far"]),
        options["seed"],
        options["solids"] or tuple(SOLIDS),
        (options["golden"] or GOLDEN) if options["seeded"] else None,
        options["examples"],
    )


def _hunt(job: Job, options: dict[str, Any]) -> Hunt:
    seconds = None if options["cases"] else options["seconds"] or SECONDS
    budget, work_here = Budget(options["cases"], seconds, options["most"]), partial(work, job)
    try:
        with _watched(budget) as on_progress:
            executor: Executor = Here(work_here)
            if options["scheduler"]:
                with interruptible():
                    executor = Cluster(work_here, options["scheduler"])
            elif options["workers"] > 1:
                executor = Processes(work_here, options["workers"])
            return run(job, budget, executor, on_progress)
    except (Unusable, Lost) as error:
        stop(str(error))


@contextmanager
def _watched(budget: Any) -> Iterator[Callable[[Hunt], None]]:
    """Show on a terminal how far the hunt is: cases, failures, the worst k so far."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    from raycert.oracle.reports.screen import screen

    columns = BarColumn(), TimeElapsedColumn(), TextColumn("{task.description}")
    with Progress(*columns, console=screen(stderr=True), transient=True) as bar:
        task = bar.add_task("starting", total=budget.cases or budget.seconds)

        def show(found: Hunt) -> None:
            done = found.tried if budget.cases else found.seconds
            bar.update(task, completed=done, description=status(found))

        yield show


def status(found: Hunt) -> str:
    causes = len(found.findings)
    plural, worst = (
        "" if causes == 1 else "s",
        f"{found.worst.k:g}" if found.worst.probe else "<= 1",
    )
    return f"{found.tried} cases, {causes} cause{plural} of failure, worst k {worst}"


def _written(
    found: Hunt, job: Job, target: tuple[str, ...], options: dict[str, Any]
) -> dict[str, Finding]:
    names = ("level", "convention", "far", "solids", "cases", "seconds", "seed", "seeded")
    asked = {"target": list(spelled(target)), **{name: options[name] for name in names}}
    findings = keep.named(found.findings.values(), keep.family(job.seed))
    try:
        with writing(options["out"]):
            findings = keep.write(options["out"], found, asked)
    except Contradiction as error:
        doubt = f"the oracle is in doubt, nothing was written: {error}"
        raise click.ClickException(doubt) from None
    return findings


def _print(
    found: Hunt, findings: dict[str, Finding], target: tuple[str, ...], options: dict[str, Any]
) -> None:
    for id, finding in findings.items():
        say(f"{id}  {finding.flaw.level} fails: {finding.symptom}")
        say(f"  case     {dumps(case(finding.probe))}")
        for probe in finding.before:
            say(f"  after    {dumps(case(probe))}")
        say(f"  answer   {dumps(answer(finding.outcome))}")
        say(f"  exact    {show(trace(*finding.probe).intervals)}")
        say(f"  because  {finding.flaw.reason}")
        if not finding.repeats:
            say("  It did not come again in a new process, so no row was written.")
    say(f"{status(found)}, {found.seconds:.0f} s, seed {options['seed']}" + _end(found))
    if any(finding.repeats for finding in findings.values()):
        out = options["out"]
        replay = ("--golden", str(out), "--level", options["level"], "--out", f"{out}/replay.json")
        say("replay: " + shlex.join(("raycert", "certify", *replay, *spelled(target))))


def _end(found: Hunt) -> str:
    """Return how a hunt ended, where that is not as it was asked to."""
    ends = {"budget": "", "most": "; ended at --most causes", "interrupted": "; interrupted"}
    return ends.get(found.ended, "; ended early")
