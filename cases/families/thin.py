"""Needles and disks: r/h from 1e1 to 1e12 both ways, near and far from the coordinate origin."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import SEVENTHS, UPRIGHT, Exact, Frame, Number
from raycert.cases.families.ladders import decades
from raycert.cases.families.sketch import Pairs, cylinder, near, pair, row, ten, two
from raycert.cases.formats import Format

HALF, QUARTER = Fraction(1, 2), Fraction(1, 4)
Shot = tuple[str, str, Exact, Exact, Pairs | None]


def _shots(r: Number, h: Number) -> tuple[Shot, ...]:
    """Return rays at the cylinder of radius r from z = 0 to h: the answers hold for any r and h."""
    return (
        ("across", "crosses the axis square to it", (-3 * r, 0, h * HALF), (r, 0, 0), pair(2, 4)),
        ("along", "runs up the axis", (0, 0, -h), (0, 0, h), pair(1, 2)),
        ("diagonal", "goes from rim to rim", (-2 * r, 0, -h * HALF), (r, 0, h * HALF), pair(1, 3)),
        (
            "cap-to-wall",
            "enters at the centre of a cap and leaves halfway up the wall",
            (-r * HALF, 0, -h * QUARTER),
            (r * HALF, 0, h * QUARTER),
            pair(1, 3),
        ),
        (
            "beside",
            "runs down halfway between axis and wall",
            (r * HALF, 0, 2 * h),
            (0, 0, -h),
            pair(1, 2),
        ),
        ("centre", "starts at the centre and crosses", (0, 0, h * HALF), (0, r, 0), pair(0, 1)),
        (
            "centre-up",
            "starts at the centre and climbs",
            (0, 0, h * HALF),
            (0, 0, h),
            pair(0, HALF),
        ),
    )


def _from_its_length(r: Number, h: Number) -> tuple[Shot, ...]:
    """Return rays at a needle from as far away as it is long: h/r radii."""
    near_side, far_side = 1 - Fraction(r) / h, 1 + Fraction(r) / h
    return (
        (
            "from-its-length",
            "comes from a height away to the axis",
            (-h, 0, h * HALF),
            (h, 0, 0),
            pair(near_side, far_side),
        ),
        (
            "from-its-length-beside",
            "comes from a height away, halfway to the wall",
            (-h, r * HALF, h * HALF),
            (h, 0, 0),
            None,
        ),
    )


def _thin(
    fmt: Format,
    shape: str,
    k: int,
    size: tuple[Number, Number],
    shots: tuple[Shot, ...],
    frame: Frame = UPRIGHT,
) -> Iterator[Case]:
    """Yield rays at a cylinder of this radius and height, 10^k to 1."""
    radius, height = size
    needle = "needle" in shape
    for name, text, origin, direction, known in shots:
        flags = ["needle" if needle else "disk"]
        flags += ["rim"] if name == "diagonal" else []
        flags += ["far"] if "length" in name else []
        flags += ["displaced"] if frame.shift != (0, 0, 0) else []
        yield row(
            fmt,
            f"{shape}-{name}-1e{k}",
            f"A ray {text}: {shape.replace('-', ' ')}, 1e{k} to 1",
            cylinder(radius, height),
            origin,
            direction,
            frame=frame,
            tier="stiff",
            flags=tuple(flags),
            known=known,
        )


def _needles(fmt: Format) -> Iterator[Case]:
    for k in decades(fmt):
        long, fine = (1, ten(k)), (near(fmt, ten(-k)), 1)
        away = _from_its_length(*long)
        yield from _thin(fmt, "long-needle", k, long, _shots(*long)[:6] + away)
        yield from _thin(fmt, "long-needle", k, long, _shots(*long)[:2] + away[1:], SEVENTHS)
        away = _from_its_length(*fine)
        yield from _thin(fmt, "fine-needle", k, fine, _shots(*fine)[:3] + away)


def _disks(fmt: Format) -> Iterator[Case]:
    for k in decades(fmt):
        wide, flat = (ten(k), 1), (1, near(fmt, ten(-k)))
        yield from _thin(fmt, "wide-disk", k, wide, _shots(*wide)[:4])
        yield from _thin(fmt, "wide-disk", k, wide, _shots(*wide)[:2], SEVENTHS)
        yield from _thin(fmt, "flat-disk", k, flat, _shots(*flat)[:3])


def _displaced(fmt: Format) -> Iterator[Case]:
    """Yield needles and disks at (48, -80, 96), their small size on the grid of that place."""
    spacing = two(10 - fmt.precision)
    frame = UPRIGHT.moved((48, -80, 96))
    for k in decades(fmt):
        small = spacing * round(ten(-k) / spacing)
        if small > 0:
            needle, disk = (small, 1), (1, small)
            yield from _thin(fmt, "displaced-needle", k, needle, _shots(*needle)[:3], frame)
            yield from _thin(fmt, "displaced-disk", k, disk, _shots(*disk)[:3], frame)


FAMILIES = (
    Family("needle", "h/r from 1e1 to 1e12: long ones and fine ones.", _needles),
    Family("disk", "r/h from 1e1 to 1e12: wide ones and flat ones.", _disks),
    Family("thin-displaced", "Needles and disks far from the coordinate origin.", _displaced),
)
