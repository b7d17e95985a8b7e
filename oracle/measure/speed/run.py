"""All sections, one after the other; an interruption ends it with what is measured by then."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from importlib.metadata import PackageNotFoundError, version
from typing import Any

SECTIONS = ("certified", "scalar", "libraries", "solids")
FORM = 1
"""The version of the form of the JSON file."""
DISTRIBUTIONS = (
    "numpy",
    "numba",
    "mpmath",
    "sympy",
    "python-flint",
    "raysect",
    "mujoco",
    "trimesh",
    "embreex",
)
"""What the figures depend on."""


@dataclass(frozen=True, slots=True)
class Effort:
    """Lanes of a batch, rays one at a time, rays to cast, pixels of a picture, solids, passes."""

    lanes: int
    scalar: int
    rays: tuple[int, int]
    picture: tuple[int, int]
    solids: int
    repeats: int


FULL = Effort(200_000, 80, (200, 100), (160, 120), 1000, 5)
QUICK = Effort(20_000, 24, (80, 50), (64, 48), 100, 3)


@dataclass
class Report:
    """The rows so far, by section, and what is to be said of them."""

    seed: int
    effort: Effort
    sections: dict[str, list[Any]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    interrupted: bool = False

    def as_json(self) -> dict[str, Any]:
        """Return the report as plain data, with the aims, the machine and the versions."""
        from raycert.oracle.measure.speed.certified import FEW_INTEGERS, INTEGERS, RATIOS

        aims = {"ratios": RATIOS, "integers": INTEGERS | {"elsewhere": FEW_INTEGERS}}
        return {
            "speed": FORM,
            "seed": self.seed,
            "interrupted": self.interrupted,
            "effort": asdict(self.effort),
            "environment": surroundings(),
            "aims": aims,
            "notes": self.notes,
            "sections": {
                name: [asdict(row) for row in rows] for name, rows in self.sections.items()
            },
        }


def surroundings() -> dict[str, Any]:
    """Return the tool, the machine and the versions of what computes."""
    from raycert.oracle.certify.environment import environment
    from raycert.oracle.measure.bench.files import processor

    packages = {}
    for name in DISTRIBUTIONS:
        try:
            packages[name] = version(name)
        except PackageNotFoundError:
            continue
    return {**environment(), "processor": processor(), "packages": packages}


def run(
    sections: Sequence[str],
    effort: Effort,
    seed: int = 1,
    advance: Callable[[], None] = lambda: None,
) -> Report:
    """Return the report on some sections; partial after KeyboardInterrupt."""
    report = Report(seed, effort)
    try:
        for name in sections:
            rows: list[Any] = report.sections.setdefault(name, [])
            for some in _MAKE[name](report):
                rows += some
                advance()
    except KeyboardInterrupt:
        report.interrupted = True
    return report


def steps(sections: Iterable[str], effort: Effort) -> int:
    """Return how often a full run advances."""
    from raycert.oracle.measure.speed import certified, libraries, scalar, scenes

    count = {
        "certified": certified.steps(),
        "scalar": len(scalar.SCENARIOS),
        "libraries": libraries.steps(),
        "solids": len(scenes.numbers(effort.solids)),
    }
    return sum(count[name] for name in sections)


def _certified(report: Report) -> Iterator[list[Any]]:
    from raycert.oracle.measure.price import ENGINES, available
    from raycert.oracle.measure.speed.certified import rows

    absent = [name for name in ENGINES if name not in available()]
    report.notes += [f"certified: {name}: not installed, or not trusted here" for name in absent]
    effort = report.effort
    for one in rows(effort.lanes, effort.repeats, report.seed):
        yield [one]


def _scalar(report: Report) -> Iterator[list[Any]]:
    from raycert.oracle.measure.speed.scalar import methods, rows

    found, notes = methods()
    report.notes += notes
    yield from rows(report.effort.scalar, report.effort.repeats, report.seed, found)


def _libraries(report: Report) -> Iterator[list[Any]]:
    from raycert.oracle.measure.speed.libraries import here, rows

    found, notes = here()
    report.notes += notes
    yield from rows(report.effort.rays, report.effort.repeats, report.seed, found)


def _solids(report: Report) -> Iterator[list[Any]]:
    from raycert.oracle.measure.speed.scenes import rows

    effort = report.effort
    for one in rows(effort.picture, effort.solids, effort.repeats):
        yield [one]


_MAKE: dict[str, Callable[[Report], Iterator[list[Any]]]] = {
    "certified": _certified,
    "scalar": _scalar,
    "libraries": _libraries,
    "solids": _solids,
}
