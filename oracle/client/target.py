"""What the words of a target mean: a program to run, or code to load.

    reference, oracle the built-in implementations, as programs
    module:function   a Python callable, `intersect(solid, ray) -> pairs` with the objects of
                      raycert.cases.model, such as reference.tracer:intersect
    dir/tracer.py:function
                      the same in a file, of any name, wherever it lies
    ./tracer.so       a shared library (.so, .dylib, .dll) with the C signatures of raycert.h
    anything else     a program that speaks the line protocol

A file that exists is never taken for a callable, whatever its name.
"""

from __future__ import annotations

import ast
import os
import re
import shlex
from collections.abc import Sequence
from pathlib import Path
from shutil import which
from typing import TYPE_CHECKING

from raycert.oracle.client.apart import ours
from raycert.oracle.client.dialogue import Command, Target, Unusable
from raycert.oracle.client.inprocess import InProcess

if TYPE_CHECKING:
    from raycert.oracle.client.worker import Loaded

BUILT_IN = {
    "oracle": ("raycert", "serve", "oracle"),
    "reference": ("raycert.reference",),
}
LIBRARIES = (".so", ".dylib", ".dll")
CALLABLE = re.compile(r"([^\W\d]\w*(\.[^\W\d]\w*)*|.+\.py):[^\W\d]\w*(\.[^\W\d]\w*)*")


def target(words: Sequence[str]) -> Target:
    """Return the target that the words of a command line name. Raises `Unusable`.

    Nothing is started or loaded yet. `replay.greet` and `replay.run` take it, any number of
    times, and guard against all that it may do.
    """
    if len(words) == 1:
        [word] = words
        if word in BUILT_IN:
            return Command(ours(*BUILT_IN[word]))
        exists = Path(word).is_file()
        if word.endswith(LIBRARIES):
            if not exists:
                raise Unusable(f"there is no file {word!r}. A shared library is given by its path.")
            return InProcess("library", word)
        if not exists and CALLABLE.fullmatch(word):
            return InProcess("callable", word)
        if file := _python_file(word):
            raise Unusable(_what_to_write(file))
    return Command(tuple(words))


def _python_file(word: str) -> Path | None:
    """Return the file of Python that a word means, which is no program by itself; None else."""
    path = Path(word)
    if path.suffix != ".py" and not which(word):
        path = path.with_name(f"{path.name}.py")
    runs = "/" in word and path == Path(word) and os.access(path, os.X_OK)
    return None if runs or path.suffix != ".py" or not path.is_file() else path


def _what_to_write(path: Path) -> str:
    """Return how a file of Python is given, by the functions that it has."""
    try:
        body = ast.parse(path.read_bytes()).body
    except (OSError, SyntaxError, ValueError, RecursionError):
        body = []
    names = [
        node.name
        for node in body
        if isinstance(node, ast.FunctionDef) and len(node.args.posonlyargs + node.args.args) == 2
    ]
    name = next(iter(sorted(names, key=lambda name: name != "intersect")), "FUNCTION")
    function = shlex.quote(f"{path}:{name}")
    program = shlex.join(["python3", str(path)])
    return (
        f"{str(path)!r} is a file of Python, and not a program. For its function of a solid and a "
        f"ray write {function}; if it speaks the line protocol, write -- {program}"
    )


def load(words: Sequence[str]) -> Loaded:
    """Load a callable or a library into this process, for direct calls. Raises `Unusable`.

    Unprotected: what crashes, hangs or exits does so here. Only for code that has been certified,
    or whose throughput is to be measured.
    """
    found = target(words)
    if not isinstance(found, InProcess):
        raise Unusable(
            f"{' '.join(words)!r} is a program. Only module:function and a shared library can be "
            "loaded."
        )
    from raycert.oracle.client.worker import KINDS, CannotLoad

    try:
        return KINDS[found.kind](found.spec)
    except CannotLoad as error:
        raise Unusable(str(error)) from None
