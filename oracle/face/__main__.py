"""`python -m raycert`: the command."""

from __future__ import annotations

from raycert.oracle.commands.main import main

if __name__ == "__main__":
    main()
