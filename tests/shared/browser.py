"""A page in a real browser, and what it measures there."""

import functools
import html
import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

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
// How many labels of a drawing lie on another, or run from the column of names into the plot.
const collisions = (svg) => {
  const boxes = [...svg.querySelectorAll("text")].map(text => text.getBoundingClientRect());
  const plot = svg.querySelector(".rail, .frame"), edge = plot && plot.getBoundingClientRect().left;
  const meet = (a, b) => a.left < b.right - 1 && b.left < a.right - 1
    && a.top < b.bottom - 3 && b.top < a.bottom - 3;
  const pairs = boxes.flatMap((a, i) => boxes.slice(i + 1).filter(b => meet(a, b)));
  const left = svg.getBoundingClientRect().left + 1;
  return pairs.length + boxes.filter(b => plot && b.left < left && b.right > edge).length;
};
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
      collide: [...inner.querySelectorAll("svg")].map(collisions).reduce((a, b) => a + b, 0),
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
