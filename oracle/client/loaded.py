"""Code of others in this process: a Python callable or a shared library, with what it declares.

Nothing here protects from it: it may crash, hang or print. A worker does (worker.py).
"""

from __future__ import annotations

import importlib
import json
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import VERSION, BadLine, Hello, Reply, read_hello
from raycert.oracle.client.process import Failure
from raycert.oracle.client.values import outcome, told

LIBRARIES = (".so", ".dylib", ".dll")


class CannotLoad(Exception):
    """The code cannot be had; the text says what was seen and what to do."""


@dataclass(frozen=True, slots=True)
class Loaded:
    """Code that is in this process: what it declares, and the bare call, which may do anything."""

    hello: Hello
    raw: Callable[[Solid, Ray], object]

    def __call__(self, solid: Solid, ray: Ray) -> Reply | Failure:
        """Return the answer to a question, as a reply without an id."""
        return outcome(partial(self.raw, solid, ray), self.hello)


def load_callable(spec: str) -> Loaded:
    """Load `module:function`; the current directory is searched first. Raises `CannotLoad`.

    A dict `hello` that the function or else its module has declares it, with the fields of the
    protocol's hello; where there is none, it is a closed binary64 tracer of every solid.
    """
    module_name, _, path = spec.partition(":")
    if "" not in sys.path:
        sys.path.insert(0, "")
    try:
        module = importlib.import_module(module_name)
    except (Exception, SystemExit) as error:
        raise CannotLoad(
            f"cannot import {module_name!r}: {told(error)}. The target is MODULE:FUNCTION, looked "
            "for in the current directory, then on PYTHONPATH, then among the installed packages."
        ) from None
    found: object = module
    for name in path.split("."):
        if not hasattr(found, name):
            place = getattr(module, "__file__", "built in")
            raise CannotLoad(
                f"{module_name!r} has no {path!r} (it is {place}). The target is MODULE:FUNCTION, "
                "such as tracer:intersect."
            )
        found = getattr(found, name)
    if not callable(found):
        raise CannotLoad(
            f"{spec!r} is a {type(found).__name__}, and not a function intersect(solid, ray)."
        )
    declared = getattr(found, "hello", getattr(module, "hello", {}))
    return Loaded(_declared(declared, spec), found)


def _declared(fields: object, spec: str) -> Hello:
    if not isinstance(fields, dict):
        raise CannotLoad(
            f"the `hello` of {spec!r} is a {type(fields).__name__}: it has to be a dict of the "
            'fields of a hello, such as {"name": "my tracer", "solids": ["sphere"]}.'
        )
    try:
        line = json.dumps({"hello": VERSION, "name": spec, **fields})
    except (TypeError, ValueError, RecursionError) as error:
        raise CannotLoad(f"the `hello` of {spec!r} is not JSON: {error}.") from None
    return read_declared(line.encode(), spec)


def read_declared(line: bytes, spec: str) -> Hello:
    """Return the hello that code gives of itself. Raises `CannotLoad`."""
    try:
        return read_hello(line)
    except BadLine as error:
        raise CannotLoad(f"{spec!r} gave a bad hello: {error}.") from None
