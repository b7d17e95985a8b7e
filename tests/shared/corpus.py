"""The golden corpus, read once by each process that tests."""

from functools import cache

from raycert.cases.corpus import Corpus, read_corpus


@cache
def golden(precision: str = "binary64") -> Corpus:
    return read_corpus(precision)
