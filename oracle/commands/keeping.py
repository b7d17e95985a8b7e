"""Where a certificate goes, and that nothing else is lost there.

A run of a part has no certificate unless `--out` names one. A certificate takes the place of one of
the same run, which is: the same command line of all that is asked, and the same corpus. Anything
else stays where it is, and the run is refused before it begins. Reports are made from the
certificate and can be again: one that is named takes the place of what has its name.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from raycert.oracle.commands.options import FILE, BadInput, write_out, writing
from raycert.oracle.reports.foreign import clean

if TYPE_CHECKING:
    from raycert.oracle.certify.run import Plan

USUAL = Path("certificate.json")
"""Where the certificate of a whole corpus goes, if nothing else is said."""
FORCE = "--out FILE writes elsewhere, --force overwrites it"


class Errand(NamedTuple):
    """What makes two runs the same: what was asked, of which golden files."""

    line: str
    version: str
    manifest: str

    @classmethod
    def of(cls, plan: Plan, command: tuple[str, ...], options: Mapping[str, Any]) -> Errand:
        from raycert.cases.corpus import digest, read_manifest

        line, golden = plan.request(command).whole(), plan.golden
        words = _also(options["expect"], {name: options[name] for name in ("stress", "bench")})
        return cls(line + words, read_manifest(golden)["corpus"], digest(golden))

    @classmethod
    def read(cls, form: Any) -> Errand:
        """Return the run of a certificate. Raises `LookupError` or `TypeError` where it is none."""
        known, corpus = form["expectations"], form["corpus"]
        words = _also(known and known["file"], form["standing"])
        return cls(form["reproduce"] + words, corpus["version"], corpus["manifest_sha256"])


def _also(expect: object, standing: Mapping[str, Any]) -> str:
    """Return the words of a command line that `Request` does not know."""
    known = f" --expect {expect}" if expect else ""
    return known + "".join(f" --{name}" for name in ("stress", "bench") if standing[name])


@dataclass(frozen=True, slots=True)
class Keep:
    """The file for the certificate of a run. `force` overwrites whatever is there."""

    out: Path
    run: Errand
    force: bool

    def obstacle(self, interrupted: bool = False) -> str | None:
        """Return what would be lost by writing here; None if nothing is.

        Of the same run that is only a whole certificate, by one of an `interrupted` run.
        """
        if self.force or not self.out.is_file() or not self.out.stat().st_size:
            return None
        try:
            form = json.loads(self.out.read_bytes())
            there, whole = Errand.read(form), not form["run"]["interrupted"]
        except (LookupError, TypeError, ValueError, RecursionError):
            return f"is no certificate, and stays as it is; {FORCE}"
        if there.line != self.run.line:
            lines = f"\n  there  {clean(there.line, 1000)}\n  asked  {self.run.line}\n"
            return f"is the certificate of another run:{lines}{FORCE}"
        if there.manifest != self.run.manifest:
            versions = f"{clean(there.version, 80)}, this run's are of {self.run.version}"
            return f"is of other golden files, those of corpus {versions}; {FORCE}"
        if interrupted and whole:
            return "is of the same run to its end, and stays; --force overwrites it"
        return None

    def write(self, form: Mapping[str, Any]) -> bool:
        """Write the certificate unless it would cost what came meanwhile; return whether it did."""
        if lost := self.obstacle(form["run"]["interrupted"]):
            with writing(self.out):
                raise FileExistsError(lost)
            return False
        return write_out(self.out, json.dumps(form, indent=1, allow_nan=False) + "\n")


def place(plan: Plan, command: tuple[str, ...], options: Mapping[str, Any]) -> Keep | None:
    """Return where the certificate goes, if anywhere. Refuses what would be lost by it: exit 2."""
    out = options["out"]
    if out is None and plan.selection.options():
        return None
    out = out or FILE.convert(USUAL, None, None)
    found = Keep(out, Errand.of(plan, command, options), options["force"])
    if lost := found.obstacle():
        raise BadInput(f"{out} {lost}")
    return found


def check_distinct(files: Mapping[str, Path | str | None]) -> None:
    """Refuse two options that name one file; standard output and a device hold any number."""
    named: dict[Path, str] = {}
    for option, file in files.items():
        path = Path(file or "-").resolve()
        if str(file or "-") == "-" or (path.exists() and not path.is_file()):
            continue
        other = named.setdefault(path, option)
        if other != option:
            raise click.UsageError(f"{other} and {option} name one file: {file}")


def check_written(options: Mapping[str, Any]) -> None:
    """Refuse to overwrite what people add to once it is written: reasons, a domain."""
    for option, new in (
        ("--write-expectations", options["record"]),
        ("--write-domain", options["write_domain"]),
    ):
        if new is None or options["force"] or not new.is_file() or not new.stat().st_size:
            continue
        read = options["expect"] if option == "--write-expectations" else None
        if read is None or not new.samefile(read):
            keeps = f"--expect {new} keeps reasons that hold, " if new == options["record"] else ""
            raise BadInput(f"{option}: {new} is there already; {keeps}--force overwrites it")
