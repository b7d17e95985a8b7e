"""The oracle as an implementation: its answers through the line protocol."""

from __future__ import annotations

from typing import cast

from raycert.cases.formats import FORMATS, Spelling
from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import Hello
from raycert.cases.serve import serve
from raycert.oracle.exact.rounding import expected
from raycert.oracle.exact.trace import trace


def serve_oracle(precision: str, numbers: str) -> None:
    """Answer every case with the exact list, correctly rounded to the precision."""
    fmt = FORMATS[precision]

    def intersect(solid: Solid, ray: Ray) -> tuple[tuple[float, float], ...]:
        return expected(trace(solid, ray).intervals, fmt)[1]

    hello = Hello("raycert oracle", precision=precision, numbers=cast(Spelling, numbers))
    serve(intersect, hello)
