"""Tilted rays: almost parallel to the axis, from 1e-1 to the last bit."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import SEVENTHS, THIRDS, Exact, Number
from raycert.cases.families.ladders import slopes
from raycert.cases.families.sketch import MISS, Body, Pairs, cylinder, near, pair, plus, row, tube
from raycert.cases.formats import Format

Leaning = tuple[str, str, Body, Exact, Exact, Pairs | None]


def _tubes(fmt: Format, tilt: Fraction) -> Iterator[Leaning]:
    """Yield rays of direction (tilt, 0, +-1) at infinite cylinders."""
    edge, shelf = near(fmt, Fraction(1023, 1024)), near(fmt, Fraction(1025, 1024))
    lean: Exact = (tilt, 0, 1)
    thin = tube(1)
    in_and_out = pair((shelf - 1) / tilt, (shelf + 1) / tilt)
    yield "tube-axis", "starts on the axis of a tube", thin, (0, 0, 0), lean, pair(0, 1 / tilt)
    out = pair(0, (1 - edge) / tilt)
    yield "tube-edge", "starts near the wall, going out", thin, (edge, 0, 0), lean, out
    what = "starts outside near the wall, going in"
    yield "tube-outside", what, thin, (-shelf, 0, 0), lean, in_and_out
    yield "tube-on-wall", "starts on the wall, going in", thin, (-1, 0, 0), lean, pair(0, 2 / tilt)
    yield "tube-far-up", "starts far up the axis", thin, (-shelf, 0, 4096), lean, in_and_out
    down: Exact = (tilt, 0, -1)
    yield "tube-chord", "runs beside the axis", tube(5), (-4, 3, 100), down, pair(0, 8 / tilt)


def _columns(fmt: Format, tilt: Fraction) -> Iterator[Leaning]:
    """Yield rays of direction (tilt, 0, 1) at cylinders of radius 1."""
    reach, shelf = near(fmt, 2 / tilt), near(fmt, Fraction(1025, 1024))
    lean: Exact = (tilt, 0, 1)
    column = cylinder(1, reach)
    known: Pairs | None = pair(1, min(1 + reach, 1 + 1 / tilt))
    what = "enters a cap and leaves by the wall"
    yield "column-wall", what, column, (-tilt, 0, -1), lean, known
    known = pair((shelf - 1) / tilt, 1 + reach) if shelf - 1 > tilt else None
    what = "enters a column by the wall"
    yield "column-wall-from-outside", what, column, (-shelf, 0, -1), lean, known
    known = pair(2, 6) if tilt * 6 <= 1 else None
    yield "stub", "crosses both caps", cylinder(1, 4), (0, 0, -2), lean, known


def _tilt(fmt: Format) -> Iterator[Case]:
    for name, tilt in slopes(fmt):
        for slug, what, body, origin, direction, known in (
            *_tubes(fmt, tilt),
            *_columns(fmt, tilt),
        ):
            yield row(
                fmt,
                f"{slug}-{name}",
                f"A ray with slope {name} to the axis {what}",
                body,
                origin,
                direction,
                tier="stiff",
                flags=("near-parallel",),
                known=known,
            )


def _oblique_tilt(fmt: Format) -> Iterator[Case]:
    """Yield rays along an oblique axis, tilted by a share of it, down to its last bit."""
    for name, tilt in slopes(fmt):
        for slug, what, body, frame in (
            ("tube", "inside an infinite cylinder", tube(1), SEVENTHS),
            ("cylinder", "through both caps of a cylinder", cylinder(1, 4), THIRDS),
            ("column", "inside a long cylinder", cylinder(1, 4096), SEVENTHS),
        ):
            yield row(
                fmt,
                f"{slug}-{name}",
                f"A ray has slope {name} to an oblique axis, {what}",
                body,
                (Fraction(1, 4), 0, -2),
                (tilt, 0, 1),
                frame=frame,
                tier="stiff",
                flags=("near-parallel",),
            )
    yield from _last_bit(fmt)


def _last_bit(fmt: Format) -> Iterator[Case]:
    """Yield rays along (2, 3, 6) with one component one unit in the last place away."""
    units: tuple[Number, ...] = tuple(Fraction(2) ** (e - fmt.precision) for e in (2, 2, 3))
    for i, letter in enumerate("xyz"):
        for sign, word in ((1, "above"), (-1, "below")):
            bit: list[Number] = [0, 0, 0]
            bit[i] = sign * units[i]
            for slug, origin, known in (
                ("inside", (0, 0, 0), None),
                ("outside", (21, -42, 14), MISS if (i, sign) in AWAY else None),
            ):
                yield row(
                    fmt,
                    f"last-bit-{slug}-{letter}-{word}",
                    f"The {letter} of the direction is one last bit {word} the axis, start {slug}",
                    Body("infinite_cylinder", (0, 0, 0), (2, 3, 6), 7),
                    origin,
                    plus((2, 3, 6), (bit[0], bit[1], bit[2])),
                    tier="stiff",
                    flags=("near-parallel",),
                    known=known,
                )


AWAY = ((0, 1), (1, -1), (2, 1))
"""The last bits that lead away from the axis at (21, -42, 14): along (3, -6, 2)."""

FAMILIES = (
    Family("tilt", "Tilted from the axis by 1e-1 and ever less.", _tilt),
    Family("tilt-oblique", "Tilted from an oblique axis, down to its last bit.", _oblique_tilt),
)
