"""The form of an exact answer, and what lies between two forms: a curve on a map.

The form is the rows of the case table (of a lone leaf) and, for every pair, the faces that its ends
lie on. It changes where the case is degenerate: at a double root, a rim, coincident faces of two
leaves, a start on a face, a direction parallel to one. All of it is decided exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal, get_args

from raycert.cases.model import Tree, leaves
from raycert.cases.numbers import Probe
from raycert.oracle.exact.faces import Place, place
from raycert.oracle.exact.trace import Answer, trace

Kind = Literal["double root", "rim", "coincident faces", "start on a face", "parallel to a face"]
KINDS: tuple[Kind, ...] = get_args(Kind)
DECIDED: dict[str, Kind] = {
    "disc": "double root",
    **dict.fromkeys(("inside", "t1", "t2", "up", "uq"), "start on a face"),
    **dict.fromkeys(("vv", "vn"), "parallel to a face"),
    **dict.fromkeys(("a-c", "b-d", "m-n"), "rim"),
}
"""What is met where the sign of a quantity of the case table changes."""
Ends = tuple[Place, Place]


@dataclass(frozen=True, slots=True)
class Topology:
    """The form of an exact answer: equal for cases with no degeneracy between them.

    `signs`, those that decided the rows, and the forms of the `parts` of a tree, its leaves, tell
    what lies between two forms.
    """

    rows: tuple[str, ...]
    ends: tuple[Ends, ...]
    touches: tuple[bool, ...]
    signs: tuple[tuple[str, int], ...] = field(default=(), compare=False)
    parts: tuple[Topology, ...] = field(default=(), compare=False)

    @property
    def pairs(self) -> int:
        return len(self.ends)

    @property
    def kinds(self) -> tuple[Kind, ...]:
        """Return which degeneracies the case lies on exactly."""
        found: set[Kind] = set()
        for end in (end for pair in self.ends for end in pair):
            own = [face for face in end.faces if face != "start"]
            if end.kind == "start":
                found |= {"start on a face"} if own else set()
            elif len({face.rpartition(":")[0] for face in own}) > 1:
                found.add("coincident faces")
            if end.kind in ("tangent", "rim"):
                found.add("double root" if end.kind == "tangent" else "rim")
        return tuple(kind for kind in KINDS if kind in found)

    @property
    def label(self) -> str:
        """Return the form in a line: the number of pairs, rows or faces, and what is met."""
        count = counted(self.touches)
        how = " ".join(self.rows) or "; ".join(_spelled(pair) for pair in self.ends)
        met = f" ({', '.join(self.kinds)})" if self.kinds else ""
        return f"{count}: {how}{met}" if how else f"{count}{met}"


def counted(touches: Sequence[bool]) -> str:
    """Return how many pairs a list has, and whether all of them are touches, in words."""
    if not touches:
        return "no pair"
    one = len(touches) == 1
    count = "1 pair" if one else f"{len(touches)} pairs"
    touch = "a touch" if one else "touches"
    return f"{count}, {touch}" if all(touches) else count


def _spelled(pair: Ends) -> str:
    enter, leave = ("=".join(end.faces) or "inf" for end in pair)
    return f"{enter} .. {leave}"


def topology(probe: Probe) -> tuple[Topology, Answer]:
    solid, ray = probe
    answer = trace(solid, ray)
    ends = tuple((place(a, solid, ray), place(b, solid, ray)) for a, b in answer.intervals)
    touches = tuple(a == b for a, b in answer.intervals)
    if isinstance(solid, Tree):
        parts = tuple(topology(Probe(leaf, ray))[0] for _, leaf in leaves(solid))
        return Topology((), ends, touches, parts=parts), answer
    signs = tuple((name, sign) for d in answer.decisions for name, sign in d.signs)
    return Topology(answer.rows, ends, touches, signs), answer


def between(one: Topology, other: Topology) -> Kind | None:
    """Return what lies between two cells, or under one of them; None if the forms are equal."""
    if one == other:
        return None
    if met := [kind for kind in KINDS if (kind in one.kinds) != (kind in other.kinds)]:
        return met[0]
    if not one.parts:
        return _of_leaf(one, other)
    both = list(zip(one.parts, other.parts, strict=True))
    changed = [(a, b) for a, b in both if a.ends != b.ends]
    if one.pairs != other.pairs:  # no rim and no start of a part adds a pair
        changed = [(a, b) for a, b in changed if a.pairs != b.pairs]
    return between(*changed[0]) if changed else "coincident faces"


def _of_leaf(one: Topology, other: Topology) -> Kind:
    """Return what lies between two forms of a leaf.

    Where both have as many pairs, the first end that changes tells it: it was cut off at the start,
    ran along for ever, or went over a rim. Else a sign does that decided a row.
    """
    if one.pairs == other.pairs:
        here, there = ([end for two in form.ends for end in two] for form in (one, other))
        for a, b in zip(here, there, strict=True):
            if a.faces != b.faces:
                if "start" in (a.kind, b.kind):
                    return "start on a face"
                return "parallel to a face" if "end" in (a.kind, b.kind) else "rim"
    known = dict(other.signs)
    changed = (name for name, sign in one.signs if known.get(name, sign) != sign)
    return next((DECIDED[name] for name in changed if name in DECIDED), "rim")
