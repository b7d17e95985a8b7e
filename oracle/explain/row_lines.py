"""A golden row in readable lines: what the file holds, with nothing computed anew."""

from __future__ import annotations

from collections.abc import Iterator

from raycert.cases.flags import FLAGS
from raycert.cases.formats import Format
from raycert.cases.row import End, GoldenRow
from raycert.oracle.explain.form import Fact, Step, numbers, shortest, tidy

POWERS = ("", " t", " t^2")


def row_steps(row: GoldenRow, fmt: Format) -> Iterator[Step]:
    """Yield the parts of a row: what it is, each exact endpoint, the lists."""
    yield Step("Row", tuple(_facts(row)))
    for i, span in enumerate(row.intervals, 1):
        touch = f", a touch ({span.touch})" if span.touch else ""
        enter, leave = _end("enter", span.enter, fmt), _end("leave", span.leave, fmt)
        yield Step(f"Exact interval {i} of {len(row.intervals)}{touch}", (*enter, *leave))
    yield Step("CaseLists", tuple(_lists(row, fmt)))


def _facts(row: GoldenRow) -> Iterator[Fact]:
    yield Fact("rows", " ".join(row.rows))
    size = "infinite, or t = 0 only" if row.condition is None else f"<= 2^{row.condition}"
    yield Fact("condition", size)
    yield Fact("decisive for", ", ".join(row.decisive) or "no level")
    for name in row.flags:
        yield Fact(f"flag {name}", FLAGS[name].trouble if name in FLAGS else "not in the legend")


def _end(name: str, end: End, fmt: Format) -> Iterator[Fact]:
    if end.polynomial is None and end.fraction is None:
        yield Fact(name, "inf")
        return
    yield Fact(name, _exactly(end))
    yield Fact("  digits", tidy(end.digits))
    if end.down == end.up:
        yield Fact("  number", shortest(end.nearest, fmt), note=f"{end.nearest.hex()} exactly")
    else:
        for side, x in (("  down", end.down), ("  up", end.up)):
            nearest = " nearest" if x == end.nearest else ""
            yield Fact(side, shortest(x, fmt), note=x.hex() + nearest)
    yield Fact("  on", ", ".join(end.faces) or "no face", note=end.kind)


def _exactly(end: End) -> str:
    """Return an endpoint as the row has it: a fraction, or which root of a polynomial."""
    if end.fraction:
        top, bottom = end.fraction
        return str(top) if bottom == 1 else f"{top}/{bottom}"
    coefficients = end.polynomial or ()
    degree = len(coefficients) - 1
    terms = [
        f"{'-' if c < 0 else '+'} {'' if abs(c) == 1 and degree - i else abs(c)}"
        f"{POWERS[degree - i] if abs(c) != 1 else POWERS[degree - i].strip()}"
        for i, c in enumerate(coefficients)
        if c
    ]
    which = "larger" if end.root else "smaller"
    return f"the {which} root of {' '.join(terms).removeprefix('+ ')}"


def _lists(row: GoldenRow, fmt: Format) -> Iterator[Fact]:
    yield Fact("expected", numbers(row.expected, fmt))
    for level, accept in row.accept.items():
        yield Fact(f"{level} inner", numbers(accept.inner, fmt))
        most = ", ".join(map(str, accept.most))
        note = f"at most {most} pairs" if accept.most else "no pair"
        yield Fact(f"{level} outer", numbers(accept.outer, fmt), note=note)
