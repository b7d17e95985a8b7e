"""What the commands on scenes share: reading one, and the reference tracer as a process.

The tracer runs in `python -m raycert.reference.arrays`: asked in JSON, it answers with arrays.
"""

from __future__ import annotations

import subprocess
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import click

from raycert.oracle.client.apart import ours
from raycert.oracle.commands.options import BadInput, stop, unknown

if TYPE_CHECKING:
    from raycert.cases.scene import Scene

COMMAND = ours("raycert.reference.arrays")
Tracer = subprocess.Popen[bytes]

scene_argument = click.argument("scene", required=False)


def read(source: str | None, size: str | None) -> tuple[Scene, str]:
    """Return the scene of a name or a file, in the size asked for, and its short name."""
    from dataclasses import replace
    from pathlib import Path

    from raycert.cases.files import BadFile
    from raycert.cases.model import Refused
    from raycert.cases.scene import load, read_size, shipped

    names = ", ".join(shipped())
    if not source:
        raise click.UsageError(f"name a scene: {names}, or a file")
    if source not in shipped() and not Path(source).exists():
        unknown("scene", source, shipped(), "and no such file")
    try:
        scene = load(source)
    except BadFile as error:
        raise BadInput(f"{error}; scenes that come along: {names}") from None
    if size:
        words = size.lower().split("x")
        if len(words) != 2 or not all(word.isdecimal() and len(word) < 9 for word in words):
            raise BadInput(f"--size: is not WxH, such as 320x240: {size!r:.40}")
        try:
            scene = replace(scene, size=read_size([int(word) for word in words], "--size"))
        except Refused as refusal:
            raise BadInput(str(refusal)) from None
    return scene, Path(source).stem


def start(scene: Scene, show: str, tracer: str, off: tuple[str, ...]) -> Tracer:
    """Start the tracer on a picture; `answer` waits for it."""
    import json

    from raycert.cases.scene import write_scene

    task = {"task": "render", "show": show, "tracer": tracer, "off": off}
    try:
        process = subprocess.Popen(COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    except OSError as error:
        stop(f"the tracer does not start: {error}")
    assert process.stdin is not None
    with suppress(BrokenPipeError):  # it ended early: `answer` says so
        process.stdin.write(json.dumps(task | {"scene": write_scene(scene)}).encode())
        process.stdin.close()
    process.stdin = None
    return process


def answer(process: Tracer) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the arrays that the tracer answers, when it is done, and what it says about them."""
    import json
    from io import BytesIO

    import numpy as np

    out, _ = process.communicate()
    if process.returncode == 2:
        raise SystemExit(2)
    if process.returncode:
        stop("the tracer failed; what it said is above")
    with np.load(BytesIO(out)) as file:
        arrays = {name: file[name] for name in file.files}
    return arrays, json.loads(str(arrays.pop("about")))
