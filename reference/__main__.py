"""`python -m raycert.reference`: the compact tracer as a server of the line protocol."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version

from raycert.cases.degenerate import DEGENERACIES
from raycert.cases.protocol import Hello, serve
from raycert.reference.tracer import intersect


def hello() -> Hello:
    """Return what the tracer declares: every solid, binary64, `closed`."""
    try:
        return Hello("raycert reference", version("raycert"), degenerate=DEGENERACIES)
    except PackageNotFoundError:
        return Hello("raycert reference", degenerate=DEGENERACIES)


if __name__ == "__main__":
    serve(intersect, hello())
