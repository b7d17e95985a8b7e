"""What the words of a target mean: a program to run, or code to load.

    module:function   a Python callable, `intersect(solid, ray) -> pairs` with the objects of
                      raycert.cases.model, such as reference.tracer:intersect
    dir/tracer.py:function
                      the same in a file, of any name, wherever it lies
    ./tracer.so       a shared library (.so, .dylib, .dll) with the C signatures of raycert.h
    anything else     a program that speaks the line protocol

A file that exists is never taken for a callable, whatever its name.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from raycert.oracle.client.dialogue import Command, Target, Unusable
from raycert.oracle.client.inprocess import InProcess

if TYPE_CHECKING:
    from raycert.oracle.client.worker import Loaded

LIBRARIES = (".so", ".dylib", ".dll")
CALLABLE = re.compile(r"([^\W\d]\w*(\.[^\W\d]\w*)*|.+\.py):[^\W\d]\w*(\.[^\W\d]\w*)*")


def target(words: Sequence[str]) -> Target:
    """Return the target that the words of a command line name. Raises `Unusable`.

    Nothing is started or loaded yet. `replay.greet` and `replay.run` take it, any number of
    times, and guard against all that it may do.
    """
    if len(words) == 1:
        [word] = words
        exists = Path(word).is_file()
        if word.endswith(LIBRARIES):
            if not exists:
                raise Unusable(f"there is no file {word!r}. A shared library is given by its path.")
            return InProcess("library", word)
        if not exists and CALLABLE.fullmatch(word):
            return InProcess("callable", word)
    return Command(tuple(words))


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
