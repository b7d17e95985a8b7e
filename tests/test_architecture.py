"""The layout as rules that a machine can check; each is shown to catch a planted violation."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import raycert
from raycert import cases, oracle, reference

CHAPTERS = (
    "exact", "judge", "batch", "witness", "corpus", "client", "zoo", "certify",
    "reports", "explain", "hunt", "map", "measure", "plots", "commands",
)  # fmt: skip
"""From the ground up: a chapter imports only those before it."""
DATA = ("schemas", "starters", "face")
"""Rooms that are no chapter: files to ship, and the face, which imports whatever it shows."""
ALONE = {"exact": {"exact"}, "judge": {"exact", "judge"}}
"""Chapters that stand on even less than the order allows."""
PACKAGES = {"cases": cases, "oracle": oracle, "reference": reference}
MAY_IMPORT = {
    "cases": {"cases"},
    "oracle": {"cases", "oracle"},
    "reference": {"cases", "reference"},
}
HEAVY = {
    "numpy", "numba", "sympy", "trimesh", "manifold3d", "scipy", "matplotlib", "mpmath", "flint",
    "PIL", "jinja2", "junitparser", "fastjsonschema", "pytest", "dask", "distributed", "hypothesis",
}  # fmt: skip
MAY_LOAD = (
    "oracle/witness/",
    "oracle/batch/",
    "oracle/measure/",
    "oracle/plots/",
    "reference/arrays/",
)
"""Rooms that exist to use a heavy package: their modules may load it at their top."""
PLUGGED = ("oracle/commands/pytest_plugin.py", "cases/strategies.py")
"""Modules that only the program that they plug into imports."""
LONGEST_MODULE, LONGEST_FUNCTION, ROOMS = 600, 40, 20


@dataclass(frozen=True)
class Source:
    """A module: its path from the root, `oracle/exact/trace.py`, and its text."""

    path: str
    text: str

    @property
    def package(self) -> str:
        return "face" if self.path.startswith("oracle/face/") else self.path.partition("/")[0]

    @property
    def chapter(self) -> str:
        """The room of oracle that the module lies in, or nothing."""
        parts = self.path.split("/")
        return parts[1] if parts[0] == "oracle" and len(parts) > 2 else ""

    @property
    def name(self) -> str:
        """The name that the module is imported by."""
        path = self.path.removesuffix(".py").removesuffix("/__init__")
        name = "raycert." + path.replace("/", ".")
        return name.replace("raycert.oracle.face", "raycert")

    @property
    def lines(self) -> int:
        return self.text.count("\n")

    @cached_property
    def tree(self) -> ast.Module:
        return ast.parse(self.text, self.path)


def sources() -> list[Source]:
    roots = {name: Path(str(package.__file__)).parent for name, package in PACKAGES.items()}
    roots["oracle/face"] = Path(str(raycert.__file__)).parent
    found = {
        f"{name}/{path.relative_to(root)}": path
        for name, root in roots.items()
        for path in root.rglob("*.py")
        if name != "oracle/face" or path.parent == root
    }
    return [Source(name, path.read_text()) for name, path in sorted(found.items())]


SOURCES = sources()
Rule = Callable[[Iterable[Source]], list[str]]


def imports(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """Yield line and full name of what the import statements of a tree name."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = "." * node.level + (node.module or "")
            yield from ((node.lineno, f"{module}.{alias.name}") for alias in node.names)


def ours(name: str) -> list[str]:
    """Return the parts of an imported name of ours, from `cases`, `oracle` or `reference` on."""
    parts = name.split(".")
    return parts[1:] if parts[0] == "raycert" else []


def wrong_directions(every: Iterable[Source]) -> list[str]:
    """Imports of a package against the direction: also in functions and for types."""
    return [
        f"{source.path}:{line}: imports {name}"
        for source in every
        for allowed in [_allowed(source)]
        for line, name in imports(source.tree)
        if name.startswith((".", "tests")) or ours(name)[:1] not in ([], *allowed)
    ]


def _allowed(source: Source) -> list[list[str]]:
    """Return what may follow `raycert.` in an import: for the face, anything."""
    anything = [[part] for _, name in imports(source.tree) for part in ours(name)[:1]]
    allowed = MAY_IMPORT.get(source.package)
    return anything if allowed is None else [[package] for package in allowed]


def upward_chapters(every: Iterable[Source]) -> list[str]:
    """Imports of a chapter that comes later, and of more than `ALONE` allows."""
    wrong = []
    for source in every:
        if source.chapter not in CHAPTERS:
            continue
        before = set(CHAPTERS[: CHAPTERS.index(source.chapter) + 1])
        allowed = ALONE.get(source.chapter, before) | {"starters", "schemas"}
        for line, name in imports(source.tree):
            parts = ours(name)
            if parts[:1] == ["oracle"] and len(parts) > 1 and parts[1] not in allowed:
                wrong.append(f"{source.path}:{line}: imports {name}")
    return wrong


def cycles(every: Iterable[Source]) -> list[str]:
    """A circle of modules that import one another, lazy imports and those for types counted."""
    by_name = {source.name: source for source in every}
    graph = defaultdict(set)
    for source in by_name.values():
        for _, name in imports(source.tree):
            target = name if name in by_name else name.rpartition(".")[0]
            if target in by_name and target != source.name:
                graph[source.name].add(target)
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return [" -> ".join(error.args[1])]
    return []


def at_top(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield the statements that run on import: all that is in no function, and not for types."""
    for node in ast.iter_child_nodes(tree):
        for_types = isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)
        if (
            not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
            and not for_types
        ):
            yield node
            yield from at_top(node)


def heavy_on_import(every: Iterable[Source]) -> list[str]:
    """Heavy packages that importing a module loads, where it is not made for that."""
    return [
        f"{source.path}:{line}: loads {name}"
        for source in every
        if not source.path.startswith(MAY_LOAD) and source.path not in PLUGGED
        for node in at_top(source.tree)
        if isinstance(node, ast.Import | ast.ImportFrom)
        for line, name in imports(node)
        if name.partition(".")[0] in HEAVY
    ]


def heavy_in_the_plain_packages(every: Iterable[Source]) -> list[str]:
    """Heavy packages that `cases` or `reference` load anywhere, lazily or not."""
    return [
        f"{source.path}:{line}: loads {name}"
        for source in every
        if source.package in ("cases", "reference")
        if not source.path.startswith(MAY_LOAD) and source.path not in PLUGGED
        for line, name in imports(source.tree)
        if name.partition(".")[0] in HEAVY
    ]


def too_long(every: Iterable[Source]) -> list[str]:
    """Modules and functions that are too long; decorators do not count."""
    found = []
    for source in every:
        if source.lines > LONGEST_MODULE:
            found.append(f"{source.path}: {source.lines} lines")
        for node in ast.walk(source.tree):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                length = (node.end_lineno or 0) - node.lineno + 1
                if length > LONGEST_FUNCTION:
                    found.append(f"{source.path}:{node.lineno}: {node.name} has {length} lines")
    return found


def without_docstring(every: Iterable[Source]) -> list[str]:
    return [source.path for source in every if not ast.get_docstring(source.tree)]


def shared_class_names(every: Iterable[Source]) -> list[str]:
    """Public classes of one name in two modules of oracle."""
    where = defaultdict(list)
    for source in every:
        if source.package == "oracle" and source.chapter != "starters":
            for node in source.tree.body:
                if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                    where[node.name].append(source.path)
    return [f"{name}: {', '.join(paths)}" for name, paths in where.items() if len(paths) > 1]


def shared_stems(every: Iterable[Source]) -> list[str]:
    """Modules of one name in two chapters; a verb may be called as what it commands."""
    stems = Counter(
        Path(source.path).stem
        for source in every
        if source.chapter not in ("", "commands", *DATA) and not source.path.endswith("__init__.py")
    )
    return [stem for stem, count in stems.items() if count > 1]


def incomplete_lists(every: Iterable[Source]) -> list[str]:
    """Packages whose docstring does not name each of their modules, a line each."""
    modules = defaultdict(set)
    for source in every:
        folder, _, stem = source.path.rpartition("/")
        modules[folder].add(stem.removesuffix(".py"))
    wrong = []
    for source in every:
        folder = source.path.removesuffix("/__init__.py")
        if folder == source.path or source.package == "face" or source.chapter == "starters":
            continue
        text = ast.get_docstring(source.tree) or ""
        listed = {line.split()[0] for line in text.splitlines() if line.split()}
        missing = modules[folder] - listed - {"__init__", "__main__"}
        if folder == "oracle":
            missing = set(CHAPTERS) - listed
        wrong += [f"{source.path} does not list {name}" for name in sorted(missing)]
    return wrong


def imported_tests(every: Iterable[Source]) -> list[str]:
    """Imports of a test module: what two of them need lies in `shared`."""
    return [
        f"{source.path}:{line}: imports {name}"
        for source in every
        for line, name in imports(source.tree)
        if any(
            part in ("tests", "conftest") or part.startswith("test_") for part in name.split(".")
        )
    ]


SPEAK = {"oracle/reports/foreign.py", "oracle/reports/screen.py"}
"""The only modules that print: what others wrote goes through them."""
SPEAKERS = {"print", "click.echo", "click.secho", "click.echo_via_pager", "Console"}


def prints(every: Iterable[Source]) -> list[str]:
    """Calls that print, around the place where foreign text is made safe to show.

    Bytes are data for a machine, each of a form that escapes; `write_out` alone hands them over.
    """
    return [
        f"{source.path}:{node.lineno}: {ast.unparse(node)}"
        for source in every
        if source.package in ("oracle", "face") and source.path not in SPEAK
        if source.chapter != "starters"
        for node in ast.walk(source.tree)
        if isinstance(node, ast.Call)
        and (
            (said := ast.unparse(node.func)) in SPEAKERS
            or said.endswith((".Console", "stdout.write", "stderr.write"))
        )
        and ast.unparse(node) != "click.echo(data, nl=False)"
    ]


RULES: tuple[Rule, ...] = (
    wrong_directions,
    upward_chapters,
    cycles,
    heavy_on_import,
    heavy_in_the_plain_packages,
    too_long,
    without_docstring,
    shared_class_names,
    shared_stems,
    incomplete_lists,
    prints,
)


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.__name__)
def test_the_modules_keep_the_rule(rule: Rule) -> None:
    assert rule(SOURCES) == []


def test_no_test_module_imports_another() -> None:
    here = Path(__file__).parent
    every = [Source(f"tests/{p.relative_to(here)}", p.read_text()) for p in here.rglob("*.py")]
    assert len(every) > 100
    assert imported_tests(every) == []


def test_all_packages_are_seen() -> None:
    assert {source.package for source in SOURCES} == {*MAY_IMPORT, "face"}
    assert {source.chapter for source in SOURCES} >= set(CHAPTERS)


def test_oracle_holds_its_rooms_and_nothing_else() -> None:
    root = Path(str(oracle.__file__)).parent
    found = {path.name for path in root.iterdir() if path.name not in ("__pycache__", "face")}
    assert found == {*CHAPTERS, "schemas", "starters", "__init__.py", "py.typed", "README.md"}
    assert len(found) <= ROOMS


def test_the_tests_have_the_folders_of_what_they_test() -> None:
    here = Path(__file__).parent
    folders = {path.name for path in here.iterdir() if list(path.glob("test_*.py"))}
    assert folders == {*CHAPTERS, *DATA, "cases", "reference"} - {"schemas"}


def loaded_by(modules: list[str]) -> set[str]:
    """Return the heavy packages that a new interpreter holds once it has imported the modules."""
    code = f"import sys\nfor name in {modules!r}: __import__(name)\nprint(*sys.modules)"
    run = [sys.executable, "-W", "error", "-c", code]
    return set(subprocess.check_output(run, text=True).split()) & HEAVY


def test_nothing_but_what_is_made_for_it_loads_a_heavy_package() -> None:
    """Over all imports of imports: what the rule on single modules cannot see."""
    modules = [
        source.name
        for source in SOURCES
        if not source.path.startswith(MAY_LOAD)
        and source.path not in PLUGGED
        and not source.path.endswith("__main__.py")
    ]
    assert loaded_by(modules) == set()
    assert loaded_by(["raycert.oracle.witness.enclosure"]) == {"mpmath"}


LONG = "def f():\n" + "    pass\n" * LONGEST_FUNCTION
PLANTED: list[tuple[Rule, dict[str, str]]] = [
    (wrong_directions, {"reference/x.py": "from raycert.oracle.exact.trace import trace"}),
    (wrong_directions, {"oracle/map/x.py": "from raycert.reference import tracer"}),
    (wrong_directions, {"oracle/map/x.py": "import raycert.reference.tracer as t"}),
    (wrong_directions, {"cases/families/x.py": "from raycert import oracle"}),
    (wrong_directions, {"cases/x.py": "from raycert.reference.tracer import intersect"}),
    (wrong_directions, {"oracle/map/x.py": "from . import trace"}),
    (wrong_directions, {"reference/x.py": "def f():\n    from raycert.oracle import exact"}),
    (wrong_directions, {"cases/x.py": "if TYPE_CHECKING:\n    from raycert.oracle import exact"}),
    (upward_chapters, {"oracle/judge/x.py": "from raycert.oracle.certify.run import certify"}),
    (upward_chapters, {"oracle/exact/x.py": "def f():\n    from raycert.oracle import judge"}),
    (upward_chapters, {"oracle/hunt/x.py": "from raycert.oracle.commands.hunt import hunt"}),
    (cycles, {
        "cases/a.py": "from raycert.cases.b import x",
        "cases/b.py": "def f():\n    from raycert.cases.a import y",
    }),
    (heavy_on_import, {"oracle/hunt/x.py": "import numpy as np"}),
    (heavy_on_import, {"oracle/commands/x.py": "from sympy import sqrt"}),
    (heavy_on_import, {"oracle/map/x.py": "try:\n    import mpmath.libmp\nexcept E:\n    pass"}),
    (heavy_on_import, {"cases/x.py": "class C:\n    import trimesh"}),
    (heavy_in_the_plain_packages, {"cases/x.py": "def f():\n    import sympy"}),
    (heavy_in_the_plain_packages, {"reference/x.py": "def f():\n    import numpy"}),
    (too_long, {"oracle/map/x.py": "pass\n" * (LONGEST_MODULE + 1)}),
    (too_long, {"oracle/map/x.py": LONG}),
    (too_long, {"oracle/map/x.py": "class C:\n    " + LONG.replace("\n", "\n    ").rstrip()}),
    (without_docstring, {"oracle/map/x.py": "x = 1"}),
    (shared_class_names, {"oracle/map/x.py": "class A: ...", "oracle/zoo/y.py": "class A: ..."}),
    (shared_stems, {"oracle/map/x.py": "", "oracle/zoo/x.py": ""}),
    (incomplete_lists, {"oracle/map/__init__.py": '"""The map."""', "oracle/map/x.py": ""}),
    (prints, {"oracle/commands/x.py": "import click\nclick.echo(name)"}),
    (prints, {"oracle/commands/x.py": "def f():\n    print(name, file=sys.stderr)"}),
    (prints, {"oracle/explain/x.py": "from rich.console import Console\nConsole().print(x)"}),
    (prints, {"oracle/hunt/x.py": "sys.stderr.write(name)"}),
    (imported_tests, {"tests/map/test_x.py": "from tests.map.test_y import run"}),
    (imported_tests, {"tests/map/test_x.py": "def f():\n    import test_y"}),
    (imported_tests, {"tests/map/test_x.py": "from . import test_y"}),
]  # fmt: skip


@pytest.mark.parametrize(("rule", "planted"), PLANTED)
def test_a_planted_violation_is_noticed(rule: Rule, planted: dict[str, str]) -> None:
    assert len(rule([Source(path, text) for path, text in planted.items()])) == 1


ALLOWED: list[tuple[Rule, dict[str, str]]] = [
    (wrong_directions, {"oracle/map/x.py": "from raycert.cases.model import Ray\nimport math"}),
    (upward_chapters, {"oracle/hunt/x.py": "from raycert.oracle.certify.run import certify"}),
    (heavy_on_import, {"oracle/map/x.py": "def f():\n    import sympy"}),
    (heavy_on_import, {"oracle/witness/x.py": "import sympy"}),
    (too_long, {"oracle/map/x.py": "def f():\n" + "    pass\n" * (LONGEST_FUNCTION - 1)}),
    (shared_stems, {"oracle/map/x.py": "", "oracle/commands/x.py": ""}),
    (incomplete_lists, {"oracle/map/__init__.py": '"""Map.\n\nx   it"""', "oracle/map/x.py": ""}),
]


@pytest.mark.parametrize(("rule", "allowed"), ALLOWED)
def test_what_is_allowed_is_not_noticed(rule: Rule, allowed: dict[str, str]) -> None:
    assert rule([Source(path, text) for path, text in allowed.items()]) == []
