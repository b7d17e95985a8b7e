"""The page in a real browser: it fits, it is drawn, it asks for nothing, and it runs nothing."""

import functools
import html
import json
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import made_certificates as made_up
import pytest
from made_certificates import Json

from raycert.oracle.reports.page import page

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
OPTIONS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--allow-file-access-from-files",
    "--virtual-time-budget=2000",
)
WIDTHS = (390, 1280)
PROBE = """<script>
addEventListener("load", () => {
  const found = {};
  for (const frame of document.querySelectorAll("iframe")) {
    const inner = frame.contentDocument, root = inner.documentElement;
    for (const d of inner.querySelectorAll("details")) d.open = true;
    const boxes = [...inner.querySelectorAll("svg")].map(s => s.getBoundingClientRect());
    const texts = [...inner.querySelectorAll("h1, h2, p, li, dd, dt, summary")];
    found[frame.width] = {
      width: root.scrollWidth,
      room: frame.contentWindow.innerWidth,
      drawings: boxes.length,
      smallest: Math.min(...boxes.map(b => Math.min(b.width, b.height))),
      title: inner.title,
      scripts: inner.scripts.length,
      requests: inner.querySelectorAll("[src], [href], [srcset], [data], [poster]").length
        + [...inner.styleSheets].flatMap(s => [...s.cssRules])
          .filter(rule => /url\\(|@import/.test(rule.cssText)).length,
      outside: texts.filter(e => e.getBoundingClientRect().right > frame.width + 1).length,
      heading: inner.querySelector("h1").getBoundingClientRect().height,
    };
  }
  const result = document.createElement("pre");
  result.id = "found";
  result.textContent = JSON.stringify(found);
  document.body.append(result);
});
</script>"""


@functools.cache
def browser() -> str:
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    if found is None:
        pytest.skip("no browser: install chromium (apt-get install chromium)")
    return found


def probed(text: str, folder: Path) -> dict[str, Any]:
    """Return what the browser measures of a page at each width, the page in a frame."""
    (folder / "page.html").write_text(text)
    frames = "".join(
        f'<iframe src="page.html" width="{width}" height="900" style="border:0"></iframe>'
        for width in WIDTHS
    )
    probe = folder / "probe.html"
    probe.write_text(f"<!doctype html><body>{frames}{PROBE}")
    command = [browser(), *OPTIONS, f"--user-data-dir={folder / 'profile'}", "--dump-dom"]
    ran = subprocess.run(
        [*command, probe.as_uri()], capture_output=True, text=True, timeout=60, check=True
    )
    match = re.search(r'<pre id="found">(.*?)</pre>', ran.stdout, re.DOTALL)
    assert match, ran.stderr[-2000:]
    found: dict[str, Any] = json.loads(html.unescape(match[1]))
    return found


@pytest.mark.parametrize("make", [made_up.good, made_up.bad, made_up.attacked])
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
