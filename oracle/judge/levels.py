"""The judge: is an answer right, how far from right, and on which level. Pure, exact.

An answer is a list of pairs of numbers of a format. It is compared as a set of t with the lists of
`judge.moved`: inner_k <= answer <= outer_k, as far as the format can tell them apart (`in_format`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from math import frexp, inf, isinf

from raycert.cases.accept import Accept, Numbers, Pairs, malformed
from raycert.cases.domain import EXACT, Tolerance
from raycert.cases.formats import BINARY64, Format
from raycert.cases.levels import Level, Tier
from raycert.cases.model import Intersection, Ray, Solid, Tree, leaves
from raycert.oracle.exact.intervals import Intervals, contains, expected, meets
from raycert.oracle.exact.surd import INFINITY, Surd, dyadic, enclose, nearest, sign_1
from raycert.oracle.exact.trace import trace
from raycert.oracle.judge.backward import Bracket, guess
from raycert.oracle.judge.moved import LAST_STEP, Measure, Movable, Step, moved_leaf

MEASURES: dict[Level, Measure] = {"sound": "squared", "stable": "strict"}
Right = Callable[[Intervals, Intervals], bool]
"""Whether an answer is right between an inner and an outer list."""
Enclosures = tuple[tuple[tuple[float, float], tuple[float, float]], ...]
"""For each pair of a list, the two numbers that enclose each of its ends."""
LIMIT = 20
"""The step of k = 64, which `sound` and `stable` allow."""


def saturated(t: Surd, fmt: Format) -> Surd:
    """Return t, or infinity where it is beyond the format's largest number."""
    return INFINITY if t > dyadic(fmt.largest) else t


def in_format(t: Surd, up: bool, fmt: Format) -> Surd:
    """Return a bound as far as the format can tell it: the benefit of the doubt is the answer's.

    Beyond the largest number there is only infinity; below the smallest normal number, where a
    correctly rounded t is no longer within u t, only the multiples of 2^least around it.
    """
    if t < dyadic(fmt.smallest_normal):
        rounded = enclose(t, fmt)
        return dyadic(rounded.up if up else rounded.down)
    return saturated(t, fmt)


@dataclass(frozen=True)
class Judge:
    """One case, ready to judge answers: everything that it needs is computed once, on demand.

    >>> from raycert.cases.model import Ray, Sphere
    >>> judge = Judge(Sphere((0, 0, 0), 1), Ray((-2, 0.5, 0), (1, 0, 0)))
    >>> judge.expected
    ((1.1339745962155614, 2.866025403784439),)
    >>> answer = [(1.1339745962155612, 2.866025403784439)]
    >>> judge.holds("faithful", answer), judge.holds("exact", answer)
    (True, False)
    >>> judge.backward_error(answer, "strict"), judge.backward_error([(1.13, 2.87)], "strict")
    (0.375, 8796093022208.0)
    """

    solid: Solid
    ray: Ray
    format: Format = BINARY64
    tier: Tier = "generic"
    tolerance: Tolerance = EXACT

    @cached_property
    def exact(self) -> Intervals:
        return trace(self.solid, self.ray).intervals

    @cached_property
    def _expected(self) -> tuple[Intervals, Numbers]:
        return expected(self.exact, self.format)

    @property
    def merged(self) -> Intervals:
        """Return the exact list with the pairs joined that touch after rounding."""
        return self._expected[0]

    @property
    def expected(self) -> Numbers:
        """Return the exact list, each endpoint rounded to nearest; what touches is merged."""
        return self._expected[1]

    @property
    def enclosures(self) -> Enclosures:
        """Return, for each end of the expected list, the two numbers around the exact one."""
        return tuple((self._around(a), self._around(b)) for a, b in self.merged)

    def _around(self, t: Surd) -> tuple[float, float]:
        rounded = enclose(t, self.format)
        return rounded.down, rounded.up

    @cached_property
    def movable(self) -> Movable:
        return Movable(self.solid, self.ray, self.format, self.tolerance)

    def moved(self, step: int, measure: Measure, sigma: int) -> Intervals:
        """Return the outer (sigma = 1) or inner (-1) list of a step of k, in the format."""
        moved = self.movable.by_k(Step.at(step), measure, sigma)
        ends = (
            (in_format(a, sigma < 0, self.format), in_format(b, sigma > 0, self.format))
            for a, b in moved
        )
        return tuple((a, b) for a, b in ends if a <= b)

    def most(self, outer: Intervals, step: int, measure: Measure) -> tuple[int, ...]:
        """Return how many pairs may lie in each interval of an outer list.

        One for a primitive and for an intersection of primitives; else the number of leaves whose
        own outer list meets it.
        """
        if is_convex(self.solid):
            return (1,) * len(outer)
        lists = [
            moved_leaf(leaf, self.movable.shift(leaf, Step.at(step), measure), 1, self.movable.grid)
            for _, leaf in leaves(self.solid)
        ]
        return tuple(sum(any(meets(a, b) for b in own) for own in lists) for a in outer)

    def accept(self, level: Level) -> Accept:
        """Return the lists that decide `sound` or `stable` by comparing numbers of the format.

        A number a of the format has a <= x exactly where a <= x rounded down. So inner enters round
        down and leaves up, outer enters up and leaves down, and what empties is dropped.
        """
        measure = MEASURES[level]
        inner, outer = self.moved(LIMIT, measure, -1), self.moved(LIMIT, measure, 1)
        narrow = [(self._up(a), self._down(b)) for a, b in outer]
        kept = [i for i, (a, b) in enumerate(narrow) if a <= b]
        most = self.most(outer, LIMIT, measure)
        return Accept(
            tuple((self._down(a), self._up(b)) for a, b in inner),
            tuple(narrow[i] for i in kept),
            tuple(most[i] for i in kept),
        )

    def _down(self, t: Surd) -> float:
        return enclose(t, self.format).down

    def _up(self, t: Surd) -> float:
        return enclose(t, self.format).up

    def malformed(self, answer: Pairs) -> str | None:
        """Return what is wrong with an answer's form here; None if nothing is."""
        overflow = any(saturated(enter, self.format) == INFINITY for enter, _ in self.exact)
        reason = malformed(answer, overflow)
        if reason or self.tier != "lattice":
            return reason
        endless = bool(self.exact) and not self.exact[-1][1].finite
        if (bool(answer) and answer[-1][1] == inf) != endless and answer:
            return f"the last leave is {'finite' if endless else 'infinite'}, the exact one is not"
        return None

    def accepts(self, answer: Pairs, step: int, measure: Measure) -> bool:
        """Whether inner <= answer <= outer for a step of k."""
        given = tuple((dyadic(a), dyadic(b)) for a, b in answer)
        return contains(self.moved(step, measure, 1), given) and contains(
            given, self.moved(step, measure, -1)
        )

    def backward_error(self, answer: Pairs, measure: Measure) -> float:
        """Return the least k that accepts an answer, to two significant bits, from 1/16 up.

        Infinite for what is no list, and where no k does.
        """
        return self.bracket_of_list(answer, measure).k

    def bracket_of_list(self, answer: Pairs, measure: Measure) -> Bracket:
        """Return the least step that accepts an answer, to be found."""
        if malformed(answer, True):
            return Bracket.at(LAST_STEP + 1)
        given = tuple((dyadic(a), dyadic(b)) for a, b in answer)
        return self.bracket(
            measure, lambda inner, outer: contains(outer, given) and contains(given, inner), answer
        )

    def bracket(self, measure: Measure, right: Right, answer: Pairs) -> Bracket:
        """Return the least step for whose inner and outer list `right` holds, to be found.

        `right` has to be monotone: what is right stays so when inner shrinks and outer grows. So
        what is right with the exact list as both is right for every k. `answer` tells the guess
        where to look.
        """

        def holds(step: int) -> bool:
            return right(self.moved(step, measure, -1), self.moved(step, measure, 1))

        found = Bracket(holds, lambda: guess(self.movable, measure, answer, self.expected))
        if right(self.exact, self.exact):
            found.at_most(0)
        return found

    def forward_error(self, answer: Pairs) -> float:
        """Return the largest distance of an endpoint from the exact one, in ulps of the exact one.

        Infinite where the number of pairs is not that of the expected list. The result is a
        rounded number for people; nothing is decided by it.
        """
        if len(answer) != len(self.merged) or malformed(answer, True):
            return inf
        return max((self.ulps(x, t) for x, t in self._ends(answer)), default=0.0)

    def _ends(self, answer: Pairs) -> Iterator[tuple[float, Surd]]:
        for given, true in zip(answer, self.merged, strict=True):
            yield from zip(given, true, strict=True)

    def ulps(self, x: float, t: Surd) -> float:
        """Return the distance of a number from an exact t, in ulps of the exact one."""
        if isinf(x) or not saturated(t, self.format).finite:
            return 0.0 if x == nearest(t, self.format) else inf
        below, ulp = enclose(t, self.format).down, self.format.least
        if below:
            ulp = max(frexp(below)[1] - self.format.precision, ulp)
        return enclose(_distance(dyadic(x), t, ulp), self.format).nearest

    def holds(self, level: Level, answer: Pairs) -> bool:
        if self.malformed(answer):
            return False
        match level:
            case "exact":
                return tuple(answer) == self.expected
            case "faithful" if len(answer) == len(self.merged):
                return all(x in self._around(t) for x, t in self._ends(answer))
            case "faithful":
                return False
        return self.accept(level).fault(answer) is None


def is_convex(solid: Solid) -> bool:
    """Whether a solid is a primitive or an intersection of such: at most one interval."""
    if isinstance(solid, Intersection):
        return all(is_convex(part) for part in solid.of)
    return not isinstance(solid, Tree)


def _distance(x: Surd, t: Surd, ulp: int) -> Surd:
    """Return |x - t| / 2^ulp, x rational."""
    up, down = 1 << max(-ulp, 0), 1 << max(ulp, 0)
    a, b, z = (x.x * t.z - t.x * x.z) * up, -t.y * x.z * up, x.z * t.z * down
    flip = -1 if sign_1(a, b, t.d) < 0 else 1
    return Surd(flip * a, flip * b, t.d, z)
