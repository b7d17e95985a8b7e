"""Every example in a docstring of the packages and of their face does what it says."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
from collections.abc import Iterator
from types import ModuleType

import pytest

import raycert
from raycert import cases, oracle, reference

LEAST = 8
"""How many examples there are at least: none found would prove nothing."""


def names(package: ModuleType) -> Iterator[str]:
    """Yield the names of a package and of all its modules, but the ones that run on import."""
    yield package.__name__
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        if not module.name.endswith("__main__"):
            yield module.name


PACKAGES = (cases, oracle, reference)
FACE = ("raycert", *(f"raycert.{module.name}" for module in pkgutil.iter_modules(raycert.__path__)))
MODULES = [name for package in PACKAGES for name in names(package)]
MODULES += [name for name in FACE if name not in MODULES and not name.endswith("__main__")]


def run(module: ModuleType) -> doctest.TestResults:
    return doctest.testmod(module, optionflags=doctest.ELLIPSIS)


@pytest.mark.parametrize("name", MODULES)
def test_examples(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    result = run(importlib.import_module(name))
    assert result.failed == 0, capsys.readouterr().out


def test_there_are_examples() -> None:
    assert len(MODULES) > 40
    found = (doctest.DocTestFinder().find(importlib.import_module(name)) for name in MODULES)
    assert sum(len(test.examples) for tests in found for test in tests) >= LEAST


def test_a_wrong_example_fails(capsys: pytest.CaptureFixture[str]) -> None:
    module = ModuleType("planted", "A wrong example.\n\n>>> 1 + 1\n3\n")
    assert run(module).failed == 1
    assert "Expected:" in capsys.readouterr().out
