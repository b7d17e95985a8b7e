"""Everything in the zoo: planted faults, sound tracers, and the faults that need a process."""

from __future__ import annotations

from raycert.oracle.zoo import answers, conventions, limits, planes, starts, trees, walls
from raycert.oracle.zoo.fault import Fault, Process
from raycert.oracle.zoo.sound import SOUND

FAULTS: tuple[Fault, ...] = (
    *walls.FAULTS,
    *planes.FAULTS,
    *conventions.FAULTS,
    *starts.FAULTS,
    *limits.FAULTS,
    *trees.FAULTS,
    *answers.FAULTS,
)
"""The planted faults, by the part of a tracer that they are in."""

BY_NAME: dict[str, Fault] = {fault.name: fault for fault in FAULTS}

HARNESS = "tests/client/test_harness.py::"
PINNED = HARNESS + "test_a_fault_is_pinned_on_its_question"
PROCESS: tuple[Process, ...] = (
    Process(
        "crash",
        "ends at every hundredth question",
        HARNESS + "test_crashes_and_hangs_are_pinned_and_all_else_is_graded",
    ),
    Process(
        "hang",
        "never answers every five-hundredth question",
        HARNESS + "test_crashes_and_hangs_are_pinned_and_all_else_is_graded",
    ),
    Process("chatter", "writes a word to standard output before its answer", PINNED),
    Process("after", "writes a word to standard output after its answer", PINNED),
    Process("half", "ends in the middle of a line", PINNED),
    Process("no-newline", "answers without the end of the line", PINNED),
    Process("wrong-id", "answers to another id", PINNED),
    Process(
        "dies-after",
        "ends after its answer",
        HARNESS + "test_a_death_after_an_answer_is_pinned_on_that_answer",
    ),
    Process(
        "hostile",
        "answers with what is no list of pairs",
        HARNESS + "test_a_hostile_line_is_a_verdict",
    ),
)
"""Faults of a process; the clients that have them are in tests/clients."""

__all__ = ["BY_NAME", "FAULTS", "PROCESS", "SOUND"]
