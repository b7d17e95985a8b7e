"""Is an answer wrong on the level asked? Cheap for the many that are right, exact for all.

What is asked for is decided as `certify.grading` does, on cases that decide the level: the exact
list first; an answer whose ends are among the two numbers around the exact ones is `stable`; only
for others are the faces moved.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from raycert.cases.accept import Accept
from raycert.cases.case import Case, Family, Tier
from raycert.cases.lattice import is_lattice
from raycert.cases.levels import LEVELS, Level, upto
from raycert.cases.model import (
    SOLIDS,
    HalfSpace,
    Leaf,
    Ray,
    Sphere,
    Tree,
    leaves,
    types,
)
from raycert.cases.numbers import Probe, is_usual
from raycert.cases.protocol import Hello, Reply, convention
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import grade
from raycert.oracle.client.dialogue import Outcome
from raycert.oracle.client.process import Failure
from raycert.oracle.corpus.golden import golden_row
from raycert.oracle.exact.faces import touch
from raycert.oracle.judge.answer import Claim, First, Listed, claim
from raycert.oracle.judge.decisive import decisive
from raycert.oracle.judge.levels import Judge
from raycert.oracle.judge.moved import LAST_STEP
from raycert.oracle.zoo.matrix import kind

COARSE = (8, 12, 16, 20, *range(28, LAST_STEP, 8), LAST_STEP)
"""The steps of k = 1, 4, 16, 64, 1024, ...: as near as the search has to know a backward error."""


@dataclass(frozen=True, slots=True)
class Asked:
    """What is a failure: of a level, of a convention on the lattice if one is asked for.

    Cases of the range tier count only with `far`.
    """

    level: Level = "stable"
    convention: str | None = None
    far: bool = False


@dataclass(frozen=True, slots=True)
class Fault:
    """How an answer fails: the first level that it fails, or `convention`; the kind; in words."""

    level: str
    kind: str
    reason: str


@dataclass(frozen=True, slots=True)
class Seen:
    """What came of a look: the fault if there is one, about how large k is (1 where <= 1), ulps."""

    fault: Fault | None = None
    k: float = 1.0
    ulps: float = 0.0


RIGHT = Seen()


@dataclass(frozen=True, slots=True)
class Looker:
    """Judges the answers of a target that said this hello, on the types of solid wanted of it."""

    hello: Hello
    asked: Asked
    solids: tuple[str, ...] = tuple(SOLIDS)

    def tier(self, probe: Probe) -> Tier:
        """Return the tier of a probe; the lattice's is only for a convention that is asked for."""
        if not is_usual(probe, self.hello.format):
            return "range"
        on_lattice = self.asked.convention is not None and is_lattice(probe.solid, probe.ray)
        return "lattice" if on_lattice else "generic"

    def wants(self, probe: Probe) -> bool:
        """Tell whether a probe is asked: its types are declared and wanted, its numbers usual."""
        names = types(probe.solid)
        if not names <= {*self.solids} & {*self.hello.solids}:
            return False
        return self.asked.far or is_usual(probe, self.hello.format)

    def judge(self, probe: Probe) -> Judge:
        """Return the judge of a probe."""
        fmt, tolerance = self.hello.format, self.hello.tolerance
        return Judge(probe.solid, probe.ray, fmt, self.tier(probe), tolerance)

    def __call__(self, probe: Probe, outcome: Outcome) -> Seen:
        """Return what comes of a look at an answer."""
        silent = _silence(outcome)
        if silent:
            return Seen(silent, inf)
        assert isinstance(outcome, Reply)
        said, judge = claim(outcome, self.hello), self.judge(probe)
        if isinstance(said, Listed) and said.pairs == judge.expected:
            return RIGHT if self.asked.convention is None else Seen(self._unkept(said, judge))
        malformed = said.malformed(judge)
        if malformed:
            return Seen(Fault("sound", "malformed", malformed), inf)
        if unkept := self._unkept(said, judge):
            return Seen(unkept)
        if said.is_faithful(judge.expected, judge.enclosures) is None:
            return Seen(self._finer(probe, outcome)) if self.asked.level == "exact" else RIGHT
        k = coarse_k(said, judge)
        fault = self._gross(said, judge)
        if fault is None and LEVELS.index(self.asked.level) > LEVELS.index("stable"):
            fault = self._finer(probe, outcome)
        return Seen(fault, k, said.forward_error(judge))

    def _unkept(self, said: Claim, judge: Judge) -> Fault | None:
        """Return the fault of a touch kept or dropped against the convention asked for."""
        if (
            judge.tier != "lattice"
            or self.asked.convention is None
            or isinstance(judge.solid, Tree)
        ):
            return None
        touches = [touch(interval, judge.solid, judge.ray) for interval in judge.exact]
        name = next((name for name in touches if name), None)
        kept = said.keeps_touch(judge.expected) if name else None
        if name is None or kept is None or kept == convention(self.asked.convention)[name]:
            return None
        how = "kept" if kept else "dropped"
        return Fault("convention", f"touch {how}", f"a touch ({name}) is {how}")

    def _gross(self, said: Claim, judge: Judge) -> Fault | None:
        """Return how an answer fails `sound` or `stable`, as far as they are asked."""
        upto: tuple[Level, ...] = ("sound",) if self.asked.level == "sound" else ("stable", "sound")
        failed: list[tuple[Level, Accept, str]] = []
        for level in upto:  # what is stable is sound
            accept = judge.accept(level)
            reason = said.fault(accept)
            if not reason:
                break
            failed.append((level, accept, reason))
        if not failed:
            return None
        decides = deciding(judge)
        for level, accept, reason in reversed(failed):
            if level in decides:
                return Fault(level, how(said, accept), reason)
        return None

    def _finer(self, probe: Probe, outcome: Outcome) -> Fault | None:
        """Return how an answer fails `faithful` or `exact`, where it is stable."""
        graded = grade(row(probe, self), outcome, self.hello)
        for level in upto(self.asked.level):
            if reason := graded.fault(level):
                pairs, wanted = len(graded.answer or ()), len(graded.row.expected)
                shape = "missed" if pairs < wanted else "phantom" if pairs > wanted else "wrong end"
                return Fault(level, shape, reason)
        return None

    def true_k(self, probe: Probe, outcome: Outcome) -> float:
        """Return the strict backward error of an answer; 0 where the probe does not decide."""
        if not isinstance(outcome, Reply) or _silence(outcome):
            return inf
        judge = self.judge(probe)
        if "stable" not in deciding(judge):
            return 0.0
        return claim(outcome, self.hello).backward_error(judge, "strict")


def row(probe: Probe, looker: Looker) -> GoldenRow:
    """Return the golden row of a probe, without witnesses."""
    case = Case("case", "A case of a hunt.", probe.solid, probe.ray, looker.tier(probe))
    return golden_row(Family("hunt", "", lambda _: ()), case, looker.hello.format)


def deciding(judge: Judge) -> tuple[Level, ...]:
    """Return the levels that a case decides; a coarse tolerance takes some away.

    So does a start on a face among numbers that are all 0, where no face moves: to keep or drop
    what is touched there is a convention.
    """
    coarse = judge.tolerance and not judge.scene.tolerance_is_fine()
    if coarse or any(_is_pinned(leaf, judge.ray) for _, leaf in leaves(judge.solid)):
        return ("faithful", "exact")
    return decisive(judge)


def _is_pinned(leaf: Leaf, ray: Ray) -> bool:
    """Tell whether a leaf has no size where the ray starts on it."""
    match leaf:
        case HalfSpace(point, _):
            return not any((*point, *ray.origin))
        case Sphere(center, radius):
            return not any((*center, radius, *ray.origin))
    return False


def coarse_k(said: Claim, judge: Judge) -> float:
    """Return k rounded up to one of a few: what most answers cost is one comparison."""
    if not isinstance(said, Listed):
        return max(said.backward_error(judge, "strict"), 1.0)
    pairs = said.pairs
    found = next((step for step in COARSE if judge.accepts(pairs, step, "strict")), None)
    return inf if found is None else 2.0 ** (found // 2 - 4)


def how(said: Claim, accept: Accept) -> str:
    """Return the kind of a gross fault."""
    if isinstance(said, Listed):
        return kind(accept.outer, accept.inner, said.pairs)
    if isinstance(said, First):
        if said.t is None:
            return "missed"
        return "wrong end" if accept.outer else "phantom"
    return "phantom" if accept.inner == () else "missed"


def _silence(outcome: Outcome) -> Fault | None:
    """Return the fault of an outcome that is no answer."""
    if isinstance(outcome, Failure):
        return Fault("sound", outcome.kind, outcome.detail)
    for name in ("error", "unsupported"):
        if (text := getattr(outcome, name)) is not None:
            return Fault("sound", name, text)
    return None
