"""Benches: one tree, and the rays that are sent at it, each with its known list."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from raycert.cases.case import Case, Tier
from raycert.cases.families.frames import Exact, Frame, frames_for
from raycert.cases.families.shapes import Node, one_frame, scene
from raycert.cases.families.sketch import Pairs
from raycert.cases.formats import Format


@dataclass(frozen=True, slots=True)
class Shot:
    """A ray at a bench: a word for it, where it starts and goes, and what it finds."""

    slug: str
    origin: Exact
    direction: Exact
    known: Pairs | None = None


@dataclass(frozen=True, slots=True)
class Bench:
    """A tree under a name; `text` calls it in a sentence. All shots bear the flags."""

    slug: str
    text: str
    shape: Node
    flags: tuple[str, ...]
    shots: tuple[Shot, ...]
    tier: Tier = "generic"


Cases = Callable[[Format], Iterator[Case]]


def shoot(benches: Iterable[Bench]) -> Cases:
    """Return the cases of all shots at all benches, each on the axes and oblique."""
    return lambda fmt: _shots(fmt, benches, lambda slug: frames_for(slug, 1, 1))


def shoot_once(benches: Iterable[Bench]) -> Cases:
    """Return the cases of all shots at all benches, each on the axes or oblique."""
    return lambda fmt: _shots(fmt, benches, one_frame)


def _shots(
    fmt: Format, benches: Iterable[Bench], frames: Callable[[str], tuple[Frame, ...]]
) -> Iterator[Case]:
    for bench in benches:
        for shot in bench.shots:
            slug = f"{bench.slug}-{shot.slug}"
            for frame in frames(slug):
                yield scene(
                    fmt,
                    slug,
                    f"A ray meets {bench.text}: {shot.slug.replace('-', ' ')}",
                    bench.shape,
                    shot.origin,
                    shot.direction,
                    frame=frame,
                    tier=bench.tier,
                    flags=bench.flags + _told(shot, bench),
                    known=shot.known,
                )


FLAG_OF = {
    "tangent": "tangent",
    "wall": "wall",
    "rim": "rim",
    "rest": "zero-direction",
    "start": "start-on-surface",
    "inside": "start-inside",
    "plane": "cap-plane",
}


def _told(shot: Shot, bench: Bench) -> tuple[str, ...]:
    """Return the flags that the word for a shot tells."""
    words = shot.slug.split("-")
    found = [flag for word, flag in FLAG_OF.items() if word in words]
    return tuple(flag for flag in found if flag not in bench.flags)
