"""SetFinder: which prims hold several objects, although no model hierarchy says so."""

from collections.abc import Callable
from itertools import combinations

import numpy as np

from usd2kg.knowledge import word_set
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.piece_boxes import Measure, PieceBoxes, count_connected
from usd2kg.scene.settings import SETS
from usd2kg.scene.unnamed_pieces import is_unnamed
from usd2kg.words import words_of

__all__ = ["ReadClasses", "SetFinder", "is_room_name"]

ReadClasses = Callable[[PrimRecord], frozenset[str]]
"""Returns the labels of a prim that state its class, in lower case."""

_ROOM_WORDS = word_set("scene", "room_words")
_SHELL_WORDS = word_set("scene", "shell_words")


def is_room_name(name: str) -> bool:
    """Return whether a name ends in a word for a room or an area.

    >>> is_room_name("Kitchen_2"), is_room_name("kitchen_table")
    (True, False)
    """
    return not _ROOM_WORDS.isdisjoint(words_of(name)[-1:])


class SetFinder:
    """Tells prims that hold several objects from objects that are made of several parts."""

    def __init__(self, measure: Measure, read_classes: ReadClasses) -> None:
        """Create it with functions that return the world box and the labels of a prim."""
        self._boxes = PieceBoxes(measure)
        self._classes_of = read_classes
        self._known_assets: dict[str, bool] = {}

    def is_set(self, record: PrimRecord, pieces: list[PrimRecord]) -> bool:
        """Return whether a prim without a model hierarchy holds several objects.

        Pieces that all have names are several objects if the prim is named after a room, or is the plural of their
        names, if they have different labels, form a room with things in it, or are mostly apart, since the parts of one
        thing touch.

        Args:
            record: the prim.
            pieces: the prims below it that would be objects.
        """
        if len(pieces) < SETS.min_objects or any(is_unnamed(piece.name) for piece in pieces):
            return False
        return (
            is_room_name(record.name)
            or _is_plural(record.name, pieces)
            or self._is_set_whatever_its_name(record, pieces)
            or self._are_apart(pieces)
        )

    def is_set_of_objects(self, asset: PrimRecord) -> bool:
        """Return whether a referenced prim holds several objects: by labels, or as a room with things in it."""
        key = asset.first_instance or asset.source.path
        if key not in self._known_assets:
            pieces = _pieces_of(asset)
            is_named = not any(is_unnamed(piece.name) for piece in pieces)
            self._known_assets[key] = is_named and self._is_set_whatever_its_name(asset, pieces)
        return self._known_assets[key]

    def _is_set_whatever_its_name(self, record: PrimRecord, pieces: list[PrimRecord]) -> bool:
        return self._have_different_labels(record, pieces) or self.is_furnished_room(pieces)

    def _have_different_labels(self, record: PrimRecord, pieces: list[PrimRecord]) -> bool:
        """Return whether pieces have different labels of classes, and the whole has none."""
        labelled = [piece for piece in pieces if piece.is_labelled]
        if len(labelled) < SETS.min_objects or (record.is_labelled and self._classes_of(record)):
            return False
        classes = filter(None, map(self._classes_of, labelled))
        return any(one.isdisjoint(other) for one, other in combinations(classes, 2))

    def is_furnished_room(self, pieces: list[PrimRecord]) -> bool:
        """Return whether prims are the shell of a room and things in it."""
        shell = [piece for piece in pieces if not _SHELL_WORDS.isdisjoint(words_of(piece.name))]
        if not shell or len(shell) == len(pieces):
            return False
        lower, upper = self._boxes.corners(pieces)
        extents = upper.max(axis=0) - lower.min(axis=0) if len(lower) else np.zeros(3)
        return bool(extents[:2].min() >= SETS.min_room)

    def _are_apart(self, pieces: list[PrimRecord]) -> bool:
        """Return whether most pieces touch no other."""
        lower, upper = self._boxes.corners(pieces)
        if len(lower) < SETS.min_objects:
            return False
        gaps = np.maximum(SETS.max_gap, SETS.max_gap_share * (upper - lower).max(axis=1))
        return 2 * count_connected(lower, upper, gaps) > len(lower)


def _pieces_of(asset: PrimRecord) -> list[PrimRecord]:
    """Return the outermost prims below an asset among which its geometry is divided."""
    pieces = [asset]
    while len(pieces) == 1 and not pieces[0].is_gprim:
        pieces = [child for child in pieces[0].children if child.gprim_count]
    return pieces


def _is_plural(name: str, pieces: list[PrimRecord]) -> bool:
    """Return whether a name is the plural of a word in the names of all pieces: Walls of WallA_N and WallA_W."""
    last = "".join(words_of(name)[-1:])
    singulars = {last.removesuffix("s"), last.removesuffix("es"), last.removesuffix("ies") + "y"} - {last}
    return all(not singulars.isdisjoint(words_of(piece.name)) for piece in pieces)
