"""`raycert explain`: one case, derived in the seed's own steps."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from raycert.oracle.commands.asking import from_json, from_words, shape_options, words_given
from raycert.oracle.commands.options import (
    check_writable,
    find,
    golden_option,
    precision_option,
    read,
)

if TYPE_CHECKING:
    from raycert.oracle.explain.derive import Derivation
    from raycert.oracle.explain.form import Fact
    from raycert.oracle.witness.proofs import Statement

EXAMPLES = """\b
Examples:
  raycert explain behind/across-just-past
  raycert explain --cylinder 0,0,0 0,0,2 1 --ray=-3,0,1 1,0,0
  raycert explain --half-space 0,0,1 0,0,1 --ray 0,0,0 0,0,0.1
  raycert show behind/across-just-past --json | raycert explain --json -
  raycert explain behind/across-just-past --html case.html --with ./tracer.so
  raycert explain --symbolic
  raycert explain --json - <<< '{"solid": {"type": "sphere", "center": [0,0,0],
      "radius": 1}, "ray": {"origin": [-3,0,0], "direction": [1,0,0]}}'
"""


@click.command(epilog=EXAMPLES)
@click.argument("id", required=False)
@shape_options
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
@click.option("--html", metavar="FILE", help="Write a page with pictures instead; - is stdout.")
@click.option(
    "--with",
    "targets",
    multiple=True,
    metavar="TARGET",
    help="On the page, ask this implementation (repeatable; the words of a command are quoted).  "
    "[default: reference]",
)
@click.option(
    "--symbolic",
    is_flag=True,
    help="Before the case, or alone: SymPy's proofs of the formulas used.",
)
@precision_option
@golden_option
def explain(id: str | None, form: str, symbolic: bool, **options: Any) -> None:
    """Derive one case in the seed's steps: every quantity of its three problems, exactly.

    Shown are the row of each table that holds and why the others do not, the endpoints exactly
    and rounded, their condition, and what the textbook formula makes of them.

    The case is a golden row by its ID, or a solid and a ray by options, or an object of the line
    protocol by --json (the only way for a union, an intersection or a difference). Vectors are
    x,y,z without blanks; numbers are decimals or hex floats such as 0x1.8p-3.

    --html draws the case: ray and solid along the axis and across, the intervals over t and in ulps
    around each end, and what implementations answer beside the exact list. A TARGET is one that
    certify takes.

    --symbolic needs no case. It derives the seed's formulas from the definitions and proves them
    equal to the oracle's code, run on symbols; exit 1 if a proof fails, 3 without SymPy.
    """
    given = bool(id) + bool(options["file"])
    given += words_given(options)
    if given > 1 or not (given or symbolic):
        raise click.UsageError("give one case: an ID, or --json, or a solid with --ray")
    page = options["html"]
    if page and (not given or form == "json"):
        raise click.UsageError("--html is a page of one case, and instead of --format json")
    if options["targets"] and not page:
        raise click.UsageError("--with is for the page; add --html FILE")
    if page and page != "-":
        check_writable(Path(page).parent, "--html")
    derivation = _derivation(id, options) if given else None
    statements = None
    if symbolic:
        from raycert.oracle.commands.symbolic import proofs

        statements = proofs()
    if page and derivation is not None:
        _write(page, derivation, options, id)
        derivation = None
    if derivation is not None or statements is not None:
        _show(derivation, statements, form, options["full"])


def _write(file: str, derivation: Derivation, options: dict[str, Any], id: str | None) -> None:
    """Ask the implementations, and write the page."""
    import shlex

    from raycert.cases.corpus import write_whole
    from raycert.oracle.commands.options import aim
    from raycert.oracle.explain.casepage import case_page
    from raycert.oracle.explain.one_case import ask

    row, fmt = derivation.row, derivation.format
    words = options["targets"] or ("reference",)
    aims = [(word, aim(tuple(shlex.split(word)))) for word in words]
    answers = [ask(word, target, row, fmt.name) for word, target in aims]
    text = case_page(derivation, answers, _repeat(derivation, options, id))
    if file == "-":
        click.echo(text.encode(), nl=False)
    else:
        write_whole(Path(file), text.encode())
        click.echo(f"written {file}", err=True)


def _repeat(derivation: Derivation, options: dict[str, Any], id: str | None) -> str:
    """Return the command line that makes the page again, from anywhere if the case is no row."""
    import json
    import shlex

    from raycert.cases.forms import write_ray, write_solid

    row, words = derivation.row, ["raycert", "explain"]
    case = {"solid": write_solid(row.solid), "ray": write_ray(row.ray)}
    words += [id] if id else ["--json", "-"]
    words += [word for target in options["targets"] for word in ("--with", target)]
    if options["precision"] != "binary64":
        words += ["--precision", options["precision"]]
    if id and options["golden"]:
        words += ["--golden", str(options["golden"])]
    line = shlex.join([*words, "--html", options["html"]])
    return line if id else f"{line} <<< {shlex.quote(json.dumps(case))}"


def _derivation(id: str | None, options: dict[str, Any]) -> Derivation:
    """Return the derivation of the case that the words name."""
    from dataclasses import replace

    from raycert.cases.formats import FORMATS
    from raycert.oracle.explain.derive import derive, given
    from raycert.oracle.explain.form import Step

    fmt = FORMATS[options["precision"]]
    if id:
        return _from_golden(id, options)
    rounded: list[Fact] = []
    if options["file"]:
        case = given(*from_json(options["file"].read(), fmt, "--json"))
    else:
        case = given(*from_words(options, fmt, rounded))
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
            from raycert.oracle.commands.symbolic import show_proofs

            show_proofs(statements, console)
        if derivation is not None:
            from raycert.oracle.explain.text import show

            if statements is not None:
                console.print()
            show(derivation, console, full)
    if not all(statement.proved for statement in statements or ()):
        raise SystemExit(1)


def _show_json(derivation: Derivation | None, statements: list[Statement] | None) -> None:
    import json

    form: dict[str, Any] = {}
    if statements is not None:
        from raycert.oracle.commands.symbolic import to_json as proofs_to_json

        form["symbolic"] = proofs_to_json(statements)
    if derivation is not None:
        from raycert.oracle.explain.derive import to_json

        form |= to_json(derivation)
    click.echo(json.dumps(form, indent=1))


def _from_golden(id: str, options: dict[str, Any]) -> Derivation:
    from raycert.oracle.explain.derive import as_given, derive

    corpus = read(options["precision"], options["golden"])
    row = find(corpus, id)
    derivation = derive(as_given(row), corpus.format, row.family)
    if derivation.row != row:
        click.echo(f"{id}: the file holds another answer; see: raycert golden check", err=True)
    return derivation
