"""What the commands on scenes share: reading one, and the reference tracer as a process.

The tracer runs in `python -m reference.arrays`: it is asked in JSON and answers with arrays.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

import click

from raycert.oracle.commands.options import BadInput

if TYPE_CHECKING:
    from raycert.cases.scene import Scene

Decorated = TypeVar("Decorated", bound=Callable[..., Any])
COMMAND = ("-m", "raycert.reference.arrays")


@dataclass(frozen=True, slots=True)
class Asked:
    """What is to be shown, by which tracer, and which items of the plan stay off."""

    show: str
    tracer: str = "reference"
    off: tuple[str, ...] = ()


def needs(*packages: str) -> None:
    """Stop, and say what to install, if a package is missing: exit 3."""
    from importlib.util import find_spec

    if missing := [name for name in packages if find_spec(name) is None]:
        click.echo(f'raycert: {", ".join(missing)} missing: pip install "raycert[plots]"', err=True)
        raise SystemExit(3)


def scene_argument(command: Decorated) -> Decorated:
    """Add the argument that names a scene."""
    return click.argument("scene", required=False)(command)


def read(source: str | None, size: str | None) -> tuple[Scene, str]:
    """Return the scene of a name or a file, in the size asked for, and its short name."""
    from dataclasses import replace
    from pathlib import Path

    from raycert.cases.model import Refused
    from raycert.cases.scene import load, read_size, shipped

    if not source:
        raise click.UsageError(f"name a scene: {', '.join(shipped())}, or a file")
    try:
        scene = load(source)
    except Refused as refusal:
        raise BadInput(f"{source}: {refusal}") from None
    except OSError as error:
        names = ", ".join(shipped())
        raise BadInput(f"{source}: {error.strerror}; scenes that come along: {names}") from None
    if size:
        words = size.lower().split("x")
        if len(words) != 2 or not all(word.isdecimal() for word in words):
            raise BadInput(f"--size: is not WxH, such as 320x240: {size!r:.40}")
        try:
            scene = replace(scene, size=read_size([int(word) for word in words], "--size"))
        except Refused as refusal:
            raise BadInput(str(refusal)) from None
    return scene, Path(source).stem


def table() -> None:
    """Print the scenes that come with raycert, and what each shows."""
    from rich.console import Console
    from rich.table import Table

    from raycert.cases.scene import load, shipped

    grid = Table(box=None, pad_edge=False, show_header=False)
    grid.add_column(no_wrap=True)
    for name in shipped():
        grid.add_row(name, load(name).about)
    Console().print(grid)


@dataclass
class Started:
    """The tracer at work on a task; `about` is what it told with its arrays."""

    process: subprocess.Popen[bytes]
    about: dict[str, Any] = field(default_factory=dict)

    def output(self) -> bytes:
        """Return what it answered, when it is done."""
        out, _ = self.process.communicate()
        if self.process.returncode == 2:
            raise SystemExit(2)
        if self.process.returncode:
            click.echo("raycert: the tracer failed; what it said is above", err=True)
            raise SystemExit(3)
        return out

    def arrays(self) -> dict[str, Any]:
        """Return the arrays that it answered, when it is done."""
        import json
        from io import BytesIO

        import numpy as np

        with np.load(BytesIO(self.output())) as file:
            found = {name: file[name] for name in file.files}
        self.about.update(json.loads(str(found.pop("about"))))
        return found


def ask(task: dict[str, Any]) -> Started:
    """Start the tracer on a task; the answer is waited for where it is used."""
    import json

    try:
        process = subprocess.Popen(
            [sys.executable, *COMMAND], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
    except OSError as error:
        click.echo(f"raycert: the tracer does not start: {error}", err=True)
        raise SystemExit(3) from None
    assert process.stdin is not None
    with suppress(BrokenPipeError):  # it ended early: `output` says so
        process.stdin.write(json.dumps(task).encode())
        process.stdin.close()
    process.stdin = None
    return Started(process)


def start(scene: Scene, asked: Asked) -> Started:
    """Start the tracer on a picture."""
    from raycert.cases.scene import write_scene

    show = "lists" if asked.show == "error" else asked.show
    task = {"task": "render", "show": show, "tracer": asked.tracer, "off": list(asked.off)}
    return ask(task | {"scene": write_scene(scene)})
