"""To add a solid: the modules that tell one leaf from another are these, and no others.

What a solid is stands in `cases.model`: its fields there give it its JSON, its numbers, its place
in integers. Beside the places below it needs its rows in `cases.table` if they are new, a family in
`cases.families`, and the schemas of `cases/schemas` and the readers of `oracle/starters`.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from raycert.cases.model import LEAVES

ROOT = Path(__file__).parents[2]
KINDS = frozenset(kind.__name__ for kind in LEAVES)

PLACES = {
    "cases.domain": "its sizes, against which a domain is measured",
    "cases.lattice": "when it lies on the lattice, and a ray in its face",
    "cases.recipes": "what a ray may aim at",
    "oracle.exact.trace": "its exact list, row by row",
    "oracle.exact.faces": "its faces as polynomials in t",
    "oracle.exact.condition": "how its endpoints move with its numbers",
    "oracle.judge.moved": "its size, its thinness, its faces moved",
    "oracle.judge.pixels": "which rays pass it by",
    "oracle.batch.constants": "its exact list for many rays",
    "oracle.witness.definition": "its definition, asked point by point",
    "oracle.witness.enclosure": "its formulas in interval arithmetic",
    "oracle.witness.symbols": "its conditions in SymPy",
    "oracle.witness.manifold": "its meshes inside and around it",
    "oracle.witness.placement": "the frame in which a mesh stands",
    "oracle.zoo.tracer": "a tracer with one place for each fault",
    "oracle.zoo.surfaces": "faults of its walls",
    "oracle.explain.derive": "the steps of its derivation",
    "oracle.reports.section": "the plane to look at it in",
    "oracle.hunt.moves": "moves that it invites, and what is simpler than it",
    "oracle.measure.arrays": "the naive formula in arrays",
    "oracle.measure.quadratics": "the formulas that are raced",
    "reference.tracer": "its list in doubles",
    "reference.arrays.tracer": "its list in arrays",
    "reference.arrays.tiles": "which tiles of rays miss it",
    "reference.arrays.plan": "what its plan may leave out",
    "reference.arrays.picture": "its normals",
}
"""The modules that dispatch on leaves, each with what it has to know of a new one."""


def _named(node: ast.AST) -> set[str]:
    """Return the leaf types named in an expression: a class, a union or a tuple of classes."""
    return {part.id for part in ast.walk(node) if isinstance(part, ast.Name)} & KINDS


def _told_apart(node: ast.AST) -> set[str]:
    """Return the leaf types that one node tells from the others."""
    match node:
        case ast.MatchClass(cls=ast.Name(id=name)):
            return {name} & KINDS
        case ast.Call(func=ast.Name(id="isinstance"), args=[_, kinds]):
            return _named(kinds)
        case ast.Compare(left=ast.Call(func=ast.Name(id="type")), comparators=kinds):
            return {name for kind in kinds for name in _named(kind)}
        case ast.Dict(keys=keys):
            return {name for key in keys if key is not None for name in _named(key)}
    return set()


def dispatching(source: str) -> Iterator[str]:
    """Yield what dispatches on two leaf types or more: functions, methods, tables by their line."""
    for top in ast.parse(source).body:
        for unit in top.body if isinstance(top, ast.ClassDef) else [top]:
            kinds = {kind for node in ast.walk(unit) for kind in _told_apart(node)}
            if len(kinds) > 1:
                yield getattr(unit, "name", f"line {unit.lineno}")


def test_a_solid_is_added_in_the_places_that_are_listed() -> None:
    found: dict[str, list[str]] = {}
    for folder in ("cases", "oracle", "reference"):
        for file in sorted((ROOT / folder).rglob("*.py")):
            if names := list(dispatching(file.read_text("utf-8"))):
                module = ".".join(file.relative_to(ROOT).with_suffix("").parts)
                found[module] = names
    unlisted = {module: names for module, names in found.items() if module not in PLACES}
    assert not unlisted, "tell leaves apart, and are not in PLACES"
    assert not set(PLACES) - set(found), "are in PLACES, and tell no leaves apart"


def test_the_readme_lists_the_same_places() -> None:
    section = (ROOT / "README.md").read_text("utf-8").partition("## To add a solid")[2]
    assert dict(re.findall(r"^- `([\w.]+)`: (.+)$", section, re.M)) == PLACES


@pytest.mark.parametrize(
    "body",
    [
        "match leaf:\n        case Sphere(): return 1\n        case Slab(): return 2",
        "match leaf:\n        case Sphere() | Slab(): return 1",
        "return isinstance(leaf, Sphere | Slab)",
        "return isinstance(leaf, (Sphere, Slab))",
        "return isinstance(leaf, Sphere) or isinstance(leaf, Slab)",
        "return type(leaf) is Sphere or type(leaf) in (Slab, Cylinder)",
        "return {Sphere: 1, Slab: 2}[type(leaf)]",
    ],
)
def test_every_way_to_dispatch_is_seen(body: str) -> None:
    assert list(dispatching(f"def planted(leaf):\n    {body}\n")) == ["planted"]


def test_one_type_or_a_tree_is_no_dispatch() -> None:
    body = "return isinstance(leaf, Sphere) or isinstance(leaf, Union)"
    assert not list(dispatching(f"def innocent(leaf):\n    {body}\n"))
