"""For all tests: a loaded machine is not a failure, and an interrupt interrupts."""

import signal

from hypothesis import settings

settings.register_profile("raycert", deadline=None)
settings.load_profile("raycert")

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # so where a shell starts it in background
    signal.signal(signal.SIGINT, signal.default_int_handler)
