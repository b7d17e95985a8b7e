"""The messages of the protocol, and every line that is not one."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.degenerate import DEGENERACIES
from raycert.cases.domain import Domain, Tolerance
from raycert.cases.formats import FORMATS, SPELLINGS, spell
from raycert.cases.model import SOLIDS, Cylinder, Ray
from raycert.cases.protocol import (
    ANSWERS,
    FROM_INSIDE,
    TOUCHES,
    Answers,
    BadLine,
    Hello,
    Reply,
    ask,
    convention,
    decode,
    encode,
    read_hello,
    read_reply,
    reply_first,
    reply_hit,
    reply_intervals,
    write_hello,
)

QUICK = settings(deadline=None, max_examples=60)
PLAIN = Hello("x")


def line(**fields: Any) -> bytes:
    return json.dumps(fields).encode()


HELLOS = st.builds(
    Hello,
    name=st.text(min_size=1),
    version=st.text(),
    answers=st.sampled_from(ANSWERS),
    solids=st.lists(st.sampled_from(sorted(SOLIDS)), min_size=1, unique=True).map(tuple),
    precision=st.sampled_from(sorted(FORMATS)),
    convention=st.sampled_from(
        ["closed", "regularized", "closed but rim, cap", "any", "closed but any tangent"]
    ),
    numbers=st.sampled_from(SPELLINGS),
    tolerance=st.builds(Tolerance, st.floats(0, 1e300), st.floats(0, 1)),
    from_inside=st.sampled_from(FROM_INSIDE),
    domain=st.builds(Domain, distance=st.none() | st.floats(1e-9, 1e9), size=st.just((None, 7.5))),
    degenerate=st.sampled_from([(), DEGENERACIES[:1], DEGENERACIES]),
    infinity=st.none() | st.floats(1, 1e300),
)


@QUICK
@given(HELLOS)
def test_a_hello_survives_its_line(hello: Hello):
    written = write_hello(hello)
    assert written.isascii()
    assert written.index(b"\n") == len(written) - 1
    assert read_hello(written) == hello


def test_all_of_a_hello_but_the_name_may_be_left_out():
    assert read_hello(b'{"hello": 1, "name": "x"}') == Hello(
        "x", "", "intervals", tuple(SOLIDS), "binary64", "closed", "decimal", Tolerance(), "zero"
    )


def test_the_hello_of_the_contract_is_read():
    hello = read_hello(
        b'{"hello": 1, "name": "my tracer", "version": "2.1", "answers": "intervals", "solids": '
        b'["sphere", "cylinder"], "precision": "binary64", "convention": "closed", "numbers": '
        b'"decimal", "tolerance": 0}\r\n'
    )
    assert hello == Hello("my tracer", "2.1", solids=("sphere", "cylinder"))
    assert hello.format is FORMATS["binary64"]


DEEP = b"[" * 900 + b"]" * 900


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (b"", "is not JSON"),
        (b"hello", "is not JSON"),
        (b"\xff\xfe{", "is not JSON"),
        (b"[" * 100_000, "is not JSON"),
        (b'{"hello": ' + b"1" * 5000 + b"}", "is not JSON"),
        (b"[1]", "is not a JSON object"),
        (b"1", "is not a JSON object"),
        (line(name="x"), "hello is not 1"),
        (line(hello=2, name="x"), "hello is not 1"),
        (line(hello="1", name="x"), "hello is not 1"),
        (line(hello=True, name="x"), "hello is not 1"),
        (line(hello=1), "hello.name is missing"),
        (line(hello=1, name=""), "hello.name is missing"),
        (line(hello=1, name=7), "hello.name is missing"),
        (line(hello=1, name="x", colour="red"), "hello.colour is not a field"),
        (line(hello=1, name="x", answers="all"), "hello.answers is not one of"),
        (line(hello=1, name="x", answers=["first"]), "hello.answers is not one of"),
        (line(hello=1, name="x", precision="float"), "hello.precision is not one of"),
        (line(hello=1, name="x", precision=None), "hello.precision is not one of"),
        (line(hello=1, name="x", numbers={}), "hello.numbers is not one of"),
        (line(hello=1, name="x", from_inside="all"), "hello.from_inside is not one of"),
        (line(hello=1, name="x", solids=[]), "hello.solids is not a list"),
        (line(hello=1, name="x", solids="sphere"), "hello.solids is not a list"),
        (line(hello=1, name="x", solids=["cone"]), "unknown type 'cone'"),
        (line(hello=1, name="x", solids=[["sphere"]]), "unknown type"),
        (line(hello=1, name="x", solids=[{}]), "unknown type"),
        (line(hello=1, name="x", tolerance=-1), "finite number >= 0"),
        (line(hello=1, name="x", tolerance=math.nan), "finite number >= 0"),
        (line(hello=1, name="x", tolerance=math.inf), "finite number >= 0"),
        (line(hello=1, name="x", tolerance=10**400), "finite number >= 0"),
        (line(hello=1, name="x", tolerance="0"), "hello.tolerance is not a number"),
        (line(hello=1, name="x", tolerance=True), "hello.tolerance is not a number"),
        (line(hello=1, name="x", version=2.1), "hello.version is not a string"),
        (line(hello=1, name="x", convention=1), "hello.convention is not a string"),
        (line(hello=1, name="x", convention="open"), "convention is not any, closed"),
        (line(hello=1, name="x", convention="any but rim"), "convention is not any, closed"),
        (line(hello=1, name="x", domain=[]), "hello.domain is not an object"),
        (line(hello=1, name="x", domain={"far": 1}), "hello.domain.far is not a quantity"),
        (line(hello=1, name="x", domain={"size": [2, 1]}), "hello.domain.size has its low bound"),
        (line(hello=1, name="x", domain={"distance": 0}), "hello.domain.distance is not a number"),
        (line(hello=1, name="x", degenerate=["point"]), "hello.degenerate is not a list of zero_d"),
        (line(hello=1, name="x", degenerate="zero_radius"), "hello.degenerate is not a list"),
        (line(hello=1, name="x", degenerate=[[]]), "hello.degenerate is not a list"),
        (line(hello=1, name="x", infinity=0), "hello.infinity is not a number > 0"),
        (line(hello=1, name="x", infinity="inf"), "hello.infinity is not a number"),
        (line(hello=1, name="x", tolerance={"size": 1}), "hello.tolerance.size is not a field"),
        (line(hello=1, name="x", tolerance={"relative": -1}), "hello.tolerance.relative is not a"),
        (line(hello=1, name="x", convention="closed but pole"), "unknown kind of touch: 'pole'"),
        (b'{"hello": 1, "name": "x", "solids": [' + DEEP + b"]}", "unknown type|nested too deep"),
    ],
)
def test_a_bad_hello_says_what_is_wrong(text: bytes, says: str):
    with pytest.raises(BadLine, match=says) as caught:
        read_hello(text)
    assert len(str(caught.value)) < 400


@QUICK
@given(st.integers(800, 1000), st.sampled_from(["name", "answers", "solids", "tolerance"]))
def test_a_deep_hello_is_never_a_traceback(depth: int, name: str):
    fields = {"hello": b"1", "name": b'"x"', name: b"[" * depth + b"]" * depth}
    text = b",".join(b'"%s": %s' % (key.encode(), value) for key, value in fields.items())
    with pytest.raises(BadLine):
        read_hello(b"{" + text + b"}")


def test_conventions():
    assert convention("closed") == dict.fromkeys(TOUCHES, True)
    assert convention("regularized") == dict.fromkeys(TOUCHES, False)
    assert convention("closed but tangent rim") == dict.fromkeys(TOUCHES, True) | {
        "tangent": False,
        "rim": False,
    }
    assert convention("any") == dict.fromkeys(TOUCHES)
    assert convention("closed but any tangent") == dict.fromkeys(TOUCHES, True) | {"tangent": None}
    assert convention("regularized but rim, any start cap") == {
        "tangent": False, "wall": False, "cap": None, "rim": True, "start": None,
    }  # fmt: skip
    assert convention("regularized but start") == dict.fromkeys(TOUCHES, False) | {"start": True}


@pytest.mark.parametrize("text", ["", "open", "closed rim", "Closed", "closed but caps"])
def test_a_bad_convention_is_refused(text: str):
    with pytest.raises(BadLine):
        convention(text)


def test_a_question_is_one_line_of_ascii():
    asked = ask("7", Cylinder((0, 0, 0), (0, 0, 2), 1), Ray((-3, 0, 1), (1, 0, 0)), "decimal",
                FORMATS["binary64"])  # fmt: skip
    assert asked.isascii()
    assert asked.endswith(b"}}\n")
    assert decode(asked) == {
        "id": "7",
        "solid": {"type": "cylinder", "p": [0, 0, 0], "q": [0, 0, 2], "radius": 1},
        "ray": {"origin": [-3, 0, 1], "direction": [1, 0, 0]},
    }


ENDS = st.floats(allow_nan=False, width=32).map(lambda x: math.inf if math.isinf(x) else x)


@pytest.mark.parametrize("precision", FORMATS)
@pytest.mark.parametrize("numbers", SPELLINGS)
@QUICK
@given(pairs=st.lists(st.tuples(ENDS, ENDS)).map(tuple))
def test_a_list_survives_its_line(precision: str, numbers: Any, pairs: Any):
    hello = Hello("x", precision=precision, numbers=numbers)
    assert read_reply(reply_intervals("7", pairs, hello), hello) == Reply("7", intervals=pairs)


@pytest.mark.parametrize("numbers", SPELLINGS)
@QUICK
@given(t=st.none() | st.floats(allow_nan=False, allow_infinity=False), hit=st.booleans())
def test_a_first_hit_and_a_truth_value_survive_their_lines(numbers: Any, t: Any, hit: bool):
    hello = Hello("x", answers="first", numbers=numbers)
    assert read_reply(reply_first("7", t, hello), hello) == Reply("7", first=t)
    assert read_reply(reply_hit("7", hit), Hello("x", answers="any")) == Reply("7", hit=hit)


def test_infinity_is_read_in_three_ways():
    text = b'{"id": "7", "intervals": [[0, null], [1, "inf"], [2, Infinity]]}'
    assert read_reply(text, PLAIN).intervals == ((0, math.inf), (1, math.inf), (2, math.inf))


@pytest.mark.parametrize("numbers", ["decimal", "hex"])
def test_an_answer_is_rounded_to_the_precision(numbers: Any):
    hello = Hello("x", precision="binary32", numbers=numbers)
    text = line(id="7", intervals=[[spell(0.1, numbers), spell(1e39, numbers)]])
    assert read_reply(text, hello).intervals == ((0.10000000149011612, math.inf),)


def test_whether_a_list_is_well_formed_is_not_asked_here():
    pairs = read_reply(b'{"id": "7", "intervals": [[NaN, -1], [5, 2]]}', PLAIN).intervals
    assert pairs is not None
    assert math.isnan(pairs[0][0])
    assert pairs[1] == (5.0, 2.0)


@pytest.mark.parametrize(
    ("text", "reply"),
    [
        (line(id="7", unsupported="no caps"), Reply("7", unsupported="no caps")),
        (line(id="7", error="x" * 5000), Reply("7", error="x" * 1000 + "... (5000 characters)")),
        (line(id="7", intervals=[], took=3), Reply("7", intervals=())),
    ],
)
def test_other_replies(text: bytes, reply: Reply):
    assert read_reply(text, PLAIN) == reply


def test_first_and_any():
    first, any_ = Hello("x", answers="first"), Hello("x", answers="any")
    assert read_reply(line(id="7", first=None), first) == Reply("7", first=None)
    assert read_reply(line(id="7", first=2), first) == Reply("7", first=2.0)
    assert read_reply(line(id="7", hit=False), any_) == Reply("7", hit=False)


@pytest.mark.parametrize(
    ("text", "says", "hello"),
    [
        (b"hit", "is not JSON", PLAIN),
        (b"[" * 100_000, "is not JSON", PLAIN),
        (b'{"id": "7", "intervals": [[' + b"7" * 10**6 + b", 1]]}", "is not JSON", PLAIN),
        (b"[]", "is not a JSON object", PLAIN),
        (line(intervals=[]), "has no id", PLAIN),
        (line(id=7, intervals=[]), "has no id", PLAIN),
        (line(id="7"), "has no intervals", PLAIN),
        (line(id="7", intervals=None), "has no intervals", PLAIN),
        (line(id="7", intervals={}), "has no intervals", PLAIN),
        (line(id="7", intervals=[2, 4]), "not a pair", PLAIN),
        (line(id="7", intervals=[[2]]), "not a pair", PLAIN),
        (line(id="7", intervals=[[2, 3, 4]]), "not a pair", PLAIN),
        (line(id="7", intervals=["24"]), "not a pair", PLAIN),
        (line(id="7", intervals=[["2", 4]]), "has a bad number", PLAIN),
        (line(id="7", intervals=[[2, True]]), "has a bad number", PLAIN),
        (line(id="7", intervals=[[2, []]]), "has a bad number", PLAIN),
        (line(id="7", intervals=[[2, 4]]), "has a bad number", Hello("x", numbers="hex")),
        (line(id="7", intervals=[["z", "z"]]), "has a bad number", Hello("x", numbers="hex")),
        (line(id="7", intervals=[["0x1p9999", "0x1p0"]]), "bad number", Hello("x", numbers="hex")),
        (line(id="7", intervals=[["3ff0", "0"]]), "has a bad number", Hello("x", numbers="bits")),
        (line(id="7", intervals=[["3ff0 0000 0000  "] * 2]), "bad num", Hello("x", numbers="bits")),
        (line(id="7", unsupported=None), "reason that is not a string", PLAIN),
        (line(id="7", error={"code": 3}), "reason that is not a string", PLAIN),
        (line(id="7", intervals=[]), "has no first", Hello("x", answers="first")),
        (line(id="7", first="2"), "has a bad number", Hello("x", answers="first")),
        (line(id="7", intervals=[]), "has no hit", Hello("x", answers="any")),
        (line(id="7", hit=1), "has no hit", Hello("x", answers="any")),
    ],
)
def test_a_bad_reply_says_what_is_wrong(text: bytes, says: str, hello: Hello):
    with pytest.raises(BadLine, match=says) as caught:
        read_reply(text, hello)
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize("answers", ANSWERS)
def test_a_reply_of_another_form_is_told_the_right_one(answers: Answers):
    """The form that is told is a reply, once its words are numbers."""
    with pytest.raises(BadLine, match=f"the hello says {answers}: reply ") as caught:
        read_reply(line(id="7", distance=2), Hello("x", answers=answers))
    _, _, form = str(caught.value).partition("reply ")
    for word in ("[[enter, leave], ...]", "t or null", "true or false", "..."):
        form = form.replace(word, {"...": '"7"', "true or false": "true"}.get(word, "null"))
    form = form.replace('"intervals": null', '"intervals": []')
    assert read_reply(form.encode(), Hello("x", answers=answers)).id == "7"


@QUICK
@given(
    st.integers(800, 1000), st.sampled_from(['"intervals": ', '"intervals": [[1, ', '"error": '])
)
def test_a_deep_reply_is_never_a_traceback(depth: int, begin: str):
    end = "]]" if "[[" in begin else ""
    text = '{"id": "7", ' + begin + "[" * depth + "]" * depth + end + "}"
    with pytest.raises(BadLine):
        read_reply(text.encode(), PLAIN)


@QUICK
@given(st.binary(max_size=60))
def test_random_bytes_are_never_a_traceback(data: bytes):
    with pytest.raises(BadLine):
        read_hello(data)
    with pytest.raises(BadLine):
        read_reply(data, PLAIN)


def test_nothing_that_json_cannot_say_is_written():
    with pytest.raises(ValueError, match="JSON"):
        encode({"x": math.nan})
