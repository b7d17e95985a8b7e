"""Every cell of a map: its exact answer, the implementation's, and how far that is right.

Cells are taken from the middle outward, so that an interrupted map is a smaller one of the same
case. The implementation is asked first, all cells in one run; then each cell is answered exactly
and compared. Nothing is compared by a float but numbers that are answers themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from typing import Literal

from raycert.cases.accept import Numbers
from raycert.cases.formats import BINARY64
from raycert.cases.model import Refused, types
from raycert.cases.protocol import Hello, Reply
from raycert.oracle.client.dialogue import Limits, Outcome, Question, Target, Unusable
from raycert.oracle.client.process import Failure
from raycert.oracle.client.replay import Interrupted, greet, run
from raycert.oracle.judge.answer import Claim, First, Listed, YesNo, claim
from raycert.oracle.judge.levels import Judge
from raycert.oracle.judge.pixels import error
from raycert.oracle.map.inputs import Case
from raycert.oracle.map.plan import At, Plan
from raycert.oracle.map.topology import Topology, counted, rounded, topology

Show = Literal["exact", "answer", "k", "ulps", "disagreement"]
SHOWS: tuple[Show, ...] = ("exact", "answer", "k", "ulps", "disagreement")
NUMBERS = ("k", "ulps")
EXACT, FAITHFUL = "the exact list, rounded", "each number next to the exact one"
RIGHT, FEW, MANY = "as many pairs", "too few pairs", "too many pairs"
WITHIN, BEYOND = ", k <= 64", ", k > 64"
Counting = Callable[[str, int], AbstractContextManager[Callable[..., None]]]


class Unfit(Unusable):
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
    """The cells of a plan, by their places; all of them unless the map was interrupted."""

    plan: Plan
    show: Show
    hello: Hello | None = None
    cells: dict[At, Cell] = field(default_factory=dict)

    @property
    def whole(self) -> bool:
        """Tell whether every cell is there."""
        return len(self.cells) == len(self.plan.places)


def sample(
    plan: Plan,
    show: Show,
    target: Target | None = None,
    limits: Limits | None = None,
    counting: Counting = _silent,
) -> Map:
    """Return the map of a plan. On KeyboardInterrupt it has the cells that were finished.

    Everything but `exact` needs a target. Raises `Unusable`, and `Unfit` where the target does not
    take the solid or the format.
    """
    made = [(at, _made(plan, at)) for at in plan.places]
    hello, outcomes = None, dict[str, Outcome]()
    if show != "exact":
        assert target is not None
        hello = greet(target, limits)
        _check(hello, plan)
        outcomes = _asked(target, made, limits, counting)
    found = Map(plan, show, hello)
    measure = Measure(show, hello)
    try:
        with counting("comparing", len(made)) as advance:
            for at, case in made:
                if isinstance(case, Refused):
                    found.cells[at] = Cell(refused=str(case))
                elif hello is None or name(at) in outcomes:
                    found.cells[at] = measure(case, outcomes.get(name(at)), plan)
                advance()
    except KeyboardInterrupt:
        pass
    return found


def name(at: At) -> str:
    """Return the id of a cell's question."""
    return f"{at[0]},{at[1]}"


def _made(plan: Plan, at: At) -> Case | Refused:
    try:
        return plan.case(at)
    except Refused as refusal:
        return refusal


def _check(hello: Hello, plan: Plan) -> None:
    fmt = plan.inputs.format
    if hello.precision != fmt.name:
        raise Unfit(f"the target is of {hello.precision}, the case of {fmt.name}")
    solid, _ = plan.inputs.case({})
    if missing := sorted(types(solid) - {*hello.solids}):
        raise Unfit(f"the target declares no {', '.join(missing)}")


def _asked(
    target: Target,
    made: list[tuple[At, Case | Refused]],
    limits: Limits | None,
    counting: Counting,
) -> dict[str, Outcome]:
    """Return what the target answered, by the ids; what was known by then if interrupted."""
    questions = [Question(name(at), *case) for at, case in made if not isinstance(case, Refused)]
    done = 0
    with counting("asking", len(questions)) as advance:

        def on_progress(known: int) -> None:
            nonlocal done
            advance(known - done)
            done = known

        try:
            return dict(run(target, questions, limits, on_progress).outcomes)
        except Interrupted as interrupted:
            return dict(interrupted.run.outcomes)


class Measure:
    """Answers cells exactly and compares; remembers the step of the last k as a guess."""

    def __init__(self, show: Show, hello: Hello | None) -> None:
        """Prepare for the answers of a target that said this hello; None if there is none."""
        self._show, self._hello = show, hello
        self._guess = 0

    def __call__(self, case: Case, outcome: Outcome | None, plan: Plan) -> Cell:
        """Return the cell of a case and what was answered to it."""
        fmt, hello = plan.inputs.format, self._hello
        form, exact = topology(case)
        wanted = rounded(exact, fmt)
        if outcome is None or hello is None:
            return Cell(topology=form, expected=wanted, says=form.label)
        judge = Judge(*case, fmt, tolerance=hello.tolerance)
        silent = _silence(outcome)
        if silent or not isinstance(outcome, Reply):
            return Cell("", form, wanted, outcome, None, silent)
        said = claim(outcome, hello)
        if malformed := said.malformed(judge):
            return Cell("", form, wanted, outcome, None, f"malformed: {malformed}")
        match self._show:
            case "k":
                return Cell("", form, wanted, outcome, self._k(said, case, judge))
            case "ulps":
                return Cell("", form, wanted, outcome, said.forward_error(judge))
            case "answer":
                return Cell("", form, wanted, outcome, None, looks(said))
        return Cell("", form, wanted, outcome, None, difference(said, judge))

    def _k(self, said: Claim, case: Case, judge: Judge) -> float:
        """Return the strict backward error."""
        if isinstance(said, Listed) and judge.format is BINARY64 and not judge.tolerance:
            k, self._guess = error(*case, said.pairs, self._guess)
            return k
        return said.backward_error(judge, "strict")


def _silence(outcome: Outcome) -> str:
    """Return why there is no answer; empty if there is one."""
    if isinstance(outcome, Failure):
        return f"{outcome.kind}: {outcome.detail}"
    if outcome.unsupported is not None:
        return f"unsupported: {outcome.unsupported}"
    return "" if outcome.error is None else f"error: {outcome.error}"


def looks(said: Claim) -> str:
    """Return the form of an answer, as far as it tells one."""
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
