"""The objects that the rows of an answer name."""

from collections.abc import Container, Sequence

from usd2kg.graph.iris import prim_path_of
from usd2kg.query.answer import Answer

__all__ = ["find_prim_paths", "prim_path_of_row"]


def find_prim_paths(answer: Answer, base: str, known: Container[str]) -> frozenset[str]:
    """Return the prim paths of the objects of an answer, the first object of each row.

    Args:
        answer: rows that name objects by prim path or IRI.
        base: namespace of the individuals.
        known: the prim paths of the scene.
    """
    found = (prim_path_of_row(row, base, known) for row in answer.rows)
    return frozenset(path for path in found if path is not None)


def prim_path_of_row(row: Sequence[str | None], base: str, known: Container[str]) -> str | None:
    """Return the prim path of the first object that a row names; None if it names none."""
    for cell in row:
        if cell is not None:
            path = prim_path_of(base, cell) if cell.startswith(base) else cell
            if path in known:
                return path
    return None
