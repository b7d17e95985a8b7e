"""The oracle as an implementation: its answers through the line protocol."""

from __future__ import annotations

from typing import cast

from cases.formats import FORMATS, Spelling
from cases.model import Ray, Solid
from cases.protocol import Hello
from cases.serve import serve
from oracle.rounding import expected
from oracle.trace import trace


def serve_oracle(precision: str, numbers: str) -> None:
    """Answer every case with the exact list, correctly rounded to the precision."""
    fmt = FORMATS[precision]

    def intersect(solid: Solid, ray: Ray) -> tuple[tuple[float, float], ...]:
        return expected(trace(solid, ray).intervals, fmt)[1]

    hello = Hello("raycert oracle", precision=precision, numbers=cast(Spelling, numbers))
    serve(intersect, hello)
