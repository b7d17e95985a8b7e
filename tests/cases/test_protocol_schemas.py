"""The published schemas describe what is written, and refuse what the readers refuse."""

from __future__ import annotations

import io
import json
import math
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from jsonschema import Draft202012Validator

from raycert.cases import protocol
from raycert.cases.domain import Tolerance
from raycert.cases.formats import BINARY64, FORMATS, SPELLINGS, Spelling
from raycert.cases.model import Cylinder, Ray, Refused, Sphere
from raycert.cases.protocol import (
    ANSWERS,
    BadLine,
    Hello,
    answer,
    ask,
    convention,
    encode,
    first,
    hit,
    read_hello,
    read_reply,
    reply_first,
    reply_hit,
    reply_intervals,
    serve,
    write_hello,
)
from raycert.cases.strategies import solids
from raycert.oracle.starters import templates
from raycert.reference import tracer
from shared.corpus import golden

SCHEMAS = Path(protocol.__file__).parent / "schemas"
NAMES = ("hello", "question", "reply")


def schema(name: str) -> Any:
    return json.loads((SCHEMAS / f"{name}.schema.json").read_text())


CHECKS = {name: Draft202012Validator(schema(name)) for name in NAMES}
PART = {
    (name, part): Draft202012Validator({**schema(name), "$ref": f"#/$defs/{part}"})
    for name, part in [("hello", "asked"), ("hello", "declared")]
}
CAN = Cylinder((0, 0, 0), (0, 0, 2), 1)
ACROSS = Ray((-3, 0, 1), (1, 0, 0))


def complaint(name: str, line: bytes) -> str | None:
    error = next(CHECKS[name].iter_errors(json.loads(line)), None)
    return error and f"{error.json_path}: {error.message}"


@pytest.mark.parametrize("name", NAMES)
def test_the_schemas_are_schemas_and_every_field_is_described(name: str) -> None:
    whole = schema(name)
    Draft202012Validator.check_schema(whole)
    assert whole["description"]
    for part in fields(whole):
        assert {"description", "$ref", "const", "enum"} & set(part) or part.get("type"), part


def fields(node: Any) -> Iterator[Any]:
    if isinstance(node, dict):
        yield from node.get("properties", {}).values()
        for value in node.values():
            yield from fields(value)
    elif isinstance(node, list):
        for value in node:
            yield from fields(value)


# What our own writers write


@pytest.mark.parametrize("numbers", SPELLINGS)
@pytest.mark.parametrize("precision", FORMATS)
def test_every_question_and_answer_of_the_corpus_is_described(
    numbers: Spelling, precision: str
) -> None:
    hello = Hello("x", numbers=numbers, precision=precision)
    for row in golden(precision).rows[::97]:
        asked = ask(row.id, row.solid, row.ray, numbers, hello.format)
        assert complaint("question", asked) is None
        replies = (
            reply_intervals(row.id, row.expected, hello),
            reply_first(row.id, first(row.expected, "exit"), hello),
            reply_hit(row.id, hit(row.expected)),
        )
        for line in replies:
            assert complaint("reply", line) is None


@settings(deadline=None, max_examples=60)
@given(solids())
def test_every_solid_is_described(solid: Any) -> None:
    for numbers in SPELLINGS:
        assert complaint("question", ask("7", solid, ACROSS, numbers, BINARY64)) is None


@pytest.mark.parametrize("radius", [0.0, -0.0, 5e-324, 1.7976931348623157e308])
@pytest.mark.parametrize("numbers", SPELLINGS)
def test_the_ends_of_the_range_are_described(radius: float, numbers: Spelling) -> None:
    ball = Sphere((-0.0, -1.7976931348623157e308, 5e-324), radius)
    assert complaint("question", ask("7", ball, ACROSS, numbers, BINARY64)) is None


def test_both_hellos_are_described() -> None:
    assert PART["hello", "asked"].is_valid({"hello": 1})
    for answers in ANSWERS:
        line = write_hello(Hello("x", "2", answers, ("slab",), tolerance=Tolerance(0.5)))
        assert PART["hello", "declared"].is_valid(json.loads(line))
    assert not PART["hello", "asked"].is_valid({"hello": 1, "name": "x"})
    assert not PART["hello", "declared"].is_valid({"hello": 1})


@pytest.mark.parametrize("answers", ANSWERS)
@pytest.mark.parametrize("numbers", SPELLINGS)
def test_whatever_is_served_is_described(answers: Any, numbers: Spelling) -> None:
    hello = Hello("x", answers=answers, numbers=numbers)
    good = ask("7", CAN, ACROSS, numbers, BINARY64)
    lines = [b'{"hello": 1}', good, good.replace(b"radius", b"width"), b'{"id": "8"}', b"what", b""]
    out = io.BytesIO()
    serve(tracer.intersect, hello, lines, out)
    said, *replies = out.getvalue().splitlines()
    assert complaint("hello", said) is None
    for line in replies:
        assert complaint("reply", line) is None
    assert complaint("reply", answer(good, lambda *_: [(math.nan, 1.0)], hello)) is None


@pytest.mark.parametrize(
    "command",
    [
        ["-m", "raycert.reference"],
        ["-m", "raycert", "serve", "oracle"],
        ["starter"],
    ],
    ids=lambda command: command[-1],
)
def test_every_line_of_a_server_is_described(command: list[str], tmp_path: Path) -> None:
    if command == ["starter"]:
        for name, data in templates("python"):
            (tmp_path / name).write_bytes(data)
        command = [str(tmp_path / "tracer.py")]
    rows = golden().rows[::197]
    asked = [ask(row.id, row.solid, row.ray, "decimal", BINARY64) for row in rows]
    lines = b"".join([encode({"hello": 1}), *asked, b"nonsense\n", b'{"id": "9"}\n'])
    ran = subprocess.run([sys.executable, *command], input=lines, capture_output=True, check=True)
    hello, *replies = ran.stdout.splitlines()
    assert complaint("hello", hello) is None
    assert len(replies) == len(rows) + 2
    for line in replies:
        assert complaint("reply", line) is None


# What is refused


def line(**fields: Any) -> bytes:
    return json.dumps(fields).encode()


BAD_HELLOS = [
    line(name="x"),
    line(hello=2, name="x"),
    line(hello="1", name="x"),
    line(hello=True, name="x"),
    line(hello=None, name="x"),
    line(hello=1, name=""),
    line(hello=1, name=7),
    line(hello=1, name="x", colour="red"),
    line(hello=1, name="x", version=2.1),
    line(hello=1, name="x", answers="all"),
    line(hello=1, name="x", answers=["first"]),
    line(hello=1, name="x", solids=[]),
    line(hello=1, name="x", solids="sphere"),
    line(hello=1, name="x", solids=["cone"]),
    line(hello=1, name="x", solids=[["sphere"]]),
    line(hello=1, name="x", precision="float"),
    line(hello=1, name="x", convention="open"),
    line(hello=1, name="x", convention="closed but"),
    line(hello=1, name="x", convention="closed but caps"),
    line(hello=1, name="x", convention="closed but rimcap"),
    line(hello=1, name="x", convention="closed rim"),
    line(hello=1, name="x", convention=1),
    line(hello=1, name="x", numbers="octal"),
    line(hello=1, name="x", tolerance=-1),
    line(hello=1, name="x", tolerance="0"),
    line(hello=1, name="x", tolerance=True),
    line(hello=1, name="x", tolerance=math.inf),
    line(hello=1, name="x", tolerance=10**400),
    line(hello=1, name="x", from_inside="all"),
    line(hello=1, name="x", convention="any but rim"),
    line(hello=1, name="x", convention="closed but anyrim"),
    line(hello=1, name="x", domain=[]),
    line(hello=1, name="x", domain={"far": 1}),
    line(hello=1, name="x", domain={"size": 1}),
    line(hello=1, name="x", domain={"size": [1]}),
    line(hello=1, name="x", domain={"distance": 0}),
    line(hello=1, name="x", domain={"distance": True}),
    line(hello=1, name="x", degenerate=["point"]),
    line(hello=1, name="x", infinity=0),
    line(hello=1, name="x", infinity="inf"),
    line(hello=1, name="x", tolerance={"size": 1}),
    line(hello=1, name="x", tolerance={"relative": -1}),
    b"[1]",
]


@pytest.mark.parametrize("text", BAD_HELLOS)
def test_a_bad_hello_is_refused_by_schema_and_reader(text: bytes) -> None:
    assert complaint("hello", text) is not None
    with pytest.raises(BadLine):
        read_hello(text)


@pytest.mark.parametrize(
    "text",
    ["closed", "regularized", "closed but rim", "closed but rim, cap", "regularized but  start ",
     "closed but tangent wall cap rim start", "closed but ,", "any", "closed but any tangent",
     "regularized but rim, any start cap", "closed but any"],
)  # fmt: skip
def test_a_convention_is_taken_by_schema_and_reader(text: str) -> None:
    assert convention(text)
    assert complaint("hello", line(hello=1, name="x", convention=text)) is None


GOOD = {
    "id": "7",
    "solid": {"type": "cylinder", "p": [0, 0, 0], "q": [0, 0, 2], "radius": 1},
    "ray": {"origin": [-3, 0, 1], "direction": [1, 0, 0]},
}
BALL = {"type": "sphere", "center": [0, 0, 0], "radius": 1}
BAD_SOLIDS = [
    None,
    [],
    {},
    {"type": "cone"},
    {"type": ["sphere"]},
    {**BALL, "radius": -1},
    {**BALL, "radius": None},
    {**BALL, "radius": True},
    {**BALL, "radius": [1]},
    {**BALL, "radius": 10**400},
    {**BALL, "colour": "red"},
    {**BALL, "center": [0, 0]},
    {**BALL, "center": [0, 0, 0, 0]},
    {**BALL, "center": [0, 0, "x"]},
    {**BALL, "center": [0, 0, None]},
    {"type": "sphere", "center": [0, 0, 0]},
    {"type": "slab", "p": [0, 0, 0], "q": [0, 0, 1], "radius": 1},
    {"type": "half_space", "point": [0, 0, 0]},
    {"type": "union", "of": []},
    {"type": "union", "of": BALL},
    {"type": "union", "of": [{}]},
    {"type": "union"},
]


@pytest.mark.parametrize("solid", BAD_SOLIDS, ids=repr)
def test_a_bad_solid_is_refused_by_schema_and_reader(solid: object) -> None:
    text = line(**{**GOOD, "solid": solid})
    assert complaint("question", line(**GOOD)) is None
    assert complaint("question", text) is not None
    assert "error" in json.loads(answer(text, tracer.intersect, Hello("x")))


@pytest.mark.parametrize(
    "ray",
    [None, {}, {"origin": [0, 0, 0]}, {**GOOD["ray"], "t": 0}, {**GOOD["ray"], "origin": [1]}],  # type: ignore[dict-item]
    ids=repr,
)
def test_a_bad_ray_is_refused_by_schema_and_reader(ray: object) -> None:
    text = line(**{**GOOD, "ray": ray})
    assert complaint("question", text) is not None
    assert "error" in json.loads(answer(text, tracer.intersect, Hello("x")))


@pytest.mark.parametrize(
    ("numbers", "radius"),
    [("hex", "-0x1.0p+0"), ("hex", "nan"), ("hex", "inf"), ("bits", "bff0000000000000"),
     ("bits", "3ff0"), ("bits", "3ff000000000000g")],
)  # fmt: skip
def test_a_bad_string_for_a_number_is_refused_by_schema_and_reader(
    numbers: Spelling, radius: str
) -> None:
    form = json.loads(ask("7", CAN, ACROSS, numbers, BINARY64))
    form["solid"]["radius"] = radius
    assert complaint("question", encode(form)) is not None
    hello = Hello("x", numbers=numbers)
    assert "error" in json.loads(answer(encode(form), tracer.intersect, hello))


def test_what_only_the_reader_of_questions_can_tell() -> None:
    for solid in (
        {**GOOD["solid"], "q": [0, 0, 0]},  # type: ignore[dict-item]
        {"type": "half_space", "point": [0, 0, 0], "normal": [0, 0, 0]},
    ):
        text = line(**{**GOOD, "solid": solid})
        assert complaint("question", text) is None
        assert "error" in json.loads(answer(text, tracer.intersect, Hello("x")))
    with pytest.raises(Refused):
        Cylinder((0, 0, 0), (0, 0, 0), 1)


PLAIN, FIRST, ANY = (Hello("x", answers=answers) for answers in ANSWERS)
BAD_REPLIES = [
    (b"[]", PLAIN),
    (line(intervals=[]), PLAIN),
    (line(id=7, intervals=[]), PLAIN),
    (line(id=None, error="x"), PLAIN),
    (line(id="7"), PLAIN),
    (line(id="7", intervals=None), PLAIN),
    (line(id="7", intervals={}), PLAIN),
    (line(id="7", intervals=[2, 4]), PLAIN),
    (line(id="7", intervals=[[2]]), PLAIN),
    (line(id="7", intervals=[[2, 3, 4]]), PLAIN),
    (line(id="7", intervals=["24"]), PLAIN),
    (line(id="7", intervals=[["2", 4]]), PLAIN),
    (line(id="7", intervals=[[2, True]]), PLAIN),
    (line(id="7", intervals=[[2, []]]), PLAIN),
    (line(id="7", intervals=[["z", "z"]]), Hello("x", numbers="hex")),
    (line(id="7", intervals=[["3ff0", "0"]]), Hello("x", numbers="bits")),
    (line(id="7", intervals=[["3ff0 0000 0000  "] * 2]), Hello("x", numbers="bits")),
    (line(id="7", unsupported=None, intervals=[]), PLAIN),
    (line(id="7", unsupported=7), PLAIN),
    (line(id="7", error={"code": 3}, intervals=[]), PLAIN),
    (line(id="7", first="2"), FIRST),
    (line(id="7", first=False), FIRST),
    (line(id="7", first=[2]), FIRST),
    (line(first=2), FIRST),
    (line(id="7", hit=1), ANY),
    (line(id="7", hit=None), ANY),
    (line(hit=True), ANY),
]


@pytest.mark.parametrize(("text", "hello"), BAD_REPLIES)
def test_a_bad_reply_is_refused_by_schema_and_reader(text: bytes, hello: Hello) -> None:
    assert complaint("reply", text) is not None
    with pytest.raises(BadLine):
        read_reply(text, hello)


@pytest.mark.parametrize(
    ("text", "hello"),
    [
        (line(id="7", intervals=[[0, None], [1, "inf"], [2, "Infinity"]]), PLAIN),
        (b'{"id": "7", "intervals": [[2, Infinity]]}', PLAIN),
        (line(id="7", intervals=[["0x1p+0", "0X1.8P1"]]), Hello("x", numbers="hex")),
        (line(id="7", intervals=[["3FF0000000000000", None]]), Hello("x", numbers="bits")),
        (line(id="7", intervals=[], took=3), PLAIN),
        (line(id="7", unsupported="no caps", intervals=7), PLAIN),
        (line(id="7", unsupported="no caps", error=7), PLAIN),
        (line(id="7", error=""), ANY),
        (line(id="7", first=None), FIRST),
        (line(id="7", first="inf"), FIRST),
        (line(id="7", hit=False), ANY),
    ],
)
def test_a_good_reply_is_taken_by_schema_and_reader(text: bytes, hello: Hello) -> None:
    assert complaint("reply", text) is None
    assert read_reply(text, hello).id == "7"


@pytest.mark.parametrize(
    ("text", "hello"),
    [
        (line(id="7", first=2), PLAIN),
        (line(id="7", intervals=[[2, 4]]), Hello("x", numbers="hex")),
        (line(id="7", intervals=[["3ff0000000000000"] * 2]), PLAIN),
        (line(id="7", intervals=[["0x1p9999", None]]), Hello("x", numbers="hex")),
        (line(error="no id"), PLAIN),
    ],
)
def test_what_only_the_reader_of_replies_can_tell(text: bytes, hello: Hello) -> None:
    assert complaint("reply", text) is None
    with pytest.raises(BadLine):
        read_reply(text, hello)
