"""The ways in which a unit searches: a directed search, and one that Hypothesis drives.

The directed search moves cases that are hard already, and the moved ones again. It starts from the
ladders of the golden families with every step drawn, from the fresh sample, and from golden rows if
it may. For each form of the exact answer it keeps the probe with the largest backward error; those
are moved most. Between a case that fails and the one that it was moved from, it goes on to the two
neighbours of which one fails.

Hypothesis draws from the public strategies, and steers toward large log2 k and many ulps. Failures
of another level, kind or type of solid are different exceptions to it, so that it goes on after the
first and shrinks each by itself. What it makes of them is the beginning of the shrinker of ours,
which knows what simple means here. In a checkout Hypothesis also draws constants that it reads in
the modules that are loaded. So there the same seed draws the same in processes that have loaded the
same; installed, in all.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from math import inf, log2
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from raycert.cases.corpus import golden_file, read_manifest
from raycert.cases.dice import Dice
from raycert.cases.draw import jittered, sampled
from raycert.cases.files import read_as
from raycert.cases.formats import FORMATS, Format
from raycert.cases.forms import Fields, read_ray, read_solid
from raycert.cases.numbers import Probe, between, numbers, ordinal
from raycert.oracle.corpus.fresh import possible
from raycert.oracle.hunt.look import Observation
from raycert.oracle.hunt.moves import MOVES, form, of_format, on_lattice, overflow, pick
from raycert.oracle.hunt.unit import Haul, Job, Site, Spent, Suspect, TimeUp, Unit, coarse

if TYPE_CHECKING:
    from hypothesis import settings

NEW, MOVED, PARTS = 48, 12, 16
"""Fresh probes of a round, probes moved in it, and parts that a way between two is cut in."""
PATIENCE = 60
"""Cases that Hypothesis has after a new cause, to find others and to shrink: ours is faster."""
HIGHEST = 64.0
"""The largest target: errors beyond it are all the same."""


def work(job: Job, unit: Unit) -> Haul:
    """Do a unit. Raises `Unusable`."""
    site, ways = Site(job, unit), {"directed": directed, "drawn": drawn}
    try:
        if possible(site.solids):
            ways[job.methods[unit.number % len(job.methods)]](site)
    except Spent:
        return site.haul(cut=False)
    except TimeUp:
        return site.haul(cut=True)
    finally:
        site.session.close()
    return site.haul(cut=False)


def directed(site: Site) -> None:
    search = _Search(site)
    while True:
        search.round()


class _Search:
    """The probes worth moving, by the form of their exact answer."""

    def __init__(self, site: Site) -> None:
        self.site = site
        self.fmt = site.looker.hello.format
        self.dice = Dice(f"hunt {site.job.seed} {site.unit.number}")
        self.sources = _sources(site, self.fmt)
        self.best: dict[tuple[str, str], tuple[float, Probe]] = {}
        self.split: set[tuple[str, str, str]] = set()

    def round(self) -> None:
        fresh = self._able([next(self.sources) for _ in range(NEW)])
        if self.site.job.criterion.convention:
            fresh += self._able([on_lattice(self.dice) for _ in range(NEW)])
        if self.site.job.criterion.far:
            fresh += [out for probe in fresh[::2] for out in overflow(probe, self.dice, self.fmt)]
        self._rank(self.site.look(fresh))
        parents = [probe for _, probe in self.best.values()]
        parents = [pick(self.dice, parents) for _ in range(MOVED // 2)] if parents else []
        parents += [pick(self.dice, fresh) for _ in range(MOVED // 2)] if fresh else []
        moves = [
            (old, new)
            for old in parents
            for new in self._able(pick(self.dice, MOVES)(old, self.dice, self.fmt))
        ]
        seen = self.site.look([new for _, new in moves])
        self._rank(seen)
        self._halve(dict(seen), moves)

    def _able(self, probes: list[Probe]) -> list[Probe]:
        return [probe for probe in probes if self.site.looker.wants(probe)]

    def _rank(self, seen: list[tuple[Probe, Observation]]) -> None:
        for probe, what in seen:
            if what.flaw is None and what.k > 1:
                key = type(probe.solid).__name__, " ".join(form(probe)[0][:4])
                if what.k > self.best.get(key, (0.0, probe))[0]:
                    self.best[key] = what.k, probe

    def _halve(self, seen: dict[Probe, Observation], moves: list[tuple[Probe, Probe]]) -> None:
        """Go from the first failure of each kind toward the case that it was moved from."""
        for old, new in moves:
            flaw = seen[new].flaw if new in seen else None
            if flaw is None or len(numbers(old)) != len(numbers(new)):
                continue
            key = flaw.level, flaw.kind, type(new.solid).__name__
            if key not in self.split and type(old.solid) is type(new.solid):
                self.split.add(key)
                self._between(old, new)

    def _between(self, right: Probe, wrong: Probe) -> None:
        """Cut the way from a right answer to a wrong one in parts, and again the part with both."""
        while _apart(right, wrong, self.fmt) > 1:
            steps = [between(right, wrong, i, PARTS, self.fmt) for i in range(PARTS + 1)]
            path = list(dict.fromkeys(self._able(of_format(steps, self.fmt))))
            seen = dict(self.site.look(path))
            first = next((i for i, s in enumerate(path) if s in seen and seen[s].flaw), 0)
            if not first or (path[first - 1], path[first]) == (right, wrong):
                return
            right, wrong = path[first - 1], path[first]


def _apart(one: Probe, other: Probe, fmt: Format) -> int:
    pairs = zip(numbers(one), numbers(other), strict=True)
    return max(abs(ordinal(a, fmt) - ordinal(b, fmt)) for a, b in pairs)


def _sources(site: Site, fmt: Format) -> Iterator[Probe]:
    """Yield probes without end: each unit has others, and none knows of another's."""
    seed, base = site.job.seed, site.unit.number * 100_000
    rows = _golden(site.job.golden, fmt.name) if site.job.golden else ()
    dice = Dice(f"hunt rows {seed} {site.unit.number}")
    number = 0
    while True:
        jitter, sample = jittered(seed, base + number, fmt), sampled(base + number, seed, fmt)
        yield from of_format(
            [Probe(jitter.solid, jitter.ray), Probe(sample.solid, sample.ray)], fmt
        )
        if rows:
            yield pick(dice, rows)
        number += 1


@cache
def _golden(folder: Path, precision: str) -> tuple[Probe, ...]:
    """Return the probes of golden rows that are not of the range tier; nothing else is read."""
    fmt, probes = FORMATS[precision], []

    def usual(form: object) -> Iterator[Probe]:
        get = Fields(form, "row")
        if get("tier", str) != "range":
            solid = read_solid(get("solid", dict), "solid", "hex", fmt)
            yield Probe(solid, read_ray(get("ray", dict), "ray", "hex", fmt))

    for name, entry in read_manifest(folder)["files"].items():
        if name.startswith(f"{precision}/"):
            for line in golden_file(folder, name, entry).splitlines():
                probes += read_as(folder / name, line, lambda form: [*usual(form)])
    return tuple(probes)


def drawn(site: Site) -> None:
    from hypothesis import given, seed, target
    from hypothesis.errors import Flaky

    causes, left, late = set[tuple[str, str, str]](), inf, False

    @_settings(site)  # above the seed, which takes the database away
    @seed(f"{site.job.seed} {site.unit.number}")
    @given(_probes(site))
    def search(drawn: Drawn) -> None:
        nonlocal left
        if left <= 0:
            raise Spent
        left -= 1
        for probe, seen in site.look([drawn.probe]):
            target(_height(seen.k), label="log2 k")
            target(_height(1 + seen.ulps), label="log2 ulps")
            if seen.flaw:
                key = coarse(Suspect(probe, seen.flaw))
                left = left if key in causes else PATIENCE
                causes.add(key)
                raise named(key)()

    try:
        with _nothing_left():
            search()
    except* (Wrong, Flaky, Spent):
        pass  # every failure was kept when it was seen
    except* TimeUp:
        late = True
    if late:
        raise TimeUp


def _settings(site: Site) -> settings:
    """Return how to search; kept examples are tried in the first unit only."""
    from hypothesis import HealthCheck, Phase, Verbosity
    from hypothesis import settings as decorator
    from hypothesis.database import DirectoryBasedExampleDatabase

    path = site.job.examples
    phases = [Phase.generate, Phase.target, Phase.shrink]
    if path is not None and site.unit.number < len(site.job.methods):
        phases.insert(0, Phase.reuse)
    return decorator(
        max_examples=max(site.unit.cases // 2, 1),
        phases=phases,
        database=None if path is None else DirectoryBasedExampleDatabase(path),
        deadline=None,
        derandomize=False,
        report_multiple_bugs=True,
        suppress_health_check=list(HealthCheck),
        verbosity=Verbosity.quiet,
        print_blob=False,
    )


@contextmanager
def _nothing_left() -> Iterator[None]:
    """Keep Hypothesis from leaving a directory of its own in the current one."""
    from hypothesis import configuration

    with TemporaryDirectory(prefix="raycert-") as folder:
        configuration.set_hypothesis_home_dir(folder)
        try:
            yield
        finally:
            configuration.set_hypothesis_home_dir(None)


class Wrong(Exception):
    """A suspect case."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """A probe. Hypothesis would take longer to spell it than to find it."""

    probe: Probe

    def __repr__(self) -> str:
        return "a probe"


@cache
def named(cause: tuple[str, str, str]) -> type[Wrong]:
    """Return the exception of a coarse cause: Hypothesis tells failures apart by their types."""
    return type(" ".join(cause), (Wrong,), {})


def _height(x: float) -> float:
    """Return log2 of a number from 1 up as a finite target."""
    return log2(x) if x < 2.0**HIGHEST else HIGHEST


def _probes(site: Site) -> Any:
    from hypothesis import strategies

    from raycert.cases.strategies import scenes

    some = scenes(6, site.solids, site.looker.hello.format)

    @strategies.composite
    def hidden(draw: Any) -> Drawn:
        return Drawn(Probe(*draw(some)))

    return hidden()
