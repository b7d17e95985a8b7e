"""The batch oracle against the scalar one, on rays about every golden case: run by hand.

Each solid of the golden rows is a scene. Rays start from the rows' own: numbers move by a few ulps
or by steps of 2^-1 to 2^-60 of their size, are swapped with those of the solid or of other rays,
turn 0, are scaled by powers of two. Each engine has to give the scalar oracle's rounded lists, lane
for lane, and the same counts of rungs as the other.
`PYTHONPATH=tests python -m shared.batch_campaign --rays 1000000`
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

import click
import numpy as np

from raycert.cases.corpus import read_corpus
from raycert.cases.formats import BINARY32, FORMATS, Format
from raycert.cases.model import HalfSpace, Ray, Refused, Solid, leaves, lengths
from raycert.oracle.batch.blocks import Batch, scalar, trace_batch
from raycert.oracle.batch.lanes import Floats

LARGEST = 2.0**1000
"""Numbers are drawn again that a step takes beyond it."""


@dataclass(frozen=True, slots=True)
class Scene:
    """A solid of the golden rows, its rays, and the family of its first row."""

    family: str
    solid: Solid
    rays: Floats


@dataclass(slots=True)
class Tally:
    """What a campaign has seen so far."""

    rays: int = 0
    pairs: int = 0
    lanes: Counter[str] = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)


def scenes(fmt: Format) -> list[Scene]:
    """Return every solid of the golden rows of a precision, with all the rays that it has there."""
    grouped: dict[Solid, list[Ray]] = {}
    family: dict[Solid, str] = {}
    for row in read_corpus(fmt.name).rows:
        grouped.setdefault(row.solid, []).append(row.ray)
        family.setdefault(row.solid, row.family)
    return [
        Scene(family[solid], solid, np.array([(*ray.origin, *ray.direction) for ray in rays]))
        for solid, rays in grouped.items()
    ]


def numbers(solid: Solid) -> Floats:
    """Return the numbers of a solid, for rays to meet."""
    found = [0.0]
    for _, leaf in leaves(solid):
        found += lengths(leaf)
        if isinstance(leaf, HalfSpace):
            found += leaf.normal
    return np.array(found)


def jittered(scene: Scene, count: int, dice: np.random.Generator) -> Floats:
    """Return rays about those of a scene, as rows of six finite numbers."""
    rows = scene.rays[dice.integers(len(scene.rays), size=count)]
    other = scene.rays[dice.integers(len(scene.rays), size=count)]
    pool = numbers(scene.solid)

    def some(share: float) -> Floats:
        """Return a mask: of the lanes a half, and of their numbers this share."""
        return np.asarray((dice.random((count, 1)) < 0.5) & (dice.random((count, 6)) < share))

    with np.errstate(all="ignore"):
        rows = np.where(some(0.25), other, rows)
        rows = np.where(some(0.1), pool[dice.integers(len(pool), size=(count, 6))], rows)
        size = np.maximum(np.abs(rows), np.abs(rows).max(axis=1, keepdims=True) * 2.0**-8)
        step = size * np.ldexp(dice.uniform(-1, 1, (count, 6)), -dice.integers(1, 60, (count, 6)))
        rows = np.where(some(0.4), rows + step, rows)
        ulps = dice.integers(-2, 3, (count, 6)) * np.spacing(rows)
        rows = np.where(some(0.3), rows + ulps, rows)
        rows = np.where(some(0.05), -rows, rows)
        power = np.ldexp(1.0, dice.integers(-4, 5, (count, 1)))
        rows[:, 3:] *= np.where(dice.random((count, 1)) < 0.2, power, 1.0)
    good = (np.abs(rows) < LARGEST) | (np.abs(rows) == np.abs(other))
    return np.where(good & np.isfinite(rows), rows, other)


def compare(scene: Scene, rays: Floats, fmt: Format, engines: tuple[str, ...]) -> Tally:
    """Return what engines and the scalar oracle make of the same rays."""
    solve = scalar(scene.solid, fmt)
    truth = [solve(row[:3], row[3:]) for row in rays.tolist()]
    tally = Tally(len(rays), sum(map(len, truth)))
    counts = set()
    for engine in engines:
        found: Batch = trace_batch(scene.solid, rays[:, :3], rays[:, 3:], fmt, engine)
        counts.add(str(found.rungs))
        tally.lanes = Counter(found.lanes)
        for i, row in enumerate(rays.tolist()):
            if found.pairs(i) != truth[i]:
                tally.faults.append(f"{engine} {fmt.name} {scene.solid} {row}: {found.pairs(i)}")
    if len(counts) > 1:
        tally.faults.append(f"{fmt.name} {scene.solid}: engines count differently: {counts}")
    return tally


def campaign(
    count: int, seed: int, precisions: tuple[str, ...], engines: tuple[str, ...]
) -> Iterator[tuple[str, Tally]]:
    """Yield (precision/family, tally) for each scene; `count` rays, evenly over the scenes."""
    todo = [(FORMATS[name], scene) for name in precisions for scene in scenes(FORMATS[name])]
    for i, (fmt, scene) in enumerate(todo):
        share = count * (i + 1) // len(todo) - count * i // len(todo)
        dice = np.random.default_rng([seed, i])
        rays = jittered(scene, share, dice)
        if fmt is BINARY32:
            single = np.float64(np.float32(rays)) if np.abs(rays).max(initial=0) < 1e38 else rays
            rays = np.where(dice.random((share, 1)) < 0.5, single, rays)
        yield f"{fmt.name}/{scene.family}", compare(scene, rays, fmt, engines)


@click.command()
@click.option("--rays", default=1_000_000, show_default=True, help="How many in all.")
@click.option("--seed", default=1, show_default=True)
@click.option("--precision", multiple=True, type=click.Choice(list(FORMATS)), default=list(FORMATS))
@click.option("--engine", multiple=True, default=["numpy", "numba"], show_default=True)
def main(rays: int, seed: int, precision: tuple[str, ...], engine: tuple[str, ...]) -> None:
    """Compare the batch oracle with the scalar one; exit 1 on the first lane that differs."""
    total, families = Tally(), set()
    for family, tally in campaign(rays, seed, precision, engine):
        families.add(family)
        before = total.rays * 20 // max(rays, 1)
        total.rays, total.pairs = total.rays + tally.rays, total.pairs + tally.pairs
        total.lanes += tally.lanes
        total.faults += tally.faults
        for fault in tally.faults[:3]:
            click.echo(f"WRONG {family}: {fault}")
        if total.rays * 20 // max(rays, 1) > before:
            click.echo(f"{total.rays} rays, {len(families)} families, {len(total.faults)} wrong")
    click.echo(f"rungs: {dict(total.lanes)}; {total.pairs} pairs")
    sys.exit(1 if total.faults else 0)


if __name__ == "__main__":
    try:
        main()
    except Refused as error:
        sys.exit(str(error))
