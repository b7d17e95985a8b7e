"""Whether a t may be the first hit, between an inner list I and an outer list O.

What is first for a start inside is the client's to say: `from_inside` is `zero` (t = 0), `exit`
(the next surface) or `miss`. The numbers may be floats or exact: they are only compared.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar

from raycert.cases.protocol import FromInside

T = TypeVar("T", bound=Any)
"""A number of either kind that is compared: a float, or an exact t."""


def first_fault(
    t: T | None,
    inner: Sequence[tuple[T, T]],
    outer: Sequence[tuple[T, T]],
    from_inside: FromInside,
    zero: T,
    last: T,
) -> str | None:
    """Return why t, or None for no hit, cannot be the first hit; None if it can.

    `zero` and `last` are 0 and infinity as numbers of the lists. entry(t) means that t is in O, and
    I is empty or t <= its first enter.

        mode   no hit is right if              t is right if
        zero   I empty                         entry(t)
        miss   I empty or 0 in O               entry(t) and 0 not in I
        exit   I empty or O begins [0, inf)    (entry(t) and 0 not in I), or: 0 in O, t <= the leave
                                               of O's first, no [a, b] of I with a <= t < b
    """
    in_inner = bool(inner) and inner[0][0] <= zero
    in_outer = bool(outer) and outer[0][0] <= zero
    if t is None:
        excused = in_outer and (
            from_inside == "miss" or (from_inside, outer[0][1]) == ("exit", last)
        )
        return "no hit, and the inner list is not empty" if inner and not excused else None
    late = bool(inner) and t > inner[0][0]
    out = not any(a <= t <= b for a, b in outer)
    leaves = in_outer and t <= outer[0][1] and not any(a <= t < b for a, b in inner)
    if from_inside == "exit" and leaves:
        return None
    if from_inside != "zero" and in_inner:
        return f"a hit that is not right for a start inside, with from_inside {from_inside!r}"
    if out:
        return "a hit in no interval of the outer list"
    return "a hit beyond the first enter of the inner list" if late else None
