"""A tracer put to the golden cases, from a prompt."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from importlib import import_module
from operator import attrgetter
from typing import Any

from raycert.answers import TALL, _framed
from raycert.cases.corpus import read_corpus
from raycert.cases.levels import Level
from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import Reply, read_fields
from raycert.cases.row import GoldenRow
from raycert.oracle.certify import run
from raycert.oracle.certify.certificate import Json, Ran
from raycert.oracle.certify.grading import grade
from raycert.oracle.certify.run import Plan, Prepared, Result
from raycert.oracle.certify.selection import Selection, able, select
from raycert.oracle.certify.verdict import verdict
from raycert.oracle.client.target import target

Intersect = Callable[[Solid, Ray], Iterable[tuple[float, float]]]


@dataclass(frozen=True, slots=True, repr=False)
class Certification:
    """What came of a certification: true where all that was asked passes.

    A part of the cases makes no certificate, and the certificate says so.
    """

    result: Result
    words: tuple[str, ...]

    def __bool__(self) -> bool:
        """Whether it is granted."""
        return self.result.verdict.granted

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why it is not granted; empty where it is."""
        return self.result.verdict.reasons

    @property
    def certificate(self) -> Json:
        """The certificate, as `raycert certify --out` writes it."""
        return self.result.form(self.words)

    def __str__(self) -> str:
        """Return the report that `raycert certify` prints."""
        from raycert.oracle.reports.screen import screen
        from raycert.oracle.reports.terminal import report

        console = screen(width=100, color_system=None, force_terminal=False)
        with console.capture() as capture:
            report(self.certificate, console)
        return capture.get()

    __repr__ = __str__

    def _repr_html_(self) -> str:
        """Return the page of the certificate, in a frame."""
        from raycert.oracle.reports.page import page

        return _framed(page(self.certificate), 2 * TALL)


def certify(
    tracer: Intersect | str | Sequence[str],
    level: Level = "sound",
    convention: str = "closed",
    *,
    solids: Sequence[str] = (),
    families: Sequence[str] = (),
    tiers: Sequence[str] = (),
    ids: Sequence[str] = (),
) -> Certification:
    """Put a tracer to the golden cases and judge every answer; the options narrow the cases.

    A tracer is a function of solid and ray that returns pairs, or what `raycert certify` takes:
    `"module:function"`, the path of a C library, or the words of a program that speaks the line
    protocol. What can be imported runs in a process of its own, where it may crash or hang; a
    function that was made at the prompt runs in this one.

    >>> from raycert import intersect
    >>> bool(certify(intersect, "stable", families=["tangent-exact"]))
    True
    >>> certify(lambda solid, ray: [], families=["table-through"]).reasons[0]
    'cylinder: sound fails on ... rows, in table-through (...)'
    """
    selection = Selection(tuple(solids), tuple(tiers), tuple(families), tuple(ids))
    words = (tracer,) if isinstance(tracer, str) else _words(tracer)
    if callable(tracer) and not _is_importable(words[0], tracer):
        plan = Plan(words, level, convention, selection)
        return Certification(_in_this_process(tracer, words[0], plan), words)
    plan = Plan(target(words), level, convention, selection)
    return Certification(run.certify(plan), words)


def _words(tracer: Intersect | Sequence[str]) -> tuple[str, ...]:
    if callable(tracer):
        name = getattr(tracer, "__qualname__", type(tracer).__name__)
        return (f"{getattr(tracer, '__module__', '__main__')}:{name}",)
    return tuple(tracer)


def _is_importable(word: str, tracer: object) -> bool:
    """Whether another process finds the same function by its module and name."""
    module, _, name = word.partition(":")
    if module == "__main__":
        return False
    try:
        found: object = attrgetter(name)(import_module(module))
    except (ImportError, AttributeError):
        return False
    return found is tracer


def _in_this_process(tracer: Intersect, name: str, plan: Plan) -> Result:
    """Ask every row by a call."""
    declared: dict[str, Any] = {"name": name, **getattr(tracer, "hello", {})}
    hello, began = read_fields(declared), time.monotonic()
    corpus = read_corpus(hello.precision, solids=hello.solids)
    if absent := plan.selection.missing(corpus):
        raise run.NotInCorpus(f"not in the corpus: {', '.join(absent)}")
    rows, left = select(corpus, hello, plan.selection)
    grades = tuple(grade(row, _reply(tracer, row), hello) for row in rows)
    ran = Ran(restarts=0, notes=(), seconds=round(time.monotonic() - began, 3))
    known = tuple(able(corpus.rows, hello))
    prepared = Prepared(plan, hello, corpus, tuple(rows), left, known)
    return Result(
        prepared, grades, ran, verdict(grades, plan.level, plan.convention, hello.domain.words())
    )


def _reply(tracer: Intersect, row: GoldenRow) -> Reply:
    try:
        pairs = tuple((float(a), float(b)) for a, b in tracer(row.solid, row.ray))
    except Exception as error:
        return Reply(row.id, error=f"{type(error).__name__}: {error}")
    return Reply(row.id, intervals=pairs)
