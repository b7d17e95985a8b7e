"""One language over all verbs: a thing has one word, the help of each verb ends alike, its examples
can be typed, and of a name that there is not one is told which was meant."""

from __future__ import annotations

import ast
import re
import shlex
from collections import defaultdict
from collections.abc import Iterator
from importlib.metadata import requires
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from raycert.cases.hints import DISTRIBUTIONS, lacking, near
from raycert.oracle.commands.main import FORMER, PLACES, load, main
from raycert.oracle.commands.options import FILE_OR_DASH, TARGETS
from shared.small_corpus import write_small

ROOT = Path(__file__).parents[2]


def leaves() -> Iterator[tuple[str, click.Command]]:
    for verb, place in PLACES.items():
        command = load(place)
        if isinstance(command, click.Group):
            yield from ((f"{verb} {name}", one) for name, one in command.commands.items())
        else:
            yield verb, command


LEAVES = dict(leaves())


def texts(command: click.Command) -> str:
    return f"{command.help or ''}\n{command.epilog or ''}"


def examples() -> Iterator[tuple[str, list[str]]]:
    """Yield each call of raycert in an example, as its line and its words."""
    for verb, command in LEAVES.items():
        block = texts(command).partition("Examples:\n")[2].partition("\n\n")[0]
        for line in block.replace("\\\n", " ").splitlines():
            bare = re.split(r" <<< |(?<=\S) {3,}|  # ", re.sub(r"(?<=\S) {2,}(?=-)", " ", line))[0]
            for part in bare.split(" | ") if not line.startswith("     ") else ():
                if part.strip().startswith("raycert "):
                    yield f"{verb}: {part.strip()}", shlex.split(part)[1:]


EXAMPLES = dict(examples())


@pytest.mark.parametrize("verb", sorted(LEAVES))
def test_help_has_an_example_and_ends_with_the_exit_statuses(verb: str) -> None:
    said = CliRunner().invoke(main, [*verb.split(), "--help"]).output
    assert "  Examples:\n" in said
    assert any(key.startswith(f"{verb}: ") for key in EXAMPLES) or verb == "serve"
    last = " ".join(said.split("\n\n")[-1].split())
    assert re.fullmatch(r"Exit status: 0 .+; 2 bad usage or input.*; 4 .+\.", last)


@pytest.mark.parametrize("line", EXAMPLES)
def test_an_example_can_be_typed(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every word is an option or a value that it takes; files need not be there."""
    verb, *words = EXAMPLES[line]
    command = load(PLACES[verb])
    if isinstance(command, click.Group):
        command, words = command.commands[words[0]], words[1:]
    for param in command.params:
        if isinstance(param.type, click.Path):
            monkeypatch.setattr(param.type, "exists", False)
        if isinstance(param.type, click.File):
            monkeypatch.setattr(param.type, "convert", lambda value, *_: value)
    command.make_context(verb, words)


def test_an_example_that_cannot_be_typed_would_be_noticed() -> None:
    with pytest.raises(click.UsageError):
        load(PLACES["certify"]).make_context("certify", ["--client", "x", "reference"])


def by_name() -> dict[str, list[tuple[str, click.Option]]]:
    found = defaultdict(list)
    for verb, command in LEAVES.items():
        for param in command.params:
            if isinstance(param, click.Option):
                for name in param.opts:
                    found[name].append((verb, param))
    return found


SHARED = {name: some for name, some in by_name().items() if len(some) > 1}
PLACE_OR_FOLDER = {"--out", "-o"}
"""What a verb makes is a file or a folder; so is what it is called."""


NARROWER = {"--method", "--show", "--corpus", "--golden"}
"""Not every verb takes all of them: a picture is of a scene or around a case, a corpus is made."""


def form(option: click.Option) -> tuple[object, ...]:
    chosen = isinstance(option.type, click.Choice)
    kind = tuple(option.type.choices) if chosen else type(option.type)
    return kind, option.is_flag, option.nargs, option.metavar


@pytest.mark.parametrize("name", sorted(SHARED))
def test_an_option_takes_the_same_in_every_verb(name: str) -> None:
    forms = {form(option): verb for verb, option in SHARED[name]}
    if name in PLACE_OR_FOLDER:
        assert {metavar for *_, metavar in forms} <= {"FILE", "DIR"}
    elif name in NARROWER:
        assert {some[1:3] for some in forms} == {(False, 1)}
    else:
        assert len(forms) == 1, forms


@pytest.mark.parametrize("name", ["--out", "--family", "--solid", "--tier", "--target", "--json"])
def test_what_many_verbs_take_is_shared(name: str) -> None:
    assert len(SHARED[name]) > 2


def test_json_goes_to_a_file_or_standard_output() -> None:
    for verb, option in SHARED["--json"]:
        assert option.type is FILE_OR_DASH, verb


def test_who_takes_a_target_says_how_it_is_named() -> None:
    for verb, command in LEAVES.items():
        takes = any(param.name == "target" or "--target" in param.opts for param in command.params)
        assert takes == (TARGETS in texts(command)), verb


ROW = "plain/tangent"
SMALL = ("certify", "list", "export", "explain", "show", "crosscheck")
"""Verbs that are asked of a small corpus, for time."""
CASE = ("--sphere", "0,0,0", "1", "--ray", "-3,0,0", "1,0,0")
MISTYPED = {
    ("certfy",): "certify",
    ("golden", "chekc"): "check",
    ("certify", "--level", "stabel", "oracle"): "stable",
    ("certify", "--family", "plane", "oracle"): "plain",
    ("certify", "--id", f"{ROW}s", "oracle"): ROW,
    ("certify", "--solid", "cilinder", "oracle"): "cylinder",
    ("certify", "--tier", "latice", "oracle"): "lattice",
    ("list", "--family", "plane"): "plain",
    ("list", "--solid", "cilinder"): "cylinder",
    ("list", "--flag", "tangemt"): "tangent",
    ("export", "--declared", "cilinder"): "cylinder",
    ("explain", f"{ROW}s"): ROW,
    ("show", f"{ROW}s"): ROW,
    ("explain", *CASE, "--precision", "binary46"): "binary64",
    ("hunt", "--solid", "spere", "oracle"): "sphere",
    ("zoo", "--fault", "no-clipp"): "no-clip",
    ("bench", "--section", "method"): "methods",
    ("bench", "--method", "textbok"): "textbook",
    ("bench", "--scenario", "fra"): "far",
    ("stress", "--sweep", "farr"): "far",
    ("crosscheck", "--witness", "definitions"): "definition",
    ("crosscheck", "--witness", "definition", "--family", "plane"): "plain",
    ("render", "dye"): "die",
    ("plan", "dei"): "die",
    ("serve", "orcale"): "oracle",
}


@pytest.fixture(scope="module")
def golden(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_small(tmp_path_factory.mktemp("golden"))


@pytest.mark.parametrize("words", MISTYPED, ids=" ".join)
def test_a_name_that_there_is_not_is_met_with_the_one_meant(
    words: tuple[str, ...], golden: Path
) -> None:
    small = ("--golden", str(golden)) if words[0] in SMALL else ()
    result = CliRunner().invoke(main, [words[0], *small, *words[1:]])
    said = " ".join(result.output.split())
    assert result.exit_code == 2, said
    assert re.search(rf"did you mean ([\w/-]+ or )*{MISTYPED[words]}( or [\w/-]+)*\?", said), said


@pytest.mark.parametrize("former", FORMER)
def test_a_former_word_says_what_to_type(former: str) -> None:
    verb, *words = former.split()
    result = CliRunner().invoke(main, [verb, *words])
    assert result.exit_code == 2
    assert FORMER[former] in " ".join(result.output.split())


def test_near_names_few_and_nothing_for_what_is_far() -> None:
    assert near("cilinder", ["cylinder", "sphere"]) == "did you mean cylinder?"
    assert near("rim", [f"rim-{i}" for i in range(9)]).count(" or ") == 2
    assert near("xyzzy", ["cylinder"]) == near("", ["a"]) == ""


def wanted() -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """Yield where a package of an extra is asked for: the place, the extra, the modules."""
    for path in [*ROOT.glob("oracle/**/*.py"), *ROOT.glob("cases/**/*.py")]:
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Call) and ast.unparse(node.func) in ("lacking", "needs"):
                _, *rest = node.args
                words = [word.value for word in rest if isinstance(word, ast.Constant)]
                if words:
                    yield f"{path.name}:{node.lineno}", str(words[0]), tuple(map(str, words[1:]))


def test_a_missing_package_is_one_of_the_extra_that_is_named() -> None:
    places = list(wanted())
    assert len(places) >= 7
    for place, extra, modules in places:
        own = [text for text in requires("raycert") or () if f'extra == "{extra}"' in text]
        for module in modules:
            name = DISTRIBUTIONS.get(module, module)
            assert any(text.startswith(name) for text in own), (place, extra, name)


def test_what_is_lacking_is_said_for_every_way_to_run() -> None:
    said = lacking("render", "plots", "numpy", "PIL")
    assert said == (
        'render needs numpy, pillow: pip install "raycert[plots]" '
        "(uvx: uvx --with numpy --with pillow ...; pipx: pipx inject raycert numpy pillow)"
    )


def test_no_other_place_says_what_to_install() -> None:
    own = {ROOT / "cases" / "hints.py"}
    for path in {*ROOT.glob("oracle/**/*.py"), *ROOT.glob("cases/**/*.py")} - own:
        code = [line for line in path.read_text().splitlines() if "pip install" in line]
        assert not [line for line in code if "raycert[" in line and "They need" not in line], path


@pytest.mark.parametrize(
    ("word", "words"),
    [
        ("reference", ("reference",)),
        ("./a --fast", ("./a", "--fast")),
        ("'my tracer' -q", ("my tracer", "-q")),
        ("m:f", ("m:f",)),
    ],
)
def test_a_target_in_one_word_is_the_same_as_argument_and_option(
    word: str, words: tuple[str, ...]
) -> None:
    argument = load(PLACES["certify"]).make_context("certify", [word])
    option = load(PLACES["map"]).make_context(
        "map", [ROW, "--x", "a", "--y", "b", "-o", "x.csv", "--target", word]
    )
    assert argument.params["target"] == option.params["target"] == words


def test_a_file_with_blanks_is_one_word(tmp_path: Path) -> None:
    for name, word in (("my tracer", "my tracer"), ("my tracer.py", "my tracer.py:intersect")):
        (tmp_path / name).touch()
        found = load(PLACES["certify"]).make_context("certify", [str(tmp_path / word)])
        assert found.params["target"] == (str(tmp_path / word),)
