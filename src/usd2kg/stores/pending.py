"""The graph that is being put in place in a folder: whole under its name, or not there."""

import logging
import os
import tempfile
import uuid
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

import pyoxigraph as ox

__all__ = ["PENDING_NAME", "read_name", "set_aside_damaged", "write_pending"]

logger = logging.getLogger(__name__)

PENDING_NAME = "usd2kg.pending.nq"
"""Once it has this name it counts as loaded: whoever opens the folder next finishes the work if this process dies."""
_DAMAGED_NAME = "usd2kg.damaged"
_END = b"# end\n"
"""The last line: a file that was cut off, even between two triples, lacks it."""


def write_pending(folder: Path, iri: str, triples: Iterable[ox.Triple]) -> None:
    """Write a graph beside the store, whole or not at all, and on the disk before anything is replaced."""
    node = ox.NamedNode(iri)
    handle, temporary = tempfile.mkstemp(dir=folder, prefix=f"{PENDING_NAME}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(f"# {node}\n".encode())
            quads = (ox.Quad(triple.subject, triple.predicate, triple.object, node) for triple in triples)
            ox.serialize(quads, file, format=ox.RdfFormat.N_QUADS)
            file.write(_END)
            file.flush()
            os.fsync(file.fileno())
        Path(temporary).replace(folder / PENDING_NAME)
    finally:
        Path(temporary).unlink(missing_ok=True)
    _sync_folder(folder)


def read_name(file: BinaryIO) -> ox.NamedNode:
    """Return the name of the graph in a pending file, from its first line.

    Raises:
        ValueError: there is none.
    """
    return ox.NamedNode(file.readline().decode().strip("# <>\n"))


def set_aside_damaged(folder: Path) -> bool:
    """Return whether what is pending is damaged; then it gets another name, so that the store can still be used."""
    path = folder / PENDING_NAME
    fault = _fault(path)
    if fault is None:
        return False
    aside = path.replace(folder / f"{_DAMAGED_NAME}.{uuid.uuid4().hex[:8]}")
    logger.warning(
        "%s: a load was broken off, and what it left is damaged (%s); it is now %s; load that scene again, then delete "
        "that file",
        folder,
        fault,
        aside.name,
    )
    return True


def _fault(path: Path) -> str | None:
    """Return what is wrong with a pending file; None where it is whole."""
    if not path.is_file():
        return "it is no file"
    with path.open("rb") as file:
        try:
            node = read_name(file)
            if any(quad.graph_name != node for quad in ox.parse(file, format=ox.RdfFormat.N_QUADS)):
                return "it holds other graphs than it says"
        except (ValueError, SyntaxError) as error:
            return " ".join(str(error).split())
        file.seek(-min(len(_END), path.stat().st_size), os.SEEK_END)
        return None if file.read() == _END else "it is cut off"


def _sync_folder(folder: Path) -> None:
    """Have a new name in a folder survive a loss of power, where the system knows how."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
