"""The targets of a gradebook: a TOML file with a table for each, read, and refused by the key.

    level = "stable"                             # what stands at the top is for all
    case_timeout = 10

    [targets.mine]
    words = "python3 tracer.py --fast"           # as in a shell, or a list of words
    title = "my tracer, with --fast"
    hello = { domain = { distance = 1e6 } }      # in place of what it says itself

    [targets.class]
    each = "submissions/*/tracer.py:intersect"   # one target for each such file

Words and patterns are relative to the folder of the file. A target of `each` is called as what the
wildcards stand for; `{}` in its `words` is the file, and `words` may be left out.
"""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from glob import glob
from hashlib import file_digest, sha256
from json import dumps
from pathlib import Path
from typing import Any

from raycert.cases.files import BadFile, read_toml
from raycert.cases.hints import near
from raycert.cases.levels import LEVELS, Level
from raycert.cases.protocol import BadLine, Hello, convention
from raycert.oracle.client.dialogue import Limits
from raycert.oracle.client.target import CALLABLE

TIMES = {"hello_timeout": "hello", "case_timeout": "case"}
COMMON = ("level", "convention", "hello", *TIMES, "line_limit")
"""Keys that may stand at the top, for all targets."""
OWN = ("words", "each", "title")
LONGEST_TIME = 86400
SLUG = 60


@dataclass(frozen=True, slots=True)
class Entrant:
    """A target of a gradebook: how it is run, in which folder, and what is asked of it.

    `hello` are the fields that hold in place of what the target says of itself.
    """

    name: str
    words: tuple[str, ...]
    folder: Path
    title: str = ""
    level: Level = "sound"
    convention: str = "closed"
    hello: Mapping[str, Any] = field(default_factory=dict)
    limits: Limits = field(default_factory=Limits)

    @property
    def place(self) -> str:
        """Return the name of the folder for its certificate: one for each name, on any system."""
        slug = re.sub(r"[^\w.+-]+", "-", self.name, flags=re.ASCII).strip("-.")[:SLUG]
        if slug == self.name:
            return slug
        return f"{slug or 'target'}-{sha256(self.name.encode('utf-8', 'replace')).hexdigest()[:6]}"

    def fingerprint(self, others: Iterable[Path], *context: object) -> str:
        """Return what changes with the entrant, with the bytes of its files, and with the context.

        Its files are those that its words name, and the Python files beside a Python file that are
        not of the `others`: what it may import.
        """
        asked = [self.words, self.level, self.convention, self.hello, repr(self.limits), *context]
        digest = sha256(dumps(asked, default=str).encode())
        own, taken = self.files(), set(others)
        beside = {p for f in own if f.suffix == ".py" for p in f.parent.glob("*.py")} - taken
        for path in sorted({*own, *beside}):
            with path.open("rb") as file:
                digest.update(f"{path.name} {file_digest(file, 'sha256').hexdigest()}".encode())
        return digest.hexdigest()

    def files(self) -> list[Path]:
        """Return the files that the words name, as far as they are there."""
        stems = [word.rpartition(":")[0] for word in self.words if CALLABLE.fullmatch(word)]
        modules = [f"{stem.replace('.', '/')}.py" for stem in stems]
        named = [self.folder / word for word in (*self.words, *stems, *modules)]
        return [path for path in dict.fromkeys(named) if path.is_file()]


def read_entrants(path: Path, over: Mapping[str, Any] | None = None) -> list[Entrant]:
    """Return the targets of a file, in its order; `over` holds in place of its keys.

    Raises `BadFile`, which names the key.
    """
    return _Reader(str(path), path.absolute().parent).entrants(read_toml(path), over or {})


def entrants_each(
    patterns: Sequence[str], words: str | None, over: Mapping[str, Any], folder: Path
) -> list[Entrant]:
    """Return a target for each file of the patterns. Raises `BadFile`."""
    common = {"words": words} if words else {}
    tables = {f"each {pattern}": {"each": pattern, **common} for pattern in patterns}
    return _Reader("--each", folder).entrants({"targets": tables}, over)


@dataclass(frozen=True)
class _Reader:
    file: str
    folder: Path

    def entrants(self, form: Mapping[str, Any], over: Mapping[str, Any]) -> list[Entrant]:
        self._keys(form, ("targets", *COMMON), "")
        tables = form.get("targets")
        if not isinstance(tables, dict) or not tables:
            raise self._bad("targets", "is missing: write [targets.NAME] for each target")
        common = self._common({name: form[name] for name in COMMON if name in form}, "")
        found: dict[str, tuple[Entrant, str]] = {}
        for name, table in tables.items():
            path = f"targets.{name}"
            if not isinstance(table, dict):
                raise self._bad(path, "is not a table: write [targets.NAME]")
            self._keys(table, (*OWN, *COMMON), f"{path}.")
            for entrant in self._targets(name, table, common, over):
                key = entrant.name.casefold()
                if key in found:
                    raise self._bad(
                        path, f"{entrant.name!r:.60} is a target of {found[key][1]} too"
                    )
                found[key] = entrant, path
        return [entrant for entrant, _ in found.values()]

    def _targets(
        self, name: str, table: dict[str, Any], common: Entrant, over: Mapping[str, Any]
    ) -> Iterator[Entrant]:
        path = f"targets.{name}."
        asked = {key: table[key] for key in COMMON if key in table}
        base = self._common(asked, path, common)
        base = self._common(over, "", base)
        base = replace(base, title=self._text(table, "title", path))
        words = self._words(table.get("words"), path)
        if "each" not in table:
            if not words:
                raise self._bad(f"{path}words", "is missing: how is it run?")
            yield replace(base, name=name, words=words)
            return
        for called, file, function in self._matching(self._text(table, "each", path), path):
            title = f"{base.title} {called}".strip() if base.title else ""
            filled = tuple(word.replace("{}", file + function) for word in words or ("{}",))
            if filled[0].endswith(".py") and not os.access(self.folder / filled[0], os.X_OK):
                hint = f'write {table["each"]}:FUNCTION, or words = "python3 {{}}"'
                raise self._bad(f"{path}each", f"{file} cannot be run by itself: {hint}")
            yield replace(base, name=called, title=title, words=filled)

    def _matching(self, pattern: str, path: str) -> Iterator[tuple[str, str, str]]:
        """Yield (name, file, `:function` or nothing) of each file of a pattern."""
        files, function = pattern, ""
        if CALLABLE.fullmatch(pattern):
            files, _, function = pattern.rpartition(":")
        if not (wild := list(re.finditer(r"\[[^\]]+\]|[*?]+", files))):
            raise self._bad(f"{path}each", f"has no wildcard: {pattern!r:.60}; name it by words")
        head, tail = wild[0].start(), len(files) - wild[-1].end()
        matches = sorted(glob(files, root_dir=self.folder, recursive=True))
        matches = [match for match in matches if (self.folder / match).is_file()]
        if not matches:
            raise self._bad(f"{path}each", f"matches no file in {self.folder}: {files!r:.60}")
        for match in matches:
            name = match[head : len(match) - tail] or match
            file = match if os.path.dirname(match) else f"./{match}"
            yield name, file, f":{function}" if function else ""

    def _common(self, form: Mapping[str, Any], path: str, base: Entrant | None = None) -> Entrant:
        """Return an entrant with what a table asks in place of what the base does."""
        base = base or Entrant("", (), self.folder)
        level = form.get("level", base.level)
        if level not in LEVELS:
            hint = near(str(level), LEVELS) or f"levels: {', '.join(LEVELS)}"
            raise self._bad(f"{path}level", f"is no level: {level!r:.40}; {hint}")
        wanted = self._text(form, "convention", path) if "convention" in form else base.convention
        hello = form.get("hello", {})
        if not isinstance(hello, dict):
            raise self._bad(f"{path}hello", "is not a table of the fields of a hello")
        self._try(lambda: convention(wanted), f"{path}convention")
        self._keys(hello, Hello.__slots__, f"{path}hello.")
        self._try(lambda: Hello("x").but(dict(hello)), f"{path}hello")
        limits = replace(base.limits, **dict(self._limits(form, path)))
        return replace(
            base, level=level, convention=wanted, hello={**base.hello, **hello}, limits=limits
        )

    def _limits(self, form: Mapping[str, Any], path: str) -> Iterator[tuple[str, Any]]:
        for key, name in (*TIMES.items(), ("line_limit", "line")):
            if key in form:
                value, whole = form[key], name == "line"
                least, most = (256, 1 << 30) if whole else (0.01, LONGEST_TIME)
                kind = int if whole else (int, float)
                if isinstance(value, bool) or not isinstance(value, kind):
                    raise self._bad(f"{path}{key}", f"is not a number: {value!r:.40}")
                if not least <= value <= most:
                    raise self._bad(f"{path}{key}", f"is not within {least} and {most}: {value!r}")
                yield name, value

    def _words(self, value: object, path: str) -> tuple[str, ...]:
        """Return the words of a command: a text is parted as a shell parts it."""
        if value is None:
            return ()
        try:
            words = shlex.split(value) if isinstance(value, str) else value
        except ValueError as error:
            raise self._bad(f"{path}words", f"{error}: {value!r:.60}") from None
        if not isinstance(words, list) or not words or not all(isinstance(w, str) for w in words):
            raise self._bad(f"{path}words", "is not a text or a list of words")
        return tuple(words)

    def _text(self, table: Mapping[str, Any], key: str, path: str) -> str:
        value = table.get(key, "")
        if not isinstance(value, str):
            raise self._bad(f"{path}{key}", f"is not a text: {value!r:.40}")
        return value

    def _try(self, read: Callable[[], object], path: str) -> None:
        try:
            read()
        except BadLine as error:
            reason = str(error).removeprefix("hello")
            raise self._bad(path, reason.removeprefix("convention ")) from None

    def _keys(self, table: Mapping[str, Any], known: Sequence[str], path: str) -> None:
        for key in table:
            if key not in known:
                hint = near(key, known) or f"keys: {', '.join(known)}"
                raise self._bad(f"{path}{key:.40}", f"is not a key; {hint}")

    def _bad(self, path: str, reason: str) -> BadFile:
        joint = "" if reason.startswith(".") else " "
        return BadFile(f"{self.file}: {path}{joint}{reason}")
