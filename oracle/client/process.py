"""One live program: lines in, lines out, and no deadlock, whatever it does.

Here: pipes, threads, time and death. Not here: what a line means (dialogue.py) and what to do after
a failure (replay.py). Three threads pump the pipes, so that the owner never blocks on a program
that does not read, does not write, or floods its standard error.
"""

from __future__ import annotations

import contextlib
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import IO, Literal

from raycert.cases.interrupts import held
from raycert.oracle.client import descendants

Kind = Literal["crash", "hang", "bad-line", "wrong-id", "malformed", "unrepeatable"]

CHUNK = 1 << 16
CHUNKS = 64
"""At most CHUNKS * CHUNK bytes (4 MiB) of output wait for the owner; then the program waits."""
TAIL = 1500
"""How many of the last bytes of standard error are kept."""
SLICE = 0.2
"""How often, in seconds, a silent program is asked whether it still lives."""
GATHER = 0.0003
"""Seconds in which answers gather, to be read at once: waking for each line costs more."""
UNREAD, UNFLUSHED = "has read nothing of its input", "output is not flushed"
"""What a silence may look like."""
GRACE = 0.5
"""Seconds for what follows a death or a closed input: the exit status, the last bytes."""


@dataclass(frozen=True, slots=True)
class Failure:
    """What a program did instead of answering. `line` is the line at fault, cut, where one is.

    `malformed` is an answer, of too many pairs to be read.
    """

    kind: Kind
    detail: str
    line: str = ""


class Broken(Exception):
    """The program has failed and can only be killed."""

    def __init__(self, failure: Failure) -> None:
        super().__init__(f"{failure.kind}: {failure.detail}")
        self.failure = failure


def shown(data: bytes | bytearray, most: int = 160) -> str:
    text = data[: most + 1].decode("utf-8", "replace").rstrip("\r\n")
    return text if len(text) <= most else text[: most - 3] + "..."


class Process:
    """A running program, in a process group of its own.

    `send` never blocks. `receive` returns within its time limit and holds bounded memory. After
    `kill` neither the program is left nor whom it has started (descendants.py).
    """

    def __init__(self, command: Sequence[str], line: int, buffers: bool = True) -> None:
        """Start the program, whose lines have at most `line` bytes. `OSError` if it cannot be.

        `buffers` tells whether what it writes may wait in a buffer of its own.
        """
        self._line, self._buffers = line, buffers
        self._sent = 0
        self._tail = bytearray()
        self._errors = bytearray()
        self._flood = 0
        self._deaf = False
        self._gone = False
        self._in: queue.Queue[bytes] = queue.Queue(CHUNKS)
        self._out: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._mark, environment = descendants.environment()
        try:
            with held():
                self._start(command, environment)
        except BaseException:
            descendants.end(self._mark)
            raise

    def _start(self, command: Sequence[str], environment: dict[str, str]) -> None:
        self._popen = subprocess.Popen(
            list(command),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            bufsize=0,
            start_new_session=True,
            env=environment,
        )
        if os.name == "posix":
            descendants.GROUPS[self._mark] = self._popen.pid
        pumps = (self._write, self._popen.stdin), (self._read, self._popen.stdout)
        self._threads = [
            threading.Thread(target=pump, args=(pipe,), daemon=True)
            for pump, pipe in (*pumps, (self._drain, self._popen.stderr))
        ]
        for thread in self._threads:
            thread.start()

    def send(self, data: bytes) -> None:
        self._out.put(data)

    def close(self) -> None:
        """End the program's input, after all that was sent."""
        self._out.put(None)

    def receive(self, seconds: float) -> list[bytes]:
        """Return the whole lines that have come, one or more, newlines removed.

        Waits at most `seconds` for the first. Raises `Broken` where the program ends (crash), is
        silent (hang), or writes a line beyond the limit (bad-line).
        """
        deadline = time.monotonic() + seconds
        while True:
            if len(self._tail) > self._line:
                raise Broken(self._too_long())
            chunk = self._chunk(deadline)
            if chunk is None:
                raise Broken(self._hang(seconds))
            if not chunk:
                raise Broken(self._crash())
            if lines := self._split(chunk):
                return lines

    def listen(self, seconds: float) -> bytes | None:
        """Return the next output, whole lines or not; b"" at its end, None if none came in time."""
        return self._chunk(time.monotonic() + seconds)

    def leftover(self) -> bytes:
        """Return the output that has come and is not a whole line yet."""
        return bytes(self._tail)

    def status(self, seconds: float = GRACE) -> str:
        """Return how the program ended, waiting a moment for it."""
        try:
            code = self._popen.wait(seconds)
        except subprocess.TimeoutExpired:
            return "did not end"
        if code >= 0:
            return f"ended with exit status {code}"
        try:
            return f"was killed by {signal.Signals(-code).name}"
        except ValueError:
            return f"was killed by signal {-code}"

    def errors(self) -> str:
        """Return the last lines of standard error, or nothing; what is cut says so."""
        text = bytes(self._errors).decode("utf-8", "replace").strip()
        lines = text.splitlines()
        before = "" if self._flood <= TAIL and len(lines) <= 10 else f"(of {self._flood} bytes) ..."
        return before + "\n".join(lines[-10:])

    def kill(self) -> bool:
        """End the program and whom it has started, then the threads.

        Returns whether that succeeded: somebody who could not be found may hold a pipe open.
        """
        with held():
            self._popen.kill()
            descendants.kill_group(self._mark)
            self._out.put(None)
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._popen.wait(10)
            descendants.end(self._mark)
            deadline = time.monotonic() + GRACE
            while any(thread.is_alive() for thread in self._threads):
                if time.monotonic() > deadline:
                    return False
                with contextlib.suppress(queue.Empty):
                    self._in.get(timeout=0.005)
            return True

    def _chunk(self, deadline: float) -> bytes | None:
        """Return the next bytes; b"" at the end; None if the time is up."""
        while True:
            wait = min(SLICE, deadline - time.monotonic())
            try:
                return self._in.get(timeout=max(0.0, wait))
            except queue.Empty:
                # Dead, and nothing came in the slice since: the end, though a child holds the pipe.
                if self._gone:
                    return b""
                self._gone = self._popen.poll() is not None
                if not self._gone and time.monotonic() >= deadline:
                    return None

    def _split(self, chunk: bytes) -> list[bytes]:
        """Return the lines that a chunk completes, up to the first that is too long."""
        if b"\n" not in chunk:
            self._tail += chunk
            return []
        first, *lines = chunk.split(b"\n")
        lines.insert(0, bytes(self._tail) + first)
        self._tail = bytearray(lines.pop())
        for i, line in enumerate(lines):
            if len(line) > self._line:
                self._tail = bytearray(line)
                return lines[:i]
        return lines

    def _too_long(self) -> Failure:
        begin = shown(self._tail)
        return Failure("bad-line", f"a line has more than {self._line} bytes: {begin!r}", begin)

    def _crash(self) -> Failure:
        self._threads[2].join(GRACE)
        detail = self.status().replace("did not end", "closed its standard output")
        if self._tail:
            detail += f", in the middle of a line: {shown(self._tail)!r}"
        if errors := self.errors():
            detail += f"; standard error: {errors}"
        return Failure("crash", detail, shown(self._tail))

    def _hang(self, seconds: float) -> Failure:
        """Say what the silence looks like. Closing the input makes a full buffer show itself."""
        detail = f"no answer for {seconds:g} s"
        if self._tail:
            detail += f", but {shown(self._tail)!r} without a newline"
        reads = self._deaf or self._has_read()
        if self._deaf:
            detail += ", and it has closed its standard input"
        elif not reads:
            detail += f", and {UNREAD}: it is still starting, or never reads"
        late = b""
        if self._buffers and reads:
            self.close()
            late = self.listen(GRACE) or b""
        if late:
            detail += f"; it wrote only when its input was closed: {UNFLUSHED}"
        if errors := self.errors():
            detail += f"; standard error: {errors}"
        return Failure("hang", detail, shown(late or self._tail))

    def _has_read(self) -> bool:
        """Whether the program has read anything of what was sent; yes where that cannot be told."""
        waiting = bytearray(4)
        with contextlib.suppress(ImportError, OSError, ValueError):
            import fcntl
            import termios

            assert self._popen.stdin
            fcntl.ioctl(self._popen.stdin.fileno(), termios.FIONREAD, waiting)
        return not self._sent or int.from_bytes(waiting, sys.byteorder) < self._sent

    def _read(self, pipe: IO[bytes]) -> None:
        # The queue is bounded: where the owner does not read, `put` blocks, the pipe fills, and the
        # program waits. `kill` empties the queue, so that a blocked reader gets to its end.
        with pipe, contextlib.suppress(OSError):
            while chunk := os.read(pipe.fileno(), CHUNK):
                self._in.put(chunk)
                if len(chunk) < CHUNK:  # of a flood more waits already
                    time.sleep(GATHER)
        self._in.put(b"")

    def _drain(self, pipe: IO[bytes]) -> None:
        # Read without a bound, so that a flood of messages never blocks the program.
        with pipe, contextlib.suppress(OSError):
            while chunk := os.read(pipe.fileno(), CHUNK):
                self._flood += len(chunk)
                self._errors = (self._errors + chunk)[-TAIL:]

    def _write(self, pipe: IO[bytes]) -> None:
        # The queue to here has no bound: `send` returns at once even to a program that is deaf.
        try:
            while (data := self._out.get()) is not None:
                rest = memoryview(data)
                while rest:
                    written = os.write(pipe.fileno(), rest)
                    self._sent += written
                    rest = rest[written:]
        except OSError:
            self._deaf = True
        with contextlib.suppress(OSError):
            pipe.close()
