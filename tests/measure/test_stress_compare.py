"""Comparisons for certificates: a target beside the reference, the textbook and the oracle."""

import sys
from dataclasses import replace

import pytest

from raycert.oracle.client.dialogue import Unusable
from raycert.oracle.client.target import target
from raycert.oracle.measure.stress import compare as module
from raycert.oracle.measure.stress.compare import BESIDE, compare, picture, plan
from raycert.oracle.measure.stress.run import Plan, run
from raycert.oracle.measure.stress.sweeps import SWEEPS


def short(monkeypatch: pytest.MonkeyPatch) -> None:
    """Compare on one sweep only, in this process."""
    whole = module.plan

    def few(*args: object, **options: object) -> Plan:
        return replace(whole(*args, **options), sweeps=(SWEEPS["far"],), workers=1)  # type: ignore[arg-type]

    monkeypatch.setattr(module, "plan", few)


def test_a_target_stands_beside_the_three(monkeypatch: pytest.MonkeyPatch) -> None:
    short(monkeypatch)
    steps: list[None] = []
    words = ("raycert.oracle.zoo.textbook:textbook",)
    found = compare("mine", target(words), advance=lambda: steps.append(None))
    names = [method["name"] for method in found.form["methods"]]
    assert names == ["mine", *BESIDE]
    ranges = {row["method"]: row["stable"]["text"] for row in found.form["ranges"]}
    assert ranges == {"mine": "to 1e0", "textbook": "to 1e0", "reference": "all", "oracle": "all"}
    assert found.svg is not None
    assert found.svg.count("<svg") == 1
    assert len(steps) == len(found.form["sweeps"][0]["steps"])


def test_what_cannot_be_compared_is_unusable() -> None:
    with pytest.raises(Unusable):
        plan("mine", target((sys.executable, "-c", "pass")), 1, True)


def test_no_picture_without_matplotlib(monkeypatch: pytest.MonkeyPatch) -> None:
    report = run(Plan((), ()), lambda: None)
    monkeypatch.setitem(sys.modules, "raycert.oracle.plots.sweeps", None)
    with pytest.raises(ModuleNotFoundError):
        picture(report)

    def absent(name: str) -> None:
        raise ModuleNotFoundError(name="matplotlib")

    monkeypatch.setattr(module, "import_module", absent)
    assert picture(report) is None
