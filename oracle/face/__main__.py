"""The command: `raycert`, or `python -m raycert`."""

from __future__ import annotations

from raycert.oracle.client.apart import keep_apart


def start() -> None:
    """Run the command, which is loaded only once nothing can take the place of its modules."""
    keep_apart()
    from raycert.oracle.commands.main import main

    main()


if __name__ == "__main__":
    start()
