"""The legend of flags: every use is defined, every definition used."""

from __future__ import annotations

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
    assert flag.reference
