"""Reserved disk space in a store folder, so that graphs can be removed when the disk is full.

The engine writes a log and its options before it removes a graph.
"""

from contextlib import suppress
from pathlib import Path

from usd2kg.stores.store_limits import RESERVE_BYTES

__all__ = ["keep_reserve", "release_reserve"]

_NAME = "usd2kg.reserve"


def keep_reserve(folder: Path) -> None:
    """Write the reserve file; without enough space, there is no reserve."""
    path = folder / _NAME
    # A killed process may have left a short file.
    if not path.exists() or path.stat().st_size != RESERVE_BYTES:
        try:
            # Not a sparse file, which would reserve nothing.
            path.write_bytes(bytes(RESERVE_BYTES))
        except OSError:
            release_reserve(folder)


def release_reserve(folder: Path) -> None:
    """Remove the reserve file."""
    with suppress(OSError):
        (folder / _NAME).unlink(missing_ok=True)
