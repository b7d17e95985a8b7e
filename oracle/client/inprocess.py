"""Code that is loaded, not spoken to: a Python callable or a shared library in a worker of ours.

What it does to its process, a crash, an exit, a hang, is seen as that of a program is, and is
pinned on its question in the same way (replay.py). Here: our end of the worker's pipes, and how
questions travel through them.
"""

from __future__ import annotations

import json
import pickle
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields
from typing import Any, Literal, TypeVar

from raycert.cases.model import SOLIDS, Ray, Solid, Tree
from raycert.cases.protocol import Answers, BadLine, Hello, Reply, cut, most_pairs, read_hello
from raycert.oracle.client.apart import ours
from raycert.oracle.client.dialogue import Dialogue, Limits, Outcome, Question, Unusable, too_much
from raycert.oracle.client.process import Broken, Failure, Process, shown

WORKER = "raycert.oracle.client.worker"
LINE = 1 << 24
"""The worker ends its lines far below this."""
BATCH = 64
"""Questions in a batch: the worker is at one while we read the answers to the one before."""


@dataclass(frozen=True, slots=True)
class InProcess:
    """A target: code by its kind and its place, `module:function` or the path of a library."""

    kind: Literal["callable", "library"]
    spec: str

    def open(self, limits: Limits, ids: Iterator[str]) -> WorkerDialogue:
        return WorkerDialogue(self, limits)


class WorkerDialogue(Dialogue):
    """The dialogue with a worker."""

    def __init__(self, target: InProcess, limits: Limits) -> None:
        self._spec = target.spec
        command = ours(WORKER, target.kind, target.spec)
        super().__init__(Process(command, LINE, buffers=False), limits)

    def _greet(self) -> Hello:
        try:
            first, *self._held = self._process.receive(self._limits.hello)
        except Broken as broken:
            raise Unusable(f"loading {self._spec!r} failed: {broken.failure.detail}.") from None
        try:
            return read_hello(first)
        except BadLine:
            raise Unusable(_unusable(first, self._spec)) from None

    def _message(self, questions: list[Question]) -> bytes:
        self._owed.extend((question.id, question) for question in questions)
        asked = [(question.solid, question.ray) for question in questions]
        batches = [write_batch(asked[i : i + BATCH]) for i in range(0, len(asked), BATCH)]
        return b"".join(len(batch).to_bytes(4, "big") + batch for batch in batches)

    def _match(self, line: bytes) -> Iterator[tuple[Question, Outcome]]:
        answers = self._answers(line)
        if len(answers) > len(self._owed):
            raise Broken(too_much(line))
        for answer in answers:
            _, question = self._owed[0]
            outcome = _outcome(question, answer, self.hello.answers)
            if outcome is None:
                raise Broken(_spoiled(line))
            self._owed.popleft()
            self.last = question
            yield question, outcome

    def _answers(self, line: bytes) -> list[object]:
        try:
            answers = json.loads(line)
        except (ValueError, RecursionError):
            answers = None
        if not isinstance(answers, list):
            raise Broken(_spoiled(line))
        return answers


def _unusable(first: bytes, spec: str) -> str:
    """Return what the first line of a worker says that is not a hello."""
    try:
        return str(json.loads(first)["unusable"])
    except (ValueError, RecursionError, KeyError, TypeError):
        return f"loading {spec!r} spoiled the pipe of its worker, which wrote {shown(first)!r}."


def _outcome(question: Question, answer: Any, form: Answers) -> Outcome | None:
    """Return the outcome that an answer of the worker is; None if it cannot be one.

    The worker keeps to the limits; code that writes in its place need not.
    """
    id = question.id
    try:
        if isinstance(answer, dict):
            [(kind, text)] = answer.items()
            if kind in ("bad-line", "malformed"):
                return Failure(kind, cut(text))
            reason: dict[str, Any] = {kind: cut(text)}
            return Reply(id, **reason)
        if form == "intervals":
            if len(answer) > most_pairs(question.solid):
                return None
            return Reply(id, intervals=tuple([(float(a), float(b)) for a, b in answer]))
        if form == "any":
            return Reply(id, hit=bool(answer))
        return Reply(id, first=None if answer is None else float(answer))
    except (TypeError, ValueError):
        return None


def _spoiled(line: bytes) -> Failure:
    text = f"its worker wrote {shown(line)!r}: the code has spoiled its memory or its pipes"
    return Failure("crash", text, shown(line, 1000))


# A batch of questions as bytes and back. The generic pickle of a solid takes ten times as long as
# the question, and so would checking again what was checked when the solid was made. So: tuples of
# numbers there, and bare slots filled here. Bytes of others are not for `read_batch`.

Form = tuple[Any, ...]
KINDS = tuple(SOLIDS.values())
NUMBER = {kind: number for number, kind in enumerate(KINDS)}
NAMES = {kind: tuple(field.name for field in fields(kind)) for kind in (*KINDS, Ray)}
SETTERS: dict[type, tuple[Any, ...]] = {
    kind: tuple(getattr(kind, name).__set__ for name in names) for kind, names in NAMES.items()
}
"""What fills the slots of a frozen instance."""


def write_batch(questions: Iterable[tuple[Solid, Ray]]) -> bytes:
    forms = [(_plain(solid), ray.origin, ray.direction) for solid, ray in questions]
    return pickle.dumps(forms, -1)


def read_batch(data: bytes) -> Iterator[tuple[Solid, Ray]]:
    for solid, origin, direction in pickle.loads(data):
        yield _whole(solid), _filled(Ray, (origin, direction))


def _plain(solid: Solid) -> Form:
    kind = type(solid)
    if isinstance(solid, Tree):
        return NUMBER[kind], tuple([_plain(part) for part in solid.of])
    return NUMBER[kind], *[getattr(solid, name) for name in NAMES[kind]]


def _whole(form: Form) -> Solid:
    kind = KINDS[form[0]]
    if issubclass(kind, Tree):
        return _filled(kind, (tuple([_whole(part) for part in form[1]]),))
    return _filled(kind, form[1:])


T = TypeVar("T")


def _filled(kind: type[T], values: Form) -> T:
    """Return an instance with these fields, none of them checked."""
    instance: T = object.__new__(kind)
    for put, value in zip(SETTERS[kind], values, strict=True):
        put(instance, value)
    return instance
