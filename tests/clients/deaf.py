"""Says hello without being asked, and never reads nor answers."""

import time

from wire import HELLO, say

say(HELLO)
time.sleep(3600)
