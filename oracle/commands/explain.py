"""`raycert explain`: one case, derived in the seed's own steps."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

from oracle.commands.listing import BadInput, find, golden_option, precision_option, read

if TYPE_CHECKING:
    from fractions import Fraction

    from cases.case import Case
    from cases.formats import Format
    from cases.forms import Json
    from oracle.derivation.derive import Derivation
    from oracle.derivation.form import Fact
    from oracle.witness.symbols import Statement

SHAPES = {
    "cylinder": ("p", "q", "radius"),
    "infinite_cylinder": ("p", "q", "radius"),
    "slab": ("p", "q"),
    "half_space": ("point", "normal"),
    "sphere": ("center", "radius"),
}
"""The solids that options can spell, and the fields in the order of their words."""
HELP = {
    "cylinder": "Axis from P to Q, radius R.",
    "infinite_cylinder": "Axis through P and Q, radius R.",
    "slab": "Between the planes through P and Q, square to PQ.",
    "half_space": "On the side of POINT away from NORMAL.",
    "sphere": "About CENTER, radius R.",
}


EXAMPLES = """\b
Examples:
  raycert explain behind/across-just-past
  raycert explain --cylinder 0,0,0 0,0,2 1 --ray=-3,0,1 1,0,0
  raycert explain --half-space 0,0,1 0,0,1 --ray 0,0,0 0,0,0.1
  raycert show behind/across-just-past --json | raycert explain --json -
  raycert explain --symbolic
  raycert explain --json - <<< '{"solid": {"type": "sphere", "center": [0,0,0],
      "radius": 1}, "ray": {"origin": [-3,0,0], "direction": [1,0,0]}}'
"""
Decorated = TypeVar("Decorated", bound=Callable[..., Any])


def _shape(name: str) -> Callable[[Decorated], Decorated]:
    """Return the decorator that adds the option of a solid."""
    words = tuple("R" if field == "radius" else field.upper() for field in SHAPES[name])
    option = f"--{name.replace('_', '-')}"
    return click.option(option, name, nargs=len(words), metavar=" ".join(words), help=HELP[name])


@click.command(epilog=EXAMPLES)
@click.argument("id", required=False)
@_shape("cylinder")
@_shape("infinite_cylinder")
@_shape("slab")
@_shape("half_space")
@_shape("sphere")
@click.option("--ray", nargs=2, metavar="U V", help="Origin and direction of the ray.")
@click.option(
    "--json", "file", type=click.File("rb"), help="File with solid and ray; - is standard input."
)
@click.option(
    "--format",
    "form",
    type=click.Choice(("text", "json")),
    default="text",
    show_default=True,
    help="json: the golden row and the steps, as data.",
)
@click.option("--full", is_flag=True, help="Long integers in full.")
@click.option(
    "--symbolic",
    is_flag=True,
    help="Before the case, or alone: SymPy's proofs of the formulas used.",
)
@precision_option
@golden_option
def explain(id: str | None, form: str, full: bool, symbolic: bool, **options: Any) -> None:
    """Derive one case in the seed's steps: every quantity of its three problems, exactly.

    Shown are the row of each table that holds and why the others do not, the endpoints exactly
    and rounded, their condition, and what the textbook formula makes of them.

    The case is a golden row by its ID, or a solid and a ray by options, or an object of the line
    protocol by --json (the only way for a union, an intersection or a difference). Vectors are
    x,y,z without blanks; numbers are decimals or hex floats such as 0x1.8p-3.

    --symbolic needs no case. It derives the seed's formulas from the definitions and proves them
    equal to the oracle's code, run on symbols; exit 1 if a proof fails, 3 without SymPy.
    """
    given = bool(id) + bool(options["file"])
    given += bool(options["ray"] or any(options[name] for name in SHAPES))
    if given > 1 or not (given or symbolic):
        raise click.UsageError("give one case: an ID, or --json, or a solid with --ray")
    derivation = _derivation(id, options) if given else None
    statements = None
    if symbolic:
        from oracle.commands.symbolic import proofs

        statements = proofs()
    _show(derivation, statements, form, full)


def _derivation(id: str | None, options: dict[str, Any]) -> Derivation:
    """Return the derivation of the case that the words name."""
    from dataclasses import replace

    from cases.formats import FORMATS
    from oracle.derivation.derive import derive, given
    from oracle.derivation.form import Step

    fmt = FORMATS[options["precision"]]
    if id:
        return _from_golden(id, options)
    rounded: list[Fact] = []
    if options["file"]:
        case = _from_json(options["file"].read(), fmt)
    else:
        case = given(*_from_words(options, fmt, rounded))
    derivation = derive(case, fmt)
    if not rounded:
        return derivation
    taken = Step(f"Taken as {fmt.name} numbers", tuple(rounded))
    return replace(derivation, steps=(taken, *derivation.steps))


def _show(
    derivation: Derivation | None, statements: list[Statement] | None, form: str, full: bool
) -> None:
    """Print the proofs, then the case; exit 1 where a proof failed."""
    from rich.console import Console

    console = Console()
    if form == "json":
        _show_json(derivation, statements)
    else:
        if statements is not None:
            from oracle.commands.symbolic import show_proofs

            show_proofs(statements, console)
        if derivation is not None:
            from oracle.derivation.text import show

            if statements is not None:
                console.print()
            show(derivation, console, full)
    if not all(statement.proved for statement in statements or ()):
        raise SystemExit(1)


def _show_json(derivation: Derivation | None, statements: list[Statement] | None) -> None:
    import json

    form: dict[str, Any] = {}
    if statements is not None:
        from oracle.commands.symbolic import to_json as proofs_to_json

        form["symbolic"] = proofs_to_json(statements)
    if derivation is not None:
        from oracle.derivation.derive import to_json

        form |= to_json(derivation)
    click.echo(json.dumps(form, indent=1))


def _from_golden(id: str, options: dict[str, Any]) -> Derivation:
    from oracle.derivation.derive import as_given, derive

    corpus = read(options["precision"], options["golden"])
    row = find(corpus, id)
    derivation = derive(as_given(row), corpus.format, row.family)
    if derivation.row != row:
        click.echo(f"{id}: the file holds another answer; see: raycert golden check", err=True)
    return derivation


def _from_json(data: bytes, fmt: Format) -> Case:
    """Return the case of an object with solid and ray; strings are hex floats or bit patterns."""
    from cases.forms import read_ray, read_solid
    from cases.model import Refused
    from cases.protocol import BadLine, decode
    from oracle.derivation.derive import given

    try:
        form = decode(data)
        for name in ("solid", "ray"):
            if name not in form:
                raise Refused(name, 'is missing; the form is {"solid": {...}, "ray": {...}}')
        spelling = _spelling(form["ray"])
        ray = read_ray(form["ray"], "ray", spelling, fmt)
        return given(read_solid(form["solid"], "solid", spelling, fmt), ray)
    except BadLine as error:
        raise BadInput(f"--json {error}") from None
    except Refused as refusal:
        raise BadInput(f"{refusal}{_advice(fmt)}") from None


def _spelling(ray: object) -> Any:
    """Return how the numbers of an object are spelled, told by the ray's first one."""
    origin = ray.get("origin") if isinstance(ray, dict) else None
    first = origin[0] if isinstance(origin, list) and origin else None
    if not isinstance(first, str):
        return "decimal"
    return "hex" if "x" in first.lower() else "bits"


def _advice(fmt: Format) -> str:
    return "" if fmt.name == "binary64" else f" (for --precision {fmt.name})"


def _from_words(options: dict[str, Any], fmt: Format, rounded: list[Fact]) -> tuple[Any, Any]:
    """Return the solid and the ray of the options; note in `rounded` each number not exact."""
    from cases.forms import read_ray, read_solid
    from cases.model import Refused

    shapes = [name for name in SHAPES if options[name]]
    if len(shapes) != 1 or not options["ray"]:
        raise click.UsageError("give one solid and its ray: --cylinder P Q R --ray U V")
    name = shapes[0]
    solid: Json = {"type": name}
    try:
        for field, word in zip(SHAPES[name], options[name], strict=True):
            solid[field] = _value(word, f"solid.{field}", fmt, rounded, field == "radius")
        fields = zip(("origin", "direction"), options["ray"], strict=True)
        ray = {field: _value(word, f"ray.{field}", fmt, rounded) for field, word in fields}
        return read_solid(solid, fmt=fmt), read_ray(ray, fmt=fmt)
    except Refused as refusal:
        raise BadInput(str(refusal)) from None


def _value(
    word: str, path: str, fmt: Format, rounded: list[Fact], single: bool = False
) -> float | list[float]:
    """Return the number or the vector that a word spells."""
    from cases.model import Refused

    if single:
        return _number(word, path, fmt, rounded)
    parts = word.split(",")
    if len(parts) != 3:
        raise Refused(path, f"is not three numbers x,y,z without blanks: {word!r:.40}")
    return [_number(part, f"{path}[{i}]", fmt, rounded) for i, part in enumerate(parts)]


def _number(text: str, path: str, fmt: Format, rounded: list[Fact]) -> float:
    """Return the number of the format nearest to a text; note it in `rounded` if it is another."""
    from fractions import Fraction
    from math import isfinite

    from cases.model import Refused
    from oracle.derivation.form import Fact, about, dyadic
    from oracle.rounding import enclose
    from oracle.surd import fraction

    try:
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
        rounded.append(Fact(f"{path} {text.strip():.24}", dyadic(value), about(value, 24)))
    return number


def _exactly(text: str) -> Fraction:
    """Return what a decimal or a hex float spells, whose size is that of a binary64 number."""
    from fractions import Fraction

    text = text.strip().lower().replace("_", "")
    if "x" not in text:
        return Fraction(text)
    mantissa, _, power = text.replace("0x", "").partition("p")
    whole, _, part = mantissa.partition(".")
    return Fraction(int(whole + part, 16)) * Fraction(2) ** (int(power or 0) - 4 * len(part))
