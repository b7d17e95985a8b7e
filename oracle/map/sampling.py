"""Every cell of a map: its exact answer, the implementation's, and how far that is right.

Cells are taken from the middle outward, so that an interrupted map is a smaller one of the same
case. The implementation is asked first, all cells in one run; then each cell is answered exactly
and compared. Nothing is compared by a float but numbers that are answers themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field, replace
from typing import Literal, get_args

from raycert.cases.accept import Numbers
from raycert.cases.formats import BINARY64, Format
from raycert.cases.model import Refused, types
from raycert.cases.numbers import Probe
from raycert.cases.protocol import Hello, Reply
from raycert.oracle.client.dialogue import Limits, Outcome, Question, Target, Unusable, silence
from raycert.oracle.client.replay import Interrupted, greet, run
from raycert.oracle.exact.intervals import expected
from raycert.oracle.judge.answer import Claim, First, Listed, YesNo, claim
from raycert.oracle.judge.levels import Judge
from raycert.oracle.judge.pixels import error
from raycert.oracle.map.raster import At, Raster
from raycert.oracle.map.topology import Topology, counted, topology

Show = Literal["exact", "answer", "k", "ulps", "disagreement"]
SHOWS: tuple[Show, ...] = get_args(Show)
NUMBERS = ("k", "ulps")
EXACT, FAITHFUL = "the exact list, rounded", "each number next to the exact one"
RIGHT, FEW, MANY = "as many pairs", "too few pairs", "too many pairs"
WITHIN, BEYOND = ", k <= 64", ", k > 64"
Counting = Callable[[str, int], AbstractContextManager[Callable[..., None]]]


class Mismatch(Unusable):
    """The implementation cannot be asked this case: what it declares excludes it."""


@contextmanager
def _silent(_verb: str, _total: int) -> Iterator[Callable[..., None]]:
    yield lambda n=1: None


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
        """Whether every cell is there."""
        return len(self.cells) == len(self.raster.places)


def sample(
    raster: Raster,
    show: Show,
    target: Target | None = None,
    limits: Limits | None = None,
    counting: Counting = _silent,
) -> Map:
    """Return the map of a raster. On KeyboardInterrupt it has the cells that were finished.

    Everything but `exact` needs a target. Raises `Unusable`; `Mismatch` where the target does not
    take the solid or the format.
    """
    probes = {at: _probe(raster, at) for at in raster.places}
    hello, outcomes = None, dict[At, Outcome]()
    if show != "exact":
        assert target is not None
        hello = greet(target, limits)
        _check(hello, raster)
        outcomes = _asked(target, probes, limits, counting)
    found = Map(raster, show, hello)
    compare = Comparison(show, hello, raster.inputs.format)
    try:
        with counting("comparing", len(probes)) as advance:
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
    target: Target, probes: dict[At, Probe | Refused], limits: Limits | None, counting: Counting
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
            outcomes = run(target, questions, limits, on_progress).outcomes
        except Interrupted as interrupted:
            outcomes = interrupted.run.outcomes
    return {places[id]: outcome for id, outcome in outcomes.items()}


class Comparison:
    """Answers cells exactly and compares; remembers the step of the last k as a guess."""

    def __init__(self, show: Show, hello: Hello | None, fmt: Format) -> None:
        self._show, self._hello, self._format = show, hello, fmt
        self._guess = 0

    def __call__(self, probe: Probe, outcome: Outcome | None) -> Cell:
        hello = self._hello
        form, exact = topology(probe)
        wanted = expected(exact.intervals, self._format)[1]
        if outcome is None or hello is None:
            return Cell(topology=form, expected=wanted, says=form.label)
        cell = Cell(topology=form, expected=wanted, outcome=outcome)
        if silent := silence(outcome):
            return replace(cell, says=": ".join(silent))
        assert isinstance(outcome, Reply)
        judge = Judge(*probe, self._format, tolerance=hello.tolerance)
        said = claim(outcome, hello)
        if malformed := said.malformed(judge):
            return replace(cell, says=f"malformed: {malformed}")
        match self._show:
            case "k":
                return replace(cell, value=self._k(said, judge))
            case "ulps":
                return replace(cell, value=said.forward_error(judge))
            case "answer":
                return replace(cell, says=looks(said))
        return replace(cell, says=difference(said, judge))

    def _k(self, said: Claim, judge: Judge) -> float:
        if isinstance(said, Listed) and judge.format is BINARY64 and not judge.tolerance:
            k, self._guess = error(judge.solid, judge.ray, said.pairs, self._guess)
            return k
        return said.backward_error(judge, "strict")


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
    given, wanted = (
        (len(said.pairs), len(judge.expected))
        if isinstance(said, Listed)
        else (bool(_hits(said)), bool(judge.expected))
    )
    which = RIGHT if given == wanted else FEW if given < wanted else MANY
    return which + (BEYOND if said.fault(judge.accept("stable")) else WITHIN)


def _hits(said: Claim) -> bool:
    return said.hit if isinstance(said, YesNo) else isinstance(said, First) and said.t is not None
