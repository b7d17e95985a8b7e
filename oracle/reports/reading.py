"""What a certificate says, read once for every report: verdict, failures, what was left out.

Also the words and numbers as every report prints them. Whatever a client said of itself is hostile
until `foreign` has seen it.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from math import isfinite
from typing import Any, Literal

from raycert.cases.degenerate import DEGENERACIES
from raycert.cases.domain import read_tolerance, within
from raycert.cases.levels import upto
from raycert.cases.model import Refused
from raycert.oracle.certify.certificate import CERTIFICATE_VERSION
from raycert.oracle.reports.foreign import clean
from raycert.oracle.reports.inputs import case_json, intervals, said

Json = dict[str, Any]
State = Literal["granted", "part", "accepted", "refused", "interrupted"]
Mark = Literal["passed", "failed", "open"]

SHORT, LINE = 60, 4000
"""Characters of a name, and of a command."""


def count(n: int, noun: str) -> str:
    """Return a number with its noun: `1 row`, `2,000 rows`."""
    return f"{n:,} {noun}" + ("" if n == 1 else "s")


def number(x: float | None) -> str:
    """Return a measured error in at most seven characters; null is infinite."""
    if x is None or not isfinite(x):
        return "inf"
    return f"{x:.3g}" if x < 1e5 else f"{x:.0e}"


@dataclass(frozen=True, slots=True)
class Ruling:
    """The verdict in words: `headline` completes the name of the subject."""

    state: State
    headline: str
    reasons: tuple[str, ...]

    @property
    def good(self) -> bool:
        return self.state in ("granted", "part", "accepted")


def verdict(certificate: Json) -> Ruling:
    what, state = asked(certificate), _state(certificate)
    headline = {
        "granted": f"is granted {what}",
        "part": f"passes {what} on a part of the corpus; not a certificate",
        "accepted": f"run accepted, not certified: its failures to be {what} are the expected ones",
        "refused": f"is not granted {what}",
        "interrupted": f"is not granted {what}: the run was interrupted",
    }[state]
    reasons = [clean(reason) for reason in certificate["reasons"]]
    beyond = limits(certificate) if state == "refused" else []
    return Ruling(state, headline, (*reasons, *beyond, *surprises(certificate)))


def _state(certificate: Json) -> State:
    if certificate["granted"]:
        return "granted"
    if certificate["run"]["interrupted"]:
        return "interrupted"
    if certificate["accepted"] and certificate["expectations"]["expected"]:
        return "accepted"
    if certificate["passed"] and (certificate["accepted"] or certificate["expectations"] is None):
        return "part"
    return "refused"


def asked(certificate: Json) -> str:
    """Return what was asked: `stable and closed`."""
    level, wanted = certificate["asked"]["level"], certificate["asked"]["convention"]
    tested = {solid["convention"] for solid in certificate["solids"].values()} - {"not tested"}
    what = f"{level} and {clean(wanted)}" if tested else f"{level}, convention not tested"
    what = within(what, certificate["domain"]["words"])
    tolerance = read_tolerance(certificate["subject"]["tolerance"]).words()
    return what + (f", faces moved by a tolerance of {tolerance}" if tolerance else "")


def level_asked(certificate: Json) -> str:
    """Return the level with the domain beside it: `stable, for starts within 1e6 sizes`."""
    return within(certificate["asked"]["level"], certificate["domain"]["words"])


def limits(certificate: Json) -> list[str]:
    """Return, for each solid and level that is not granted, where it would be, or that it fails."""
    found: dict[tuple[str, str], list[str]] = {}
    for name, solid in certificate["solids"].items():
        for level, measured in solid["measured"].items():
            if measured:
                found.setdefault((name, limit(measured)), []).append(level)
    return [f"{name}: {' and '.join(levels)}{words}" for (name, words), levels in found.items()]


def limit(measured: Json) -> str:
    """Return what completes: sound ..."""
    ordinary = measured["ordinary"]
    if measured["domain"] is None:
        cases = count(ordinary["failed"], "ordinary case")
        return f" in no domain: fails on {cases}, such as {ordinary['rows'][0]}"
    more = "" if measured["exhaustive"] else " (a wider one may be)"
    first = ", ".join(dict.fromkeys(edge["row"] for edge in measured["edges"]))
    return f" for {measured['words']}{more}; first failure beyond: {first}"


def apart(certificate: Json, together: bool = False) -> list[str]:
    """Return how the rows fared that count for no level, and why they do not.

    For each type of solid, or all of them `together`.
    """
    level = "sound" if certificate["asked"]["level"] == "sound" else "stable"
    solids = certificate["solids"]
    groups = {"": list(solids.values())} if together else {f"{x}: ": [solids[x]] for x in solids}
    lines = []
    for of, some in groups.items():
        lines.append(_fares(f"{of}outside the domain", [s["outside"][level] for s in some]))
        for kind in DEGENERACIES:
            fares = [s["degenerate"][kind] for s in some if kind in s["degenerate"]]
            lines.append(_fares(f"{of}{kind.replace('_', ' ')}, not declared", fares))
    return [line for line in lines if line]


def _fares(what: str, fares: list[Json]) -> str:
    """Return how rows fared, in a sentence; empty where there are none."""
    total = Counter[str]()
    for one in fares:
        total.update(one)
    told = [f"{n} {how}" for how, n in total.items() if how != "rows"]
    rows = total["rows"]
    return f"{what}: {count(rows, 'row')}: {', '.join(told)}; not counted" if rows else ""


def surprises(certificate: Json) -> list[str]:
    """Return how a run differs from its file of known failures, a sentence each."""
    expectations = certificate["expectations"] or {}
    about = {
        "new": "not expected",
        "unexpected_passes": "expected to fail",
        "unmatched": "expected, and about nothing",
    }
    found = []
    for name, words in about.items():
        entries = expectations.get(name, [])
        found += [f"{words}: {clean(entry)}" for entry in entries[:5]]
        found += [f"{words}: {len(entries) - 5} more"] if len(entries) > 5 else []
    return found


def subject(certificate: Json, most: int = SHORT) -> str:
    declared = certificate["subject"]
    return clean(f"{declared['name']} {declared['version']}".rstrip(), most)


def levels_asked(certificate: Json) -> tuple[str, ...]:
    """Return the level asked for and those below it: the verdict is about these."""
    return upto(certificate["asked"]["level"])


def failing(certificate: Json) -> list[Json]:
    """Return the failures that the verdict is about, in the order of the corpus."""
    level = certificate["asked"]["level"]
    return [
        f
        for f in certificate["failures"]
        if level in f["faults"] and f["tier"] != "range" and f["place"] == "inside"
    ]


def fault(certificate: Json, failed: Json, most: int = 160) -> str:
    return clean(failed["faults"][certificate["asked"]["level"]], most)


def facts(certificate: Json, failed: Json) -> tuple[str, ...]:
    """Return what a row is: why it is there, its fault, answers, inputs, and two commands."""
    return (
        clean(failed["why"]),
        fault(certificate, failed),
        f"answer   {said(failed)}",
        f"expected {intervals(failed['expected'])}",
        f"inputs   {case_json(failed)}",
        f"in hex   {case_json(failed, hexed=True)}",
        f"explain  {clean(failed['explain'], LINE)}",
        f"repeat   {clean(failed['reproduce'], LINE)}",
    )


def family_of(id: str) -> str:
    return id.partition("/")[0]


def by_family(failures: list[Json]) -> dict[tuple[str, str], list[Json]]:
    """Return failures by (type of solid, family)."""
    found: dict[tuple[str, str], list[Json]] = {}
    for failed in failures:
        found.setdefault((failed["solid"]["type"], family_of(failed["id"])), []).append(failed)
    return found


def mark(tally: Json) -> Mark:
    """Return whether rows failed, passed, or none of them decides."""
    return "failed" if tally["failed"] else "passed" if tally["passed"] else "open"


def left_out(certificate: Json) -> list[str]:
    """Return what was not tested or not counted."""
    left, lines = certificate["not_tested"], []
    if left["solids"]:
        lines.append(f"not tested: {', '.join(left['solids'])} (no rows sent)")
    if left["rows"]:
        lines.append(f"{count(left['rows'], 'row')} of the corpus not sent")
    if certificate["shard"]:
        lines.append(f"only shard {clean(certificate['shard'])} of the corpus")
    for level, ids in certificate["not_decisive"].items():
        if ids["rows"]:
            wrong = f", {len(ids['wrong'])} of them answered wrong" if ids["wrong"] else ""
            lines.append(f"{level}: {len(ids['rows'])} rows do not decide{wrong}; not counted")
    return lines


def windows(certificate: Json) -> list[str]:
    """Return, for each solid, the scales around 1 in which it is `stable`."""
    lines = []
    for name, solid in certificate["solids"].items():
        window = solid["windows"]["stable"]
        spans = [f"{what} {_span(*w)}" for what, w in window.items() if w]
        if spans:
            lines.append(f"{name}: stable for {' and '.join(spans)}")
    return lines


def _span(low: int, high: int) -> str:
    ends = ([f"down to 2^{low}"] if low < 0 else []) + ([f"up to 2^{high}"] if high > 0 else [])
    return " and ".join(ends) or "of usual size only"


def notes(certificate: Json) -> list[str]:
    run = certificate["run"]
    restarts = [f"the target was restarted {run['restarts']} times"] if run["restarts"] else []
    return restarts + [clean(note) for note in run["notes"]]


def beside(certificate: Json, note: str = "") -> list[str]:
    """Return what is to be known beside the verdict: what is left out, windows, notes."""
    said = [note + line for line in notes(certificate)]
    return [*left_out(certificate), *apart(certificate), *windows(certificate), *said]


# Is it a certificate at all?


def check(form: object) -> Json:
    """Return a certificate as it is, or refuse what its schema does not describe."""
    from fastjsonschema import JsonSchemaValueException

    if not isinstance(form, dict) or "certificate" not in form:
        raise Refused("certificate", "is missing; is this a file that certify wrote?")
    if form["certificate"] != CERTIFICATE_VERSION:
        raise Refused("certificate", f"is not of version {CERTIFICATE_VERSION}")
    try:
        _schema()(form)
    except JsonSchemaValueException as error:
        path, reason = str(error.name), str(error.message).removeprefix(f"{error.name} ")
        raise Refused(path.replace("data", "certificate", 1), f"{reason:.200}") from None
    return form


@cache
def _schema() -> Callable[[object], object]:
    import fastjsonschema

    text = (files("raycert.oracle") / "schemas" / "certificate.schema.json").read_bytes()
    check: Callable[[object], object]
    check = fastjsonschema.compile(json.loads(text), use_default=False)
    return check
