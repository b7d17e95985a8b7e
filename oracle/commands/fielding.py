"""Many targets certified side by side, each in a process of ours that others do not share.

A lane is such a process, and does one target after another. What ends it, or whatever goes wrong in
it, is told of the target that it was at; another takes its place.
"""

from __future__ import annotations

import json
import os
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Protocol

from raycert.cases.interrupts import held, interruptible
from raycert.cases.workers import Workers
from raycert.oracle.certify.entrants import Entrant
from raycert.oracle.certify.run import Plan, Unsuitable, Watch, certify
from raycert.oracle.certify.selection import Selection
from raycert.oracle.client.declared import Declared
from raycert.oracle.client.dialogue import Target, Unusable
from raycert.oracle.client.target import target
from raycert.oracle.commands.options import spelled
from raycert.oracle.reports.gradebook import graded, without

Json = dict[str, Any]
POLL = 0.1
"""Seconds between two looks at what is under way."""
_to_board: list[Connection] = []
"""In a lane: where to tell how far its work is."""


@dataclass(frozen=True, slots=True)
class Turn:
    """A target to certify. `hello` is the file that has the fields of its entrant."""

    number: int
    entrant: Entrant
    selection: Selection
    golden: Path
    hello: str

    def plan(self) -> Plan:
        entrant = self.entrant
        aimed: Target = target(entrant.words)
        if entrant.hello:
            aimed = Declared(aimed, entrant.hello, self.hello)
        asked = (
            aimed,
            entrant.level,
            entrant.convention,
            self.selection,
            entrant.limits,
            self.golden,
        )
        return Plan(*asked)


@dataclass(frozen=True, slots=True)
class Came:
    """What came of a turn: its part of a row, and the certificate and its page, if there is one."""

    row: Json
    certificate: str = ""
    page: str = ""


class Board(Protocol):
    """Who is told how the work goes."""

    def begun(self, turn: Turn) -> None: ...
    def progress(self, number: int, verb: str, done: int, total: int) -> None: ...
    def ended(self, turn: Turn, came: Came) -> None: ...


def work(turn: Turn) -> Came:
    """Certify one target: in a lane."""
    from raycert.oracle.reports.page import page

    try:
        os.chdir(turn.entrant.folder)
        result = certify(
            turn.plan(), Watch(lambda verb, total: _counting(turn.number, verb, total))
        )
    except (Unusable, Unsuitable, OSError) as error:
        return Came(without("not run", str(error)))
    form = result.form(spelled(turn.entrant.words))
    row = graded(form)
    if result.changed or not form["tested"]:
        row |= {"state": "not run", "reason": result.changed or "nothing was tested"}
    return Came(row, json.dumps(form, indent=1, allow_nan=False) + "\n", page(form))


@contextmanager
def _counting(number: int, verb: str, total: int) -> Iterator[Callable[..., None]]:
    done, told = 0, 0.0

    def advance(n: int = 1) -> None:
        nonlocal done, told
        done += n
        if time.monotonic() - told > POLL:
            told = time.monotonic()
            _tell(number, verb, done, total)

    _tell(number, verb, 0, total)
    yield advance


def _listened(board: Connection) -> None:
    _to_board.append(board)


def _tell(*words: int | str) -> None:
    """Send a few words: less than a pipe takes whole, so that lanes need no lock."""
    for board in _to_board:
        board.send(words)


@dataclass
class _Lane:
    """A process, and what it is at."""

    board: Connection
    turn: Turn | None = None
    future: Future[Came] = field(default_factory=Future)

    def __post_init__(self) -> None:
        self._pool = Workers(1, _listened, self.board)

    def begin(self, turn: Turn) -> None:
        self.turn, self.future = turn, self._pool.submit(work, turn)

    def end(self) -> tuple[Turn, Came]:
        """Return what came of a turn that has ended, and be ready for another."""
        assert self.turn is not None
        turn, error, self.turn = self.turn, self.future.exception(), None
        if error is None:
            return turn, self.future.result()
        self.close()
        self.__post_init__()
        seen = f"{type(error).__name__}: {error}"
        return turn, Came(without("not run", f"raycert itself failed on it: {seen}"))

    def close(self) -> None:
        self._pool.end()


def run(turns: Sequence[Turn], count: int, board: Board) -> None:
    """Do the turns, so many at a time, and tell the board of each. Raises KeyboardInterrupt."""
    waiting, (heard, told) = deque(turns), Pipe(duplex=False)
    lanes = [_Lane(told) for _ in range(min(count, len(turns)))]
    try:
        while waiting or any(lane.turn for lane in lanes):
            for lane in lanes:
                if waiting and not lane.turn:
                    board.begun(waiting[0])
                    lane.begin(waiting.popleft())
            with interruptible():
                wait([lane.future for lane in lanes if lane.turn], POLL, FIRST_COMPLETED)
            while heard.poll():
                board.progress(*heard.recv())
            for lane in lanes:
                if lane.turn and lane.future.done():
                    board.ended(*lane.end())
    finally:
        with held():
            for lane in lanes:
                lane.close()
