"""The line of a question is to the byte what json writes of its form."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from raycert.cases.formats import FORMATS, SPELLINGS, Spelling
from raycert.cases.forms import question, write_ray, write_solid
from raycert.cases.protocol import encode
from raycert.cases.strategies import rays, solids


@pytest.mark.parametrize("precision", FORMATS)
@pytest.mark.parametrize("spelling", SPELLINGS)
@settings(max_examples=25)
@given(data=st.data(), id=st.text())
def test_a_line_is_that_of_json(precision: str, spelling: Spelling, data: Any, id: str) -> None:
    fmt = FORMATS[precision]
    solid, ray = data.draw(solids(fmt=fmt)), data.draw(rays(fmt=fmt))
    form = {
        "id": id,
        "solid": write_solid(solid, spelling, fmt),
        "ray": write_ray(ray, spelling, fmt),
    }
    assert question(id, solid, ray, spelling, fmt) == encode(form)
