"""The certificate as Markdown, for the summary of a CI job: what to know, and how to repeat it.

Whatever a client said stands in code spans, where no Markdown and no HTML is read.
"""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from raycert.cases.levels import LEVELS
from raycert.oracle.reports import findings, reading
from raycert.oracle.reports.foreign import code, legible, plain
from raycert.oracle.reports.inputs import case_json, intervals, said
from raycert.oracle.reports.reading import Json, count

FAMILIES, ROWS = 20, 5
"""How many failing families are shown, and how many rows of each."""
MARKS = {"passed": "\u2705", "failed": "\u274c", "open": "\u2796"}
STATES = {"granted": "\u2705", "part": "\u2705", "accepted": "\u26a0\ufe0f"}


def markdown(certificate: Json) -> str:
    certificate = legible(certificate)
    found = reading.verdict(certificate)
    lines = [
        f"### {STATES.get(found.state, MARKS['failed'])} {code(reading.subject(certificate))} "
        f"{found.headline}",
        "",
        *(f"- {code(reason)}" for reason in found.reasons),
        *(f"- **likely fault:** {code(line)}" for line in findings.likely(certificate)),
        "",
        *_solids(certificate),
        "",
        *_failures(certificate),
        *_small(certificate),
        "",
    ]
    return "\n".join(lines)


def _solids(certificate: Json) -> Iterator[str]:
    yield "| solid | " + " | ".join(LEVELS) + " | convention |"
    yield "|---|" + "--:|" * len(LEVELS) + "---|"
    for name, solid in certificate["solids"].items():
        cells = [_cell(solid["levels"][level]) for level in LEVELS]
        yield f"| {plain(name)} | " + " | ".join(cells) + f" | {plain(solid['convention'])} |"
    for name in certificate["not_tested"]["solids"]:
        yield f"| {plain(name)} |" + " not tested |" * 5


def _cell(tally: Json) -> str:
    of = tally["passed"] + tally["failed"]
    text = {"failed": f"{tally['failed']} of {of} fail", "passed": str(of), "open": "no row"}
    return f"{MARKS[reading.mark(tally)]} {text[reading.mark(tally)]}"


def _failures(certificate: Json) -> Iterator[str]:
    failures = reading.by_family(reading.failing(certificate))
    if not failures:
        return
    total = sum(map(len, failures.values()))
    yield from (f"**{count(total, 'row')} fail in {count(len(failures), 'place')}**", "")
    for (solid, family), rows in list(failures.items())[:FAMILIES]:
        place = escape(f"{solid}: {family} ({count(len(rows), 'row')})")
        yield f"<details><summary>{place}</summary>"
        yield ""
        for failed in rows[:ROWS]:
            yield from _row(certificate, failed)
        if len(rows) > ROWS:
            yield f"- and {len(rows) - ROWS} more"
        yield from ("", "</details>")
    if len(failures) > FAMILIES:
        yield from ("", f"and {len(failures) - FAMILIES} more places, all in the certificate")
    yield ""


def _row(certificate: Json, failed: Json) -> tuple[str, ...]:
    return (
        f"- {code(failed['id'])}: {plain(failed['why'])}",
        f"  - {code(reading.fault(certificate, failed))}",
        f"  - answer {code(said(failed))}, expected {code(intervals(failed['expected']))}",
        f"  - inputs {code(case_json(failed))}",
        f"  - in hex {code(case_json(failed, hexed=True))}",
        f"  - {code(failed['explain'])}",
        f"  - {code(failed['reproduce'])}",
    )


def _small(certificate: Json) -> Iterator[str]:
    """Yield what was left out, the notes, and what it was made with."""
    corpus, tool = certificate["corpus"], certificate["tool"]
    made = (
        f"{certificate['tested']} rows of corpus {corpus['version']} ({corpus['precision']}), "
        f"{tool['name']} {tool['version']}, {certificate['run']['seconds']:.1f} s"
    )
    repeat = f"repeat: {certificate['reproduce']}"
    yield from (f"<details><summary>{escape(made)}</summary>", "")
    yield from (f"- {code(line)}" for line in (*reading.beside(certificate), repeat))
    yield from ("", "</details>")
