"""What a figure or a certificate was made with: the tool to the byte, versions and machine."""

from __future__ import annotations

import hashlib
import os
import platform
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

PACKAGES = ("cases", "oracle", "reference")


def environment() -> dict[str, Any]:
    """Return the tool, the Python and the machine."""
    return {
        "tool": {"name": "raycert", "version": tool_version(), "sha256": tool_sha256()},
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


@cache
def tool_sha256() -> str:
    """Return the SHA-256 over the Python source of the three packages as they are installed."""
    return source_sha256(Path(__file__).parents[2])


def source_sha256(root: Path) -> str:
    """Return the SHA-256 over the packages' Python files: path and bytes of each, in path order."""
    digest = hashlib.sha256()
    paths = (path for name in PACKAGES for path in (root / name).rglob("*.py"))
    for name, path in sorted((path.relative_to(root).as_posix(), path) for path in paths):
        source = path.read_bytes()
        digest.update(f"{name} {len(source)}\n".encode() + source)
    return digest.hexdigest()
