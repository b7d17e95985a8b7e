"""The legend of flags: what each says is hard in a case, what breaks there, and where to read.

Every reference is a page, a paper by its DOI, or a file of this project.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Flag:
    """One entry: the kind of trouble, its effect on an unsound tracer, and where to read of it."""

    name: str
    trouble: str
    effect: str
    references: tuple[str, ...]


_HUB = "https://github.com/"
_GEANT4 = _HUB + "Geant4/geant4/blob/master/source/geometry/solids/"
_GEANT4_BUG = "https://bugzilla-geant4.kek.jp/show_bug.cgi?id="
_IEEE_754 = "doi:10.1109/IEEESTD.2019.8766229"

_LEGEND: tuple[tuple[str, ...], ...] = (
    ("tangent",
     "The ray touches the curved face in one point, so the discriminant is exactly zero.",
     "A rounded discriminant turns negative: a miss or the square root of a negative number.",
     _GEANT4 + "CSG/History", _HUB + "openmc-dev/openmc/issues/80"),
    ("near-tangent",
     "The gap to tangency is small, so the discriminant is a small difference of large numbers.",
     "Endpoints lose half their digits; hit and miss trade places.",
     _HUB + "celeritas-project/celeritas/pull/480", _HUB + "BRL-CAD/brlcad/commit/5b99b43471"),
    ("rim", "The ray passes through the circle where wall and cap meet.",
     "The point is counted by both faces, or by neither.",
     _HUB + "moveit/geometric_shapes/commit/a627e6f", _HUB + "dartsim/dart/pull/3359"),
    ("near-rim", "The ray passes close to a rim, inside or outside.",
     "A strict and a loose comparison disagree, and a short chord is lost or made up.",
     _HUB + "openmc-dev/openmc/issues/81"),
    ("wall", "The ray lies in the curved face.", "Inside and outside differ by rounding only.",
     "cases/README.md"),
    ("cap-plane", "The ray lies in the plane of a cap or of a half-space.",
     "0/0 in the crossing of the plane, or an epsilon too small to act.",
     _HUB + "BRL-CAD/brlcad/commit/5a09fa45bd", _HUB + "root-project/root/pull/3724"),
    ("parallel", "The direction is parallel to the axis, so the quadratic has no t^2.",
     "Division by zero; the caps are forgotten and the ray misses.",
     _HUB + "bepu/bepuphysics2/issues/253", _HUB + "aardvark-platform/aardvark.base/issues/123"),
    ("near-parallel", "The direction is almost parallel to the axis or to a plane.",
     "A tiny leading coefficient is taken for zero, or gives enormous wrong roots.",
     _HUB + "celeritas-project/celeritas/issues/621", _HUB + "mccode-dev/McCode/issues/986"),
    ("perpendicular", "The direction is square to the axis, so it never crosses the cap planes.",
     "Division by zero at the caps; the solid vanishes.", _HUB + "RenderKit/ospray/issues/482"),
    ("start-inside", "The ray starts inside the solid.",
     "The pair begins at a negative parameter, or the exit is reported as the entry.",
     _HUB + "bulletphysics/bullet3/issues/459"),
    ("start-on-surface", "The ray starts exactly on a face.",
     "The endpoint at 0 comes out as a tiny number of either sign.",
     _GEANT4 + "CSG/History", _HUB + "openmc-dev/openmc/pull/3923"),
    ("start-near-surface", "The ray starts within a small distance of a face.",
     "An epsilon against self-hits swallows a true hit, or lets a false one through.",
     _HUB + "RenderKit/ospray/issues/279", "https://gitlab.cern.ch/VecGeom/VecGeom/-/commit/ba71e216"),
    ("behind", "The solid lies behind the start.", "Negative parameters are reported as hits.",
     _HUB + "erincatto/box2d/issues/523"),
    ("far", "The start is many radii away from the solid.",
     "b^2 - ac cancels: the solid shrinks, tears or vanishes.",
     _GEANT4_BUG + "1022", _HUB + "jrouwe/JoltPhysics/issues/1818"),
    ("needle", "The solid is much longer than it is wide.",
     "Errors in proportion to the length exceed the radius.", _HUB + "RenderKit/ospray/issues/600"),
    ("disk", "The solid is much wider than it is thick.",
     "Errors in proportion to the radius exceed the thickness.", "oracle/plots/shown/stress.png"),
    ("displaced", "The solid is far from the coordinate origin, seen in its own size.",
     "Forms expanded about the coordinate origin cancel.", _HUB + "mmp/pbrt-v3/issues/44"),
    ("direction-scale", "The direction is very short or very long.",
     "A fixed threshold takes the direction, or its square, for zero.",
     _HUB + "PixarAnimationStudios/OpenUSD/pull/4221"),
    ("scene-scale", "The whole scene is very small or very large.",
     "Fixed thresholds swallow the solid; high powers leave the range.",
     _HUB + "moveit/geometric_shapes/issues/28"),
    ("overflow", "Squares or products of the inputs exceed the largest number.",
     "Infinities and NaN on the way to an answer that is representable.",
     "doi:10.1145/355769.355771"),
    ("underflow", "Squares or products of the inputs fall below the smallest normal number.",
     "Coefficients vanish on the way to an answer that is representable.",
     _HUB + "aardvark-platform/aardvark.base/issues/127"),
    ("subnormal", "Inputs or endpoints are subnormal numbers.",
     "Flushing to zero makes the radius, the axis or the direction vanish.", _IEEE_754),
    ("zero-direction", "The direction is zero: the ray stays where it starts.",
     "Normalising divides by zero.", _HUB + "tommy-xr/shock2quest/pull/409"),
    ("zero-radius", "The radius is zero: the solid is a line or a segment.",
     "The solid vanishes, or its touch is lost.", _HUB + "NVIDIA/VisRTX/pull/334"),
    ("signed-zero", "A component is -0.",
     "A sign test or a division by the component takes -0 for negative.", _IEEE_754),
    ("tie", "An endpoint lies exactly halfway between two numbers of the format.",
     "Any rounding on the way decides the last bit.", "doi:10.1109/TC.2008.202"),
    ("hard-to-round",
     "An endpoint lies extremely close to halfway between two numbers of the format.",
     "Working precision in the hundreds of bits still rounds it the wrong way.",
     "doi:10.1109/ARITH.2001.930110"),
    ("reported", "A public report or a measurement on a public engine describes this trigger.",
     "As reported: see the source of the case.", "cases/families/reports.py"),
    ("large", "The solid is much larger than the distance from which it is seen.",
     "|y|^2 - r^2 cancels: the start is lost on the wrong side of the surface.",
     _HUB + "mmp/pbrt-v4/commit/5f7a6068", _GEANT4 + "CSG/History"),
    ("coincident-faces", "Faces of two parts lie on one another along the ray.",
     "Rounding decides which comes first: phantom slivers, or a removed wall that is hit.",
     _HUB + "POV-Ray/povray/issues/209"),
    ("touching-parts", "Parts touch in a point, a line or a face, and share no more.",
     "A union falls in two, or an intersection loses its touch or makes one up.",
     _HUB + "mantidproject/mantid/issues/32971"),
    ("closure", "A Boolean of closed lists is to be closed again, and only that.",
     "A touch survives its removal, or a removed point leaves two intervals.",
     "cases/README.md", _HUB + "dzhus/csg/blob/master/src/Data/CSG.hs"),
    ("order", "The same parts stand in another order elsewhere.",
     "Unions and intersections depend on the order of their operands.", _GEANT4_BUG + "723"),
    ("deep-tree", "Booleans stand in Booleans, three levels deep or more.",
     "The sense of a face is lost on the way up.", _GEANT4 + "Boolean/History"),
    ("many-intervals", "The list has three intervals or more.",
     "A tracer that keeps one entry and one exit drops the others.",
     _HUB + "dzhus/csg/blob/master/src/Data/CSG.hs"),
    ("hollow", "One part is taken out of the middle of another.",
     "The way through the hole is filled, or its far wall is lost.",
     _HUB + "Project-10/OpenRT/issues/27"),
    ("endless", "A part has no end, and the list may have none either.",
     "An infinity is subtracted from another, or is no longer recognised.", _IEEE_754),
    ("empty", "A node of the tree has an empty list.",
     "An empty list is taken for a missing operand.", _GEANT4_BUG + "979"),
    ("equal-endpoints", "Surfaces of different parts are crossed at exactly the same t.",
     "Two roundings of one number disagree, and leave a sliver or a gap.",
     _HUB + "openmc-dev/openmc/issues/2618"),
    ("ulp-apart", "Faces of different parts are one unit in the last place apart.",
     "A tolerance merges what is apart, or rounding exchanges the two.",
     _HUB + "openmc-dev/openmc/issues/1383"),
    ("near-touching", "Parts almost touch: a gap or an overlap much smaller than they are.",
     "The gap is closed, or the overlap is lost.", _HUB + "openmc-dev/openmc/issues/1383"),
    ("merged-by-rounding",
     "A gap between two intervals is below half a unit in the last place of t.",
     "The two ends round to one number, and are given as two pairs that touch.", "cases/README.md"),
    ("thin-wall", "What a difference leaves is much thinner than the parts it is made of.",
     "Errors in proportion to the parts exceed the wall.",
     _HUB + "BRL-CAD/brlcad/commit/89ad1e2a58", _HUB + "AIDASoft/DD4hep/issues/784"),
)  # fmt: skip
"""Name, trouble, effect, and the references."""

FLAGS: dict[str, Flag] = {
    name: Flag(name, trouble, effect, tuple(references))
    for name, trouble, effect, *references in _LEGEND
}
"""The legend by name."""
