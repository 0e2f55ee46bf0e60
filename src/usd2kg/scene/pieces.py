"""Geometry that a converter has cut into pieces that nobody named: what belongs together is told by where it is."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from usd2kg.scene.model import Box
from usd2kg.scene.outline import Outline, PrimRecord
from usd2kg.words import words_of

__all__ = ["UNNAMED_PIECES", "is_silent", "sort_pieces"]

UNNAMED_PIECES = "unnamed pieces that hang together"
_SILENT_WORDS = frozenset(
    """
    poly part parts piece pieces component element item entity body solid surface face shape unnamed untitled
    group groups grp empty record transform layer id material cube cylinder plane circle icosphere line rectangle
    sketch up skp mesh meshes geo
    """.split()
)
"""Words of names that converters and modelling tools make up; with production tokens and numbers they say nothing."""
_LARGEST_WHOLE = 3.0
"""What is larger, in metres, is a set or a room, whose pieces touch too."""
_TOUCHING = 0.02
"""Pieces hang together when the gap between their boxes is at most this, in metres."""
_MOST_PIECES = 5_000

_Points = NDArray[np.float64]
Measure = Callable[[PrimRecord], Box | None]
"""Gives the world box of all below a record, in metres; None where there is nothing to measure."""


def is_silent(name: str) -> bool:
    """Return whether a name says nothing of what a thing is.

    >>> is_silent("Group_12"), is_silent("part7_obj"), is_silent("Chair_2")
    (True, True, False)
    """
    return _SILENT_WORDS.issuperset(words_of(name))


@dataclass(slots=True)
class _Held:
    """What is below a record."""

    pieces: list[PrimRecord] = field(default_factory=list)
    is_pure: bool = True
    """Whether the pieces are all there is, and none of them has a name."""


def sort_pieces(outline: Outline, candidates: dict[str, str], owners: dict[str, str], measure: Measure) -> None:
    """Change `owners`, the prims that own geometry without a model above it, where names say nothing.

    An unnamed group becomes one object if the pieces in it are themselves unnamed, of one mesh each as a rule, hang
    together and are no larger than a piece of furniture. An unnamed group larger than that, whose meshes do not
    hang together, gives way to its meshes.
    """
    if not any(is_silent(path.rpartition("/")[2]) for path in owners):
        return
    boxes = _Boxes(measure)
    wholes = _wholes(outline, candidates, owners)
    merged: set[str] = set()
    for record, pieces in wholes:
        if merged.isdisjoint(_paths_above(record)) and boxes.is_one_thing(pieces):
            merged.add(record.path)
            for piece in pieces:
                del owners[piece.path]
            owners[record.path] = UNNAMED_PIECES
    for record in [record for record in outline.records if record.path in owners and record.path not in merged]:
        gprims = _loose_gprims(record)
        if gprims and boxes.is_scattered(gprims):
            reason = owners.pop(record.path)
            owners.update({gprim.path: reason for gprim in gprims})


def _wholes(
    outline: Outline, candidates: dict[str, str], owners: dict[str, str]
) -> list[tuple[PrimRecord, list[PrimRecord]]]:
    """Return the unnamed groups of unnamed pieces, outer ones first, with the pieces."""
    held: dict[str, _Held] = {}
    found = []
    for record in reversed(outline.records):
        here = _held(record, candidates, owners, held)
        held[record.path] = here
        is_group = record.path not in owners and not (record.is_scope or record.is_gprim)
        if is_group and here.is_pure and 1 < len(here.pieces) <= _MOST_PIECES and _may_be_whole(record, outline):
            found.append((record, here.pieces))
    return found[::-1]


def _held(record: PrimRecord, candidates: dict[str, str], owners: dict[str, str], held: dict[str, _Held]) -> _Held:
    below = [held.pop(child.path) for child in record.children]
    if record.path in owners:
        return _Held([record], is_silent(record.name))
    full = [inner.pieces for inner in below if inner.pieces]
    pieces = full[0] if len(full) == 1 else [piece for inner in full for piece in inner]
    return _Held(pieces, record.path not in candidates and all(inner.is_pure for inner in below))


def _may_be_whole(record: PrimRecord, outline: Outline) -> bool:
    is_all = record.gprim_count == outline.root.gprim_count
    is_top = record.parent is outline.root
    return is_silent(record.name) and record.kind not in {"assembly", "group"} and not (is_all and is_top)


def _loose_gprims(record: PrimRecord) -> list[PrimRecord]:
    """Return the unnamed meshes right below an unnamed record, where they are all it shows."""
    if record.is_gprim or not is_silent(record.name):
        return []
    gprims = [child for child in record.children if child.is_gprim and not child.is_hidden]
    is_all = len(gprims) == record.gprim_count <= _MOST_PIECES
    return gprims if is_all and all(is_silent(gprim.name) for gprim in gprims) else []


def _paths_above(record: PrimRecord) -> Iterator[str]:
    above = record.parent
    while above is not None:
        yield above.path
        above = above.parent


class _Boxes:
    """Compares pieces by their boxes, each measured once."""

    def __init__(self, measure: Measure) -> None:
        self._measure = measure
        self._known: dict[str, Box | None] = {}
        self._answers: dict[int, bool] = {}
        """id of a list of pieces → whether they are one thing; groups that hold one group each share their list."""

    def is_one_thing(self, pieces: list[PrimRecord]) -> bool:
        """Return whether simple pieces hang together in something of a size that a person would name."""
        if id(pieces) not in self._answers:
            self._answers[id(pieces)] = self._is_one_thing(pieces)
        return self._answers[id(pieces)]

    def _is_one_thing(self, pieces: list[PrimRecord]) -> bool:
        if 2 * sum(1 for piece in pieces if piece.gprim_count == 1) < len(pieces):
            return False
        lower, upper = self._corners(pieces)
        return bool(len(lower)) and _extent(lower, upper) <= _LARGEST_WHOLE and _hang_together(lower, upper)

    def is_scattered(self, pieces: list[PrimRecord]) -> bool:
        """Return whether pieces are strewn over a place."""
        lower, upper = self._corners(pieces)
        return bool(len(lower)) and _extent(lower, upper) > _LARGEST_WHOLE and not _hang_together(lower, upper)

    def _corners(self, pieces: list[PrimRecord]) -> tuple[_Points, _Points]:
        for piece in pieces:
            if piece.path not in self._known:
                self._known[piece.path] = self._measure(piece)
        boxes = [box for piece in pieces if (box := self._known[piece.path]) is not None]
        return np.array([box.lower for box in boxes]), np.array([box.upper for box in boxes])


def _extent(lower: _Points, upper: _Points) -> float:
    return float((upper.max(axis=0) - lower.min(axis=0)).max())


def _hang_together(lower: _Points, upper: _Points) -> bool:
    """Return whether each box is reached from each other one over boxes that touch; both are (n, 3)."""
    is_left = np.ones(len(lower), dtype=bool)
    is_left[0] = False
    pending = [0]
    while pending and is_left.any():
        at = pending.pop()
        is_near = (lower <= upper[at] + _TOUCHING).all(axis=1) & (upper >= lower[at] - _TOUCHING).all(axis=1) & is_left
        is_left &= ~is_near
        pending.extend(np.flatnonzero(is_near).tolist())
    return not is_left.any()
