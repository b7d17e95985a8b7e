"""Answers as numbers: is a list well-formed, and does it lie between two lists of numbers.

Comparisons of floats only, so a reader in any language can do the same with the golden rows. What
the lists are is for the oracle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isinf, isnan

Pairs = Sequence[tuple[float, float]]
Numbers = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Accept:
    """Inner and outer list in numbers of the format; `most` pairs are allowed in each outer one."""

    inner: Numbers
    outer: Numbers
    most: tuple[int, ...]

    def fault(self, answer: Pairs) -> str | None:
        """Return why an answer, well-formed by itself, is not between the lists; None if it is."""
        for pair in answer:
            if not any(_within(pair, outer) for outer in self.outer):
                return f"{pair} is in no interval of the outer list"
        for inner in self.inner:
            if not any(_within(inner, pair) for pair in answer):
                return f"nothing contains {inner} of the inner list"
        for outer, most in zip(self.outer, self.most, strict=True):
            count = sum(_within(pair, outer) for pair in answer)
            if count > most:
                return f"{count} pairs where the solid has at most {most}, in {outer}"
        return None


def _within(pair: tuple[float, float], outer: tuple[float, float]) -> bool:
    return outer[0] <= pair[0] and pair[1] <= outer[1]


def malformed(answer: Pairs, enters_overflow: bool = False) -> str | None:
    """Return what is wrong with the list as a list, whatever the solid; None if nothing is.

    `enters_overflow` allows (inf, inf): the exact enter is beyond the format's largest number.
    """
    last = -1.0
    for enter, leave in answer:
        if isnan(enter) or isnan(leave):
            return "NaN"
        if enter < 0:
            return f"enter {enter!r} is negative"
        if isinf(enter) and not enters_overflow:
            return "enter is infinite"
        if enter > leave:
            return f"enter {enter!r} > leave {leave!r}"
        if enter <= last:
            return f"enter {enter!r} <= {last!r}, the leave before it"
        last = leave
    return None
