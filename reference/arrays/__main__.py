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

from raycert.cases.scene import Scene, read_scene
from raycert.reference.arrays.picture import lists, picture
from raycert.reference.arrays.plan import ITEMS, Plan, plan


def render(scene: Scene, task: dict[str, Any]) -> bytes:
    """Return the arrays of a picture, and what the plan left out."""
    began = perf_counter()
    show, off = task["show"], frozenset(task.get("off", ()))
    if unknown := off - set(ITEMS):
        print(f"no item {', '.join(sorted(unknown))}; items: {', '.join(ITEMS)}", file=sys.stderr)
        raise SystemExit(2)
    made = plan(scene, show, off, task.get("tracer", "reference"))
    arrays: dict[str, np.ndarray[Any, Any]]
    if show == "lists":
        found = lists(made)
        arrays = {"enter": found.enter, "leave": found.leave, "count": found.count}
        hits = int(np.count_nonzero(found.count))
    else:
        seen = picture(made, show)
        arrays, hits = {"values": seen.values}, seen.hits
    about = {"hits": hits, "seconds": perf_counter() - began, "left_out": _left_out(made)}
    return _packed(arrays | {"about": np.array(json.dumps(about))})


def _left_out(made: Plan) -> list[str]:
    return [item.name for item in made.items if item.name in made.on]


def _packed(arrays: dict[str, np.ndarray[Any, Any]]) -> bytes:
    file = BytesIO()
    np.savez(file, allow_pickle=False, **arrays)
    return file.getvalue()


def main() -> None:
    """Do the task on standard input."""
    task = json.load(sys.stdin)
    assert task["task"] == "render"
    sys.stdout.buffer.write(render(read_scene(task["scene"]), task))


if __name__ == "__main__":
    main()
