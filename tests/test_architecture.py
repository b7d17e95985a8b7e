"""The layout as rules a machine can check: imports point down, modules are small and say why."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from raycert import cases, oracle, reference

PACKAGES = {"cases": cases, "oracle": oracle, "reference": reference}
MAY_IMPORT = {
    "cases": {"cases"},
    "oracle": {"cases", "oracle"},
    "reference": {"cases", "reference"},
}
HEAVY = {
    "numpy",
    "numba",
    "sympy",
    "trimesh",
    "manifold3d",
    "scipy",
    "matplotlib",
    "mpmath",
    "flint",
    "PIL",
    "jinja2",
    "junitparser",
    "pytest",
    "dask",
    "distributed",
}
MAY_LOAD = (
    "oracle/witness/",
    "oracle/batch/",
    "oracle/measure/",
    "oracle/plots/",
    "reference/arrays/",
)
"""The packages that exist to use a heavy one: their modules may load it at their top."""
NAMED = ("oracle/commands/pytest_plugin.py",)
"""Modules that nobody but the program that they plug into imports."""
LONGEST_MODULE, LONGEST_FUNCTION = 300, 40


@dataclass(frozen=True)
class Source:
    """A module: its path from the root, `oracle/trace.py`, and its text."""

    path: str
    text: str

    @property
    def package(self) -> str:
        return self.path.partition("/")[0]

    @property
    def tree(self) -> ast.Module:
        return ast.parse(self.text, self.path)


def sources() -> list[Source]:
    roots = {name: Path(str(package.__file__)).parent for name, package in PACKAGES.items()}
    return [
        Source(f"{name}/{path.relative_to(root)}", path.read_text())
        for name, root in roots.items()
        for path in sorted(root.rglob("*.py"))
    ]


SOURCES = sources()
each = pytest.mark.parametrize("source", SOURCES, ids=lambda source: source.path)


def imported(node: ast.AST) -> Iterator[str]:
    """Yield the top names that an import statement names."""
    if isinstance(node, ast.Import):
        yield from (alias.name.removeprefix("raycert.").partition(".")[0] for alias in node.names)
    elif isinstance(node, ast.ImportFrom):
        yield (
            (node.module or "").removeprefix("raycert.").partition(".")[0]
            if not node.level
            else "."
        )


def wrong_directions(source: Source) -> list[str]:
    """Return what a module imports against the direction: also in functions and for types."""
    allowed = MAY_IMPORT[source.package]
    return [
        f"{source.path}:{node.lineno}: imports {name}"  # type: ignore[attr-defined]
        for node in ast.walk(source.tree)
        for name in imported(node)
        if name == "." or (name in (*PACKAGES, "tests") and name not in allowed)
    ]


def at_top(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield the statements that run on import: all that is in no function."""
    for node in ast.iter_child_nodes(tree):
        yield node
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            yield from at_top(node)


def heavy_on_import(source: Source) -> list[str]:
    """Return the heavy packages that importing a module loads, where it is not made for that."""
    if source.path.startswith(MAY_LOAD) or source.path in NAMED:
        return []
    return [
        f"{source.path}:{node.lineno}: loads {name}"  # type: ignore[attr-defined]
        for node in at_top(source.tree)
        for name in imported(node)
        if name in HEAVY
    ]


def heavy_in_the_plain_packages(source: Source) -> list[str]:
    """Return heavy packages that `cases` or `reference` load anywhere, lazily or not."""
    if source.package == "oracle" or source.path.startswith(MAY_LOAD):
        return []
    names = (name for node in ast.walk(source.tree) for name in imported(node))
    return [f"{source.path}: loads {name}" for name in names if name in HEAVY]


def too_long(source: Source) -> list[str]:
    """Return the module if it is too long, and its functions that are; decorators do not count."""
    lines = source.text.count("\n")
    found = [f"{source.path}: {lines} lines"] if lines > LONGEST_MODULE else []
    for node in ast.walk(source.tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            length = (node.end_lineno or 0) - node.lineno + 1
            if length > LONGEST_FUNCTION:
                found.append(f"{source.path}:{node.lineno}: {node.name} has {length} lines")
    return found


def without_docstring(source: Source) -> list[str]:
    return [] if ast.get_docstring(source.tree) else [f"{source.path}: has no docstring"]


RULES = (
    wrong_directions,
    heavy_on_import,
    heavy_in_the_plain_packages,
    too_long,
    without_docstring,
)


@each
@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.__name__)
def test_a_module_keeps_the_rule(source: Source, rule: object) -> None:
    assert rule(source) == []  # type: ignore[operator]


def test_all_three_packages_are_seen() -> None:
    for name in PACKAGES:
        assert sum(source.package == name for source in SOURCES) >= 3
    assert len(SOURCES) > 40


def loaded_by(modules: list[str]) -> set[str]:
    """Return the heavy packages that a new interpreter holds once it has imported the modules."""
    code = f"import sys\nfor name in {modules!r}: __import__(name)\nprint(*sys.modules)"
    run = [sys.executable, "-W", "error", "-c", code]
    root = str(Path(str(cases.__file__)).parent.parent)
    env = os.environ | {"PYTHONPATH": root}
    return set(subprocess.check_output(run, text=True, env=env).split()) & HEAVY


def test_nothing_but_what_is_made_for_it_loads_a_heavy_package() -> None:
    """Over all imports of imports: what the rule on single modules cannot see."""
    modules = [
        "raycert." + source.path.removesuffix(".py").removesuffix("/__init__").replace("/", ".")
        for source in SOURCES
        if not source.path.startswith(MAY_LOAD)
        and source.path not in NAMED
        and not source.path.endswith("__main__.py")
    ]
    assert loaded_by(modules) == set()
    assert loaded_by(["raycert.oracle.witness.enclosure"]) == {"mpmath"}


LONG = "def f():\n" + "    pass\n" * LONGEST_FUNCTION
PLANTED = [
    (wrong_directions, "reference/x.py", "from oracle.trace import trace"),
    (wrong_directions, "oracle/x.py", "from reference import tracer"),
    (wrong_directions, "oracle/x.py", "import reference.tracer as t"),
    (wrong_directions, "cases/families/x.py", "import oracle"),
    (wrong_directions, "cases/x.py", "from reference.tracer import intersect"),
    (wrong_directions, "oracle/x.py", "from .trace import trace"),
    (wrong_directions, "oracle/x.py", "from . import trace"),
    (wrong_directions, "reference/x.py", "def f():\n    from oracle import surd"),
    (wrong_directions, "cases/x.py", "if TYPE_CHECKING:\n    from oracle.surd import Surd"),
    (heavy_on_import, "oracle/x.py", "import numpy as np"),
    (heavy_on_import, "oracle/commands/x.py", "from sympy import sqrt"),
    (
        heavy_on_import,
        "oracle/x.py",
        "try:\n    import mpmath.libmp\nexcept ImportError:\n    pass",
    ),
    (heavy_on_import, "cases/x.py", "class C:\n    import trimesh"),
    (heavy_in_the_plain_packages, "cases/x.py", "def f():\n    import sympy"),
    (heavy_in_the_plain_packages, "reference/x.py", "def f():\n    import numpy"),
    (too_long, "oracle/x.py", "pass\n" * (LONGEST_MODULE + 1)),
    (too_long, "oracle/x.py", LONG),
    (too_long, "oracle/x.py", "class C:\n    " + LONG.replace("\n", "\n    ").rstrip()),
    (without_docstring, "oracle/x.py", "x = 1"),
]


@pytest.mark.parametrize(("rule", "path", "text"), PLANTED)
def test_a_planted_fault_is_noticed(rule: object, path: str, text: str) -> None:
    assert len(rule(Source(path, text))) == 1  # type: ignore[operator]


@pytest.mark.parametrize(
    ("rule", "path", "text"),
    [
        (wrong_directions, "oracle/x.py", "from cases.model import Ray\nimport math"),
        (heavy_on_import, "oracle/x.py", "def f():\n    import sympy"),
        (heavy_on_import, "oracle/witness/x.py", "import sympy"),
        (too_long, "oracle/x.py", "def f():\n" + "    pass\n" * (LONGEST_FUNCTION - 1)),
    ],
)
def test_what_is_allowed_is_not_noticed(rule: object, path: str, text: str) -> None:
    assert rule(Source(path, text)) == []  # type: ignore[operator]
