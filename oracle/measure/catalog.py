"""All ways by name, from cheap to dear, and those that a command line asks for.

Naming them loads none of their libraries: each is loaded when it is first asked. Of one arithmetic,
they differ by the formula; of one formula, by the arithmetic.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from raycert.oracle.client.target import target
from raycert.oracle.measure.digits import in_balls, in_intervals, in_sympy, with_digits
from raycert.oracle.measure.facets import SIDES
from raycert.oracle.measure.quadratics import (
    Formula,
    determinant,
    frame,
    framed,
    printed,
    q_root,
    shifted,
    shifted_ball,
    textbook,
)
from raycert.oracle.measure.way import (
    ALL,
    Way,
    called,
    client,
    exact,
    function,
    missing,
    one_by_one,
)

DIGITS = (20, 50, 100, 200)
MANY = 4096
"""The rays that one call of a batch is priced at."""
BESIDE = ("reference", "textbook", "oracle")
"""What somebody's own tracer is set beside: what is right, what is not, and the truth."""


def _late(name: str, *args: object) -> Callable[..., Any]:
    """Return `function(*args, cases)` of a module here, which is loaded when it is called."""
    return lambda cases: function(f"raycert.oracle.measure.{name}")(*args, cases)


def _in_arrays(name: str, does: str, kind: str) -> Way:
    solve, ready = (_late(f"arrays:{f}", kind) for f in ("textbook", "ready_textbook"))
    return Way(name, does, solve, ALL, kind, True, MANY, ready, ("numpy",))


def _batch(name: str, does: str, called: str, precision: str) -> Way:
    solve, ready = (_late(f"arrays:{f}", called) for f in ("batch", "ready_batch"))
    return Way(name, does, solve, ALL, precision, False, MANY, ready, ("numpy",))


def _mesh(caster: str, n: int) -> Way:
    words = {"trimesh": "trimesh's own caster, in doubles", "embree": "Embree, in binary32"}
    return Way(
        f"{caster}-{n}",
        f"casts at a prism of {n} sides in the cylinder, by {words[caster]}",
        _late("facets:cast", caster, n),
        frozenset({"cylinder"}),
        "mesh",
        stress=False,
        lanes=MANY // (16 if caster == "trimesh" else 4),
        needs=("numpy", "trimesh", "scipy", "rtree") + ("embreex",) * (caster == "embree"),
    )


WAYS: tuple[Way, ...] = (
    Way("reference", "is the reference tracer", called("raycert.reference.tracer:intersect")),
    _batch("reference-batch", "is the reference tracer in lanes",
           "raycert.reference.arrays.tracer:intersect", "float64"),
    Way("textbook", "solves by the discriminant b^2 - a c", Formula(textbook)),
    Way("seed", "solves by the formulas of Problem 1, as printed", Formula(printed)),
    Way("local-frame", "turns the ray into the frame of the axis", Formula(frame, framed)),
    Way("determinant", "has D = r^2 A - (y . (v x n))^2", Formula(printed, determinant)),
    Way("q-root", "takes the roots C / q and q / A, and D from elsewhere", Formula(q_root)),
    Way("shift", "starts from the closest approach to p in space",
        Formula(textbook, shifted, shifted_ball)),
    _in_arrays("numpy-float32", "is the textbook in NumPy, binary32", "float32"),
    _in_arrays("numpy-float64", "is the textbook in NumPy, binary64", "float64"),
    _in_arrays("numpy-longdouble", "is the textbook in NumPy, long double", "longdouble"),
    _in_arrays("double-double", "is the textbook in NumPy, in pairs of doubles", "double-double"),
    *(
        Way(f"mpmath-{digits}", f"is the textbook in mpmath, {digits} digits",
            with_digits(digits), ALL, "mpmath", digits <= 50, needs=("mpmath",))
        for digits in DIGITS
    ),
    Way("mpmath-intervals", "is the textbook in intervals, of which it must be sure",
        in_intervals, ALL, "interval", False, needs=("mpmath",)),
    Way("arb", "is the textbook in arb's balls, written out for capped cylinders",
        one_by_one(in_balls), frozenset({"cylinder"}), "interval", False, needs=("flint",)),
    Way("sympy", "is the textbook in SymPy, exact, then 40 digits", in_sympy, ALL,
        "symbolic", False, needs=("sympy",)),
    Way("oracle", "is the oracle, in integers", one_by_one(exact), ALL, "exact"),
    _batch("oracle-batch", "is the oracle in lanes, the same answers",
           "raycert.oracle.batch.blocks:trace_batch", "exact"),
    *(_mesh(caster, n) for caster in ("trimesh", "embree") for n in SIDES),
)  # fmt: skip
BY_NAME = {way.name: way for way in WAYS}


def here(ways: Sequence[Way]) -> tuple[list[Way], list[str]]:
    """Return the ways whose packages are installed, and a note for each package that is not."""
    absent = missing(sorted({name for way in ways for name in way.needs}))
    notes = [
        f"{name} is not installed; left out: "
        + ", ".join(way.name for way in ways if name in way.needs)
        for name in absent
    ]
    return [way for way in ways if not set(absent) & set(way.needs)], notes


def chosen(names: Sequence[str], targets: Sequence[Sequence[str]] = ()) -> list[Way]:
    """Return the ways of these names, all without one, and those of targets' words.

    Raises `KeyError` for an unknown name, `Unusable` for a target that cannot be run. A client is
    called by the words that name it; no two ways have one name.
    """
    ways = [BY_NAME[name] for name in dict.fromkeys(names)] or list(WAYS)
    for words in targets:
        name = " ".join((Path(words[0]).name, *words[1:]))
        taken = sum(way.name == name or way.name.startswith(f"{name} #") for way in ways)
        ways.append(client(f"{name} #{taken + 1}" if taken else name, target(words)))
    return ways
