"""`explain` from an id, from numbers, from JSON; and every way to get it wrong."""

import hashlib
import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from raycert.cases.case import Case, Family
from raycert.cases.formats import Format
from raycert.cases.model import Cylinder, Ray
from raycert.oracle.commands.explain import explain
from raycert.oracle.corpus.golden import write
from raycert.oracle.witness import proofs as proving
from raycert.oracle.witness.proofs import derivation

UNIT = Cylinder((0, 0, 0), (0, 0, 2), 1)
RAY = ("--ray=-3,0,1", "1,0,0")
CYLINDER = ("--cylinder", "0,0,0", "0,0,2", "1")
FORM = {
    "solid": {"type": "cylinder", "p": [0, 0, 0], "q": [0, 0, 2], "radius": 1},
    "ray": {"origin": [-3, 0, 1], "direction": [1, 0, 0]},
}


def run(*words: str, stdin: str | None = None) -> Result:
    return CliRunner().invoke(explain, words, input=stdin)


def cases(fmt: Format) -> Iterator[Case]:
    yield Case("through", "A ray crosses.", UNIT, Ray((-3, 0, 1), (1, 0, 0)), "lattice")


@pytest.fixture(scope="module")
def golden(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("golden")
    write(folder, (Family("plain", "The plain ones.", cases),), lambda _: None)
    return folder


def test_from_numbers() -> None:
    result = run(*CYLINDER, *RAY)
    assert result.exit_code == 0
    for words in (
        "w = q - p  (0, 0, 2)",
        "> through",
        "> AE",
        "> meet",
        "Answer: [2, 4]",
        "decisive for",
        "textbook",
    ):
        assert words in result.stdout
    assert max(map(len, result.stdout.splitlines())) <= 80


@pytest.mark.parametrize(
    "words",
    [
        ("--infinite-cylinder", "0,0,0", "0,0,2", "1"),
        ("--slab", "0,0,0", "0,0,2"),
        ("--half-space", "0,0,1", "0,0,1"),
        ("--sphere", "0,0,0", "1.5"),
    ],
)
def test_every_leaf_has_an_option(words: tuple[str, ...]) -> None:
    result = run(*words, *RAY)
    assert result.exit_code == 0
    assert words[0][2:].replace("-", "_") in result.stdout
    assert "Measured" in result.stdout


def test_a_ray_may_begin_with_a_minus_without_an_equals_sign() -> None:
    assert "Answer: [2, 4]" in run(*CYLINDER, "--ray", "-3,0,1", "1,0,0").stdout


def test_hex_floats_are_read() -> None:
    words = ("--cylinder", "0,0,0", "0,0,0x1p+1", "0x1.0p0")
    assert run(*words, *RAY).stdout == run(*CYLINDER, *RAY).stdout


def test_a_decimal_that_is_not_exact_is_shown_as_what_it_is() -> None:
    text = run("--cylinder", "0,0,0", "0,0,2", "0.1", *RAY).stdout
    assert "Taken as binary64 numbers" in text
    assert "solid.radius 0.1  0.100000000000000005551115  = 3602879701896397*2^-55" in text
    assert "Taken" not in run(*CYLINDER, *RAY).stdout
    tiny = run(*CYLINDER, "--ray=-3,0,1e-999", "1,0,0").stdout
    assert "ray.origin[2] 1e-999  0" in tiny
    long = run("--cylinder", "0,0,0", "0,0,2", "0x1.00000000000001p0", *RAY).stdout
    assert "solid.radius 0x1.00000000000001p0" in long


def test_binary32_rounds_to_its_own_numbers() -> None:
    result = run("--cylinder", "0,0,0", "0,0,2", "0.1", *RAY, "--precision", "binary32")
    assert "solid.radius 0.1  0.100000001490116119384766  = 13421773*2^-27" in result.stdout
    assert "radius 0.1\n" in result.stdout


def test_from_json_file_and_input(tmp_path: Path) -> None:
    path = tmp_path / "case.json"
    path.write_text(json.dumps(FORM))
    assert run("--case", str(path)).stdout == run(*CYLINDER, *RAY).stdout
    assert run("--case", "-", stdin=json.dumps(FORM)).stdout == run(*CYLINDER, *RAY).stdout


def test_from_json_in_the_other_spellings() -> None:
    one = {"type": "sphere", "center": ["0x0p+0"] * 3, "radius": "0x1p+0"}
    ray = {"origin": ["-0x1.8p+1", "0x0p+0", "0x0p+0"], "direction": ["0x1p+0"] + ["0x0p+0"] * 2}
    text = run("--case", "-", stdin=json.dumps({"solid": one, "ray": ray})).stdout
    assert "Answer: [2, 4]" in text
    bits = {"type": "sphere", "center": ["0" * 16] * 3, "radius": "3ff0000000000000"}
    aim = {
        "origin": ["c008000000000000", "0" * 16, "0" * 16],
        "direction": ["3ff0000000000000", "0" * 16, "0" * 16],
    }
    assert run("--case", "-", stdin=json.dumps({"solid": bits, "ray": aim})).stdout == text


def test_a_tree_comes_by_json() -> None:
    tree = {"type": "union", "of": [FORM["solid"], {**FORM["solid"], "radius": 2}]}
    result = run("--case", "-", stdin=json.dumps({"solid": tree, "ray": FORM["ray"]}))
    assert result.exit_code == 0
    assert "of[1] (cylinder): Problem 3" in result.stdout
    assert "of[0] or of[1]" in result.stdout


def test_from_an_id(golden: Path) -> None:
    result = run("plain/through", "--golden", str(golden))
    assert result.exit_code == 0
    assert result.stdout.startswith("plain/through\nA ray crosses.\nlattice, binary64")
    assert result.stderr == ""


def test_json_output_is_the_row_and_the_steps(golden: Path) -> None:
    result = run("plain/through", "--golden", str(golden), "--json", "-")
    form = json.loads(result.stdout)
    line = (golden / "binary64" / "plain.jsonl").read_text()
    assert form["row"] == json.loads(line)
    assert form["steps"][0]["heading"] == "Vectors"


def test_a_stale_file_is_said(golden: Path, tmp_path: Path) -> None:
    folder = tmp_path / "golden"
    shutil.copytree(golden, folder)
    path = folder / "binary64" / "plain.jsonl"
    old = path.read_bytes()
    path.write_bytes(old.replace(b'"condition":2', b'"condition":3'))
    assert path.read_bytes() != old
    form = json.loads((folder / "manifest.json").read_text())
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    form["files"]["binary64/plain.jsonl"]["sha256"] = digest
    (folder / "manifest.json").write_text(json.dumps(form))
    result = run("plain/through", "--golden", str(folder))
    assert "golden check" in result.stderr


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((), "give one case"),
        (("plain/through", *CYLINDER, *RAY), "give one case"),
        (CYLINDER, "one solid and its ray"),
        (RAY, "one solid and its ray"),
        ((*CYLINDER, "--sphere", "0,0,0", "1", *RAY), "one solid and its ray"),
        (("--cylinder", "0,0,0", "0,0,0", "1", *RAY), "solid.q: is the same point as p"),
        (("--cylinder", "0,0,0", "0,0,2", "-1", *RAY), "solid.radius: is negative"),
        (("--cylinder", "0,0", "0,0,2", "1", *RAY), "solid.p: is not three numbers"),
        (("--cylinder", "0,0,x", "0,0,2", "1", *RAY), "solid.p[2]: is not a number: 'x'; write"),
        (("--cylinder", "0,0,1/3", "0,0,2", "1", *RAY), "solid.p[2]: is not a number: '1/3'"),
        (("--cylinder", "0,0,nan", "0,0,2", "1", *RAY), "solid.p[2]: is NaN"),
        (("--cylinder", "0,0,1e999", "0,0,2", "1", *RAY), "solid.p[2]: is NaN or beyond"),
        (("--half-space", "0,0,0", "0,0,0", *RAY), "solid.normal: is zero"),
        ((*CYLINDER, "--ray", "1,2,", "1,0,0"), "ray.origin[2]: is not a number"),
        ((*CYLINDER, "--ray=1e39,0,0", "1,0,0", "--precision", "binary32"), "beyond binary32"),
        (("--case", "no-such-file"), "no-such-file"),
    ],
)
def test_bad_input_exits_2_and_says_what_to_do(words: tuple[str, ...], said: str) -> None:
    result = run(*words)
    assert result.exit_code == 2
    assert said in result.stderr
    assert "Traceback" not in result.output


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "is not JSON"),
        ("[1]", "is not a JSON object"),
        ("{}", 'solid: is missing; the form is {"solid"'),
        ('{"solid": {"type": "cone"}, "ray": {"origin": [0,0,0], "direction": [0,0,1]}}', "cone"),
        (json.dumps({**FORM, "ray": {"origin": [0, 0, 0]}}), "ray.direction: is missing"),
        (json.dumps({**FORM, "ray": 7}), "ray: is not an object"),
        (
            json.dumps(
                {**FORM, "solid": {"type": "union", "of": [FORM["solid"], {"type": "slab"}]}}
            ),
            "solid.of[1].p: is missing",
        ),
    ],
)
def test_bad_json_exits_2_and_names_the_field(text: str, said: str) -> None:
    result = run("--case", "-", stdin=text)
    assert result.exit_code == 2
    assert said in result.stderr


def test_an_unknown_id_exits_2_with_near_ones(golden: Path) -> None:
    result = run("plain/trough", "--golden", str(golden))
    assert result.exit_code == 2
    assert "did you mean plain/through" in result.stderr


@pytest.fixture(scope="module")
def proofs() -> str:
    result = run("--symbolic")
    assert result.exit_code == 0
    return result.stdout


def test_symbolic_alone_prints_every_proof(proofs: str) -> None:
    lines = proofs.splitlines()
    assert max(map(len, lines)) <= 80
    count = sum(line.endswith("  proved") for line in lines)
    assert lines[-1] == f"{count} of {count} statements proved by SymPy"
    assert count == len(derivation())
    for heading in ("Symbols", "Problem 1", "Problem 2", "Sphere", "The case tables"):
        assert lines.count(heading) == 1
    assert "    F = l^2 (t^2 (vbar.vbar) + 2 t (vbar.ybar) + ybar.ybar - r^2)" in lines


@pytest.fixture
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """Three statements are proved, none of the tables."""
    monkeypatch.setattr(proving, "PROOFS", proving.PROOFS[:3])
    monkeypatch.setattr(proving, "table_proofs", lambda: iter(()))


@pytest.mark.usefixtures("few")
def test_symbolic_comes_before_the_case() -> None:
    result = run("--symbolic", *CYLINDER, *RAY)
    assert result.stdout == f"{run('--symbolic').stdout}\n{run(*CYLINDER, *RAY).stdout}"


@pytest.mark.usefixtures("few")
def test_symbolic_as_data() -> None:
    alone = json.loads(run("--symbolic", "--json", "-").stdout)
    assert list(alone) == ["symbolic"]
    assert {"title": "1 (a) is zero at", "text": "s0 = (x - p).h", "proved": True} in alone[
        "symbolic"
    ]
    both = json.loads(run("--symbolic", "--json", "-", *CYLINDER, *RAY).stdout)
    case = json.loads(run("--json", "-", *CYLINDER, *RAY).stdout)
    assert both == alone | case


@pytest.mark.usefixtures("few")
def test_a_failed_proof_exits_1(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = (("1 (a) is zero at", "s0 = (x + p) @ h"), *proving.PROOFS[:2])
    monkeypatch.setattr(proving, "PROOFS", wrong)
    result = run("--symbolic")
    assert result.exit_code == 1
    assert "NOT PROVED\n    s0 = (x + p).h" in result.stdout
    assert "2 of 3 statements proved" in result.stdout


def test_symbolic_without_sympy_exits_3(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sympy", None)
    for name in [name for name in sys.modules if name.startswith("raycert.oracle.witness.")]:
        monkeypatch.delitem(sys.modules, name)
    result = run("--symbolic", *CYLINDER, *RAY)
    assert result.exit_code == 3
    assert result.stdout == ""
    assert result.stderr.startswith('raycert: symbols needs sympy: pip install "raycert[symbols]"')


def test_sympy_is_loaded_only_for_it() -> None:
    code = (
        "import sys; from raycert.oracle.commands.explain import explain;"
        f"explain({[*CYLINDER, *RAY]}, standalone_mode=False);"
        "print('sympy' in sys.modules)"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert result.stdout.endswith("False\n"), result.stderr
