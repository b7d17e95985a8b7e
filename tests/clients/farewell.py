"""Answers everything, and says goodbye at the end: `farewell.py TEXT`, or an exit status."""

import sys
import time

from wire import reply, say, serve

serve(lambda question: say(reply(question)))
if sys.argv[1] == "stays":
    time.sleep(3600)
elif sys.argv[1] == "slow":
    time.sleep(1.8)
    sys.exit()
elif sys.argv[1].isdigit():
    sys.exit(int(sys.argv[1]))
print(sys.argv[1])
