"""A ray and the solids it meets: frozen data that refuse what they cannot mean.

What is refused is refused on construction, with `Refused`, which names the field by its path.
Nothing here computes geometry.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields

Vector = tuple[float, float, float]


class Refused(ValueError):
    """An input outside the contract: `path` names the field, `reason` says what is wrong."""

    def __init__(self, path: str, reason: str) -> None:
        """Join path and reason into the message a person reads."""
        super().__init__(f"{_shown(path)}: {reason}" if path else reason)
        self.path = path
        self.reason = reason

    def under(self, parent: str) -> Refused:
        """Return the same refusal, seen from the object that holds the field as `parent`."""
        joined = f"{parent}.{self.path}" if self.path else parent
        return Refused(joined, self.reason)


def _shown(path: str) -> str:
    """Return a path as a person can read it: of a very deep one, both ends."""
    return path if len(path) <= 200 else f"{path[:90]} ... {path[-90:]}"


def real(value: object, path: str) -> float:
    """Return `value` as a finite binary64, or refuse it. Integers round to nearest."""
    if isinstance(value, bool) or not isinstance(value, int | float):
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
        raise Refused(path, f"is not a list of three numbers: {value!r:.40}")
    if len(value) != 3:
        raise Refused(path, f"has {len(value)} numbers, not three")
    x, y, z = (real(item, f"{path}[{i}]") for i, item in enumerate(value))
    return (x, y, z)


def _radius(value: object) -> float:
    number = real(value, "radius")
    if number < 0:
        raise Refused("radius", f"is negative: {number!r}")
    return number


def _set(target: object, **fields: object) -> None:
    """Store checked fields in a frozen instance."""
    for name, value in fields.items():
        object.__setattr__(target, name, value)


def _axis(solid: Slab | InfiniteCylinder | Cylinder) -> None:
    p, q = vector(solid.p, "p"), vector(solid.q, "q")
    if p == q:
        raise Refused("q", "is the same point as p: the axis has no direction")
    _set(solid, p=p, q=q)


@dataclass(frozen=True, slots=True)
class Ray:
    """f(t) = origin + t * direction, t >= 0. The zero direction stays at its origin."""

    origin: Vector
    direction: Vector

    def __post_init__(self) -> None:
        """Refuse what is not two vectors of finite numbers."""
        _set(
            self,
            origin=vector(self.origin, "origin"),
            direction=vector(self.direction, "direction"),
        )


@dataclass(frozen=True, slots=True)
class HalfSpace:
    """(x - point) . normal <= 0, with the outward normal of any length but zero."""

    point: Vector
    normal: Vector

    def __post_init__(self) -> None:
        """Refuse a zero normal."""
        point, normal = vector(self.point, "point"), vector(self.normal, "normal")
        if normal == (0, 0, 0):
            raise Refused("normal", "is zero")
        _set(self, point=point, normal=normal)


@dataclass(frozen=True, slots=True)
class Sphere:
    """|x - center| <= radius."""

    center: Vector
    radius: float

    def __post_init__(self) -> None:
        """Refuse a negative radius."""
        _set(self, center=vector(self.center, "center"), radius=_radius(self.radius))


@dataclass(frozen=True, slots=True)
class InfiniteCylinder:
    """Distance from the line through p and q <= radius."""

    p: Vector
    q: Vector
    radius: float

    def __post_init__(self) -> None:
        """Refuse p = q and a negative radius."""
        _axis(self)
        _set(self, radius=_radius(self.radius))


@dataclass(frozen=True, slots=True)
class Slab:
    """Between the two planes through p and q square to pq."""

    p: Vector
    q: Vector

    def __post_init__(self) -> None:
        """Refuse p = q."""
        _axis(self)


@dataclass(frozen=True, slots=True)
class Cylinder:
    """In the infinite cylinder and in the slab of the same p and q."""

    p: Vector
    q: Vector
    radius: float

    def __post_init__(self) -> None:
        """Refuse p = q and a negative radius."""
        _axis(self)
        _set(self, radius=_radius(self.radius))


def _parts(tree: Union | Intersection | Difference) -> None:
    if not isinstance(tree.of, list | tuple) or not tree.of:
        raise Refused("of", "is not a list of one or more solids")
    for i, part in enumerate(tree.of):
        if not isinstance(part, Solid):
            raise Refused(f"of[{i}]", f"is not a solid: {part!r:.40}")
    _set(tree, of=tuple(tree.of))


@dataclass(frozen=True, slots=True)
class Union:
    """In any part."""

    of: tuple[Solid, ...]

    def __post_init__(self) -> None:
        """Refuse an empty list of parts."""
        _parts(self)


@dataclass(frozen=True, slots=True)
class Intersection:
    """In every part."""

    of: tuple[Solid, ...]

    def __post_init__(self) -> None:
        """Refuse an empty list of parts."""
        _parts(self)


@dataclass(frozen=True, slots=True)
class Difference:
    """In the first part, less all the others; closed again along the ray."""

    of: tuple[Solid, ...]

    def __post_init__(self) -> None:
        """Refuse an empty list of parts."""
        _parts(self)


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


FIELDS: dict[type[Leaf], tuple[str, ...]] = {
    kind: tuple(field.name for field in fields(kind)) for kind in Leaf.__args__
}
"""Of each type of leaf its fields in order, each a vector or a length."""


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
