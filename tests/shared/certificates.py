"""Certificates of known runs, made in process from a sample of the corpus, as read from JSON."""

import json
from collections.abc import Callable, Iterable
from functools import cache
from typing import Any

from raycert.cases.levels import Level
from raycert.cases.model import Ray, Solid
from raycert.cases.protocol import Hello, Reply
from raycert.cases.row import GoldenRow
from raycert.oracle.certify.certificate import Ran, Request, certificate
from raycert.oracle.certify.environment import environment
from raycert.oracle.certify.grading import Grade, grade
from raycert.oracle.certify.selection import Left
from raycert.oracle.certify.verdict import verdict
from raycert.oracle.client.process import Failure
from raycert.oracle.zoo.inhabitants import BY_NAME
from shared.corpus import golden

Json = dict[str, Any]
Outcome = Reply | Failure
HOSTILE = (
    "<script>document.title='owned'</script></title><img src=x onerror=alert(1)> \u202eRTL \x00 "
    "\ud800 \x1b[31m ``` | ]]> [/red] e" + "\u0301" * 50
)
STEP = 60
LIKELY: list[Json] = [
    {
        "solid": "cylinder",
        "level": "sound",
        "failures": 9,
        "explained": [
            {
                "fault": "some-fault",
                "does": "does likely this",
                "origin": "somewhere",
                "rows": 8,
                "first": "perpendicular/any",
            }
        ],
        "unexplained": 1,
    }
]


@cache
def sample() -> tuple[GoldenRow, ...]:
    """Return some rows of every family."""
    seen: dict[str, int] = {}
    taken = []
    for row in golden().rows:
        n = seen[row.family] = seen.get(row.family, -1) + 1
        if n % STEP == 0:
            taken.append(row)
    return tuple(taken)


def right(row: GoldenRow, n: int) -> Outcome:
    return Reply(row.id, intervals=row.expected)


def planted(name: str) -> Callable[[GoldenRow, int], Outcome]:
    tracer: Callable[[Solid, Ray], Iterable[tuple[float, float]]] = BY_NAME[name].make()
    return lambda row, n: Reply(row.id, intervals=tuple(tracer(row.solid, row.ray)))


def hostile(row: GoldenRow, n: int) -> Outcome:
    """Answer with what no report may be broken by."""
    lists: dict[int, tuple[tuple[float, float], ...]] = {
        3: ((float("nan"), 1.0),),
        4: tuple((2.0 * i, 2.0 * i + 1) for i in range(300)),
        5: ((0.0, float("inf")), (-1.0, float("-inf"))),
        6: ((1e300, 1.5e300),),
    }
    if n % 8 == 0:
        return Reply(row.id, error=HOSTILE * 8)
    if n % 8 == 1:
        return Failure("crash", HOSTILE * 8)
    if n % 8 == 2:
        return Failure("hang", "no answer for 5 s")
    return Reply(row.id, intervals=lists.get(n % 8, ()))


def first(row: GoldenRow, n: int) -> Outcome:
    """Answer the first hit, too far by a little."""
    return Reply(row.id, first=row.expected[0][0] * (1 + 1e-9) if row.expected else None)


def yes_no(row: GoldenRow, n: int) -> Outcome:
    return Reply(row.id, hit=n % 3 > 0)


def made(
    answer: Callable[[GoldenRow, int], Outcome],
    level: Level = "stable",
    hello: Hello | None = None,
    rows: tuple[GoldenRow, ...] | None = None,
    interrupted: bool = False,
    selection: tuple[str, ...] = (),
    **more: Any,
) -> Json:
    """Return the certificate of a run, as read back from its file."""
    hello = hello or Hello("a tracer", "1.0")
    rows = sample() if rows is None else rows
    grades: list[Grade] = [grade(row, answer(row, n), hello) for n, row in enumerate(rows)]
    asked = Request(level, "closed", ("--", "./tracer"), selection)
    ran = Ran(1, ("a note",), 1.25, interrupted, "2026-01-02T03:04:05+00:00", {"likely": LIKELY})
    judged = verdict(grades, level, "closed")
    form = certificate(
        asked, hello, golden(), grades, Left((), 0), ran, judged, environment(), **more
    )
    read: Json = json.loads(json.dumps(form, allow_nan=False))
    return read


@cache
def good() -> Json:
    return made(right)


@cache
def bad() -> Json:
    return made(planted("caps-forgotten"))


@cache
def much() -> Json:
    """Return a certificate with something of all that a run can find."""
    form: Json = json.loads(json.dumps(bad()))
    union = {**LIKELY[0], "solid": "union", "unexplained": 0}
    union["explained"] = [LIKELY[0]["explained"][0] | {"rows": 9}]
    form["likely"] = [*LIKELY, union]
    ball = {"type": "sphere", "center": [1.0, 2.0, 3.0], "radius": 2.0}
    first = {"id": "easy/through", "solid": ball, "ray": TRIED, "answer": "[]", "expected": "no"}
    easy = {"solid": "sphere", "failed": 3, "of": 4, "first": first}
    form["easy"] = [easy | {"misread": "it ignores the center"}, easy | {"misread": None}]
    edge = {"quantity": "distance", "side": "high", "bound": 1000.0, "row": "sphere-far/far"}
    words = {"domain": {"distance": 1000.0}, "words": "starts within 1000 sizes"}
    counts = {"rows": 752, "left": 123, "edges": [edge | {"fault": "too far"}]}
    ordinary = {"ordinary": {"failed": 0, "rows": []}, "exhaustive": True}
    sphere = form["solids"]["sphere"]
    sphere["measured"] = {"sound": words | counts | ordinary}
    sphere["outside"]["stable"] = {"rows": 312, "right": 250, "refused": 40, "wrong": 22}
    for solid in form["solids"].values():
        solid["degenerate"] = {}
    sphere["degenerate"]["zero_direction"] = {"rows": 16, "answered": 0, "refused": 15, "wrong": 1}
    return form


TRIED = {"origin": [-7.0, 2.0, 3.0], "direction": [4.0, 0.0, 0.0]}


@cache
def attacked() -> Json:
    hello = Hello(HOSTILE + "A" * 100_000, version="</style>" + HOSTILE)
    return made(hostile, hello=hello)


def expecting(**lists: list[str]) -> Json:
    """Return what is said of a file of known failures."""
    names = ("expected", "unexpected_passes", "unmatched", "new")
    return {"file": "known.toml"} | {name: lists.get(name, []) for name in names}


def accepted() -> Json:
    """Return the certificate of a run whose failures are the expected ones."""
    rows = tuple(row for row in sample() if row.id.startswith("perpendicular/"))
    failing = [f["id"] for f in made(planted("caps-forgotten"), rows=rows)["failures"]]
    told = expecting(expected=failing)
    return made(planted("caps-forgotten"), rows=rows, expectations=told)
