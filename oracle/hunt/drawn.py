"""The search that Hypothesis drives: the public strategies, its targets, shrinker and database.

It steers toward large log2 k and many ulps. Failures of another level, kind or type of solid are
different exceptions to it, so that it goes on after the first and shrinks each by itself. What it
makes of them is the beginning of the shrinker of ours, which knows what simple means here.

In a checkout Hypothesis also draws constants that it reads in the modules that are loaded. So there
the same seed draws the same in processes that have loaded the same; installed, in all.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from math import log2
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from raycert.cases.numbers import Probe
from raycert.oracle.hunt.session import TimeUp
from raycert.oracle.hunt.unit import Failing, Field, Spent, coarse

if TYPE_CHECKING:
    from hypothesis import settings

PATIENCE = 60
"""Cases after a new cause: to find others, and to shrink them."""
HIGHEST = 64.0
"""The largest target: errors beyond it are all the same."""


def drawn(place: Field) -> None:
    """Search until the cases or the time are used up, or Hypothesis has had enough."""
    from hypothesis import given, seed, target
    from hypothesis.errors import Flaky

    patience, late = Patience(), False

    @_settings(place)  # above the seed, which takes the database away
    @seed(f"{place.job.seed} {place.unit.number}")
    @given(_probes(place))
    def search(drawn: Drawn) -> None:
        patience.check()
        for probe, seen in place.look([drawn.probe]):
            target(_height(seen.k), label="log2 k")
            target(_height(1 + seen.ulps), label="log2 ulps")
            if seen.fault:
                key = coarse(Failing(probe, seen.fault))
                patience.found(key)
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


def _settings(place: Field) -> settings:
    """Return how to search; kept examples are tried in the first unit only."""
    from hypothesis import HealthCheck, Phase, Verbosity
    from hypothesis import settings as decorator

    phases = [Phase.generate, Phase.target, Phase.shrink]
    if place.job.examples is not None and place.unit.number < len(place.job.methods):
        phases.insert(0, Phase.reuse)
    return decorator(
        max_examples=max(place.unit.cases // 2, 1),
        phases=phases,
        database=_database(place),
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
    """A failing case."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """A probe. Hypothesis would take longer to spell it than to find it."""

    probe: Probe

    def __repr__(self) -> str:
        return "a probe"


class Patience:
    """Ends a search PATIENCE cases after the last new cause: ours is the faster shrinker."""

    def __init__(self) -> None:
        """Begin without a cause."""
        self._known: set[tuple[str, str, str]] = set()
        self._left = 0

    def found(self, key: tuple[str, str, str]) -> None:
        """Take a cause; a new one gives time again."""
        if key not in self._known:
            self._known.add(key)
            self._left = PATIENCE

    def check(self) -> None:
        """Count a case. Raises `Spent`."""
        if self._known:
            self._left -= 1
            if self._left < 0:
                raise Spent


@cache
def named(cause: tuple[str, str, str]) -> type[Wrong]:
    """Return the exception of a coarse cause: Hypothesis tells failures apart by their types."""
    return type(" ".join(cause), (Wrong,), {})


def _height(x: float) -> float:
    """Return log2 of a number from 1 up as a finite target."""
    return log2(x) if x < 2.0**HIGHEST else HIGHEST


def _probes(place: Field) -> Any:
    from hypothesis import strategies

    from raycert.cases.strategies import scenes

    some = scenes(6, place.solids, place.looker.hello.format)

    @strategies.composite
    def hidden(draw: Any) -> Drawn:
        return Drawn(Probe(*draw(some)))

    return hidden()


def _database(place: Field) -> Any:
    from hypothesis.database import DirectoryBasedExampleDatabase

    path = place.job.examples
    return None if path is None else DirectoryBasedExampleDatabase(path)
