"""Endpoints that are equal, or almost: from different surfaces, an ulp apart, and less."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.case import Case, Family
from raycert.cases.families.frames import ON_Y, SEVENTHS, UPRIGHT, Exact, Frame, Number, frames_for
from raycert.cases.families.ladders import gaps, is_double, power
from raycert.cases.families.shapes import (
    MAKE,
    Shape,
    all_of,
    any_of,
    ball,
    below,
    layer,
    less,
    pipe,
    rod,
    scene,
    spans,
)
from raycert.cases.families.sketch import MISS, Pairs, pair, touch, two
from raycert.cases.formats import Format

ALONG: Exact = (-8, 0, 0)
AHEAD: Exact = (4, 0, 0)
HALF = Fraction(1, 2)

# Solids whose ends on the x axis are -+sqrt(3) (SURDS) and -+4 (WHOLES): other surfaces, same root.
SURDS: tuple[tuple[str, Shape], ...] = (
    ("ball", ball(2, 0, 1, 0)),
    ("ball-quarter", ball(Fraction(7, 4), 0, 0, Fraction(1, 4))),
    ("ball-wide", ball(Fraction(13, 4), 0, Fraction(11, 4), 0)),
    ("rod", rod((0, 1, -2), (0, 1, 2), 2)),
    ("pipe", pipe((0, Fraction(-1, 4), 0), (0, Fraction(-1, 4), 8), Fraction(7, 4))),
    ("pipe-long", pipe((0, 1, 0), (0, 1, 3), 2)),
)
WHOLES: tuple[tuple[str, Shape], ...] = (
    ("ball", ball(4)),
    ("ball-aside", ball(5, 0, 3, 0)),
    ("rod", rod((0, -3, -4), (0, -3, 4), 5)),
    ("caps", rod((-4, 0, 0), (4, 0, 0), 1)),
    ("layer", layer((-4, 2, 0), (4, 2, 0))),
    ("pipe", pipe((0, 0, 0), (0, 2, 0), 4)),
)
KNOWN: dict[str, Pairs] = {"union": pair(1, 3), "intersection": pair(1, 3), "difference": MISS}


def _equal(fmt: Format) -> Iterator[Case]:
    for kind, solids, lists in (("surds", SURDS, None), ("wholes", WHOLES, KNOWN)):
        for i, (one, first) in enumerate(solids):
            for other, second in solids[i + 1 :]:
                for name, make in MAKE.items():
                    slug = f"{kind}-{name}-{one}-{other}"
                    aligned = kind == "surds" or len(slug) % 2
                    for frame in frames_for(slug, int(aligned), 1 - int(aligned)):
                        yield scene(
                            fmt,
                            slug,
                            f"Both ends are equal {kind} in the {name} of {one} and {other}",
                            make(first, second),
                            ALONG,
                            AHEAD,
                            frame=frame,
                            flags=("equal-endpoints",),
                            known=lists[name] if lists else None,
                        )
    yield from _crossings(fmt)


def _crossings(fmt: Format) -> Iterator[Case]:
    """Yield two surfaces that the ray crosses at one point, where they are tangent or cross."""
    plane, globe, tube = (
        below((0, 0, 0), (0, 0, 2)),
        ball(4, 0, 0, 4),
        pipe((0, 4, 0), (8, 4, 0), 4),
    )
    circle, bore = ball(5), pipe((0, 0, 0), (0, 0, 1), 3)
    slant = ((-4, 0, 4), (4, 0, -4))
    rays: tuple[tuple[str, str, Shape, tuple[Exact, Exact], Pairs | None], ...] = (
        ("plane-ball-or", "a plane and its sphere", any_of(plane, globe), slant, pair(0, None)),
        ("plane-ball-and", "a plane and its sphere", all_of(plane, globe), slant, touch(1)),
        ("plane-ball-less", "a sphere less its plane", less(globe, plane), slant, pair(0, 1)),
        ("ball-tube-less", "a sphere less a tangent tube", less(globe, tube), slant, None),
        ("circle-or", "sphere and tube on a circle", any_of(circle, bore),
         ((-6, 0, 4), (3, 0, 0)), pair(1, 3)),
        ("circle-and", "sphere and tube on a circle", all_of(circle, bore),
         ((-6, 0, 4), (3, 0, 0)), pair(1, 3)),
        ("circle-less", "sphere less tube on a circle", less(circle, bore),
         ((-6, 0, 4), (3, 0, 0)), MISS),
        ("circle-slanted", "sphere less tube, through a point of their circle",
         less(circle, bore), ((-6, 0, 8), (3, 0, -4)), None),
        ("cap-circle", "sphere and cap on a circle", any_of(circle, rod((0, 0, 4), (0, 0, 8), 3)),
         ((3, 0, -16), (0, 0, 4)), pair(3, 6)),
    )  # fmt: skip
    for slug, text, shape, (origin, direction), known in rays:
        for frame in frames_for(slug, 1, 1):
            yield scene(
                fmt,
                slug,
                f"Two surfaces are crossed at one point: {text}",
                shape,
                origin,
                direction,
                frame=frame,
                flags=("equal-endpoints",),
                known=known,
            )


Pack = tuple[str, str, Shape, Pairs | None]


def _ulp_parts(fmt: Format) -> tuple[Pack, ...]:
    """Return pairs of parts whose faces are one ulp apart, met along x from -8 at speed 4."""
    ulp = two(1 - fmt.precision)
    wide, narrow = 1 + ulp, 1 - ulp / 2
    thin = Fraction(ulp, 4)
    return (
        ("shell", "a shell one ulp thick", less(ball(wide), ball(1)),
         spans((Fraction(7, 4) - thin, "7/4"), ("9/4", Fraction(9, 4) + thin))),
        ("shell-back", "a sphere less one an ulp larger", less(ball(1), ball(wide)), MISS),
        ("shell-below", "a shell half an ulp thick", less(ball(1), ball(narrow)),
         spans(("7/4", Fraction(7, 4) + thin / 2), (Fraction(9, 4) - thin / 2, "9/4"))),
        ("tube", "a tube one ulp thick",
         less(rod((0, 0, -1), (0, 0, 1), wide), rod((0, 0, -1), (0, 0, 1), 1)),
         spans((Fraction(7, 4) - thin, "7/4"), ("9/4", Fraction(9, 4) + thin))),
        ("both", "two spheres, one an ulp larger", all_of(ball(wide), ball(1)), spans(("7/4",
         "9/4"))),
        ("either", "two spheres united, one an ulp larger", any_of(ball(1), ball(wide)),
         pair(Fraction(7, 4) - thin, Fraction(9, 4) + thin)),
        ("caps-gap", "two caps one ulp apart",
         any_of(rod((-1, 0, 0), (1, 0, 0), 1), rod((wide, 0, 0), (3, 0, 0), 1)),
         spans(("7/4", "9/4"), (Fraction(9, 4) + thin, "11/4"))),
        ("caps-overlap", "what caps that overlap by an ulp share",
         all_of(rod((-1, 0, 0), (wide, 0, 0), 1), rod((1, 0, 0), (3, 0, 0), 1)),
         pair(Fraction(9, 4), Fraction(9, 4) + thin)),
        ("caps-apart", "what caps one ulp apart share",
         all_of(rod((-1, 0, 0), (1, 0, 0), 1), rod((wide, 0, 0), (3, 0, 0), 1)), MISS),
        ("planes", "two planes one ulp apart",
         less(below((wide, 0, 0), (1, 0, 0)), below((1, 0, 0), (2, 0, 0))),
         pair(Fraction(9, 4), Fraction(9, 4) + thin)),
        ("planes-back", "two planes one ulp apart, exchanged",
         less(below((1, 0, 0), (2, 0, 0)), below((wide, 0, 0), (1, 0, 0))), MISS),
    )  # fmt: skip


def _one_ulp(fmt: Format) -> Iterator[Case]:
    for slug, text, shape, known in _ulp_parts(fmt):
        rays: tuple[tuple[str, Exact, Pairs | None, Frame], ...] = (
            ("across", (-8, 0, 0), known, UPRIGHT),
            ("across-turned", (-8, 0, 0), known, ON_Y),
            ("aside", (-8, HALF, 0), None, UPRIGHT),
        )
        for way, origin, found, frame in rays:
            yield scene(
                fmt,
                f"{slug}-{way}",
                f"A ray {way.replace('-', ', ')} meets {text}",
                shape,
                origin,
                AHEAD,
                frame=frame,
                tier="stiff",
                flags=("ulp-apart",),
                known=found,
            )


def _gap_exponents(fmt: Format) -> tuple[int, ...]:
    """Return the k of gaps 2^-k: from some ulps to far below half an ulp of an end near 2."""
    if is_double(fmt):
        return (20, 40, 48, 51, 52, 53, 54, 55, 60, 80, 200)
    return (8, 16, 20, 22, 23, 24, 25, 26, 30, 40, 60)


def _gaps(fmt: Format) -> Iterator[Case]:
    """Yield parts on both sides of x = 0 with a gap of 2^-k between them, met at t = 2."""
    for k in _gap_exponents(fmt):
        gap = two(-k)
        before, after, hole = layer((-4, 0, 0), (0, 0, 0)), layer((gap, 0, 0), (1, 0, 0)), gap / 4
        block, sliver = layer((-4, 0, 0), (4, 0, 0)), layer((0, 0, 0), (gap, 0, 0))
        later = 2 + hole
        rods = (rod((-4, 0, 0), (0, 0, 0), 1), rod((gap, 0, 0), (4, 0, 0), 1))
        scenes: tuple[tuple[str, str, Shape, Pairs], ...] = (
            ("slabs", "two slabs with a gap of", any_of(before, after), spans((1, 2), (later,
             "9/4"))),
            ("rods", "two caps with a gap of", any_of(*rods), spans((1, 2), (later, 3))),
            ("slot", "a slab with a slot of", less(block, sliver), spans((1, 2), (later, 3))),
            ("sliver", "a slab of thickness", all_of(block, sliver), spans((2, later))),
            ("plane", "a half-space and a slab with a gap of",
             any_of(below((0, 0, 0), (1, 0, 0)), layer((gap, 0, 0), (4, 0, 0))),
             spans((0, 2), (later, 3))),
        )  # fmt: skip
        for slug, text, shape, known in scenes:
            yield scene(
                fmt,
                f"{slug}-{power(-k)}",
                f"A ray meets {text} 2^-{k}",
                shape,
                ALONG,
                AHEAD,
                frame=SEVENTHS if slug == "rods" and k < fmt.precision else UPRIGHT,
                tier="stiff",
                flags=("near-touching", *(("merged-by-rounding",) if _merges(fmt, k) else ())),
                known=known,
            )


def _merges(fmt: Format, k: int) -> bool:
    """Tell whether 2 + 2^-k / 4 rounds to 2."""
    return k + 2 >= fmt.precision - 1


def _near(fmt: Format) -> Iterator[Case]:
    """Yield spheres that nearly touch, 2^-k apart or into each other."""
    for k in gaps(fmt, 12):
        for side, sign in (("apart", 1), ("overlapping", -1)):
            one, other = ball(1, -1), ball(1, 1 + sign * two(-k))
            apart: Number = two(-k)
            lists: dict[str, Pairs] = {
                "union": spans((1, 3), (3 + apart, 5 + apart)) if sign > 0 else pair(1, 5 - apart),
                "intersection": MISS if sign > 0 else pair(3 - apart, 3),
                "difference": pair(1, 3) if sign > 0 else pair(1, 3 - apart),
            }
            for name, make in MAKE.items():
                yield scene(
                    fmt,
                    f"{name}-{side}-{power(-k)}",
                    f"A ray meets the {name} of two spheres 2^-{k} {side}",
                    make(one, other),
                    (-3, 0, 0),
                    (1, 0, 0),
                    tier="stiff",
                    flags=("near-touching",),
                    known=lists[name],
                )


FAMILIES = (
    Family("csg-equal-ends", "Equal endpoints from different surfaces.", _equal),
    Family("csg-one-ulp", "Faces one ulp apart.", _one_ulp),
    Family("csg-gap", "Gaps from some ulps to far below half an ulp.", _gaps),
    Family("csg-near-touch", "Spheres that almost touch.", _near),
)
