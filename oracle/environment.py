"""What a figure or a certificate was made with: versions and machine, for the record."""

from __future__ import annotations

import os
import platform
from importlib.metadata import PackageNotFoundError, version


def environment() -> dict[str, str | int | None]:
    """Return the tool's version, the Python and the machine."""
    return {
        "raycert": tool_version(),
        "python": platform.python_version(),
        "implementation": platform.python_implementation(),
        "system": platform.platform(),
        "machine": platform.machine(),
        "cores": os.cpu_count(),
    }


def tool_version() -> str:
    """Return the installed version of raycert, or `source` where it runs from a checkout."""
    try:
        return version("raycert")
    except PackageNotFoundError:
        return "source"
