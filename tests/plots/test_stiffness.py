"""The picture: panels, a legend with every method, marks only beyond 64, the same bytes."""

from functools import cache
from itertools import pairwise

from matplotlib.figure import Figure

from raycert.cases.families.sketch import ten, two
from raycert.oracle.measure.catalog import BY_NAME
from raycert.oracle.measure.curves import Itinerary, Stress, run
from raycert.oracle.measure.facets import Sides
from raycert.oracle.measure.sweeps import SWEEPS
from raycert.oracle.plots.stiffness import MOST_LINES, NONE, NOTES, Axis, draw, pages, spaced
from raycert.oracle.plots.style import picture, styled

NAMES = ("textbook", "oracle")
PLAN = Itinerary(
    tuple(BY_NAME[name] for name in NAMES),
    (SWEEPS["far"], SWEEPS["start"], SWEEPS["hard"]),
    quick=True,
    workers=1,
)
SIDES = [Sides(caster, 8 << k, 0.06 / 4**k, 0) for caster in ("trimesh", "embree") for k in (0, 1)]


@cache
def report() -> Stress:
    return run(PLAN, lambda: None)


def drawn(**options: object) -> Figure:
    with styled():
        return draw(report(), NAMES, **options)  # type: ignore[arg-type]


def test_a_panel_for_each_sweep_and_one_for_meshes() -> None:
    titles = [axes.get_title(loc="left") for axes in drawn(sides=SIDES).axes]
    assert [title for title in titles if title] == [
        "start far from the solid",
        "start near the wall",
        "hard to round (dots: not correctly rounded)",
        "meshes of n sides: error / radius",
    ]


def test_the_legend_names_every_method() -> None:
    [legend] = drawn().legends
    assert [text.get_text() for text in legend.get_texts()] == [*NAMES, "condition, ulps"]


def test_marks_stand_beyond_64_only() -> None:
    far = drawn().axes[0]
    marked = [line for line in far.lines if line.get_markevery()]
    [textbook] = marked
    for i in textbook.get_markevery():  # type: ignore[union-attr]
        assert textbook.get_ydata()[i] > 64  # type: ignore[index]


def test_labels_do_not_overlap() -> None:
    figure = drawn(sides=SIDES, notes=["a note"] * 20)
    renderer = figure.canvas.get_renderer()  # type: ignore[attr-defined]
    figure.draw(renderer)
    for axes in figure.axes:
        low, high = sorted(axes.get_xlim())
        boxes = [
            tick.label1.get_window_extent(renderer)
            for tick in axes.xaxis.get_major_ticks()
            if low <= tick.get_loc() <= high and tick.label1.get_visible()  # type: ignore[attr-defined]
        ]
        boxes.sort(key=lambda box: box.x0)
        for one, other in pairwise(boxes):
            assert one.x1 <= other.x0
        for box in boxes:
            assert figure.bbox.x0 <= box.x0
            assert box.x1 <= figure.bbox.x1


def test_notes_end_where_the_room_ends() -> None:
    figure = drawn(sides=SIDES, notes=[f"note {i}" for i in range(NOTES + 5)])
    [text] = [t.get_text() for axes in figure.axes for t in axes.texts]
    assert len(text.splitlines()) == NOTES
    assert text.splitlines()[-1] == "and 6 more"


def test_forward_errors_are_drawn_without_the_64() -> None:
    far = drawn(field="ulps").axes[0]
    assert not any(list(line.get_ydata()) == [64, 64] for line in far.lines)
    assert all(max(line.get_ydata()) <= NONE for line in far.lines)


def test_the_same_report_gives_the_same_bytes() -> None:
    with styled():
        one, two = (picture(draw(report(), NAMES, SIDES, notes=["x"]), "svg") for _ in range(2))
    assert one == two


def test_many_methods_are_drawn_on_several_pages() -> None:
    names = ["reference", "textbook", "oracle", *(f"method {i}" for i in range(9))]
    found = pages(names)
    assert sorted(name for page in found for name in page) == sorted(names)
    assert all(0 < len(page) <= MOST_LINES for page in found)
    assert pages(["a", "b"]) == [("a", "b")]


def test_a_report_of_nothing_is_drawn() -> None:
    with styled():
        assert draw(Stress(PLAN), NAMES).legends


def test_an_axis_goes_from_mild_to_stiff_with_zero_last() -> None:
    start = Axis(SWEEPS["start"], SWEEPS["start"].steps)
    places = [start.at(x) for x in start.steps]
    assert places == sorted(places, reverse=True)
    left, right = start.limits
    assert left > places[0] > places[-1] > right
    assert list(start.ticks())[-1] == (places[-1], "0")
    far = Axis(SWEEPS["far"], (ten(0), ten(3)))
    assert [text for _, text in far.ticks()] == ["1", "$10^{1}$", "$10^{2}$", "$10^{3}$"]
    assert Axis(SWEEPS["speed"], (two(-1000), two(1000))).limits[0] < -1000


def test_marks_keep_apart() -> None:
    assert spaced([0, 1, 2, 3, 10, 11], [False, True, True, True, True, True], 2) == [1, 3, 4]
    assert spaced([0.0, 1.0], [False, False], 1) == []
