"""The least k that accepts an answer: proposed in doubles, proved in integers.

What accepts an answer at one k accepts it at every larger one. So k is proved by two acceptances,
one at its step that holds and one a step below that does not; `Bracket` keeps what was proved, and
proves no more than it is asked. `guess` says where to begin. It decides nothing: from a wrong guess
the way is longer, and the end the same.

The guess is the depth of the answer's ends: with d the distance of f(t) from axis or center,

    curved face   d^2 - r^2 = x s^2,   r = y s       kappa = 2 x / (q + sqrt(q^2 + 4 x))
    plane         h above it                         kappa = h / s

is the kappa = k u by which the face has to be moved to pass through f(t), outward where it is
positive; q is 2 y (`strict`) or 2 y + 1/4 (`squared`). A leaf has the largest of its faces, a union
the least of its parts, an intersection the largest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from math import frexp, inf, isinf, ldexp, sqrt

from raycert.cases.accept import Pairs
from raycert.cases.model import Difference, Solid, Tree, Union
from raycert.oracle.exact.leaf import Plane, Quadric
from raycert.oracle.judge.moved import LAST_STEP, Measure, Movable, Step

LEAST = float(Step.at(0))
HALFWAY = LAST_STEP // 2
FAR = 40
"""Times 2^40: so far beyond the last finite end an endless interval is looked at."""


class Bracket:
    """The least of the steps 0 to `last` at which something monotone holds, as far as known.

    It does not hold at `low`, and holds at `high`; `last` + 1 stands for no step at all.
    """

    def __init__(
        self,
        holds: Callable[[int], bool],
        guess: Callable[[], int] = lambda: HALFWAY,
        last: int = LAST_STEP,
    ) -> None:
        self.holds, self._guess = holds, guess
        self.low, self.high = -1, last + 1

    @classmethod
    def at(cls, step: int) -> Bracket:
        """Return a least step that is known; LAST_STEP + 1 for none."""
        known = cls(lambda at: at >= step)
        known.low, known.high = step - 1, step
        return known

    def within(self, step: int) -> bool:
        """Whether the least step is at most this one."""
        if not self.low < step < self.high:
            return step >= self.high
        if self.holds(step):
            self.high = step
            return True
        self.low = step
        return False

    def at_most(self, step: int) -> None:
        """Take it as known that it holds at a step, if there is such a step."""
        self.high = min(self.high, max(step, self.low + 1))

    @cached_property
    def guess(self) -> int:
        """Return a step that may be the least one, or near it."""
        return self.low + 1 if self.low + 1 == self.high else self._guess()

    @property
    def least(self) -> int:
        """Return the least step: from the guess in strides that double, then by halves."""
        step, stride = min(max(self.guess, self.low + 1), self.high - 1), 1
        while self.low < step < self.high:
            step += -stride if self.within(step) else stride
            stride *= 2
        while self.high - self.low > 1:
            self.within((self.low + self.high) // 2)
        return self.high

    @property
    def k(self) -> float:
        """Return the k of the least step; infinite where there is none."""
        return float(Step.at(self.least)) if self.least <= LAST_STEP else inf


def guess(movable: Movable, measure: Measure, answer: Pairs, expected: Pairs) -> int:
    """Return a step near the least one that accepts an answer."""
    rounding = 0.25 if measure == "squared" else 0.0
    try:
        kappas = [
            abs(_kappa(movable, movable.solid, t, rounding)) for t in places(answer, expected)
        ]
    except OverflowError:  # lengths of many hundred bits
        return HALFWAY
    return nearest_step(ldexp(max(kappas), movable.format.precision)) if kappas else HALFWAY


def nearest_step(k: float) -> int:
    """Return the least step that is not below k, nor above the last."""
    fraction, exponent = frexp(max(k * (1 - 2.0**-40), LEAST))
    return min(2 * (exponent + 3) + (fraction > 0.5) + (fraction > 0.75), LAST_STEP)


def places(answer: Pairs, expected: Pairs) -> Iterator[float]:
    """Yield t that tell how far off an answer is.

    Its ends; the start and a far end, where only one of the lists has them; and the middle of each
    interval, answered or expected, that meets none of the other list.
    """
    yield from (t for pair in answer for t in pair if 0 < t < inf)
    both = answer, expected
    starts, lasts = [x[0][0] if x else inf for x in both], [x[-1][1] if x else 0.0 for x in both]
    if 0 in starts and any(starts):
        yield 0.0
    if inf in lasts and min(lasts) < inf:
        yield ldexp(1 + min(lasts), FAR)
    for one, other in (both, both[::-1]):
        for a, b in one:
            if not any(a <= d and c <= b for c, d in other):
                yield 2 * a + 1 if isinf(b) else a / 2 + b / 2


def _kappa(movable: Movable, solid: Solid, t: float, rounding: float) -> float:
    """Return how far a solid would have to be moved outward for f(t) to lie on it, over s(t)."""
    if isinstance(solid, Tree):
        kappas = [_kappa(movable, part, t, rounding) for part in solid.of]
        if isinstance(solid, Difference):
            kappas[1:] = [-kappa for kappa in kappas[1:]]
        return min(kappas) if isinstance(solid, Union) else max(kappas)
    (n, m), (s0, s1) = movable.grid.parameter(t), movable.sizes[solid]
    size, (radius, each) = s0 * m + s1 * n, movable.faces[solid]
    return max(_over_size(face, radius * m, n, m, size, rounding) for face in each) if size else 0.0


def _over_size(
    face: Quadric | Plane, radius: int, n: int, m: int, size: int, rounding: float
) -> float:
    """Return kappa of one face at t = n / m; radius and size are times m."""
    if isinstance(face, Plane):
        above = face.c * m + face.b * n
        kappa = sqrt(above * above / (face.square * size * size))
        return -kappa if above < 0 else kappa
    x = (face.a * n * n + 2 * face.b * n * m + face.c * m * m) / (face.scale * size * size)
    q = 2 * radius / size + rounding
    bottom = q + sqrt(max(q * q + 4 * x, 0.0))
    return 2 * x / bottom if bottom else 0.0
