"""The derivation of one case with this case's numbers, as data; and a golden row as it stands.

A leaf goes through its vectors, Problem 1, Problem 2 and Problem 3, as in cases/README.md; a tree
through each leaf by path and then through the algebra of lists. Then come the exact endpoints in
every form, and how answers measure there. Everything is computed anew; nothing is taken from a
file. Only `row_passages` says what a row of a file holds, with nothing computed.

The vectors and products are computed here, in fractions straight from the inputs; the rows taken
are those of `exact.trace`, and so are the signs that decided them. Nothing is normalised: what
the problems divide by |w| or |w|^2 is shown before that division, which changes no sign.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from math import isinf, log2
from typing import Any

from raycert.cases.accept import Pairs
from raycert.cases.case import Case, Family
from raycert.cases.flags import FLAGS
from raycert.cases.formats import Format
from raycert.cases.lattice import is_lattice
from raycert.cases.levels import LEVELS
from raycert.cases.model import (
    Cylinder,
    Difference,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Slab,
    Solid,
    Sphere,
    Tree,
    Union,
    Vector,
    leaves,
    type_of,
)
from raycert.cases.row import End, GoldenRow, write_row
from raycert.cases.table import HALF_SPACE, PROBLEM_1, PROBLEM_2, PROBLEM_3, Row
from raycert.cases.vectors import cross, dot, minus
from raycert.oracle.corpus.golden import golden_row
from raycert.oracle.exact.condition import kappa
from raycert.oracle.exact.grid import Grid
from raycert.oracle.exact.intervals import Intervals
from raycert.oracle.exact.leaf import Plane, Quadric, ball, caps, half_space, plane_signs, wall
from raycert.oracle.exact.surd import Surd, decimal, sign
from raycert.oracle.exact.trace import Decision, combine, solve_leaf
from raycert.oracle.explain.wording import (
    Exact,
    Fact,
    Note,
    Passage,
    accepting,
    as_json,
    brief,
    enclosing,
    endpoint,
    listed,
    number,
    numbers,
    row_table,
    scalar,
    tidy,
    vector,
)
from raycert.oracle.judge.levels import Judge
from raycert.oracle.zoo.textbook import textbook

POWERS = ("", " t", " t^2")


@dataclass(frozen=True, slots=True)
class Derivation:
    """A case as its golden row is or would be, and the passages that lead to it."""

    row: GoldenRow
    format: Format
    steps: tuple[Passage, ...]


def derive(case: Case, fmt: Format, family: str = "given") -> Derivation:
    row = golden_row(Family(family, "", lambda _: ()), case, fmt)
    judge = Judge(case.solid, case.ray, fmt, case.tier)
    answers = (*_answers(row, judge), judgement(row, judge))
    return Derivation(row, fmt, (*solid_steps(case.solid, case.ray), *answers))


def given(solid: Solid, ray: Ray) -> Case:
    """Return the case of a solid and a ray that come from no family."""
    return Case(type_of(solid), "", solid, ray, "lattice" if is_lattice(solid, ray) else "generic")


def as_given(row: GoldenRow) -> Case:
    slug = row.id.partition("/")[2]
    return Case(slug, row.why, row.solid, row.ray, row.tier, row.flags, row.source)


def to_json(derivation: Derivation) -> dict[str, Any]:
    """Return the derivation as a JSON object: the whole golden row, and the steps."""
    steps = [as_json(passage) for passage in derivation.steps]
    return {"row": write_row(derivation.row, derivation.format), "steps": steps}


def solid_steps(solid: Solid, ray: Ray) -> Iterator[Passage]:
    if not isinstance(solid, Tree):
        yield from leaf_steps(solid, ray)
        return
    for path, leaf in leaves(solid):
        for passage in leaf_steps(leaf, ray):
            yield replace(passage, heading=f"{path} ({type_of(leaf)}): {passage.heading}")
    facts: list[Fact | Note] = []
    _lists(solid, Grid.of(solid, ray), "", facts)
    yield Passage("The lists of the tree, from the leaves up", tuple(facts))


def _lists(solid: Solid, grid: Grid, path: str, facts: list[Fact | Note]) -> Intervals:
    """Return the list of a node, after adding a fact for each node below it and for itself."""
    if not isinstance(solid, Tree):
        found = solve_leaf(solid, grid, path, [])
        facts.append(Fact(path, listed(found), note=type_of(solid)))
        return found
    paths = [f"{path}.of[{i}]" if path else f"of[{i}]" for i in range(len(solid.of))]
    lists = [_lists(part, grid, at, facts) for part, at in zip(solid.of, paths, strict=True)]
    found = combine(solid, lists)
    facts.append(Fact(path or "the solid", listed(found), note=_words(solid, paths)))
    return found


def _words(tree: Tree, paths: list[str]) -> str:
    if isinstance(tree, Difference):
        return paths[0] + (f", less {' and '.join(paths[1:])}" if paths[1:] else "")
    return (" or " if isinstance(tree, Union) else " and ").join(paths)


def _answers(row: GoldenRow, judge: Judge) -> Iterator[Passage]:
    """Yield a passage for each endpoint of the exact list; one sentence where there is none."""
    if not row.intervals:
        yield Passage("Answer: no pair", (Note("The ray is never in the solid."),))
    for i, (span, interval) in enumerate(zip(row.intervals, judge.exact, strict=True), 1):
        count = f"Answer {i} of {len(row.intervals)}" if len(row.intervals) > 1 else "Answer"
        pair = numbers([(span.enter.nearest, span.leave.nearest)], judge.format)
        touch = f", a touch ({span.touch})" if span.touch else ""
        ends = [("enter", span.enter, interval[0]), ("leave", span.leave, interval[1])]
        if interval[0] == interval[1]:
            ends = [("t", span.enter, interval[0])]
        lines = [fact for end in ends for fact in end_facts(*end, judge)]
        yield Passage(f"{count}: {pair}{touch}", tuple(lines))


def end_facts(name: str, end: End, t: Surd, judge: Judge) -> tuple[Fact, ...]:
    """Return one endpoint: exactly, in digits and numbers, where it lies, and its condition."""
    faces = ", ".join(end.faces) or "no face"
    place = Fact("  on", faces, note=end.kind)
    if not t.finite:
        return (Fact(name, "inf", note="the ray never leaves"),)
    exact = Fact(name, endpoint(t))
    if t.sign() == 0:
        return (exact, place)
    digits = () if t.rational() and len(exact.value) < 12 else (Fact("  digits", tidy(end.digits)),)
    bounds = enclosing(end.down, end.up, end.nearest, judge.format)
    return (exact, *digits, *bounds, place, _condition(t, judge))


def _condition(t: Surd, judge: Judge) -> Fact:
    size = kappa(t, judge.solid, judge.ray)
    if not size.finite:
        return Fact("  condition", "infinite", note="a double root: an error e moves it by sqrt(e)")
    if not size.sign():
        return Fact("  condition", "0", note="no input moves it")
    return Fact("  condition", brief(size, 7), note=f"2^{_log2(size):.1f}")


def _log2(v: Surd) -> float:
    """Return log2 of a number > 0 of any size, for people."""
    digits, _, power = decimal(v, 17).partition("e")
    return log2(float(digits)) + int(power) * log2(10)


def judgement(row: GoldenRow, judge: Judge) -> Passage:
    """Return what is measured here: two answers, the levels decided, the lists that accept."""
    lines = (
        *_measured("rounded", judge.expected, judge, "each exact end to nearest"),
        *_measured("textbook", textbook(judge.solid, judge.ray, judge.format), judge),
        Fact("decisive for", ", ".join(row.decisive) or "no level"),
        *accepting("sound", row.accept["sound"], judge.format),
        *accepting("stable", row.accept["stable"], judge.format),
    )
    return Passage("Measured", lines)


def _measured(name: str, answer: Pairs, judge: Judge, note: str = "") -> Iterator[Fact]:
    """Yield an answer, its forward and backward errors, and the levels it holds here."""
    yield Fact(name, numbers(answer, judge.format), note=note)
    if wrong := judge.malformed(answer):
        yield Fact("", f"not well-formed: {wrong}")
        return
    forward = judge.forward_error(answer)
    error = "infinite" if isinf(forward) else f"{forward:.3g} ulps"
    error = error if len(answer) == len(judge.expected) else "another number of pairs"
    k = [_k(judge.backward_error(answer, measure)) for measure in ("strict", "squared")]
    yield Fact("", f"error {error}; backward error k {k[0]} strict, {k[1]} squared")
    held = [level for level in LEVELS if judge.holds(level, answer)]
    yield Fact("", f"holds {', '.join(held)}" if held else "holds no level")


def _k(k: float) -> str:
    if isinf(k):
        return "infinite"
    return "1/16" if k <= 1 / 16 else f"{k:.2g}"


def row_passages(row: GoldenRow, fmt: Format) -> Iterator[Passage]:
    yield Passage("Row", tuple(_row_facts(row)))
    for i, span in enumerate(row.intervals, 1):
        touch = f", a touch ({span.touch})" if span.touch else ""
        enter, leave = _stored("enter", span.enter, fmt), _stored("leave", span.leave, fmt)
        yield Passage(f"Exact interval {i} of {len(row.intervals)}{touch}", (*enter, *leave))
    lists = [fact for level in row.accept for fact in accepting(level, row.accept[level], fmt)]
    yield Passage("Lists", (Fact("expected", numbers(row.expected, fmt)), *lists))


def _row_facts(row: GoldenRow) -> Iterator[Fact]:
    yield Fact("rows", " ".join(row.rows))
    size = "infinite, or t = 0 only" if row.condition is None else f"<= 2^{row.condition}"
    yield Fact("condition", size)
    yield Fact("decisive for", ", ".join(row.decisive) or "no level")
    for name in row.flags:
        yield Fact(f"flag {name}", FLAGS[name].trouble if name in FLAGS else "not in the legend")


def _stored(name: str, end: End, fmt: Format) -> Iterator[Fact]:
    if end.polynomial is None and end.fraction is None:
        yield Fact(name, "inf")
        return
    yield Fact(name, _exactly(end))
    yield Fact("  digits", tidy(end.digits))
    yield from enclosing(end.down, end.up, end.nearest, fmt)
    yield Fact("  on", ", ".join(end.faces) or "no face", note=end.kind)


def _exactly(end: End) -> str:
    """Return an endpoint as the row has it: a fraction, or which root of a polynomial."""
    if end.fraction:
        top, bottom = end.fraction
        return str(top) if bottom == 1 else f"{top}/{bottom}"
    coefficients = end.polynomial or ()
    degree = len(coefficients) - 1
    terms = [
        f"{'-' if c < 0 else '+'} {'' if abs(c) == 1 and degree - i else abs(c)}"
        f"{POWERS[degree - i] if abs(c) != 1 else POWERS[degree - i].strip()}"
        for i, c in enumerate(coefficients)
        if c
    ]
    which = "larger" if end.root else "smaller"
    return f"the {which} root of {' '.join(terms).removeprefix('+ ')}"


CURVED = {"inside": "r^2-|ybar|^2", "vv": "|vbar|^2", "disc": "disc", "t1": "t1", "t2": "t2"}
ROUND = CURVED | {"inside": "r^2-|y|^2", "vv": "|v|^2"}
FLAT = {"up": "(u-p).n", "uq": "(u-q).n", "vn": "v.n"}
BOTH = {"pairs_1": "pairs of 1", "pairs_2": "pairs of 2", "m-n": "m - n"}


def exact(x: Vector) -> Exact:
    return (Fraction(x[0]), Fraction(x[1]), Fraction(x[2]))


def leaf_steps(leaf: Leaf, ray: Ray) -> Iterator[Passage]:
    grid, decisions = Grid.of(leaf, ray), list[Decision]()
    solve_leaf(leaf, grid, "", decisions)
    if isinstance(leaf, HalfSpace):
        yield _half_space(leaf, ray, grid, decisions[0])
    elif isinstance(leaf, Sphere):
        yield _sphere(leaf, ray, grid, decisions[0])
    else:
        yield _axis(leaf, ray)
        if isinstance(leaf, InfiniteCylinder | Cylinder):
            yield _wall(leaf, ray, grid, decisions[0])
        if isinstance(leaf, Slab | Cylinder):
            yield _slab(leaf, ray, grid, decisions[isinstance(leaf, Cylinder)])
        if isinstance(leaf, Cylinder):
            yield _both(leaf, grid, decisions[2])


def _axis(leaf: Slab | InfiniteCylinder | Cylinder, ray: Ray) -> Passage:
    p, u, v = exact(leaf.p), exact(ray.origin), exact(ray.direction)
    w = minus(exact(leaf.q), p)
    square = scalar("|w|^2", dot(w, w), sign=False)
    if isinstance(leaf, Slab):
        return Passage("Vectors", (vector("w = q - p", w), square, *_remarks(ray)))
    y = minus(u, p)
    across = cross(v, w)
    lines = (
        vector("w = q - p", w),
        vector("y = u - p", y),
        square,
        vector("v x w", across, "= |w| vbar"),
        vector("y x w", cross(y, w), "= |w| ybar"),
    )
    parallel = not any(across) and any(v)
    aside = (Note("v x w = 0: the ray is parallel to the axis."),) if parallel else ()
    return Passage("Vectors", (*lines, *_remarks(ray), *aside))


def _remarks(ray: Ray) -> tuple[Note, ...]:
    if any(ray.direction):
        return ()
    return (Note("v = 0: the ray stays at its origin, inside for every t or for none."),)


def _wall(leaf: InfiniteCylinder | Cylinder, ray: Ray, grid: Grid, decision: Decision) -> Passage:
    p, u, v = exact(leaf.p), exact(ray.origin), exact(ray.direction)
    w = minus(exact(leaf.q), p)
    y, square, r = minus(u, p), dot(w, w), Fraction(leaf.radius)
    vw, yw = cross(v, w), cross(y, w)
    volume = dot(cross(v, w), y)
    vv, vy = dot(vw, vw), dot(vw, yw)
    facts = (
        Note("disc = r^2 |vbar|^2 - |vbar x ybar|^2. The four products are times |w|^2."),
        scalar("|vbar|^2", vv),
        scalar("vbar . ybar", vy),
        scalar("r^2 - |ybar|^2", r * r * square - dot(yw, yw)),
        scalar("disc", r * r * vv - volume * volume),
    )
    heading = "Problem 1, the infinite cylinder: |ybar + t vbar| <= r"
    return _curved(heading, facts, wall(leaf, grid), grid, decision, CURVED, "vbar . ybar")


def _sphere(leaf: Sphere, ray: Ray, grid: Grid, decision: Decision) -> Passage:
    v, r = exact(ray.direction), Fraction(leaf.radius)
    y = minus(exact(ray.origin), exact(leaf.center))
    turned = cross(v, y)
    facts: tuple[Fact | Note, ...] = (
        vector("y = u - center", y),
        Note("disc = r^2 |v|^2 - |v x y|^2"),
        scalar("|v|^2", dot(v, v)),
        scalar("v . y", dot(v, y)),
        scalar("r^2 - |y|^2", r * r - dot(y, y)),
        scalar("disc", r * r * dot(v, v) - dot(turned, turned)),
        *_remarks(ray),
    )
    heading = "Sphere, by the rows of Problem 1: |y + t v| <= r"
    return _curved(heading, facts, ball(leaf, grid), grid, decision, ROUND, "v . y")


def _curved(
    heading: str,
    facts: tuple[Fact | Note, ...],
    face: Quadric,
    grid: Grid,
    decision: Decision,
    names: dict[str, str],
    product: str,
) -> Passage:
    """Return the table of Problem 1; t1 and t2 are defined where nothing divides by zero."""
    signs = {"vv": sign(face.a), "inside": -sign(face.c), "disc": sign(face.disc)}
    ends: tuple[Fact, ...] = ()
    if face.a and face.disc >= 0:
        t1, t2 = face.roots(grid, face.disc)
        signs |= {"t1": t1.sign(), "t2": t2.sign()}
        root = f"(-{product} -+ sqrt(disc)) / {names['vv']}"
        ends = (number("t1", t1, note=root), number("t2", t2))
        if t1 == t2:
            ends = (number("t1 = t2", t1, note="a double root: the ray is tangent"),)
    table = row_table(PROBLEM_1, names, signs | dict(decision.signs), decision.row)
    return Passage(heading, (*facts, *ends, table, _emits(decision.row, "(a, b)")))


def _emits(row: Row, name: str) -> Note:
    pair = "no pair" if row.pairs == "{}" else f"{name} = {row.pairs.strip('{}')}"
    return Note(f"Row {row.name}, Problem {row.parts}: {pair}")


def _slab(leaf: Slab | Cylinder, ray: Ray, grid: Grid, decision: Decision) -> Passage:
    p, q, u, v = (exact(x) for x in (leaf.p, leaf.q, ray.origin, ray.direction))
    n = minus(p, q)
    faces = caps(leaf, grid)
    facts = (
        Note("n = (p - q) / |w|, the outward normal at p. The products are times |w|."),
        scalar("(u - p) . n", dot(minus(u, p), n)),
        scalar("(u - q) . n", dot(minus(u, q), n)),
        scalar("v . n", dot(v, n)),
        *_crossings((("tp", "(u - p)", faces[0]), ("tq", "(u - q)", faces[1])), grid),
    )
    signs = plane_signs(*faces) | dict(decision.signs)
    table = row_table(PROBLEM_2, FLAT, signs, decision.row)
    heading = "Problem 2, the slab between the planes through p and q"
    return Passage(heading, (*facts, table, _emits(decision.row, "(c, d)")))


def _crossings(planes: tuple[tuple[str, str, Plane], ...], grid: Grid) -> Iterator[Fact | Note]:
    if not planes[0][2].b:
        yield Note("v . n = 0: the ray keeps its distance from the planes.")
        return
    for name, from_plane, face in planes:
        yield number(name, face.crossing(grid), note=f"-{from_plane}.n / v.n")


def _half_space(leaf: HalfSpace, ray: Ray, grid: Grid, decision: Decision) -> Passage:
    n, v = exact(leaf.normal), exact(ray.direction)
    away = minus(exact(ray.origin), exact(leaf.point))
    face = half_space(leaf, grid)
    facts = (
        Note("n is the outward normal, of any length."),
        vector("u - p", away),
        scalar("(u - p) . n", dot(away, n)),
        scalar("v . n", dot(v, n)),
        *_crossings((("tp", "(u - p)", face),), grid),
        *_remarks(ray),
    )
    signs = {"up": sign(face.c), "vn": sign(face.b)} | dict(decision.signs)
    table = row_table(HALF_SPACE, FLAT, signs, decision.row)
    heading = "Problem 2 (c), one plane: (x - p) . n <= 0"
    return Passage(heading, (*facts, table, _emits(decision.row, "(c, d)")))


def _both(leaf: Cylinder, grid: Grid, last: Decision) -> Passage:
    """Problem 3: a ? c, b ? d, m ? n."""
    aside = list[Decision]()
    one = solve_leaf(InfiniteCylinder(leaf.p, leaf.q, leaf.radius), grid, "", aside)
    two = solve_leaf(Slab(leaf.p, leaf.q), grid, "", aside)
    lines = [Fact("(a, b)", listed(one)), Fact("(c, d)", listed(two))]
    if one and two:
        signs = dict(last.signs)
        ac, bd, mn = ("<=>"[1 + signs[name]] for name in ("a-c", "b-d", "m-n"))
        m, n = ("a" if ac == ">" else "c"), ("b" if bd == "<" else "d")
        lines += [
            Fact(f"a {ac} c", f"m = max(a, c) = {m}"),
            Fact(f"b {bd} d", f"n = min(b, d) = {n}"),
            Fact(f"m {mn} n", f"{m} {mn} {n}"),
        ]
    table = row_table(PROBLEM_3, BOTH, dict(last.signs), last.row)
    pair = {"meet": "(m, n)", "apart": "no pair, as m > n"}.get(last.row.name, "no pair")
    emits = Note(f"Row {last.row.name}, Problem {last.row.parts}: {pair}")
    return Passage("Problem 3, in both", (*lines, table, emits))
