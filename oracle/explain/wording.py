"""The form of a derivation: passages made of lines, and how exact numbers are worded in them.

Everything is data, so that a terminal and a page can show the same derivation. Integers are
written out in full; `shorten` is for the reader's sake and is left to whoever shows the lines.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from fractions import Fraction
from typing import Any

from raycert.cases.accept import Accept, Pairs
from raycert.cases.formats import BINARY64, Format
from raycert.cases.table import HOLDS, Row
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.surd import Surd, decimal, fraction

RELATION = {-1: "< 0", 0: "= 0", 1: "> 0"}
"""The words for a sign."""
Exact = tuple[Fraction, Fraction, Fraction]
SHORT = 22
"""Exact numbers up to this many characters stand for themselves; longer ones get digits too."""


@dataclass(frozen=True, slots=True)
class Fact:
    """`name` = `value`, exactly; `about` in a few digits where that is long; `sign` as `> 0`."""

    name: str
    value: str
    about: str = ""
    sign: str = ""
    note: str = ""


@dataclass(frozen=True, slots=True)
class Demand:
    """What a row asks of one quantity; `holds` is None where the quantity is undefined."""

    relation: str
    holds: bool | None


@dataclass(frozen=True, slots=True)
class Entry:
    """One row of a case table: a cell or None for each quantity, what it emits."""

    name: str
    cells: tuple[Demand | None, ...]
    pairs: str
    taken: bool


@dataclass(frozen=True, slots=True)
class Table:
    """A case table beside this case: the quantities, their signs here, all the rows."""

    quantities: tuple[str, ...]
    signs: tuple[str, ...]
    rows: tuple[Entry, ...]


@dataclass(frozen=True, slots=True)
class Note:
    """A sentence."""

    text: str


@dataclass(frozen=True, slots=True)
class Passage:
    """One passage of a derivation: what it is about, and its lines."""

    heading: str
    lines: tuple[Fact | Table | Note, ...]


def as_json(passage: Passage) -> dict[str, Any]:
    """Return a passage as a JSON object; each line says its form: `fact`, `table` or `note`."""
    lines = [{"form": type(line).__name__.lower(), **asdict(line)} for line in passage.lines]
    return {"heading": passage.heading, "lines": lines}


def row_table(
    rows: tuple[Row, ...], names: Mapping[str, str], signs: Mapping[str, int], taken: Row
) -> Table:
    quantities = list(dict.fromkeys(q for row in rows for q, _ in row.condition))
    entries = []
    for row in rows:
        asked = dict(row.condition)
        cells = tuple(_cell(q, asked[q], signs) if q in asked else None for q in quantities)
        entries.append(Entry(row.name, cells, row.pairs, row.name == taken.name))
    return Table(
        tuple(names[q] for q in quantities),
        tuple(RELATION[signs[q]] if q in signs else "-" for q in quantities),
        tuple(entries),
    )


def _cell(quantity: str, relation: str, signs: Mapping[str, int]) -> Demand:
    return Demand(relation, signs[quantity] in HOLDS[relation] if quantity in signs else None)


def scalar(name: str, value: Fraction, note: str = "", sign: bool = True) -> Fact:
    text = dyadic(value)
    relation = RELATION[(value > 0) - (value < 0)] if sign else ""
    digits = about(value) if len(text) > SHORT or "*" in text else ""
    return Fact(name, text, digits, relation, note)


def vector(name: str, value: Exact, note: str = "") -> Fact:
    """Return the fact of a vector of dyadic numbers; long ones share one power of two."""
    texts = [dyadic(x) for x in value]
    if all(len(text) <= SHORT and "*" not in text for text in texts):
        return Fact(name, f"({', '.join(texts)})", note=note)
    shift = max(x.denominator.bit_length() - 1 for x in value)
    whole = [int(x * 2**shift) for x in value]
    if not shift:
        shift = -min((n & -n).bit_length() - 1 for n in whole if n)
        whole = [n >> -shift for n in whole]
    power = f"*2^{-shift}" if shift else ""
    digits = ", ".join(about(x, 5) for x in value)
    return Fact(name, f"({', '.join(map(str, whole))}){power}", f"({digits})", note=note)


def number(name: str, value: Surd, note: str = "", sign: bool = True) -> Fact:
    """Return the fact of an endpoint: the fraction where it is a short one, else 20 digits."""
    relation = RELATION[value.sign()] if sign else ""
    return Fact(name, brief(value, 20), sign=relation, note=note)


def brief(value: Surd, digits: int = 12) -> str:
    """Return a number in so many digits; short rational ones and infinity exactly."""
    rational = value.rational()
    if rational is None:
        return tidy(decimal(value, digits))
    denominator = rational.denominator
    short = str(rational) if denominator & (denominator - 1) else dyadic(rational)
    return short if len(short) <= digits and "*" not in short else tidy(decimal(value, digits))


def tidy(digits: str) -> str:
    """Return scientific digits without the power where it is a small one.

    >>> tidy("1.41421e+0"), tidy("4.25e-3"), tidy("1.0e+9")
    ('1.41421', '0.00425', '1.0e+9')
    """
    mantissa, _, power = digits.partition("e")
    if not power or not -4 <= int(power) < len(mantissa.replace("-", "")) - 2:
        return digits
    sign = "-" if mantissa.startswith("-") else ""
    plain = mantissa.lstrip("-").replace(".", "")
    point = int(power) + 1
    if point <= 0:
        return f"{sign}0.{'0' * -point}{plain}"
    return f"{sign}{plain[:point]}.{plain[point:]}".rstrip(".")


def dyadic(value: Fraction) -> str:
    """Return a dyadic number exactly: a short integer or decimal, else an integer * 2^k.

    >>> dyadic(Fraction(5, 4)), dyadic(Fraction(0.1)), dyadic(Fraction(2**90))
    ('1.25', '3602879701896397*2^-55', '1*2^90')
    """
    top, shift = value.numerator, value.denominator.bit_length() - 1
    if not shift and len(str(top)) <= SHORT:
        return str(top)
    if 0 < shift <= 16 and len(str(top)) < 16:
        whole = abs(top) * 5**shift
        text = f"{whole:0{shift + 1}d}"
        return f"{'-' * (top < 0)}{text[:-shift]}.{text[-shift:]}"
    even = (top & -top).bit_length() - 1 if not shift else 0
    power = even - shift
    return f"{top >> even}*2^{power}" if power else str(top)


def about(value: Fraction, digits: int = 6) -> str:
    if not value:
        return "0"
    return tidy(decimal(fraction(value.numerator, value.denominator), digits))


def endpoint(value: Surd) -> str:
    """Return an endpoint exactly: `(a - sqrt(b)) / c` in integers, a fraction, or inf.

    >>> endpoint(Surd(6, -2, 8, 4)), endpoint(Surd(4, 0, 0, 6))
    ('(3 - sqrt(8)) / 2', '2/3')
    """
    rational = value.rational()
    if not value.finite or rational is not None:
        return "inf" if rational is None else str(rational)
    a, b, c = value.polynomial()
    top, square, bottom = -b, b * b - 4 * a * c, 2 * a
    for prime in (2, 3, 5, 7):
        while not (top % prime or bottom % prime or square % prime**2):
            top, square, bottom = top // prime, square // prime**2, bottom // prime
    sign = "+" if value.y > 0 else "-"
    root = f"{top or ''} {sign} sqrt({square})" if top else f"{'-' * (sign == '-')}sqrt({square})"
    if bottom == 1:
        return root
    return f"({root}) / {bottom}" if top else f"{root} / {bottom}"


def listed(intervals: Intervals) -> str:
    return " ".join(f"[{brief(a)}, {brief(b)}]" for a, b in intervals) or "{}"


def numbers(pairs: Pairs, fmt: Format = BINARY64) -> str:
    """Return a list of numbers of a format, each in the fewest digits that identify it."""
    return " ".join(f"[{shortest(a, fmt)}, {shortest(b, fmt)}]" for a, b in pairs) or "{}"


def shortest(x: float, fmt: Format = BINARY64) -> str:
    """Return the shortest decimal that rounds to `x` in its format.

    >>> from raycert.cases.formats import BINARY32
    >>> shortest(BINARY32.nearest(0.1), BINARY32), shortest(-3.0), shortest(0.1)
    ('0.1', '-3', '0.1')
    """
    text = repr(x)
    if fmt is not BINARY64 and fmt.holds(x):
        text = next((t for n in range(1, 10) if fmt.nearest(float(t := f"{x:.{n}g}")) == x), text)
    return text.removesuffix(".0")


def shorten(text: str) -> str:
    """Return a text with the integers of more than 20 digits cut in the middle.

    >>> shorten("x = " + "12345" * 10)
    'x = 123451...2345 (50 digits)'
    """
    is_vector = text.startswith("(") and text.count(",") == 2

    def cut(match: re.Match[str]) -> str:
        digits = match[0]
        short = f"{digits[:6]}...{digits[-4:]}"
        return short if is_vector else f"{short} ({len(digits)} digits)"

    return re.sub(r"(?<![\d.])\d{21,}", cut, text)


def enclosing(down: float, up: float, nearest: float, fmt: Format) -> Iterator[Fact]:
    """Yield the numbers below and above an endpoint, or the one that it is."""
    if down == up:
        yield Fact("  number", shortest(down, fmt), note=f"{down.hex()} exactly")
        return
    for name, x in (("  down", down), ("  up", up)):
        yield Fact(name, shortest(x, fmt), note=x.hex() + (" nearest" if x == nearest else ""))


def accepting(level: str, accept: Accept, fmt: Format) -> Iterator[Fact]:
    yield Fact(f"{level} inner", numbers(accept.inner, fmt), note="each lies in a pair")
    most = ", ".join(map(str, accept.most))
    pairs = f"at most {most} {'pair' if most == '1' else 'pairs'}" if most else "no pair"
    yield Fact(f"{level} outer", numbers(accept.outer, fmt), note=pairs)
