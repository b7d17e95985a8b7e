"""A batch of questions as bytes and back: how they travel to a worker, cheaply.

The generic pickle of a solid takes ten times as long as the question, and so would checking again
what was checked when the solid was made. So: tuples of numbers there, and bare slots filled here.
Bytes of others are not for this module.
"""

from __future__ import annotations

import pickle
from collections.abc import Iterable, Iterator
from dataclasses import fields
from typing import Any, TypeVar

from raycert.cases.model import SOLIDS, Ray, Solid, Tree

Form = tuple[Any, ...]
KINDS = tuple(SOLIDS.values())
NUMBER = {kind: number for number, kind in enumerate(KINDS)}
NAMES = {kind: tuple(field.name for field in fields(kind)) for kind in (*KINDS, Ray)}
SETTERS: dict[type, tuple[Any, ...]] = {
    kind: tuple(getattr(kind, name).__set__ for name in names) for kind, names in NAMES.items()
}
"""What fills the slots of a frozen instance."""


def write_batch(questions: Iterable[tuple[Solid, Ray]]) -> bytes:
    """Return questions as bytes."""
    forms = [(_plain(solid), ray.origin, ray.direction) for solid, ray in questions]
    return pickle.dumps(forms, -1)


def read_batch(data: bytes) -> Iterator[tuple[Solid, Ray]]:
    """Yield the questions of a batch."""
    for solid, origin, direction in pickle.loads(data):
        yield _whole(solid), _filled(Ray, (origin, direction))


def _plain(solid: Solid) -> Form:
    kind = type(solid)
    if isinstance(solid, Tree):
        return NUMBER[kind], tuple([_plain(part) for part in solid.of])
    return NUMBER[kind], *[getattr(solid, name) for name in NAMES[kind]]


def _whole(form: Form) -> Solid:
    kind = KINDS[form[0]]
    if issubclass(kind, Tree):
        return _filled(kind, (tuple([_whole(part) for part in form[1]]),))
    return _filled(kind, form[1:])


T = TypeVar("T")


def _filled(kind: type[T], values: Form) -> T:
    """Return an instance with these fields, none of them checked."""
    instance: T = object.__new__(kind)
    for put, value in zip(SETTERS[kind], values, strict=True):
        put(instance, value)
    return instance
