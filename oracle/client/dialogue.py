"""What a dialogue with a target is: questions to it, answers in order, whatever it is made of.

Two kinds of target open one: a program that speaks the line protocol (`Command`, here: its hello,
one line a question, one line an answer), and code that is loaded into a process of ours
(inprocess.py). Here: what is owed, and how it ends. Not here: what follows a failure (replay.py).
"""

from __future__ import annotations

import secrets
import shlex
import time
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import (
    LINE,
    VERSION,
    BadLine,
    Hello,
    Reply,
    TooMany,
    ask,
    encode,
    most_pairs,
    read_hello,
    read_reply,
)
from raycert.oracle.client.process import GRACE, UNREAD, Broken, Failure, Process, shown

Outcome = Reply | Failure
LEFT = "a process that it started has left its session and may still run: end it by hand"


@dataclass(frozen=True, slots=True)
class Question:
    """A case as it is asked. The `id` is ours, and is never sent."""

    id: str
    solid: Solid
    ray: Ray


@dataclass(frozen=True, slots=True)
class Limits:
    """What a program may take.

    Seconds to the hello and to an answer; bytes in a line; questions outstanding at a time.
    A run is given up after `in_a_row` questions that fail one after the other, or when `lost`
    seconds have gone into silence and restarts.
    """

    hello: float = 10.0
    case: float = 5.0
    line: int = LINE
    window: int = 256
    in_a_row: int = 50
    lost: float = 600.0


def silence(outcome: Outcome) -> tuple[str, str] | None:
    """Return the kind and the words of an outcome that is no answer; None for an answer."""
    if isinstance(outcome, Failure):
        return outcome.kind, outcome.detail
    if outcome.unsupported is not None:
        return "unsupported", outcome.unsupported
    return None if outcome.error is None else ("error", outcome.error)


class Unusable(Exception):
    """The target could not be run at all; the text says what was seen and what to do."""


def fresh_ids() -> Iterator[str]:
    """Yield ids that tell nothing: not the case, and not its place in the corpus."""
    state = secrets.randbits(32)
    while True:
        state = (state + 0x9E3779B1) % (1 << 32)
        yield f"q{state:08x}"


class Target(Protocol):
    """What can be certified: a way to start it, any number of times."""

    def open(self, limits: Limits, ids: Iterator[str]) -> Dialogue:
        """Start it in a process of its own and read its hello. Raises `Unusable`.

        `ids` are those that questions go by, where it is told any.
        """


class Dialogue(ABC):
    """A running implementation that has said hello.

    `hello` is what it declared; `unanswered` the questions it owes, in order; `last` the one it
    answered last; `asked` how many it was asked.
    """

    def __init__(self, process: Process, limits: Limits) -> None:
        """Take over a process that was just started, and read its hello. Raises `Unusable`."""
        self.asked = 0
        self.last: Question | None = None
        self._limits = limits
        self._owed: deque[tuple[str, Question]] = deque()
        self._held: list[bytes] = []
        self._process = process
        try:
            self.hello = self._greet()
        except BaseException:
            self.kill()
            raise

    @abstractmethod
    def _greet(self) -> Hello:
        """Read the hello. Raises `Unusable`."""

    @abstractmethod
    def _message(self, questions: list[Question]) -> bytes:
        """Return the bytes that ask questions, having entered them into `_owed`."""

    @abstractmethod
    def _match(self, line: bytes) -> Iterable[tuple[Question, Outcome]]:
        """Return the answers on a line with their questions, struck from `_owed`; `Broken`."""

    @property
    def unanswered(self) -> list[Question]:
        return [question for _, question in self._owed]

    @property
    def owed(self) -> int:
        return len(self._owed)

    def ask(self, questions: Iterable[Question]) -> None:
        """Send questions, in the spelling and format of the hello. Never blocks."""
        asked = list(questions)
        self.asked += len(asked)
        self._process.send(self._message(asked))

    def answers(self) -> Iterator[tuple[Question, Outcome]]:
        """Yield the answers that have come, waiting for the first; each carries the question's id.

        A `Failure` among them is an answer of no meaning from a target that goes on. Raises
        `Broken`, after the good answers before the failure.
        """
        lines, self._held = self._held, []
        for line in lines or self._process.receive(self._limits.case):
            yield from self._match(line)

    def stay_quiet(self) -> None:
        """Raise `Broken` if the target says more, or ends, though it owes nothing."""
        more = self._unasked() or self._process.listen(GRACE / 10)
        if more == b"":
            raise Broken(Failure("crash", f"{self._process.status()} after its answer"))
        if more:
            raise Broken(too_much(more))

    def finish(self, seconds: float = 2 * GRACE) -> str:
        """End the input, wait for the end; return what is odd about it, or nothing.

        Who has not ended after so many seconds is killed, which is odd. Raises `Broken` if lines
        come after the last answer. The target is dead afterwards.
        """
        began = time.monotonic()
        try:
            self._process.close()
            if more := self._unasked() or self._process.listen(seconds):
                raise Broken(too_much(more))
            ending = self._process.status(max(GRACE, began + seconds - time.monotonic()))
        finally:
            left = self.kill()
        if left:
            return left
        if ending == "did not end":
            return f"it did not end within {seconds:g} s when its input ended, and was killed"
        return "" if ending == "ended with exit status 0" else f"after its input ended it {ending}"

    def kill(self) -> str:
        """Leave nothing behind; return what could not be ended, or nothing."""
        return "" if self._process.kill() else LEFT

    def _unasked(self) -> bytes:
        """Return what has come beside the answers."""
        return b"\n".join([*self._held, self._process.leftover()])


def too_much(output: bytes) -> Failure:
    """Return the failure of a target that says what it was not asked."""
    text = shown(output)
    return Failure("bad-line", f"wrote more than its answers: {text!r}", shown(output, 1000))


@dataclass(frozen=True, slots=True)
class Command:
    """A target: a program and its arguments."""

    words: tuple[str, ...]

    def open(self, limits: Limits, ids: Iterator[str]) -> PipeDialogue:
        return PipeDialogue(self.words, limits, ids)


class PipeDialogue(Dialogue):
    """The dialogue with a program, over its standard input and output."""

    def __init__(self, command: Sequence[str], limits: Limits, ids: Iterator[str]) -> None:
        self._words, self._name = tuple(command), shlex.join(command)
        self._ids = ids
        self._last_id = ""
        super().__init__(_start(command, limits), limits)

    def _message(self, questions: list[Question]) -> bytes:
        spelling, fmt, lines = self.hello.numbers, self.hello.format, []
        for question in questions:
            id = next(self._ids)
            self._owed.append((id, question))
            lines.append(ask(id, question.solid, question.ray, spelling, fmt))
        return b"".join(lines)

    def _greet(self) -> Hello:
        self._process.send(encode({"hello": VERSION}))
        try:
            first, *self._held = self._process.receive(self._limits.hello)
        except Broken as broken:
            raise Unusable(_no_hello(self._words, broken.failure)) from None
        try:
            return read_hello(first)
        except BadLine as error:
            seen = _bad_hello(self._name, str(error), first, self._process.errors())
            raise Unusable(seen) from None

    def _match(self, line: bytes) -> Iterable[tuple[Question, Outcome]]:
        if not self._owed:
            raise Broken(too_much(line))
        id, question = self._owed[0]
        given, outcome = self._read(line, question)
        if given != id:
            raise Broken(self._wrong_id(given, id, line))
        self._owed.popleft()
        self.last, self._last_id = question, id
        return ((question, outcome),)

    def _read(self, line: bytes, question: Question) -> tuple[str, Outcome]:
        """Return the id on a line, and the outcome that it is of the question next in turn."""
        try:
            reply = read_reply(line, self.hello, most_pairs(question.solid))
        except TooMany as error:
            return error.id, Failure("malformed", f"the answer {error}: {shown(line, 80)!r}")
        except BadLine as error:
            raise Broken(Failure("bad-line", f"the line {error}", shown(line, 1000))) from None
        return reply.id, replace(reply, id=question.id)

    def _wrong_id(self, subject: str, truth: str, line: bytes) -> Failure:
        detail = f"answered id {subject[:40]!r} where {truth!r} was next"
        if subject == self._last_id:
            detail += "; that one was answered just before"
        elif any(subject == id for id, _ in self._owed):
            detail += "; that one was asked later: answers have to come in the order of questions"
        else:
            detail += "; no such id was asked: ids have to be given back as they are"
        return Failure("wrong-id", detail, shown(line, 1000))


def _start(command: Sequence[str], limits: Limits) -> Process:
    try:
        if not command:
            raise ValueError("there is no command")
        return Process(command, limits.line)
    except (OSError, ValueError) as error:
        name = shlex.join(command)
        raise Unusable(
            f"cannot start {name!r}: {error}. Give the program and its arguments as you would "
            "type them in a terminal, and see that the file exists and is executable."
        ) from None


EXAMPLE = '{"hello": 1, "name": "my tracer"}'


def _no_hello(words: Sequence[str], failure: Failure) -> str:
    advice = f'It has to answer the line {{"hello": 1}} with a line such as {EXAMPLE}'
    if failure.kind == "hang" and UNREAD in failure.detail:
        advice += "; if it is slow to start, raise --hello-timeout"
    elif failure.kind == "hang":
        advice += ", and to flush its standard output after each line"
    scripts = [word for word in words if word.endswith(".py")]
    if scripts and failure.detail == "ended with exit status 0":
        advice += f". A function in a file is a target of its own: {scripts[0]}:intersect"
    return f"{shlex.join(words)!r} gave no hello: {failure.detail}. {advice}."


def _bad_hello(name: str, error: str, first: bytes, errors: str) -> str:
    seen = f"{name!r} gave a bad hello: {error}. Its first line was {shown(first)!r}."
    if errors:
        seen += f" Standard error: {errors}."
    return (
        f"{seen} Its first line has to be one such as {EXAMPLE}; anything else that it prints "
        "belongs on standard error."
    )
