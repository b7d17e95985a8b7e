"""The page in a real browser: it fits, it is drawn, it asks for nothing, and it runs nothing."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import shared.certificates as made_up
from raycert.oracle.reports.page import page
from shared.browser import probed
from shared.certificates import Json


@pytest.mark.parametrize("make", [made_up.good, made_up.much, made_up.attacked])
def test_the_page_fits_and_is_drawn_and_nothing_runs(
    make: Callable[[], Json], tmp_path: Path
) -> None:
    form = make()
    for width, seen in probed(page(form), tmp_path).items():
        assert seen["room"] == int(width)
        assert seen["width"] <= seen["room"], "the page scrolls sideways"
        assert seen["outside"] == 0, "text runs out of the page"
        assert seen["drawings"] >= len(form["worst"])
        assert seen["smallest"] > 5
        assert seen["collide"] == 0, "labels lie on one another"
        assert seen["scripts"] == seen["requests"] == 0
        assert "owned" not in seen["title"].replace("title='owned'", "")
        assert seen["heading"] < 500


@pytest.mark.parametrize(
    ("fault", "sees"),
    [
        ('<p style="width:3000px">wide</p>', lambda seen: seen["width"] > seen["room"]),
        ("<img src='picture.png'>", lambda seen: seen["requests"] == 1),
        ("<style>p { background: url(x.png); }</style>", lambda seen: seen["requests"] == 1),
        ("<script>document.title='owned'</script>", lambda seen: seen["title"] == "owned"),
        (
            '<svg viewBox="0 0 99 9"><text y="8">one</text><text x="3" y="8">two</text></svg>',
            lambda seen: seen["collide"] == 1,
        ),
        ('<svg width="0" height="0"></svg>', lambda seen: seen["smallest"] == 0),
    ],
)
def test_a_planted_fault_is_seen(
    fault: str, sees: Callable[[dict[str, Any]], bool], tmp_path: Path
) -> None:
    text = page(made_up.good()).replace("</main>", f"{fault}</main>")
    if "svg" in fault:
        text = text.replace("svg { display: block; width: 100%; height: auto; }", "")
    assert all(map(sees, probed(text, tmp_path).values()))
