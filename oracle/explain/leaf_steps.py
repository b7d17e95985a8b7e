"""The derivation of one leaf, problem by problem as in cases/README.md.

The vectors and products are computed here, in fractions straight from the inputs; the rows taken
are those of `exact.trace`, and so are the signs that decided them. Nothing is normalised: what
the problems divide by |w| or |w|^2 is shown before that division, which changes no sign.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from raycert.cases.model import (
    Cylinder,
    HalfSpace,
    InfiniteCylinder,
    Leaf,
    Ray,
    Slab,
    Sphere,
    Vector,
)
from raycert.cases.table import HALF_SPACE, PROBLEM_1, PROBLEM_2, PROBLEM_3, Row
from raycert.cases.vectors import cross, dot, minus
from raycert.oracle.exact.grid import Grid
from raycert.oracle.exact.leaf import Plane, Quadric, ball, caps, half_space, plane_signs, wall
from raycert.oracle.exact.surd import sign
from raycert.oracle.exact.trace import Decision, solve_leaf
from raycert.oracle.explain.wording import (
    Exact,
    Fact,
    Note,
    Passage,
    listed,
    number,
    row_table,
    scalar,
    vector,
)

CURVED = {"inside": "r^2-|ybar|^2", "vv": "|vbar|^2", "disc": "disc", "t1": "t1", "t2": "t2"}
ROUND = CURVED | {"inside": "r^2-|y|^2", "vv": "|v|^2"}
FLAT = {"up": "(u-p).n", "uq": "(u-q).n", "vn": "v.n"}
BOTH = {"pairs_1": "pairs of 1", "pairs_2": "pairs of 2", "m-n": "m - n"}


def exact(x: Vector) -> Exact:
    return (Fraction(x[0]), Fraction(x[1]), Fraction(x[2]))


def leaf_steps(leaf: Leaf, ray: Ray) -> Iterator[Passage]:
    grid, decisions = Grid.of(leaf, ray), list[Decision]()
    solve_leaf(leaf, grid, "", decisions)
    match leaf:
        case HalfSpace():
            yield _half_space(leaf, ray, grid, decisions[0])
        case Sphere():
            yield _sphere(leaf, ray, grid, decisions[0])
        case Slab():
            yield _axis(leaf, ray)
            yield _slab(leaf, ray, grid, decisions[0])
        case InfiniteCylinder():
            yield _axis(leaf, ray)
            yield _wall(leaf, ray, grid, decisions[0])
        case Cylinder():
            yield _axis(leaf, ray)
            yield _wall(leaf, ray, grid, decisions[0])
            yield _slab(leaf, ray, grid, decisions[1])
            yield _both(leaf, grid, decisions)


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
    known = ("{(t1, t2)}", "{(0, t2)}", "{(0, inf)}")
    pairs = decision.row.pairs
    pair = f"(a, b) = {pairs.strip('{}')}" if pairs in known else "no pair"
    return Passage(heading, (*facts, *ends, table, _emits(decision.row, pair)))


def _emits(row: Row, pair: str) -> Note:
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
    return Passage(
        "Problem 2, the slab between the planes through p and q",
        (*facts, table, _slab_pair(decision.row)),
    )


def _slab_pair(row: Row) -> Note:
    return _emits(row, f"(c, d) = {row.pairs.strip('{}')}" if row.pairs != "{}" else "no pair")


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
    return Passage(
        "Problem 2 (c), one plane: (x - p) . n <= 0", (*facts, table, _slab_pair(decision.row))
    )


def _both(leaf: Cylinder, grid: Grid, decisions: list[Decision]) -> Passage:
    """Problem 3: a ? c, b ? d, m ? n."""
    aside = list[Decision]()
    one = solve_leaf(InfiniteCylinder(leaf.p, leaf.q, leaf.radius), grid, "", aside)
    two = solve_leaf(Slab(leaf.p, leaf.q), grid, "", aside)
    last = decisions[2]
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
    return Passage("Problem 3, in both", (*lines, table, _emits(last.row, pair)))
