"""Fresh cases: steps of the golden ladders drawn anew, and scenes of parts that share numbers.

A case depends on its seed, its number and the format only, and on no other case: it is the same on
every machine. On a ladder everything is drawn in exact numbers as the golden families are, so that
what is exactly tangent stays so; the answer is given where the construction makes it evident.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TypeVar

from raycert.cases import recipes
from raycert.cases.case import Case
from raycert.cases.dice import Dice
from raycert.cases.families.frames import ALIGNED, OBLIQUE, UPRIGHT, Exact, Frame, Number
from raycert.cases.families.lists import AHEAD, SPEED, START, STYLES, Stretch, Term, build
from raycert.cases.families.shots import Flags, Shot, decades, is_double
from raycert.cases.families.sketch import (
    MAKE,
    Pairs,
    Shape,
    ball,
    below,
    layer,
    moved,
    near,
    pair,
    pipe,
    plus,
    rod,
    ten,
    times,
    touch,
    two,
)
from raycert.cases.families.touch import CONTACTS
from raycert.cases.formats import BINARY64, Format
from raycert.cases.model import SOLIDS, Vector
from raycert.cases.recipes import LEAVES, TREES, Aim, LeafRecipe, Pool, Recipe, Spot, TreeRecipe

T = TypeVar("T")
CHORDS = (*CONTACTS, *((y, x, radius) for x, y, radius in CONTACTS), (0, 3, 3))
"""How far off the axis, half a chord, the radius."""


@dataclass(frozen=True, slots=True)
class Draw:
    """The dice of one case, and the format it is for."""

    dice: Dice
    fmt: Format

    def whole(self, low: int, high: int) -> int:
        return self.dice.integer(low, high)

    def pick(self, items: Sequence[T]) -> T:
        return items[self.whole(0, len(items) - 1)]

    def chance(self, times: int, of: int) -> bool:
        """Whether a draw with the chance times / of comes out."""
        return self.whole(1, of) <= times

    def sign(self) -> int:
        return self.pick((1, -1))

    def large(self) -> Fraction:
        """Return a number of 10 to 10^13, or to 10^6 in binary32."""
        return self.whole(10, 99) * ten(self.pick(decades(self.fmt)) - 1)

    def small(self) -> Fraction:
        """Return a number of the format, of 1/10 to 1e-13, or to 1e-7 in binary32."""
        return near(self.fmt, self.whole(10, 99) * ten(-self.pick(decades(self.fmt)) - 2))

    def gap(self) -> Fraction:
        """Return 2^-k that 1 - 2^-k and 32 + 2^-k can hold."""
        return two(-self.whole(2, self.fmt.precision - 6))

    def frame(self) -> Frame:
        """Return a frame along the coordinate axes, or an oblique one."""
        return self.pick(self.pick((ALIGNED, OBLIQUE)))


def _shot(
    draw: Draw,
    noun: str,
    shape: Shape,
    target: Exact,
    direction: Exact,
    known: Pairs | None = None,
    *flags: str,
) -> Shot:
    return Shot("", noun, shape, target, direction, known, draw.frame(), flags)


def any_shot(draw: Draw) -> Shot:
    """Return a ray through a leaf of any type, a cylinder more often, aimed from its middle."""
    y, half, radius = draw.pick(CHORDS)
    y, climb = y * draw.sign(), draw.whole(-radius, radius)
    low, high, within = (0, 0, -2 * radius), (0, 0, 2 * radius), pair(-1, 1)
    target, slope = (0, y, 0), (half, 0, climb)
    match draw.whole(0, 7):
        case 0 | 1 | 2:
            return _shot(draw, "a cylinder", rod(low, high, radius), target, slope, within)
        case 3 | 4:
            tube = pipe(low, high, radius)
            return _shot(draw, "an infinite cylinder", tube, target, slope, within)
        case 5 | 6:
            return _shot(draw, "a sphere", ball(radius), target, (half, 0, 0), within)
    slope = (draw.whole(-9, 9), draw.whole(-9, 9), -radius)
    if draw.whole(0, 1):
        slab = layer((0, 0, -radius), (0, 0, radius))
        return _shot(draw, "a slab", slab, (y, half, 0), slope, within)
    plane = below((0, 0, 0), (0, 0, draw.whole(1, 9)))
    return _shot(draw, "a half-space", plane, (y, half, 0), slope, pair(0, None))


def _faces(shot: Shot) -> list[Number]:
    """Return the t at which an aim is on a face, counted from its target."""
    return [t for ends in shot.known or () for t in ends if t is not None]


def _framed(shot: Shot) -> Frame:
    assert isinstance(shot.frame, Frame)
    return shot.frame


def _far(draw: Draw) -> Shot:
    return any_shot(draw).back(draw.large())


def _displaced(draw: Draw) -> Shot:
    shot, shift = any_shot(draw), (draw.sign() * draw.large(), draw.large(), -draw.large())
    return shot.back(draw.whole(2, 9)).but(frame=_framed(shot).moved(shift))


def _start(draw: Draw) -> Shot:
    """Return a start inside, on a face, or a small step beside it."""
    shot, step = any_shot(draw), draw.sign() * draw.gap()
    face = draw.pick(_faces(shot))
    starts = ((-face, "on-surface"), (step - face, "near-surface"), (step, "inside"))
    back, where = draw.pick(starts)
    return shot.back(back).but(flags=(f"start-{where}",))


def _behind(draw: Draw) -> Shot:
    past = draw.pick((Fraction(draw.whole(2, 9)), draw.large(), 1 + draw.gap()))
    return any_shot(draw).back(-past)


def _speed(draw: Draw) -> Shot:
    factor = two(draw.sign() * draw.whole(8, 40 if is_double(draw.fmt) else 12))
    return any_shot(draw).back(draw.whole(-1, 9)).faster(factor)


def _size(draw: Draw) -> Shot:
    factor = two(draw.sign() * draw.whole(8, 100 if is_double(draw.fmt) else 15))
    return any_shot(draw).back(draw.whole(-1, 9)).larger(factor)


def _thin(draw: Draw) -> Shot:
    """Return a needle crossed, or a disk met through both caps."""
    y, half, radius = draw.pick(CHORDS)
    long, within = draw.large() * radius, pair(-1, 1)
    if draw.whole(0, 1):
        body, slope = rod((0, 0, -long), (0, 0, long), radius), (half, 0, draw.whole(-9, 9))
        shot = _shot(draw, "a needle", body, (0, y, 0), slope, within, "needle")
    else:
        body, slope = rod((0, 0, -1), (0, 0, 1), long), (draw.whole(-5, 5), 2, draw.sign())
        shot = _shot(draw, "a disk", body, (draw.whole(-4, 4), 1, 0), slope, within, "disk")
    return shot.back(draw.whole(0, 9)).larger(two(-draw.whole(0, 30)))


def _tilt(draw: Draw) -> Shot:
    """Return a ray almost along the axis, from inside, or from beside the wall."""
    lean, height = draw.small(), draw.pick((Fraction(8), draw.large()))
    beside = draw.pick((Fraction(-1) - draw.gap(), Fraction(-1), Fraction(draw.whole(-7, 7), 8)))
    enter, leave = (-1 - beside) / lean, (1 - beside) / lean
    make = draw.pick((rod, pipe))
    top = leave if make is pipe else min(leave, height)
    known = pair(enter, top) if enter <= top else None
    body = make((0, 0, -8), (0, 0, height), 1)
    shot = _shot(draw, "a cylinder", body, (beside, 0, 0), (lean, 0, 1), known)
    return shot.back(0).but(frame=UPRIGHT)


def _level(draw: Draw) -> Shot:
    """Return a ray almost level with a plane, or with two."""
    lean, side = draw.sign() * draw.small(), Fraction(draw.whole(-24, 24), 8)
    two_planes, one = layer((0, 0, -1), (0, 0, 1)), below((0, 0, 0), (0, 0, draw.whole(1, 9)))
    caps = rod((0, 0, -1), (0, 0, 1), draw.pick((Fraction(3), draw.large())))
    shape = draw.pick((two_planes, one, caps))
    slope = (draw.whole(1, 9), draw.whole(-9, 9), lean)
    return _shot(draw, "planes", shape, (0, 0, side), slope).back(draw.whole(0, 2))


def _contact(draw: Draw) -> Shot:
    """Return a ray from where it touches a cylinder or a sphere."""
    x, y, radius = draw.pick(CHORDS)
    low, high = (0, 0, -2 * radius), (0, 0, 2 * radius)
    touched: list[tuple[str, Shape]] = [
        ("a cylinder", rod(low, high, radius)),
        ("an infinite cylinder", pipe(low, high, radius)),
        ("a sphere", ball(radius)),
    ]
    turn, (noun, shape) = draw.sign(), draw.pick(touched)
    slope = (turn * y, -turn * x, draw.whole(-2, 2))
    return _shot(draw, noun, shape, (x, y, 0), slope, touch(0))


def _tangent(draw: Draw) -> Shot:
    back = draw.pick((Fraction(0), Fraction(draw.whole(1, 9)), draw.large()))
    return _contact(draw).back(back)


def _gap(draw: Draw) -> Shot:
    shot = _contact(draw)
    beside = times(1 + draw.sign() * draw.gap(), shot.origin)
    return shot.but(origin=beside, known=None).back(draw.whole(0, 9))


def _rim(draw: Draw) -> Shot:
    """Return a ray through a rim, or by a small gap beside it."""
    x, y, radius = draw.pick(CHORDS)
    gap, flag = draw.pick([(Fraction(0), "rim"), (draw.sign() * draw.gap(), "near-rim")])
    inward: Exact = (-x, -y, draw.whole(-radius, radius))
    slope = draw.pick([inward, (y, -x, 0), (0, 0, 1), (draw.whole(-9, 9), -y, draw.sign())])
    body = rod((0, 0, -4), (0, 0, 4), radius)
    shot = _shot(draw, "the rim of a cylinder", body, (x, y, 4 + gap), slope, None, flag)
    return shot.back(draw.whole(0, 3))


def _face(draw: Draw) -> Shot:
    """Return a ray in a wall, in a plane, or along the axis."""
    x, y, radius = draw.pick(CHORDS)
    base = 4 * draw.whole(-1, 1)
    body = draw.pick((rod, pipe))((0, 0, -4), (0, 0, 4), radius)
    lines: list[tuple[Shape, Exact, Exact]] = [
        (body, (x, y, base), (0, 0, draw.sign())),
        (body, (draw.whole(-1, 1), 0, base), (0, 0, draw.sign())),
        (body, (x, y, base), (-1, draw.whole(-3, 3), 0)),
        (layer((0, 0, -4), (0, 0, 4)), (x, y, base), (1, draw.whole(-3, 3), 0)),
        (below((0, 0, 0), (0, 0, 2)), (x, y, base), (1, draw.whole(-3, 3), 0)),
    ]
    return _shot(draw, "a face", *draw.pick(lines)).back(draw.whole(0, 9))


def _rest(draw: Draw) -> Shot:
    shot = any_shot(draw)
    ends = _faces(shot)
    at = plus(shot.origin, shot.direction, draw.pick((*ends, *ends, Fraction(1, 2), 2, -2)))
    return shot.but(origin=at, direction=(0, 0, 0), known=None)


def _stretch(draw: Draw) -> Stretch:
    a = Fraction(draw.whole(0, 12), 2)
    b = draw.pick((a, None, *(a + Fraction(draw.whole(1, 12), 2) for _ in range(10))))
    return (a, b)


def _term(draw: Draw, depth: int) -> Term | Stretch:
    """Return a Boolean of stretches of one ray, whose ends coincide more often than not."""
    if not depth:
        return _stretch(draw)
    count = draw.whole(2, 3)
    parts = tuple(_term(draw, min(draw.whole(0, 2), depth - 1)) for _ in range(count))
    return Term(draw.pick(tuple(MAKE)), parts)


def _boolean(draw: Draw) -> Shot:
    """Return a Boolean met at known places, near or far, in its size or another."""
    _, ways = draw.pick(list(STYLES.values()))
    shape = build(_term(draw, 2), ways, draw.dice)
    later = draw.pick((*map(Fraction, (0, 0, 1)), draw.large()))
    size = draw.pick((Fraction(1), two(draw.whole(-15, 15))))
    shape = moved(shape, (SPEED * later, 0, 0))
    return _shot(draw, "a Boolean of stretches", shape, START, AHEAD).larger(size)


_BOOLEAN = ("boolean", "meets", ("coincident-faces",), _boolean)
LADDERS: tuple[tuple[str, str, Flags, Callable[[Draw], Shot]], ...] = (
    ("far", "comes from afar to", ("far",), _far),
    _BOOLEAN,
    ("tangent", "touches", ("tangent",), _tangent),
    ("gap", "almost touches", ("near-tangent",), _gap),
    ("displaced", "far from the coordinate origin meets", ("displaced",), _displaced),
    ("start", "starts in or at", (), _start),
    _BOOLEAN,
    ("behind", "has left behind", ("behind",), _behind),
    ("rim", "passes through or by", (), _rim),
    ("tilt", "runs almost along", ("near-parallel",), _tilt),
    ("level", "is almost level with", ("near-parallel",), _level),
    _BOOLEAN,
    ("thin", "meets", (), _thin),
    ("face", "runs in or along", ("parallel",), _face),
    ("rest", "with no direction rests in or by", ("zero-direction",), _rest),
    _BOOLEAN,
    ("speed", "very slow or very fast meets", ("direction-scale",), _speed),
    ("size", "meets, very small or large,", ("scene-scale",), _size),
)
"""The ladders by turns: a name, what the ray does, flags, and the draw of a shot."""


def jittered(seed: int, number: int, fmt: Format) -> Case:
    """Return a step of a ladder; every ladder has its turn."""
    name, does, flags, ladder = LADDERS[number % len(LADDERS)]
    shot = ladder(Draw(Dice(f"jitter {seed} {number} {fmt.name}"), fmt))
    case = shot.named(f"{name}-{number}", f"A ray {does} {{}}", *flags).case(fmt, _framed(shot))
    return replace(case, tier="stiff")


PARTS = (*LEAVES, "sphere", "infinite_cylinder", "cylinder")
"""What the parts of a tree are drawn from."""


def fresh(count: int, seed: int) -> Iterator[Case]:
    """Yield `count` sampled cases of a seed; a larger count begins with the same cases."""
    for number in range(count):
        yield sampled(number, seed)


def sampled(number: int, seed: int, fmt: Format = BINARY64) -> Case:
    """Return a scene of parts that share points, axes and radii; every type has its turn."""
    draw = Draw(Dice(f"sample {seed} {number} {fmt.name}"), fmt)
    parts = _Parts(draw, lattice=draw.chance(3, 4))
    pool = parts.pool()
    kind = (*LEAVES, *TREES)[number % len(SOLIDS)]
    solid = recipes.make_solid(parts.leaf(kind) if kind in LEAVES else parts.tree(kind, 3), pool)
    ray = recipes.make_ray((solid,), parts.aim(), pool)
    why = f"Case {number} of the sample with seed {seed}, a {kind.replace('_', ' ')}."
    return Case(f"{seed}-{number}", why, solid, ray, "generic")


@dataclass(frozen=True, slots=True)
class _Parts:
    """Draws the parts of a scene: on the lattice, or with all bits random."""

    draw: Draw
    lattice: bool

    def point(self) -> Vector:
        if not self.lattice:
            return self.draw.dice.vector(self.draw.fmt, -4, 4)
        x, y, z = (float(self.draw.whole(-4, 4)) for _ in range(3))
        return (x, y, z)

    def direction(self) -> Vector:
        if self.lattice and self.draw.chance(3, 4):
            return self.draw.pick(recipes.DIRECTIONS)
        vector = self.point()
        return vector if any(vector) else recipes.UNITS[2]

    def radius(self) -> float:
        if self.lattice:
            return self.draw.pick(recipes.RADII)
        return self.draw.dice.real(self.draw.fmt, 0.01, 4)

    def pool(self) -> Pool:
        points = (self.point(), self.point())
        axes = [(self.point(), self.direction()) for _ in range(2)]
        return Pool.of(points, axes, (self.radius(), self.radius()), self.draw.fmt)

    def own(self, make: Callable[[], T], own: int) -> int | T:
        """Return a pick from the pool, or in `own` cases of four a value of its own."""
        return make() if self.draw.chance(own, 4) else self.draw.pick(recipes.PICKS)

    def leaf(self, kind: str) -> LeafRecipe:
        axis = self.own(lambda: (self.point(), self.direction()), 1)
        return LeafRecipe(kind, axis, self.own(self.point, 1), self.own(self.radius, 2))

    def tree(self, kind: str, depth: int) -> TreeRecipe:
        """Return a Boolean, now and then of parts that are alike, or the same."""
        if self.draw.chance(1, 4):
            leaf, pick = self.leaf(self.draw.pick(PARTS)), self.draw.pick(recipes.PICKS)
            return TreeRecipe(kind, recipes.alike(leaf, pick, self.draw.pick(recipes.NESTED)))
        parts: list[Recipe] = []
        for _ in range(self.draw.pick((2, 2, 3, 2, 3, 4, 2, 1))):
            if parts and self.draw.chance(1, 10):
                parts.append(parts[0])
            elif depth > 1 and self.draw.chance(1, 3):
                parts.append(self.tree(self.draw.pick(TREES), depth - 1))
            else:
                parts.append(self.leaf(self.draw.pick(PARTS)))
        return TreeRecipe(kind, parts)

    def spot(self) -> Spot:
        leaf, frame = self.draw.whole(0, 11), self.draw.whole(0, 11)
        return Spot(leaf, frame, self.draw.pick(recipes.ALONG), self.draw.pick(recipes.AWAY))

    def aim(self) -> Aim:
        free = None
        if self.draw.chance(1, 6):
            still = self.draw.chance(1, 5)
            free = (self.own(self.point, 2), recipes.STILL if still else self.direction())
        return Aim(
            spot=self.spot(),
            turn=self.draw.pick(recipes.TURNS),
            toward=self.spot() if self.draw.chance(1, 3) else None,
            back=self.draw.pick(recipes.BACK),
            speed=self.draw.pick(recipes.SPEEDS),
            free=free,
            moved=self.draw.pick(recipes.MOVED),
        )
