"""Work for executors to do, in a module that their processes can import wherever the tests are."""

import os
import signal
from pathlib import Path

from raycert.oracle.hunt.unit import Haul, Worst


def easy(unit):
    return Haul(unit.number, unit.cases, Worst(), ())


def deadly_once(folder, unit):
    """Kills its own process at its first unit 3."""
    mark = Path(folder) / "died"
    if unit.number == 3 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return easy(unit)


def deadly(unit):
    os.kill(os.getpid(), signal.SIGKILL)


def wrong(unit):
    raise ValueError("a fault of ours")
