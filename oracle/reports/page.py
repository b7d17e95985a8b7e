"""The certificate as one HTML page that needs nothing else: no network, no script, no font.

All text is made legible first; the template escapes it besides.
"""

from __future__ import annotations

from base64 import b64encode
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from importlib.resources import files
from typing import Any

from raycert.cases.domain import read_tolerance
from raycert.cases.levels import LEVELS
from raycert.cases.table import PROBLEM_1, PROBLEM_2
from raycert.oracle.reports import findings, reading
from raycert.oracle.reports.bounds import domains
from raycert.oracle.reports.foreign import clean, legible
from raycert.oracle.reports.inputs import PARTS, case_json, intervals, said, written
from raycert.oracle.reports.junit import junit
from raycert.oracle.reports.markdown import markdown
from raycert.oracle.reports.picture import pictures
from raycert.oracle.reports.reading import Json, count, number

LISTED, AT_MOST = 100, 4000
"""How many failing rows of a family are listed, and how many in all."""
SHOWN = 20
"""How many families that fail are shown at once."""


def page(certificate: Json) -> str:
    certificate = legible(certificate)
    return render(
        "page.html",
        ("page.css",),
        {"clean": clean, "count": count, "mark": reading.mark},
        c=certificate,
        levels=LEVELS,
        **_verdict(certificate),
        **_matrix(certificate),
        grid=_grid(certificate),
        columns=[row.name for row in PROBLEM_2],
        domains=domains(certificate),
        apart=reading.apart(certificate, together=True),
        each=reading.apart(certificate),
        easy=[_easy(said, first) for said, first in findings.easy(certificate)],
        worst=[_worst(certificate, shown) for shown in certificate["worst"]],
        listed=_listed(certificate),
        not_decisive=_not_decisive(certificate),
        made=_made(certificate),
        standing=standing(certificate),
    )


def _verdict(certificate: Json) -> Json:
    say = ["verdict", "asked", "level_asked", "subject", "notes", "left_out", "windows"]
    return {
        "likely": findings.likely(certificate),
        **{name: getattr(reading, name)(certificate) for name in say},
        "within": reading.levels_asked(certificate),
        "reproduce": clean(certificate["reproduce"], 2000),
        "began": _moment(certificate["run"]["began"]),
    }


def _moment(began: str | None) -> str:
    return clean((began or "").replace("T", " ").replace("+00:00", " UTC"), 40)


def _matrix(certificate: Json) -> Json:
    """Return the families, those in which something asked fails before the others."""
    within = reading.levels_asked(certificate)

    def fails(family: Json) -> int:
        return max(int(family["levels"][level]["failed"]) for level in within)

    families = certificate["families"]
    return {
        "failed": sorted(filter(fails, families), key=fails, reverse=True),
        "held": [family for family in families if not fails(family)],
        "number": number,
        "shown": SHOWN,
    }


def _grid(certificate: Json) -> list[tuple[str, list[Json]]]:
    """Return the capped cylinder's cells: a line for each row of Problem 1."""
    cells = {tuple(cell["rows"]): cell for cell in certificate["table"]["cylinder"]}
    return [(one.name, [cells[one.name, two.name] for two in PROBLEM_2]) for one in PROBLEM_1]


def _worst(certificate: Json, shown: Json) -> Json:
    level = certificate["asked"]["level"]
    failed = level in shown["faults"]
    return {
        "id": shown["id"],
        "family": reading.family_of(shown["id"]),
        "solid": shown["solid"]["type"].replace("_", " "),
        "kind": shown["kind"],
        "why": clean(shown["why"]),
        "fault": reading.fault(certificate, shown, 300) if failed else "",
        "answer": said(shown),
        "expected": intervals(shown["expected"]),
        "errors": [number(shown[name]) for name in ("strict_k", "squared_k", "ulps")],
        "inputs": _inputs(shown),
        "hex": case_json(shown, hexed=True),
        "explain": clean(shown["explain"], reading.LINE),
        "reproduce": clean(shown["reproduce"], reading.LINE),
        "pictures": pictures(shown, certificate["corpus"]["precision"]),
    }


def _inputs(case: Json) -> list[list[str]]:
    """Return the code that names the inputs of a case, each line in parts that are not broken."""
    lines = [f"{part} = {written(case[part])}" for part in PARTS]
    return [
        [f"{part}," for part in line.split(", ")[:-1]] + line.split(", ")[-1:] for line in lines
    ]


def _easy(said: str, case: Json) -> Json:
    shown = {name: clean(str(case[name])) for name in ("answer", "expected")}
    return {"said": said, "inputs": _inputs(case), **shown}


def _listed(certificate: Json) -> list[Json]:
    """Return the failing rows by family, as many as a page can hold."""
    failures = reading.by_family(reading.failing(certificate))
    most = min(LISTED, AT_MOST // max(len(failures), 1))
    return [
        {
            "solid": solid,
            "family": family,
            "rows": [
                (clean(row["id"].partition("/")[2], 80), reading.fault(certificate, row, 110))
                for row in rows[:most]
            ],
            "count": len(rows),
            "more": max(len(rows) - most, 0),
        }
        for (solid, family), rows in failures.items()
    ]


def _not_decisive(certificate: Json) -> list[tuple[str, int, list[str]]]:
    """Return, for each level asked, how many rows do not decide it, and of which families."""
    found = []
    for level in reading.levels_asked(certificate):
        ids = certificate["not_decisive"].get(level, {"rows": []})["rows"]
        families = Counter(map(reading.family_of, ids))
        if ids:
            found.append((level, len(ids), [f"{name} {n}" for name, n in families.items()]))
    return found


def _made(certificate: Json) -> list[tuple[str, str]]:
    declared, corpus, tool = (certificate[name] for name in ("subject", "corpus", "tool"))
    made, run, fresh = (certificate[name] for name in ("environment", "run", "fresh"))
    values = {
        "subject": reading.subject(certificate, 200),
        "command": clean(" ".join(declared["command"]), 500),
        "declares": f"{declared['answers']}, {declared['precision']}, "
        f"{clean(declared['convention'])}, numbers as {declared['numbers']}, "
        f"tolerance {read_tolerance(declared['tolerance']).words() or 'none'}",
        "solids": ", ".join(declared["solids"]),
        "asked": reading.asked(certificate),
        "corpus": f"{corpus['version']}, {corpus['precision']}, {corpus['rows']:,} rows",
        "fresh": "" if fresh is None else f"{fresh['rows']:,} cases of seed {fresh['seed']}",
        "manifest": corpus["manifest_sha256"],
        "tool": f"{tool['name']} {tool['version']}",
        "source": tool["sha256"],
        "run": f"{certificate['tested']:,} rows in {run['seconds']:.1f} s, "
        f"{count(run['restarts'], 'restart')}"
        + (f", began {_moment(run['began'])}" if run["began"] else ""),
        "machine": f"{made['implementation']} {made['python']}, {made['system']}, "
        f"{made['cores']} cores",
    }
    return [(term, value) for term, value in values.items() if value]


def standing(certificate: Json) -> Json:
    """Return where the subject sits: `plots`, (what it shows, its address) each, and `sweeps`.

    A plot goes in as a picture of its own, so that nothing in it can touch the page.
    """
    found = certificate["standing"]
    stress, bench = found["stress"], found["bench"]
    plots = [("Backward error against stiffness", stress["svg"])] if stress else []
    if bench:
        plots += [
            (f"Error against run time, {name} rays", svg) for name, svg in bench["svg"].items()
        ]
    return {
        "plots": [(clean(title, 80), _address(svg)) for title, svg in plots if svg],
        "sweeps": _sweeps(stress) if stress else [],
    }


def _address(svg: str) -> str:
    return f"data:image/svg+xml;base64,{b64encode(svg.encode()).decode('ascii')}"


def _sweeps(stress: Json) -> list[Json]:
    """Return, for each sweep, the ranges in which two levels hold, and why they end."""
    titles = {sweep["name"]: sweep["title"] for sweep in stress["sweeps"]}
    mine = stress["methods"][0]["name"]
    return [
        {
            "title": clean(str(titles.get(row["sweep"])), 80),
            "stable": clean(row["stable"]["text"], 60),
            "sound": clean(row["sound"]["text"], 60),
            "whole": row["stable"]["whole"],
            "causes": clean(", ".join(dict.fromkeys(c["cause"] for c in row["causes"])), 200),
        }
        for row in stress["ranges"]
        if row["method"] == mine
    ]


def render(
    name: str, styles: Sequence[str], filters: Mapping[str, Callable[..., Any]], **values: Any
) -> str:
    """Return the page that a template of this package makes of values and of style sheets.

    The template escapes all text. Only the style sheets and the drawings, whose text their library
    escapes, go in as they are.
    """
    from jinja2 import Environment, StrictUndefined

    here = files("raycert.oracle.reports")
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= filters
    style = "\n".join((here / sheet).read_text("utf-8").rstrip() for sheet in styles)
    template = environment.from_string((here / name).read_text("utf-8"))
    return template.render(style=style, **values)


WRITERS: dict[str, Callable[[Json], str]] = {"junit": junit, "markdown": markdown, "html": page}
"""The forms of a report, each a function from the certificate to text."""
