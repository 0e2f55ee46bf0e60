"""Unnamed pieces of geometry, as converters produce them: merged into objects by position."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from usd2kg.knowledge import word_set
from usd2kg.scene.outline import Outline, PrimRecord
from usd2kg.scene.piece_boxes import Measure, PieceBoxes
from usd2kg.scene.settings import UNNAMED
from usd2kg.words import words_of

__all__ = ["UNNAMED_PIECES", "is_unnamed", "merge_unnamed_pieces"]

UNNAMED_PIECES = "connected unnamed pieces"
"""The reason of an object that was merged from pieces."""
_UNNAMED_WORDS = word_set("scene", "unnamed_words")


def is_unnamed(name: str) -> bool:
    """Return whether a name does not describe an object.

    >>> is_unnamed("Group_12"), is_unnamed("part7_obj"), is_unnamed("Chair_2")
    (True, True, False)
    """
    return _UNNAMED_WORDS.issuperset(words_of(name))


@dataclass(slots=True)
class _Content:
    """The pieces at and below a prim."""

    pieces: list[PrimRecord] = field(default_factory=list)
    is_pure: bool = True
    """Whether the prim contains no other objects, and no piece has a descriptive name."""


def merge_unnamed_pieces(
    outline: Outline, candidates: dict[str, str], owners: dict[str, str], measure: Measure
) -> None:
    """Merge and split unnamed prims in `owners`, the prims that own geometry outside of any model.

    An unnamed group becomes one object if its pieces are unnamed and connected, most of them have a single mesh, and
    together they are no larger than furniture. An unnamed group that is larger and disconnected is replaced by its
    meshes.
    """
    if not any(is_unnamed(path.rpartition("/")[2]) for path in owners):
        return
    boxes = PieceBoxes(measure)
    merged: set[str] = set()
    for record, pieces in _unnamed_groups(outline, candidates, owners):
        if merged.isdisjoint(_paths_above(record)) and boxes.are_one_object(pieces):
            merged.add(record.path)
            for piece in pieces:
                del owners[piece.path]
            owners[record.path] = UNNAMED_PIECES
    for record in [record for record in outline.records if record.path in owners and record.path not in merged]:
        gprims = _loose_gprims(record)
        if gprims and boxes.is_scattered(gprims):
            reason = owners.pop(record.path)
            owners.update({gprim.path: reason for gprim in gprims})


def _unnamed_groups(
    outline: Outline, candidates: dict[str, str], owners: dict[str, str]
) -> list[tuple[PrimRecord, list[PrimRecord]]]:
    """Return the unnamed groups of unnamed pieces with their pieces, outer groups first."""
    contents: dict[str, _Content] = {}
    found = []
    for record in reversed(outline.records):
        content = contents[record.path] = _content(record, candidates, owners, contents)
        is_group = record.path not in owners and not (record.is_scope or record.is_gprim)
        has_pieces = content.is_pure and 1 < len(content.pieces) <= UNNAMED.max_pieces
        if is_group and has_pieces and _may_be_object(record, outline):
            found.append((record, content.pieces))
    return found[::-1]


def _content(
    record: PrimRecord, candidates: dict[str, str], owners: dict[str, str], contents: dict[str, _Content]
) -> _Content:
    below = [contents.pop(child.path) for child in record.children]
    if record.path in owners:
        return _Content([record], is_unnamed(record.name))
    full = [inner.pieces for inner in below if inner.pieces]
    pieces = full[0] if len(full) == 1 else [piece for inner in full for piece in inner]
    return _Content(pieces, record.path not in candidates and all(inner.is_pure for inner in below))


def _may_be_object(record: PrimRecord, outline: Outline) -> bool:
    is_all = record.gprim_count == outline.root.gprim_count
    is_top = record.parent is outline.root
    return is_unnamed(record.name) and record.kind not in {"assembly", "group"} and not (is_all and is_top)


def _loose_gprims(record: PrimRecord) -> list[PrimRecord]:
    """Return the unnamed gprims that are the only geometry of an unnamed prim and its children; else none."""
    if record.is_gprim or not is_unnamed(record.name):
        return []
    gprims = [child for child in record.children if child.is_gprim and not child.is_hidden]
    is_all = len(gprims) == record.gprim_count <= UNNAMED.max_pieces
    return gprims if is_all and all(is_unnamed(gprim.name) for gprim in gprims) else []


def _paths_above(record: PrimRecord) -> Iterator[str]:
    above = record.parent
    while above is not None:
        yield above.path
        above = above.parent
