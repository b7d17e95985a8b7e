"""Clients to begin from, one folder a language: `raycert harness LANG --out DIR` writes one.

Each holds the whole line protocol, one marked place, `replace from here` to `to here`, for the
user's own tracer, and a kit of what adapters to libraries need. Until then a port of the reference
tracer stands there, behind the kit if that is wanted, so that it is granted `stable` as it is.
`library` is a shared library instead of a program, and binds the tracer of `c`; `readers` holds two
programs that judge answers without raycert, and is no client; `function` holds a function of
Python, which raycert calls in a process of its own. A file `NAME.jinja` is a template of `NAME`,
and the options are its values; all others are written as they are.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import TYPE_CHECKING

from raycert.cases.protocol import Answers, FromInside

if TYPE_CHECKING:
    from jinja2 import Environment

MARK = b"replace from here"
"""Begins the one place, in one file of each language, that is the user's."""
READERS = "readers"
"""No client: programs that judge answers by the golden rows alone. Asked for like a language."""
TEMPLATE = ".jinja"
README = "README.md"


@dataclass(frozen=True, slots=True)
class Starter:
    """A language: its name, what is typed to build its client (may be nothing) and to run it."""

    name: str
    build: str
    run: str


PLAIN = "-O2 -ffp-contract=off"
"""No multiplication is fused with an addition: the answers are those of every other language."""
STARTERS = {
    "c": Starter("C", f"cc -std=c11 {PLAIN} -o tracer client.c tracer.c -lm", "./tracer"),
    "cpp": Starter("C++", f"c++ -std=c++17 {PLAIN} -o tracer client.cpp tracer.cpp", "./tracer"),
    "rust": Starter("Rust", "cargo build --release", "target/release/tracer"),
    "go": Starter("Go", "go build", "./tracer"),
    "java": Starter("Java", "javac Tracer.java", "java Tracer"),
    "javascript": Starter("JavaScript", "", "node client.mjs"),
    "python": Starter("Python", "", "python3 tracer.py"),
    "library": Starter(
        "C library",
        f"cc -std=c11 -shared -fPIC {PLAIN} -o tracer.so library.c tracer.c -lm",
        "./tracer.so",
    ),
}
FUNCTION = "function"
"""No client, but a function that is called: Python `--in-process`."""
IN_PROCESS = Starter("Python function", "", "tracer.py:intersect")
SHARED = {"library": ("c", ("tracer.c.jinja", "tracer.h.jinja", "kit.h"))}
"""Files that a language takes from another."""


@dataclass(frozen=True, slots=True)
class Wanted:
    """What a client answers, in which precision, and whether it goes through the kit."""

    answers: Answers = "intervals"
    from_inside: FromInside = "zero"
    precision: str = "binary64"
    adapter: bool = False

    @property
    def subject(self) -> str:
        """The name in its hello, less the language."""
        return "reference tracer" + " behind the kit" * self.adapter


def templates(lang: str, wanted: Wanted | None = None) -> Iterator[tuple[str, bytes]]:
    """Yield each file of a language's client: its path in the directory, and its bytes."""
    root = files(__name__)
    found = dict(_walk(root / lang, ""))
    other, names = SHARED.get(lang, ("", ()))
    found |= {name: root / other / name for name in names}
    wanted = wanted or Wanted()
    values = asdict(wanted) | {"starter": STARTERS.get(lang), "subject": wanted.subject}
    for path, file in sorted(found.items()):
        if path.endswith(TEMPLATE):
            text = _environment(root).from_string(file.read_text("utf-8")).render(values)
            yield path.removesuffix(TEMPLATE), text.encode()
        else:
            yield path, file.read_bytes()


def _walk(folder: Traversable, path: str) -> Iterator[tuple[str, Traversable]]:
    for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
        if entry.is_file():
            yield path + entry.name, entry
        elif entry.name != "__pycache__":  # pip compiles the Python one where it lies
            yield from _walk(entry, f"{path}{entry.name}/")


def _environment(root: Traversable) -> Environment:
    """Return what renders: blocks are those of Jinja, a value is $(name), as {{ is in all of C."""
    from jinja2 import Environment, FunctionLoader, StrictUndefined

    return Environment(
        loader=FunctionLoader(lambda name: (root / name).read_text("utf-8")),
        variable_start_string="$(",
        variable_end_string=")",
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=StrictUndefined,
    )
