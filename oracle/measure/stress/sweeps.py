"""The sweeps: one parameter each, by decades, and the rays of every step.

The rays of a step depend on the seed, the sweep and the step only, and are the same on every
machine. All steps of a sweep draw the same numbers; only the parameter moves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from raycert.cases.dice import Dice
from raycert.cases.draw import Draw
from raycert.cases.families.sketch import ten, two
from raycert.cases.formats import BINARY64
from raycert.oracle.measure.stress import aims, touching
from raycert.oracle.measure.stress.sample import Sample

Make = Callable[[Draw, int, Fraction], Sample]
LAST_BIT = 52
"""1 + 2^-52 is the double after 1; the last step of a gap is half of that."""


@dataclass(frozen=True)
class Sweep:
    """One parameter: its steps in the order of the axis, and the sample of a step.

    `mild` is the step where nothing is stiff: ranges are read from there, both ways. `base` is
    that of the steps' powers; 0 may follow them. `weight` multiplies the samples, where a failure
    is rare. `rounding` tells that only the correctly rounded list is of
    interest, not its backward error.
    """

    name: str
    title: str
    axis: str
    steps: tuple[Fraction, ...]
    mild: Fraction
    make: Make
    base: Literal[2, 10] = 10
    weight: int = 1
    rounding: bool = False

    def text(self, x: Fraction) -> str:
        """Return a step as people write it: 1e-7, 2^-53, 0.

        >>> SWEEPS["far"].text(ten(6)), SWEEPS["speed"].text(two(-50))
        ('1e6', '2^-50')
        """
        if not x:
            return "0"
        power = self.power(x)
        return f"1e{power}" if self.base == 10 else "1" if not power else f"2^{power}"

    def power(self, x: Fraction) -> int:
        """Return the exponent of a step that is not 0."""
        large = x if x >= 1 else 1 / x
        size = (
            len(str(large.numerator)) - 1 if self.base == 10 else large.numerator.bit_length() - 1
        )
        return size if x >= 1 else -size

    def samples(self, x: Fraction, seed: int, count: int) -> list[Sample]:
        """Return the samples of a step: `count` times the weight."""
        return [self.make(draw(seed, self.name, i), i, x) for i in range(count * self.weight)]

    def coarse(self, every: int) -> tuple[Fraction, ...]:
        """Return each `every`-th step from the mild one, and the ends."""
        middle = self.steps.index(self.mild)
        last = len(self.steps) - 1
        kept = (i for i in range(len(self.steps)) if (i - middle) % every == 0 or i in (0, last))
        return tuple(self.steps[i] for i in kept)


def draw(seed: int, name: str, number: int) -> Draw:
    """Return what a sample is drawn from: the same for every step."""
    return Draw(Dice(f"stress {seed} {name} {number}"), BINARY64)


def _powers(base: int, exponents: Iterable[int], *, zero: bool = False) -> tuple[Fraction, ...]:
    power = ten if base == 10 else two
    return (*map(power, exponents), *([Fraction(0)] if zero else []))


_GAPS = _powers(2, [*range(0, -LAST_BIT, -4), -50, -51, -52, -53])
_TO_ZERO = _powers(2, [*range(0, -LAST_BIT, -4), -50, -51, -52, -53], zero=True)
_RANGE = _powers(2, range(-1000, 1001, 50))
_TILTS = _powers(10, range(0, -18, -1))
ONE = Fraction(1)

_ALL = (
    Sweep(
        "far",
        "start far from the solid",
        "distance of the start / radius",
        _powers(10, range(17)),
        ONE,
        aims.far,
    ),
    Sweep(
        "displaced",
        "scene far from the coordinate origin",
        "distance from the origin / radius",
        _powers(10, range(16)),
        ONE,
        aims.displaced,
    ),
    Sweep(
        "thin",
        "needle and disk",
        "radius / height",
        _powers(10, range(-15, 16)),
        ONE,
        aims.thin,
    ),
    Sweep(
        "tilt-wall",
        "almost parallel, from near the wall",
        "angle to the axis, rad",
        _TILTS,
        ONE,
        aims.tilt_wall,
        weight=2,
    ),
    Sweep(
        "tilt-axis",
        "almost parallel, from far up the axis",
        "angle to the axis, rad",
        _TILTS,
        ONE,
        aims.tilt_axis,
        weight=2,
    ),
    Sweep(
        "gap-inside",
        "almost tangent, inside",
        "gap to tangency / radius",
        _GAPS,
        ONE,
        touching.gap_inside,
        2,
    ),
    Sweep(
        "gap-outside",
        "almost tangent, outside",
        "gap to tangency / radius",
        _GAPS,
        ONE,
        touching.gap_outside,
        2,
    ),
    Sweep(
        "start",
        "start near the wall",
        "distance from the wall / radius",
        _TO_ZERO,
        ONE,
        touching.start,
        2,
        weight=8,
    ),
    Sweep(
        "faces",
        "Boolean faces close together",
        "distance between the faces",
        _TO_ZERO,
        ONE,
        touching.faces,
        2,
    ),
    Sweep(
        "speed",
        "short and long directions",
        "length of the direction",
        _RANGE,
        ONE,
        aims.speed,
        2,
    ),
    Sweep("scale", "small and large scenes", "size of the scene", _RANGE, ONE, aims.scale, 2),
    Sweep(
        "hard",
        "hard to round",
        "distance from a tie of two doubles",
        _powers(2, (-20, -40, -80, -120, -160, -240, -320, -480, -640, -800, -1000)),
        two(-20),
        touching.hard,
        2,
        rounding=True,
    ),
)
SWEEPS = {sweep.name: sweep for sweep in _ALL}
