"""Where a ray is inside a solid, exactly, and how far off the answer of a tracer is.

    >>> from raycert import *
    >>> can = Cylinder(p=(0, 0, 0), q=(0, 0, 2), radius=1)
    >>> hits = trace(can, Ray(origin=(-3, 0.5, 1), direction=(1, 0, 0)))
    >>> print(hits)
    [(6 - sqrt(3))/2, (6 + sqrt(3))/2]

An answer is the list of closed intervals of t >= 0 for which origin + t direction is in the solid.
Its ends are numbers of degree 1 or 2: they convert, compare with numbers, and have all digits.

    >>> enter, leave = hits[0]
    >>> float(enter), enter < 2.2, format(enter, ".30")
    (2.133974596215561, True, '2.13397459621556135323627682925')

Ask
    trace           the exact list of a solid along a ray
    expected        that list in doubles: correctly rounded, what touches then merged
    trace_batch     the same for many rays at once, in arrays (NumPy)
    intersect       the reference: a tracer in doubles, to read and to port
    explain         how the answer comes about, step by step

Judge
    Judge           one case, ready to judge answers: levels, backward and forward error
    certify         all golden cases put to a tracer: a function, a library or a program

Say what is asked
    HalfSpace  Sphere  InfiniteCylinder  Slab  Cylinder         the solids
    Union  Intersection  Difference                             of a list of solids
    Ray             origin and direction; the direction is not normalised
    read            a solid, a ray, a case or a golden row from its JSON

Be answered
    Trace           what `trace` returns: intervals, rows of the case table, a picture
    Surd, INFINITY  an end: (x + y sqrt(d)) / z in integers, or infinity

Solids, rays, traces and ends are shown as what gives them back; in a notebook a trace and an
explanation draw themselves. Where a number is expected any real number will do, NumPy's too; where
a vector is, a list, a tuple or an array of three. What means nothing raises `ValueError`, with the
path of the field at fault. Everything is loaded when it is first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from raycert.answers import Trace as Trace
    from raycert.answers import expected as expected
    from raycert.answers import explain as explain
    from raycert.answers import read as read
    from raycert.answers import trace as trace
    from raycert.cases.model import Cylinder as Cylinder
    from raycert.cases.model import Difference as Difference
    from raycert.cases.model import HalfSpace as HalfSpace
    from raycert.cases.model import InfiniteCylinder as InfiniteCylinder
    from raycert.cases.model import Intersection as Intersection
    from raycert.cases.model import Ray as Ray
    from raycert.cases.model import Slab as Slab
    from raycert.cases.model import Sphere as Sphere
    from raycert.cases.model import Union as Union
    from raycert.oracle.batch.blocks import trace_batch as trace_batch
    from raycert.oracle.exact.surd import INFINITY as INFINITY
    from raycert.oracle.exact.surd import Surd as Surd
    from raycert.oracle.judge.levels import Judge as Judge
    from raycert.reference.tracer import intersect as intersect
    from raycert.trials import certify as certify

_HOMES = {
    "raycert.answers": "trace expected explain read Trace",
    "raycert.cases.model": "HalfSpace Sphere InfiniteCylinder Slab Cylinder "
    "Union Intersection Difference Ray",
    "raycert.oracle.batch.blocks": "trace_batch",
    "raycert.oracle.exact.surd": "Surd INFINITY",
    "raycert.oracle.judge.levels": "Judge",
    "raycert.reference.tracer": "intersect",
    "raycert.trials": "certify",
}
"""Where each public name is defined; its module is imported when the name is first asked for."""
_HOME = {name: module for module, names in _HOMES.items() for name in names.split()}

__all__ = [
    "INFINITY",
    "Cylinder",
    "Difference",
    "HalfSpace",
    "InfiniteCylinder",
    "Intersection",
    "Judge",
    "Ray",
    "Slab",
    "Sphere",
    "Surd",
    "Trace",
    "Union",
    "certify",
    "expected",
    "explain",
    "intersect",
    "read",
    "trace",
    "trace_batch",
]


def __getattr__(name: str) -> Any:
    """Return a public name, from the module that defines it."""
    if name not in _HOME:
        raise AttributeError(f"module 'raycert' has no attribute {name!r}")
    value = globals()[name] = getattr(import_module(_HOME[name]), name)
    return value


def __dir__() -> list[str]:
    """Return the public names: what there is to complete."""
    return sorted(__all__)
