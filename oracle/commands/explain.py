"""`raycert explain`: one case, derived step by step."""

from __future__ import annotations

import json
import shlex
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from raycert.cases.formats import FORMATS
from raycert.cases.forms import write_ray, write_solid
from raycert.cases.row import GoldenRow
from raycert.oracle.commands.asking import case_options, chosen, count_given
from raycert.oracle.commands.options import FILE_OR_DASH, aim, stop, write_out
from raycert.oracle.explain.console import show, show_proofs
from raycert.oracle.explain.derive import Derivation, as_given, derive, given, to_json
from raycert.oracle.explain.wording import Fact, Passage
from raycert.oracle.reports.foreign import say
from raycert.oracle.reports.screen import screen

if TYPE_CHECKING:
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
@case_options
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
    "--html",
    type=FILE_OR_DASH,
    metavar="FILE",
    help="Write a page with pictures instead; - is stdout.",
)
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
def explain(form: str, symbolic: bool, full: bool, **options: Any) -> None:
    """Derive one case step by step: every quantity of its three problems, exactly.

    Shown are the row of each table that holds and why the others do not, the endpoints exactly
    and rounded, their condition, and what the textbook formula makes of them.

    The case is a golden row by its ID, or a solid and a ray by options, or an object of the line
    protocol by --json (the only way for a union, an intersection or a difference). Vectors are
    x,y,z without blanks; numbers are decimals or hex floats such as 0x1.8p-3.

    --html draws the case: ray and solid along the axis and across, the intervals over t and in ulps
    around each end, and what implementations answer beside the exact list. A TARGET is one that
    certify takes.

    --symbolic needs no case. It derives the formulas from the definitions and proves them
    equal to the oracle's code, run on symbols; exit 1 if a proof fails, 3 without SymPy.
    """
    given, page = count_given(options), options["html"]
    if given > 1 or not (given or symbolic):
        raise click.UsageError("give one case: an ID, or --json, or a solid with --ray")
    if page and (not given or form == "json"):
        raise click.UsageError("--html is a page of one case, and instead of --format json")
    if options["targets"] and not page:
        raise click.UsageError("--with is for the page; add --html FILE")
    derivation = _derivation(options) if given else None
    statements = _proofs() if symbolic else []
    if page and derivation is not None:
        _write(page, derivation, options)
        derivation = None
    if form == "json":
        proofs = [{"title": s.title, "text": s.text, "proved": s.proved} for s in statements]
        shown = {"symbolic": proofs} if symbolic else {}
        say(json.dumps(shown | (to_json(derivation) if derivation else {}), indent=1))
    else:
        _print(derivation, statements, full)
    if not all(statement.proved for statement in statements):
        raise SystemExit(1)


def _derivation(options: dict[str, Any]) -> Derivation:
    fmt = FORMATS[options["precision"]]
    rounded: list[Fact] = []
    case = chosen(options, rounded)
    if isinstance(case, GoldenRow):
        derivation = derive(as_given(case), fmt, case.family)
        if derivation.row != case:
            text = f"{case.id}: the file holds another answer; see: raycert golden check"
            say(text, err=True)
        return derivation
    derivation = derive(given(*case), fmt)
    if not rounded:
        return derivation
    taken = Passage(f"Taken as {fmt.name} numbers", tuple(rounded))
    return replace(derivation, steps=(taken, *derivation.steps))


def _proofs() -> list[Statement]:
    """Return every statement, proved now. Stops, naming what to install, without SymPy."""
    from raycert.oracle.witness.testimony import Missing, load

    try:
        load("symbols")
    except Missing as missing:
        stop(str(missing))
    from raycert.oracle.witness.proofs import derivation

    with screen(stderr=True).status("proving with SymPy"):
        return derivation()


def _write(file: str, derivation: Derivation, options: dict[str, Any]) -> None:
    from raycert.oracle.explain.casepage import ask, case_page

    row, fmt = derivation.row, derivation.format
    words = options["targets"] or ("reference",)
    aims = [(word, aim(tuple(shlex.split(word)))) for word in words]
    answers = [ask(word, target, row, fmt.name) for word, target in aims]
    text = case_page(derivation, answers, _repeat(derivation, options))
    if write_out(file, text) and file != "-":
        say(f"written {file}", err=True)


def _repeat(derivation: Derivation, options: dict[str, Any]) -> str:
    """Return the command line that makes the page again, from anywhere if the case is no row."""
    row, id, words = derivation.row, options["id"], ["raycert", "explain"]
    case = {"solid": write_solid(row.solid), "ray": write_ray(row.ray)}
    words += [id] if id else ["--json", "-"]
    words += [word for target in options["targets"] for word in ("--with", target)]
    if options["precision"] != "binary64":
        words += ["--precision", options["precision"]]
    if id and options["golden"]:
        words += ["--golden", str(options["golden"])]
    line = shlex.join([*words, "--html", options["html"]])
    return line if id else f"{line} <<< {shlex.quote(json.dumps(case))}"


def _print(derivation: Derivation | None, statements: list[Statement], full: bool) -> None:
    console = screen()
    if statements:
        show_proofs(statements, console)
    if statements and derivation:
        console.print()
    if derivation:
        show(derivation, console, full)
