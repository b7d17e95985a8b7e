"""The directed search: cases that are hard already are moved, and the moved ones moved again.

It starts from the ladders of the golden families with every step drawn, from the fresh sample, and
from golden rows if it may. For each form of the exact answer it keeps the probe with the largest
backward error; those are moved most. Between a case that fails and the one that it was moved
from, it goes on to the two neighbours of which one fails.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from raycert.cases.corpus import read_manifest
from raycert.cases.dice import Dice
from raycert.cases.formats import FORMATS, Format
from raycert.cases.forms import read_ray, read_solid
from raycert.cases.jitter import jittered
from raycert.cases.numbers import Probe, between, numbers, ordinal
from raycert.cases.sample import case as sampled
from raycert.oracle.hunt.look import Seen
from raycert.oracle.hunt.moves import MOVES, form, on_lattice, overflow, pick
from raycert.oracle.hunt.placed import kept
from raycert.oracle.hunt.unit import Field

NEW, MOVED, PARTS = 48, 12, 16
"""Fresh probes of a round, probes moved in it, and parts that a way between two is cut in."""


def directed(place: Field) -> None:
    """Search until the cases or the time are used up."""
    search = _Search(place)
    while True:
        search.round()


class _Search:
    """The probes worth moving, by the form of their exact answer."""

    def __init__(self, place: Field) -> None:
        self.place = place
        self.fmt = place.looker.hello.format
        self.dice = Dice(f"hunt {place.job.seed} {place.unit.number}")
        self.sources = _sources(place, self.fmt)
        self.best: dict[tuple[str, str], tuple[float, Probe]] = {}
        self.split: set[tuple[str, str, str]] = set()

    def round(self) -> None:
        """Ask fresh probes, then what they and the best are moved to."""
        fresh = self._able([next(self.sources) for _ in range(NEW)])
        if self.place.job.asked.convention:
            fresh += self._able([on_lattice(self.dice) for _ in range(NEW)])
        if self.place.job.asked.far:
            fresh += [out for probe in fresh[::2] for out in overflow(probe, self.dice, self.fmt)]
        self._rank(self.place.look(fresh))
        parents = [probe for _, probe in self.best.values()]
        parents = [pick(self.dice, parents) for _ in range(MOVED // 2)] if parents else []
        parents += [pick(self.dice, fresh) for _ in range(MOVED // 2)] if fresh else []
        made = [(old, new) for old in parents for new in self._moves(old)]
        seen = self.place.look([new for _, new in made])
        self._rank(seen)
        self._halve(dict(seen), made)

    def _moves(self, probe: Probe) -> list[Probe]:
        return self._able(pick(self.dice, MOVES)(probe, self.dice, self.fmt))

    def _able(self, probes: list[Probe]) -> list[Probe]:
        """Return the probes that may be asked about."""
        return [probe for probe in probes if self.place.looker.wants(probe)]

    def _rank(self, seen: list[tuple[Probe, Seen]]) -> None:
        for probe, what in seen:
            if what.fault is None and what.k > 1:
                key = type(probe.solid).__name__, " ".join(form(probe)[0][:4])
                if what.k > self.best.get(key, (0.0, probe))[0]:
                    self.best[key] = what.k, probe

    def _halve(self, seen: dict[Probe, Seen], made: list[tuple[Probe, Probe]]) -> None:
        """Go from the first failure of each kind toward the case that it was moved from."""
        for old, new in made:
            fault = seen[new].fault if new in seen else None
            if fault is None or len(numbers(old)) != len(numbers(new)):
                continue
            key = fault.level, fault.kind, type(new.solid).__name__
            if key not in self.split and type(old.solid) is type(new.solid):
                self.split.add(key)
                self._between(old, new)

    def _between(self, right: Probe, wrong: Probe) -> None:
        """Cut the way from a right answer to a wrong one in parts, and again the part with both."""
        while _apart(right, wrong, self.fmt) > 1:
            steps = [between(right, wrong, i, PARTS, self.fmt) for i in range(PARTS + 1)]
            path = list(dict.fromkeys(self._able(kept(steps, self.fmt))))
            seen = dict(self.place.look(path))
            failing = next((s for s in path if s in seen and seen[s].fault), None)
            last = path[path.index(failing) - 1] if failing and failing != path[0] else None
            if failing is None or last is None or (last, failing) == (right, wrong):
                return
            right, wrong = last, failing


def _apart(one: Probe, other: Probe, fmt: Format) -> int:
    """Return the largest distance of two numbers, in steps of the format."""
    pairs = zip(numbers(one), numbers(other), strict=True)
    return max(abs(ordinal(a, fmt) - ordinal(b, fmt)) for a, b in pairs)


def _sources(place: Field, fmt: Format) -> Iterator[Probe]:
    """Yield probes without end: each unit has others, and none knows of another's."""
    seed, base = place.job.seed, place.unit.number * 100_000
    rows = _golden(place.job.golden, fmt.name) if place.job.golden else ()
    dice = Dice(f"hunt rows {seed} {place.unit.number}")
    number = 0
    while True:
        jitter, sample = jittered(seed, base + number, fmt), sampled(base + number, seed)
        yield from kept([Probe(jitter.solid, jitter.ray), Probe(sample.solid, sample.ray)], fmt)
        if rows:
            yield pick(dice, rows)
        number += 1


@cache
def _golden(folder: Path, precision: str) -> tuple[Probe, ...]:
    """Return the probes of golden rows that are not of the range tier; nothing else is read."""
    fmt, found = FORMATS[precision], []
    for name in read_manifest(folder)["files"]:
        if name.startswith(f"{precision}/"):
            for line in (folder / name).read_bytes().splitlines():
                form = json.loads(line)
                if form["tier"] != "range":
                    solid = read_solid(form["solid"], "solid", "hex", fmt)
                    found.append(Probe(solid, read_ray(form["ray"], "ray", "hex", fmt)))
    return tuple(found)
