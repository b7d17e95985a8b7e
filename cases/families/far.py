"""Far starts, and scenes far from 0; needles, disks and thin walls; rays tilted from an axis.

Each ladder goes as far as the format has room: to 1e12 steps or radii, to the last bit of an axis.
The deep rays are decisive as far up the ladder as any ray can be: a tracer that gives up with
distance is caught there, not only at the edge.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction

from raycert.cases.case import Family
from raycert.cases.families.frames import SEVENTHS, THIRDS, UPRIGHT, Exact, Frame, Number
from raycert.cases.families.shots import Shot, Step, decades, depths, family, ladder, slopes, table
from raycert.cases.families.sketch import (
    MISS,
    Pairs,
    all_of,
    any_of,
    ball,
    cylinder,
    half_space,
    layer,
    less,
    near,
    pair,
    pipe,
    plus,
    rod,
    slab,
    spans,
    ten,
    times,
    touch,
    tube,
    two,
)
from raycert.cases.formats import Format

DRUM = cylinder(1, 4)
CENTRE: Exact = (0, 0, 2)
HALF, QUARTER = Fraction(1, 2), Fraction(1, 4)
Z8: tuple[Exact, Exact] = ((0, 0, -8), (0, 0, 8))
SLEEVE = less(rod(*Z8, 5), rod(*Z8, 3))
DUMBBELL = any_of(ball(3, -6), rod((-6, 0, 0), (6, 0, 0), 1), ball(3, 6))
DRILLED = less(ball(5), pipe(*Z8, 3), pipe((-8, 0, 0), (8, 0, 0), 3))

# Aims: the origin is the point aimed at, and the list is counted from there.
QUARTERS = pair(-QUARTER, QUARTER)
DEEP = table(
    ("across", "through the axis, square to it", DRUM, CENTRE, (1, 0, 0), pair(-1, 1)),
    ("slanted", "through the centre on a slant", DRUM, CENTRE, (4, 0, 3), QUARTERS, SEVENTHS),
    ("along", "down the axis", DRUM, CENTRE, (0, 0, -1), pair(-2, 2)),
    ("along-oblique", "down the axis", DRUM, CENTRE, (0, 0, -1), pair(-2, 2), THIRDS),
    ("along-beside", "down a parallel to the axis", DRUM, (QUARTER, QUARTER, 2), (0, 0, -1),
     pair(-2, 2)),
    ("tube", "through the axis of a tube", tube(1, 4), CENTRE, (4, 0, 3), QUARTERS),
    ("slab", "through a slab", slab(4), CENTRE, (4, 0, -2), pair(-1, 1), SEVENTHS),
    ("half-space", "into a half-space", half_space(), (0, 0, 0), (4, 0, -3), pair(0, None),
     SEVENTHS),
)  # fmt: skip
BESIDE = tuple(
    Shot(f"{slug}-{abs(y)}-fifths", f"{abs(y)}/5 of a radius off the axis of {body.noun}",
         body, (0, y, 8), (half, 0, climb), pair(-1, 1), UPRIGHT if y > 0 else THIRDS)
    for y, half in ((3, 4), (-4, 3))
    for body, slug, climb in ((cylinder(5, 16), "cylinder", 0), (tube(5, 16), "tube", 2))
)  # fmt: skip
SPHERES = table(
    ("centre", "through the centre", ball(1), (0, 0, 0), (1, 0, 0), pair(-1, 1)),
    ("slanted", "on a slant through the centre", ball(7), (0, 0, 0), (2, 3, 6), pair(-1, 1),
     THIRDS),
    ("3-fifths", "3/5 of a radius off the centre", ball(5), (0, 3, 0), (4, 0, 0), pair(-1, 1),
     THIRDS),
    ("4-fifths", "4/5 of a radius off the centre", ball(5), (0, 4, 0), (3, 0, 0), pair(-1, 1)),
    ("2-thirds", "sqrt(8)/3 off the centre", ball(3), (2, 2, 0), (0, 0, 1), pair(-1, 1), SEVENTHS),
)  # fmt: skip
TREES = table(
    ("tube", "a tube", SLEEVE, (0, 0, 0), (1, 0, 0), spans((-5, -3), (3, 5))),
    ("tube-beside", "a tube, beside the bore", SLEEVE, (0, 4, 0), (3, 0, 0), pair(-1, 1), SEVENTHS),
    ("dumbbell", "a dumbbell, end on", DUMBBELL, (0, 0, 0), (1, 0, 0), pair(-9, 9), THIRDS),
    ("balls", "two spheres", any_of(ball(3, -6), ball(3, 6)), (0, 0, 0), (1, 0, 0),
     spans((-9, -3), (3, 9))),
    ("drilled", "a drilled sphere", DRILLED, (0, 4, 0), (3, 0, 0), pair(-1, 1), SEVENTHS),
    ("edge-of-two", "two spheres, 24/25 of a radius off the centre",
     any_of(ball(25), ball(25, 0, -60)), (0, 24, 0), (7, 0, 0), pair(-1, 1)),
    ("edge-of-rest", "a bored sphere, 24/25 of a radius off the centre",
     less(ball(25), rod((0, 0, -60), (0, 0, 60), 20)), (0, 24, 0), (7, 0, 0), pair(-1, 1)),
    ("edge-of-both", "a sphere within a cylinder, 24/25 of a radius off the centre",
     all_of(ball(25), rod((0, 0, -60), (0, 0, 60), 25)), (0, 24, 0), (7, 0, 0), pair(-1, 1)),
    ("bore", "a tube, down the bore", SLEEVE, (1, 1, 0), (0, 0, 4), MISS),
)  # fmt: skip


def _from_afar(k: int, aims: Iterable[Shot], text: str) -> Iterator[Shot]:
    """Yield the aims from 10^k steps away."""
    start = f"From 1e{k} steps away, a ray {text}"
    return (aim.back(ten(k)).named(f"{{}}-1e{k}", start) for aim in aims)


def _deep(_: Format, k: int) -> Iterator[Shot]:
    yield from _from_afar(k, DEEP, "goes {}")
    yield Shot(f"segment-1e{k}",
               f"A direction 1e{k} radii long reaches from the start to the axis at t = 1", DRUM,
               plus(CENTRE, (4, 0, 3), -ten(k)), times(ten(k), (4, 0, 3)),
               pair(1 - QUARTER / ten(k), 1 + QUARTER / ten(k)),
               flags=("direction-scale",))  # fmt: skip


def _off_axis(fmt: Format, k: int) -> Iterator[Shot]:
    """Yield chords at 3/5 and 4/5 of the radius: the half chords are 4/5 and 3/5."""
    yield from _from_afar(k, BESIDE, "goes {}")
    yield from table(
        (f"nineteen-twentieths-1e{k}",
         f"From 1e{k} radii away, a ray meets a chord at 0.95 of the radius",
         DRUM, (-ten(k), near(fmt, Fraction(19, 20)), 2), (1, 0, 0), None),
        (f"wide-1e{k}", f"From 1e{k} steps away, a ray passes a quarter radius wide of the wall",
         DRUM, (-4 * ten(k), Fraction(5, 4), 2 - 3 * ten(k)), (4, 0, 3), MISS, THIRDS),
    )  # fmt: skip


def _grazing(fmt: Format, k: int) -> Iterator[Shot]:
    reach, text = 2 * fmt.precision // 5, f"From 1e{k} radii away, a ray "
    inside, outside = 1 - two(-reach), 1 + two(-reach)
    lines = (
        (tube(1, 4), "tangent", "exactly tangent", 1, touch(ten(k)), "tangent"),
        (DRUM, "tangent", "exactly tangent", 1, touch(ten(k)), "tangent"),
        (DRUM, "just-inside", f"2^-{reach} inside tangency", inside, None, "near-tangent"),
        (DRUM, "just-outside", f"2^-{reach} outside tangency", outside, MISS, "near-tangent"),
    )
    for body, name, how, y, known, flag in lines:
        yield Shot(f"{body.word}-{name}-1e{k}", f"{text}is {how} to {body.noun}",
                   body, (-ten(k), y, 2), (1, 0, 0), known, flags=(flag,))  # fmt: skip
    yield Shot(f"cap-1e{k}", f"{text}comes in the plane of the cap", DRUM, (0, ten(k), 4),
               (0, -1, 0), pair(ten(k) - 1, ten(k) + 1), flags=("cap-plane",))  # fmt: skip


def _spheres(_: Format, k: int) -> Iterator[Shot]:
    yield from _from_afar(k, SPHERES, "meets a sphere {}")
    reach = 1 / (5 * ten(k))
    yield Shot(f"segment-1e{k}", f"A direction 1e{k} radii long reaches the centre at t = 1",
               ball(5), times(-5 * ten(k), (3, 0, 4)), times(5 * ten(k), (3, 0, 4)),
               pair(1 - reach, 1 + reach), flags=("direction-scale",))  # fmt: skip


def _grazing_spheres(fmt: Format, k: int) -> Iterator[Shot]:
    reach, text = 2 * fmt.precision // 5, f"From 1e{k} radii away, a ray is "
    inside, outside = 1 - two(-reach), 1 + two(-reach)
    lines = (
        ("tangent", "exactly tangent", Fraction(1), touch(ten(k)), "tangent"),
        ("inside", f"2^-{reach} inside tangency", inside, None, "near-tangent"),
        ("outside", f"2^-{reach} outside tangency", outside, MISS, "near-tangent"),
        ("twentieth", "0.95 radii off the centre", near(fmt, Fraction(19, 20)), None, "far"),
        ("wide", "a quarter radius wide", 1 + QUARTER, MISS, "far"),
    )
    for name, how, y, known, flag in lines:
        yield Shot(f"{name}-1e{k}", text + how, ball(1), (-ten(k), y, 0), (1, 0, 0), known,
                   SEVENTHS if name == "wide" else UPRIGHT, (flag,))  # fmt: skip
    yield Shot(f"tangent-skew-1e{k}", f"From 1e{k} steps away, a ray touches a sphere at (1, 2, 2)",
               ball(3), plus((1, 2, 2), (2, 1, -2), -ten(k)), (2, 1, -2), touch(ten(k)),
               flags=("tangent",))  # fmt: skip


def _large(_: Format, k: int) -> tuple[Shot, ...]:
    """Return rays at the sphere of radius 10^k about (0, 0, -10^k), from one step away."""
    r = ten(k)
    globe = ball(r, 0, 0, -r)
    shots = table(
        ("down", "falls straight onto", globe, (0, 0, 1), (0, 0, -1), pair(1, 1 + 2 * r)),
        ("up", "rises straight from", globe, (0, 0, 0), (0, 0, 1), touch(0)),
        ("level", "runs one step above", globe, (-r, 0, 1), (1, 0, 0), MISS),
        ("slanted", "falls on a slant onto", globe, (0, 0, 1), (4, 0, -3), None),
        ("dip", "starts one step below", globe, (0, 0, -1), (1, 0, 0), None),
    )
    on = {"up": ("start-on-surface",)}
    text = f"A ray {{}} a sphere of radius 1e{k}"
    return tuple(shot.named(f"{{}}-1e{k}", text, *on.get(shot.slug, ())) for shot in shots)


CLOSE = table(
    ("across", "square to the axis", DRUM, (-3, 0, 2), (1, 0, 0), pair(2, 4)),
    ("along", "along the axis", DRUM, (0, 0, -2), (0, 0, 1), pair(2, 6)),
    ("slanted", "on a slant", DRUM, (-4, 0, -1), (4, 0, 3), pair(1 - QUARTER, 1 + QUARTER)),
)
CLOSE_SPHERES = (
    Shot("centre", "through the centre", ball(1), (-3, 0, 0), (1, 0, 0), pair(2, 4)),
    Shot("chord", "down a chord", ball(5), (-8, 3, 0), (4, 0, 0), pair(1, 3)),
    Shot("tangent", "along a tangent", ball(3), (-3, 0, 6), (2, 1, -2), touch(2),
         flags=("tangent",)),
    Shot("inside", "from inside", ball(5), (0, 3, 0), (0, 0, 2), pair(0, 2)),
)  # fmt: skip
CLOSE_TREES = tuple(aim.back(10).but(frame=UPRIGHT) for aim in (TREES[0], TREES[4]))


def _displaced(name: str, reason: str, shots: tuple[Shot, ...], text: str) -> Family:
    """Return the family of shots moved, with their shapes, 10^k away from the coordinate origin."""

    def moved(_: Format, k: int) -> Iterator[Shot]:
        place = UPRIGHT.moved((3 * ten(k), -2 * ten(k), ten(k)))
        where = text.replace("#", f"1e{k}") + " the coordinate origin"
        return (shot.named(f"{{}}-1e{k}", where).but(frame=place) for shot in shots)

    return family(name, reason, ladder(decades, moved), flags=("displaced",), tier="stiff")


def _far(name: str, reason: str, shots: Step) -> Family:
    return family(name, reason, ladder(decades, shots), flags=("far",), tier="stiff")


def _trees(_: Format, k: int) -> Iterator[Shot]:
    return _from_afar(k, TREES, "meets {}")


FLAG_OF = {"needle": "needle", "disk": "disk", "diagonal": "rim", "length": "far",
           "displaced": "displaced"}  # fmt: skip


def _at_thin(r: Number, h: Number) -> tuple[Shot, ...]:
    """Return rays at the cylinder of radius r from z = 0 to h: the answers hold for any r and h."""
    body, half, up = cylinder(r, h), h * HALF, h * QUARTER
    return table(
        ("across", "crosses the axis square to it", body, (-3 * r, 0, half), (r, 0, 0), pair(2, 4)),
        ("along", "runs up the axis", body, (0, 0, -h), (0, 0, h), pair(1, 2)),
        ("diagonal", "goes from rim to rim", body, (-2 * r, 0, -half), (r, 0, half), pair(1, 3)),
        ("cap-to-wall", "enters at the centre of a cap and leaves halfway up the wall", body,
         (-r * HALF, 0, -up), (r * HALF, 0, up), pair(1, 3)),
        ("beside", "runs down halfway between axis and wall", body, (r * HALF, 0, 2 * h),
         (0, 0, -h), pair(1, 2)),
        ("centre", "starts at the centre and crosses", body, (0, 0, half), (0, r, 0), pair(0, 1)),
    )  # fmt: skip


def _from_its_length(r: Number, h: Number) -> tuple[Shot, ...]:
    """Return rays at a needle from as far away as it is long: h/r radii."""
    body, share = cylinder(r, h), Fraction(r) / h
    return table(
        ("from-its-length", "comes from a height away to the axis", body,
         (-h, 0, h * HALF), (h, 0, 0), pair(1 - share, 1 + share)),
        ("from-its-length-beside", "comes from a height away, halfway to the wall", body,
         (-h, r * HALF, h * HALF), (h, 0, 0), None),
    )  # fmt: skip


def _thin(shape: str, k: int, shots: tuple[Shot, ...], frame: Frame = UPRIGHT) -> Iterator[Shot]:
    """Yield rays at a cylinder whose radius and height are 10^k to 1."""
    for shot in shots:
        words = (*shape.split("-"), *shot.slug.split("-"))
        flags = [flag for word, flag in FLAG_OF.items() if word in words]
        text = f"A ray {{}}: {shape.replace('-', ' ')}, 1e{k} to 1"
        yield shot.named(f"{shape}-{{}}-1e{k}", text, *flags).but(frame=frame)


def _needles(fmt: Format, k: int) -> Iterator[Shot]:
    long, fine = (1, ten(k)), (near(fmt, ten(-k)), 1)
    away = _from_its_length(*long)
    yield from _thin("long-needle", k, _at_thin(*long) + away)
    yield from _thin("long-needle", k, _at_thin(*long)[:2] + away[1:], SEVENTHS)
    yield from _thin("fine-needle", k, _at_thin(*fine)[:3] + _from_its_length(*fine))


def _disks(fmt: Format, k: int) -> Iterator[Shot]:
    wide, flat = _at_thin(ten(k), 1), _at_thin(1, near(fmt, ten(-k)))
    yield from _thin("wide-disk", k, wide[:4])
    yield from _thin("wide-disk", k, wide[:2], SEVENTHS)
    yield from _thin("flat-disk", k, flat[:3])


def _thin_displaced(fmt: Format, k: int) -> Iterator[Shot]:
    """Yield needles and disks at (48, -80, 96), their small size on the grid of that place."""
    spacing = two(10 - fmt.precision)
    small = spacing * round(ten(-k) / spacing)
    if small > 0:
        frame = UPRIGHT.moved((48, -80, 96))
        yield from _thin("displaced-needle", k, _at_thin(small, 1)[:3], frame)
        yield from _thin("displaced-disk", k, _at_thin(1, small)[:3], frame)


def _walls(fmt: Format) -> Iterator[Shot]:
    """Yield shells, tubes, plates and lids whose walls are 1e-1 to 1e-12 thick."""
    for name, thickness in (("1e-1", near(fmt, Fraction(1, 10))), *depths(fmt)):
        inner = near(fmt, 1 - thickness)
        wall = 1 - inner
        shell, sleeve = less(ball(1), ball(inner)), less(rod(*Z8, 1), rod(*Z8, inner))
        plate = less(layer((0, 0, 0), (0, 0, wall)), pipe(*Z8, 1))
        lid = any_of(cylinder(1, 1, -1), cylinder(1, wall))
        sides = spans((2, 2 + wall), (4 - wall, 4))
        for shot in table(
            ("shell", "a spherical shell", shell, (-3, 0, 0), (1, 0, 0), sides),
            ("shell-inside", "a spherical shell, from its centre", shell, (0, 0, 0), (0, 0, 1),
             pair(inner, 1), SEVENTHS),
            ("shell-tangent", "a shell, tangent to its hole", shell, (-3, inner, 0), (1, 0, 0),
             None),
            ("tube", "a tube", sleeve, (-3, 0, 1), (1, 0, 0), sides),
            ("plate", "a plate with a hole", plate, (-3, 0, -1), (1, 0, 1), pair(1, 1 + wall)),
            ("lid", "a lid on a cylinder", lid, (0, 0, 2), (0, 0, -1), pair(2 - wall, 3)),
        ):  # fmt: skip
            yield shot.named(f"{{}}-{name}", f"A ray meets {{}}, {name} thick")


def _leaning(fmt: Format, tilt: Fraction) -> tuple[Shot, ...]:
    """Return rays of direction (tilt, 0, +-1) at infinite cylinders, and at those of radius 1."""
    edge, shelf = near(fmt, Fraction(1023, 1024)), near(fmt, Fraction(1025, 1024))
    lean: Exact = (tilt, 0, 1)
    line, reach = tube(1), near(fmt, 2 / tilt)
    column, stub = cylinder(1, reach), cylinder(1, 4)
    through = pair((shelf - 1) / tilt, (shelf + 1) / tilt)
    by_the_wall = pair((shelf - 1) / tilt, 1 + reach) if shelf - 1 > tilt else None
    return table(
        ("tube-axis", "starts on the axis of a tube", line, (0, 0, 0), lean, pair(0, 1 / tilt)),
        ("tube-edge", "starts near the wall, going out", line, (edge, 0, 0), lean,
         pair(0, (1 - edge) / tilt)),
        ("tube-outside", "starts outside near the wall, going in", line, (-shelf, 0, 0), lean,
         through),
        ("tube-on-wall", "starts on the wall, going in", line, (-1, 0, 0), lean, pair(0, 2 / tilt)),
        ("tube-far-up", "starts far up the axis", line, (-shelf, 0, 4096), lean, through),
        ("tube-chord", "runs beside the axis", tube(5), (-4, 3, 100), (tilt, 0, -1),
         pair(0, 8 / tilt)),
        ("column-wall", "enters a cap and leaves by the wall", column, (-tilt, 0, -1), lean,
         pair(1, min(1 + reach, 1 + 1 / tilt))),
        ("column-wall-from-outside", "enters a column by the wall", column, (-shelf, 0, -1), lean,
         by_the_wall),
        ("stub", "crosses both caps", stub, (0, 0, -2), lean,
         pair(2, 6) if 6 * tilt <= 1 else None),
    )  # fmt: skip


def _tilt(fmt: Format) -> Iterator[Shot]:
    for name, tilt in slopes(fmt):
        for shot in _leaning(fmt, tilt):
            yield shot.named(f"{{}}-{name}", f"A ray with slope {name} to the axis {{}}")


def _oblique_tilt(fmt: Format) -> Iterator[Shot]:
    """Yield rays along an oblique axis, tilted by a share of it, down to its last bit."""
    start: Exact = (QUARTER, 0, -2)
    for name, tilt in slopes(fmt):
        lean: Exact = (tilt, 0, 1)
        for shot in table(
            ("tube", "inside an infinite cylinder", tube(1), start, lean, None, SEVENTHS),
            ("cylinder", "through both caps of a cylinder", cylinder(1, 4), start, lean, None,
             THIRDS),
            ("column", "inside a long cylinder", cylinder(1, 4096), start, lean, None, SEVENTHS),
        ):  # fmt: skip
            yield shot.named(f"{{}}-{name}", f"A ray has slope {name} to an oblique axis, {{}}")
    yield from _last_bit(fmt)


AWAY = ((0, 1), (1, -1), (2, 1))
"""The last bits that lead away from the axis at (21, -42, 14): along (3, -6, 2)."""


def _last_bit(fmt: Format) -> Iterator[Shot]:
    """Yield rays along (2, 3, 6) with one component one unit in the last place away."""
    body, units = pipe((0, 0, 0), (2, 3, 6), 7), [two(e - fmt.precision) for e in (2, 2, 3)]
    for i, letter in enumerate("xyz"):
        for sign, word in ((1, "above"), (-1, "below")):
            x, y, z = (c + (sign * units[i] if i == j else 0) for j, c in enumerate((2, 3, 6)))
            away: Pairs | None = MISS if (i, sign) in AWAY else None
            text = f"The {letter} of the direction is one last bit {word} the axis, start {{}}"
            for shot in table(
                ("inside", "inside", body, (0, 0, 0), (x, y, z), None),
                ("outside", "outside", body, (21, -42, 14), (x, y, z), away),
            ):
                yield shot.named(f"last-bit-{{}}-{letter}-{word}", text)


FAMILIES = (
    _displaced("displaced", "Ray and cylinder together far from the coordinate origin.", CLOSE,
               "A ray goes {}, close by, # radii from"),
    _far("far-deep", "Far starts aimed through the axis, the caps and the planes.", _deep),
    _far("far-off-axis", "Far starts aimed beside the axis, and wide of the wall.", _off_axis),
    _far("far-grazing", "Far starts that graze the wall or a cap.", _grazing),
    _far("sphere-far", "Far starts aimed through a sphere.", _spheres),
    _far("sphere-far-grazing", "Far starts that graze a sphere.", _grazing_spheres),
    _displaced("sphere-displaced", "Ray and sphere far from the coordinate origin.", CLOSE_SPHERES,
               "A ray goes {} of a sphere, # from"),
    family("sphere-large", "Spheres of a planet's size, seen from close by.",
           ladder(decades, _large), flags=("large",), tier="stiff"),
    _far("csg-far", "Trees from 1e1 to 1e12 steps away.", _trees),
    _displaced("csg-displaced", "Trees far from the coordinate origin.", CLOSE_TREES,
               "A ray meets {}, # from"),
    family("needle", "h/r from 1e1 to 1e12: long ones and fine ones.", ladder(decades, _needles),
           tier="stiff"),
    family("disk", "r/h from 1e1 to 1e12: wide ones and flat ones.", ladder(decades, _disks),
           tier="stiff"),
    family("thin-displaced", "Needles and disks far from the coordinate origin.",
           ladder(decades, _thin_displaced), tier="stiff"),
    family("csg-thin", "Trees with walls from 1e-1 to 1e-12 thick.", _walls, flags=("thin-wall",),
           tier="stiff"),
    family("tilt", "Tilted from the axis by 1e-1 and ever less.", _tilt, flags=("near-parallel",),
           tier="stiff"),
    family("tilt-oblique", "Tilted from an oblique axis, down to its last bit.", _oblique_tilt,
           flags=("near-parallel",), tier="stiff"),
)  # fmt: skip
