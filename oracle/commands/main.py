"""The command `raycert`: a table of verbs, each loaded only when it is called."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import click

VERBS: dict[str, tuple[str, str]] = {
    "certify": (
        "raycert.oracle.commands.certify:certify",
        "Grade an implementation on the golden cases.",
    ),
    "report": (
        "raycert.oracle.commands.reporting:report",
        "Write the reports of a certificate again.",
    ),
    "explain": ("raycert.oracle.commands.explain:explain", "Derive one case in the seed's steps."),
    "list": (
        "raycert.oracle.commands.listing:list_cases",
        "List golden cases by family, flag, tier, row.",
    ),
    "show": ("raycert.oracle.commands.listing:show", "Show golden rows in full."),
    "export": ("raycert.oracle.commands.export:export", "Write the golden cases as flat TSV."),
    "golden": ("raycert.oracle.commands.golden:golden", "Regenerate or check the golden files."),
    "harness": (
        "raycert.oracle.commands.harness:harness",
        "Write a starter client in C, C++, Rust, Go, Java, ...",
    ),
    "zoo": (
        "raycert.oracle.commands.zoo:zoo",
        "Try planted wrong tracers: who refuses which, and why.",
    ),
    "crosscheck": (
        "raycert.oracle.commands.crosscheck:crosscheck",
        "Check the oracle by independent witnesses.",
    ),
    "bench": (
        "raycert.oracle.commands.bench:bench",
        "Set error against run time, on the same rays.",
    ),
    "render": ("raycert.oracle.commands.render:render", "Render a scene: depth, normals, error."),
    "plan": (
        "raycert.oracle.commands.plan:plan",
        "What a scene lets the tracer leave out, and why.",
    ),
    "speed": (
        "raycert.oracle.commands.speed:speed",
        "What answers cost beside other ways, as ratios.",
    ),
    "stress": (
        "raycert.oracle.commands.stress:stress",
        "Set error against how stiff the problem is.",
    ),
    "hunt": ("raycert.oracle.commands.hunt:hunt", "Search for failing cases and make them simple."),
    "map": (
        "raycert.oracle.commands.map:draw_map",
        "Draw what surrounds a case: exact answers, errors.",
    ),
    "adopt": ("raycert.oracle.commands.adopt:adopt", "Keep a found case in the corpus."),
    "serve": (
        "raycert.oracle.commands.serve:serve",
        "Answer the line protocol: oracle or reference.",
    ),
}

EPILOG = """\b
First steps:
  raycert certify reference             grade the built-in tracer
  raycert certify -- ./my_tracer        grade yours (it speaks JSON Lines)
  raycert list --families               what is tested, and why
  raycert explain --cylinder 0,0,0 0,0,2 1 --ray=-3,0,1 1,0,0
                                        one case, derived step by step

Exit status: 0 granted or done, 1 not granted or differences found, 2 bad usage or
input, 3 the target could not be run or nothing was tested.
"""


class Verbs(click.Group):
    """A group whose commands are imported when they are needed."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the verbs in the order of the table."""
        return list(VERBS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Return a verb's command, imported now."""
        return load(VERBS[cmd_name][0]) if cmd_name in VERBS else None

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the verbs and what they do, importing none of them."""
        with formatter.section("Verbs"):
            formatter.write_dl([(verb, summary) for verb, (_, summary) in VERBS.items()])


def load(target: str) -> click.Command:
    """Return the command that `module:attribute` names."""
    module, _, attribute = target.partition(":")
    command: click.Command = getattr(import_module(module), attribute)
    return command


@click.group(cls=Verbs, epilog=EPILOG, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="raycert", message="raycert %(version)s")
def main(**_: Any) -> None:
    """Certify ray/solid intersection against exact answers.

    A ray f(t) = u + t v meets a solid in intervals [(enter, leave), ...]. raycert knows them
    exactly, grades what an implementation answers, and shows where it goes wrong.
    """


if __name__ == "__main__":
    main()
