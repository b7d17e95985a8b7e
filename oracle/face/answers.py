"""What a person asks of one ray and one solid, and how the answers show themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any, overload

from raycert.cases.accept import Numbers
from raycert.cases.files import TOO_DEEP, decode_json, is_shallow
from raycert.cases.formats import FORMATS, Spelling
from raycert.cases.forms import read_ray, read_solid
from raycert.cases.model import Ray, Refused, Solid
from raycert.cases.numbers import Probe
from raycert.cases.row import GoldenRow, read_row
from raycert.oracle.exact import intervals as lists
from raycert.oracle.exact import trace as exact
from raycert.oracle.exact.intervals import Interval, Intervals

if TYPE_CHECKING:
    from raycert.oracle.explain.derive import Derivation

TALL = 420
"""Pixels of a drawing in a notebook."""


@dataclass(frozen=True, slots=True)
class Trace(Sequence[Interval]):
    """The exact answer: a sequence of pairs (enter, leave), beside the solid and the ray.

    Numbers have the same list in them as points: `2 in hits` says whether the ray is inside at 2.

    >>> from raycert import Ray, Sphere
    >>> hits = trace(Sphere((0, 0, 0), 1), Ray((-2, 0, 0), (1, 0, 0)))
    >>> hits
    Trace(((Surd(1), Surd(3)),), Sphere(center=(0.0, 0.0, 0.0), radius=1.0), \
Ray(origin=(-2.0, 0.0, 0.0), direction=(1.0, 0.0, 0.0)))
    >>> len(hits), 2 in hits, 3.5 in hits, hits.rows
    (1, True, False, ('through',))
    """

    intervals: Intervals
    solid: Solid
    ray: Ray

    def __len__(self) -> int:
        """Return how many intervals there are."""
        return len(self.intervals)

    @overload
    def __getitem__(self, at: int) -> Interval: ...
    @overload
    def __getitem__(self, at: slice) -> Intervals: ...
    def __getitem__(self, at: int | slice) -> Interval | Intervals:
        """Return an interval, or some."""
        return self.intervals[at]

    def __contains__(self, t: object) -> bool:
        """Whether a number is in one of the intervals, or a pair is one of them."""
        if isinstance(t, tuple):
            return t in self.intervals
        return any(enter <= t <= leave for enter, leave in self.intervals)

    def __repr__(self) -> str:
        """Return what gives it back."""
        return f"Trace({self.intervals!r}, {self.solid!r}, {self.ray!r})"

    def __str__(self) -> str:
        """Return the intervals in closed form."""
        return ", ".join(map(_shown, self.intervals)) or "no intersection"

    @property
    def rows(self) -> tuple[str, ...]:
        """The rows of the case table that led to it."""
        return exact.trace(self.solid, self.ray).rows

    def _repr_html_(self) -> str:
        """Return the picture: ray and solid, over the intervals in t."""
        from raycert.oracle.explain.casepage import lists as drawable
        from raycert.oracle.explain.casepage import wholes

        row = _derived(self.solid, self.ray, "binary64").row
        drawn = wholes(row, drawable(row, row.accept["stable"]), ())
        body = "".join(
            f"<figure>{svg}<figcaption>{name}</figcaption></figure>" for name, svg in drawn
        )
        return f"{_framed(_styled(body), TALL * len(drawn))}<code>{escape(str(self))}</code>"


def _shown(interval: Interval) -> str:
    enter, leave = interval
    return f"[{enter}, {leave}{']' if leave.finite else ')'}"


def trace(solid: Solid, ray: Ray) -> Trace:
    """Return the exact intervals of t >= 0 for which a ray is in a solid; never refuses one.

    >>> from raycert import Cylinder, Ray
    >>> print(trace(Cylinder((0, 0, 0), (0, 0, 2), 1), Ray((-3, 0, 1), (1, 0, 0))))
    [2, 4]
    """
    return Trace(exact.trace(solid, ray).intervals, solid, ray)


def expected(solid: Solid, ray: Ray, precision: str = "binary64") -> Numbers:
    """Return the exact list in numbers of a format, `binary64` or `binary32`.

    Each end is rounded to nearest, ties to even; intervals that touch after that are merged.

    >>> from raycert import Ray, Sphere
    >>> expected(Sphere((0, 0, 0), 1), Ray((-2, 0.5, 0), (1, 0, 0)))
    ((1.1339745962155614, 2.866025403784439),)
    """
    return lists.expected(exact.trace(solid, ray).intervals, FORMATS[precision])[1]


@dataclass(frozen=True, slots=True, repr=False)
class Explanation:
    """The derivation of one case: a text where it is shown, a page with pictures in a notebook."""

    derivation: Derivation

    def __str__(self) -> str:
        """Return the derivation as `raycert explain` prints it."""
        from raycert.oracle.explain.console import show
        from raycert.oracle.reports.screen import screen

        console = screen(width=100, color_system=None, force_terminal=False)
        with console.capture() as capture:
            show(self.derivation, console, full=False)
        return capture.get()

    __repr__ = __str__

    def _repr_html_(self) -> str:
        """Return the page of the case, in a frame."""
        from raycert.oracle.explain.casepage import case_page

        return _framed(case_page(self.derivation, (), "raycert explain"), 2 * TALL)


def explain(solid: Solid, ray: Ray, precision: str = "binary64") -> Explanation:
    """Return how the answer comes about: vectors, signs, rows of the tables, ends, condition.

    >>> from raycert import Ray, Sphere
    >>> print(str(explain(Sphere((0, 0, 0), 1), Ray((-2, 0, 0), (1, 0, 0)))).splitlines()[0])
    solid  sphere  center (0, 0, 0)  radius 1
    """
    return Explanation(_derived(solid, ray, precision))


def _derived(solid: Solid, ray: Ray, precision: str) -> Derivation:
    from raycert.oracle.explain.derive import derive, given

    return derive(given(solid, ray), FORMATS[precision])


def read(form: str | bytes | Mapping[str, Any], precision: str = "binary64") -> Any:
    """Return what a JSON object, or its text, describes; `Refused` names what is wrong in it.

    A solid has a `type`, a ray an `origin`; a case has a `solid` and a `ray`, and is returned as
    that pair; a golden row, as `raycert show ID --json -` prints it, has its answer too. Numbers
    are all JSON numbers or all hex floats.

    >>> read('{"type": "sphere", "center": [0, 0, 0], "radius": 0.5}')
    Sphere(center=(0.0, 0.0, 0.0), radius=0.5)
    """
    try:
        given = decode_json(form) if isinstance(form, str | bytes) else form
    except ValueError as error:
        raise Refused("", str(error)) from None
    if not is_shallow(given):
        raise Refused("", TOO_DEEP)
    if not isinstance(given, Mapping):
        raise Refused("", f"is not an object: {given!r:.40}")
    fmt, spelling = FORMATS[precision], _spelling(given)
    if "accept" in given:
        row: GoldenRow = read_row(given, fmt)
        return row
    if "solid" in given:
        solid = read_solid(given["solid"], "solid", spelling, fmt)
        return Probe(solid, read_ray(given.get("ray"), "ray", spelling, fmt))
    if "origin" in given:
        return read_ray(given, "ray", spelling, fmt)
    return read_solid(given, "solid", spelling, fmt)


def _spelling(form: object) -> Spelling:
    """Return how the numbers are spelled: as strings in hex, or as numbers."""
    return "hex" if any("0x" in text for text in _texts(form)) else "decimal"


def _texts(form: object) -> Iterator[str]:
    if isinstance(form, str):
        yield form
    elif isinstance(form, Mapping | list):
        for part in form.values() if isinstance(form, Mapping) else form:
            yield from _texts(part)


def _styled(body: str) -> str:
    """Return a page with the style of the reports."""
    from importlib.resources import files

    style = (files("raycert.oracle.reports") / "page.css").read_text("utf-8")
    return f"<!doctype html><meta charset=utf-8><style>{style}</style>{body}"


def _framed(page: str, tall: int) -> str:
    """Return a page in a frame of its own, so that its style is not the notebook's."""
    return (
        f'<iframe sandbox style="width: 100%; height: {tall}px; border: 0" '
        f'srcdoc="{escape(page)}"></iframe>'
    )
