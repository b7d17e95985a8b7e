"""The rays of a camera, tile by tile: the formula of `raycert.cases.scene`, to the bit.

A tile is a square of pixels, so that its rays are near each other: what one of them misses, all
of them mostly miss.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from raycert.cases.model import Vector
from raycert.cases.scene import Frame
from raycert.reference.arrays.vectors import Array, Vectors, Whole

SIDE = 64
"""Pixels along a side of a tile: 4096 lanes, whose arrays fit in a cache."""


class Tile(NamedTuple):
    """The pixels in columns [left, right) and rows [top, bottom)."""

    left: int
    right: int
    top: int
    bottom: int

    @property
    def lanes(self) -> int:
        """Return the number of pixels."""
        return (self.right - self.left) * (self.bottom - self.top)

    def pixels(self, width: int) -> Whole:
        """Return the index of each pixel in the picture, row by row."""
        rows, columns = np.arange(self.top, self.bottom), np.arange(self.left, self.right)
        return (rows[:, None] * width + columns).ravel()

    def corners(self) -> list[tuple[int, int]]:
        """Return (column, row) of the outermost pixels, around the tile."""
        right, bottom = self.right - 1, self.bottom - 1
        return [(self.left, self.top), (right, self.top), (right, bottom), (self.left, bottom)]


def tiles(size: tuple[int, int], side: int) -> list[Tile]:
    """Return the tiles of a picture, row by row."""
    width, height = size
    return [
        Tile(left, min(left + side, width), top, min(top + side, height))
        for top in range(0, height, side)
        for left in range(0, width, side)
    ]


def rays(frame: Frame, size: tuple[int, int], tile: Tile) -> tuple[Vectors, Vectors]:
    """Return origins and directions of a tile's pixels; what all share has length 1."""
    width, height = size
    columns, rows = np.arange(tile.left, tile.right), np.arange(tile.top, tile.bottom)
    a = (2 * columns + 1 - width) / height * frame.scale
    b = (height - 1 - 2 * rows) / height * frame.scale
    if frame.kind == "perspective":
        return _shared(frame.eye), _spread(frame.forward, frame, a, b)
    return _spread(frame.eye, frame, a, b), _shared(frame.forward)


def widened(a: Vectors, lanes: int) -> Vectors:
    """Return a shared vector lane by lane."""
    x, y, z = (None if c is None else np.repeat(c, lanes // c.size) for c in a)
    return x, y, z


def _shared(a: Vector) -> Vectors:
    x, y, z = (np.array([c], float) for c in a)
    return x, y, z


def _spread(base: Vector, frame: Frame, a: Array, b: Array) -> Vectors:
    x, y, z = (
        (c + a[None, :] * r + b[:, None] * t).ravel()
        for c, r, t in zip(base, frame.right, frame.top, strict=True)
    )
    return x, y, z
