"""Reports A and B: rays along the axis, almost along it, and square to it."""

from __future__ import annotations

from raycert.cases.families.frames import ON_X, ON_Y, UPRIGHT, Frame
from raycert.cases.families.report import GIVEN, NUMBERS, Report, at, number
from raycert.cases.families.sketch import ALWAYS, MISS, Body, cylinder, pair, tube

BEPU = cylinder(3, 4, -2)
UPRIGHT_Y = Frame("", "", ON_Y.lateral, ON_Y.across, ON_Y.axis)
VISRTX = Body("cylinder", at("-30.005 -77.1061 -16.8721"), at("-30.005 -27.301 16.8721"), 10)
VIEW = at("0 0.827878 0.560908")
CELERITAS = at("98.9771847341366993 10.6416436785971431 44.6914463342164936")
NEARLY_Z = at("4.09517743700767399e-7 1.00812588415826643e-6 0.99999999999940814")
DRUM = cylinder(4, 8)

REPORTS = (
    Report(
        "bepu-axis", "bepu/bepuphysics2 #253", GIVEN,
        "From the centre of a cylinder with r = 3 and h = 4, a ray runs along the axis",
        BEPU, (0, 0, 0), (0, 0, 1), pair(0, 2), ("parallel", "start-inside"), UPRIGHT_Y,
    ),
    Report(
        "bepu-square", "bepu/bepuphysics2 #253", GIVEN,
        "From the centre of a cylinder with r = 3 and h = 4, a ray runs square to the axis",
        BEPU, (0, 0, 0), (1, 0, 0), pair(0, 3), ("perpendicular", "start-inside"), UPRIGHT_Y,
    ),
    Report(
        "mccode-nearly-parallel", "mccode-dev/McCode #986", NUMBERS,
        "1 - vy^2 rounds to zero while vx is 1e-9",
        cylinder(1, 4), (0, 0, -2), at("1e-9 0 1"), None, ("near-parallel",), UPRIGHT_Y,
    ),
    Report(
        "mccode-square-underflows", "mccode-dev/McCode #986", NUMBERS,
        "The square of vx underflows while vx is positive",
        cylinder(1, 4), (0, 0, -2), at("1e-170 0 1"), None, ("near-parallel", "underflow"),
        UPRIGHT_Y, "range", large=True,
    ),
    Report(
        "mccode-above-the-cap", "mccode-dev/McCode 85f9b28e2", NUMBERS,
        "A ray square to the axis passes above a cylinder once taken as infinite",
        DRUM, (-8, 0, 9), (4, 0, 0), MISS, ("perpendicular",), UPRIGHT_Y,
    ),
    Report(
        "mccode-parallel-up", "mccode-dev/McCode 9d8339691", NUMBERS,
        "A ray parallel to the axis goes up through both caps",
        DRUM, (1, 2, -8), (0, 0, 4), pair(2, 4), ("parallel",), UPRIGHT_Y,
    ),
    Report(
        "mccode-parallel-down", "mccode-dev/McCode a205f116b", NUMBERS,
        "A ray parallel to the axis goes down through both caps",
        DRUM, (1, 2, 16), (0, 0, -4), pair(2, 4), ("parallel",), UPRIGHT_Y,
    ),
    Report(
        "mccode-cap-to-wall", "mccode-dev/McCode 65796ac7a", NUMBERS,
        "A ray enters by a cap and leaves by the wall",
        DRUM, (-4, 0, -1), (2, 0, 1), pair(1, 4), (), UPRIGHT_Y, "generic",
    ),
    Report(
        "mccode-edge", "mccode-dev/McCode 245fd7a37", NUMBERS,
        "A ray enters at the top edge",
        DRUM, (-8, 0, 11), (4, 0, -3), pair(1, 3), ("rim",), UPRIGHT_Y,
    ),
    Report(
        "celeritas-inside", "celeritas-project/celeritas #621", "radius 100",
        "From the reported start, inside, the reported direction has vx^2 + vy^2 = 1.2e-12",
        tube(100, 200), CELERITAS, NEARLY_Z, None, ("near-parallel", "start-inside"),
    ),
    Report(
        "celeritas-outside", "celeritas-project/celeritas #621", "radius 99",
        "The reported ray, with vx^2 + vy^2 = 1.2e-12, moves away outside the wall",
        tube(99, 200), CELERITAS, NEARLY_Z, MISS, ("near-parallel", "behind"),
    ),
    Report(
        "celeritas-capped", "celeritas-project/celeritas #621", "size",
        "The reported ray, with vx^2 + vy^2 = 1.2e-12, starts in a capped cylinder",
        cylinder(100, 200), CELERITAS, NEARLY_Z, None, ("near-parallel", "start-inside"),
    ),
    Report(
        "celeritas-along-x", "celeritas-project/celeritas PR #627", GIVEN,
        "Inside r = 3 the tested direction is 1.1e-6 off the axis",
        tube(3), at("0.345 0.456 0.123"), NEARLY_Z, None, ("near-parallel",), ON_X,
    ),
    Report(
        "visrtx-axis", "NVIDIA/VisRTX #73", "radius and eye",
        "A view along the axis of the reported cylinder meets its centre",
        VISRTX, at("-30.005 -159.8939 -72.9629"), VIEW, None, ("near-parallel",),
    ),
    Report(
        "visrtx-inside", "NVIDIA/VisRTX #73", "radius and eye",
        "A view along the axis of the reported cylinder meets a cap halfway out",
        VISRTX, at("-25.005 -159.8939 -72.9629"), VIEW, None, ("near-parallel",),
    ),
    Report(
        "visrtx-outside", "NVIDIA/VisRTX #73", "radius and eye",
        "A view along the axis of the reported cylinder passes beside the wall",
        VISRTX, at("-19.505 -159.8939 -72.9629"), VIEW, MISS, ("near-parallel",),
    ),
    Report(
        "aardvark-parallel-inside", "aardvark-platform/aardvark.base #123", NUMBERS,
        "An axis-parallel ray meets the caps",
        DRUM, (2, 1, -4), (0, 0, 2), pair(2, 6), ("parallel",), UPRIGHT,
    ),
    Report(
        "aardvark-parallel-outside", "aardvark-platform/aardvark.base #123", NUMBERS,
        "An axis-parallel ray passes outside the wall",
        DRUM, (3, 3, -4), (0, 0, 2), MISS, ("parallel",), UPRIGHT,
    ),
    Report(
        "aardvark-from-inside", "aardvark-platform/aardvark.base #123", NUMBERS,
        "A ray that starts inside leaves through the wall",
        DRUM, (0, 0, 4), (4, 0, 3), pair(0, 1), ("start-inside",), UPRIGHT, "generic",
    ),
    Report(
        "aardvark-looking-away", "aardvark-platform/aardvark.base #123", NUMBERS,
        "A ray points away from the cylinder",
        DRUM, (8, 0, 4), (4, 0, 1), MISS, ("behind",), UPRIGHT, "generic",
    ),
    Report(
        "vecgeom-vz-one", "VecGeom 35c91e81 (VECGEOM-253)", NUMBERS,
        "1 - vz^2 is zero, the start in the tube",
        cylinder(5, 20, -10), (3, 0, 0), (0, 0, 1), pair(0, 10), ("parallel", "start-inside"),
    ),
    Report(
        "vecgeom-vz-one-outside", "VecGeom 35c91e81 (VECGEOM-253)", NUMBERS,
        "1 - vz^2 is zero, the start beside the tube",
        cylinder(5, 20, -10), (6, 0, 0), (0, 0, 1), MISS, ("parallel",),
    ),
    Report(
        "vecgeom-vz-zero", "VecGeom 3656a84c (VECGEOM-206)", NUMBERS,
        "1/vz is infinite, the start outside the tube",
        cylinder(5, 20, -10), (-10, 0, 3), (1, 0, 0), pair(5, 15), ("perpendicular",),
    ),
    Report(
        "openmoc-polar-zero", "mit-crpg/OpenMOC PR #457", NUMBERS,
        "A track with polar angle zero runs along an infinite cylinder, inside it",
        tube(2), (1, 0, 0), (0, 0, 1), ALWAYS, ("parallel", "start-inside"),
    ),
    Report(
        "openmoc-vertical", "mit-crpg/OpenMOC PR #457", NUMBERS,
        "The cosine of a vertical track comes out as 6.123e-17",
        tube(2), (0, -4, 0), (number("6.123233995736766e-17"), 1, 0), None, ("perpendicular",),
    ),
    Report(
        "ncollide-parallel", "dimforge/ncollide #178", GIVEN,
        "A ray runs parallel to the reported segment, drawn as radius zero",
        Body("cylinder", (2, 1, 0), (2, 0, 0)), (3, 0, 0), (0, 1, 0), MISS,
        ("parallel", "zero-radius"),
    ),
    Report(
        "ncollide-parallel-beside", "dimforge/ncollide #269", GIVEN,
        "A ray starts level with the middle of the parallel segment, drawn as radius zero",
        Body("cylinder", (1, 2, 0), (1, -2, 0)), (0, 0, 0), (0, -1, 0), MISS,
        ("parallel", "zero-radius"),
    ),
    Report(
        "parry-zero-length-inside", "tommy-xr/shock2quest PR #409", NUMBERS,
        "A ray of no length lies inside a cylinder, the report having a box",
        cylinder(1, 2, -1), (0, 0, 0), (0, 0, 0), ALWAYS, ("zero-direction",), UPRIGHT_Y,
    ),
    Report(
        "parry-zero-length-segment", "dimforge/parry #31", "line",
        "A ray misses the reported segment of no length, drawn as a line of radius zero",
        Body("infinite_cylinder", (10, 10, 0), (10, 10, 1)), (0, 0, 0), (1, 0, 0), MISS,
        ("perpendicular", "zero-radius"),
    ),
    Report(
        "parry-along-a-segment", "dimforge/parry #357", NUMBERS,
        "A ray runs along a segment, drawn as radius zero",
        Body("cylinder", (0, 0, -1), (0, 0, 1)), (0, 0, -3), (0, 0, 1), pair(2, 4),
        ("parallel", "zero-radius"),
    ),
    Report(
        "ospray-square", "RenderKit/ospray #482", NUMBERS,
        "The direction is exactly square to the axis",
        cylinder(1, 4), (-5, 0, 2), (1, 0, 0), pair(4, 6), ("perpendicular",), ON_X,
    ),
    Report(
        "ospray-square-off-axis", "RenderKit/ospray #302", NUMBERS,
        "The direction is square to the axis and the ray passes beside it",
        cylinder(5, 4), (-8, 3, 2), (4, 0, 0), pair(1, 3), ("perpendicular",), ON_Y,
    ),
    Report(
        "occt-line-quadric", "OCCT 0024640", NUMBERS,
        "A line square to the axis meets the axis of an infinite cylinder",
        tube(2), (-8, 0, 5), (1, 0, 0), pair(6, 10), ("perpendicular",), ON_Y,
    ),
)  # fmt: skip
