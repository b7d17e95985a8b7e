"""A ray and the solids it meets: frozen data that refuse what they cannot mean.

What is refused is refused on construction, with `Refused`, which names the field by its path.
Any real number is taken where a number is: a float, an int or a `Fraction` (rounded to nearest), a
scalar of NumPy or an array of no dimension; and a list, a tuple or an array of three where a vector
is. Not a bool, a string, or a `Decimal`, which Python does not count among the real numbers. What
is held is always a float, or a tuple of three.

What a field of a leaf is, a place, a direction or a length, is its annotation; `SHAPES` and the
functions of leaves below are read off it, so that a new leaf has them by being declared.
Nothing else here computes geometry.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, fields
from numbers import Real
from typing import NamedTuple

from raycert.cases.vectors import minus

Vector = tuple[float, float, float]
Point = Vector
"""A field that is a place: it moves, turns and grows with the scene."""
Direction = Vector
"""A field that is a direction: it turns with the scene, and its length means nothing to a leaf."""
Length = float
"""A field that is a length, >= 0: it grows with the scene."""


class Refused(ValueError):
    """An input outside the contract: `path` names the field, `reason` says what is wrong."""

    def __init__(self, path: str, reason: str) -> None:
        super().__init__(f"{_shown(path)}: {reason}" if path else reason)
        self.path = path
        self.reason = reason

    def under(self, parent: str) -> Refused:
        """Return the same refusal, seen from the object that holds the field as `parent`."""
        joined = f"{parent}.{self.path}" if self.path else parent
        return Refused(joined, self.reason)


def _shown(path: str) -> str:
    """Return a path as a person can read it: of a very deep one, both ends; escapes spelled."""
    path = path if path.isprintable() else repr(path)[1:-1]
    return path if len(path) <= 200 else f"{path[:90]} ... {path[-90:]}"


def real(value: object, path: str) -> float:
    """Return `value` as a finite binary64, or refuse it. What is between two rounds to nearest."""
    if type(value) is not float:
        plain = getattr(value, "item", None)
        if plain is not None and getattr(value, "shape", None) == ():  # NumPy's, of no dimension
            value = plain()
        if isinstance(value, bool) or not isinstance(value, Real):
            raise Refused(path, f"is not a number: {value!r:.40}")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise Refused(path, "is NaN" if math.isnan(number) else "is infinite or beyond binary64")
    return number


def vector(value: object, path: str) -> Vector:
    """Return `value` as three finite numbers, or refuse it."""
    if not isinstance(value, list | tuple):
        if not getattr(value, "shape", None) or not isinstance(value, Iterable):
            raise Refused(path, f"is not a list of three numbers: {value!r:.40}")
        value = list(value)
    if len(value) != 3:
        raise Refused(path, f"has {len(value)} numbers, not three")
    x, y, z = (real(item, f"{path}[{i}]") for i, item in enumerate(value))
    return (x, y, z)


def _length(value: object, path: str) -> float:
    number = real(value, path)
    if number < 0:
        raise Refused(path, f"is negative: {number!r}")
    return number


_READ: dict[str, Callable[[object, str], object]] = {
    "Point": vector,
    "Direction": vector,
    "Length": _length,
}


class _Checked:
    """Stores the fields of a ray or a leaf as what they are declared to be, or refuses one."""

    __slots__ = ()

    def __post_init__(self) -> None:
        for name, read in _READERS[type(self)]:  # past the `__setattr__` of a frozen class
            object.__setattr__(self, name, read(getattr(self, name), name))


class _Axial(_Checked):
    """A leaf whose axis runs from p to q: refuses p = q."""

    __slots__ = ()
    p: Point
    q: Point

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.p == self.q:
            raise Refused("q", "is the same point as p: the axis has no direction")


@dataclass(frozen=True, slots=True)
class Ray(_Checked):
    """f(t) = origin + t * direction, t >= 0. The zero direction stays at its origin.

    >>> Ray(origin=(-3, 0, 1), direction=(1, 0, 0))
    Ray(origin=(-3.0, 0.0, 1.0), direction=(1.0, 0.0, 0.0))
    """

    origin: Point
    direction: Direction


@dataclass(frozen=True, slots=True)
class HalfSpace(_Checked):
    """(x - point) . normal <= 0, with the outward normal of any length but zero.

    >>> HalfSpace(point=(0, 0, 1), normal=(0, 0, 2))
    HalfSpace(point=(0.0, 0.0, 1.0), normal=(0.0, 0.0, 2.0))
    """

    point: Point
    normal: Direction

    def __post_init__(self) -> None:
        _Checked.__post_init__(self)
        if not any(self.normal):
            raise Refused("normal", "is zero")


@dataclass(frozen=True, slots=True)
class Sphere(_Checked):
    """|x - center| <= radius.

    >>> Sphere(center=(0, 0, 0), radius=-1)
    Traceback (most recent call last):
    ...
    raycert.cases.model.Refused: radius: is negative: -1.0
    """

    center: Point
    radius: Length


@dataclass(frozen=True, slots=True)
class InfiniteCylinder(_Axial):
    """Distance from the line through p and q <= radius.

    >>> InfiniteCylinder(p=(0, 0, 0), q=(0, 0, 1), radius=2).radius
    2.0
    """

    p: Point
    q: Point
    radius: Length


@dataclass(frozen=True, slots=True)
class Slab(_Axial):
    """Between the two planes through p and q square to pq.

    >>> Slab(p=(0, 0, 0), q=(0, 0, 0))
    Traceback (most recent call last):
    ...
    raycert.cases.model.Refused: q: is the same point as p: the axis has no direction
    """

    p: Point
    q: Point


@dataclass(frozen=True, slots=True)
class Cylinder(_Axial):
    """In the infinite cylinder and in the slab of the same p and q.

    >>> Cylinder(p=[0, 0, 0], q=[0, 0, 2], radius=1).q
    (0.0, 0.0, 2.0)
    """

    p: Point
    q: Point
    radius: Length


@dataclass(frozen=True, slots=True)
class _Boolean:
    of: tuple[Solid, ...]

    def __post_init__(self) -> None:
        if not isinstance(self.of, list | tuple) or not self.of:
            raise Refused("of", "is not a list of one or more solids")
        for i, part in enumerate(self.of):
            if not isinstance(part, Solid):
                raise Refused(f"of[{i}]", f"is not a solid: {part!r:.40}")
        object.__setattr__(self, "of", tuple(self.of))


@dataclass(frozen=True, slots=True)
class Union(_Boolean):
    """In any part.

    >>> len(Union([Sphere((0, 0, 0), 1), Sphere((1, 0, 0), 1)]).of)
    2
    """


@dataclass(frozen=True, slots=True)
class Intersection(_Boolean):
    """In every part.

    >>> Intersection([])
    Traceback (most recent call last):
    ...
    raycert.cases.model.Refused: of: is not a list of one or more solids
    """


@dataclass(frozen=True, slots=True)
class Difference(_Boolean):
    """In the first part, less all the others; closed again along the ray.

    >>> shell = Difference([Sphere((0, 0, 0), 2), Sphere((0, 0, 0), 1)])
    >>> [part.radius for part in shell.of]
    [2.0, 1.0]
    """


Leaf = HalfSpace | Sphere | InfiniteCylinder | Slab | Cylinder
Tree = Union | Intersection | Difference
Solid = Leaf | Tree

SOLIDS: dict[str, type[Solid]] = {
    "half_space": HalfSpace,
    "sphere": Sphere,
    "infinite_cylinder": InfiniteCylinder,
    "slab": Slab,
    "cylinder": Cylinder,
    "union": Union,
    "intersection": Intersection,
    "difference": Difference,
}
TYPE_NAMES: dict[type[Solid], str] = {kind: name for name, kind in SOLIDS.items()}


LEAVES: tuple[type[Leaf], ...] = Leaf.__args__
FIELDS: dict[type[Leaf], tuple[str, ...]] = {
    kind: tuple(field.name for field in fields(kind)) for kind in LEAVES
}
"""Of each type of leaf its fields in order, each a vector or a length."""


class Shape(NamedTuple):
    """What the fields of a type of leaf are, in the order of their declaration."""

    points: tuple[str, ...]
    directions: tuple[str, ...]
    lengths: tuple[str, ...]

    @classmethod
    def of(cls, kind: type[Leaf]) -> Shape:
        named = [(field.name, field.type) for field in fields(kind)]
        return cls(*(tuple(n for n, sort in named if sort == each) for each in _READ))


SHAPES: dict[type[Leaf], Shape] = {kind: Shape.of(kind) for kind in LEAVES}
VECTORS = frozenset(
    field.name for kind in (Ray, *LEAVES) for field in fields(kind) if field.type != "Length"
)
"""The fields of rays and leaves that are three numbers."""
_READERS: dict[type, list[tuple[str, Callable[[object, str], object]]]] = {
    kind: [(field.name, _READ[str(field.type)]) for field in fields(kind)]
    for kind in (Ray, *LEAVES)
}


def points(leaf: Leaf) -> tuple[Point, ...]:
    """Return the places by which a leaf is given; the first is where it stands."""
    return tuple([getattr(leaf, name) for name in SHAPES[type(leaf)].points])


def radius(leaf: Leaf, otherwise: float = 0.0) -> float:
    """Return the radius of a leaf; `otherwise` for one that has none."""
    names = SHAPES[type(leaf)].lengths
    return getattr(leaf, names[0]) if names else otherwise


def lengths(leaf: Leaf) -> list[float]:
    """Return the numbers of a leaf that grow with the scene: of its places, then its lengths."""
    shape = SHAPES[type(leaf)]
    numbers = [x for name in shape.points for x in getattr(leaf, name)]
    return numbers + [getattr(leaf, name) for name in shape.lengths]


def axis(leaf: Leaf) -> Vector | None:
    """Return the direction that a leaf has, q - p or its normal, in doubles; None if it has none.

    >>> axis(Cylinder((0, 0, 1), (0, 0, 3), 1)), axis(Sphere((0, 0, 0), 1))
    ((0.0, 0.0, 2.0), None)
    """
    directions, ends = SHAPES[type(leaf)].directions, points(leaf)
    if directions:
        own: Vector = getattr(leaf, directions[0])
        return own
    return minus(ends[1], ends[0]) if len(ends) > 1 else None


def type_of(solid: Solid) -> str:
    """Return the JSON type name of a solid: `cylinder`, `union`, ..."""
    return TYPE_NAMES[type(solid)]


def parts(solid: Solid) -> tuple[Solid, ...]:
    """Return the parts of a tree; a leaf has none."""
    return solid.of if isinstance(solid, Tree) else ()


def nodes(solid: Solid) -> Iterator[Solid]:
    """Yield a solid and all that it is made of, each before its parts."""
    yield solid
    for part in parts(solid):
        yield from nodes(part)


def types(solid: Solid) -> set[str]:
    """Return the type names of a solid and of all that it is made of."""
    return {type_of(node) for node in nodes(solid)}


def map_leaves(change: Callable[[Leaf], Leaf], solid: Solid) -> Solid:
    """Return the same tree with each leaf replaced by what `change` makes of it."""
    if isinstance(solid, Tree):
        return type(solid)(tuple(map_leaves(change, part) for part in solid.of))
    return change(solid)


def leaves(solid: Solid, path: str = "") -> Iterator[tuple[str, Leaf]]:
    """Yield (path, leaf) in order; a path reads `of[1].of[0]`, and is empty for a lone leaf."""
    if isinstance(solid, Tree):
        for i, part in enumerate(solid.of):
            yield from leaves(part, f"{path}.of[{i}]" if path else f"of[{i}]")
    else:
        yield path, solid
