"""What code in our own process may return, and the answer that it means: any value gets an outcome.

    intervals   an iterable of pairs (enter, leave), at most `MOST`; a NumPy array is one
    first       a number, or None for a miss
    any         True or False

A number is a float, an integer, or what has `__float__` and is neither text nor a truth value; it
is rounded to the declared precision, and None or infinity ends an interval that never ends. Whether
the numbers make a well-formed list is for the judge.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import SupportsFloat

from raycert.cases.formats import Format
from raycert.cases.protocol import Hello, Pairs, Reply
from raycert.oracle.client.process import Failure

MOST = 4096
"""No list has more pairs than this: that is more than any question asks for."""


class NoAnswer(ValueError):
    """A value that is not of the promised form; the text says what it is."""


def outcome(call: Callable[[], object], hello: Hello) -> Reply | Failure:
    """Return what a call answers, with no id. Never raises, but what is no `Exception`.

    `NotImplementedError` is the reply `unsupported`, another exception the reply `error`, a value
    that is not of the form that the hello promises a failure.
    """
    try:
        return read(call(), hello)
    except NoAnswer as error:
        return Failure("bad-line", f"it returned {error}")
    except NotImplementedError as error:
        return Reply("", unsupported=told(error))
    except Exception as error:
        return Reply("", error=told(error))


def told(error: BaseException) -> str:
    """Return an exception as text, also one whose own text cannot be had."""
    try:
        text = str(error)
    except Exception:
        text = ""
    kind = type(error).__name__
    return (f"{kind}: {text}" if text else kind)[:1000]


def read(value: object, hello: Hello) -> Reply:
    """Return the reply that a value means, with no id. May raise `NoAnswer`, or anything."""
    if hello.answers == "intervals":
        return Reply("", intervals=_pairs(value, hello.format))
    if hello.answers == "first":
        return Reply("", first=None if value is None else number(value, hello.format))
    if isinstance(value, bool):
        return Reply("", hit=value)
    if type(value).__module__ == "numpy" and type(value).__name__ in ("bool", "bool_"):
        return Reply("", hit=bool(value))
    raise NoAnswer(f"{seen(value)}, and not True or False")


def _pairs(value: object, fmt: Format) -> Pairs:
    if isinstance(value, str | bytes | dict) or not hasattr(value, "__iter__"):
        raise NoAnswer(f"{seen(value)}, and not a list of pairs (an empty one is a miss)")
    pairs: list[tuple[float, float]] = []
    for pair in value:
        if len(pairs) == MOST:
            raise NoAnswer(f"more than {MOST} intervals")
        pairs.append(_pair(pair, fmt))
    return tuple(pairs)


def _pair(pair: object, fmt: Format) -> tuple[float, float]:
    if isinstance(pair, str | bytes | dict | set) or not hasattr(pair, "__iter__"):
        raise NoAnswer(f"an interval that is {seen(pair)}, and not a pair of numbers")
    ends: list[float] = []
    for end in pair:
        if len(ends) == 2:
            raise NoAnswer(f"an interval of more than two numbers: {seen(pair)}")
        ends.append(math.inf if end is None else number(end, fmt))
    if len(ends) != 2:
        raise NoAnswer(f"an interval that has not two numbers: {seen(pair)}")
    return ends[0], ends[1]


def number(value: object, fmt: Format) -> float:
    """Return a value as the nearest number of a format. Raises `NoAnswer` if it is no number."""
    if type(value) is not float:
        if isinstance(value, bool | str | bytes | bytearray) or not isinstance(
            value, SupportsFloat
        ):
            raise NoAnswer(f"{seen(value)} where a number has to be")
        try:
            value = float(value)
        except OverflowError:
            value = math.inf if value > 0 else -math.inf  # type: ignore[operator]
        except (TypeError, ValueError):
            raise NoAnswer(f"{seen(value)} where a number has to be") from None
    return value if fmt.name == "binary64" else fmt.nearest(value)


def seen(value: object) -> str:
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
