"""Is an answer wrong on the level asked? Cheap for the many that are right, exact for all.

What is asked for is decided as `certify.grading` does, on cases that decide the level: the exact
list first; an answer whose ends are among the two numbers around the exact ones is `stable`; only
for others are the faces moved.

What tells two failures apart, once they are as simple as they get, is their symptom, not their
digits: the level and the kind, of an error its first words; the shape of the solid; the rows of the
case table that the exact answer takes, without the comparisons.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

from raycert.cases.accept import Accept
from raycert.cases.case import Case, Family, Tier
from raycert.cases.lattice import is_lattice
from raycert.cases.levels import Level, upto
from raycert.cases.model import (
    SOLIDS,
    Solid,
    Tree,
    type_of,
    types,
)
from raycert.cases.numbers import Probe, is_usual
from raycert.cases.protocol import Hello, Reply, convention
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.grading import grade, place_of
from raycert.oracle.client.dialogue import Outcome, silence
from raycert.oracle.corpus.golden import golden_row
from raycert.oracle.exact.faces import touch
from raycert.oracle.exact.trace import trace
from raycert.oracle.judge.answer import Claim, First, Listed, claim
from raycert.oracle.judge.decisive import decisive
from raycert.oracle.judge.levels import Judge
from raycert.oracle.judge.moved import LAST_STEP
from raycert.oracle.zoo.matrix import kind

COARSE = (8, 12, 16, 20, *range(28, LAST_STEP, 8), LAST_STEP)
"""The steps of k = 1, 4, 16, 64, 1024, ...: as near as the search has to know a backward error."""

SILENT = ("error", "crash", "unsupported", "bad-line", "unrepeated")
UNREPEATED = "unrepeated"
"""The kind of a failure that does not come again in a new process: only its words count."""


@dataclass(frozen=True, slots=True)
class Criterion:
    """When an answer fails: below a level or, on the lattice, against a convention.

    Cases of the range tier count only with `far`.
    """

    level: Level = "stable"
    convention: str | None = None
    far: bool = False


@dataclass(frozen=True, slots=True)
class Flaw:
    """How an answer fails: the first level that it fails, or `convention`; the kind; in words."""

    level: str
    kind: str
    reason: str


@dataclass(frozen=True, slots=True)
class Observation:
    """What came of a look: the flaw if there is one, about how large k is (1 where <= 1), ulps."""

    flaw: Flaw | None = None
    k: float = 1.0
    ulps: float = 0.0


@dataclass(frozen=True, slots=True)
class Looker:
    """Judges the answers of a target that said this hello, on the types of solid wanted of it."""

    hello: Hello
    criterion: Criterion
    solids: tuple[str, ...] = tuple(SOLIDS)

    def tier(self, probe: Probe) -> Tier:
        """Return the tier of a probe; the lattice's is only for a convention that is asked for."""
        if not is_usual(probe, self.hello.format):
            return "range"
        on_lattice = self.criterion.convention is not None and is_lattice(probe.solid, probe.ray)
        return "lattice" if on_lattice else "generic"

    def wants(self, probe: Probe) -> bool:
        """Whether a probe is asked: declared and wanted, its numbers usual.

        Declared are its types, its degenerate inputs, and a domain that it lies in.
        """
        names = types(probe.solid)
        if not names <= {*self.solids} & {*self.hello.solids}:
            return False
        if place_of(probe.solid, probe.ray, self.hello) != "inside":
            return False
        return self.criterion.far or is_usual(probe, self.hello.format)

    def judge(self, probe: Probe) -> Judge:
        fmt, tolerance = self.hello.format, self.hello.tolerance
        return Judge(probe.solid, probe.ray, fmt, self.tier(probe), tolerance)

    def __call__(self, probe: Probe, outcome: Outcome) -> Observation:
        if silent := silence(outcome):
            return Observation(Flaw("sound", *silent), inf)
        assert isinstance(outcome, Reply)
        said, judge = claim(outcome, self.hello), self.judge(probe)
        if isinstance(said, Listed) and said.pairs == judge.expected:
            return Observation(self._unkept(said, judge))
        if malformed := said.malformed(judge):
            return Observation(Flaw("sound", "malformed", malformed), inf)
        if unkept := self._unkept(said, judge):
            return Observation(unkept)
        if said.is_faithful(judge.expected, judge.enclosures) is None:
            asked = self.criterion.level == "exact"
            return Observation(self._finer(probe, outcome) if asked else None)
        k = coarse_k(said, judge)
        flaw = self._gross(said, judge)
        if flaw is None and self.criterion.level in ("faithful", "exact"):
            flaw = self._finer(probe, outcome)
        return Observation(flaw, k, said.forward_error(judge))

    def _unkept(self, said: Claim, judge: Judge) -> Flaw | None:
        wanted = self.criterion.convention
        if judge.tier != "lattice" or wanted is None or isinstance(judge.solid, Tree):
            return None
        touches = (touch(interval, judge.solid, judge.ray) for interval in judge.exact)
        name = next(filter(None, touches), None)
        kept = said.keeps_touch(judge.expected) if name else None
        if name is None or kept is None or convention(wanted)[name] in (None, kept):
            return None
        how = "kept" if kept else "dropped"
        return Flaw("convention", f"touch {how}", f"a touch ({name}) is {how}")

    def _gross(self, said: Claim, judge: Judge) -> Flaw | None:
        """Return how an answer fails `sound` or `stable`, as far as they are asked."""
        flaw, decides = None, None
        levels: tuple[Level, ...] = ("stable", "sound")  # what is stable is sound
        for level in levels if self.criterion.level != "sound" else levels[1:]:
            accept = judge.accept(level)
            reason = said.fault(accept)
            if not reason:
                break
            decides = decides or decisive(judge)
            flaw = Flaw(level, how(said, accept), reason) if level in decides else flaw
        return flaw

    def _finer(self, probe: Probe, outcome: Outcome) -> Flaw | None:
        """Return how an answer fails `faithful` or `exact`, where it is stable."""
        graded = grade(self.row(probe, "hunt/case", "A hunt."), outcome, self.hello)
        for level in upto(self.criterion.level):
            if reason := graded.fault(level):
                pairs, wanted = len(graded.answer or ()), len(graded.row.expected)
                shape = "missed" if pairs < wanted else "phantom" if pairs > wanted else "wrong end"
                return Flaw(level, shape, reason)
        return None

    def row(self, probe: Probe, id: str, why: str, witnesses: Sequence[str] = ()) -> GoldenRow:
        """Return the golden row of a probe. Raises `Contradiction` where a witness differs."""
        family, _, slug = id.partition("/")
        case = Case(slug, why, probe.solid, probe.ray, self.tier(probe))
        return golden_row(Family(family, "", lambda _: ()), case, self.hello.format, witnesses)

    def true_k(self, probe: Probe, outcome: Outcome) -> float:
        """Return the strict backward error of an answer; 0 where the probe does not decide."""
        if not isinstance(outcome, Reply) or silence(outcome):
            return inf
        judge = self.judge(probe)
        if "stable" not in decisive(judge):
            return 0.0
        return claim(outcome, self.hello).backward_error(judge, "strict")


def coarse_k(said: Claim, judge: Judge) -> float:
    """Return k rounded up to one of a few: what most answers cost is one comparison."""
    if not isinstance(said, Listed):
        return max(said.backward_error(judge, "strict"), 1.0)
    pairs = said.pairs
    first = next((step for step in COARSE if judge.accepts(pairs, step, "strict")), None)
    return inf if first is None else 2.0 ** (first // 2 - 4)


def how(said: Claim, accept: Accept) -> str:
    if isinstance(said, Listed):
        return kind(accept.outer, accept.inner, said.pairs)
    if isinstance(said, First):
        if said.t is None:
            return "missed"
        return "wrong end" if accept.outer else "phantom"
    return "phantom" if accept.inner == () else "missed"


@dataclass(frozen=True, slots=True)
class Symptom:
    """A key: failures with the same one count as one."""

    level: str
    kind: str
    words: str
    shape: str
    rows: tuple[str, ...]

    def __str__(self) -> str:
        where = f" ({' '.join(self.rows)})" if self.rows else ""
        return f"{self.kind} on {self.shape}{where}"


def symptom(probe: Probe, flaw: Flaw) -> Symptom:
    first = re.sub(r"[^A-Za-z ]+", " ", flaw.reason).split()[:4] if flaw.kind in SILENT else []
    words = " ".join(first)
    if flaw.kind == UNREPEATED:
        return Symptom(flaw.level, flaw.kind, words, "any solid", ())
    return Symptom(flaw.level, flaw.kind, words, shape(probe.solid), rows_taken(probe))


def shape(solid: Solid) -> str:
    """Return the types of a solid and its parts: `difference(sphere, slab)`."""
    if isinstance(solid, Tree):
        return f"{type_of(solid)}({', '.join(shape(part) for part in solid.of)})"
    return type_of(solid)


def rows_taken(probe: Probe) -> tuple[str, ...]:
    """Return the rows that the exact answer takes, each once, without paths and comparisons."""
    names = (name.rpartition(":")[2] for name in trace(probe.solid, probe.ray).rows)
    return tuple(sorted({name for name in names if not re.search("[<>=]", name)}))
