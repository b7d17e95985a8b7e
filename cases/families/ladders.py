"""The ladders: steps of distance, depth, aspect and scale that fit a format."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.families.sketch import near, ten
from raycert.cases.formats import BINARY64, Format


def is_double(fmt: Format) -> bool:
    """Tell whether the format has the full ladders."""
    return fmt is BINARY64


def decades(fmt: Format) -> range:
    """Return the exponents k of distances and aspects 10^k: to 1e12, or 1e5 in binary32."""
    return range(1, 13 if is_double(fmt) else 6)


def depths(fmt: Format) -> Iterator[tuple[str, Fraction]]:
    """Yield (name, depth) from 1e-2 to 1e-12, or 1e-6 in binary32."""
    for k in range(2, 13 if is_double(fmt) else 7):
        yield f"1e-{k}", near(fmt, ten(-k))


def slopes(fmt: Format) -> Iterator[tuple[str, Fraction]]:
    """Yield (name, slope) from 1e-1 to below the last bit of 1."""
    for k in range(1, 18 if is_double(fmt) else 9):
        yield f"1e-{k}", near(fmt, ten(-k))


def gaps(fmt: Format, step: int = 1) -> range:
    """Return the exponents k of gaps 2^-k that 1 - 2^-k and 1 + 2^-k can hold: to 52, or 23."""
    return range(1, fmt.precision, step)


def scales(fmt: Format, reach64: int, reach32: int, step64: int, step32: int) -> range:
    """Return exponents from -reach to reach, in steps."""
    if is_double(fmt):
        return range(-reach64, reach64 + 1, step64)
    return range(-reach32, reach32 + 1, step32)


def power(k: int) -> str:
    """Return the slug of 2^k, as hex-floats write it: `1p40` or `1p-40`."""
    return f"1p{k}"
