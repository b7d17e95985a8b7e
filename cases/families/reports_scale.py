"""Reports D, E and F: far starts, unusual scales, thin and small solids."""

from __future__ import annotations

from fractions import Fraction

from raycert.cases.families.frames import ON_X, ON_Y, THIRDS
from raycert.cases.families.report import GIVEN, NUMBERS, Report, at, number
from raycert.cases.families.sketch import ALWAYS, Body, cylinder, pair, slab, touch, tube

HALF = Fraction(1, 2)
CAN = cylinder(HALF, 2)
PIN = cylinder(1, 2, -1)
LATTICE_PITCH = number("173.205")

REPORTS = (
    Report(
        "geant4-far", "Geant4 report #1022", NUMBERS,
        "The start is 1e7 radii from a tube, its chord at 0.6 radii",
        cylinder(5, 16), (-5 * 10**7, 3, 8), (4, 0, 0), None, ("far",), large=True,
    ),
    Report(
        "mitsuba-far", "mitsuba-renderer/mitsuba3 #1594", NUMBERS,
        "The start is 1e4 radii from a cylinder, its chord at 0.6 radii",
        tube(5), (-4 * 10**4, 3, 0), (4, 0, 0), pair(10**4 - 1, 10**4 + 1), ("far",),
    ),
    Report(
        "mitsuba-far-oblique", "mitsuba-renderer/mitsuba3 PR #1600", NUMBERS,
        "The start is 1e4 directions away, the chord at 0.6 radii",
        cylinder(5, 16), (-4 * 10**4, 3, 8), (4, 0, 0), pair(10**4 - 1, 10**4 + 1), ("far",),
        THIRDS,
    ),
    Report(
        "jolt-centre", "jrouwe/JoltPhysics #1818", "the rest",
        "Over 12,000 units a ray meets the middle of a cylinder",
        CAN, (-12000, 0, 1), (12000, 0, 0), None, ("far", "direction-scale"), ON_Y,
    ),
    Report(
        "jolt-halfway", "jrouwe/JoltPhysics #1818", "the rest",
        "Over 12,000 units a ray meets a cylinder halfway out",
        CAN, (-12000, Fraction(1, 4), 1), (12000, 0, 0), None, ("far", "direction-scale"), ON_Y,
    ),
    Report(
        "jolt-edge", "jrouwe/JoltPhysics #1818", "the rest",
        "Over 12,000 units a ray meets a cylinder at 0.98 of its radius",
        CAN, (-12000, number("0.49"), 1), (12000, 0, 0), None, ("far", "direction-scale"), ON_Y,
    ),
    Report(
        "jolt-oblique", "jrouwe/JoltPhysics #1818", "the rest",
        "Over 12,000 units a ray meets a cylinder on a slant",
        CAN, at("-9600 0.125 -7199"), (9600, 0, 7200), None, ("far", "direction-scale"), ON_Y,
    ),
    Report(
        "pbrt-distant-edge", "mmp/pbrt-v3 #44", "cylinder and ray",
        "10,000 units out, as the sphere reported, a unit cylinder is met at 0.95 radii",
        Body("infinite_cylinder", (10000, 0, 0), (10000, 0, 8), 1), (9995, number("0.95"), 0),
        (1, 0, 0), None, ("displaced",),
    ),
    Report(
        "openmc-lattice-in", "openmc-dev/openmc #1383", NUMBERS,
        "A start on a lattice plane 173 units out goes in",
        slab(1, LATTICE_PITCH), (0, 0, LATTICE_PITCH), at("0.6 0 0.8"), None,
        ("start-on-surface", "displaced"), ON_X,
    ),
    Report(
        "openmc-lattice-out", "openmc-dev/openmc PR #1414", NUMBERS,
        "A start on a lattice plane 173 units out goes out",
        slab(1, LATTICE_PITCH), (0, 0, LATTICE_PITCH), at("0.6 0 -0.8"), touch(0),
        ("start-on-surface", "displaced"), ON_X,
    ),
    Report(
        "brlcad-sliver", "BRL-CAD e605a55594", "the rest",
        "A slab is 0.005 thick, half of the step that once jumped over it",
        slab(number("0.005")), (1, 2, -3), (2, 0, 1), None, ("disk",),
    ),
    Report(
        "brlcad-grazed-box", "BRL-CAD 871aacbd2a", NUMBERS,
        "The start lies in a plane of a slab and the direction is level",
        slab(8), (-5, 1, 0), (1, 0, 0), ALWAYS, ("cap-plane",),
    ),
    Report(
        "openusd-short-direction", "PixarAnimationStudios/OpenUSD PR #4221", GIVEN,
        "With r = 1, h = 2, from (0, -2, 0) along (0, 1e-5, 0), the list is near [1e5, 3e5]",
        PIN, (0, -2, 0), at("0 1e-5 0"), None, ("direction-scale",),
    ),
    Report(
        "shapes-long-direction", "moveit/geometric_shapes 074502d", NUMBERS,
        "The direction is two units long",
        PIN, (-3, 0, 0), (2, 0, 0), pair(1, 2), ("direction-scale",), tier="generic",
    ),
    Report(
        "shapes-half-direction", "moveit/geometric_shapes 074502d", NUMBERS,
        "The direction is half a unit long",
        PIN, (-3, 0, 0), (HALF, 0, 0), pair(4, 8), ("direction-scale",), tier="generic",
    ),
    Report(
        "openmc-drifted-norm", "openmc-dev/openmc #192", NUMBERS,
        "A direction of norm near 1 + 1e-6 is reflected into a cylinder from its wall",
        tube(5), (3, 4, 0), at("-0.6000006 -0.8000008 0"), None, ("start-on-surface",),
    ),
    Report(
        "ospray-epsilon", "RenderKit/ospray #279", "the rest",
        "Inside r = 1/2 every hit is nearer than the reported epsilon 1.442",
        cylinder(HALF, 2), (0, 0, 1), at("0.6 0 0.8"), None, ("start-inside", "start-near-surface"),
    ),
    Report(
        "ospray-long-cylinder", "RenderKit/ospray #600", "radius and ray",
        "A cylinder from (0, 0, 0) to (30000, 0, 0) is met near its far end",
        cylinder(1, 30000), (-3, 0, 29000), (1, 0, 0), pair(2, 4), ("needle",), ON_X,
    ),
    Report(
        "shapes-tiny-radius", "moveit/geometric_shapes #28", NUMBERS,
        "A ray goes through the axis at a radius of 1e-9, the report having a mesh loop",
        cylinder(number("1e-9"), 1), (-1, 0, HALF), (1, 0, 0), None, ("needle",),
    ),
    Report(
        "visrtx-zero-radius", "NVIDIA/VisRTX PR #334", NUMBERS,
        "The radius is zero and the ray crosses the axis",
        cylinder(0, 2), (-3, 0, 1), (1, 0, 0), touch(3), ("zero-radius",),
    ),
    Report(
        "brlcad-small", "BRL-CAD NEWS, small TGC", NUMBERS,
        "Radius and height are 1e-6 and the start is one unit away",
        cylinder(number("1e-6"), number("1e-6")), (-1, 0, number("4e-7")), (1, 0, 0), None,
        ("scene-scale", "far"), large=True,
    ),
    Report(
        "occt-small-cylinder", "OCCT OCC22318", NUMBERS,
        "Radius and height are 1e-7 and a ray starts close by, the report being of shading",
        cylinder(number("1e-7"), number("1e-7")), at("-3e-7 2e-8 4e-8"), at("1e-7 0 0"), None,
        ("scene-scale",),
    ),
)  # fmt: skip
