"""Reports of sphere and Boolean faults; each sentence says whose the numbers are."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from raycert.cases.case import Case, Family, Tier
from raycert.cases.families.csg_faces import drum
from raycert.cases.families.frames import SEVENTHS, THIRDS, UPRIGHT, Exact, Frame
from raycert.cases.families.ladders import is_double
from raycert.cases.families.report import NUMBERS, at, number
from raycert.cases.families.shapes import (
    Shape,
    all_of,
    any_of,
    ball,
    below,
    layer,
    less,
    pipe,
    rod,
    scene,
    spans,
)
from raycert.cases.families.sketch import MISS, Pairs, pair, ten, touch, two
from raycert.cases.formats import Format


@dataclass(frozen=True, slots=True)
class Told:
    """One reported trigger, like `report.Report`, with any shape for its solid."""

    slug: str
    source: str
    why: str
    shape: Shape
    origin: Exact
    direction: Exact
    known: Pairs | None = None
    flags: tuple[str, ...] = ()
    frame: Frame = UPRIGHT
    tier: Tier = "generic"
    ours: str = NUMBERS
    large: bool = False

    @property
    def sentence(self) -> str:
        """Return the fact, and whose numbers these are."""
        return f"{self.why}; {self.ours} chosen here"


GLOBE = ball(6371000, 0, 0, -6371000)
COMB = less(rod((0, 0, 0), (10, 0, 0), 1), layer((2, 0, 0), (3, 0, 0)))
AHEAD: Exact = (1, 0, 0)
LEFT, RIGHT = (rod((x, 0, -1), (x, 0, 1), 1) for x in (4, 6))
ROUND, TURNED = rod((0, 0, -2), (0, 0, 2), 1), rod((0, 0, 2), (0, 0, -2), 1)


def _cube(low: Exact, high: Exact) -> Shape:
    """Return the box between two corners, as three slabs."""
    return all_of(
        *(
            layer(low, (*low[:i], high[i], *low[i + 1 :]))  # type: ignore[arg-type]
            for i in range(3)
        )
    )


SPHERES = (
    Told("pytracer-scaled", "pytracer #22",
         "From (-1e7, 0.095), a ray meets a sphere of radius 0.1",
         ball(number("0.1")), at("-1e7 0.095 0"), AHEAD, None, ("far",), tier="stiff",
         ours="the rest", large=True),
    Told("aardvark-tangent", "aardvark-platform/aardvark.base #127", "A ray is exactly tangent",
         ball(4), (-8, 4, 0), (4, 0, 0), touch(2), ("tangent",)),
    Told("aardvark-touch", "aardvark-platform/aardvark.base #127", "A ray touches at (1, 2, 2)",
         ball(3), (-3, 0, 6), (2, 1, -2), touch(2), ("tangent",)),
    Told("aardvark-overflow", "aardvark-platform/aardvark.base #127", "The discriminant overflows",
         ball(5), (-8, 3, 0), (4, 0, 0), pair(1, 3), ("overflow",), UPRIGHT.scaled(two(60)),
         "range"),
    Told("aardvark-underflow", "aardvark-platform/aardvark.base #127",
         "The discriminant underflows",
         ball(5), (-8, 3, 0), (4, 0, 0), pair(1, 3), ("underflow",), UPRIGHT.scaled(two(-60)),
         "range"),
    Told("mitsuba3-far", "mitsuba-renderer/mitsuba3 #512", "A sphere is met 1e4 radii away",
         ball(1), (-ten(4), Fraction(3, 4), 0), AHEAD, None, ("far",), tier="stiff"),
    Told("mitsuba2-far", "mitsuba-renderer/mitsuba2 #171", "A sphere is met 1e5 radii away",
         ball(1), (-ten(5), Fraction(1, 2), 0), AHEAD, None, ("far",), tier="stiff"),
    Told("jolt-12000", "jrouwe/JoltPhysics #1818", "A sphere is met from 12000 units away",
         ball(1), (-12000, 0, 0), AHEAD, pair(11999, 12001), ("far",), tier="stiff",
         ours="radius"),
    Told("jolt-12000-aside", "jrouwe/JoltPhysics #1818",
         "From 12000 units away, 3/5 off the centre",
         ball(5), (-12000, 3, 0), (4, 0, 0), pair(2999, 3001), ("far",), tier="stiff",
         ours="radius"),
    Told("pbrt3-8e5", "mmp/pbrt-v3 #265", "A sphere stands at 8e5, seen close by",
         ball(1, 800000), (799997, 0, 0), AHEAD, pair(2, 4), ("displaced",), tier="stiff",
         ours="radius"),
    Told("pbrt3-self-hit", "mmp/pbrt-v3 #44", "A ray leaves a sphere far from the origin",
         ball(1, 65536), (65537, 0, 0), AHEAD, touch(0), ("displaced", "start-on-surface"),
         tier="stiff"),
    Told("pbrt4-earth-down", "mmp/pbrt-v4 5f7a6068",
         "From 0.5 m above the Earth, a ray falls on it",
         GLOBE, at("0 0 0.5"), (0, 0, -1), spans(("1/2", "25484001/2")), ("large",), tier="stiff",
         ours="direction"),
    Told("pbrt4-earth-up", "mmp/pbrt-v4 5f7a6068", "From 0.5 m above the Earth, a ray rises",
         GLOBE, at("0 0 0.5"), (0, 0, 1), MISS, ("large", "behind"), tier="stiff",
         ours="direction"),
    Told("pbrt4-earth-level", "mmp/pbrt-v4 5f7a6068",
         "From 0.5 m above the Earth, a ray runs level",
         GLOBE, at("0 0 0.5"), (1, 0, 0), MISS, ("large", "near-tangent"), tier="stiff",
         ours="direction"),
    Told("pbrt4-earth-slanted", "mmp/pbrt-v4 5f7a6068", "From 0.5 m above the Earth, a slanted ray",
         GLOBE, at("0 0 0.5"), (4, 0, -3), None, ("large",), tier="stiff", ours="direction"),
    Told("atmosphere-limb", "ebruneton/precomputed_atmospheric_scattering #21",
         "A ray starts on a sphere of radius 6420 and dips by 1e-3",
         ball(6420), (0, 0, 6420), (1, 0, number("-0.001")), None, ("large", "start-on-surface"),
         tier="stiff"),
    Told("photon-far", "TzuChieh/Photon-v2 #7", "A small sphere is met from far away",
         ball(number("0.125")), (-4096, 0, number("0.0625")), (1, 0, 0), None, ("far",),
         tier="stiff"),
    Told("geant4-rmax", "Geant4 geom-solids-csg-V04-00-00 (2002-01-10)",
         "A ray starts on a sphere of radius 2.5e8", ball(250000000), (-250000000, 0, 0), (1, 0, 0),
         pair(0, 500000000), ("large", "start-on-surface"), tier="stiff",
         ours="ray"),
    Told("geant4-rmax-below", "Geant4 geom-solids-csg-V04-00-00 (2002-01-10)",
         "A ray starts one step inside a sphere of radius 2.5e8", ball(250000000),
         (-249999984, 0, 0), (-1, 0, 0), pair(0, 16), ("large", "start-near-surface"),
         tier="stiff", ours="ray"),
    Told("geant4-1022", "Geant4 report #1022", "A start is 1e7 radii from a sphere",
         ball(1), (-ten(7), Fraction(1, 2), 0), AHEAD, None, ("far",), tier="stiff", large=True),
    Told("geant4-2100", "Geant4 report #2100", "A start is 1e10 radii from a sphere",
         ball(1), (-ten(10), 0, Fraction(1, 2)), AHEAD, None, ("far",), tier="stiff", large=True),
    Told("weekend-tangent", "RayTracing/raytracing.github.io #110", "A ray has discriminant zero",
         ball(1), (-2, 1, 0), (1, 0, 0), touch(2), ("tangent",)),
    Told("weekend-two-roots", "RayTracing/raytracing.github.io #1124", "A ray has two roots",
         ball(5), (-8, 3, 0), (4, 0, 0), pair(1, 3)),
    Told("embree-long", "RenderKit/embree CHANGELOG", "The direction of a ray has length 1000",
         ball(5), (-8, 3, 0), (1000, 0, 0), spans(("1/250", "3/250")), ("direction-scale",)),
    Told("embree-short", "RenderKit/embree CHANGELOG", "The direction of a ray has length 1/1024",
         ball(5), (-8, 3, 0), (two(-10), 0, 0), pair(4096, 12288), ("direction-scale",)),
    Told("physx-behind", "NVIDIA-Omniverse/PhysX #487", "A sphere lies behind the start",
         ball(1), (3, 0, 0), (1, 0, 0), MISS, ("behind",)),
    Told("bullet-inside", "bulletphysics/bullet3 #459", "A ray starts inside a sphere",
         ball(7), (2, 3, 0), (0, 0, 3), pair(0, 2), ("start-inside",)),
    Told("arborx-sphere", "arborx/ArborX PR #461",
         "The start is the closest approach to the centre",
         ball(5), (0, 3, 0), (2, 0, 0), pair(0, 2), ("start-inside",)),
)  # fmt: skip

RAYSECT = "measured (M7): raysect 0.9.1"
TREES = (
    Told("raysect-less-itself", RAYSECT, "A cylinder with R = 1 and |z| <= 2, less itself",
         less(ROUND, ROUND), (-7, 0, 1), AHEAD, MISS, ("coincident-faces",)),
    Told("raysect-less-itself-slanted", RAYSECT, "A slanted ray meets a cylinder less itself",
         less(ROUND, TURNED), (-5, 0, -3), (4, 1, 2), MISS, ("coincident-faces",), SEVENTHS),
    Told("raysect-shared-wall", RAYSECT, "A ray meets A - B with a shared wall",
         less(drum(0, 8), drum(2, 6)), (-8, 3, 1), (4, -1, 1), None, ("coincident-faces",), THIRDS),
    Told("raysect-shared-wall-hole", RAYSECT, "A ray crosses the part removed, the wall shared",
         less(drum(0, 8), drum(2, 6)), (-8, 1, 4), (4, 0, 0), MISS, ("coincident-faces",),
         SEVENTHS),
    Told("raysect-shared-cap", RAYSECT, "A ray meets A - B with a shared cap",
         less(rod((5, 0, 0), (9, 0, 0), 1), rod((7, 0, 0), (9, 0, 0), 1)), (0, 0, 0), AHEAD,
         pair(5, 7), ("coincident-faces",)),
    Told("raysect-whole-less-part", RAYSECT, "A ray meets a part less the whole, a cap shared",
         less(rod((7, 0, 0), (9, 0, 0), 1), rod((5, 0, 0), (9, 0, 0), 1)), (0, 0, 0), AHEAD,
         MISS, ("coincident-faces",)),
    Told("raysect-union-ab", RAYSECT, "The union of touching cylinders on [3,5] and [5,7]",
         any_of(LEFT, RIGHT), (0, 0, 0), AHEAD, pair(3, 7), ("order", "touching-parts"),
         ours="place"),
    Told("raysect-union-ba", RAYSECT, "The union of touching cylinders on [5,7] and [3,5]",
         any_of(RIGHT, LEFT), (0, 0, 0), AHEAD, pair(3, 7), ("order", "touching-parts"),
         ours="place"),
    Told("raysect-common-ab", RAYSECT, "What touching cylinders on [3,5] and [5,7] share",
         all_of(LEFT, RIGHT), (0, 0, 0), AHEAD, touch(5), ("order", "touching-parts"),
         ours="place"),
    Told("raysect-common-ba", RAYSECT, "What touching cylinders on [5,7] and [3,5] share",
         all_of(RIGHT, LEFT), (0, 0, 0), AHEAD, touch(5), ("order", "touching-parts"),
         ours="place"),
    Told("povray-coincident", "POV-Ray/povray #209", "A difference has coincident surfaces",
         less(layer((0, 0, 0), (0, 0, 4)), rod((0, 0, 0), (0, 0, 4), 2)), (1, 0, 8), (0, 0, -2),
         MISS, ("coincident-faces",)),
    Told("povray-coincident-aside", "POV-Ray/povray #209",
         "A ray passes beside a hole from face to face",
         less(layer((0, 0, 0), (0, 0, 4)), rod((0, 0, 0), (0, 0, 4), 2)), (3, 0, 8), (0, 0, -2),
         pair(2, 4), ("coincident-faces",)),
    Told("povray-plane", "POV-Ray/povray #139", "A cylinder ends on a plane",
         all_of(drum(0, 8), below((0, 0, 0), (0, 0, 1))), (-8, 0, 4), (4, 0, -2), touch(2),
         ("touching-parts",)),
    Told("povray-vanish", "POV-Ray/povray #128", "An intersection keeps the quadric inside it",
         all_of(pipe((0, 0, 0), (0, 0, 1), 1), layer((0, 0, -4), (0, 0, 4)), ball(8)), (-3, 0, 0),
         AHEAD, pair(2, 4)),
    Told("openmc-redundant", "openmc-dev/openmc #260", "A region is cut by one cylinder twice",
         all_of(pipe((0, 0, 0), (0, 0, 1), 5), pipe((0, 0, 3), (0, 0, 7), 5), drum(-9, 9, 13)),
         (-8, 3, 0), (4, 0, 0), pair(1, 3), ("coincident-faces",)),
    Told("openmc-coincident-spheres", "openmc-dev/openmc #2618",
         "A region lies between equal spheres",
         less(ball(5), ball(5)), (-8, 3, 0), (4, 0, 0), MISS, ("coincident-faces",)),
    Told("openmc-coincident-cells", "openmc-dev/openmc #2618", "Two cells meet on one sphere",
         any_of(ball(5), less(ball(13), ball(5))), (-16, 5, 0), (4, 0, 0), pair(1, 7),
         ("coincident-faces",)),
    Told("geant4-723-ab", "Geant4 report #723", "An intersection, A before B",
         all_of(ball(5, -3), rod((-4, 0, 0), (8, 0, 0), 3)), (-12, 0, 0), (2, 0, 0), pair(4, 7),
         ("order",)),
    Told("geant4-723-ba", "Geant4 report #723", "An intersection, B before A",
         all_of(rod((-4, 0, 0), (8, 0, 0), 3), ball(5, -3)), (-12, 0, 0), (2, 0, 0), pair(4, 7),
         ("order",)),
    Told("geant4-153", "Geant4 report #153", "A start inside one part only of an intersection",
         all_of(ball(5), ball(5, 6)), (-2, 0, 0), AHEAD, pair(3, 7), ("start-inside",)),
    Told("geant4-979", "Geant4 report #979", "A start on a face that a subtraction shares",
         less(ball(5), ball(4, 1)), (5, 0, 0), (-1, 0, 0), pair(8, 10), ("start-on-surface",)),
    Told("geant4-subtraction-loop", "Geant4 Boolean/History 2011-05-27",
         "A ray runs along the face that a subtraction leaves open",
         less(drum(0, 8), layer((0, 0, 4), (0, 0, 8))), (-8, 0, 4), (4, 0, 0), MISS,
         ("coincident-faces",)),
    Told("geant4-zero-step", "Geant4 Boolean/History 2016-08-17", "A start where two parts touch",
         any_of(LEFT, RIGHT), (5, 0, 0), AHEAD, pair(0, 2), ("touching-parts",)),
    Told("vecgeom-union", "VecGeom VECGEOM-235", "A start inside the overlap of a union",
         any_of(ball(5), ball(5, 6)), (3, 0, 0), (2, 0, 0), pair(0, 4), ("start-inside",)),
    Told("vecgeom-union-surface", "VecGeom VECGEOM-540", "A start on one part, inside the other",
         any_of(ball(5), ball(5, 6)), (5, 0, 0), (-2, 0, 0), pair(0, 5), ("start-on-surface",)),
    Told("dd4hep-sliver", "AIDASoft/DD4hep #784", "A subtraction leaves a sliver at its seam",
         less(drum(-4, 4), below((0, 0, 0), (0, two(-16), 1)), below((0, 0, 0), (0, 0, -1))),
         (0, 2, 8), (0, 0, -4), pair(2, 2 + two(-17)), ("thin-wall",), tier="stiff"),
    Told("mantid-cubes", "mantidproject/mantid #32971", "Two cubes share a face",
         any_of(_cube((-1, -1, -1), (1, 1, 1)), _cube((1, -1, -1), (3, 1, 1))), (-3, 0, 0), AHEAD,
         pair(2, 6), ("touching-parts",)),
    Told("mantid-cubes-face", "mantidproject/mantid #32971", "A ray lies in the face of two cubes",
         any_of(_cube((-1, -1, -1), (1, 1, 1)), _cube((1, -1, -1), (3, 1, 1))), (1, -3, 0),
         (0, 1, 0), pair(2, 4), ("touching-parts",)),
    Told("mantid-cubes-common", "mantidproject/mantid #32971", "What two touching cubes share",
         all_of(_cube((-1, -1, -1), (1, 1, 1)), _cube((1, -1, -1), (3, 1, 1))), (-3, 0, 0), AHEAD,
         touch(4), ("touching-parts",)),
    Told("occt-tangent-cylinders", "OCCT 0023043", "Two cylinders touch in a point, axes crossed",
         any_of(pipe((0, 0, -2), (2, 0, -2), 2), pipe((0, 0, 2), (0, 2, 2), 2)), (0, 0, -8),
         (0, 0, 2), pair(2, 6), ("touching-parts",)),
    Told("occt-in-or-on", "OCCT 0029606", "A cylinder lies in another, the walls in touch",
         less(drum(0, 8), rod((2, 0, 0), (2, 0, 8), 2)), (-8, 0, 4), (4, 0, 0), pair(1, 2),
         ("touching-parts",)),
    Told("challenge-filter", "ray-tracer-challenge CSG filter #13", "A ray enters B inside A",
         less(ball(8), ball(4)), (-16, 0, 0), (4, 0, 0), spans((2, 3), (5, 6)), ("hollow",)),
    Told("openrt-difference", "OpenRT #27", "A difference is seen from within the removed part",
         less(ball(8), ball(4)), (0, 0, 0), (4, 0, 0), pair(1, 2), ("hollow",)),
    Told("dzhus-comb", "dzhus/csg src/Data/CSG.hs", "A ray meets [0,10] n {[0,2], [3,10]}",
         all_of(rod((0, 0, 0), (10, 0, 0), 1), COMB), (0, 0, 0), AHEAD, spans((0, 2), (3, 10)),
         ("order",)),
    Told("dzhus-comb-swapped", "dzhus/csg src/Data/CSG.hs", "A ray meets {[0,2], [3,10]} n [0,10]",
         all_of(COMB, rod((0, 0, 0), (10, 0, 0), 1)), (0, 0, 0), AHEAD, spans((0, 2), (3, 10)),
         ("order",)),
    Told("brlcad-sliver", "BRL-CAD 89ad1e2a58", "A sliver is thinner than a step of 0.01",
         less(ball(1), ball(number("0.9921875"))), (-3, 0, 0), AHEAD,
         spans((2, "257/128"), ("511/128", 4)), ("thin-wall",)),
)  # fmt: skip


def _cases(told: Iterable[Told]) -> Callable[[Format], Iterator[Case]]:
    def cases(fmt: Format) -> Iterator[Case]:
        for one in told:
            if one.large and not is_double(fmt):
                continue
            yield scene(
                fmt,
                one.slug,
                one.sentence,
                one.shape,
                one.origin,
                one.direction,
                frame=one.frame,
                tier=one.tier,
                flags=("reported", *one.flags),
                known=one.known,
                source=one.source,
            )

    return cases


FAMILIES = (
    Family("reports-sphere", "Faults of spheres, reported in public.", _cases(SPHERES)),
    Family("reports-csg", "Faults of Booleans, reported or measured.", _cases(TREES)),
)
