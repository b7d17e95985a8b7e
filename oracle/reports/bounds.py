"""The domains of a type of solid, as a picture and in words: declared, measured, and what fails.

A line for each quantity of cases/domain.py, all over one axis of powers of ten: what is declared,
what was measured, and a tick for each row that fails. Of a row that is bounded on both sides, such
as by its sizes, the least and the greatest have one each.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor, log10
from typing import Any
from xml.etree.ElementTree import Element

from raycert.cases.domain import QUANTITIES, Domain, quantities, read_domain, short
from raycert.cases.forms import read_ray, read_solid
from raycert.oracle.certify.widest import ORDINARY
from raycert.oracle.reports.picture import BAR, GUTTER, PLOT, ROW, WIDTH, drawing, el, label
from raycert.oracle.reports.reading import Json, count, levels_asked, limit

Span = tuple[float | None, float | None]
MOST = 8
"""Numbers on the axis."""


@dataclass(frozen=True, slots=True)
class QuantityLine:
    """A quantity: its bounds, None for none, and the logarithms of where rows fail.

    `beyond` is the first row that fails beyond what was measured.
    """

    name: str
    declared: Span | None
    measured: Span | None
    failing: tuple[float, ...]
    beyond: str

    def is_beyond(self, log: float) -> bool:
        """Whether a row that fails lies beyond what was measured; all do where nothing was."""
        if self.measured is None:
            return True
        low, high = self.measured
        return (low is not None and log < _log(low)) or (high is not None and log > _log(high))

    @property
    def words(self) -> tuple[str, ...]:
        """Return what is declared, what was measured, and where rows fail."""
        ends = (self.failing[0], self.failing[-1]) if self.failing else ()
        fails = " to ".join(dict.fromkeys(f"{10.0**x:.2g}" for x in ends)) or "nowhere"
        return self.name, _between(self.declared), _between(self.measured), fails, self.beyond


def _between(span: Span | None) -> str:
    if span is None:
        return ""
    low, high = span
    if low is None:
        return "any" if high is None else f"up to {short(high)}"
    return f"from {short(low)}" if high is None else f"{short(low)} to {short(high)}"


def domains(certificate: Json) -> list[Json]:
    """Return for each type of solid that fails a level that was asked, a picture and its words."""
    return [
        _shown(certificate, name, solid["measured"], level)
        for name, solid in certificate["solids"].items()
        if (level := _lowest(solid["measured"], certificate))
    ]


def _lowest(measures: Json, certificate: Json) -> str | None:
    """Return the lowest level asked for that is not granted; None where all are."""
    return next((level for level in levels_asked(certificate) if level in measures), None)


def _shown(certificate: Json, name: str, measures: Json, level: str) -> Json:
    found = measures[level]
    rows = failures(certificate, name, level)
    lines = list(quantity_lines(certificate, found, rows))
    text = f"{level}{limit(found)}" if found else f"{level} in no domain"
    title = f"{name.replace('_', ' ')}: {text}; {count(len(rows), 'row')} of it fail"
    return {
        "solid": name,
        "caption": text,
        "drawing": drawn(lines, title),
        "words": [line.words for line in lines],
    }


def failures(certificate: Json, name: str, level: str) -> list[Json]:
    """Return the failures of a level for a type of solid, also those outside what is declared."""
    return [
        failed
        for failed in certificate["failures"]
        if failed["solid"]["type"] == name
        and level in failed["faults"]
        and failed["tier"] != "range"
        and failed["place"] != "degenerate"
    ]


def quantity_lines(
    certificate: Json, found: Json | None, rows: Sequence[Json]
) -> Iterator[QuantityLine]:
    """Yield the lines: `found` is the measured domain, `rows` are those that fail."""
    domain = read_domain(certificate["domain"]["declared"])
    declared = _bounds(domain) if domain else {}
    measured = _bounds(read_domain(found["domain"])) if found and found["domain"] else {}
    edges = {edge["quantity"]: edge["row"] for edge in (found["edges"] if found else ())}
    spans = [_spans(row) for row in rows]
    for name in QUANTITIES:
        values = {x for span in spans for x in span.get(name, ()) if x > 0}
        failing = tuple(sorted({_log(x) for x in values}))
        spans_of = declared.get(name), measured.get(name)
        yield QuantityLine(name, *spans_of, failing, edges.get(name, ""))


def _spans(row: Json) -> dict[str, tuple[Fraction, Fraction]]:
    solid, ray = read_solid(row["solid"], "solid", "hex"), read_ray(row["ray"], "ray", "hex")
    return quantities(solid, ray).spans()


def _bounds(domain: Domain) -> dict[str, Span]:
    return {name: (low, high) for name, low, high in domain.bounds()}


def _log(x: Fraction | float) -> float:
    top, bottom = x.as_integer_ratio()
    return log10(top) - log10(bottom)


# The picture.


@dataclass(frozen=True, slots=True)
class DecadeAxis:
    """The axis of a picture, from one power of ten to another."""

    low: int
    high: int

    @classmethod
    def of(cls, lines: Sequence[QuantityLine]) -> DecadeAxis:
        """Return an axis that has all bounds and all that fails, with room at both ends."""
        spans = [span for line in lines for span in (line.declared, line.measured) if span]
        ends = [_log(x) for span in spans for x in span if x is not None]
        ends += [x for line in lines for x in line.failing] + [-3.0, 3.0]
        return cls(floor(min(ends)) - 1, ceil(max(ends)) + 1)

    def x(self, log: float) -> float:
        return GUTTER + PLOT * (log - self.low) / (self.high - self.low)

    def bar(self, span: Span) -> tuple[float, float]:
        """Return where a range begins and ends; at the border where it has no bound."""
        low, high = span
        ends = self.low if low is None else _log(low), self.high if high is None else _log(high)
        left, right = map(self.x, ends)
        return left, right

    def numbers(self) -> range:
        """Return the powers of ten that are written."""
        steps = (1, 2, 3, 5, 10, 20, 50, 100, 200)
        step = next(n for n in steps if (self.high - self.low) / n <= MOST)
        return range(-(-(self.low + 1) // step) * step, self.high, step)


def drawn(lines: Sequence[QuantityLine], title: str) -> str:
    """Return the picture."""
    axis, foot = DecadeAxis.of(lines), 4.0 + ROW * len(lines)
    parts = [part for i, line in enumerate(lines) for part in _line(line, axis, 4.0 + ROW * i)]
    for power in axis.numbers():
        x = axis.x(power)
        parts.append(el("line", x1=x, x2=x, y1=foot, y2=foot + 4, kind="tick"))
        parts.append(label(x, foot + 17, f"1e{power}" if power else "1", "number", "middle"))
    return drawing(foot + 22, title, *parts)


def _line(line: QuantityLine, axis: DecadeAxis, y: float) -> Iterator[Element]:
    yield label(0, y + BAR - 1, line.name, "name")
    yield el("line", x1=GUTTER, x2=WIDTH, y1=y + BAR / 2, y2=y + BAR / 2, kind="rail")
    low, high = ORDINARY[line.name]
    usual = axis.bar((low or None, high))
    bars: list[tuple[tuple[float, float], str, float]] = [(usual, "usual", 0)]
    bars += [(axis.bar(line.declared), "declared", 0)] if line.declared else []
    bars += [(axis.bar(line.measured), "within", 3)] if line.measured else []
    for (left, right), kind, inset in bars:
        size: dict[str, Any] = {"y": y + inset, "height": BAR - 2 * inset}
        yield el("rect", x=left, width=max(right - left, 1.0), kind=kind, **size)
    for beyond in (False, True):  # those within are explained by another quantity
        kind = "failing" if beyond else "failing faint"
        for x in sorted({round(axis.x(x)) for x in line.failing if line.is_beyond(x) == beyond}):
            yield el("line", x1=x, x2=x, y1=y - 2, y2=y + BAR + 2, kind=kind)
