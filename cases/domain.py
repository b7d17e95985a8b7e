"""What an implementation is for: ranges of lengths, distances and shapes, measured from each case.

Of a case there are five quantities, each exact, over all leaves of the solid that have it:

    direction   N(direction)
    size        every radius and every thickness N(q - p); the least and the greatest
    distance    N(origin - p), to the center of a sphere, over the smallest size of the leaf
    offset      the largest coordinate of p, q or center over the smallest size of the leaf
    aspect      the largest size of the leaf over its smallest

with N the norm rounded up (`vectors.norm_up`), and exact where it is rational, so that a bound of 1
holds a unit vector along an axis. What is zero is no size and no direction: it is a
degenerate input, declared by its name. A half-space has no size, so nothing is in proportion to it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields
from fractions import Fraction
from math import inf, isqrt
from typing import Any, NamedTuple

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    Leaf,
    Ray,
    Refused,
    Slab,
    Solid,
    leaves,
    points,
    radius,
    real,
)
from raycert.cases.vectors import dot, minus, norm_up, times

Bound = float | None
Span = tuple[Bound, Bound]
FREE: Span = (None, None)


class Quantities(NamedTuple):
    """The quantities of a case; None where nothing has them. `size` is the least and the most."""

    direction: Fraction | None
    size: tuple[Fraction, Fraction] | None
    distance: Fraction | None
    offset: Fraction | None
    aspect: Fraction | None

    def spans(self) -> dict[str, tuple[Fraction, Fraction]]:
        """Return the least and the greatest of each quantity that there is."""
        values = {name: value for name, value in self._asdict().items() if value is not None}
        return {
            name: value if isinstance(value, tuple) else (value, value)
            for name, value in values.items()
        }


def quantities(solid: Solid, ray: Ray) -> Quantities:
    """Return the quantities of a case.

    >>> from raycert.cases.model import Sphere
    >>> q = quantities(Sphere((4, 0, 0), 2), Ray((4, 6, 0), (0, -1, 0)))
    >>> float(q.direction), float(q.distance), float(q.offset), float(q.aspect)
    (1.0, 3.0, 2.0, 1.0)
    """
    sized = [found for _, leaf in leaves(solid) if (found := _of_leaf(leaf, ray))]
    direction = _length(ray.direction) or None
    if not sized:
        return Quantities(direction, None, None, None, None)
    least, greatest, distance, offset, aspect = zip(*sized, strict=True)
    size = min(least), max(greatest)
    return Quantities(direction, size, max(distance), max(offset), max(aspect))


def _of_leaf(leaf: Leaf, ray: Ray) -> tuple[Fraction, ...] | None:
    """Return the least and greatest size of a leaf, its distance, offset and aspect."""
    sizes = [size for size in _sizes(leaf) if size]
    if not sizes:
        return None
    least, greatest, places = min(sizes), max(sizes), points(leaf)
    farthest = max(abs(Fraction(x)) for place in places for x in place)
    away = _length(ray.origin, places[0])
    return least, greatest, away / least, farthest / least, greatest / least


def _sizes(leaf: Leaf) -> Iterator[Fraction]:
    if isinstance(leaf, Slab | Cylinder):
        yield _length(leaf.q, leaf.p)
    if not isinstance(leaf, Slab | HalfSpace):
        yield Fraction(radius(leaf))


def _length(x: tuple[float, float, float], y: tuple[float, float, float] = (0, 0, 0)) -> Fraction:
    """Return |x - y|, exactly where it is rational, else N(x - y)."""
    ratios = [number.as_integer_ratio() for number in (*map(float, x), *map(float, y))]
    unit = max(bottom for _, bottom in ratios)
    a, b, c, d, e, f = (top * (unit // bottom) for top, bottom in ratios)
    apart = minus((a, b, c), (d, e, f))
    square = dot(apart, apart)
    length = isqrt(square)
    if length * length == square:
        return Fraction(length, unit)
    return Fraction(norm_up(times(1 << UNITS, apart)), unit << UNITS)


UNITS = 64
"""Bits below the grid of the numbers, on which N is an integer."""


@dataclass(frozen=True, slots=True)
class Domain:
    """For which quantities an implementation is; None is no bound.

    >>> Domain(size=(1e-4, 1e4), distance=1e6).words()
    'starts within 1e6 sizes, sizes 1e-4 to 1e4'
    """

    direction: Span = FREE
    size: Span = FREE
    distance: Bound = None
    offset: Bound = None
    aspect: Bound = None

    def __bool__(self) -> bool:
        """Whether anything is bounded."""
        return self != EVERYWHERE

    def bounds(self) -> Iterator[tuple[str, Bound, Bound]]:
        """Yield (name, low, high) of each quantity."""
        for name in QUANTITIES:
            value = getattr(self, name)
            yield (name, *(value if isinstance(value, tuple) else (None, value)))

    def holds(self, found: Quantities) -> bool:
        """Whether a case lies within all bounds; where it has no such quantity, it does."""
        spans = found.spans()
        return all(
            (low is None or spans[name][0] >= low) and (high is None or spans[name][1] <= high)
            for name, low, high in self.bounds()
            if name in spans
        )

    def words(self) -> str:
        """Return what it is for, as a person says it; empty where nothing is bounded."""
        said = {name: _words(name, low, high) for name, low, high in self.bounds()}
        return ", ".join(said[name] for name in WORDS if said[name])

    def form(self) -> dict[str, Any]:
        """Return the JSON object of a hello: what is bounded, and nothing else."""
        form: dict[str, Any] = {}
        for name, low, high in self.bounds():
            if low is not None or high is not None:
                form[name] = [low, high] if name in PAIRS else high
        return form


EVERYWHERE = Domain()
"""No bounds at all."""
QUANTITIES = tuple(field.name for field in fields(Domain))
PAIRS = ("direction", "size")
"""The quantities with a lower bound too."""
WORDS = {
    "distance": "starts {} sizes",
    "size": "sizes {}",
    "direction": "directions {} long",
    "offset": "coordinates {} sizes",
    "aspect": "aspects {}",
}
"""What each is called, the most telling first."""


def _words(name: str, low: Bound, high: Bound) -> str:
    if low is None and high is None:
        return ""
    if low is None:
        between = f"{'within' if name in ('distance', 'offset') else 'up to'} {short(high)}"
    else:
        between = f"from {short(low)}" if high is None else f"{short(low)} to {short(high)}"
    return WORDS[name].format(between)


def short(number: float | None) -> str:
    """Return a number as short as it can be read back.

    >>> short(1e6), short(0.25), short(2.0**40), short(1536.0), short(2.1e7), short(None)
    ('1e6', '0.25', '2^40', '1536', '2.1e7', 'any')
    """
    if number is None:
        return "any"
    exact = Fraction(number)
    two = exact.numerator.bit_length() - exact.denominator.bit_length()
    for digits in range(17):
        form, _, power = f"{number:.{digits}e}".partition("e")
        if float(f"{form}e{power}") == number:
            break
    if digits and number == 2.0**two and abs(two) > 10:
        return f"2^{two}"
    if -3 < int(power) < 4:
        return repr(number).removesuffix(".0")
    return f"{form}e{int(power)}"


def within(text: str, words: str) -> str:
    """Return a level, or what is said of one, with the words of the domain beside it.

    >>> within("stable and closed", "starts within 1e6 sizes")
    'stable and closed, for starts within 1e6 sizes'
    """
    return f"{text}, for {words}" if words else text


def joint(one: Domain, other: Domain) -> Domain:
    """Return the domain of what lies within both."""
    spans: dict[str, list[Bound]] = {}
    for name, low, high in (*one.bounds(), *other.bounds()):
        least, most = spans.get(name, (None, None))
        spans[name] = [_tighter(max, low, least), _tighter(min, high, most)]
    return Domain(**{name: tuple(x) if name in PAIRS else x[1] for name, x in spans.items()})  # type: ignore[arg-type]


def _tighter(of: Callable[[float, float], float], one: Bound, other: Bound) -> Bound:
    return one if other is None else other if one is None else of(one, other)


def read_domain(form: object, path: str = "domain") -> Domain:
    """Return the domain that a JSON object describes, or refuse it (`Refused`)."""
    if not isinstance(form, dict):
        raise Refused(path, f"is not an object of bounds: {form!r:.40}")
    for name in form:
        if name not in QUANTITIES:
            raise Refused(f"{path}.{name:.40}", f"is not a quantity ({', '.join(QUANTITIES)})")
    read: dict[str, Any] = {name: _read(name, x, f"{path}.{name}") for name, x in form.items()}
    return Domain(**read)


def _read(name: str, value: object, path: str) -> Span | Bound:
    if name not in PAIRS:
        return _bound(value, path)
    if not isinstance(value, list | tuple) or len(value) != 2:
        raise Refused(path, f"is not [low, high], either of which may be null: {value!r:.40}")
    low, high = (_bound(item, f"{path}[{i}]") for i, item in enumerate(value))
    if low is not None and high is not None and low > high:
        raise Refused(path, f"has its low bound above the high one: {value!r:.40}")
    return low, high


def _bound(value: object, path: str) -> Bound:
    if value is None:
        return None
    bound = real(value, path)
    if not 0 < bound < inf:
        raise Refused(path, f"is not a number > 0: {value!r:.40}")
    return bound


@dataclass(frozen=True, slots=True)
class Tolerance:
    """By how much the faces of a solid may be off: a length, and a part of the leaf's own size.

    The size is the radius for a curved face and the thickness for a plane; half-spaces have none.
    """

    absolute: float = 0.0
    relative: float = 0.0

    def __bool__(self) -> bool:
        return self != EXACT

    def form(self) -> float | dict[str, float]:
        """Return the value in a hello: a length alone is a number."""
        both = {"absolute": self.absolute, "relative": self.relative}
        return both if self.relative else self.absolute

    def words(self) -> str:
        """Return what is allowed: `1e-3 and 1e-4 of the size`; empty for nothing."""
        parts = [short(self.absolute)] if self.absolute else []
        parts += [f"{short(self.relative)} of the size"] if self.relative else []
        return " and ".join(parts)


EXACT = Tolerance()
"""None allowed."""


def read_tolerance(form: object, path: str = "tolerance") -> Tolerance:
    """Return the tolerance that a number or an object describes, or refuse it (`Refused`)."""
    if not isinstance(form, dict):
        return Tolerance(_part(form, path))
    for name in form:
        if name not in ("absolute", "relative"):
            raise Refused(f"{path}.{name:.40}", "is not a field (fields: absolute, relative)")
    return Tolerance(**{name: _part(value, f"{path}.{name}") for name, value in form.items()})


def _part(value: object, path: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise Refused(path, f"is not a number: {value!r:.40}")
    try:
        number = float(value)
    except OverflowError:
        number = inf
    if not 0 <= number < inf:
        raise Refused(path, f"is not a finite number >= 0: {value!r:.40}")
    return number
