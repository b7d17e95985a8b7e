"""A case as a command takes it: a golden row, a solid and a ray by options, or a JSON object.

Numbers on a command line are decimals or hex floats, and are taken to the nearest number of the
format; which of them are not exact is noted.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import isfinite
from typing import Any, TypeVar

import click

from raycert.cases.files import BadFile, read_all, read_as
from raycert.cases.formats import FORMATS, Format
from raycert.cases.forms import Json, read_ray, read_solid
from raycert.cases.model import FIELDS, TYPE_NAMES, Refused
from raycert.cases.numbers import Probe
from raycert.cases.row import GoldenRow
from raycert.oracle.commands.options import BadInput, find, golden_option, precision_option, read
from raycert.oracle.exact.surd import enclose, fraction
from raycert.oracle.explain.wording import Fact, about, dyadic

SHAPES = {
    "cylinder": "Axis from P to Q, radius R.",
    "infinite_cylinder": "Axis through P and Q, radius R.",
    "slab": "Between the planes through P and Q, square to PQ.",
    "half_space": "On the side of POINT away from NORMAL.",
    "sphere": "About CENTER, radius R.",
}
"""The solids that options can spell."""
WORDS = {TYPE_NAMES[kind]: fields for kind, fields in FIELDS.items()}
"""What the words of one are, in their order: its fields."""
Decorated = TypeVar("Decorated", bound=Callable[..., Any])


def case_options(function: Decorated) -> Decorated:
    """Add what names one case: an ID, a solid and a ray by options, or --case; and of which rows.

    `count_given` says how many of the three there are, `chosen` gives the case.
    """
    options = [click.argument("id", required=False)]
    for name, about_it in SHAPES.items():
        words = ["R" if field == "radius" else field.upper() for field in WORDS[name]]
        more: dict[str, Any] = {"nargs": len(words), "metavar": " ".join(words), "help": about_it}
        options.append(click.option(f"--{name.replace('_', '-')}", name, **more))
    options.append(click.option("--ray", nargs=2, metavar="U V", help="Origin and direction."))
    options.append(case_option())
    for option in reversed((*options, precision_option, golden_option)):
        function = option(function)
    return function


def case_option(text: str = "", **more: Any) -> Callable[[Decorated], Decorated]:
    text = f"JSON file with solid and ray{text}; - is standard input."
    return click.option("--case", "file", type=click.File("rb"), metavar="FILE", help=text, **more)


def count_given(options: dict[str, Any]) -> int:
    words = options["ray"] or any(options[name] for name in SHAPES)
    return bool(options["id"]) + bool(options["file"]) + bool(words)


ONE_CASE = "give one case: an ID, or --case FILE, or a solid with --ray"


def chosen(options: dict[str, Any], rounded: list[Fact]) -> Probe | GoldenRow:
    """Return the golden row with the ID, or else the case of --case or of the solid and the ray.

    What of the words is no number of the format is noted in `rounded`. Ends the command with exit
    status 2 where there is no such row or case.
    """
    fmt = FORMATS[options["precision"]]
    if options["id"]:
        return find(read(options["precision"], options["golden"]), options["id"])
    if options["file"]:
        return from_json(read_all("--case", options["file"]), fmt, "--case")
    return _from_words(options, fmt, rounded)


def from_json(data: bytes, fmt: Format, option: str) -> Probe:
    """Return the case of an object with solid and ray; strings are hex floats or bit patterns.

    Ends the command with exit status 2 where it is none; `option` names it in the message.
    """

    def read(form: object) -> Probe:
        if not isinstance(form, dict):
            raise Refused("", "is not a JSON object")
        for name in ("solid", "ray"):
            if name not in form:
                raise Refused(name, 'is missing; the form is {"solid": {...}, "ray": {...}}')
        spelling = _spelling(form["ray"])
        ray = read_ray(form["ray"], "ray", spelling, fmt)
        return Probe(read_solid(form["solid"], "solid", spelling, fmt), ray)

    try:
        return read_as(option, data, read)
    except BadFile as error:
        advice = "" if fmt.name == "binary64" else f" (for --precision {fmt.name})"
        raise BadInput(f"{error}{advice}") from None


def _spelling(ray: object) -> Any:
    """Return how the numbers of an object are spelled, told by the ray's first one."""
    origin = ray.get("origin") if isinstance(ray, dict) else None
    first = origin[0] if isinstance(origin, list) and origin else None
    if not isinstance(first, str):
        return "decimal"
    return "hex" if "x" in first.lower() else "bits"


def _from_words(options: dict[str, Any], fmt: Format, rounded: list[Fact]) -> Probe:
    """Return the solid and the ray of the options; note in `rounded` each number not exact."""
    name, *more = [name for name in SHAPES if options[name]] or [""]
    if not name or more or not options["ray"]:
        raise click.UsageError("give one solid and its ray: --cylinder P Q R --ray U V")
    solid: Json = {"type": name}
    try:
        for field, word in zip(WORDS[name], options[name], strict=True):
            read = _number if field == "radius" else _vector
            solid[field] = read(word, f"solid.{field}", fmt, rounded)
        fields = zip(("origin", "direction"), options["ray"], strict=True)
        ray = {field: _vector(word, f"ray.{field}", fmt, rounded) for field, word in fields}
        return Probe(read_solid(solid, fmt=fmt), read_ray(ray, fmt=fmt))
    except Refused as refusal:
        raise BadInput(str(refusal)) from None


def _vector(word: str, path: str, fmt: Format, rounded: list[Fact]) -> list[float]:
    parts = word.split(",")
    if len(parts) != 3:
        raise Refused(path, f"is not three numbers x,y,z without blanks: {word!r:.40}")
    return [_number(part, f"{path}[{i}]", fmt, rounded) for i, part in enumerate(parts)]


def _number(text: str, path: str, fmt: Format, rounded: list[Fact]) -> float:
    """Return the number of the format nearest to a text; note it in `rounded` if it is another."""
    try:
        if not text.isascii() or set(text) & set("_ \t\n"):  # Python reads those in a number
            raise ValueError
        number = float.fromhex(text) if "x" in text.lower() else float(text)
    except (ValueError, OverflowError):
        hint = "write a decimal such as 0.1 or a hex float such as 0x1.8p-3"
        raise Refused(path, f"is not a number: {text!r:.40}; {hint}") from None
    if not isfinite(number):
        raise Refused(path, f"is NaN or beyond {fmt.name}: {text!r:.40}; write a finite number")
    exact = _exactly(text) if number else Fraction(0)
    number = enclose(fraction(exact.numerator, exact.denominator), fmt).nearest
    if not isfinite(number):
        raise Refused(path, f"is beyond {fmt.name}: {text!r:.40}")
    if Fraction(number) != exact or (not number and any(c in "123456789" for c in text[:40])):
        value = Fraction(number)
        rounded.append(Fact(f"{path} {text:.24}", dyadic(value), about(value, 24)))
    return number


def _exactly(text: str) -> Fraction:
    """Return what a decimal or a hex float spells, whose size is that of a binary64 number."""
    text = text.lower()
    if "x" not in text:
        return Fraction(text)
    mantissa, _, power = text.replace("0x", "").partition("p")
    whole, _, part = mantissa.partition(".")
    return Fraction(int(whole + part, 16)) * Fraction(2) ** (int(power or 0) - 4 * len(part))
