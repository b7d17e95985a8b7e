"""The derivation of one case: the seed's own steps with this case's numbers, as data.

A leaf goes through its vectors, Problem 1, Problem 2 and Problem 3; a tree through each leaf by
path and then through the algebra of lists. Then come the exact endpoints and the measures.
Everything is computed anew; nothing is taken from a file.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from raycert.cases.case import Case, Family
from raycert.cases.formats import Format
from raycert.cases.lattice import is_lattice
from raycert.cases.model import Difference, Intersection, Ray, Solid, Tree, Union, leaves, type_of
from raycert.cases.row import GoldenRow, write_row
from raycert.oracle.corpus.golden import golden_row
from raycert.oracle.exact.grid import Grid
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.trace import combine, solve_leaf
from raycert.oracle.explain.ends import answer_steps, judgement
from raycert.oracle.explain.form import Fact, Note, Step, as_json, listed
from raycert.oracle.explain.leaf_steps import leaf_steps
from raycert.oracle.judge.levels import Judge


@dataclass(frozen=True, slots=True)
class Derivation:
    """A case as its golden row is or would be, and the steps that lead to it."""

    row: GoldenRow
    format: Format
    steps: tuple[Step, ...]


def derive(case: Case, fmt: Format, family: str = "given") -> Derivation:
    """Return the derivation of a case."""
    row = golden_row(Family(family, "", lambda _: ()), case, fmt)
    judge = Judge(case.solid, case.ray, fmt, case.tier)
    steps = (*solid_steps(case.solid, case.ray), *answer_steps(row, judge), judgement(row, judge))
    return Derivation(row, fmt, steps)


def given(solid: Solid, ray: Ray) -> Case:
    """Return the case of a solid and a ray that come from no family."""
    return Case(type_of(solid), "", solid, ray, "lattice" if is_lattice(solid, ray) else "generic")


def as_given(row: GoldenRow) -> Case:
    """Return the case of a golden row, without its answer."""
    slug = row.id.partition("/")[2]
    return Case(slug, row.why, row.solid, row.ray, row.tier, row.flags, row.source)


def to_json(derivation: Derivation) -> dict[str, Any]:
    """Return the derivation as a JSON object: the whole golden row, and the steps."""
    steps = [as_json(step) for step in derivation.steps]
    return {"row": write_row(derivation.row, derivation.format), "steps": steps}


def solid_steps(solid: Solid, ray: Ray) -> Iterator[Step]:
    """Yield the steps of a solid up to its exact list."""
    if not isinstance(solid, Tree):
        yield from leaf_steps(solid, ray)
        return
    for path, leaf in leaves(solid):
        for step in leaf_steps(leaf, ray):
            yield replace(step, heading=f"{path} ({type_of(leaf)}): {step.heading}")
    facts: list[Fact | Note] = []
    _lists(solid, Grid.of(solid, ray), "", facts)
    yield Step("The lists of the tree, from the leaves up", tuple(facts))


def _lists(solid: Solid, grid: Grid, path: str, facts: list[Fact | Note]) -> Intervals:
    """Return the list of a node, after adding a fact for each node below it and for itself."""
    if not isinstance(solid, Tree):
        found = solve_leaf(solid, grid, path, [])
        facts.append(Fact(path, listed(found), note=type_of(solid)))
        return found
    paths = [f"{path}.of[{i}]" if path else f"of[{i}]" for i in range(len(solid.of))]
    lists = [_lists(part, grid, at, facts) for part, at in zip(solid.of, paths, strict=True)]
    found = combine(solid, lists)
    facts.append(Fact(path or "the solid", listed(found), note=_words(solid, paths)))
    return found


def _words(tree: Union | Intersection | Difference, paths: list[str]) -> str:
    match tree:
        case Union():
            return f"{' or '.join(paths)}"
        case Intersection():
            return f"{' and '.join(paths)}"
        case Difference():
            rest = f", less {' and '.join(paths[1:])}" if paths[1:] else ""
            return f"{paths[0]}{rest}"
