"""A certification from plan to result: greet, select, ask the easy cases, ask, judge.

The command, the pytest plugin and others share it. Nothing is printed and nothing written: what a
person may want to see while it runs goes through a `Watch`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path

from raycert.cases.corpus import GOLDEN, Corpus, read_corpus
from raycert.cases.interrupts import interruptible
from raycert.cases.levels import Level
from raycert.cases.protocol import Hello
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.again import MOST, PART, Again, ask_again
from raycert.oracle.certify.certificate import Json, Ran, Request, certificate
from raycert.oracle.certify.diagnosis import contradictions, diagnose
from raycert.oracle.certify.environment import environment
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.certify.habits import habits
from raycert.oracle.certify.known import Expectations, Matched, failed_level, match, record
from raycert.oracle.certify.measured import measured
from raycert.oracle.certify.selection import Left, Selection, able, select
from raycert.oracle.certify.verdict import Verdict, verdict
from raycert.oracle.client.adapter import adapter_faults, misread
from raycert.oracle.client.declared import Declared
from raycert.oracle.client.dialogue import Limits, Outcome, Question, Target, Unusable
from raycert.oracle.client.process import Failure
from raycert.oracle.client.replay import Changed, Interrupted, alone, greet
from raycert.oracle.client.replay import run as ask
from raycert.oracle.client.smoke import easy, fallen
from raycert.oracle.client.smoke import limits as soon
from raycert.oracle.corpus.fresh import Fresh, fresh_rows

BLOCK = 256
"""Questions that are asked before the answers are judged, where the first failure ends the run."""

Advance = Callable[..., None]
Counting = Callable[[str, int], AbstractContextManager[Advance]]


class Unsuitable(Exception):
    """Nothing was tested: no row for what is declared, or not one easy case answered."""


class NotInCorpus(ValueError):
    """A selection names what there is not; the text lists it."""


@contextmanager
def _silent(_verb: str, _total: int) -> Iterator[Advance]:
    yield lambda n=1: None


@dataclass(frozen=True, slots=True)
class Watch:
    """Who looks on. `counting(verb, total)` gives a context of `advance(n=1)`.

    `note` is told at once what is wrong with the adapter; the result has it too.
    """

    counting: Counting = _silent
    note: Callable[[str], None] = lambda _: None


@dataclass(frozen=True, slots=True)
class Plan:
    """What to certify, on which rows, for what.

    `fail_fast` ends the run soon after the first row that fails the level; the result is then
    marked as interrupted.
    """

    target: Sequence[str] | Target
    level: Level = "sound"
    convention: str = "closed"
    selection: Selection = field(default_factory=Selection)
    limits: Limits = field(default_factory=Limits)
    golden: Path = GOLDEN
    fresh: Fresh | None = None
    fail_fast: bool = False

    def request(self, command: Sequence[str]) -> Request:
        """Return what is asked; `command` are the words that name the target to a person."""
        narrowed, drawn = self.selection.options(), self.fresh.options() if self.fresh else ()
        other = () if self.golden == GOLDEN else ("--golden", str(self.golden))
        asked = (self.level, self.convention, tuple(command), narrowed, drawn, other)
        if not isinstance(self.target, Declared):
            return Request(*asked)
        return Request(*asked, ("--hello", self.target.file), tuple(self.target.fields))


@dataclass(frozen=True, slots=True)
class Prepared:
    """A plan whose target has said hello: the rows to ask, and those left.

    `known` are all rows that could be asked of it, outside the selection too.
    """

    plan: Plan
    hello: Hello
    corpus: Corpus
    rows: tuple[GoldenRow, ...]
    left: Left
    known: tuple[GoldenRow, ...]

    def only(self, families: Sequence[str]) -> Prepared:
        rows = tuple(row for row in self.rows if row.family in families)
        more = len(self.rows) - len(rows)
        plan = replace(self.plan, selection=replace(self.plan.selection, families=tuple(families)))
        left = Left(self.left.solids, self.left.rows + more)
        return replace(self, plan=plan, rows=rows, left=left)


@dataclass(frozen=True, slots=True)
class Result:
    """What came of a run. `changed` says how the target became another, where that ended it."""

    prepared: Prepared
    grades: tuple[Grade, ...]
    ran: Ran
    verdict: Verdict
    changed: str = ""

    def matched(self, expectations: Expectations) -> Matched:
        plan = self.prepared.plan
        return match(expectations, self.grades, plan.level, plan.convention, self.prepared.known)

    def recorded(self, old: Expectations | None = None) -> Expectations:
        """Return the expectations that accept this run; the old ones that hold are kept."""
        plan, version, known = self.prepared.plan, self.prepared.corpus.version, self.prepared.known
        return record(self.grades, plan.level, plan.convention, version, old, known)

    def form(self, command: Sequence[str], expectations: Json | None = None) -> Json:
        """Return the certificate.

        `command` are the words that name the target to a person, `expectations` what
        `Matched.as_json` says.
        """
        plan, prepared = self.prepared.plan, self.prepared
        shard, fresh = plan.selection.shard, plan.fresh
        return certificate(
            plan.request(command),
            prepared.hello,
            prepared.corpus,
            self.grades,
            prepared.left,
            self.ran,
            self.verdict,
            environment(),
            expectations,
            shard=None if shard is None else str(shard),
            fresh=None if fresh is None else {"seed": fresh.seed, "rows": fresh.count},
        )


@interruptible()
def prepare(plan: Plan) -> Prepared:
    """Greet the target and choose the rows.

    Raises `Unusable` (no hello), `BadFile`, `NotInCorpus` and `Unsuitable` (no rows).
    """
    hello, fresh = greet(plan.target, plan.limits), tuple[GoldenRow, ...]()
    corpus = read_corpus(hello.precision, plan.golden, hello.solids)
    if not corpus.headings:
        raise Unsuitable(f"there are no rows in {hello.precision} in {plan.golden}")
    if plan.fresh:
        fresh = fresh_rows(plan.fresh.seed, plan.fresh.count, hello.format, hello.solids)
    if absent := plan.selection.missing(corpus, fresh):
        raise NotInCorpus(f"not in the corpus: {', '.join(absent)}")
    rows, left = select(corpus, hello, plan.selection, fresh)
    if not rows:
        raise Unsuitable(f"nothing to test: the target declares {', '.join(hello.solids)}")
    known = tuple(able((*corpus.rows, *fresh), hello))
    return Prepared(plan, hello, corpus, tuple(rows), left, known)


def certify(plan: Plan, watch: Watch | None = None) -> Result:
    """Return what came of a plan. Raises what `prepare` and `conduct` raise."""
    return conduct(prepare(plan), watch)


def conduct(prepared: Prepared, watch: Watch | None = None) -> Result:
    """Ask the easy cases, then every row, and judge the answers.

    On KeyboardInterrupt what is known is kept, and the result marked. Raises `Unusable`, and
    `Unsuitable` where not one easy case is answered.
    """
    watch, plan = watch or Watch(), prepared.plan
    began, clock = datetime.now(UTC).isoformat(timespec="seconds"), time.monotonic()
    answers = _Answers(prepared, watch)
    size = BLOCK if plan.fail_fast else len(prepared.rows)
    for start in range(0, len(prepared.rows), size):
        if not answers.stopped:
            answers.add(prepared.rows[start : start + size])
    grades = tuple(answers.grades)
    again = answers.ask_again((time.monotonic() - clock) * PART)
    seen = *again.notes, *habits(grades), *contradictions(prepared.hello, grades)
    said = dict.fromkeys((*answers.notes, *seen))
    ran = Ran(
        restarts=answers.restarts,
        notes=tuple(said),
        seconds=round(time.monotonic() - clock, 3),
        interrupted=answers.stopped,
        began=began,
        diagnosis={
            "likely": diagnose(grades) if any(g.faults for g in grades) else [],
            "easy": answers.easy,
            "state": again.form(),
        },
    )
    words = prepared.hello.domain.words()
    found = verdict(grades, plan.level, plan.convention, words)
    found = replace(found, reasons=(*found.reasons, *again.reasons))
    return Result(prepared, grades, ran, found, answers.changed)


def smoke(plan: Plan, hello: Hello, watch: Watch) -> tuple[list[str], list[Json]]:
    """Ask the easy cases; return what is wrong with the adapter, and which of them fail.

    Raises `Unsuitable` if it answers none of them.
    """
    cases = easy(hello)
    questions = [case.question for case in cases]
    outcomes = ask(plan.target, questions, soon(plan.limits), hello=hello).outcomes
    said = adapter_faults(cases, outcomes, hello, plan.target)
    found = fallen(cases, outcomes, hello)
    for line in said or misread(found):
        watch.note(line)
    if cases and all(_unanswered(outcome) for outcome in outcomes.values()):
        raise Unsuitable("none of the easy cases was answered, so nothing was tested")
    return said, [each.form(hello) for each in found]


def _unanswered(outcome: Outcome) -> bool:
    return isinstance(outcome, Failure) and outcome.kind != "malformed"


class _Answers:
    """What is known of a run so far."""

    def __init__(self, prepared: Prepared, watch: Watch) -> None:
        """Ask the easy cases."""
        self.grades: list[Grade] = []
        self.notes: list[str] = []
        self.easy: list[Json] = []
        self.restarts = 0
        self.stopped = False
        self.changed = ""
        self._prepared, self._watch = prepared, watch
        try:
            with interruptible():
                self.notes, self.easy = smoke(prepared.plan, prepared.hello, watch)
        except KeyboardInterrupt:
            self.stopped = True

    def add(self, rows: Sequence[GoldenRow]) -> None:
        self._judge(rows, self._ask(rows))
        plan, rest = self._prepared.plan, len(self._prepared.rows) - len(self.grades)
        failing = (g.row.id for g in self.grades if failed_level(g, plan.level))
        if plan.fail_fast and not self.stopped and (first := next(failing, None)):
            self.stopped = rest > 0
            note = f"ended early, at {first}, the first row that fails: {rest} not asked"
            self.notes.append(note)

    def ask_again(self, seconds: float) -> Again:
        """Ask failing rows again, each alone; nothing where a lone row was asked, or it ended."""
        plan, hello, grades = self._prepared.plan, self._prepared.hello, self.grades
        if self.stopped or len(grades) < 2:
            return Again()
        with self._watch.counting("asking again", MOST) as advance:

            def ask_alone(question: Question) -> Outcome:
                return alone(plan.target, question, plan.limits, hello)

            try:
                with interruptible():
                    return ask_again(grades, plan.level, hello, ask_alone, seconds, advance)
            except KeyboardInterrupt:
                self.stopped = True
            except Unusable as error:
                self.notes.append(f"no failing row could be asked again: {error}")
        return Again()

    def _ask(self, rows: Sequence[GoldenRow]) -> dict[str, Outcome]:
        plan, hello, done = self._prepared.plan, self._prepared.hello, 0
        # What is wrong with the end of a session is pinned on its last question, which has to count
        # then: no failure of the range tier does.
        in_order = sorted(rows, key=lambda row: row.tier != "range")
        questions = [Question(row.id, row.solid, row.ray) for row in in_order]
        with self._watch.counting("asking", len(rows)) as advance:

            def on_progress(known: int) -> None:
                nonlocal done
                advance(known - done)
                done = known

            try:
                with interruptible():
                    ran = ask(plan.target, questions, plan.limits, on_progress, hello)
            except Interrupted as interrupted:
                ran, self.stopped = interrupted.run, True
            except KeyboardInterrupt:
                self.stopped = True
                return {}
            except Changed as changed:
                if changed.run is None:
                    raise
                ran, self.stopped, self.changed = changed.run, True, str(changed)
                self.notes.append(self.changed)
        self.restarts += ran.restarts
        self.notes += ran.notes
        return dict(ran.outcomes)

    def _judge(self, rows: Sequence[GoldenRow], outcomes: dict[str, Outcome]) -> None:
        answered = [row for row in rows if row.id in outcomes]
        with self._watch.counting("judging", len(answered)) as advance:
            try:
                with interruptible():
                    known = len(self.grades)
                    for row in answered:
                        self.grades.append(grade(row, outcomes[row.id], self._prepared.hello))
                    graded = self.grades[known:]
                    del self.grades[known:]
                    for one in measured(graded):
                        self.grades.append(one)
                        advance()
            except KeyboardInterrupt:
                self.stopped = True
