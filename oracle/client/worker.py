"""The process that code of others runs in, and how that code is loaded, called and understood.

In:  the kind and place of the code on the command line; then, on standard input, batches: 4 bytes
     that give the length, and the questions as inprocess.py writes them.
Out: lines of JSON. The first is {"hello": ...} or {"unusable": why}; every other one is a list of
     answers in the order of the questions. They are sent when a batch is done, or 5 ms after the
     last that were sent, so that neither a line for each nor a long silence costs anything.

An answer is what is promised, a list of pairs, a first hit or a truth value, or else an object
with one key: `error`, `unsupported`, `bad-line` or `malformed`. The lines are JSON, not pickles,
because the code may have spoiled the memory of the process that writes them. The code sees an
empty standard input, and what it prints goes to standard error.

What a call may return, and the answer that it means; any value gets an outcome:

    intervals   an iterable of pairs (enter, leave), up to `most_pairs`; a NumPy array is one
    first       a number, or None for a miss
    any         True or False

A number is a float, an integer, or what has `__float__` and is neither text nor a truth value; it
is rounded to the declared precision, and None or infinity ends an interval that never ends. Whether
the numbers make a well-formed list is for the judge.
"""

from __future__ import annotations

import ctypes
import importlib
import inspect
import json
import math
import os
import sys
import time
from array import array
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from functools import partial
from importlib.machinery import PathFinder
from importlib.util import module_from_spec, spec_from_file_location
from itertools import islice
from pathlib import Path
from types import ModuleType
from typing import Any, BinaryIO, SupportsFloat

from raycert.cases.formats import Format
from raycert.cases.model import SOLIDS, Ray, Solid, Tree, nodes, type_of
from raycert.cases.numbers import leaf_numbers
from raycert.cases.protocol import (
    VERSION,
    BadLine,
    Hello,
    Pairs,
    Reply,
    cut,
    most_pairs,
    read_hello,
    write_hello,
)
from raycert.oracle.client.dialogue import silence
from raycert.oracle.client.inprocess import read_batch
from raycert.oracle.client.process import Failure, Kind

OWNER = os.getpid()
"""The process that is asked."""
FLUSH = 0.005
LONGEST = 1 << 18
"""A line is ended once it has so many characters; one answer more goes into it."""
ROOM = 64
"""How many pairs there is room for at first in what a library writes to."""
CODES = {name: code for code, name in enumerate(SOLIDS, 1)}
"""The codes of raycert.h: half_space 1, sphere 2, ... difference 8."""
HEADER = "raycert harness library writes the header and an example"


class CannotLoad(Exception):
    """The code cannot be had; the text says what was seen and what to do."""


class NoAnswer(ValueError):
    """A value that is not of the promised form; the text says what it is."""


class TooMany(NoAnswer):
    """A list of more pairs than an answer may have."""

    def __init__(self, count: str, most: int) -> None:
        super().__init__(f"{count} pairs, and {most} is the most for this solid")


class LibraryError(Exception):
    """The library could not answer, and says so."""


def main(kind: str, spec: str) -> None:
    questions, answers = _private_pipes()
    try:
        loaded = KINDS[kind](spec)
    except CannotLoad as error:
        _send(answers, json.dumps({"unusable": str(error)}))
        return
    _send(answers, write_hello(loaded.hello).decode().rstrip("\n"))
    while head := questions.read(4):
        batch = questions.read(int.from_bytes(head, "big"))
        _answer(read_batch(batch), loaded, answers)


def _private_pipes() -> tuple[BinaryIO, BinaryIO]:
    """Take standard input and output away from the code, and return them.

    Copies of both descriptors are kept for us. Then 0 reads nothing, and 1 goes where 2 goes, also
    for code in C that writes to it past Python.
    """
    questions, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb", buffering=0)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    return questions, answers


def _answer(batch: Iterable[tuple[Solid, Ray]], loaded: Loaded, answers: BinaryIO) -> None:
    texts, length, sent = list[str](), 0, time.monotonic()
    for solid, ray in batch:
        text = _write(loaded(solid, ray))
        texts.append(text)
        length += len(text)
        if time.monotonic() - sent > FLUSH or length > LONGEST:
            _send(answers, f"[{','.join(texts)}]")
            texts, length, sent = [], 0, time.monotonic()
    if texts:
        _send(answers, f"[{','.join(texts)}]")


def _write(outcome: Reply | Failure) -> str:
    if isinstance(outcome, Failure):
        return json.dumps({outcome.kind: outcome.detail})
    if quiet := silence(outcome):
        return json.dumps(dict([quiet]))
    told = (outcome.intervals, outcome.hit, outcome.first)
    return json.dumps(next((value for value in told if value is not None), None))


def _send(answers: BinaryIO, line: str) -> None:
    if os.getpid() != OWNER:  # a copy that the code has made by `fork` answers nothing
        os._exit(0)
    rest = memoryview(line.encode("ascii") + b"\n")
    while rest:  # a raw pipe may take less than it is given
        rest = rest[answers.write(rest) :]


# Loading: a Python callable or a shared library, with what it declares. Nothing protects from it.


@dataclass(frozen=True, slots=True)
class Loaded:
    """Code that is in this process: what it declares, and the bare call, which may do anything."""

    hello: Hello
    raw: Callable[[Solid, Ray], object]

    def __call__(self, solid: Solid, ray: Ray) -> Reply | Failure:
        """Return the answer to a question, as a reply without an id."""
        return outcome(partial(self.raw, solid, ray), self.hello, most_pairs(solid))


def load_callable(spec: str) -> Loaded:
    """Load `module:function`, of the current directory where it is there. Raises `CannotLoad`.

    The module may be the path of a file, `submissions/a-b.py:function`; the function a method of an
    object, or of a class, which is made without arguments. What declares it is `hello` of the
    function, else of its object or class, else of the module: a dict of the fields of the
    protocol's hello, or what has them as attributes. Without one it is a closed binary64 tracer of
    every solid.
    """
    module_name, _, path = spec.rpartition(":")
    try:
        module = _of_file(module_name) if module_name.endswith(".py") else _module(module_name)
    except (Exception, SystemExit) as error:
        raise CannotLoad(
            f"cannot import {module_name!r}: {described(error)}. The target is MODULE:FUNCTION, "
            "looked for in the current directory, then on PYTHONPATH, then among what is installed."
        ) from None
    places: list[Any] = [module]
    for name in path.split("."):
        if not hasattr(places[-1], name):
            raise CannotLoad(_missing(spec, module, places[-1], name))
        places.append(getattr(places[-1], name))
    declared: Any = next((place.hello for place in reversed(places) if hasattr(place, "hello")), {})
    return Loaded(_declared(declared, spec), _function(spec, *places[-2:]))


def _missing(spec: str, module: ModuleType, place: object, name: str) -> str:
    """Return what is said of a name that is not there, with the one that was meant."""
    module_name, _, path = spec.rpartition(":")
    names = [
        each for each, value in vars(place).items()
        if callable(value) and each[0] != "_"
        and getattr(value, "__module__", None) == module.__name__
    ] if hasattr(place, "__dict__") else []  # fmt: skip
    seen = f"{module_name!r} has no {path!r} (it is {getattr(module, '__file__', 'built in')})."
    if not names:
        return f"{seen} The target is MODULE:FUNCTION, such as tracer:intersect."
    before = spec[: len(spec) - len(path)] + path.rpartition(name)[0]
    [meant, *_] = [*get_close_matches(name, names, 1), *names]
    return f"{seen} Did you mean {before}{meant}? It has {', '.join(names[:8])}."


def _function(spec: str, owner: object, found: object) -> Callable[[Solid, Ray], object]:
    """Return what is called as intersect(solid, ray). Raises `CannotLoad` if that cannot be."""
    try:
        if isinstance(owner, type) and inspect.isfunction(
            inspect.getattr_static(owner, _last(spec))
        ):
            found = getattr(owner(), _last(spec))
        elif isinstance(found, type) and any("__call__" in vars(kind) for kind in found.__mro__):
            found = found()
    except Exception as error:
        raise CannotLoad(f"the class of {spec!r} cannot be made: {described(error)}.") from None
    if not callable(found) or isinstance(found, type):
        kind = "class" if isinstance(found, type) else type(found).__name__
        hint = f" A method of it is a target: {spec}.intersect." if kind == "class" else ""
        raise CannotLoad(f"{spec!r} is a {kind}, and not a function intersect(solid, ray).{hint}")
    try:
        signature = inspect.signature(found)
    except (TypeError, ValueError):  # of code that is not Python's
        return found
    try:
        signature.bind(None, None)
    except TypeError as error:
        raise CannotLoad(
            f"{_last(spec)}{signature} cannot be called as {_last(spec)}(solid, ray): {error}. "
            "They are objects of raycert.cases.model: a Sphere has solid.center and solid.radius, "
            "a ray ray.origin and ray.direction. Write a function that takes them apart for yours."
        ) from None
    return found


def _last(spec: str) -> str:
    return spec.rpartition(":")[2].rpartition(".")[2]


def _module(name: str) -> ModuleType:
    """Import a module of the user, as a script of theirs that lies in the current directory would.

    One that has the name of a module that is loaded already is loaded beside it, for the rest of
    the process has to find what it means by that name.
    """
    if "" not in sys.path:
        sys.path.insert(0, "")
    top, _, inner = name.partition(".")
    spec, taken = PathFinder.find_spec(top, [""]), sys.modules.get(top)
    if not taken or not spec or not spec.loader or spec.origin == _origin(taken):
        return importlib.import_module(name)
    if inner:
        raise ImportError(f"{top!r} is the name of a module that is loaded already ({taken!r})")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _of_file(path: str) -> ModuleType:
    """Load a file as a module: what lies beside it is found, as a script would find it."""
    sys.path.insert(0, str(Path(path).resolve().parent))
    spec = spec_from_file_location(Path(path).stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    sys.modules.setdefault(spec.name, module)
    spec.loader.exec_module(module)
    return module


def _origin(module: ModuleType) -> str | None:
    """Return the file of a module."""
    return module.__spec__.origin if module.__spec__ else None


def _declared(hello: Any, spec: str) -> Hello:
    """Return the hello that a dict is, or whatever has its fields as attributes."""
    fields = hello
    if isinstance(hello, Hello):
        fields = hello.form()
    elif not isinstance(hello, dict):
        fields = {name: getattr(hello, name) for name in Hello.__slots__ if hasattr(hello, name)}
        if not fields:
            raise CannotLoad(
                f"the `hello` of {spec!r} is a {type(hello).__name__}: it has to be a dict of the "
                'fields of a hello, such as {"name": "my tracer", "solids": ["sphere"]}, or an '
                "object that has them."
            )
    try:
        line = json.dumps({"hello": VERSION, "name": spec, **fields}, default=_listed)
    except (TypeError, ValueError, RecursionError) as error:
        raise CannotLoad(f"the `hello` of {spec!r} is not JSON: {error}.") from None
    return read_declared(line.encode(), spec)


def _listed(value: object) -> list[Any]:
    """Return a set as JSON has it."""
    if isinstance(value, set | frozenset):
        return sorted(value)
    raise TypeError(f"a {type(value).__name__} has no form there")


def read_declared(line: bytes, spec: str) -> Hello:
    """Return the hello that code gives of itself. Raises `CannotLoad`."""
    try:
        return read_hello(line)
    except BadLine as error:
        raise CannotLoad(f"{spec!r} gave a bad hello: {error}.") from None


# A shared library: the C signatures of starters/library/raycert.h, called by ctypes.


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


def flat(solid: Solid) -> tuple[array[int], array[float]]:
    """Return a solid in prefix order: its codes, each tree's followed by its count; its numbers."""
    words, numbers = array("i"), array("d")
    for node in nodes(solid):
        words.append(CODES[type_of(node)])
        if isinstance(node, Tree):
            words.append(len(node.of))
        else:
            numbers.extend(leaf_numbers(node))
    return words, numbers


class Library:
    """The function of a library as a callable of a solid and a ray."""

    def __init__(self, function: ctypes._NamedFuncPointer, hello: Hello) -> None:
        self._function = function
        self._answers = hello.answers
        self._make_room(ROOM)

    def _make_room(self, pairs: int) -> None:
        self._room = pairs
        self._out = array("d", [math.nan]) * (2 * pairs)
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
        if count > (most := most_pairs(solid)):
            raise TooMany(str(count), most)
        if count > self._room:  # it told how many there are, and wrote only what had room
            self._make_room(count)
            again = self._call(words, numbers, ray)
            if again != count:
                raise NoAnswer(f"{count} intervals, and when asked again {again}")
        ends = self._out[: 2 * count]
        return list(zip(ends[::2], ends[1::2], strict=True))

    def _call(self, words: array[int], numbers: array[float], ray: Ray) -> int:
        """Call the function; return how many pairs there are. What it did not write is NaN."""
        self._out[:] = self._blank
        arrays = words, numbers, array("d", ray.origin), array("d", ray.direction), self._out
        codes, reals, origin, direction, out = (each.buffer_info()[0] for each in arrays)
        sizes = len(words), len(numbers)
        count: int = self._function(
            codes, sizes[0], reals, sizes[1], origin, direction, out, self._room
        )
        if count == -1:
            raise NotImplementedError("raycert_intersect returned -1")
        if count == -2:
            raise LibraryError("raycert_intersect returned -2")
        if count < 0:
            raise NoAnswer(f"{count} from raycert_intersect, which has to return -2 or more")
        return count


KINDS: dict[str, Callable[[str], Loaded]] = {"callable": load_callable, "library": load_library}


# Values: what a call returned, as the reply that it means.


def outcome(call: Callable[[], object], hello: Hello, most: int) -> Reply | Failure:
    """Return what a call answers, with no id. Never raises, but what is no `Exception`.

    `NotImplementedError` is the reply `unsupported`, another exception the reply `error`, a value
    that is not of the form that the hello promises a failure.
    """
    try:
        return read(call(), hello, most)
    except NoAnswer as error:
        kind: Kind = "malformed" if isinstance(error, TooMany) else "bad-line"
        return Failure(kind, f"it returned {error}")
    except NotImplementedError as error:
        return Reply("", unsupported=described(error))
    except Exception as error:
        return Reply("", error=described(error))


def described(error: BaseException) -> str:
    """Return an exception as text, also one whose own text cannot be had."""
    try:
        text = str(error)
    except Exception:
        text = ""
    kind = type(error).__name__
    return cut(f"{kind}: {text}" if text else kind)


def read(value: object, hello: Hello, most: int) -> Reply:
    """Return the reply that a value means, with no id; of up to `most` pairs.

    May raise `NoAnswer`, or anything.
    """
    if hello.answers == "intervals":
        return Reply("", intervals=_pairs(value, hello.format, most))
    if hello.answers == "first":
        return Reply("", first=None if value is None else number(value, hello.format))
    if isinstance(value, bool):
        return Reply("", hit=value)
    if type(value).__module__ == "numpy" and type(value).__name__ in ("bool", "bool_"):
        return Reply("", hit=bool(value))
    raise NoAnswer(f"{in_words(value)}, and not True or False")


def _pairs(value: object, fmt: Format, most: int) -> Pairs:
    if isinstance(value, str | bytes | dict) or not hasattr(value, "__iter__"):
        raise NoAnswer(f"{in_words(value)}, and not a list of pairs (an empty one is a miss)")
    pairs = tuple([_pair(pair, fmt) for pair in islice(value, most + 1)])
    if len(pairs) > most:
        raise TooMany("more", most)
    return pairs


def _pair(pair: object, fmt: Format) -> tuple[float, float]:
    if isinstance(pair, str | bytes | dict | set) or not hasattr(pair, "__iter__"):
        raise NoAnswer(f"an interval that is {in_words(pair)}, and not a pair of numbers")
    ends = [math.inf if end is None else number(end, fmt) for end in islice(pair, 3)]
    if len(ends) != 2:
        what = "of more than two" if len(ends) > 2 else "that has not two"
        raise NoAnswer(f"an interval {what} numbers: {in_words(pair)}")
    return ends[0], ends[1]


def number(value: object, fmt: Format) -> float:
    """Return a value as the nearest number of a format. Raises `NoAnswer` if it is no number."""
    if type(value) is not float:
        if isinstance(value, bool | str | bytes | bytearray) or not isinstance(
            value, SupportsFloat
        ):
            raise NoAnswer(f"{in_words(value)} where a number has to be")
        try:
            value = float(value)
        except OverflowError:
            value = math.inf if value > 0 else -math.inf  # type: ignore[operator]
        except (TypeError, ValueError):
            raise NoAnswer(f"{in_words(value)} where a number has to be") from None
    return value if fmt.name == "binary64" else fmt.nearest(value)


def in_words(value: object) -> str:
    """Return a few words that tell what a value is, whatever its `repr` does."""
    kind = type(value).__name__
    if value is None or isinstance(value, bool):
        return repr(value)
    if isinstance(value, int) and value.bit_length() > 128:
        return f"an integer of {value.bit_length()} bits"
    if isinstance(value, str | bytes | int | float):
        return f"the {kind} {value[:60] if isinstance(value, str | bytes) else value!r}"
    try:
        text = repr(value) if isinstance(value, tuple) and len(value) < 4 else ""
    except Exception:
        text = ""
    return f"a {kind} {text}"[:80].rstrip()


if __name__ == "__main__":
    main(*sys.argv[1:3])
