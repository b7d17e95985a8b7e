"""Reports K and M: faults measured on public engines, most with r = 1 and |z| <= 2."""

from __future__ import annotations

from fractions import Fraction

from raycert.cases.families.frames import ON_Y, SEVENTHS
from raycert.cases.families.report import GIVEN, Report, at, number
from raycert.cases.families.sketch import MISS, cylinder, near, pair, touch, two
from raycert.cases.formats import BINARY64

BODY = cylinder(1, 4, -2)
ALL = "raysect 0.9.1, MuJoCo 4.0.0, Geant4 11.4.p01, Bullet 3.2.7"
FAR = "Geant4 11.4.p01 G4Tubs"
TILT = near(BINARY64, number("1e-8"))

REPORTS = (
    Report(
        "m0-generic", f"measured (M0): {ALL}", "ray",
        "A generic ray, on which every engine is right to its precision",
        BODY, at("-3 0.3 -0.7"), at("1 0.1 0.2"), None, (), tier="generic",
    ),
    Report(
        "m1-tilted", "measured (M1): MuJoCo 4.0.0, Geant4 11.4.p01, Bullet 3.2.7", "start",
        "Tilted by 1e-8, a ray from the axis meets the wall at 1e8, far below the cap at 1e9",
        cylinder(1, 10**9), (0, 0, 0), (TILT, 0, 1), pair(0, 1 / TILT), ("near-parallel", "needle"),
        large=True,
    ),
    Report(
        "m1-tilted-from-outside", "measured (M1): MuJoCo 4.0.0, Geant4 11.4.p01, Bullet 3.2.7",
        "start",
        "Tilted by 1e-8, a ray from two radii away meets the wall at 1e8 and again at 3e8",
        cylinder(1, 10**9), (-2, 0, 0), (TILT, 0, 1), pair(1 / TILT, 3 / TILT),
        ("near-parallel", "needle"), large=True,
    ),
    Report(
        "m2-tangent", "measured (M2): Bullet 3.2.7, scikit-spatial 10", "start",
        "A ray passes 1e-15 radii inside tangency",
        BODY, (-3, 1 - number("1e-15"), 0), (1, 0, 0), None, ("near-tangent",), large=True,
    ),
    Report(
        "m2-tangent-exact", "measured (M2): Bullet 3.2.7", "start",
        "A ray is exactly tangent to the unit cylinder",
        BODY, (-3, 1, 0), (1, 0, 0), touch(3), ("tangent",), ON_Y,
    ),
    Report(
        "m3-far", "measured (M3): raysect 0.9.1, MuJoCo 4.0.0, OCCT 8.0.1, scikit-spatial 10",
        GIVEN,
        "From 1e8 radii a ray passes at 0.95 of the radius",
        BODY, (-(10**8), number("0.95"), 0), (1, 0, 0), None, ("far",), large=True,
    ),
    Report(
        "m4-deep-1e8", f"measured (M4): {FAR}", "offset",
        "From 1e8 radii a perpendicular ray passes at 0.3 of the radius",
        BODY, (-(10**8), number("0.3"), 1), (1, 0, 0), None, ("far", "perpendicular"), large=True,
    ),
    Report(
        "m4-deep-10e7", f"measured (M4): {FAR}", "offset",
        "From 1e7 radii a perpendicular ray passes at 0.3 of the radius",
        BODY, (-(10**7), number("0.3"), 1), (1, 0, 0), None, ("far", "perpendicular"), large=True,
    ),
    Report(
        "m4-between", f"measured (M4): {FAR}", "offset",
        "From 10^7.5 radii a perpendicular ray passes at 0.7 of the radius",
        BODY, (-31622777, number("0.7"), -1), (1, 0, 0), None, ("far", "perpendicular"), large=True,
    ),
    Report(
        "m4-1e9", f"measured (M4): {FAR}", "offset",
        "From 1e9 radii a perpendicular ray passes at 0.5 of the radius",
        BODY, (-(10**9), Fraction(1, 2), 1), (1, 0, 0), None, ("far", "perpendicular"), large=True,
    ),
    Report(
        "m5-oblique-1e8", "measured (M5): Mitsuba 3.9.1, scikit-spatial 10", "ray",
        "From 1e8 steps an oblique ray goes through the centre",
        BODY, (-4 * 10**8, 0, -3 * 10**8), (4, 0, 3),
        pair(10**8 - Fraction(1, 4), 10**8 + Fraction(1, 4)), ("far",), SEVENTHS, large=True,
    ),
    Report(
        "m5-oblique-1e10", "measured (M5): raysect 0.9.1, MuJoCo 4.0.0, Geant4 11.4.p01", "ray",
        "From 1e10 steps an oblique ray goes through the centre",
        BODY, (-4 * 10**10, 0, -3 * 10**10), (4, 0, 3),
        pair(10**10 - Fraction(1, 4), 10**10 + Fraction(1, 4)), ("far",), SEVENTHS, large=True,
    ),
    Report(
        "m6-radius-1e-9", "measured (M6): raysect 0.9.1", "ray",
        "The radius is 1e-9 and the ray goes through the axis from one unit away",
        cylinder(number("1e-9"), 4, -2), (-1, 0, 0), (1, 0, 0), None, ("needle", "far"),
    ),
    Report(
        "m6-radius-1e-6", f"measured (M6): {ALL}", "ray",
        "The radius is 1e-6 and the ray passes halfway to the wall from one unit away",
        cylinder(number("1e-6"), 4, -2), (-1, number("5e-7"), 0), (1, 0, 0), None,
        ("needle", "far"), large=True,
    ),
    Report(
        "m8-disk", "measured (M8): OCCT 8.0.1", "ray",
        "A ray grazes down through a disk of radius 1e3 and thickness 1e-9",
        cylinder(1000, number("1e-9")), (-2000, 0, 2), (1000, 0, -1), None, ("disk",), large=True,
    ),
    Report(
        "m8-disk-level", "measured (M8): OCCT 8.0.1", "ray",
        "A ray lies in the upper face of a disk of radius 1e3 and thickness 1e-9",
        cylinder(1000, number("1e-9")), (-2000, 0, number("1e-9")), (1000, 0, 0), None,
        ("disk", "cap-plane"), large=True,
    ),
    Report(
        "m9-short-direction", "measured (M9): MuJoCo 4.0.0, trimesh 5.2.0", "start",
        "The direction is 1e-9 long",
        BODY, (-3, 0, 0), (number("1e-9"), 0, 0), None, ("direction-scale",),
    ),
    Report(
        "m10-in-the-wall", "measured (M10): Geant4 11.4.p01, Bullet 3.2.7", "start",
        "A ray lies in the wall",
        BODY, (0, 1, -4), (0, 0, 1), pair(2, 6), ("wall", "rim"),
    ),
    Report(
        "m10-in-the-cap", "measured (M10): Geant4 11.4.p01, Bullet 3.2.7", "start",
        "A ray lies in the plane of a cap",
        BODY, (-3, 0, 2), (1, 0, 0), pair(2, 4), ("cap-plane", "rim"),
    ),
    Report(
        "m10-start-inside", f"measured (M10): {ALL}", "ray",
        "From the centre a ray meets the wall at t = 1, the square root of 2 away",
        BODY, (0, 0, 0), (1, 0, 1), pair(0, 1), ("start-inside",), tier="generic",
    ),
    Report(
        "m10-wall-out", f"measured (M10): {ALL}", "start",
        "A ray starts on the wall and goes out",
        BODY, (1, 0, 0), (1, 0, 0), touch(0), ("start-on-surface",),
    ),
    Report(
        "m10-wall-tangent", f"measured (M10): {ALL}", "start",
        "A ray starts on the wall and goes along the tangent",
        BODY, (1, 0, 0), (0, 1, 0), touch(0), ("start-on-surface", "tangent"),
    ),
    Report(
        "trimesh-long-direction", "measured (K67): trimesh 5.2.0", "start",
        "The direction is 1e6 long",
        BODY, (-3, 0, 0), (10**6, 0, 0), None, ("direction-scale",),
    ),
    Report(
        "trimesh-short-direction", "measured (K67): trimesh 5.2.0", "start",
        "The direction is 1e-6 long",
        BODY, (-3, 0, 0), (number("1e-6"), 0, 0), None, ("direction-scale",),
    ),
    Report(
        "tilted-annulus", "measured (K68): trimesh 5.2.0", "ray",
        "Tilted by 2^-20, a ray stays between the wall and an inscribed mesh of 256 facets",
        BODY, (1 - two(-16), 0, -3), (two(-20), 0, 1), None, ("near-parallel", "near-rim"),
    ),
    Report(
        "annulus-outside", "measured (K68): trimesh 5.2.0", "ray and mesh",
        "A ray passes wide of the wall but inside a circumscribed mesh of 256 facets",
        BODY, (-3, 1 + two(-16), 0), (1, 0, 0), MISS, ("near-tangent",),
    ),
)  # fmt: skip
