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
from raycert.oracle.commands.asking import ONE_CASE, case_options, chosen, count_given
from raycert.oracle.commands.keeping import check_distinct
from raycert.oracle.commands.options import (
    FILE_OR_DASH,
    TARGETS,
    aim,
    json_option,
    statuses,
    stop,
    target_option,
    write_out,
)
from raycert.oracle.explain.console import show, show_proofs
from raycert.oracle.explain.derive import Derivation, as_given, derive, given, to_json
from raycert.oracle.explain.wording import Fact, Passage
from raycert.oracle.reports.foreign import say
from raycert.oracle.reports.screen import screen

if TYPE_CHECKING:
    from raycert.oracle.witness.proofs import Statement

STATUSES = {1: "a proof of --symbolic failed", 3: "a target could not be run, or SymPy is missing"}
EPILOG = f"""{TARGETS}
\b
Examples:
  raycert explain behind/across-just-past
  raycert explain --cylinder 0,0,0 0,0,2 1 --ray=-3,0,1 1,0,0
  raycert explain --half-space 0,0,1 0,0,1 --ray 0,0,0 0,0,0.1
  raycert show behind/across-just-past --json - | raycert explain --case -
  raycert explain behind/across-just-past --html case.html --target ./tracer.so
  raycert explain --symbolic
  raycert explain --case - <<< '{{"solid": {{"type": "sphere", "center": [0,0,0],
      "radius": 1}}, "ray": {{"origin": [-3,0,0], "direction": [1,0,0]}}}}'

{statuses(STATUSES)}
"""


@click.command(epilog=EPILOG)
@case_options
@json_option("Instead: the golden row and the steps", "data")
@click.option("--full", is_flag=True, help="Long integers in full.")
@click.option(
    "--html",
    type=FILE_OR_DASH,
    metavar="FILE",
    help="Instead: a page with pictures; - is standard output.",
)
@target_option(
    "On the page, ask this implementation (repeatable).  [default: reference]",
    "targets",
    multiple=True,
)
@click.option(
    "--symbolic",
    is_flag=True,
    help="Before the case, or alone: SymPy's proofs of the formulas used.",
)
def explain(symbolic: bool, full: bool, **options: Any) -> None:
    """Derive one case step by step: every quantity of its three problems, exactly.

    Shown are the row of each table that holds and why the others do not, the endpoints exactly
    and rounded, their condition, and what the textbook formula makes of them.

    The case is a golden row by its ID, or a solid and a ray by options, or an object of the line
    protocol by --case (the only way for a union, an intersection or a difference). Vectors are
    x,y,z without blanks; numbers are decimals or hex floats such as 0x1.8p-3.

    --html draws the case: ray and solid along the axis and across, the intervals over t and in ulps
    around each end, and what implementations answer beside the exact list.

    --symbolic needs no case. It derives the formulas from the definitions and proves them
    equal to the oracle's code, run on symbols; exit 1 if a proof fails, 3 without SymPy.
    """
    given, page, data = count_given(options), options["html"], options["data"]
    if given > 1 or not (given or symbolic):
        raise click.UsageError(ONE_CASE)
    if page and not given:
        raise click.UsageError("--html is a page of one case")
    if options["targets"] and not page:
        raise click.UsageError("--target is for the page; add --html FILE")
    check_distinct({"--html": page, "--json": data})
    derivation = _derivation(options) if given else None
    statements = _proofs() if symbolic else []
    if page and derivation is not None:
        _write(page, derivation, options)
    if data:
        proofs = [{"title": s.title, "text": s.text, "proved": s.proved} for s in statements]
        shown = {"symbolic": proofs} if symbolic else {}
        shown |= to_json(derivation) if derivation else {}
        write_out(data, json.dumps(shown, indent=1) + "\n")
    else:
        _print(None if page else derivation, statements, full)
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
    targets = options["targets"] or (("reference",),)
    aims = [(_one(words), aim(words)) for words in targets]
    answers = [ask(word, target, row, fmt.name) for word, target in aims]
    text = case_page(derivation, answers, _repeat(derivation, options))
    if write_out(file, text) and file != "-":
        say(f"written {file}", err=True)


def _one(words: tuple[str, ...]) -> str:
    """Return the words of a target in one, as --target takes them."""
    return words[0] if len(words) == 1 else shlex.join(words)


def _repeat(derivation: Derivation, options: dict[str, Any]) -> str:
    """Return the command line that makes the page again, from anywhere if the case is no row."""
    row, id, words = derivation.row, options["id"], ["raycert", "explain"]
    case = {"solid": write_solid(row.solid), "ray": write_ray(row.ray)}
    words += [id] if id else ["--case", "-"]
    words += [word for target in options["targets"] for word in ("--target", _one(target))]
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
