"""The targets of these tests are importable in worker processes."""

import pytest

from shared.places import TESTS


@pytest.fixture(autouse=True)
def _importable(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", str(TESTS))
