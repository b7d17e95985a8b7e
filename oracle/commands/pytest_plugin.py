"""pytest --raycert TARGET: one test for each family of golden rows, one subtest for each failure.

TARGET is what `raycert certify` takes after `--`, as one word: a command that speaks the line
protocol (`--raycert "./my_tracer --fast"`), or `module:function`, a Python callable that takes a
solid and a ray of cases.model and returns the pairs:

    # my_tracer.py
    def trace(solid, ray):
        return [(enter, leave), ...]

    pytest --raycert my_tracer:trace --raycert-level stable
    pytest --raycert ./my_tracer -k "far-deep or rim"
    pytest --raycert ./my_tracer --raycert-expect known.toml

The tests are named `raycert::FAMILY`. The target is asked once, for the families that are left
after deselection; under pytest-xdist, each worker asks for a family when that test is its turn.
Without --raycert nothing is loaded and nothing done.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import pytest

from raycert.cases.levels import LEVELS, Level

if TYPE_CHECKING:
    from raycert.oracle.certify.grading import Grade
    from raycert.oracle.certify.known import Expectations, Matched
    from raycert.oracle.certify.run import Plan, Prepared

NAME = "raycert"
EXPECTATIONS = "expectations"
"""The test for the entries of --raycert-expect that are about nothing."""


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup(NAME, "certify a ray tracer on the golden cases of raycert")
    add = group.addoption
    add("--raycert", metavar="TARGET", help="Certify this command, or module:function.")
    add("--raycert-level", choices=LEVELS, default="sound", help="The level asked (sound).")
    add("--raycert-convention", default="closed", help="The convention asked (closed).")
    add("--raycert-family", action="append", default=[], help="Only this family (repeatable).")
    add("--raycert-golden", metavar="DIR", help="Golden files instead of the installed ones.")
    add("--raycert-expect", metavar="FILE", help="Known failures, with their reasons (TOML).")
    add("--raycert-seed", type=int, metavar="N", help="Ask a block of fresh rows too.")
    add("--raycert-fresh", type=int, metavar="COUNT", help="How many fresh rows (500).")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(session: pytest.Session, items: list[pytest.Item]) -> None:
    """Add the tests of the families, before -k and the like choose among all."""
    if session.config.getoption("--raycert"):
        families = Families.from_parent(session, name=NAME, nodeid=NAME)
        items.extend(node for node in session.genitems(families) if isinstance(node, pytest.Item))


class Families(pytest.Collector):
    """The families that the target declares the solids of."""

    def collect(self) -> Iterable[pytest.Item]:
        """Greet the target, and yield a test for each family of its rows."""
        campaign = Campaign(self.session)
        names = list(dict.fromkeys(row.family for row in campaign.prepared.rows))
        names += [EXPECTATIONS] if campaign.file else []
        for name in names:
            yield FamilyTest.of(self, name, campaign)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> str:
        """Say why the target cannot be tested, without a traceback."""
        return str(excinfo.value) or excinfo.exconly()


class FamilyTest(pytest.Function):
    """The test of one family. `campaign` asks for all families at once, if it may."""

    campaign: Campaign

    @classmethod
    def of(cls, parent: pytest.Collector, name: str, campaign: Campaign) -> FamilyTest:
        """Return the test of a family; with subtests where this pytest has them."""
        calls: list[Any] = [lambda: campaign.check(name, None)]
        if parent.config.pluginmanager.hasplugin("subtests"):
            calls = [lambda subtests: campaign.check(name, subtests)]
        test: FamilyTest = cls.from_parent(parent, name=name, callobj=calls[0])
        test.campaign = campaign
        return test

    def reportinfo(self) -> tuple[str, None, str]:
        return NAME, None, f"{NAME}::{self.name}"


class Campaign:
    """One target in one session: what it declares, and the grades of what it was asked."""

    def __init__(self, session: pytest.Session) -> None:
        """Greet the target. Whatever keeps it from being tested is a `pytest.UsageError`."""
        from raycert.cases.files import BadFile, read_text
        from raycert.cases.protocol import BadLine
        from raycert.oracle.certify.known import Expectations, read
        from raycert.oracle.certify.run import NotInCorpus, Unsuitable, prepare
        from raycert.oracle.client.dialogue import Unusable
        from raycert.oracle.reports.foreign import escaped

        self.session = session
        self.file: str | None = session.config.getoption("--raycert-expect")
        self.expectations: Expectations = Expectations()
        self.grades: dict[str, list[Grade]] = {}
        try:
            self.plan = _plan(session.config)
            if self.file:
                self.expectations = read(read_text(Path(self.file)), self.file)
            self.prepared: Prepared = prepare(self.plan)
        except (BadFile, BadLine, NotInCorpus, Unsuitable, Unusable) as error:
            raise pytest.UsageError(escaped(f"raycert: {error}")) from None

    def check(self, family: str, subtests: Any) -> None:
        """Fail on what is not expected of a family; xfail on what is."""
        from raycert.oracle.reports.foreign import escaped

        if family == EXPECTATIONS:
            self._check_expectations()
            return
        matched = self._match(self._graded(family))
        wrong = [*self._failures(family, matched), *_stale(matched, family, self.expectations)]
        if subtests is None and wrong:
            _fail("\n".join(text for _, text in wrong))
        for name, text in wrong:
            with subtests.test(msg=name):
                _fail(text)
        if matched.expected and not wrong:
            about = [e for e in self.expectations.entries if _is_about(e.name, matched.expected)]
            why = "; ".join(dict.fromkeys(entry.reason for entry in about))
            pytest.xfail(escaped(f"{len(matched.expected)} known failures: {why}"))

    def _graded(self, family: str) -> list[Grade]:
        """Return the grades of a family, asked now if they were not before."""
        from raycert.oracle.certify.run import Unsuitable, conduct
        from raycert.oracle.client.dialogue import Unusable

        if family not in self.grades:
            try:
                result = conduct(self.prepared.only(self._families(family)))
            except (Unusable, Unsuitable) as error:
                _fail(f"raycert: {error}")
            if result.ran.interrupted:
                raise KeyboardInterrupt
            for grade in result.grades:
                self.grades.setdefault(grade.row.family, []).append(grade)
        return self.grades[family]

    def _families(self, family: str) -> list[str]:
        """Return the families to ask for now: all that are left, or under xdist just this."""
        if hasattr(self.session.config, "workerinput"):
            return [family]
        mine = [item for item in self.session.items if isinstance(item, FamilyTest)]
        return [item.name for item in mine if item.name not in self.grades]

    def _match(self, grades: Sequence[Grade]) -> Matched:
        from raycert.oracle.certify.known import match

        plan = self.plan
        return match(self.expectations, grades, plan.level, plan.convention, self.prepared.known)

    def _failures(self, family: str, matched: Matched) -> Iterator[tuple[str, str]]:
        """Yield (name, text) of what failed and was not expected to."""
        from raycert.oracle.certify.known import failed_level

        grades = {grade.row.id: grade for grade in self.grades[family]}
        for text in matched.new:
            name = text.partition(": ")[0]
            grade = grades.get(name)
            if grade is not None and (level := failed_level(grade, self.plan.level)):
                yield name, f"{text}\n{self._shown(grade, level)}"
            elif "no row decides" not in text and text != "nothing was tested":
                yield name, text  # a convention; families may decide nothing

    def _shown(self, grade: Grade, level: Level) -> str:
        """Return what a person needs to see of a failure, with the command that repeats it."""
        from raycert.cases.domain import within

        words = shlex.split(self.session.config.getoption("--raycert"))
        fresh = self.plan.fresh.options() if self.plan.fresh else ()
        repeat = ("raycert", "certify", "--level", self.plan.level, *fresh, "--id", grade.row.id)
        level_said = within(level, self.prepared.hello.domain.words())
        lines = [grade.row.why, f"{level_said}: {grade.fault(level)}"]
        if grade.answer is not None:
            lines.append(f"answered {[list(pair) for pair in grade.answer]}")
        lines.append(f"expected {[list(pair) for pair in grade.row.expected]}")
        return "\n".join([*lines, f"repeat   {shlex.join((*repeat, '--', *words))}"])

    def _check_expectations(self) -> None:
        matched = self._match([grade for graded in self.grades.values() for grade in graded])
        whole = [text for text in matched.unexpected_passes if text.startswith("convention ")]
        wrong = [*matched.unmatched, *whole]
        if wrong:
            _fail(f"{self.file}:\n" + "\n".join(wrong))


def _fail(text: str) -> NoReturn:
    from raycert.oracle.reports.foreign import escaped

    pytest.fail(escaped(text), pytrace=False)


def _stale(matched: Matched, family: str, known: Expectations) -> Iterator[tuple[str, str]]:
    """Yield (name, text) of the entries about a family that pass."""
    for text in matched.unexpected_passes:
        name = text.partition(": ")[0]
        if name == f"family {family}" or name.startswith(f"{family}/"):
            yield name, f"{text}: expected to fail, and passes; take it from the file"


def _is_about(name: str, expected: Iterable[str]) -> bool:
    """Whether an entry's name is that of an expected failure, its family or its solid."""
    return any(said == name or said.startswith((f"{name}/", f"{name}: ")) for said in expected)


def _plan(config: pytest.Config) -> Plan:
    from raycert.cases.corpus import GOLDEN
    from raycert.cases.protocol import convention
    from raycert.oracle.certify.run import Plan
    from raycert.oracle.certify.selection import Selection
    from raycert.oracle.client.target import target
    from raycert.oracle.corpus.fresh import COUNT, Fresh

    option, seed = config.getoption, config.getoption("--raycert-seed")
    convention(option("--raycert-convention"))
    return Plan(
        target(shlex.split(option("--raycert"))),
        option("--raycert-level"),
        option("--raycert-convention"),
        Selection(families=tuple(option("--raycert-family"))),
        golden=Path(option("--raycert-golden") or GOLDEN),
        fresh=None if seed is None else Fresh(seed, option("--raycert-fresh") or COUNT),
    )
