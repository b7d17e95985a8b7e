"""A program that speaks the line protocol: its hello, one line a question, one line an answer."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from raycert.cases.protocol import (
    VERSION,
    BadLine,
    Hello,
    Reply,
    ask,
    encode,
    read_hello,
    read_reply,
)
from raycert.oracle.client.dialogue import Dialogue, Limits, Question, Unusable, too_much
from raycert.oracle.client.process import Broken, Failure, Process, shown


@dataclass(frozen=True, slots=True)
class Command:
    """A target: a program and its arguments."""

    words: tuple[str, ...]

    def open(self, limits: Limits, ids: Iterator[str]) -> Piped:
        """Start the program and read its hello. Raises `Unusable`."""
        return Piped(self.words, limits, ids)


class Piped(Dialogue):
    """The dialogue with a program, over its standard input and output."""

    def __init__(self, command: Sequence[str], limits: Limits, ids: Iterator[str]) -> None:
        """Start the program and read its hello. Raises `Unusable`."""
        self._name = shlex.join(command)
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
            raise Unusable(_no_hello(self._name, broken.failure)) from None
        try:
            return read_hello(first)
        except BadLine as error:
            seen = _bad_hello(self._name, str(error), first, self._process.errors())
            raise Unusable(seen) from None

    def _match(self, line: bytes) -> Iterable[tuple[Question, Reply]]:
        """Return the oldest question with the answer to it that `line` is."""
        if not self._owed:
            raise Broken(too_much(line))
        id, question = self._owed[0]
        try:
            reply = read_reply(line, self.hello)
        except BadLine as error:
            raise Broken(Failure("bad-line", f"the line {error}", shown(line, 1000))) from None
        if reply.id != id:
            raise Broken(self._wrong_id(reply.id, id, line))
        self._owed.popleft()
        self.last, self._last_id = question, id
        known = Reply(
            question.id, reply.intervals, reply.first, reply.hit, reply.unsupported, reply.error
        )
        return ((question, known),)

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


def _no_hello(name: str, failure: Failure) -> str:
    advice = f'It has to answer the line {{"hello": 1}} with a line such as {EXAMPLE}'
    if failure.kind == "hang":
        advice += ", and to flush its standard output after each line"
    return f"{name!r} gave no hello: {failure.detail}. {advice}."


def _bad_hello(name: str, error: str, first: bytes, errors: str) -> str:
    seen = f"{name!r} gave a bad hello: {error}. Its first line was {shown(first)!r}."
    if errors:
        seen += f" Standard error: {errors}."
    return (
        f"{seen} Its first line has to be one such as {EXAMPLE}; anything else that it prints "
        "belongs on standard error."
    )
