"""The legend of flags: what each says is hard in a case, what breaks there, and where to read.

References named (failures, ...) are sections of the project's survey of public reports.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Flag:
    """One entry: the kind of trouble, its effect on an unsound tracer, and a reference."""

    name: str
    trouble: str
    effect: str
    reference: str


_LEGEND = (
    Flag(
        "tangent",
        "The ray touches the curved face in one point, so the discriminant is exactly zero.",
        "A rounded discriminant turns negative: a miss or the square root of a negative number.",
        "Geant4 CSG/History 2007-08-16; openmc-dev/openmc #80",
    ),
    Flag(
        "near-tangent",
        "The gap to tangency is small, so the discriminant is a small difference of large numbers.",
        "Endpoints lose half their digits; hit and miss trade places.",
        "celeritas-project/celeritas PR #480; BRL-CAD 5b99b43471",
    ),
    Flag(
        "rim",
        "The ray passes through the circle where wall and cap meet.",
        "The point is counted by both faces, or by neither.",
        "moveit/geometric_shapes a627e6f; dartsim/dart PR #3359",
    ),
    Flag(
        "near-rim",
        "The ray passes close to a rim, inside or outside.",
        "A strict and a loose comparison disagree, and a short chord is lost or made up.",
        "openmc-dev/openmc #81",
    ),
    Flag(
        "wall",
        "The ray lies in the curved face.",
        "Inside and outside differ by rounding only.",
        "failures M10",
    ),
    Flag(
        "cap-plane",
        "The ray lies in the plane of a cap or of a half-space.",
        "0/0 in the crossing of the plane, or an epsilon too small to act.",
        "BRL-CAD 5a09fa45bd; root-project/root PR #3724",
    ),
    Flag(
        "parallel",
        "The direction is parallel to the axis, so the quadratic has no t^2.",
        "Division by zero; the caps are forgotten and the ray misses.",
        "bepu/bepuphysics2 #253; aardvark-platform/aardvark.base #123",
    ),
    Flag(
        "near-parallel",
        "The direction is almost parallel to the axis or to a plane.",
        "A tiny leading coefficient is taken for zero, or gives enormous wrong roots.",
        "celeritas-project/celeritas #621; mccode-dev/McCode #986",
    ),
    Flag(
        "perpendicular",
        "The direction is square to the axis, so it never crosses the cap planes.",
        "Division by zero at the caps; the solid vanishes.",
        "RenderKit/ospray #482",
    ),
    Flag(
        "start-inside",
        "The ray starts inside the solid.",
        "The pair begins at a negative parameter, or the exit is reported as the entry.",
        "bulletphysics/bullet3 #459",
    ),
    Flag(
        "start-on-surface",
        "The ray starts exactly on a face.",
        "The endpoint at 0 comes out as a tiny number of either sign.",
        "Geant4 CSG/History 2008-06-23; openmc-dev/openmc PR #3923",
    ),
    Flag(
        "start-near-surface",
        "The ray starts within a small distance of a face.",
        "An epsilon against self-hits swallows a true hit, or lets a false one through.",
        "RenderKit/ospray #279; VecGeom ba71e216",
    ),
    Flag(
        "behind",
        "The solid lies behind the start.",
        "Negative parameters are reported as hits.",
        "NVIDIA PhysX #487",
    ),
    Flag(
        "far",
        "The start is many radii away from the solid.",
        "b^2 - ac cancels: the solid shrinks, tears or vanishes.",
        "Geant4 report #1022; jrouwe/JoltPhysics #1818; failures M3 to M5",
    ),
    Flag(
        "needle",
        "The solid is much longer than it is wide.",
        "Errors in proportion to the length exceed the radius.",
        "RenderKit/ospray #600; failures M6",
    ),
    Flag(
        "disk",
        "The solid is much wider than it is thick.",
        "Errors in proportion to the radius exceed the thickness.",
        "failures M8",
    ),
    Flag(
        "displaced",
        "The solid is far from the coordinate origin, seen in its own size.",
        "Forms expanded about the coordinate origin cancel.",
        "mmp/pbrt-v3 #44",
    ),
    Flag(
        "direction-scale",
        "The direction is very short or very long.",
        "A fixed threshold takes the direction, or its square, for zero.",
        "PixarAnimationStudios/OpenUSD PR #4221; failures M9",
    ),
    Flag(
        "scene-scale",
        "The whole scene is very small or very large.",
        "Fixed thresholds swallow the solid; high powers leave the range.",
        "moveit/geometric_shapes #28",
    ),
    Flag(
        "overflow",
        "Squares or products of the inputs exceed the largest number.",
        "Infinities and NaN on the way to an answer that is representable.",
        "numerics table 2",
    ),
    Flag(
        "underflow",
        "Squares or products of the inputs fall below the smallest normal number.",
        "Coefficients vanish on the way to an answer that is representable.",
        "aardvark-platform/aardvark.base #127",
    ),
    Flag(
        "subnormal",
        "Inputs or endpoints are subnormal numbers.",
        "Flushing to zero makes the radius, the axis or the direction vanish.",
        "IEEE 754-2019, 3.4",
    ),
    Flag(
        "zero-direction",
        "The direction is zero: the ray stays where it starts.",
        "Normalising divides by zero.",
        "tommy-xr/shock2quest PR #409",
    ),
    Flag(
        "zero-radius",
        "The radius is zero: the solid is a line or a segment.",
        "The solid vanishes, or its touch is lost.",
        "NVIDIA/VisRTX PR #334",
    ),
    Flag(
        "signed-zero",
        "A component is -0.",
        "A sign test or a division by the component takes -0 for negative.",
        "IEEE 754-2019, 6.3",
    ),
    Flag(
        "tie",
        "An endpoint lies exactly halfway between two numbers of the format.",
        "Any rounding on the way decides the last bit.",
        "numerics table 3",
    ),
    Flag(
        "hard-to-round",
        "An endpoint lies extremely close to halfway between two numbers of the format.",
        "Working precision in the hundreds of bits still rounds it the wrong way.",
        "numerics table 6",
    ),
    Flag(
        "reported",
        "A public report or a measurement on a public engine describes this trigger.",
        "As reported: see the source of the case.",
        "failures, sections A to M",
    ),
    Flag(
        "large",
        "The solid is much larger than the distance from which it is seen.",
        "|y|^2 - r^2 cancels: the start is lost on the wrong side of the surface.",
        "mmp/pbrt-v4 5f7a6068; Geant4 2002-01-10",
    ),
    Flag(
        "coincident-faces",
        "Faces of two parts lie on one another along the ray.",
        "Rounding decides which comes first: phantom slivers, or a removed wall that is hit.",
        "POV-Ray/povray #209; failures M7",
    ),
    Flag(
        "touching-parts",
        "Parts touch in a point, a line or a face, and share no more.",
        "A union falls in two, or an intersection loses its touch or makes one up.",
        "mantidproject/mantid #32971; failures M7",
    ),
    Flag(
        "closure",
        "A Boolean of closed lists is to be closed again, and only that.",
        "A touch survives its removal, or a removed point leaves two intervals.",
        "design, section 1; dzhus/csg src/Data/CSG.hs",
    ),
    Flag(
        "order",
        "The same parts stand in another order elsewhere.",
        "Unions and intersections depend on the order of their operands.",
        "Geant4 report #723; failures M7",
    ),
    Flag(
        "deep-tree",
        "Booleans stand in Booleans, three levels deep or more.",
        "The sense of a face is lost on the way up.",
        "Geant4 Boolean/History 2011-05-27",
    ),
    Flag(
        "many-intervals",
        "The list has three intervals or more.",
        "A tracer that keeps one entry and one exit drops the others.",
        "dzhus/csg src/Data/CSG.hs",
    ),
    Flag(
        "hollow",
        "One part is taken out of the middle of another.",
        "The way through the hole is filled, or its far wall is lost.",
        "OpenRT #27",
    ),
    Flag(
        "endless",
        "A part has no end, and the list may have none either.",
        "An infinity is subtracted from another, or is no longer recognised.",
        "IEEE 754-2019, 7.2",
    ),
    Flag(
        "empty",
        "A node of the tree has an empty list.",
        "An empty list is taken for a missing operand.",
        "Geant4 report #979",
    ),
    Flag(
        "equal-endpoints",
        "Surfaces of different parts are crossed at exactly the same t.",
        "Two roundings of one number disagree, and leave a sliver or a gap.",
        "openmc-dev/openmc #2618",
    ),
    Flag(
        "ulp-apart",
        "Faces of different parts are one unit in the last place apart.",
        "A tolerance merges what is apart, or rounding exchanges the two.",
        "openmc-dev/openmc #1383",
    ),
    Flag(
        "near-touching",
        "Parts almost touch: a gap or an overlap much smaller than they are.",
        "The gap is closed, or the overlap is lost.",
        "openmc-dev/openmc #1383",
    ),
    Flag(
        "merged-by-rounding",
        "A gap between two intervals is below half a unit in the last place of t.",
        "The two ends round to one number, and are given as two pairs that touch.",
        "design, section 1",
    ),
    Flag(
        "thin-wall",
        "What a difference leaves is much thinner than the parts it is made of.",
        "Errors in proportion to the parts exceed the wall.",
        "BRL-CAD 89ad1e2a58; DD4hep #784",
    ),
)

FLAGS: dict[str, Flag] = {flag.name: flag for flag in _LEGEND}
"""The legend by name."""
