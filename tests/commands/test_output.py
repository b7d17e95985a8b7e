"""Outputs: tried before the work, and what fails after it loses nothing that was found."""

import json
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import click
import pytest
from click.testing import CliRunner, Result

import shared.certificates as made_up
from raycert.cases.corpus import append_whole, write_whole
from raycert.oracle.commands.main import PLACES, load, main
from raycert.oracle.commands.options import Output

RAY = ("--sphere", "0,0,0", "1", "--ray=-3,0,0", "1,0,0")
MAP = ("map", *RAY, "--x", "ray.origin[1]", "--y", "solid.radius", "--cells", "2")
WRITES = {
    "certify": (("certify", "--id", "behind/across-just-past", "oracle"), "--out", "x.json"),
    "expectations": (
        ("certify", "--id", "behind/across-just-past", "oracle"),
        "--write-expectations",
        "x.toml",
    ),
    "html": (("report", "CERTIFICATE"), "--html", "x.html"),
    "markdown": (("report", "CERTIFICATE"), "--markdown", "x.md"),
    "junit": (("report", "CERTIFICATE"), "--junit", "x.xml"),
    "explain": (("explain", *RAY), "--html", "x.html"),
    "export": (("export", "--family", "behind"), "--out", "x.tsv"),
    "map": (MAP, "--out", "x.csv"),
    "picture": (MAP, "--out", "x.png"),
    "zoo": (("zoo", "--fault", "no-clip"), "--json", "x.json"),
    "render": (("render", "die", "--size", "8x8"), "--out", "x.png"),
}
"""A call of each verb that writes a file, the option that names it, and a good name."""
CHEAP = ("junit", "map")


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "certificate.in").write_text(json.dumps(made_up.bad()))
    return tmp_path


def run(words: tuple[str, ...], *more: str) -> Result:
    words = tuple("certificate.in" if word == "CERTIFICATE" else word for word in words)
    if words[0] == "certify" and not any(word.startswith("--out") for word in more):
        more = (*more, "--out=c")
    return CliRunner().invoke(main, [words[0], *more, *words[1:]])


def parameters() -> Iterator[tuple[str, click.Parameter]]:
    commands = {verb: load(place) for verb, place in PLACES.items()}
    while commands:
        verb, command = commands.popitem()
        if isinstance(command, click.Group):
            commands |= {f"{verb} {name}": one for name, one in command.commands.items()}
        yield from ((verb, parameter) for parameter in command.params)


def test_every_file_of_every_verb_is_there_already_or_tried_before_the_work() -> None:
    """A folder of golden files is the argument of `check` and `write` alike: tried by `write`."""
    wrong = [
        (verb, parameter.name)
        for verb, parameter in parameters()
        if isinstance(parameter.type, click.Path)
        if not (parameter.type.exists or isinstance(parameter.type, Output))
    ]
    assert sorted(wrong) == [("golden check", "folder"), ("golden write", "folder")]


@pytest.mark.parametrize("name", WRITES)
def test_a_name_that_cannot_be_written_is_refused_before_the_work(name: str, here: Path) -> None:
    words, option, _ = WRITES[name]
    before = sorted(here.iterdir())
    suffix = Path(WRITES[name][2]).suffix
    bad = ["", ".", "x" * 300 + suffix, f"certificate.in/y{suffix}", "no/" + "x" * 300 + suffix]
    for out in bad:
        result = run(words, f"{option}={out}")
        assert result.exit_code == 2, (out, result.output)
        assert "Traceback" not in result.output
        assert option in result.output
    assert sorted(here.iterdir()) == before


@pytest.mark.parametrize("name", ["certify", "expectations", "junit", "explain", "picture"])
def test_a_full_disk_loses_only_what_was_to_go_there(name: str, here: Path) -> None:
    words, option, file = WRITES[name]
    (here / file).symlink_to("/dev/full")
    result = run(words, f"{option}={file}")
    assert result.exit_code == 4, result.output
    last = f"raycert: not written: {file}: No space left on device"
    assert result.output.splitlines()[-1] == last
    assert (here / file).is_symlink()
    assert "oracle passes sound" in result.output or words[0] != "certify"


def test_one_output_that_fails_keeps_none_of_the_others_from_being_written(here: Path) -> None:
    words = ("certify", "--id", "behind/across-just-past", "oracle")
    for name in ("full.md", "full.json"):
        (here / name).symlink_to("/dev/full")
    outs = ("--markdown=full.md", "--html=x.html", "--junit=deep/x.xml", "--out=full.json")
    result = run(words, *outs)
    assert result.exit_code == 4
    lines = result.output.splitlines()
    said = "raycert: not written: {}: No space left on device"
    assert lines[-2:] == [said.format("full.json"), said.format("full.md")]
    assert lines[-3] == "certificate: x.html deep/x.xml"
    assert "raycert oracle passes sound" in result.output
    assert (here / "x.html").stat().st_size > 1000
    assert (here / "deep" / "x.xml").stat().st_size > 100


def test_a_full_standard_output_loses_no_file(here: Path) -> None:
    code = "from raycert.oracle.commands.main import main; main()"
    words = ("certify", "--id", "behind/across-just-past", "--out=x.json", "oracle")
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-c", code, *words], stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert done.returncode == 4
    assert done.stderr.endswith("raycert: not written: standard output: No space left on device\n")
    assert "Traceback" not in done.stderr
    assert json.loads((here / "x.json").read_text())["tested"] == 1


@pytest.mark.parametrize("name", CHEAP)
def test_outputs_go_through_what_is_no_regular_file_and_keep_the_mode(
    name: str, here: Path
) -> None:
    words, option, file = WRITES[name]
    out = here / file
    assert run(words, f"{option}={file}").exit_code == 0
    wanted = out.read_bytes()
    out.write_bytes(b"")
    out.chmod(0o600)
    assert run(words, f"{option}={file}").exit_code == 0
    assert (out.read_bytes(), out.stat().st_mode & 0o777) == (wanted, 0o600)
    os.rename(out, here / "target")
    (here / "target").write_bytes(b"")
    out.symlink_to("target")
    assert run(words, f"{option}={file}").exit_code == 0
    assert (out.is_symlink(), (here / "target").read_bytes()) == (True, wanted)
    out.unlink()
    os.mkfifo(out)
    read: list[bytes] = []
    reader = threading.Thread(target=lambda: read.append(out.read_bytes()))
    reader.start()
    assert run(words, f"{option}={file}").exit_code == 0
    reader.join(10)
    assert (out.is_fifo(), read) == (True, [wanted])


@pytest.mark.parametrize("began", ["", "# Job", "# Job\n", "# Job\n\n"])
def test_markdown_is_added_to_what_others_have_begun(began: str, here: Path) -> None:
    (here / "x.md").write_text(began)
    words, option, _ = WRITES["markdown"]
    alone = run(words, "--markdown=-").output
    assert run(words, f"{option}=x.md").exit_code == 0
    assert (here / "x.md").read_text() == ("# Job\n\n" if began else "") + alone


def test_what_is_added_is_there_whole_or_not_at_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import resource
    import signal

    path = tmp_path / "x.md"
    path.write_text("# Job\n")
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, limit[1]))
    try:
        for write in (append_whole, write_whole):
            with pytest.raises(OSError, match="large"):
                write(path, b"x" * 1000)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
        signal.signal(signal.SIGXFSZ, before)
    assert path.read_text() == "# Job\n"
    assert list(tmp_path.iterdir()) == [path]


def test_a_new_file_has_the_mode_that_the_user_gives_files(tmp_path: Path) -> None:
    before = os.umask(0o077)
    try:
        write_whole(tmp_path / ("x" * 255), b"")
    finally:
        os.umask(before)
    assert (tmp_path / ("x" * 255)).stat().st_mode & 0o777 == 0o600
