"""Reports C, G, H and J: tangents and grazing, starts on surfaces, rims, and the solver."""

from __future__ import annotations

from fractions import Fraction

from raycert.cases.families.frames import ELEVENTHS, SEVENTHS, UPRIGHT, Exact
from raycert.cases.families.report import NUMBERS, Report, at, number
from raycert.cases.families.sketch import (
    MISS,
    Body,
    cylinder,
    half_space,
    pair,
    slab,
    touch,
    tube,
    two,
)

TUBE = cylinder(5, 20, -10)
DRUM = cylinder(4, 8)
ATLAS: Exact = at("23.51934584635 17.141066715148 344.45000092904")
ATLAS_WAY: Exact = at("0.5784236876658104 0.8157365000698582 -9.290358099212079e-7")
ATLAS_PLANE = number("344.45")
BRLCAD: Exact = at("12320.0005 -1168 2134")
BRLCAD_SHOT: Exact = at("51.20451138795556290 -9.99999987347469776 19.42666674721774100")
BITS = 53
HALF = Fraction(1, 2)
HERE = HALF + two(-BITS)

TANGENTS = (
    Report(
        "geant4-wall-tangent", "Geant4 CSG/History 2007-08-16", NUMBERS,
        "From a point of the tube wall a ray leaves along the tangent",
        TUBE, (3, 4, 0), (4, -3, 0), touch(0), ("tangent", "start-on-surface"),
    ),
    Report(
        "geant4-wall-tangent-climbing", "Geant4 CSG/History 2007-08-16", NUMBERS,
        "From a point of the tube wall a ray leaves along a climbing tangent",
        TUBE, (3, 4, 0), (4, -3, 12), touch(0), ("tangent", "start-on-surface"),
    ),
    Report(
        "geant4-barely-inward", "Geant4 CSG/History 2008-06-23", NUMBERS,
        "From the wall a ray leaves along the tangent turned inward by 1e-10",
        TUBE, (0, 5, 0), at("1 -1e-10 0"), None, ("near-tangent", "start-on-surface"),
    ),
    Report(
        "geant4-barely-outward", "Geant4 CSG/History 2008-06-23", NUMBERS,
        "From the wall a ray leaves along the tangent turned outward by 1e-10",
        TUBE, (0, 5, 0), at("1 1e-10 0"), touch(0), ("near-tangent", "start-on-surface"),
    ),
    Report(
        "openmc-tangent", "openmc-dev/openmc #80", "cylinder",
        "From x = -10 a track is exactly tangent to r = 1, the report having a sphere",
        tube(1), (-10, 1, 0), (1, 0, 0), touch(10), ("tangent",),
    ),
    Report(
        "openmoc-barely-touching", "mit-crpg/OpenMOC #258", NUMBERS,
        "A track cuts a circle 1e-12 radii deep",
        tube(1), (-3, 1 - number("1e-12"), 0), (1, 0, 0), None, ("near-tangent",), large=True,
    ),
    Report(
        "openmoc-tangent-oblique", "mit-crpg/OpenMOC #456", NUMBERS,
        "A track is tangent to a circle at (3, 4)",
        tube(5), (-5, 10, 0), (4, -3, 0), touch(2), ("tangent",),
    ),
    Report(
        "brlcad-graze-wall", "BRL-CAD 878f52244a", NUMBERS,
        "A ray lies in the wall, the report having a grazed cone",
        cylinder(4, 8), (0, 4, -4), (0, 0, 4), pair(1, 3), ("wall", "rim"), SEVENTHS,
    ),
    Report(
        "brlcad-graze-rim", "BRL-CAD TODO, havoc.g s.nos5g", NUMBERS,
        "A ray grazes an edge, which once gave one hit",
        cylinder(4, 8), (-8, 0, 4), (2, 0, 2), touch(2), ("rim",), ELEVENTHS,
    ),
    Report(
        "brlcad-flat-end", "BRL-CAD acd321b55e", NUMBERS,
        "A ray lies in the flat end of a right circular cylinder",
        DRUM, (-8, 1, 0), (2, 0, 0), None, ("cap-plane",),
    ),
    Report(
        "brlcad-above-the-end", "BRL-CAD f52963d2d2", NUMBERS,
        "A ray runs 1e-77 above the flat end, inside the cylinder",
        DRUM, (-8, 0, number("1e-77")), (2, 0, 0), None, ("cap-plane",), large=True,
    ),
    Report(
        "brlcad-below-the-end", "BRL-CAD 5a09fa45bd", NUMBERS,
        "A ray runs 1e-77 below the flat end, outside the cylinder",
        DRUM, (-8, 0, -number("1e-77")), (2, 0, 0), MISS, ("cap-plane",), large=True,
    ),
    Report(
        "brlcad-special-point", "BRL-CAD aaa955a6f2", "cylinder",
        "The reported point and direction graze the rim of a cylinder",
        Body("cylinder", (12400, -1268, 2134), (12400, -1268, 2234), 100), BRLCAD, (1, 0, 0),
        None, ("rim", "tangent"),
    ),
    Report(
        "brlcad-near-tangent", "BRL-CAD 5b99b43471", "cylinder",
        "The reported shot passes 1.3e-7 inside a radius of 10",
        cylinder(10, 40), BRLCAD_SHOT, (-1, 0, 0), None, ("near-tangent",), large=True,
    ),
    Report(
        "celeritas-short-chord", "celeritas-project/celeritas PR #480", NUMBERS,
        "The chord next to a tangent is 9e-8 radii long, the report having a curved track",
        tube(1), (-3, 1 - number("1e-15"), 0), (1, 0, 0), None, ("near-tangent",), large=True,
    ),
    Report(
        "celeritas-atlas-plane", "celeritas-project/celeritas #1902", "level z = 344.45",
        "The reported ray meets a plane at a slope of -9.29e-7",
        half_space(ATLAS_PLANE), ATLAS, ATLAS_WAY, None, ("near-parallel",), large=True,
    ),
    Report(
        "celeritas-atlas-slab", "celeritas-project/celeritas PR #1914", "level and thickness",
        "The reported ray sinks into a slab at a slope of -9.29e-7",
        slab(Fraction(1, 2), ATLAS_PLANE - Fraction(1, 2)), ATLAS, ATLAS_WAY, None,
        ("near-parallel",), large=True,
    ),
    Report(
        "aardvark-tangent", "aardvark-platform/aardvark.base #127", NUMBERS,
        "A ray is exactly tangent, the report having a sphere",
        DRUM, (-8, 4, 2), (4, 0, 0), touch(2), ("tangent",), ELEVENTHS,
    ),
    Report(
        "aardvark-underflow", "aardvark-platform/aardvark.base #127", NUMBERS,
        "Every length is about 2^-540, so squares underflow, the report having a sphere",
        DRUM, (-8, 1, 2), (4, 0, 0), None, ("underflow", "scene-scale"),
        UPRIGHT.scaled(two(-540)), "range", large=True,
    ),
    Report(
        "aardvark-overflow", "aardvark-platform/aardvark.base #127", NUMBERS,
        "Every length is about 2^540, so squares overflow, the report having a sphere",
        DRUM, (-8, 1, 2), (4, 0, 0), None, ("overflow", "scene-scale"),
        UPRIGHT.scaled(two(540)), "range", large=True,
    ),
    Report(
        "root-grazed-cap", "root-project/root PR #3724", NUMBERS,
        "A ray lies in the upper plane of a slab, the report having an eight-point solid",
        slab(8), (-5, 1, 8), (3, 4, 0), pair(0, None), ("cap-plane",),
    ),
    Report(
        "shapes-touched-side", "moveit/geometric_shapes a627e6f", NUMBERS,
        "A ray touches the side of a cylinder",
        cylinder(1, 2, -1), (-2, 1, 0), (1, 0, 0), touch(2), ("tangent",),
    ),
    Report(
        "shapes-base-and-side", "moveit/geometric_shapes a627e6f", NUMBERS,
        "A ray passes the edge between base and side, and the opposite one",
        cylinder(1, 2, -1), (-2, 0, -2), (1, 0, 1), pair(1, 3), ("rim",),
    ),
)  # fmt: skip

STARTS = (
    Report(
        "bullet-from-inside", "bulletphysics/bullet3 #459", NUMBERS,
        "A ray starts inside and leaves through the wall",
        cylinder(1, 2, -1), at("0.25 -0.5 0.125"), at("0.75 0.375 0.5"), None, ("start-inside",),
        tier="generic",
    ),
    Report(
        "bullet-from-inside-axial", "bulletphysics/bullet3 #459", NUMBERS,
        "A ray starts inside and leaves through a cap",
        cylinder(1, 2, -1), at("0.25 -0.5 0.125"), at("0.125 0.25 -1"), None, ("start-inside",),
        tier="generic",
    ),
    Report(
        "physx-behind", "NVIDIA PhysX #487", NUMBERS,
        "The solid lies wholly behind the ray",
        cylinder(1, 2, -1), (5, 0, 0), (1, 0, 0), MISS, ("behind",),
    ),
    Report(
        "parry-inside", "dimforge/parry PR #183", NUMBERS,
        "A ray starts inside and meets the wall from within",
        cylinder(5, 8), (0, 3, 4), (2, 0, 0), pair(0, 2), ("start-inside",), tier="generic",
    ),
    Report(
        "vecgeom-shell-outside", "VecGeom ba71e216 (VECGEOM-540)", NUMBERS,
        "The start is 5e-10 outside the wall, in the tolerance shell, going in",
        TUBE, (5 + number("5e-10"), 0, 0), (-1, 0, 0), None, ("start-near-surface",), large=True,
    ),
    Report(
        "vecgeom-shell-inside", "VecGeom ba71e216 (VECGEOM-540)", NUMBERS,
        "The start is 5e-10 inside the wall, in the tolerance shell, going out",
        TUBE, (5 - number("5e-10"), 0, 0), (1, 0, 0), None, ("start-near-surface",), large=True,
    ),
    Report(
        "vecgeom-shell-leaving", "VECGEOM-601", NUMBERS,
        "The start is 5e-10 outside the wall, going out, the report having a cone",
        TUBE, (5 + number("5e-10"), 0, 0), (1, 0, 0), None, ("start-near-surface",), large=True,
    ),
    Report(
        "openmc-turned-back", "openmc-dev/openmc PR #3923", NUMBERS,
        "A particle on the wall is scattered back in, the report having a sphere",
        tube(5), (3, 4, 0), (-3, -1, 2), pair(0, Fraction(13, 5)), ("start-on-surface",),
    ),
    Report(
        "dart-surface-start", "dartsim/dart PR #3355", "height",
        "From (0.5, 0, 0) on the wall of radius 0.5 a ray leaves, the report having a capsule",
        cylinder(HALF, 1, -HALF), (HALF, 0, 0), (1, 0, 0), touch(0), ("start-on-surface",),
    ),
    Report(
        "geant4-both-zero", "Geant4 CSG/History 2004-07", NUMBERS,
        "A ray on the wall goes almost along the axis, out by 2^-20, the report having a cone",
        TUBE, (5, 0, 0), (two(-20), 0, 1), touch(0), ("start-on-surface", "near-parallel"),
    ),
    Report(
        "dart-rim", "dartsim/dart PR #3359", NUMBERS,
        "A ray meets the rim of a cylinder from above, the report having a swept sphere",
        DRUM, (-8, 0, 12), (4, 0, -4), pair(1, 3), ("rim",), tier="generic",
    ),
    Report(
        "fluid-engine-above", "doyubkim/fluid-engine-dev #251", NUMBERS,
        "A ray meets the infinite cylinder above the upper cap only",
        cylinder(1, 2, -1), (-2, 0, 2), (1, 0, 1), MISS, (), tier="generic",
    ),
    Report(
        "fluid-engine-below", "doyubkim/fluid-engine-dev #251", NUMBERS,
        "A ray meets the infinite cylinder below the lower cap only",
        cylinder(1, 2, -1), (-2, 0, -2), (1, 0, -1), MISS, (), tier="generic",
    ),
    Report(
        "openmc-two-surfaces", "openmc-dev/openmc #116", NUMBERS,
        "From outside a ray is aimed at an edge, the report having the corner of a lattice",
        DRUM, (-8, 0, 4), (2, 0, 2), touch(2), ("rim",),
    ),
    Report(
        "openmc-two-surfaces-inside", "openmc-dev/openmc #81", NUMBERS,
        "From inside a ray is aimed at an edge, the report having a sphere cut by a plane",
        DRUM, (0, 0, 4), (2, 0, 2), pair(0, 2), ("rim", "start-inside"),
    ),
    Report(
        "arborx-zero-b", "arborx/ArborX PR #461", NUMBERS,
        "The start is the closest approach to the axis, so the linear coefficient is zero",
        tube(5), (0, 3, 0), (2, 0, 7), pair(0, 2), ("start-inside",), tier="generic",
    ),
    Report(
        "numworks-quadratic", "numworks/epsilon #2038", "solid",
        "The quadratic t^2 - (1 + 2^-52) t + 1/4 + 2^-53 has the roots 1/2 and 1/2 + 2^-52",
        tube(two(-BITS), 1), (-HERE, 0, 0), (1, 0, 0), pair(Fraction(1, 2), HERE + two(-BITS)),
        ("needle",), large=True,
    ),
)  # fmt: skip

REPORTS = TANGENTS + STARTS
