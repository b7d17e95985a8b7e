"""Shots: a ray at a shape in exact numbers, one line of a table; and the families made of them.

A ladder is a table whose lines are shot from ever further, or with ever less to spare: its steps
are here too, as many as a format has room for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import starmap
from typing import Any

from raycert.cases.case import Case, Family, Tier
from raycert.cases.dice import Dice
from raycert.cases.families.frames import UPRIGHT, Exact, Frame, Number, frames_for
from raycert.cases.families.sketch import (
    Body,
    Pairs,
    Pen,
    Shape,
    later,
    near,
    plus,
    slower,
    ten,
    times,
)
from raycert.cases.formats import BINARY64, Format
from raycert.cases.lattice import is_lattice
from raycert.cases.model import Ray

Flags = tuple[str, ...]
Frames = Frame | tuple[Frame, ...] | Callable[[str], tuple[Frame, ...]]
"""Where a shot stands: in a frame, in several, or in those that are drawn by its slug."""


def drawn(aligned: int = 1, oblique: int = 1) -> Callable[[str], tuple[Frame, ...]]:
    """Return the draw of so many frames along coordinate axes, and so many oblique ones."""
    return lambda slug: frames_for(slug, aligned, oblique)


def one_frame(slug: str) -> tuple[Frame, ...]:
    """Return one frame drawn by a slug: on the axes for half of the slugs, else oblique."""
    aligned = Dice(slug).bits(1)
    return frames_for(slug, aligned, 1 - aligned)


@dataclass(frozen=True, slots=True)
class Shot:
    """A ray at a shape: a line of a table.

    `text` is a sentence, or what the family's sentence has place for, without its full stop.
    `known` is the list where the construction makes it evident; an aim (`back`) counts it from the
    point aimed at, before it too.
    """

    slug: str
    text: str
    shape: Shape
    origin: Exact
    direction: Exact
    known: Pairs | None = None
    frame: Frames = UPRIGHT
    flags: Flags = ()
    tier: Tier = "generic"
    source: str = ""

    def but(self, **changes: Any) -> Shot:
        return replace(self, **changes)

    def named(self, slug: str, text: str, *flags: str) -> Shot:
        """Return it under a longer name: `{}` is its own. The flags are added to its own."""
        slug, text = slug.format(self.slug), text.format(self.text)
        return self.but(slug=slug, text=text, flags=(*self.flags, *flags))

    def back(self, steps: Number) -> Shot:
        """Return it shot from `steps` directions further back; what is before the start is cut."""
        known = None if self.known is None else later(self.known, steps)
        return self.but(origin=plus(self.origin, self.direction, -steps), known=known)

    def faster(self, factor: Fraction) -> Shot:
        """Return it with a direction `factor` times as long."""
        known = None if self.known is None else slower(self.known, factor)
        return self.but(direction=times(factor, self.direction), known=known)

    def larger(self, factor: Number) -> Shot:
        """Return it with every length `factor` times as long, |direction| too."""
        assert isinstance(self.frame, Frame)
        return self.but(frame=self.frame.scaled(factor))

    def cases(self, fmt: Format) -> Iterator[Case]:
        match self.frame:
            case Frame():
                frames: tuple[Frame, ...] = (self.frame,)
            case tuple():
                frames = self.frame
            case draw:
                frames = draw(self.slug)
        for frame in frames:
            yield self.case(fmt, frame)

    def case(self, fmt: Format, frame: Frame) -> Case:
        """Return its case in a frame.

        A named frame is added to slug and sentence. Numbers that the format cannot hold are
        rounded, and `known` is then dropped: it was the answer of another scene. `tier` is for a
        case off the lattice.
        """
        pen = Pen(fmt)
        solid = pen.solid(self.shape, frame)
        ray = Ray(pen.vector(frame.point(self.origin)), pen.vector(frame.vector(self.direction)))
        known = self.known if pen.exact else None
        where = frame.text if isinstance(self.shape, Body) else frame.text.replace("axis", "z")
        return Case(
            slug=f"{self.slug}-{frame.name}" if frame.name else self.slug,
            why=f"{self.text}, {where}." if where else f"{self.text}.",
            solid=solid,
            ray=ray,
            tier="lattice" if self.tier != "range" and is_lattice(solid, ray) else self.tier,
            flags=self.flags,
            source=self.source or ("oracle" if known is None else "construction"),
            known=known,
        )


Line = (
    tuple[str, str, Shape, Exact, Exact, Pairs | None]
    | tuple[str, str, Shape, Exact, Exact, Pairs | None, Frame]
)
"""A shot without what its table says of all its lines."""


def table(*lines: Line) -> tuple[Shot, ...]:
    return tuple(starmap(Shot, lines))


def family(
    name: str,
    reason: str,
    shots: Iterable[Shot] | Callable[[Format], Iterable[Shot]],
    text: str = "{}",
    flags: Flags = (),
    *,
    frame: Frames = UPRIGHT,
    tier: Tier = "generic",
) -> Family:
    """Return the family of these shots.

    `text` is the sentence that has a place for theirs, and `flags` come before theirs. Frame and
    tier are for the shots that do not say theirs.
    """

    def cases(fmt: Format) -> Iterator[Case]:
        for shot in shots(fmt) if callable(shots) else shots:
            yield from shot.but(
                text=text.format(shot.text),
                flags=tuple(dict.fromkeys((*flags, *shot.flags))),
                frame=frame if shot.frame is UPRIGHT else shot.frame,
                tier=tier if shot.tier == "generic" else shot.tier,
            ).cases(fmt)

    return Family(name, reason, cases)


Step = Callable[[Format, int], Iterable[Shot]]


def ladder(steps: Callable[[Format], Iterable[int]], shots: Step) -> Callable[[Format], Any]:
    return lambda fmt: (shot for k in steps(fmt) for shot in shots(fmt, k))


def is_double(fmt: Format) -> bool:
    """Whether the format has the full ladders."""
    return fmt is BINARY64


def decades(fmt: Format) -> range:
    """Return the exponents k of distances and aspects 10^k: to 1e12, or 1e5 in binary32."""
    return range(1, 13 if is_double(fmt) else 6)


def depths(fmt: Format) -> Iterator[tuple[str, Fraction]]:
    """Yield (name, depth) from 1e-2 to 1e-12, or 1e-6 in binary32."""
    for k in range(2, 13 if is_double(fmt) else 7):
        yield f"1e-{k}", near(fmt, ten(-k))


def beside(fmt: Format) -> Iterator[tuple[str, Fraction, str, bool]]:
    """Yield starts below and above a face: slug, signed depth, sentence, and whether inside."""
    for size, depth in depths(fmt):
        yield f"below-{size}", -depth, f"A ray starts {size} radii below {{}}", True
        yield f"above-{size}", depth, f"A ray starts {size} radii above {{}}", False


def slopes(fmt: Format) -> Iterator[tuple[str, Fraction]]:
    """Yield (name, slope) from 1e-1 to below the last bit of 1."""
    for k in range(1, 18 if is_double(fmt) else 9):
        yield f"1e-{k}", near(fmt, ten(-k))


def gaps(fmt: Format, step: int = 1) -> range:
    """Return the exponents k of gaps 2^-k that 1 - 2^-k and 1 + 2^-k can hold: to 52, or 23."""
    return range(1, fmt.precision, step)


def scales(fmt: Format, reach64: int, reach32: int, step64: int, step32: int) -> range:
    """Return exponents from -reach to reach, in steps."""
    if is_double(fmt):
        return range(-reach64, reach64 + 1, step64)
    return range(-reach32, reach32 + 1, step32)


def power(k: int) -> str:
    """Return the slug of 2^k, as hex-floats write it: `1p40` or `1p-40`."""
    return f"1p{k}"
