"""The two number formats, and the three ways to spell a number of them in text.

A number of either format is held as a Python float. Spellings:

    decimal   a JSON number, the shortest that round-trips
    hex       a string as `float.hex()` writes it
    bits      16 hexadecimal digits (8 for binary32): the IEEE bit pattern, most significant first
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass
from typing import Literal

Spelling = Literal["decimal", "hex", "bits"]
SPELLINGS: tuple[Spelling, ...] = ("decimal", "hex", "bits")


@dataclass(frozen=True, slots=True)
class Format:
    """A binary floating-point format: numbers are n * 2^e with |n| < 2^precision, e >= least."""

    name: str
    precision: int
    least: int
    overflow: int
    pack: str

    @property
    def digits(self) -> int:
        """Return how many hexadecimal digits a bit pattern has."""
        return 2 * struct.calcsize(self.pack)

    @property
    def largest(self) -> float:
        return math.ldexp(2.0**self.precision - 1.0, self.overflow - self.precision)

    @property
    def smallest_normal(self) -> float:
        """Return the smallest positive number that has all its digits."""
        return math.ldexp(1.0, self.least + self.precision - 1)

    def holds(self, number: float) -> bool:
        """Whether `number` is one of this format's (infinities included)."""
        return not math.isnan(number) and self.nearest(number) == number

    def nearest(self, number: float) -> float:
        """Return the number of this format nearest to a binary64, ties to even."""
        if math.isnan(number):
            return number
        try:
            packed: float = struct.unpack(self.pack, struct.pack(self.pack, number))[0]
        except OverflowError:
            return math.copysign(math.inf, number)
        return packed

    def bits(self, number: float) -> str:
        """Return the bit pattern of `number`, which must be of this format."""
        return struct.pack(self.pack, number).hex()

    def from_bits(self, text: str) -> float:
        """Return the number with this bit pattern; `ValueError` if the text is not one."""
        if len(text) != self.digits:
            raise ValueError(f"{text!r:.40} has not {self.digits} hexadecimal digits")
        try:
            number: float = struct.unpack(self.pack, bytes.fromhex(text))[0]
        except struct.error:  # fromhex skips spaces
            raise ValueError(f"{text!r:.40} has not {self.digits} hexadecimal digits") from None
        return number


BINARY64 = Format("binary64", 53, -1074, 1024, ">d")
BINARY32 = Format("binary32", 24, -149, 128, ">f")
FORMATS: dict[str, Format] = {"binary64": BINARY64, "binary32": BINARY32}


def spell(number: float, spelling: Spelling, fmt: Format = BINARY64) -> float | str | None:
    """Return the JSON value that spells `number`. Infinity is null (None) in every spelling."""
    if math.isinf(number):
        return None
    if spelling == "decimal":
        return number
    return number.hex() if spelling == "hex" else fmt.bits(number)


def parse(value: object, spelling: Spelling, fmt: Format = BINARY64) -> float:
    """Return the number that a JSON value spells, infinities and NaN included.

    null, "inf" and the JSON extension Infinity are read as infinity. A decimal is rounded to the
    format. Raises `ValueError` for anything else.
    """
    if value is None or value in ("inf", "Infinity"):
        return math.inf
    if isinstance(value, bool):
        raise ValueError(f"{value!r} is not a number")
    if spelling == "decimal":
        if not isinstance(value, int | float):
            raise ValueError(f"{value!r:.40} is not a JSON number")
        try:
            return fmt.nearest(float(value))
        except OverflowError:
            return math.inf if value > 0 else -math.inf
    if not isinstance(value, str):
        raise ValueError(f"{value!r:.40} is not a string in the {spelling} spelling")
    return float.fromhex(value) if spelling == "hex" else fmt.from_bits(value)
