"""Hypothesis strategies for rays and solids: for the tests of any tracer, this project's and yours.

They need the extra `hunt`: pip install "raycert[hunt]".

    numbers(fmt)  vectors(fmt)    coordinates
    leaves(kinds)                 half-spaces, spheres, slabs, cylinders
    solids(max_leaves, kinds)     leaves, and trees of unions, intersections and differences
    rays(solid)                   rays, aimed at a solid or at nothing
    scenes(max_leaves, kinds)     (solid, ray)
    ensembles(count)              (solids, ray): several solids for one ray

Tracers go wrong where random numbers never lie. So five scenes of six lie on small integers and
powers of two: leaves share points, axes, planes and radii; rays run along walls and in caps,
touch, pass through rims, start on faces, stand still; radii may be 0; and single numbers move to
their neighbours in the format. In the other scenes all bits are random, and what is aimed at is
missed by roundings. No number is so large or small that a sound formula over- or underflows.
Failing scenes shrink to few parts and small integers.

>>> from hypothesis import given, settings
>>> from raycert.oracle.exact.trace import trace
>>> from raycert.reference.tracer import intersect      # your own comes here
>>> @settings(max_examples=50, database=None, derandomize=True)
... @given(scenes(kinds=("cylinder", "sphere", "union")))
... def test_what_is_missed_is_at_most_touched(scene):
...     if not intersect(*scene):
...         assert all(enter == leave for enter, leave in trace(*scene).intervals)
>>> test_what_is_missed_is_at_most_touched()
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from math import ldexp
from typing import Any, TypeVar

from raycert.cases import recipes
from raycert.cases.formats import BINARY64, Format
from raycert.cases.hints import lacking
from raycert.cases.model import Leaf, Ray, Solid, Vector

try:
    from hypothesis import strategies as st
except ImportError:
    raise ImportError(
        lacking("raycert.cases.strategies", "hunt", "hypothesis"), name="hypothesis"
    ) from None

T = TypeVar("T")
Ensemble = tuple[tuple[Solid, ...], Ray]

KINDS = recipes.LEAVES + recipes.TREES
WEIGHTS = dict(zip(recipes.LEAVES, (1, 2, 2, 1, 3), strict=True))

REACH = 10
"""Powers of two lie between 2^-REACH and 2^REACH; other coordinates are drawn from [-8, 8]."""
STANDING = st.just(recipes.STILL)
WHOLE = st.integers(-4, 4).map(float)


def numbers(fmt: Format = BINARY64) -> st.SearchStrategy[float]:
    """Return small integers, powers of two, their neighbours in the format, and any in [-8, 8]."""
    powers = st.builds(ldexp, st.sampled_from((1.0, -1.0)), st.integers(-REACH, REACH))
    near = st.builds(recipes.neighbour, WHOLE | powers, st.booleans(), st.just(fmt))
    return st.one_of(WHOLE, powers, near, _random(fmt))


def vectors(fmt: Format = BINARY64) -> st.SearchStrategy[Vector]:
    """Return three such numbers; the zero vector is one of them."""
    return st.one_of(_thrice(WHOLE), _thrice(numbers(fmt)), _thrice(_random(fmt)))


def leaves(
    kinds: Iterable[str] = recipes.LEAVES, fmt: Format = BINARY64
) -> st.SearchStrategy[Leaf]:
    """Return leaves of the types named as in the protocol: `half_space`, `sphere`, ..."""
    chosen, trees = _split(kinds)
    if trees:
        raise ValueError(f"not a leaf: {', '.join(trees)}")
    return _styled(
        fmt, lambda style: st.builds(recipes.make_leaf, _leaves(chosen, style), _pools(style))
    )


def solids(
    max_leaves: int = 6, kinds: Iterable[str] = KINDS, fmt: Format = BINARY64
) -> st.SearchStrategy[Solid]:
    """Return leaves, and trees of so many leaves at most; of the types named."""
    names = _split(kinds)
    return _styled(
        fmt,
        lambda style: st.builds(
            recipes.make_solid, _trees(max_leaves, names, style), _pools(style)
        ),
    )


def scenes(
    max_leaves: int = 6, kinds: Iterable[str] = KINDS, fmt: Format = BINARY64
) -> st.SearchStrategy[tuple[Solid, Ray]]:
    """Return (solid, ray), the ray mostly aimed at a leaf of the solid."""
    return ensembles(1, max_leaves, kinds, fmt).map(lambda drawn: (drawn[0][0], drawn[1]))


def ensembles(
    count: int, max_leaves: int = 6, kinds: Iterable[str] = KINDS, fmt: Format = BINARY64
) -> st.SearchStrategy[Ensemble]:
    """Return `count` solids that share points, axes and radii, and a ray aimed at one of them."""
    names = _split(kinds)

    def of(style: _Style) -> st.SearchStrategy[Ensemble]:
        some = st.tuples(*[_trees(max_leaves, names, style)] * count)
        return st.builds(_ensemble, some, _aims(style), _pools(style))

    return _styled(fmt, of)


def rays(solid: Solid | None = None, fmt: Format = BINARY64) -> st.SearchStrategy[Ray]:
    """Return rays, mostly aimed at where a leaf of the solid is hard; without one, at nothing."""
    if solid is None:
        directions = _styled(fmt, lambda style: _mixed((9, _directions(style)), (1, STANDING)))
        return st.builds(Ray, vectors(fmt), directions)
    return _styled(
        fmt,
        lambda style: st.builds(recipes.make_ray, st.just((solid,)), _aims(style), _pools(style)),
    )


@dataclass(frozen=True, slots=True)
class _Style:
    """How the numbers of a scene look: on the lattice, a few of them moved; or all bits random."""

    fmt: Format
    lattice: bool


def _styled(fmt: Format, make: Callable[[_Style], st.SearchStrategy[T]]) -> st.SearchStrategy[T]:
    return _mixed((5, make(_Style(fmt, lattice=True))), (1, make(_Style(fmt, lattice=False))))


def _mixed(*weighted: tuple[int, st.SearchStrategy[T]]) -> st.SearchStrategy[T]:
    """Return strategies each as often as its weight; `one_of` takes each just once."""
    each = [strategy for weight, strategy in weighted for _ in range(weight)]
    return st.integers(0, len(each) - 1).flatmap(each.__getitem__)


def _split(kinds: Iterable[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the names of leaves and of trees among `kinds`, in the order of the contract."""
    wanted = {kinds} if isinstance(kinds, str) else set(kinds)
    if unknown := sorted(wanted - set(KINDS)):
        raise ValueError(f"unknown type {', '.join(unknown)}; known are {', '.join(KINDS)}")
    chosen = tuple(name for name in recipes.LEAVES if name in wanted)
    if not chosen:
        raise ValueError(f"no leaf among the types; name one of {', '.join(recipes.LEAVES)}")
    return chosen, tuple(name for name in recipes.TREES if name in wanted)


def _thrice(parts: st.SearchStrategy[float]) -> st.SearchStrategy[Vector]:
    return st.tuples(parts, parts, parts)


@cache
def _random(fmt: Format) -> st.SearchStrategy[float]:
    """Return numbers in [-8, 8], most with all their bits random."""
    some = st.floats(-8, 8, width=32 if fmt.precision == 24 else 64, allow_subnormal=False)
    return some.map(lambda x: x if abs(x) >= 2.0**-REACH else 0.0)


@cache
def _coordinates(style: _Style) -> st.SearchStrategy[Vector]:
    if not style.lattice:
        return _thrice(_random(style.fmt))
    return _mixed((15, _thrice(WHOLE)), (1, _thrice(numbers(style.fmt))))


@cache
def _directions(style: _Style) -> st.SearchStrategy[Vector]:
    """Return vectors other than 0: on the lattice mostly along an axis, or of whole length."""
    some = _coordinates(style).map(lambda v: v if any(v) else recipes.UNITS[2])
    return _mixed((3, st.sampled_from(recipes.DIRECTIONS)), (1, some)) if style.lattice else some


@cache
def _radii(style: _Style) -> st.SearchStrategy[float]:
    return st.sampled_from(recipes.RADII) if style.lattice else _random(style.fmt).map(abs)


@cache
def _axes(style: _Style) -> st.SearchStrategy[recipes.Axis]:
    return st.tuples(_coordinates(style), _directions(style))


@cache
def _pools(style: _Style) -> st.SearchStrategy[recipes.Pool]:
    parts = _coordinates(style), _axes(style), _radii(style)
    return st.builds(
        recipes.Pool.of, *(st.tuples(part, part) for part in parts), st.just(style.fmt)
    )


@cache
def _leaves(kinds: tuple[str, ...], style: _Style) -> st.SearchStrategy[recipes.LeafRecipe]:
    """Return leaves whose fields are mostly picked from the pool."""
    pick = st.sampled_from(recipes.PICKS)
    fields: dict[str, st.SearchStrategy[Any]] = {
        "axis": _mixed((3, pick), (1, _axes(style))),
        "point": _mixed((3, pick), (1, _coordinates(style))),
        "radius": pick | _radii(style),
    }
    needs = {"sphere": ("point", "radius"), "half_space": ("axis",), "slab": ("axis",)}

    def leaf(kind: str) -> st.SearchStrategy[recipes.LeafRecipe]:
        needed = {name: fields[name] for name in needs.get(kind, ("axis", "radius"))}
        return st.builds(recipes.LeafRecipe, st.just(kind), **needed)

    return _mixed(*((WEIGHTS[kind], leaf(kind)) for kind in kinds))


@cache
def _trees(
    max_leaves: int, names: tuple[tuple[str, ...], tuple[str, ...]], style: _Style
) -> st.SearchStrategy[recipes.Recipe]:
    """Return leaves and trees; now and then the parts of a X, or the same."""
    kinds, trees = names
    leaf = _leaves(kinds, style)
    if not trees or max_leaves < 2:
        return leaf
    pairs = st.builds(
        recipes.alike, leaf, st.sampled_from(recipes.PICKS), st.sampled_from(recipes.NESTED)
    )
    often = [name for name in trees for _ in range(1 if name == "intersection" else 2)]

    def extend(parts: st.SearchStrategy[recipes.Recipe]) -> st.SearchStrategy[recipes.Recipe]:
        twice = parts.map(lambda part: [part, part])
        few, more = (st.lists(parts, min_size=n, max_size=4) for n in (1, 2))
        some = _mixed((1, few), (3, more), (1, twice), (3, pairs))
        return st.builds(recipes.TreeRecipe, st.sampled_from(often), some)

    grown = st.recursive(leaf, extend, max_leaves=max_leaves)
    return grown.filter(lambda recipe: recipe.count() <= max_leaves)


@cache
def _aims(style: _Style) -> st.SearchStrategy[recipes.Aim]:
    index = st.integers(0, 11)
    spots = st.builds(
        recipes.Spot, index, index, st.sampled_from(recipes.ALONG), st.sampled_from(recipes.AWAY)
    )
    free = st.tuples(index | _coordinates(style), _mixed((4, _directions(style)), (1, STANDING)))
    return st.builds(
        recipes.Aim,
        spot=spots,
        turn=st.sampled_from(recipes.TURNS),
        toward=_mixed((2, st.none()), (1, spots)),
        back=st.sampled_from(recipes.BACK),
        speed=st.sampled_from(recipes.SPEEDS),
        free=_mixed((5, st.none()), (1, free)),
        moved=st.sampled_from(recipes.MOVED),
    )


def _ensemble(parts: tuple[recipes.Recipe, ...], aim: recipes.Aim, pool: recipes.Pool) -> Ensemble:
    drawn = tuple(recipes.make_solid(recipe, pool) for recipe in parts)
    return drawn, recipes.make_ray(drawn, aim, pool)
