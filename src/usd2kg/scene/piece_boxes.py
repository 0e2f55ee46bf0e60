"""PieceBoxes: whether pieces of geometry are connected, by their boxes."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from usd2kg.scene.model import Box
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.settings import UNNAMED

__all__ = ["Measure", "PieceBoxes", "count_connected"]

_Points = NDArray[np.float64]
Measure = Callable[[PrimRecord], Box | None]
"""Returns the world box of all geometry at and below a prim, in metres; None if there is none."""


class PieceBoxes:
    """Boxes of pieces, each measured once."""

    def __init__(self, measure: Measure) -> None:
        """Create it with a function that returns the world box of a prim."""
        self._measure = measure
        self._known: dict[str, Box | None] = {}
        self._answers: dict[int, bool] = {}
        """id of a list of pieces → whether they are one object; nested groups with one child share their list."""

    def are_one_object(self, pieces: list[PrimRecord]) -> bool:
        """Return whether most pieces have a single mesh, and all are connected and no larger than furniture."""
        if id(pieces) not in self._answers:
            self._answers[id(pieces)] = self._compare(pieces)
        return self._answers[id(pieces)]

    def _compare(self, pieces: list[PrimRecord]) -> bool:
        if 2 * sum(1 for piece in pieces if piece.gprim_count == 1) < len(pieces):
            return False
        lower, upper = self.corners(pieces)
        return bool(len(lower)) and _extent(lower, upper) <= UNNAMED.max_extent and count_connected(lower, upper) == 1

    def is_scattered(self, pieces: list[PrimRecord]) -> bool:
        """Return whether pieces are disconnected and larger than furniture."""
        lower, upper = self.corners(pieces)
        return bool(len(lower)) and _extent(lower, upper) > UNNAMED.max_extent and count_connected(lower, upper) > 1

    def corners(self, pieces: list[PrimRecord]) -> tuple[_Points, _Points]:
        """Return the lower and upper corners of the pieces with a box, (n, 3) each, metres."""
        for piece in pieces:
            if piece.path not in self._known:
                self._known[piece.path] = self._measure(piece)
        boxes = [box for piece in pieces if (box := self._known[piece.path]) is not None]
        return np.array([box.lower for box in boxes]), np.array([box.upper for box in boxes])


def _extent(lower: _Points, upper: _Points) -> float:
    return float((upper.max(axis=0) - lower.min(axis=0)).max())


def count_connected(lower: _Points, upper: _Points, gaps: float | _Points = UNNAMED.max_gap) -> int:
    """Return the number of connected components of boxes (n, 3) under touching.

    Two boxes touch if they are no farther apart than the larger of their `gaps`, in metres, a number or (n,).
    """
    allowed = np.broadcast_to(gaps, len(lower))
    is_left = np.ones(len(lower), dtype=bool)
    components = 0
    while is_left.any():
        components += 1
        pending = [int(is_left.argmax())]
        is_left[pending] = False
        while pending and is_left.any():
            at = pending.pop()
            gap = np.maximum(allowed, allowed[at])[:, None]
            is_near = ((lower <= upper[at] + gap) & (upper >= lower[at] - gap)).all(axis=1) & is_left
            is_left &= ~is_near
            pending.extend(np.flatnonzero(is_near).tolist())
    return components
