"""Run an implementation over many questions, and pin every failure on the question that caused it.

Questions are pipelined. After a crash, a hang, a bad line or a wrong id the process is killed, and
what it had not answered is asked again one at a time. A failure is a question's own only where the
question was the first that a fresh process was asked; a failure that does not come again so is
`unrepeatable`. A value of no meaning that code in a process of ours returns is a failure too, but
one that harms no other question: nothing is killed or asked again for it.

Here: that replay. Not here: pipes and time (process.py), what is said through them (dialogue.py),
whether an answer is right.
"""

from __future__ import annotations

import json
import time
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from raycert.cases.protocol import Hello, cut
from raycert.oracle.client.dialogue import (
    Command,
    Dialogue,
    Limits,
    Outcome,
    Question,
    Target,
    Unusable,
    fresh_ids,
)
from raycert.oracle.client.process import GRACE, Broken, Failure

STARTS = 3
"""A program that gave no hello this many times in a row is not started again."""

Progress = Callable[[int], None]


@dataclass(frozen=True, slots=True)
class Run:
    """What came of a run: the outcome of each question by its id, in the order of the questions.

    Every question is there, unless the run was interrupted.
    """

    hello: Hello
    outcomes: Mapping[str, Outcome]
    restarts: int
    notes: tuple[str, ...]


class Interrupted(KeyboardInterrupt):
    """The person interrupted the run; `run` is what was known by then."""

    def __init__(self, run: Run) -> None:
        super().__init__()
        self.run = run


class Changed(Unusable):
    """The target says another hello than at first, so that it is another; `run` is of the first."""

    def __init__(self, words: str, run: Run | None = None) -> None:
        super().__init__(words)
        self.run = run


def greet(target: Sequence[str] | Target, limits: Limits | None = None) -> Hello:
    """Return what an implementation declares of itself. Raises `Unusable`."""
    dialogue = _target(target).open(limits or Limits(), fresh_ids())
    dialogue.kill()
    return dialogue.hello


def open_again(target: Target, limits: Limits, ids: Iterator[str], first: Hello | None) -> Dialogue:
    """Start a target that said this hello at first. Raises `Unusable`; `Changed` for another."""
    dialogue = target.open(limits, ids)
    if first is None or dialogue.hello == first:
        return dialogue
    dialogue.kill()
    then, now = _differing(first, dialogue.hello), _differing(dialogue.hello, first)
    raise Changed(
        f"the target became another while it was asked: its hello said {then} at first, and {now} "
        "when it was started again. What is certified is one target, so nothing more was asked."
    )


def _differing(hello: Hello, other: Hello) -> str:
    """Return the fields of a hello that another has not so, as JSON."""
    fields, others = hello.form(), other.form()
    return cut(json.dumps({name: x for name, x in fields.items() if x != others[name]}), 300)


def _target(target: Sequence[str] | Target) -> Target:
    return Command(tuple(target)) if isinstance(target, Sequence) else target


def run(
    target: Sequence[str] | Target,
    questions: Sequence[Question],
    limits: Limits | None = None,
    on_progress: Progress | None = None,
    hello: Hello | None = None,
) -> Run:
    """Ask an implementation, a command or any target, all the questions, whose ids are distinct.

    Every question gets an outcome, within bounded time. No process is left behind. `on_progress`
    is told now and then how many questions have one. Raises `Unusable` if the first start gives no
    hello, `Changed` if a start gives another one than `hello` (that of the first start, if there is
    none to compare with), and `Interrupted` on KeyboardInterrupt.
    """
    if len({question.id for question in questions}) < len(questions):
        raise ValueError("two questions have the same id")
    watch = on_progress or (lambda _: None)
    replay = Replay(_target(target), questions, limits or Limits(), watch, hello)
    try:
        replay.all()
    except Changed as changed:
        raise Changed(str(changed), replay.result()) from None
    except KeyboardInterrupt:
        raise Interrupted(replay.result()) from None
    finally:
        replay.kill()
    return replay.result()


def alone(
    target: Sequence[str] | Target, question: Question, limits: Limits, hello: Hello
) -> Outcome:
    """Return what a fresh process answers to one question. Raises `Unusable`, `Changed`."""
    dialogue = open_again(_target(target), limits, fresh_ids(), hello)
    try:
        dialogue.ask([question])
        [(_, outcome)] = dialogue.answers()
        return outcome
    except Broken as broken:
        return broken.failure
    finally:
        dialogue.kill()


class GivenUp(Exception):
    """It is no use to go on."""


class Replay:
    """The state of one run."""

    def __init__(
        self,
        target: Target,
        questions: Sequence[Question],
        limits: Limits,
        on_progress: Progress,
        hello: Hello | None = None,
    ) -> None:
        self._target, self._questions, self._limits = target, questions, limits
        self._on_progress = on_progress
        self._pending = deque(questions)
        self._outcomes: dict[str, Outcome] = {}
        self._worst = Failure("crash", "")
        self._restarts = 0
        self._in_a_row = 0
        self._lost = 0.0
        self._notes: list[str] = []
        self._ids = fresh_ids()
        self._dialogue: Dialogue | None = open_again(target, limits, self._ids, hello)
        self._hello = self._dialogue.hello

    def all(self) -> None:
        try:
            while self._pending:
                self._stream()
            self._end()
        except GivenUp as reason:
            self._abandon(str(reason))

    def result(self) -> Run:
        known = self._outcomes
        outcomes = {q.id: known[q.id] for q in self._questions if q.id in known}
        return Run(self._hello, outcomes, self._restarts, tuple(self._notes))

    def kill(self) -> None:
        dialogue, self._dialogue = self._dialogue, None
        if dialogue is not None:
            self._note(dialogue.kill())

    def _note(self, text: str) -> None:
        """Keep what is odd, if it is anything, once."""
        if text and text not in self._notes:
            self._notes.append(text)

    def _stream(self) -> None:
        """Ask the pending questions, many at a time, until all are answered or one fails."""
        dialogue = self._live()
        try:
            while self._pending or dialogue.owed:
                room = min(self._limits.window - dialogue.owed, len(self._pending))
                if room > 0:
                    dialogue.ask([self._pending.popleft() for _ in range(room)])
                for question, reply in dialogue.answers():
                    self._settle(question, reply)
                self._on_progress(len(self._outcomes))
        except Broken as broken:
            self._blame(dialogue, broken.failure)

    def _blame(self, dialogue: Dialogue, failure: Failure) -> bool:
        """Give outcomes to all that a failed process did not answer.

        Returns whether the failure of one of them came again in a fresh process.
        """
        self.kill()
        self._count_silence(failure)
        self._worst = failure
        # The one to blame is the oldest without an answer; where none is owed, it failed after its
        # last answer, which then is the one.
        before = [dialogue.last] if dialogue.last else []
        head, *rest = dialogue.unanswered or before
        if dialogue.asked == 1:  # nothing came before it: the failure is its own
            self._settle(head, failure)
            return True
        again = self._confirm(head)
        if not again and failure.kind != "hang" and before != [head]:
            # Alone the oldest does well: the failure may be an after-effect of the answer before.
            again = any(map(self._confirm, before))
        for question in rest:
            again = self._single(question) or again
        if not again:
            self._settle(head, _unrepeatable(failure))
        return again

    def _confirm(self, question: Question) -> bool:
        """Ask one question of a fresh process, to its end. Return whether that failed."""
        self.kill()
        dialogue = self._live()
        try:
            dialogue.ask([question])
            [(_, reply)] = dialogue.answers()
            dialogue.stay_quiet()
            dialogue.finish()
        except Broken as broken:
            self.kill()
            self._count_silence(broken.failure)
            self._settle(question, broken.failure)
            return True
        self._dialogue = None  # it has ended, as `finish` told it to
        self._settle(question, reply)
        return isinstance(reply, Failure)

    def _single(self, question: Question) -> bool:
        """Ask one question with no other outstanding. Return whether one failed by itself."""
        dialogue = self._live()
        try:
            dialogue.ask([question])
            [(_, reply)] = dialogue.answers()
        except Broken as broken:
            return self._blame(dialogue, broken.failure)
        self._settle(question, reply)
        self._on_progress(len(self._outcomes))
        return isinstance(reply, Failure)

    def _count_silence(self, failure: Failure) -> None:
        self._lost += self._limits.case if failure.kind == "hang" else 0.0

    def _settle(self, question: Question, outcome: Outcome) -> None:
        """Record an outcome; a later one replaces an earlier one."""
        self._outcomes[question.id] = outcome
        if isinstance(outcome, Failure) and outcome.kind != "malformed":
            self._worst = outcome
            self._in_a_row += 1
            self._on_progress(len(self._outcomes))
        else:
            self._in_a_row = 0

    def _live(self) -> Dialogue:
        """Return the running process, or a fresh one. Raises `GivenUp` and `Changed`."""
        if self._dialogue is None:
            began = time.monotonic()
            self._dialogue = self._restart()
            self._lost += time.monotonic() - began
        return self._dialogue

    def _restart(self) -> Dialogue:
        if self._in_a_row >= self._limits.in_a_row:
            raise GivenUp(f"{self._in_a_row} questions in a row had failed")
        if self._lost > self._limits.lost:
            raise GivenUp(f"{self._lost:.0f} s had gone into silence and restarts")
        seen = ""
        for _ in range(STARTS):
            self._restarts += 1
            try:
                return open_again(self._target, self._limits, self._ids, self._hello)
            except Changed:
                raise
            except Unusable as error:
                seen = str(error)
        raise GivenUp(f"{STARTS} restarts failed one after the other: {seen}")

    def _end(self) -> None:
        """Close the input of the last process, which has nothing more to say."""
        dialogue = self._dialogue
        if dialogue is None:
            return
        try:
            note = dialogue.finish(max(2 * GRACE, self._limits.case))
        except Broken as broken:
            if dialogue.last is not None:
                self._blame(dialogue, broken.failure)
            return
        self._dialogue = None
        self._note(note)

    def _abandon(self, reason: str) -> None:
        """Give all that have no outcome the kind of the last failure, and say why."""
        worst = f"the last failure was a {self._worst.kind}: {self._worst.detail}"
        rest = Failure(self._worst.kind, f"not asked to the end, as {reason}; {worst}")
        missing = [question for question in self._questions if question.id not in self._outcomes]
        for question in missing:
            self._outcomes[question.id] = rest
        self._notes.append(f"given up, {len(missing)} questions without an answer: {reason}")


def _unrepeatable(first: Failure) -> Failure:
    detail = f"this did not come again when asked alone: {first.kind}: {first.detail}"
    return Failure("unrepeatable", detail, first.line)
