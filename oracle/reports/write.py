"""The forms in which a certificate can be written, each a function from the certificate to text."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from raycert.oracle.reports.junit import junit
from raycert.oracle.reports.markdown import markdown
from raycert.oracle.reports.page import page

Json = dict[str, Any]
WRITERS: dict[str, Callable[[Json], str]] = {"junit": junit, "markdown": markdown, "html": page}
