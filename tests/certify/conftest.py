"""For the tests of certificates: the corpus is read once, and the runs share it."""

from pathlib import Path

import pytest

from raycert.cases.corpus import GOLDEN, Corpus, read_corpus
from shared.corpus import golden


@pytest.fixture(autouse=True)
def one_reading(monkeypatch: pytest.MonkeyPatch) -> None:
    def read(precision: str, folder: Path, solids: tuple[str, ...]) -> Corpus:
        return golden(precision) if folder == GOLDEN else read_corpus(precision, folder, solids)

    monkeypatch.setattr("raycert.oracle.certify.run.read_corpus", read)
