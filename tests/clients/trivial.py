"""Reads a line, takes it for JSON, answers a constant: as little as a client in Python can do."""

import json
import sys

sys.stdout.write('{"hello": 1, "name": "trivial"}\n')
sys.stdout.flush()
sys.stdin.readline()
for line in sys.stdin:
    id = json.loads(line)["id"]
    sys.stdout.write(f'{{"id": "{id}", "intervals": [[2.0, 4.0]]}}\n')
    sys.stdout.flush()
