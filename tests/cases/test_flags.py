"""The legend of flags: every use is defined, every definition used."""

from __future__ import annotations

import re
from importlib.resources import files

import pytest

from raycert.cases.families.catalog import FAMILIES
from raycert.cases.flags import FLAGS, Flag
from raycert.cases.formats import FORMATS, Format


@pytest.mark.parametrize("fmt", FORMATS.values(), ids=FORMATS)
def test_every_flag_is_used_and_every_use_defined(fmt: Format) -> None:
    used = {flag for family in FAMILIES for case in family.cases(fmt) for flag in case.flags}
    assert used == set(FLAGS)


@pytest.mark.parametrize("fmt", FORMATS.values(), ids=FORMATS)
def test_no_case_bears_a_flag_twice(fmt: Format) -> None:
    for family in FAMILIES:
        for case in family.cases(fmt):
            assert len(set(case.flags)) == len(case.flags), f"{family.name}/{case.slug}"


@pytest.mark.parametrize("flag", FLAGS.values(), ids=FLAGS)
def test_an_entry_says_trouble_effect_and_reference(flag: Flag) -> None:
    assert FLAGS[flag.name] is flag
    assert flag.trouble.endswith(".")
    assert flag.effect.endswith(".")
    assert flag.references


PUBLIC = re.compile(r"https://[\w.-]+/\S+|doi:10\.\d{4,}/\S+", re.ASCII)
"""A page, or a paper by its DOI."""


@pytest.mark.parametrize("flag", FLAGS.values(), ids=FLAGS)
def test_anybody_can_follow_a_reference(flag: Flag) -> None:
    for reference in flag.references:
        assert is_public(reference), reference


def is_public(reference: str) -> bool:
    """Whether it is a page, a paper, or a file that ships with the package it is in."""
    if PUBLIC.fullmatch(reference):
        return True
    folder, *rest = reference.split("/")
    if folder not in ("cases", "oracle"):
        return False
    shipped = files(f"raycert.{folder}").joinpath(*rest)
    return shipped.is_file()


@pytest.mark.parametrize(
    "reference", ["failures M7", "https://x", "doi:11/x", "cases/none.md", "issue 7"]
)
def test_what_nobody_can_follow_is_seen(reference: str) -> None:
    assert not is_public(reference)
