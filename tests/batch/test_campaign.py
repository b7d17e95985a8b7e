"""The campaign draws rays about the golden scenes, and notices a lane that is wrong."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from click.testing import CliRunner

from raycert.cases.formats import BINARY32, BINARY64
from raycert.oracle.batch.blocks import trace_batch
from shared import batch_campaign as campaign
from shared.batch_campaign import Scene, compare, jittered, numbers, scenes


def some() -> list[Scene]:
    return scenes(BINARY64)[::60]


def test_rays_are_finite_and_near_those_of_the_scene() -> None:
    dice = np.random.default_rng(51)
    for scene in some():
        rays = jittered(scene, 50, dice)
        assert np.isfinite(rays).all()
        assert (rays == scene.rays[0]).any(), "some numbers stay as they are"
        assert 0 in numbers(scene.solid)


def test_no_lane_is_wrong() -> None:
    dice = np.random.default_rng(52)
    for scene in some():
        tally = compare(scene, jittered(scene, 25, dice), BINARY64, ("numpy",))
        assert tally.faults == []
        assert sum(tally.lanes.values()) == tally.rays == 25


def test_in_binary32_neither() -> None:
    dice = np.random.default_rng(53)
    for scene in scenes(BINARY32)[::120]:
        assert compare(scene, jittered(scene, 25, dice), BINARY32, ("numpy",)).faults == []


def test_a_planted_fault_is_noticed(monkeypatch) -> None:
    def faulty(*args, **options):
        found = trace_batch(*args, **options)
        return replace(found, leave=np.nextafter(found.leave, np.inf))

    monkeypatch.setattr(campaign, "trace_batch", faulty)
    dice = np.random.default_rng(54)
    faults = [compare(s, jittered(s, 5, dice), BINARY64, ("numpy",)).faults for s in some()]
    assert sum(map(len, faults)) > 20


def test_the_command_counts_and_ends_with_1_where_a_lane_is_wrong(monkeypatch) -> None:
    monkeypatch.setattr(campaign, "scenes", lambda fmt: some()[:5])
    run = ["--rays", "100", "--precision", "binary64", "--engine", "numpy"]
    result = CliRunner().invoke(campaign.main, run)
    assert (result.exit_code, "100 rays" in result.output) == (0, True)
    monkeypatch.setattr(campaign, "scalar", lambda solid, fmt: lambda u, v: ((7.0, 8.0),))
    assert CliRunner().invoke(campaign.main, run).exit_code == 1
