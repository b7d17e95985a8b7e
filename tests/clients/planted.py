"""Callables for the tests of in-process targets; each finds its place in the ray's origin."""

from __future__ import annotations

import ctypes
import os
import sys
import time
from typing import Any

hello = {"name": "planted callable", "version": "3", "solids": ["cylinder", "sphere"]}


def steady(solid: Any, ray: Any) -> Any:
    n = ray.origin[0]
    return [(n, n + 1)]


def talks(solid: Any, ray: Any) -> Any:
    print("traced one")
    os.write(1, b"[[1, 2]]\n")
    assert sys.stdin.read() == ""
    return steady(solid, ray)


def crashes(solid: Any, ray: Any) -> Any:
    n = int(ray.origin[0])
    if n and n % 500 == 0:
        time.sleep(3600)
    if n and n % 100 == 0:
        ctypes.string_at(0)
    if n and n % 130 == 0:
        os._exit(7)
    if n and n % 170 == 0:
        sys.exit("enough")
    return steady(solid, ray)


def silly(solid: Any, ray: Any) -> Any:
    return "x" * 10_000_000


def endless(solid: Any, ray: Any) -> Any:
    while True:
        yield (0.0, 1.0)


def fails(solid: Any, ray: Any) -> Any:
    raise ValueError("x" * 10_000_000)


HUGE = 1 << 3_000_000


def odd(solid: Any, ray: Any) -> Any:
    n = int(ray.origin[0])
    if n % 3 == 1:
        return None
    if n % 3 == 2:
        return [(HUGE, "x")]
    return steady(solid, ray)


def refuses(solid: Any, ray: Any) -> Any:
    if int(ray.origin[0]) % 2:
        raise NotImplementedError("odd")
    raise ZeroDivisionError("float division by zero")


CALLS = [0]


def counted(solid: Any, ray: Any) -> Any:
    CALLS[0] += 1
    if CALLS[0] == 10:
        os._exit(0)
    return steady(solid, ray)


def spoils(solid: Any, ray: Any) -> Any:
    """Write into every pipe there is."""
    if ray.origin[0] == 3:
        for number in range(3, 20):
            try:
                os.write(number, b'{"x": 1}\n')
            except OSError:
                continue
    return steady(solid, ray)


def nearest(solid: Any, ray: Any) -> Any:
    return ray.origin[0] + 0.1 if ray.origin[0] else None


nearest.hello = {  # type: ignore[attr-defined]
    "name": "first",
    "answers": "first",
    "precision": "binary32",
}


class Kept:
    def __call__(self, solid: Any, ray: Any) -> Any:
        return ray.origin[0] > 0

    hello = {"name": "any", "answers": "any"}  # noqa: RUF012


kept = Kept()
number = 7


def strange(solid: Any, ray: Any) -> Any:
    return []


strange.hello = {"solids": ["cone"]}  # type: ignore[attr-defined]


def unsaid(solid: Any, ray: Any) -> Any:
    return []


unsaid.hello = {"name": b"bytes"}  # type: ignore[attr-defined]


def wordy(solid: Any, ray: Any) -> Any:
    return []


wordy.hello = "hello"  # type: ignore[attr-defined]
