"""A corpus of seven rows, one of each thing that a reader of golden files has to tell."""

from collections.abc import Iterator
from pathlib import Path

from raycert.cases.case import Case, Family
from raycert.cases.formats import Format
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Ray,
    Slab,
    Sphere,
    Union,
)
from raycert.oracle.corpus.golden import write

UNIT = Cylinder((0, 0, 0), (0, 0, 2), 1)
TREE = Difference((Sphere((0, 0, 0), 2), Union((UNIT, HalfSpace((0, 0, 0), (0, 0, 1))))))


def plain(fmt: Format) -> Iterator[Case]:
    yield Case("through", "A ray crosses.", UNIT, Ray((-3, 0, 1), (1, 0, 0)), "lattice")
    touching = Ray((-3, 1, 1), (1, 0, 0))
    yield Case("tangent", "A ray touches.", UNIT, touching, "lattice", ("tangent",), "Geant4 #1")
    yield Case("miss", "A ray misses.", UNIT, Ray((-3, 9, 1), (1, 0, 0)), "lattice")
    slab = Slab((0, -0.0, 0), (0, 0, 2))
    yield Case("slab", "A ray stays in a slab.", slab, Ray((0, 0, 1), (1, 1, 0)), "generic")
    tube = InfiniteCylinder((0, 0, 0), (0, 0.25, 2), 0.75)
    yield Case("tube", "A ray crosses a tube.", tube, Ray((-3, 0.125, 1), (1, 0, 0.5)), "stiff")
    far = Ray((fmt.nearest(-3e12), fmt.nearest(0.1), 1), (1, 0, fmt.nearest(1e-14)))
    yield Case("far", "A ray comes from far away.", UNIT, far, "stiff", ("far", "tangent"))


def trees(fmt: Format) -> Iterator[Case]:
    yield Case("tree", "A carved ball.", TREE, Ray((-3, 0, 1), (1, 0, 0)), "generic")


def write_small(folder: Path) -> Path:
    """Write the golden files of the families `plain` and `tree`, and return their folder."""
    families = (Family("plain", "The plain ones.", plain), Family("tree", "Trees.", trees))
    write(folder, families, lambda _: None)
    return folder
