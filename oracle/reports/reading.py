"""What a certificate says, read once for every report: verdict, failures, what was left out.

Also the words and numbers as every report prints them. Whatever a client said of itself is hostile
until `foreign` has seen it.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from math import isfinite
from typing import Any, Literal

from raycert.cases.domain import read_tolerance, within
from raycert.cases.levels import upto
from raycert.cases.model import Refused
from raycert.oracle.certify.certificate import CERTIFICATE_VERSION
from raycert.oracle.reports.foreign import ELLIPSIS, clean

Json = dict[str, Any]
State = Literal["granted", "part", "accepted", "refused", "interrupted"]
Mark = Literal["passed", "failed", "open"]

SHORT = 60


def count(n: int, noun: str) -> str:
    """Return a number with its noun: `1 row`, `2,000 rows`."""
    return f"{n:,} {noun}" + ("" if n == 1 else "s")


def number(x: float | None) -> str:
    """Return a measured error in at most seven characters; null is infinite."""
    if x is None or not isfinite(x):
        return "inf"
    return f"{x:.3g}" if x < 1e5 else f"{x:.0e}"


def decimal(text: str) -> str:
    """Return a hex float in decimal, the shortest that round-trips."""
    return repr(float.fromhex(text))


def intervals(pairs: Sequence[Sequence[str]] | None, most: int = 6) -> str:
    """Return a list of pairs of hex floats in decimal, cut after `most` pairs."""
    if pairs is None:
        return "none"
    shown = [f"[{decimal(a)}, {decimal(b)}]" for a, b in pairs[:most]]
    return "[" + ", ".join(shown + [ELLIPSIS] * (len(pairs) > most)) + "]"


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
                found.setdefault((name, _limit(measured)), []).append(level)
    return [f"{name}: {' and '.join(levels)}{words}" for (name, words), levels in found.items()]


def _limit(measured: Json) -> str:
    """Return what completes: sound ..."""
    ordinary = measured["ordinary"]
    if measured["domain"] is None:
        cases = count(ordinary["failed"], "ordinary case")
        return f" in no domain: fails on {cases}, such as {ordinary['rows'][0]}"
    more = "" if measured["exhaustive"] else " (a wider one may be)"
    first = ", ".join(dict.fromkeys(edge["row"] for edge in measured["edges"]))
    return f" for {measured['words']}{more}; first failure beyond: {first}"


def apart(certificate: Json) -> list[str]:
    """Return how the rows fared that count for no level, and why they do not."""
    level = "sound" if certificate["asked"]["level"] == "sound" else "stable"
    lines = []
    for name, solid in certificate["solids"].items():
        outside = solid["outside"][level]
        if outside["rows"]:
            lines.append(f"{name}: outside the domain: {_fares(outside)}; not counted")
        for kind, fares in solid["degenerate"].items():
            what = kind.replace("_", " ")
            lines.append(f"{name}: {what}, not declared: {_fares(fares)}; not counted")
    return lines


def _fares(fares: Json) -> str:
    told = [f"{n} {how}" for how, n in fares.items() if how != "rows"]
    return f"{count(fares['rows'], 'row')}: {', '.join(told)}"


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


def facts(certificate: Json, failed: Json) -> tuple[str, str, str, str, str]:
    """Return why a row is there, its fault, what is answered, expected, and how to repeat it."""
    return (
        clean(failed["why"]),
        fault(certificate, failed),
        f"answer   {said(failed)}",
        f"expected {intervals(failed['expected'])}",
        f"repeat   {clean(failed['reproduce'], 2000)}",
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


def said(shown: Json) -> str:
    """Return what was answered to a row, in decimal."""
    reply = shown["reply"]
    if reply is None:
        return intervals(shown["answer"])
    if "hit" in reply:
        return f"hit: {str(reply['hit']).lower()}"
    return f"first: {'null' if reply['first'] is None else repr(float.fromhex(reply['first']))}"


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


def likely(certificate: Json) -> list[str]:
    """Return the likely faults, a sentence each."""
    return [
        f"on {cause['rows']} of {found['failures']} failures of {found['solid']} your answers are "
        f"those of a tracer that {cause['does']} ({cause['fault']}; {cause['origin']})"
        for found in certificate["likely"]
        for cause in found["explained"]
    ]


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
