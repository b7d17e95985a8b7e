"""Every cell of a map: its exact answer, the implementation's, and how far that is right.

Cells are taken from the middle outward, so that an interrupted map is a smaller one of the same
case. The implementation is asked first, all cells in one run; then each cell is answered exactly
and compared. Nothing is compared by a float but numbers that are answers themselves.

The form of an exact answer is the rows of the case table (of a lone leaf) and, for every pair, the
faces that its ends lie on. It changes where the case is degenerate, which makes a curve on the map:
at a double root, a rim, coincident faces of two leaves, a start on a face, a direction parallel to
one. All of it is decided exactly.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field, replace
from typing import Literal, get_args

from raycert.cases.accept import Numbers
from raycert.cases.formats import BINARY64, Format
from raycert.cases.interrupts import interruptible
from raycert.cases.model import Refused, Tree, leaves, types
from raycert.cases.numbers import Probe
from raycert.cases.protocol import Hello, Reply
from raycert.oracle.client.dialogue import Limits, Outcome, Question, Target, Unusable, silence
from raycert.oracle.client.replay import Interrupted, greet, run
from raycert.oracle.exact.faces import Place, place
from raycert.oracle.exact.intervals import expected
from raycert.oracle.exact.trace import Answer, trace
from raycert.oracle.judge.answer import Claim, First, Listed, YesNo, claim
from raycert.oracle.judge.levels import Judge
from raycert.oracle.judge.pixels import error
from raycert.oracle.map.raster import At, Raster

Show = Literal["exact", "answer", "k", "ulps", "disagreement"]
SHOWS: tuple[Show, ...] = get_args(Show)
NUMBERS = ("k", "ulps")
EXACT, FAITHFUL = "the exact list, rounded", "each number next to the exact one"
RIGHT, FEW, MANY = "as many pairs", "too few pairs", "too many pairs"
WITHIN, BEYOND = ", k <= 64", ", k > 64"
ORDER = (EXACT, FAITHFUL, *(how + k for k in (WITHIN, BEYOND) for how in (RIGHT, FEW, MANY)))
"""The classes of a disagreement, from none to the worst."""
Counting = Callable[[str, int], AbstractContextManager[Callable[..., None]]]


class Mismatch(Unusable):
    """The implementation cannot be asked this case: what it declares excludes it."""


@dataclass(frozen=True, slots=True)
class Cell:
    """A cell: no case (`refused` says why), or its exact answer and what was made of it.

    `value` is k or ulps; `says` is a class: how the answer looks, or how it differs.
    """

    refused: str = ""
    topology: Topology | None = None
    expected: Numbers = ()
    outcome: Outcome | None = None
    value: float | None = None
    says: str = ""


@dataclass(frozen=True)
class Map:
    """The cells of a raster, by their places; all of them unless the map was interrupted."""

    raster: Raster
    show: Show
    hello: Hello | None = None
    cells: dict[At, Cell] = field(default_factory=dict)

    @property
    def whole(self) -> bool:
        return len(self.cells) == len(self.raster.places)


def sample(
    raster: Raster,
    show: Show,
    target: Target | None = None,
    limits: Limits | None = None,
    counting: Counting = lambda *_: nullcontext(lambda n=1: None),
) -> Map:
    """Return the map of a raster. On KeyboardInterrupt it has the cells that were finished.

    Everything but `exact` needs a target. Raises `Unusable`; `Mismatch` where the target does not
    take the solid or the format.
    """
    probes = {at: _probe(raster, at) for at in raster.places}
    hello, outcomes = None, dict[At, Outcome]()
    if show != "exact":
        assert target is not None
        with interruptible():
            hello = greet(target, limits)
        _check(hello, raster)
        outcomes = _asked(target, hello, probes, limits, counting)
    found = Map(raster, show, hello)
    compare = Comparison(show, hello, raster.inputs.format)
    try:
        with interruptible(), counting("comparing", len(probes)) as advance:
            for at, probe in probes.items():
                if isinstance(probe, Refused):
                    found.cells[at] = Cell(refused=str(probe))
                elif hello is None or at in outcomes:
                    found.cells[at] = compare(probe, outcomes.get(at))
                advance()
    except KeyboardInterrupt:
        pass
    return found


def _probe(raster: Raster, at: At) -> Probe | Refused:
    try:
        return raster.probe(at)
    except Refused as refusal:
        return refusal


def _check(hello: Hello, raster: Raster) -> None:
    fmt = raster.inputs.format
    if hello.precision != fmt.name:
        raise Mismatch(f"the target is of {hello.precision}, the case of {fmt.name}")
    if missing := sorted(types(raster.inputs.probe({}).solid) - {*hello.solids}):
        raise Mismatch(f"the target declares no {', '.join(missing)}")


def _asked(
    target: Target,
    hello: Hello,
    probes: dict[At, Probe | Refused],
    limits: Limits | None,
    counting: Counting,
) -> dict[At, Outcome]:
    """Return what the target answered; what was known by then if interrupted."""
    places = {f"{at[0]},{at[1]}": at for at in probes}
    asked = ((id, probes[at]) for id, at in places.items())
    questions = [Question(id, *probe) for id, probe in asked if not isinstance(probe, Refused)]
    done = 0
    with counting("asking", len(questions)) as advance:

        def on_progress(known: int) -> None:
            nonlocal done
            advance(known - done)
            done = known

        try:
            with interruptible():
                outcomes = run(target, questions, limits, on_progress, hello).outcomes
        except Interrupted as interrupted:
            outcomes = interrupted.run.outcomes
    return {places[id]: outcome for id, outcome in outcomes.items()}


@dataclass
class Comparison:
    """Answers cells exactly and compares; remembers the step of the last k as a `guess`."""

    show: Show
    hello: Hello | None
    format: Format
    guess: int = 0

    def __call__(self, probe: Probe, outcome: Outcome | None) -> Cell:
        hello, (form, exact) = self.hello, topology(probe)
        wanted = expected(exact.intervals, self.format)[1]
        if outcome is None or hello is None:
            return Cell(topology=form, expected=wanted, says=form.label)
        cell = Cell(topology=form, expected=wanted, outcome=outcome)
        if silent := silence(outcome):
            return replace(cell, says=": ".join(silent))
        assert isinstance(outcome, Reply)
        judge = Judge(*probe, self.format, tolerance=hello.tolerance)
        said = claim(outcome, hello)
        if malformed := said.malformed(judge):
            return replace(cell, says=f"malformed: {malformed}")
        if self.show == "ulps":
            return replace(cell, value=said.forward_error(judge))
        if self.show != "k":
            words = looks(said) if self.show == "answer" else difference(said, judge)
            return replace(cell, says=words)
        if isinstance(said, Listed) and judge.format is BINARY64 and not judge.tolerance:
            k, self.guess = error(*probe, said.pairs, self.guess)
            return replace(cell, value=k)
        return replace(cell, value=said.backward_error(judge, "strict"))


def looks(said: Claim) -> str:
    match said:
        case Listed(pairs):
            return counted([a == b for a, b in pairs])
        case First(t, _):
            return "no hit" if t is None else "a first hit at 0" if t == 0 else "a first hit"
        case YesNo(hit):
            return "a hit" if hit else "no hit"
    raise TypeError(said)


def difference(said: Claim, judge: Judge) -> str:
    """Return how an answer differs from the exact one; k decides against 64, strictly."""
    if said.is_expected(judge.expected) is None:
        return EXACT
    if said.is_faithful(judge.expected, judge.enclosures) is None:
        return FAITHFUL
    given, wanted = 0, len(judge.expected)
    match said:
        case Listed(pairs):
            given = len(pairs)
        case First(t, _):
            given, wanted = t is not None, wanted > 0
        case YesNo(hit):
            given, wanted = hit, wanted > 0
    which = RIGHT if given == wanted else FEW if given < wanted else MANY
    return which + (BEYOND if said.fault(judge.accept("stable")) else WITHIN)


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
        faces = [[("=".join(end.faces) or "inf") for end in pair] for pair in self.ends]
        how = " ".join(self.rows) or "; ".join(map(" .. ".join, faces))
        met = f" ({', '.join(self.kinds)})" if self.kinds else ""
        return f"{counted(self.touches)}{': ' * bool(how)}{how}{met}"


def counted(touches: Sequence[bool]) -> str:
    """Return how many pairs a list has, and whether all of them are touches, in words."""
    if not touches:
        return "no pair"
    one = len(touches) == 1
    count = "1 pair" if one else f"{len(touches)} pairs"
    touch = "a touch" if one else "touches"
    return f"{count}, {touch}" if all(touches) else count


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
