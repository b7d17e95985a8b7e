"""The certificate as JUnit XML: one suite for a type of solid, one test for a family.

A test fails if a row of the family fails the level that was asked. Expected failures, families of
which no row decides, and types that were not tested are skipped, with the reason. The time is that
of the run; what a single family took is not measured.
"""

from __future__ import annotations

from typing import Any

from raycert.oracle.reports import reading
from raycert.oracle.reports.reading import clean, count, intervals

Json = dict[str, Any]
SHOWN = 20


def junit(certificate: Json) -> str:
    from junitparser import JUnitXml

    xml = JUnitXml(
        f"raycert: {reading.subject(certificate)} {reading.verdict(certificate).headline}"
    )
    for solid in certificate["solids"]:
        xml.add_testsuite(_solid(certificate, solid))
    for solid in certificate["not_tested"]["solids"]:
        xml.add_testsuite(_untested(solid))
    xml.add_testsuite(_run(certificate))
    xml.update_statistics()  # type: ignore[no-untyped-call]
    xml.time = certificate["run"]["seconds"]
    text = xml.tostring()  # type: ignore[no-untyped-call]
    return (text.decode() if isinstance(text, bytes) else text) + "\n"


def _solid(certificate: Json, solid: str) -> Any:
    from junitparser import TestSuite

    suite = TestSuite(f"raycert.{solid}")
    for name, value in _properties(certificate).items():
        suite.add_property(name, value)
    failures = reading.by_family(reading.failing(certificate))
    for family in certificate["families"]:
        if family["solid"] == solid:
            found = failures.get((solid, family["family"]), [])
            suite.add_testcase(_family(certificate, family, found))
    return suite


def _properties(certificate: Json) -> dict[str, str]:
    corpus, tool = certificate["corpus"], certificate["tool"]
    return {
        "level": certificate["asked"]["level"],
        "convention": clean(certificate["asked"]["convention"]),
        "corpus": f"{corpus['version']} {corpus['precision']} {corpus['manifest_sha256']}",
        "tool": f"{tool['name']} {tool['version']} {tool['sha256']}",
    }


def _family(certificate: Json, family: Json, failures: list[Json]) -> Any:
    from junitparser import Failure, Skipped, TestCase

    level, solid = certificate["asked"]["level"], family["solid"]
    test = TestCase(f"{family['family']} [{level}]", f"raycert.{solid}")
    expectations = certificate["expectations"] or {"expected": []}
    expected = set(expectations["expected"])
    new = [failed for failed in failures if failed["id"] not in expected]
    if new:
        message = f"{level} fails on {len(new)} of {count(family['rows'], 'row')}"
        test.result = [_result(Failure(message, level), _listed(certificate, new))]
    elif failures:
        reason = f"{count(len(failures), 'expected failure')}: {clean(expectations['file'])}"
        test.result = [Skipped(reason)]
    elif not family["levels"][level]["passed"]:
        test.result = [Skipped(f"no row decides {level}")]
    return test


def _result(result: Any, text: str) -> Any:
    result.text = text
    return result


def _listed(certificate: Json, failures: list[Json]) -> str:
    lines = []
    for failed in failures[:SHOWN]:
        lines += [
            failed["id"],
            f"  {failed['why']}",
            f"  {reading.fault(certificate, failed)}",
            f"  answer   {reading.said(failed)}",
            f"  expected {intervals(failed['expected'])}",
            f"  repeat   {clean(failed['reproduce'], 1000)}",
        ]
    if len(failures) > SHOWN:
        lines.append(f"and {len(failures) - SHOWN} more rows, all in the certificate")
    return "\n".join(lines)


def _untested(solid: str) -> Any:
    from junitparser import Skipped, TestCase, TestSuite

    suite = TestSuite(f"raycert.{solid}")
    test = TestCase("not tested", f"raycert.{solid}")
    test.result = [Skipped("no row of this type was sent: not declared, or not selected")]
    suite.add_testcase(test)
    return suite


def _run(certificate: Json) -> Any:
    """Return what no family can say: the convention, the expectations, an interruption."""
    from junitparser import Failure, Skipped, TestCase, TestSuite

    suite, found = TestSuite("raycert.run"), reading.verdict(certificate)
    test = TestCase(f"granted: {reading.asked(certificate)}", "raycert.run")
    if found.state in ("refused", "interrupted"):
        text = "\n".join((*found.reasons, f"repeat   {clean(certificate['reproduce'], 1000)}"))
        test.result = [_result(Failure(found.headline, found.state), text)]
    elif found.state != "granted":
        test.result = [Skipped(found.headline)]
    suite.add_testcase(test)
    if certificate["expectations"] is not None:
        test = TestCase("expectations", "raycert.run")
        if lines := reading.surprises(certificate):
            test.result = [_result(Failure(lines[0], "expectations"), "\n".join(lines))]
        suite.add_testcase(test)
    return suite
