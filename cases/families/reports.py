"""Reports: every public fault of a leaf that gives enough geometry, as a named case.

Each line holds what the report gives, and says what is chosen here to draw it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from raycert.cases.case import Tier
from raycert.cases.families.frames import (
    ELEVENTHS,
    ON_X,
    ON_Y,
    SEVENTHS,
    THIRDS,
    UPRIGHT,
    Exact,
    Frame,
)
from raycert.cases.families.shots import Shot, family, is_double
from raycert.cases.families.sketch import (
    ALWAYS,
    MISS,
    Pairs,
    Shape,
    cylinder,
    half_space,
    near,
    pair,
    pipe,
    rod,
    slab,
    touch,
    tube,
    two,
)
from raycert.cases.formats import BINARY64, Format

GIVEN = ""
"""What is ours in a scene that the report gives whole."""
NUMBERS = "numbers"
"""What is ours where the report names a trigger and no scene."""


@dataclass(frozen=True, slots=True)
class Report:
    """One reported trigger: `source` is the report, `why` one fact about the scene.

    `ours` is what of the scene is chosen here; the sentence of the case ends with it.
    `flags` are words. `large` marks distances and sizes that only binary64 has room for.
    """

    slug: str
    source: str
    why: str
    shape: Shape
    origin: Exact
    direction: Exact
    known: Pairs | None = None
    flags: str = ""
    frame: Frame = UPRIGHT
    tier: Tier = "stiff"
    ours: str = NUMBERS
    large: bool = False

    def shot(self) -> Shot:
        whose = f"{self.ours} chosen here" if self.ours else "numbers as given"
        return Shot(self.slug, f"{self.why}; {whose}", self.shape, self.origin, self.direction,
                    self.known, self.frame, ("reported", *self.flags.split()), self.tier,
                    self.source)  # fmt: skip


def shots(*tables: Iterable[Report]) -> Callable[[Format], Iterator[Shot]]:
    """Return the shots of some tables that a format has room for."""
    every = [report for table in tables for report in table]
    return lambda fmt: (r.shot() for r in every if not r.large or is_double(fmt))


def at(text: str) -> Exact:
    """Return the point or vector with these decimal components.

    >>> at("0.5 -1e-3 2")
    (Fraction(1, 2), Fraction(-1, 1000), Fraction(2, 1))
    """
    x, y, z = (Fraction(word) for word in text.split())
    return (x, y, z)


HALF = Fraction(1, 2)
BEPU = cylinder(3, 4, -2)
UPRIGHT_Y = Frame("", "", ON_Y.lateral, ON_Y.across, ON_Y.axis)
VISRTX = rod(at("-30.005 -77.1061 -16.8721"), at("-30.005 -27.301 16.8721"), 10)
VIEW = at("0 0.827878 0.560908")
CELERITAS = at("98.9771847341366993 10.6416436785971431 44.6914463342164936")
NEARLY_Z = at("4.09517743700767399e-7 1.00812588415826643e-6 0.99999999999940814")
DRUM = cylinder(4, 8)
# Rays along the axis, almost along it, and square to it.
PARALLEL = (
    Report("bepu-axis", "bepu/bepuphysics2 #253",
           "From the centre of a cylinder with r = 3 and h = 4, a ray runs along the axis",
           BEPU, (0, 0, 0), (0, 0, 1), pair(0, 2), "parallel start-inside", UPRIGHT_Y, ours=GIVEN),
    Report("bepu-square", "bepu/bepuphysics2 #253",
           "From the centre of a cylinder with r = 3 and h = 4, a ray runs square to the axis",
           BEPU, (0, 0, 0), (1, 0, 0), pair(0, 3), "perpendicular start-inside", UPRIGHT_Y,
           ours=GIVEN),
    Report("mccode-nearly-parallel", "mccode-dev/McCode #986",
           "1 - vy^2 rounds to zero while vx is 1e-9",
           cylinder(1, 4), (0, 0, -2), at("1e-9 0 1"), None, "near-parallel", UPRIGHT_Y),
    Report("mccode-square-underflows", "mccode-dev/McCode #986",
           "The square of vx underflows while vx is positive", cylinder(1, 4), (0, 0, -2),
           at("1e-170 0 1"), None, "near-parallel underflow", UPRIGHT_Y, "range", large=True),
    Report("mccode-above-the-cap", "mccode-dev/McCode 85f9b28e2",
           "A ray square to the axis passes above a cylinder once taken as infinite",
           DRUM, (-8, 0, 9), (4, 0, 0), MISS, "perpendicular", UPRIGHT_Y),
    Report("mccode-parallel-up", "mccode-dev/McCode 9d8339691",
           "A ray parallel to the axis goes up through both caps",
           DRUM, (1, 2, -8), (0, 0, 4), pair(2, 4), "parallel", UPRIGHT_Y),
    Report("mccode-parallel-down", "mccode-dev/McCode a205f116b",
           "A ray parallel to the axis goes down through both caps",
           DRUM, (1, 2, 16), (0, 0, -4), pair(2, 4), "parallel", UPRIGHT_Y),
    Report("mccode-cap-to-wall", "mccode-dev/McCode 65796ac7a",
           "A ray enters by a cap and leaves by the wall",
           DRUM, (-4, 0, -1), (2, 0, 1), pair(1, 4), frame=UPRIGHT_Y, tier="generic"),
    Report("mccode-edge", "mccode-dev/McCode 245fd7a37", "A ray enters at the top edge",
           DRUM, (-8, 0, 11), (4, 0, -3), pair(1, 3), "rim", UPRIGHT_Y),
    Report("celeritas-inside", "celeritas-project/celeritas #621",
           "From the reported start, inside, the reported direction has vx^2 + vy^2 = 1.2e-12",
           tube(100, 200), CELERITAS, NEARLY_Z, None, "near-parallel start-inside",
           ours="radius 100"),
    Report("celeritas-outside", "celeritas-project/celeritas #621",
           "The reported ray, with vx^2 + vy^2 = 1.2e-12, moves away outside the wall",
           tube(99, 200), CELERITAS, NEARLY_Z, MISS, "near-parallel behind", ours="radius 99"),
    Report("celeritas-capped", "celeritas-project/celeritas #621",
           "The reported ray, with vx^2 + vy^2 = 1.2e-12, starts in a capped cylinder",
           cylinder(100, 200), CELERITAS, NEARLY_Z, None, "near-parallel start-inside",
           ours="size"),
    Report("celeritas-along-x", "celeritas-project/celeritas PR #627",
           "Inside r = 3 the tested direction is 1.1e-6 off the axis",
           tube(3), at("0.345 0.456 0.123"), NEARLY_Z, None, "near-parallel", ON_X, ours=GIVEN),
    Report("visrtx-axis", "NVIDIA/VisRTX #73",
           "A view along the axis of the reported cylinder meets its centre", VISRTX,
           at("-30.005 -159.8939 -72.9629"), VIEW, None, "near-parallel", ours="radius and eye"),
    Report("visrtx-inside", "NVIDIA/VisRTX #73",
           "A view along the axis of the reported cylinder meets a cap halfway out", VISRTX,
           at("-25.005 -159.8939 -72.9629"), VIEW, None, "near-parallel", ours="radius and eye"),
    Report("visrtx-outside", "NVIDIA/VisRTX #73",
           "A view along the axis of the reported cylinder passes beside the wall", VISRTX,
           at("-19.505 -159.8939 -72.9629"), VIEW, MISS, "near-parallel", ours="radius and eye"),
    Report("aardvark-parallel-inside", "aardvark-platform/aardvark.base #123",
           "An axis-parallel ray meets the caps",
           DRUM, (2, 1, -4), (0, 0, 2), pair(2, 6), "parallel"),
    Report("aardvark-parallel-outside", "aardvark-platform/aardvark.base #123",
           "An axis-parallel ray passes outside the wall",
           DRUM, (3, 3, -4), (0, 0, 2), MISS, "parallel"),
    Report("aardvark-from-inside", "aardvark-platform/aardvark.base #123",
           "A ray that starts inside leaves through the wall",
           DRUM, (0, 0, 4), (4, 0, 3), pair(0, 1), "start-inside", tier="generic"),
    Report("aardvark-looking-away", "aardvark-platform/aardvark.base #123",
           "A ray points away from the cylinder",
           DRUM, (8, 0, 4), (4, 0, 1), MISS, "behind", tier="generic"),
    Report("vecgeom-vz-one", "VecGeom 35c91e81 (VECGEOM-253)",
           "1 - vz^2 is zero, the start in the tube",
           cylinder(5, 20, -10), (3, 0, 0), (0, 0, 1), pair(0, 10), "parallel start-inside"),
    Report("vecgeom-vz-one-outside", "VecGeom 35c91e81 (VECGEOM-253)",
           "1 - vz^2 is zero, the start beside the tube",
           cylinder(5, 20, -10), (6, 0, 0), (0, 0, 1), MISS, "parallel"),
    Report("vecgeom-vz-zero", "VecGeom 3656a84c (VECGEOM-206)",
           "1/vz is infinite, the start outside the tube",
           cylinder(5, 20, -10), (-10, 0, 3), (1, 0, 0), pair(5, 15), "perpendicular"),
    Report("openmoc-polar-zero", "mit-crpg/OpenMOC PR #457",
           "A track with polar angle zero runs along an infinite cylinder, inside it",
           tube(2), (1, 0, 0), (0, 0, 1), ALWAYS, "parallel start-inside"),
    Report("openmoc-vertical", "mit-crpg/OpenMOC PR #457",
           "The cosine of a vertical track comes out as 6.123e-17",
           tube(2), (0, -4, 0), (Fraction("6.123233995736766e-17"), 1, 0), None, "perpendicular"),
    Report("ncollide-parallel", "dimforge/ncollide #178",
           "A ray runs parallel to the reported segment, drawn as radius zero",
           rod((2, 1, 0), (2, 0, 0), 0), (3, 0, 0), (0, 1, 0), MISS, "parallel zero-radius",
           ours=GIVEN),
    Report("ncollide-parallel-beside", "dimforge/ncollide #269",
           "A ray starts level with the middle of the parallel segment, drawn as radius zero",
           rod((1, 2, 0), (1, -2, 0), 0), (0, 0, 0), (0, -1, 0), MISS, "parallel zero-radius",
           ours=GIVEN),
    Report("parry-zero-length-inside", "tommy-xr/shock2quest PR #409",
           "A ray of no length lies inside a cylinder, the report having a box",
           cylinder(1, 2, -1), (0, 0, 0), (0, 0, 0), ALWAYS, "zero-direction", UPRIGHT_Y),
    Report("parry-zero-length-segment", "dimforge/parry #31",
           "A ray misses the reported segment of no length, drawn as a line of radius zero",
           pipe((10, 10, 0), (10, 10, 1), 0), (0, 0, 0), (1, 0, 0), MISS,
           "perpendicular zero-radius", ours="line"),
    Report("parry-along-a-segment", "dimforge/parry #357",
           "A ray runs along a segment, drawn as radius zero", rod((0, 0, -1), (0, 0, 1), 0),
           (0, 0, -3), (0, 0, 1), pair(2, 4), "parallel zero-radius"),
    Report("ospray-square", "RenderKit/ospray #482", "The direction is exactly square to the axis",
           cylinder(1, 4), (-5, 0, 2), (1, 0, 0), pair(4, 6), "perpendicular", ON_X),
    Report("ospray-square-off-axis", "RenderKit/ospray #302",
           "The direction is square to the axis and the ray passes beside it",
           cylinder(5, 4), (-8, 3, 2), (4, 0, 0), pair(1, 3), "perpendicular", ON_Y),
    Report("occt-line-quadric", "OCCT 0024640",
           "A line square to the axis meets the axis of an infinite cylinder",
           tube(2), (-8, 0, 5), (1, 0, 0), pair(6, 10), "perpendicular", ON_Y),
)  # fmt: skip
BORE = cylinder(5, 20, -10)
ATLAS: Exact = at("23.51934584635 17.141066715148 344.45000092904")
ATLAS_WAY: Exact = at("0.5784236876658104 0.8157365000698582 -9.290358099212079e-7")
ATLAS_PLANE = Fraction("344.45")
BRLCAD: Exact = at("12320.0005 -1168 2134")
BRLCAD_SHOT: Exact = at("51.20451138795556290 -9.99999987347469776 19.42666674721774100")
BITS = 53
HERE = HALF + two(-BITS)
# Tangents and grazing.
TANGENTS = (
    Report("geant4-wall-tangent", "Geant4 CSG/History 2007-08-16",
           "From a point of the tube wall a ray leaves along the tangent",
           BORE, (3, 4, 0), (4, -3, 0), touch(0), "tangent start-on-surface"),
    Report("geant4-wall-tangent-climbing", "Geant4 CSG/History 2007-08-16",
           "From a point of the tube wall a ray leaves along a climbing tangent",
           BORE, (3, 4, 0), (4, -3, 12), touch(0), "tangent start-on-surface"),
    Report("geant4-barely-inward", "Geant4 CSG/History 2008-06-23",
           "From the wall a ray leaves along the tangent turned inward by 1e-10",
           BORE, (0, 5, 0), at("1 -1e-10 0"), None, "near-tangent start-on-surface"),
    Report("geant4-barely-outward", "Geant4 CSG/History 2008-06-23",
           "From the wall a ray leaves along the tangent turned outward by 1e-10",
           BORE, (0, 5, 0), at("1 1e-10 0"), touch(0), "near-tangent start-on-surface"),
    Report("openmc-tangent", "openmc-dev/openmc #80",
           "From x = -10 a track is exactly tangent to r = 1, the report having a sphere",
           tube(1), (-10, 1, 0), (1, 0, 0), touch(10), "tangent", ours="cylinder"),
    Report("openmoc-barely-touching", "mit-crpg/OpenMOC #258",
           "A track cuts a circle 1e-12 radii deep",
           tube(1), (-3, 1 - Fraction("1e-12"), 0), (1, 0, 0), None, "near-tangent", large=True),
    Report("openmoc-tangent-oblique", "mit-crpg/OpenMOC #456",
           "A track is tangent to a circle at (3, 4)",
           tube(5), (-5, 10, 0), (4, -3, 0), touch(2), "tangent"),
    Report("brlcad-graze-wall", "BRL-CAD 878f52244a",
           "A ray lies in the wall, the report having a grazed cone",
           cylinder(4, 8), (0, 4, -4), (0, 0, 4), pair(1, 3), "wall rim", SEVENTHS),
    Report("brlcad-graze-rim", "BRL-CAD TODO, havoc.g s.nos5g",
           "A ray grazes an edge, which once gave one hit",
           cylinder(4, 8), (-8, 0, 4), (2, 0, 2), touch(2), "rim", ELEVENTHS),
    Report("brlcad-flat-end", "BRL-CAD acd321b55e",
           "A ray lies in the flat end of a right circular cylinder",
           DRUM, (-8, 1, 0), (2, 0, 0), None, "cap-plane"),
    Report("brlcad-above-the-end", "BRL-CAD f52963d2d2",
           "A ray runs 1e-77 above the flat end, inside the cylinder",
           DRUM, (-8, 0, Fraction("1e-77")), (2, 0, 0), None, "cap-plane", large=True),
    Report("brlcad-below-the-end", "BRL-CAD 5a09fa45bd",
           "A ray runs 1e-77 below the flat end, outside the cylinder",
           DRUM, (-8, 0, -Fraction("1e-77")), (2, 0, 0), MISS, "cap-plane", large=True),
    Report("brlcad-special-point", "BRL-CAD aaa955a6f2",
           "The reported point and direction graze the rim of a cylinder",
           rod((12400, -1268, 2134), (12400, -1268, 2234), 100), BRLCAD, (1, 0, 0), None,
           "rim tangent", ours="cylinder"),
    Report("brlcad-near-tangent", "BRL-CAD 5b99b43471",
           "The reported shot passes 1.3e-7 inside a radius of 10", cylinder(10, 40), BRLCAD_SHOT,
           (-1, 0, 0), None, "near-tangent", ours="cylinder", large=True),
    Report("celeritas-short-chord", "celeritas-project/celeritas PR #480",
           "The chord next to a tangent is 9e-8 radii long, the report having a curved track",
           tube(1), (-3, 1 - Fraction("1e-15"), 0), (1, 0, 0), None, "near-tangent", large=True),
    Report("celeritas-atlas-plane", "celeritas-project/celeritas #1902",
           "The reported ray meets a plane at a slope of -9.29e-7", half_space(ATLAS_PLANE), ATLAS,
           ATLAS_WAY, None, "near-parallel", ours="level z = 344.45", large=True),
    Report("celeritas-atlas-slab", "celeritas-project/celeritas PR #1914",
           "The reported ray sinks into a slab at a slope of -9.29e-7",
           slab(Fraction(1, 2), ATLAS_PLANE - Fraction(1, 2)), ATLAS, ATLAS_WAY, None,
           "near-parallel", ours="level and thickness", large=True),
    Report("aardvark-tangent", "aardvark-platform/aardvark.base #127",
           "A ray is exactly tangent, the report having a sphere",
           DRUM, (-8, 4, 2), (4, 0, 0), touch(2), "tangent", ELEVENTHS),
    Report("aardvark-underflow", "aardvark-platform/aardvark.base #127",
           "Every length is about 2^-540, so squares underflow, the report having a sphere",
           DRUM, (-8, 1, 2), (4, 0, 0), None, "underflow scene-scale", UPRIGHT.scaled(two(-540)),
           "range", large=True),
    Report("aardvark-overflow", "aardvark-platform/aardvark.base #127",
           "Every length is about 2^540, so squares overflow, the report having a sphere",
           DRUM, (-8, 1, 2), (4, 0, 0), None, "overflow scene-scale", UPRIGHT.scaled(two(540)),
           "range", large=True),
    Report("root-grazed-cap", "root-project/root PR #3724",
           "A ray lies in the upper plane of a slab, the report having an eight-point solid",
           slab(8), (-5, 1, 8), (3, 4, 0), pair(0, None), "cap-plane"),
    Report("shapes-touched-side", "moveit/geometric_shapes a627e6f",
           "A ray touches the side of a cylinder",
           cylinder(1, 2, -1), (-2, 1, 0), (1, 0, 0), touch(2), "tangent"),
    Report("shapes-base-and-side", "moveit/geometric_shapes a627e6f",
           "A ray passes the edge between base and side, and the opposite one",
           cylinder(1, 2, -1), (-2, 0, -2), (1, 0, 1), pair(1, 3), "rim"),
)  # fmt: skip
# Starts on surfaces, rims, and the solver.
STARTS = (
    Report("bullet-from-inside", "bulletphysics/bullet3 #459",
           "A ray starts inside and leaves through the wall", cylinder(1, 2, -1),
           at("0.25 -0.5 0.125"), at("0.75 0.375 0.5"), flags="start-inside", tier="generic"),
    Report("bullet-from-inside-axial", "bulletphysics/bullet3 #459",
           "A ray starts inside and leaves through a cap", cylinder(1, 2, -1),
           at("0.25 -0.5 0.125"), at("0.125 0.25 -1"), flags="start-inside", tier="generic"),
    Report("physx-behind", "NVIDIA PhysX #487", "The solid lies wholly behind the ray",
           cylinder(1, 2, -1), (5, 0, 0), (1, 0, 0), MISS, "behind"),
    Report("parry-inside", "dimforge/parry PR #183",
           "A ray starts inside and meets the wall from within",
           cylinder(5, 8), (0, 3, 4), (2, 0, 0), pair(0, 2), "start-inside", tier="generic"),
    Report("vecgeom-shell-outside", "VecGeom ba71e216 (VECGEOM-540)",
           "The start is 5e-10 outside the wall, in the tolerance shell, going in",
           BORE, (5 + Fraction("5e-10"), 0, 0), (-1, 0, 0), None, "start-near-surface", large=True),
    Report("vecgeom-shell-inside", "VecGeom ba71e216 (VECGEOM-540)",
           "The start is 5e-10 inside the wall, in the tolerance shell, going out",
           BORE, (5 - Fraction("5e-10"), 0, 0), (1, 0, 0), None, "start-near-surface", large=True),
    Report("vecgeom-shell-leaving", "VECGEOM-601",
           "The start is 5e-10 outside the wall, going out, the report having a cone",
           BORE, (5 + Fraction("5e-10"), 0, 0), (1, 0, 0), None, "start-near-surface", large=True),
    Report("openmc-turned-back", "openmc-dev/openmc PR #3923",
           "A particle on the wall is scattered back in, the report having a sphere",
           tube(5), (3, 4, 0), (-3, -1, 2), pair(0, Fraction(13, 5)), "start-on-surface"),
    Report("dart-surface-start", "dartsim/dart PR #3355",
           "From (0.5, 0, 0) on the wall of radius 0.5 a ray leaves, the report having a capsule",
           cylinder(HALF, 1, -HALF), (HALF, 0, 0), (1, 0, 0), touch(0), "start-on-surface",
           ours="height"),
    Report("geant4-both-zero", "Geant4 CSG/History 2004-07",
           "A ray on the wall goes almost along the axis, out by 2^-20, the report having a cone",
           BORE, (5, 0, 0), (two(-20), 0, 1), touch(0), "start-on-surface near-parallel"),
    Report("dart-rim", "dartsim/dart PR #3359",
           "A ray meets the rim of a cylinder from above, the report having a swept sphere",
           DRUM, (-8, 0, 12), (4, 0, -4), pair(1, 3), "rim", tier="generic"),
    Report("fluid-engine-above", "doyubkim/fluid-engine-dev #251",
           "A ray meets the infinite cylinder above the upper cap only",
           cylinder(1, 2, -1), (-2, 0, 2), (1, 0, 1), MISS, tier="generic"),
    Report("fluid-engine-below", "doyubkim/fluid-engine-dev #251",
           "A ray meets the infinite cylinder below the lower cap only",
           cylinder(1, 2, -1), (-2, 0, -2), (1, 0, -1), MISS, tier="generic"),
    Report("openmc-two-surfaces", "openmc-dev/openmc #116",
           "From outside a ray is aimed at an edge, the report having the corner of a lattice",
           DRUM, (-8, 0, 4), (2, 0, 2), touch(2), "rim"),
    Report("openmc-two-surfaces-inside", "openmc-dev/openmc #81",
           "From inside a ray is aimed at an edge, the report having a sphere cut by a plane",
           DRUM, (0, 0, 4), (2, 0, 2), pair(0, 2), "rim start-inside"),
    Report("arborx-zero-b", "arborx/ArborX PR #461",
           "The start is the closest approach to the axis, so the linear coefficient is zero",
           tube(5), (0, 3, 0), (2, 0, 7), pair(0, 2), "start-inside", tier="generic"),
    Report("numworks-quadratic", "numworks/epsilon #2038",
           "The quadratic t^2 - (1 + 2^-52) t + 1/4 + 2^-53 has the roots 1/2 and 1/2 + 2^-52",
           tube(two(-BITS), 1), (-HERE, 0, 0), (1, 0, 0), pair(Fraction(1, 2), HERE + two(-BITS)),
           "needle", ours="solid", large=True),
)  # fmt: skip
CAN = cylinder(HALF, 2)
PIN = cylinder(1, 2, -1)
LATTICE_PITCH = Fraction("173.205")
# Far starts, unusual scales, thin and small solids.
SCALES = (
    Report("geant4-far", "Geant4 report #1022",
           "The start is 1e7 radii from a tube, its chord at 0.6 radii",
           cylinder(5, 16), (-5 * 10**7, 3, 8), (4, 0, 0), None, "far", large=True),
    Report("mitsuba-far", "mitsuba-renderer/mitsuba3 #1594",
           "The start is 1e4 radii from a cylinder, its chord at 0.6 radii",
           tube(5), (-4 * 10**4, 3, 0), (4, 0, 0), pair(10**4 - 1, 10**4 + 1), "far"),
    Report("mitsuba-far-oblique", "mitsuba-renderer/mitsuba3 PR #1600",
           "The start is 1e4 directions away, the chord at 0.6 radii", cylinder(5, 16),
           (-4 * 10**4, 3, 8), (4, 0, 0), pair(10**4 - 1, 10**4 + 1), "far", THIRDS),
    Report("jolt-centre", "jrouwe/JoltPhysics #1818",
           "Over 12,000 units a ray meets the middle of a cylinder",
           CAN, (-12000, 0, 1), (12000, 0, 0), None, "far direction-scale", ON_Y, ours="the rest"),
    Report("jolt-halfway", "jrouwe/JoltPhysics #1818",
           "Over 12,000 units a ray meets a cylinder halfway out", CAN, (-12000, Fraction(1, 4), 1),
           (12000, 0, 0), None, "far direction-scale", ON_Y, ours="the rest"),
    Report("jolt-edge", "jrouwe/JoltPhysics #1818",
           "Over 12,000 units a ray meets a cylinder at 0.98 of its radius",
           CAN, (-12000, Fraction("0.49"), 1), (12000, 0, 0), None, "far direction-scale", ON_Y,
           ours="the rest"),
    Report("jolt-oblique", "jrouwe/JoltPhysics #1818",
           "Over 12,000 units a ray meets a cylinder on a slant", CAN, at("-9600 0.125 -7199"),
           (9600, 0, 7200), None, "far direction-scale", ON_Y, ours="the rest"),
    Report("pbrt-distant-edge", "mmp/pbrt-v3 #44",
           "10,000 units out, as the sphere reported, a unit cylinder is met at 0.95 radii",
           pipe((10000, 0, 0), (10000, 0, 8), 1), (9995, Fraction("0.95"), 0), (1, 0, 0), None,
           "displaced", ours="cylinder and ray"),
    Report("openmc-lattice-in", "openmc-dev/openmc #1383",
           "A start on a lattice plane 173 units out goes in", slab(1, LATTICE_PITCH),
           (0, 0, LATTICE_PITCH), at("0.6 0 0.8"), None, "start-on-surface displaced", ON_X),
    Report("openmc-lattice-out", "openmc-dev/openmc PR #1414",
           "A start on a lattice plane 173 units out goes out", slab(1, LATTICE_PITCH),
           (0, 0, LATTICE_PITCH), at("0.6 0 -0.8"), touch(0), "start-on-surface displaced", ON_X),
    Report("brlcad-sliver", "BRL-CAD e605a55594",
           "A slab is 0.005 thick, half of the step that once jumped over it",
           slab(Fraction("0.005")), (1, 2, -3), (2, 0, 1), None, "disk", ours="the rest"),
    Report("brlcad-grazed-box", "BRL-CAD 871aacbd2a",
           "The start lies in a plane of a slab and the direction is level",
           slab(8), (-5, 1, 0), (1, 0, 0), ALWAYS, "cap-plane"),
    Report("openusd-short-direction", "PixarAnimationStudios/OpenUSD PR #4221",
           "With r = 1, h = 2, from (0, -2, 0) along (0, 1e-5, 0), the list is near [1e5, 3e5]",
           PIN, (0, -2, 0), at("0 1e-5 0"), None, "direction-scale", ours=GIVEN),
    Report("shapes-long-direction", "moveit/geometric_shapes 074502d",
           "The direction is two units long",
           PIN, (-3, 0, 0), (2, 0, 0), pair(1, 2), "direction-scale"),
    Report("shapes-half-direction", "moveit/geometric_shapes 074502d",
           "The direction is half a unit long",
           PIN, (-3, 0, 0), (HALF, 0, 0), pair(4, 8), "direction-scale"),
    Report("openmc-drifted-norm", "openmc-dev/openmc #192",
           "A direction of norm near 1 + 1e-6 is reflected into a cylinder from its wall",
           tube(5), (3, 4, 0), at("-0.6000006 -0.8000008 0"), None, "start-on-surface"),
    Report("ospray-epsilon", "RenderKit/ospray #279",
           "Inside r = 1/2 every hit is nearer than the reported epsilon 1.442", cylinder(HALF, 2),
           (0, 0, 1), at("0.6 0 0.8"), None, "start-inside start-near-surface", ours="the rest"),
    Report("ospray-long-cylinder", "RenderKit/ospray #600",
           "A cylinder from (0, 0, 0) to (30000, 0, 0) is met near its far end", cylinder(1, 30000),
           (-3, 0, 29000), (1, 0, 0), pair(2, 4), "needle", ON_X, ours="radius and ray"),
    Report("shapes-tiny-radius", "moveit/geometric_shapes #28",
           "A ray goes through the axis at a radius of 1e-9, the report having a mesh loop",
           cylinder(Fraction("1e-9"), 1), (-1, 0, HALF), (1, 0, 0), None, "needle"),
    Report("visrtx-zero-radius", "NVIDIA/VisRTX PR #334",
           "The radius is zero and the ray crosses the axis",
           cylinder(0, 2), (-3, 0, 1), (1, 0, 0), touch(3), "zero-radius"),
    Report("brlcad-small", "BRL-CAD NEWS, small TGC",
           "Radius and height are 1e-6 and the start is one unit away",
           cylinder(Fraction("1e-6"), Fraction("1e-6")), (-1, 0, Fraction("4e-7")), (1, 0, 0), None,
           "scene-scale far", large=True),
    Report("occt-small-cylinder", "OCCT OCC22318",
           "Radius and height are 1e-7 and a ray starts close by, the report being of shading",
           cylinder(Fraction("1e-7"), Fraction("1e-7")), at("-3e-7 2e-8 4e-8"), at("1e-7 0 0"),
           None, "scene-scale"),
)  # fmt: skip
BODY = cylinder(1, 4, -2)
ALL = "raysect 0.9.1, MuJoCo 4.0.0, Geant4 11.4.p01, Bullet 3.2.7"
FAR = "Geant4 11.4.p01 G4Tubs"
TILT = near(BINARY64, Fraction("1e-8"))
# Measured on public engines, most with r = 1 and |z| <= 2.
MEASURED = (
    Report("m0-generic", f"measured (M0): {ALL}",
           "A generic ray, on which every engine is right to its precision",
           BODY, at("-3 0.3 -0.7"), at("1 0.1 0.2"), tier="generic", ours="ray"),
    Report("m1-tilted", "measured (M1): MuJoCo 4.0.0, Geant4 11.4.p01, Bullet 3.2.7",
           "Tilted by 1e-8, a ray from the axis meets the wall at 1e8, far below the cap at 1e9",
           cylinder(1, 10**9), (0, 0, 0), (TILT, 0, 1), pair(0, 1 / TILT), "near-parallel needle",
           ours="start", large=True),
    Report("m1-tilted-from-outside", "measured (M1): MuJoCo 4.0.0, Geant4 11.4.p01, Bullet 3.2.7",
           "Tilted by 1e-8, a ray from two radii away meets the wall at 1e8 and again at 3e8",
           cylinder(1, 10**9), (-2, 0, 0), (TILT, 0, 1), pair(1 / TILT, 3 / TILT),
           "near-parallel needle", ours="start", large=True),
    Report("m2-tangent", "measured (M2): Bullet 3.2.7, scikit-spatial 10",
           "A ray passes 1e-15 radii inside tangency", BODY, (-3, 1 - Fraction("1e-15"), 0),
           (1, 0, 0), None, "near-tangent", ours="start", large=True),
    Report("m2-tangent-exact", "measured (M2): Bullet 3.2.7",
           "A ray is exactly tangent to the unit cylinder",
           BODY, (-3, 1, 0), (1, 0, 0), touch(3), "tangent", ON_Y, ours="start"),
    Report("m3-far", "measured (M3): raysect 0.9.1, MuJoCo 4.0.0, OCCT 8.0.1, scikit-spatial 10",
           "From 1e8 radii a ray passes at 0.95 of the radius",
           BODY, (-(10**8), Fraction("0.95"), 0), (1, 0, 0), None, "far", ours=GIVEN, large=True),
    Report("m4-deep-1e8", f"measured (M4): {FAR}",
           "From 1e8 radii a perpendicular ray passes at 0.3 of the radius",
           BODY, (-(10**8), Fraction("0.3"), 1), (1, 0, 0), None, "far perpendicular",
           ours="offset", large=True),
    Report("m4-deep-10e7", f"measured (M4): {FAR}",
           "From 1e7 radii a perpendicular ray passes at 0.3 of the radius",
           BODY, (-(10**7), Fraction("0.3"), 1), (1, 0, 0), None, "far perpendicular",
           ours="offset", large=True),
    Report("m4-between", f"measured (M4): {FAR}",
           "From 10^7.5 radii a perpendicular ray passes at 0.7 of the radius",
           BODY, (-31622777, Fraction("0.7"), -1), (1, 0, 0), None, "far perpendicular",
           ours="offset", large=True),
    Report("m4-1e9", f"measured (M4): {FAR}",
           "From 1e9 radii a perpendicular ray passes at 0.5 of the radius",
           BODY, (-(10**9), Fraction(1, 2), 1), (1, 0, 0), None, "far perpendicular", ours="offset",
           large=True),
    Report("m5-oblique-1e8", "measured (M5): Mitsuba 3.9.1, scikit-spatial 10",
           "From 1e8 steps an oblique ray goes through the centre",
           BODY, (-4 * 10**8, 0, -3 * 10**8), (4, 0, 3),
           pair(10**8 - Fraction(1, 4), 10**8 + Fraction(1, 4)), "far", SEVENTHS, ours="ray",
           large=True),
    Report("m5-oblique-1e10", "measured (M5): raysect 0.9.1, MuJoCo 4.0.0, Geant4 11.4.p01",
           "From 1e10 steps an oblique ray goes through the centre",
           BODY, (-4 * 10**10, 0, -3 * 10**10), (4, 0, 3),
           pair(10**10 - Fraction(1, 4), 10**10 + Fraction(1, 4)), "far", SEVENTHS, ours="ray",
           large=True),
    Report("m6-radius-1e-9", "measured (M6): raysect 0.9.1",
           "The radius is 1e-9 and the ray goes through the axis from one unit away",
           cylinder(Fraction("1e-9"), 4, -2), (-1, 0, 0), (1, 0, 0), None, "needle far",
           ours="ray"),
    Report("m6-radius-1e-6", f"measured (M6): {ALL}",
           "The radius is 1e-6 and the ray passes halfway to the wall from one unit away",
           cylinder(Fraction("1e-6"), 4, -2), (-1, Fraction("5e-7"), 0), (1, 0, 0), None,
           "needle far", ours="ray", large=True),
    Report("m8-disk", "measured (M8): OCCT 8.0.1",
           "A ray grazes down through a disk of radius 1e3 and thickness 1e-9",
           cylinder(1000, Fraction("1e-9")), (-2000, 0, 2), (1000, 0, -1), None, "disk", ours="ray",
           large=True),
    Report("m8-disk-level", "measured (M8): OCCT 8.0.1",
           "A ray lies in the upper face of a disk of radius 1e3 and thickness 1e-9",
           cylinder(1000, Fraction("1e-9")), (-2000, 0, Fraction("1e-9")), (1000, 0, 0), None,
           "disk cap-plane", ours="ray", large=True),
    Report("m9-short-direction", "measured (M9): MuJoCo 4.0.0, trimesh 5.2.0",
           "The direction is 1e-9 long",
           BODY, (-3, 0, 0), (Fraction("1e-9"), 0, 0), None, "direction-scale", ours="start"),
    Report("m10-in-the-wall", "measured (M10): Geant4 11.4.p01, Bullet 3.2.7",
           "A ray lies in the wall",
           BODY, (0, 1, -4), (0, 0, 1), pair(2, 6), "wall rim", ours="start"),
    Report("m10-in-the-cap", "measured (M10): Geant4 11.4.p01, Bullet 3.2.7",
           "A ray lies in the plane of a cap",
           BODY, (-3, 0, 2), (1, 0, 0), pair(2, 4), "cap-plane rim", ours="start"),
    Report("m10-start-inside", f"measured (M10): {ALL}",
           "From the centre a ray meets the wall at t = 1, the square root of 2 away",
           BODY, (0, 0, 0), (1, 0, 1), pair(0, 1), "start-inside", tier="generic", ours="ray"),
    Report("m10-wall-out", f"measured (M10): {ALL}", "A ray starts on the wall and goes out",
           BODY, (1, 0, 0), (1, 0, 0), touch(0), "start-on-surface", ours="start"),
    Report("m10-wall-tangent", f"measured (M10): {ALL}",
           "A ray starts on the wall and goes along the tangent",
           BODY, (1, 0, 0), (0, 1, 0), touch(0), "start-on-surface tangent", ours="start"),
    Report("trimesh-long-direction", "measured (K67): trimesh 5.2.0", "The direction is 1e6 long",
           BODY, (-3, 0, 0), (10**6, 0, 0), None, "direction-scale", ours="start"),
    Report("trimesh-short-direction", "measured (K67): trimesh 5.2.0", "The direction is 1e-6 long",
           BODY, (-3, 0, 0), (Fraction("1e-6"), 0, 0), None, "direction-scale", ours="start"),
    Report("tilted-annulus", "measured (K68): trimesh 5.2.0",
           "Tilted by 2^-20, a ray stays between the wall and an inscribed mesh of 256 facets",
           BODY, (1 - two(-16), 0, -3), (two(-20), 0, 1), None, "near-parallel near-rim",
           ours="ray"),
    Report("annulus-outside", "measured (K68): trimesh 5.2.0",
           "A ray passes wide of the wall but inside a circumscribed mesh of 256 facets",
           BODY, (-3, 1 + two(-16), 0), (1, 0, 0), MISS, "near-tangent", ours="ray and mesh"),
)  # fmt: skip

FAMILIES = (
    family("reports", "Faults reported in public, or measured on public engines.",
           shots(PARALLEL, TANGENTS, STARTS, SCALES, MEASURED)),
)  # fmt: skip
