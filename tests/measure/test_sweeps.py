"""Sweeps: from where to where, the same rays for a seed, and the parameter that they claim."""

from __future__ import annotations

from fractions import Fraction

import pytest

from raycert.cases.families.frames import ON_Z
from raycert.cases.families.sketch import rod, ten, two
from raycert.cases.model import Cylinder, Difference, InfiniteCylinder, Ray, Refused
from raycert.oracle.exact.surd import Surd, enclose, fraction
from raycert.oracle.exact.trace import trace
from raycert.oracle.measure.causes import first_leaf, nearest
from raycert.oracle.measure.sweeps import (
    SWEEPS,
    Sample,
    Sweep,
    before,
    disc,
    draw,
    frame_of,
    heading,
    root,
)

each = pytest.mark.parametrize("sweep", SWEEPS.values(), ids=lambda sweep: sweep.name)
ENDS = {
    "far": (ten(0), ten(16)),
    "displaced": (ten(0), ten(15)),
    "thin": (ten(-15), ten(15)),
    "tilt-wall": (ten(0), ten(-17)),
    "tilt-axis": (ten(0), ten(-17)),
    "gap-inside": (two(0), two(-53)),
    "gap-outside": (two(0), two(-53)),
    "start": (two(0), Fraction(0)),
    "faces": (two(0), Fraction(0)),
    "speed": (two(-1000), two(1000)),
    "scale": (two(-1000), two(1000)),
    "hard": (two(-20), two(-1000)),
}


@each
def test_a_sweep_goes_from_end_to_end(sweep: Sweep) -> None:
    assert (sweep.steps[0], sweep.steps[-1]) == ENDS[sweep.name]
    assert sweep.mild in sweep.steps
    assert len({sweep.text(x) for x in sweep.steps}) == len(sweep.steps)


@each
def test_fewer_steps_keep_the_mild_one_and_the_ends(sweep: Sweep) -> None:
    few = sweep.coarse(3)
    assert {sweep.steps[0], sweep.steps[-1], sweep.mild} <= set(few) <= set(sweep.steps)
    assert len(few) < len(sweep.steps)
    assert sweep.coarse(1) == sweep.steps


@each
def test_the_same_seed_gives_the_same_rays(sweep: Sweep) -> None:
    x = sweep.steps[len(sweep.steps) // 2]
    samples = sweep.samples(x, 1, 2)
    assert samples == sweep.samples(x, 1, 2)
    assert samples[:1] == sweep.samples(x, 1, 1)[:1]
    assert samples != sweep.samples(x, 2, 2)
    assert len(samples) == 2 * sweep.weight


@each
def test_every_step_has_a_question(sweep: Sweep) -> None:
    for x in sweep.coarse(5):
        assert all(sample.referee() for sample in sweep.samples(x, 1, 4))


def test_the_rays_of_a_seed_are_known_to_the_bit() -> None:
    _, ray = SWEEPS["far"].samples(ten(6), 1, 2)[1].posed()
    assert [x.hex() for x in ray.origin] == [
        "-0x1.f311bde6a16d3p+19",
        "0x1.286f55f18872ep+19",
        "0x1.59b3ee3ed83e2p+22",
    ]


def across(sample: Sample) -> tuple[Fraction, Fraction]:
    """Return the squares of the distance of line and axis, and of the radius."""
    t = nearest(sample)
    assert t is not None
    x, y = (Fraction(sample.origin[i]) + t * sample.direction[i] for i in (0, 1))
    return x * x + y * y, Fraction(first_leaf(sample.shape).radius) ** 2


@pytest.mark.parametrize("x", [two(-4), two(-40), two(-52), two(-53)])
def test_the_gap_to_tangency_is_exact_in_doubles(x: Fraction) -> None:
    for name, sign in (("gap-inside", -1), ("gap-outside", 1)):
        for sample in SWEEPS[name].samples(x, 1, 8):
            offset, square = across(sample)
            assert offset / square in ((1 + sign * x) ** 2, 1 / (1 - x) ** 2)
            cylinder, ray = sample.posed()
            assert isinstance(cylinder, Cylinder)
            wall = InfiniteCylinder(cylinder.p, cylinder.q, cylinder.radius)
            line = Ray(
                tuple(a - 64 * b for a, b in zip(ray.origin, ray.direction, strict=True)),
                ray.direction,
            )
            assert bool(trace(wall, line).intervals) == (sign < 0)


def test_far_starts_are_far_and_still_hit() -> None:
    for k in (0, 4, 8, 12):
        for sample in SWEEPS["far"].samples(ten(k), 1, 6):
            solid, ray = sample.posed()
            assert trace(solid, ray).intervals
            reach = sum(Fraction(x) ** 2 for x in sample.origin)
            size = Fraction(first_leaf(sample.shape).radius) ** 2
            assert not k or Fraction(9, 10) < reach / size / ten(k) ** 2 < Fraction(11, 10)


def test_tilts_are_tilts() -> None:
    for name in ("tilt-wall", "tilt-axis"):
        for sample in SWEEPS[name].samples(ten(-9), 1, 8):
            x, y, z = map(Fraction, sample.direction)
            assert abs(z) == 1
            assert 1 <= (x * x + y * y) / ten(-18) <= Fraction(9, 8)


def test_scales_and_speeds_are_powers_of_two_of_the_mild_scene() -> None:
    for name in ("speed", "scale"):
        sweep = SWEEPS[name]
        pairs = zip(sweep.samples(two(0), 1, 4), sweep.samples(two(300), 1, 4), strict=True)
        for mild, large in pairs:
            (solid, ray), (other, fast) = mild.posed(), large.posed()
            if name == "speed":
                assert solid == other
                assert fast.origin == ray.origin
                assert fast.direction == scaled(ray.direction)
            else:
                assert fast == Ray(scaled(ray.origin), scaled(ray.direction))


def scaled(x: tuple[float, float, float]) -> tuple[float, float, float]:
    return (x[0] * 2.0**300, x[1] * 2.0**300, x[2] * 2.0**300)


def test_shells_are_as_thin_as_they_say() -> None:
    for x in (two(-30), two(-53), Fraction(0)):
        shells = [s.posed()[0] for s in SWEEPS["faces"].samples(x, 1, 6)]
        for shell in (shell for shell in shells if isinstance(shell, Difference)):
            outer, inner = (Fraction(part.radius) for part in shell.of)  # type: ignore[union-attr]
            assert abs((outer - inner) / outer - x) <= two(-52)


def fraction_surd(number: Fraction) -> Surd:
    return fraction(number.numerator, number.denominator)


def test_hard_ends_lie_as_near_to_a_tie_as_they_say() -> None:
    for x in (two(-80), two(-1000)):
        for sample in SWEEPS["hard"].samples(x, 1, 3):
            referee = sample.referee()
            assert referee is not None
            for t in referee.exact[0]:
                around = enclose(t, referee.format)
                tie = (Fraction(around.down) + Fraction(around.up)) / 2
                near, far = (fraction_surd(tie - x / n) for n in (32, 1))
                assert far < t < fraction_surd(tie + x)
                assert not near < t < fraction_surd(tie + x / 32)


@pytest.mark.parametrize("number", [2, 10**40, Fraction(2, 3), Fraction(1, 10**700), 10**900])
def test_a_root_squares_back(number: Fraction | int) -> None:
    error = root(number) ** 2 / Fraction(number) - 1
    assert abs(error) < Fraction(1, 2**60)


def test_roots_of_squares_are_exact() -> None:
    assert root(0) == 0
    assert root(Fraction(9, 4)) == Fraction(3, 2)


def test_a_heading_is_about_as_long_as_one_and_goes_across() -> None:
    for i in range(50):
        a, b, c = map(Fraction, heading(draw(1, "heading", i)))
        assert abs(a * a + b * b + c * c - 1) < Fraction(1, 2**50)
        assert a * a + b * b >= Fraction(1, 4)


def test_a_disc_holds_its_points() -> None:
    for i in range(50):
        a, b = disc(draw(1, "disc", i), 0.875)
        assert a * a + b * b <= Fraction(49, 64)


def test_frames_are_along_the_axes_or_oblique() -> None:
    for i in range(20):
        assert sorted(map(abs, frame_of(draw(1, "frame", i), oblique=False).axis)) == [0, 0, 1]
        assert frame_of(draw(1, "frame", i), oblique=True).stretch > 1


def test_a_sample_is_posed_in_its_frame() -> None:
    sample = Sample(rod((0, 0, 0), (0, 0, 2), 1), before((0, 0, 1), (1, 0, 0), 3), (1, 0, 0))
    solid, ray = sample.posed()
    assert solid == Cylinder((0, 0, 0), (0, 0, 2), 1)
    assert (ray.origin, ray.direction) == ((-3, 0, 1), (1, 0, 0))


def test_what_rounding_leaves_no_solid_is_refused() -> None:
    far = Sample(rod((0, 0, 0), (0, 0, 2), 1), (0, 0, 0), (1, 0, 0), ON_Z.moved((0, 0, 10**40)))
    with pytest.raises(Refused):
        far.posed()
