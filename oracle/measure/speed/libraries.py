"""The batched reference tracer beside the ray casters that people use: the same rays and question.

Each answer is held against the exact one: the share of the rays with another number of hits, and,
of the rest, the largest relative error of a t. So a fast answer that is wrong is seen to be.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

from raycert.oracle.measure.speed.casters import CASTERS, Caster
from raycert.oracle.measure.speed.casting import CASTS, QUESTIONS, Cast, Hits, cast
from raycert.oracle.measure.speed.clock import race

PATIENCE = 3.0
"""Seconds of a library at one question, the fewest passes aside."""


@dataclass(frozen=True, slots=True)
class Row:
    """What a library costs at a question: nanoseconds a ray, and in units of the reference's.

    `wrong` is the share of the rays with another number of hits than there are, or with a t that
    is no number; `error` the largest relative error of a t elsewhere, None if there is none.
    """

    cast: str
    question: str
    library: str
    interface: str
    facets: int | None
    rays: int
    ns: float
    ratio: float
    wrong: float
    error: float | None


def here() -> tuple[list[Caster], list[str]]:
    """Return the libraries that are installed, and notes on those that are not."""
    absent = {c.name: [name for name in c.needs if find_spec(name) is None] for c in CASTERS}
    notes = [f"libraries: {name}: not installed: {', '.join(x)}" for name, x in absent.items() if x]
    return [c for c in CASTERS if not absent[c.name]], notes


def steps() -> int:
    """Return the number of questions."""
    return len(CASTS) * len(QUESTIONS)


def rows(
    size: tuple[int, int], repeats: int, seed: int, casters: list[Caster]
) -> Iterator[list[Row]]:
    """Yield the rows of each question, of the libraries that can be asked it."""
    for name in CASTS:
        asked = cast(name, size, seed)
        for question in QUESTIONS:
            yield _race(asked, question, repeats, casters)


def _race(asked: Cast, question: str, repeats: int, casters: list[Caster]) -> list[Row]:
    made = {c.name: c.way(asked, question) for c in casters}
    ways = {name: way for name, way in made.items() if way is not None}
    times = race({name: way.run for name, way in ways.items()}, repeats, PATIENCE)
    truth, count = asked.exact(question), len(asked.origins)
    base = times[casters[0].name].seconds
    found = []
    for name, way in ways.items():
        wrong, error = check(way.read(times[name].answer), truth, count)
        cost = times[name].seconds
        ns, ratio = cost / count * 1e9, cost / base
        found.append(
            Row(
                asked.name,
                question,
                name,
                way.interface,
                way.facets,
                count,
                ns,
                ratio,
                wrong,
                error,
            )
        )
    return found


def check(found: Hits, truth: Hits, rays: int) -> tuple[float, float | None]:
    """Return the share of the rays that are wrong, and the largest relative error of the rest."""
    import numpy as np

    counts = [np.bincount(hits.ray, minlength=rays) for hits in (found, truth)]
    right = counts[0] == counts[1]
    right[found.ray[~np.isfinite(found.t)]] = False
    one, two = (_sorted(hits, right) for hits in (found, truth))
    wrong = 1 - float(right.mean())
    return wrong, float(np.max(abs(one - two) / two)) if two.size else None


def _sorted(hits: Hits, keep: Any) -> Any:
    """Return the t of the rays that are kept, ray by ray and in order."""
    import numpy as np

    kept = keep[hits.ray]
    ray, t = hits.ray[kept], hits.t[kept]
    return t[np.lexsort((t, ray))]
