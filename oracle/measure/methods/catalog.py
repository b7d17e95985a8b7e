"""All methods by name, from cheap to dear, and those that a command line asks for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from raycert.oracle.client.target import target
from raycert.oracle.measure.methods.arithmetics import with_digits, with_intervals, with_sympy
from raycert.oracle.measure.methods.formulas import frame, q_root, seed, textbook
from raycert.oracle.measure.methods.method import ALL, Case, Method, Solve, one_by_one
from raycert.oracle.measure.methods.programs import (
    batch_seconds,
    called,
    client,
    exact,
    oracle_batch,
    reference_batch,
)
from raycert.oracle.measure.methods.scalar import (
    Formula,
    Scalar,
    determinant,
    framed,
    shifted,
    shifted_ball,
)

DIGITS = (20, 50, 100, 200)
SIDES = tuple(2**k for k in range(3, 13))
MANY = 4096
"""The rays that one call of a batch is priced at."""
LEAVES = frozenset({"half_space", "sphere", "infinite_cylinder", "slab", "cylinder"})


def _late(module: str, name: str, *args: object) -> Callable[[Sequence[Case]], Any]:
    """Return the function that `module.name(*args)` makes, made anew at each call: it is cheap."""
    return lambda cases: getattr(import_module(module), name)(*args)(cases)


def _arrays(kind: str) -> tuple[Solve, Callable[[Sequence[Case]], float]]:
    return (
        _late("raycert.oracle.measure.methods.vector.batches", "textbook", kind),
        _late("raycert.oracle.measure.methods.vector.timing", "textbook_seconds", kind),
    )


def _in_arrays(name: str, does: str, kind: str) -> Method:
    solve, timed = _arrays(kind)
    return Method(name, does, solve, ALL, kind, True, MANY, timed, ("numpy",))


def _mesh(caster: str, n: int) -> Method:
    words = {"trimesh": "trimesh's own caster, in doubles", "embree": "Embree, in binary32"}
    needs = ("numpy", "trimesh", "scipy", "rtree") + (("embreex",) if caster == "embree" else ())
    return Method(
        f"{caster}-{n}",
        f"casts at a prism of {n} sides in the cylinder, by {words[caster]}",
        _late("raycert.oracle.measure.methods.vector.casters", "cast", caster, n),
        frozenset({"cylinder"}),
        "mesh",
        stress=False,
        lanes=MANY // (16 if caster == "trimesh" else 4),
        needs=needs,
    )


def _scalar(name: str, does: str, formula: Formula, stress: bool = True) -> Method:
    return Method(name, does, Scalar(formula), ALL, "float64", stress)


METHODS: tuple[Method, ...] = (
    Method("reference", "is the reference tracer", called("raycert.reference.tracer:intersect"),
           ALL, "float64"),
    Method("reference-batch", "is the reference tracer in lanes", reference_batch, ALL, "float64",
           False, MANY, batch_seconds("raycert.reference.arrays.tracer:intersect"), ("numpy",)),
    _scalar("textbook", "solves by the discriminant b^2 - a c", Formula(textbook)),
    _scalar("seed", "solves by the seed's formulas as printed", Formula(seed)),
    _scalar("local-frame", "turns the ray into the frame of the axis", Formula(frame, framed)),
    _scalar("determinant", "has D = r^2 A - (y . (v x n))^2", Formula(seed, determinant)),
    _scalar("q-root", "takes the roots C / q and q / A, and D from elsewhere", Formula(q_root)),
    _scalar("shift", "starts from the closest approach to p in space",
            Formula(textbook, shifted, shifted_ball)),
    _in_arrays("numpy-float32", "is the textbook in NumPy, binary32", "float32"),
    _in_arrays("numpy-float64", "is the textbook in NumPy, binary64", "float64"),
    _in_arrays("numpy-longdouble", "is the textbook in NumPy, long double", "longdouble"),
    _in_arrays("double-double", "is the textbook in NumPy, in pairs of doubles", "double-double"),
    *(
        Method(f"mpmath-{digits}", f"is the textbook in mpmath, {digits} digits",
               with_digits(digits), ALL, "mpmath", digits <= 50, needs=("mpmath",))
        for digits in DIGITS
    ),
    Method("mpmath-intervals", "is the textbook in intervals, of which it must be sure",
           with_intervals(), ALL, "interval", False, needs=("mpmath",)),
    Method("sympy", "is the textbook in SymPy, exact, then 40 digits", with_sympy(), ALL,
           "symbolic", False, needs=("sympy",)),
    Method("oracle", "is the oracle, in integers", one_by_one(exact), ALL, "exact"),
    Method("oracle-batch", "is the oracle in lanes, the same answers", oracle_batch, ALL, "exact",
           False, MANY, batch_seconds("raycert.oracle.batch.trace:trace_batch"), ("numpy",)),
    *(_mesh(caster, n) for caster in ("trimesh", "embree") for n in SIDES),
)  # fmt: skip
"""Of one arithmetic, they differ by the formula; of one formula, by the arithmetic."""
BY_NAME = {method.name: method for method in METHODS}


def by_name(name: str) -> Method:
    """Return the method of a name; `KeyError` if there is none."""
    return BY_NAME[name]


def here(methods: Sequence[Method]) -> tuple[list[Method], list[str]]:
    """Return the methods whose packages are installed, and a note for each package that is not."""
    lacking = {name for m in methods for name in m.needs if not _installed(name)}
    notes = [
        f"{name} is not installed; left out: "
        + ", ".join(m.name for m in methods if name in m.needs)
        for name in sorted(lacking)
    ]
    return [m for m in methods if not lacking & set(m.needs)], notes


def _installed(name: str) -> bool:
    try:
        import_module(name)
    except ImportError:
        return False
    return True


def chosen(names: Sequence[str], targets: Sequence[Sequence[str]] = ()) -> list[Method]:
    """Return the methods of these names, all without one, and those of targets' words.

    Raises `KeyError` for an unknown name, `Unusable` for a target that cannot be run. A client is
    called by the words that name it; no two methods have one name.
    """
    found = [by_name(name) for name in dict.fromkeys(names)] or list(METHODS)
    for words in targets:
        name = " ".join((Path(words[0]).name, *words[1:]))
        taken = sum(m.name == name or m.name.startswith(f"{name} #") for m in found)
        found.append(client(f"{name} #{taken + 1}" if taken else name, target(words)))
    return found
