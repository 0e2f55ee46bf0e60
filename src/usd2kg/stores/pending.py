"""Write-ahead file of a store folder: a graph that is complete on disk and not yet in the store."""

import logging
import os
import tempfile
import uuid
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

import pyoxigraph as ox

from usd2kg.errors import one_line

__all__ = ["PENDING_NAME", "read_name", "set_aside_damaged", "write_pending"]

logger = logging.getLogger(__name__)

PENDING_NAME = "usd2kg.pending.nq"
"""A file with this name is committed: if this process dies, the next process that opens the folder applies it."""
_DAMAGED_NAME = "usd2kg.damaged"
_END = b"# end\n"
"""The last line, which a truncated file lacks."""


def write_pending(folder: Path, node: ox.NamedNode, quads: Iterable[ox.Quad]) -> None:
    """Write the quads of one graph to the pending file, atomically and synced to disk."""
    handle, temporary = tempfile.mkstemp(dir=folder, prefix=f"{PENDING_NAME}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(f"# {node}\n".encode())
            ox.serialize(quads, file, format=ox.RdfFormat.N_QUADS)
            file.write(_END)
            file.flush()
            os.fsync(file.fileno())
        Path(temporary).replace(folder / PENDING_NAME)
    finally:
        Path(temporary).unlink(missing_ok=True)
    _sync_folder(folder)


def read_name(file: BinaryIO) -> ox.NamedNode:
    """Return the IRI of the graph in a pending file, from its first line.

    Raises:
        ValueError: the line contains no IRI.
    """
    return ox.NamedNode(file.readline().decode().strip("# <>\n"))


def set_aside_damaged(folder: Path) -> bool:
    """Rename a damaged pending file, so that the store stays usable; return whether it was damaged."""
    path = folder / PENDING_NAME
    damage = _find_damage(path)
    if damage is None:
        return False
    aside = path.replace(folder / f"{_DAMAGED_NAME}.{uuid.uuid4().hex[:8]}")
    logger.warning(
        "%s: an interrupted load left a damaged file (%s), renamed to %s; load that scene again, then delete the file",
        folder,
        damage,
        aside.name,
    )
    return True


def _find_damage(path: Path) -> str | None:
    """Return how a pending file is damaged; None if it is complete."""
    if not path.is_file():
        return "it is not a file"
    with path.open("rb") as file:
        try:
            node = read_name(file)
            if any(quad.graph_name != node for quad in ox.parse(file, format=ox.RdfFormat.N_QUADS)):
                return "it contains other graphs than its first line names"
        except (ValueError, SyntaxError) as error:
            return one_line(error)
        file.seek(-min(len(_END), path.stat().st_size), os.SEEK_END)
        return None if file.read() == _END else "it is truncated"


def _sync_folder(folder: Path) -> None:
    """Sync a renamed entry to disk, if the platform supports it."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
