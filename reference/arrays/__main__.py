"""`python -m reference.arrays`: a task in JSON on standard input, the answer on standard output.

    {"task": "render", "scene": {...}, "show": "depth", "tracer": "reference", "off": []}
        -> an .npz: `values`, or `enter`, `leave` and `count` for "lists"; and `about`, as JSON

The scene is as `cases.scene` writes it. A command that started it has checked what it sends.
"""

from __future__ import annotations

import json
import sys
from io import BytesIO
from time import perf_counter
from typing import Any

import numpy as np

from raycert.cases.scene import read_scene
from raycert.reference.arrays.picture import lists, picture
from raycert.reference.arrays.plan import ITEMS, plan


def render(task: dict[str, Any]) -> bytes:
    """Return the arrays of a picture, and what the plan left out."""
    began = perf_counter()
    show, off = task["show"], frozenset(task.get("off", ()))
    if unknown := off - set(ITEMS):
        print(f"no item {', '.join(sorted(unknown))}; items: {', '.join(ITEMS)}", file=sys.stderr)
        raise SystemExit(2)
    ready = plan(read_scene(task["scene"]), show, off, task.get("tracer", "reference"))
    if show == "lists":
        pairs = lists(ready)
        arrays = {"enter": pairs.enter, "leave": pairs.leave, "count": pairs.count}
        hits = int(np.count_nonzero(pairs.count))
    else:
        values, hits = picture(ready, show)
        arrays = {"values": values}
    left_out = [name for name in ITEMS if name in ready.on]
    about = {"hits": hits, "seconds": perf_counter() - began, "left_out": left_out}
    file = BytesIO()
    np.savez(file, allow_pickle=False, **arrays, about=np.array(json.dumps(about)))
    return file.getvalue()


def main() -> None:
    task = json.load(sys.stdin)
    assert task["task"] == "render"
    sys.stdout.buffer.write(render(task))


if __name__ == "__main__":
    main()
