"""Where the tests lie, for programs and processes that are started from elsewhere."""

from pathlib import Path

TESTS = Path(__file__).parents[1]
ROOT = TESTS.parent
CLIENTS = TESTS / "clients"
