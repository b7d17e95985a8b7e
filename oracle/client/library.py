"""A shared library as a tracer: the C signatures of starters/library/raycert.h, called by ctypes.

A solid goes in as two flat arrays in prefix order, codes and numbers, as in `raycert export`. The
same rules as for any code in our process hold: nothing here protects from it.
"""

from __future__ import annotations

import ctypes
from array import array
from dataclasses import fields
from math import nan
from pathlib import Path

from raycert.cases.model import SOLIDS, TYPE_NAMES, Ray, Solid, Tree
from raycert.cases.protocol import Hello
from raycert.oracle.client.loaded import CannotLoad, Loaded, read_declared
from raycert.oracle.client.values import MOST, NoAnswer

CODES = {name: code for code, name in enumerate(SOLIDS, 1)}
"""The codes of the header: half_space 1, sphere 2, ... difference 8."""
ROOM = 64
"""How many pairs there is room for at first."""
HEADER = "raycert harness library writes the header and an example"


def flat(solid: Solid) -> tuple[array[int], array[float]]:
    """Return a solid in prefix order: its codes, each tree's followed by its count; its numbers."""
    words, numbers = array("i"), array("d")
    _flatten(solid, words, numbers)
    return words, numbers


def _flatten(solid: Solid, words: array[int], numbers: array[float]) -> None:
    words.append(CODES[TYPE_NAMES[type(solid)]])
    if isinstance(solid, Tree):
        words.append(len(solid.of))
        for part in solid.of:
            _flatten(part, words, numbers)
        return
    for name in FIELDS[type(solid)]:
        value = getattr(solid, name)
        if isinstance(value, tuple):
            numbers.extend(value)
        else:
            numbers.append(value)


FIELDS = {kind: tuple(field.name for field in fields(kind)) for kind in SOLIDS.values()}


def load_library(path: str) -> Loaded:
    """Load a shared library. Raises `CannotLoad`."""
    try:
        library = ctypes.CDLL(str(Path(path).resolve()))
    except OSError as error:
        raise CannotLoad(
            f"cannot load {path!r}: {error}. It has to be a shared library for this machine "
            "(cc -shared -fPIC)."
        ) from None
    try:
        function = library.raycert_intersect
    except AttributeError:
        raise CannotLoad(
            f'{path!r} has no symbol raycert_intersect; {HEADER} (in C++, it has to be extern "C").'
        ) from None
    pointer, length = ctypes.c_void_p, ctypes.c_int32
    function.argtypes = (pointer, length, pointer, length, pointer, pointer, pointer, length)
    function.restype = ctypes.c_int
    hello = _hello(library, path)
    return Loaded(hello, Library(function, hello))


def _hello(library: ctypes.CDLL, path: str) -> Hello:
    try:
        function = library.raycert_hello
    except AttributeError:
        return Hello(Path(path).name)
    function.argtypes, function.restype = (), ctypes.c_char_p
    line = function()
    if line is None:
        raise CannotLoad(f"raycert_hello of {path!r} returned NULL, and not a line of JSON.")
    return read_declared(line, path)


class Library:
    """The function of a library as a callable of a solid and a ray."""

    def __init__(self, function: ctypes._NamedFuncPointer, hello: Hello) -> None:
        """Hold the function, and room for its answers."""
        self._function = function
        self._answers = hello.answers
        self._make_room(ROOM)

    def _make_room(self, pairs: int) -> None:
        self._room = pairs
        self._out = array("d", [nan]) * (2 * pairs)
        self._blank = array("d", self._out)

    def __call__(self, solid: Solid, ray: Ray) -> object:
        """Return the list of pairs, the first hit or None, or the truth value. `NoAnswer`."""
        words, numbers = flat(solid)
        count = self._call(words, numbers, ray)
        if self._answers != "intervals":
            if count not in (0, 1):
                raise NoAnswer(f"{count} from raycert_intersect, which has to return 0 or 1")
            hit = self._out[0] if count else None
            return hit if self._answers == "first" else bool(count)
        if count > self._room:
            if count > MOST:
                raise NoAnswer(f"more than {MOST} intervals: {count}")
            self._make_room(count)
            again = self._call(words, numbers, ray)
            if again != count:
                raise NoAnswer(f"{count} intervals, and when asked again {again}")
        ends = self._out[: 2 * count]
        return list(zip(ends[::2], ends[1::2], strict=True))

    def _call(self, words: array[int], numbers: array[float], ray: Ray) -> int:
        """Call the function; return how many pairs there are. What it did not write is NaN."""
        origin, direction = array("d", ray.origin), array("d", ray.direction)
        self._out[:] = self._blank
        count: int = self._function(
            words.buffer_info()[0],
            len(words),
            numbers.buffer_info()[0],
            len(numbers),
            origin.buffer_info()[0],
            direction.buffer_info()[0],
            self._out.buffer_info()[0],
            self._room,
        )
        if count == -1:
            raise NotImplementedError("raycert_intersect returned -1")
        if count == -2:
            raise LibraryError("raycert_intersect returned -2")
        if count < 0:
            raise NoAnswer(f"{count} from raycert_intersect, which has to return -2 or more")
        return count


class LibraryError(Exception):
    """The library could not answer, and says so."""
