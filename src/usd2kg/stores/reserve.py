"""Space that a store folder keeps, so that graphs can be removed when the disk is full.

The engine writes a log and its options before it removes anything.
"""

from contextlib import suppress
from pathlib import Path

from usd2kg.stores.store_limits import RESERVE_BYTES

__all__ = ["keep_reserve", "release_reserve"]

_NAME = "usd2kg.reserve"


def keep_reserve(folder: Path) -> None:
    """Write the file that takes the space; without enough space, there is none."""
    path = folder / _NAME
    # A process that was killed leaves a short file.
    if not path.exists() or path.stat().st_size != RESERVE_BYTES:
        try:
            # Not a sparse file, which would reserve nothing.
            path.write_bytes(bytes(RESERVE_BYTES))
        except OSError:
            release_reserve(folder)


def release_reserve(folder: Path) -> None:
    """Remove the file."""
    with suppress(OSError):
        (folder / _NAME).unlink(missing_ok=True)
