"""For all tests: a loaded machine is not a failure, an interrupt interrupts, processes start fast.

Processes that tests start can import `shared`. Where Python is told to write no bytecode, each of
some hundred processes would compile all that it imports: there the tests keep bytecode in pytest's
cache, and write it nowhere else.
"""

import gc
import os
import signal
import sys
from pathlib import Path

from hypothesis import settings

settings.register_profile("raycert", deadline=None)
settings.load_profile("raycert")

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # so where a shell starts it in background
    signal.signal(signal.SIGINT, signal.default_int_handler)

HERE = Path(__file__).parent
others = os.environ.get("PYTHONPATH", "").split(os.pathsep)
if str(HERE) not in others:
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, (str(HERE), *others)))

if sys.dont_write_bytecode:
    sys.pycache_prefix = str(HERE.parent / ".pytest_cache" / "bytecode")
    sys.dont_write_bytecode = False
    os.environ["PYTHONPYCACHEPREFIX"] = sys.pycache_prefix
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

# Some thousand golden rows live as long as the session: to look through them for garbage at every
# turn costs a seventh of the time.
gc.set_threshold(100_000, 20, 100)
