"""The certificate as JUnit XML: one suite for a type of solid, one test for a family.

A test fails if a row of the family fails the level that was asked. Expected failures, families of
which no row decides, and types that were not tested are skipped, with the reason. The time is that
of the run; what a single family took is not measured.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from raycert.oracle.reports import reading
from raycert.oracle.reports.foreign import clean, legible
from raycert.oracle.reports.reading import Json, count

SHOWN = 20


class Test(NamedTuple):
    """A test passes without a message, fails with a message and a kind, else is skipped."""

    name: str
    message: str = ""
    kind: str = ""
    text: str | None = None


def junit(certificate: Json) -> str:
    from junitparser import JUnitXml

    certificate = legible(certificate)
    title = f"raycert: {reading.subject(certificate)} {reading.verdict(certificate).headline}"
    xml, properties = JUnitXml(title), _properties(certificate)
    for solid in certificate["solids"]:
        xml.add_testsuite(_suite(solid, _families(certificate, solid), properties))
    untested = Test("not tested", "no row of this type was sent: not declared, or not selected")
    for solid in certificate["not_tested"]["solids"]:
        xml.add_testsuite(_suite(solid, [untested]))
    xml.add_testsuite(_suite("run", _run(certificate)))
    xml.update_statistics()  # type: ignore[no-untyped-call]
    xml.time = certificate["run"]["seconds"]
    text = xml.tostring()  # type: ignore[no-untyped-call]
    return (text.decode() if isinstance(text, bytes) else text) + "\n"


def _suite(name: str, tests: Iterable[Test], properties: Mapping[str, str] | None = None) -> Any:
    from junitparser import Failure, Skipped, TestCase, TestSuite

    suite = TestSuite(f"raycert.{name}")
    for key, value in (properties or {}).items():
        suite.add_property(key, value)
    for test in tests:
        case = TestCase(test.name, suite.name)
        if test.message:
            result: Any = Failure(test.message, test.kind) if test.kind else Skipped(test.message)
            result.text = test.text
            case.result = [result]
        suite.add_testcase(case)
    return suite


def _properties(certificate: Json) -> dict[str, str]:
    corpus, tool = certificate["corpus"], certificate["tool"]
    return {
        "level": reading.level_asked(certificate),
        "convention": clean(certificate["asked"]["convention"]),
        "corpus": f"{corpus['version']} {corpus['precision']} {corpus['manifest_sha256']}",
        "tool": f"{tool['name']} {tool['version']} {tool['sha256']}",
    }


def _families(certificate: Json, solid: str) -> Iterator[Test]:
    level, asked = certificate["asked"]["level"], reading.level_asked(certificate)
    expectations = certificate["expectations"] or {"expected": []}
    expected = set(expectations["expected"])
    failures = reading.by_family(reading.failing(certificate))
    for family in certificate["families"]:
        if family["solid"] != solid:
            continue
        name = f"{family['family']} [{asked}]"
        found = failures.get((solid, family["family"]), [])
        new = [failed for failed in found if failed["id"] not in expected]
        if new:
            message = f"{asked} fails on {len(new)} of {count(family['rows'], 'row')}"
            yield Test(name, message, level, _listed(certificate, new))
        elif found:
            file = clean(expectations["file"])
            yield Test(name, f"{count(len(found), 'expected failure')}: {file}")
        else:
            passed = family["levels"][level]["passed"]
            yield Test(name, "" if passed else f"no row decides {asked}")


def _listed(certificate: Json, failures: list[Json]) -> str:
    lines = []
    for failed in failures[:SHOWN]:
        lines += [failed["id"], *(f"  {line}" for line in reading.facts(certificate, failed))]
    if len(failures) > SHOWN:
        lines.append(f"and {len(failures) - SHOWN} more rows, all in the certificate")
    return "\n".join(lines)


def _run(certificate: Json) -> Iterator[Test]:
    """Yield what no family can say: the convention, the expectations, an interruption."""
    found = reading.verdict(certificate)
    name = f"granted: {reading.asked(certificate)}"
    if found.state in ("refused", "interrupted"):
        text = "\n".join((*found.reasons, f"repeat   {clean(certificate['reproduce'], 1000)}"))
        yield Test(name, found.headline, found.state, text)
    else:
        yield Test(name, "" if found.state == "granted" else found.headline)
    if certificate["expectations"] is not None:
        lines = reading.surprises(certificate)
        failed = (lines[0], "expectations", "\n".join(lines)) if lines else ()
        yield Test("expectations", *failed)
