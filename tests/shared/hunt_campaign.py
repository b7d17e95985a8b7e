"""The hunt tried on every planted fault of the zoo, with the golden rows withheld.

    cd tests
    python -m shared.hunt_campaign                     every fault, a minute each at most
    python -m shared.hunt_campaign no-clip diameter    these
    python -m shared.hunt_campaign --time 20 --json campaign.json

A fault that is granted `stable` shows in no answer that the level can refuse: it is hunted for its
convention, or in the range tier. A case counts only if the tracer that the fault was planted in has
it right. It is small if none of its numbers has more than 12 bits.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from math import frexp
from pathlib import Path

import click

from raycert.cases.numbers import Probe, numbers
from raycert.cases.protocol import Reply
from raycert.oracle.client.inprocess import InProcess
from raycert.oracle.hunt.executors import Here
from raycert.oracle.hunt.keep import case
from raycert.oracle.hunt.look import Criterion, Looker
from raycert.oracle.hunt.moves import cost
from raycert.oracle.hunt.pursuit import work
from raycert.oracle.hunt.search import Budget, Finding, hunt
from raycert.oracle.hunt.unit import Job
from raycert.oracle.zoo.inhabitants import BY_NAME, FAULTS
from raycert.oracle.zoo.tracer import BASE, Fault
from shared.hunted_targets import spec

SMALL = 12
UNIT = 400
"""Cases of a unit: failures are taken up after each."""


@dataclass(frozen=True, slots=True)
class Trial:
    """What a hunt for one fault came to."""

    fault: Fault
    finding: Finding | None
    tried: int
    seconds: float

    @property
    def is_small(self) -> bool:
        """Whether the case found has short numbers only."""
        return self.finding is not None and longest(self.finding.probe) <= SMALL


def longest(probe: Probe) -> int:
    """Return the most significant bits that a number of a probe has."""
    return max((_bits(x) for x in numbers(probe)), default=0)


def _bits(x: float) -> int:
    top = int(frexp(x)[0] * 2**53)
    return abs(top).bit_length() - ((top & -top).bit_length() - 1) if top else 0


def trial(fault: Fault, budget: Budget, seed: int = 0) -> Trial:
    """Hunt for one fault until something is found or the budget is used up."""
    far = fault.home.startswith("range")
    criterion = Criterion(
        "stable", "closed" if fault.granted == "stable" and not far else None, far
    )
    job = Job(InProcess("callable", spec(fault.name)), criterion=criterion, seed=seed, golden=None)
    found = hunt(job, budget, Here(partial(work, job)))
    theirs = [finding for finding in found.findings.values() if is_theirs(finding, found.looker)]
    findings = sorted(theirs, key=lambda finding: cost(finding.probe))
    return Trial(fault, findings[0] if findings else None, found.tried, found.seconds)


def is_theirs(finding: Finding, looker: Looker) -> bool:
    """Whether the tracer that the fault was planted in has the case right."""
    base = Reply("", intervals=tuple(BASE(*finding.probe)))
    return looker(finding.probe, base).flaw is None


def trials(faults: Sequence[Fault], budget: Budget, seed: int = 0) -> Iterator[Trial]:
    """Yield the trial of each fault."""
    for fault in faults:
        yield trial(fault, budget, seed)


@click.command()
@click.argument("names", nargs=-1)
@click.option("--time", "seconds", type=click.FloatRange(min=1), default=60.0, show_default=True)
@click.option("--seed", type=int, default=0, show_default=True)
@click.option("--json", "out", type=click.Path(dir_okay=False, path_type=Path))
def main(names: tuple[str, ...], seconds: float, seed: int, out: Path | None) -> None:
    """Hunt for the faults of the zoo; exit 0 if nine in ten are found."""
    faults = [BY_NAME[name] for name in names] or list(FAULTS)
    done = []
    for tried in trials(faults, Budget(seconds=seconds, most=1, unit=UNIT), seed):
        click.echo(line(tried))
        done.append(tried)
    found = [tried for tried in done if tried.finding]
    small = sum(tried.is_small for tried in found)
    click.echo(f"{len(found)} of {len(done)} found, {small} of them in small numbers")
    if out:
        out.write_text(json.dumps([form(tried) for tried in done], indent=1) + "\n")
    raise SystemExit(0 if 10 * len(found) >= 9 * len(done) else 1)


def line(tried: Trial) -> str:
    """Return a trial as a line of text."""
    finding = tried.finding
    head = f"{tried.fault.name:<22} {tried.seconds:5.1f} s {tried.tried:>6} cases"
    if finding is None:
        return f"{head}  NOT FOUND"
    return f"{head}  {longest(finding.probe):>2} bits  {finding.flaw.level} {finding.symptom}"


def form(tried: Trial) -> dict[str, object]:
    """Return a trial as JSON."""
    finding = tried.finding
    found = finding and {
        "cause": str(finding.symptom),
        "seconds": finding.after,
        **case(finding.probe),
    }
    return {
        "fault": tried.fault.name,
        "does": tried.fault.does,
        "seconds": round(tried.seconds, 1),
        "tried": tried.tried,
        "found": found,
    }


if __name__ == "__main__":
    main()
