"""Sketches: a solid and a ray in exact numbers, and the case that they become.

In a sketch the axis lies along z. Of a cylinder or slab, p is the lower end. Of a half-space, p
is the point and q - p the outward normal.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from raycert.cases.case import Case, KnownEnd, Tier
from raycert.cases.families.frames import UPRIGHT, Exact, Frame, Number
from raycert.cases.formats import Format
from raycert.cases.lattice import is_lattice
from raycert.cases.model import Cylinder, HalfSpace, InfiniteCylinder, Ray, Slab, Solid, Vector

Pairs = tuple[tuple[KnownEnd, KnownEnd], ...]
MISS: Pairs = ()
ALWAYS: Pairs = ((0, None),)


@dataclass(frozen=True, slots=True)
class Body:
    """A solid in exact numbers. `kind` is its JSON type name, `noun` what a sentence calls it."""

    kind: str
    p: Exact
    q: Exact
    radius: Number = 0

    @property
    def noun(self) -> str:
        """Return the word for it in a sentence."""
        return NOUNS[self.kind]

    @property
    def word(self) -> str:
        """Return the word for it in a slug."""
        return self.kind.replace("_", "-")


NOUNS = {
    "half_space": "a half-space",
    "slab": "a slab",
    "infinite_cylinder": "an infinite cylinder",
    "cylinder": "a cylinder",
}


def cylinder(radius: Number, height: Number, base: Number = 0) -> Body:
    """Return the capped cylinder about z from z = base up."""
    return Body("cylinder", (0, 0, base), (0, 0, base + height), radius)


def tube(radius: Number, height: Number = 8, base: Number = 0) -> Body:
    """Return the infinite cylinder about z, its p and q `height` apart."""
    return Body("infinite_cylinder", (0, 0, base), (0, 0, base + height), radius)


def slab(height: Number, base: Number = 0) -> Body:
    """Return the slab from z = base up."""
    return Body("slab", (0, 0, base), (0, 0, base + height))


def half_space(level: Number = 0, normal: Number = 1) -> Body:
    """Return the half-space below z = level, with a normal of this length."""
    return Body("half_space", (0, 0, level), (0, 0, level + normal))


def near(fmt: Format, number: Number) -> Fraction:
    """Return the number of the format nearest to `number`."""
    return Fraction(fmt.nearest(float(Fraction(number))))


def two(exponent: int) -> Fraction:
    """Return 2^exponent."""
    return Fraction(2) ** exponent


def ten(exponent: int) -> Fraction:
    """Return 10^exponent."""
    return Fraction(10) ** exponent


def plus(a: Exact, b: Exact, times: Number = 1) -> Exact:
    """Return a + times b."""
    return (a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2])


def times(factor: Number, a: Exact) -> Exact:
    """Return factor a."""
    return (factor * a[0], factor * a[1], factor * a[2])


def pair(enter: Number, leave: Number | None) -> Pairs:
    """Return the list of one known interval."""
    return ((Fraction(enter), leave if leave is None else Fraction(leave)),)


def touch(t: Number) -> Pairs:
    """Return the list of one known touch."""
    return pair(t, t)


def between(start: Number, speed: Number, low: Number, high: Number) -> Pairs:
    """Return where low <= start + speed t <= high, for t >= 0."""
    if speed == 0:
        return ALWAYS if low <= start <= high else MISS
    one, other = Fraction(low - start) / speed, Fraction(high - start) / speed
    enter, leave = max(min(one, other), Fraction(0)), max(one, other)
    return pair(enter, leave) if leave >= 0 else MISS


def row(
    fmt: Format,
    slug: str,
    why: str,
    body: Body,
    origin: Exact,
    direction: Exact,
    *,
    frame: Frame = UPRIGHT,
    tier: Tier = "generic",
    flags: tuple[str, ...] = (),
    known: Pairs | None = None,
    source: str = "",
) -> Case:
    """Return the case of a sketch put in a frame.

    `why` comes without its full stop. A named frame is added to slug and sentence. Numbers that
    the format cannot hold are rounded, and `known` is then dropped: it was the answer of another
    scene. `tier` is for a case off the lattice.
    """
    pen = LeafPen(fmt)
    solid = pen.solid(body, frame)
    ray = Ray(pen.vector(frame.point(origin)), pen.vector(frame.vector(direction)))
    if not pen.exact:
        known = None
    return Case(
        slug=f"{slug}-{frame.name}" if frame.name else slug,
        why=f"{why}, {frame.text}." if frame.text else f"{why}.",
        solid=solid,
        ray=ray,
        tier="lattice" if tier != "range" and is_lattice(solid, ray) else tier,
        flags=flags,
        source=source or ("oracle" if known is None else "construction"),
        known=known,
    )


class LeafPen:
    """Writes exact numbers as numbers of a format, and remembers whether that changed any."""

    def __init__(self, fmt: Format) -> None:
        self.fmt = fmt
        self.exact = True

    def real(self, number: Number) -> float:
        """Return the nearest number of the format."""
        written = self.fmt.nearest(float(Fraction(number)))
        self.exact = self.exact and Fraction(written) == number
        return written

    def vector(self, vector: Exact) -> Vector:
        """Return the nearest vector of the format."""
        x, y, z = vector
        return (self.real(x), self.real(y), self.real(z))

    def solid(self, body: Body, frame: Frame) -> Solid:
        """Return a sketched body as it stands in a frame."""
        p = self.vector(frame.point(body.p))
        if body.kind == "half_space":
            return HalfSpace(p, self.vector(frame.vector(plus(body.q, body.p, -1))))
        q = self.vector(frame.point(body.q))
        match body.kind:
            case "slab":
                return Slab(p, q)
            case "infinite_cylinder":
                return InfiniteCylinder(p, q, self.real(frame.stretch * body.radius))
            case _:
                return Cylinder(p, q, self.real(frame.stretch * body.radius))
