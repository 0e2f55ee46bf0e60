"""Labels of prims and objects, in all encodings."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from pxr import UsdGeom

from usd2kg.scene.label_encodings import find_labels, predicted_confidence, semantic_names
from usd2kg.scene.model import NO_LABELS, Label, ObjectLabels
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.sets_of_objects import is_room_name
from usd2kg.scene.settings import LIMITS

__all__ = ["LabelReader", "class_reader", "read_labels"]


class LabelReader:
    """Reads the labels of objects at one time; labels of shared ancestors are read once."""

    def __init__(self, time: Any, known: Mapping[str, tuple[Label, ...]] | None = None) -> None:
        """Read at `time`; `known` maps the paths of prims that were read before to their labels."""
        self._time = time
        self._known = known or {}
        self._above: dict[str, tuple[Label, ...]] = {}

    def read(self, records: list[PrimRecord]) -> ObjectLabels:
        """Return the labels of an object, given its prim and the prims below it without nested objects."""
        own = self._read(records[0].prim) if records[0].is_labelled else ()
        below = [label for prim in _labelled_parts(records) for label in self._read(prim)]
        labels = self.inherit(ObjectLabels(own, (), _distinct(below)[: LIMITS.max_part_labels]), records[0].parent)
        return labels if own or labels is NO_LABELS else labels._replace(of_whole=self._of_whole(records))

    def inherit(self, labels: ObjectLabels, parent: PrimRecord | None) -> ObjectLabels:
        """Return labels with those that an object inherits from the prim above it and the ancestors of that prim."""
        inherited = _distinct([*labels.own, *self._inherited(parent)])[len(labels.own) :]
        return labels._replace(inherited=inherited) if labels.own or inherited or labels.of_parts else NO_LABELS

    def _of_whole(self, records: list[PrimRecord]) -> tuple[Label, ...]:
        """Return the labels on the nearest wrapper of an object, or those that all its geometry shares."""
        root = records[0]
        above = root.parent
        while above is not None and above.gprim_count == root.gprim_count and not is_room_name(above.name):
            if above.is_labelled and above.parent is not None:
                return self._read(above.prim)
            above = above.parent
        gprims = [record for record in records if record.is_gprim and not record.is_hidden]
        if not gprims or not all(gprim.is_labelled for gprim in gprims):
            return ()
        first, *others = (self._read(gprim.prim) for gprim in gprims)
        stated = {(label.taxonomy, label.value) for label in first}
        is_shared = all(stated == {(label.taxonomy, label.value) for label in labels} for labels in others)
        return first if is_shared else ()

    def read_shared(self, prims: list[Any]) -> tuple[Label, ...]:
        """Return the labels on the first of some prims that all of them have."""
        first, *others = map(self._read, prims) if prims else [()]
        common = set(map(_meaning, first)).intersection(*(map(_meaning, labels) for labels in others))
        return tuple(label for label in first if _meaning(label) in common)

    def _read(self, prim: Any) -> tuple[Label, ...]:
        known = self._known.get(str(prim.GetPath())) if self._known else None
        return read_labels(prim, self._time) if known is None else known

    def _inherited(self, record: PrimRecord | None) -> list[Label]:
        found: list[Label] = []
        while record is not None:
            if record.is_labelled:
                if record.path not in self._above:
                    here = self._read(record.prim)
                    self._above[record.path] = tuple(replace(label, is_inherited=True) for label in here)
                found += self._above[record.path]
            record = record.parent
        return found


def _labelled_parts(records: list[PrimRecord]) -> Iterator[Any]:
    for record in records:
        if record.is_labelled and record is not records[0]:
            yield record.prim
        if record.has_subsets:
            yield from (subset.GetPrim() for subset in UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(record.prim)))


def _distinct(labels: Iterable[Label]) -> tuple[Label, ...]:
    first: dict[tuple[str, str, str], Label] = {}
    for label in labels:
        first.setdefault(_meaning(label), label)
    return tuple(first.values())


def _meaning(label: Label) -> tuple[str, str, str]:
    return label.encoding, label.taxonomy, label.value


def read_labels(prim: Any, time: Any) -> tuple[Label, ...]:
    """Return the labels authored on `prim` itself at `time`, in all encodings, whether or not a schema is applied.

    Blank values, values longer than 200 characters and labels that a stronger layer blocks are left out;
    `lint_labels` reports the first two. If a Multiverse class prim is missing, its path gives taxonomy and
    class name.
    """
    names = semantic_names(prim)
    if not names:
        return ()
    path, found = str(prim.GetPath()), find_labels(prim, names, time)
    confidence = predicted_confidence(prim, found)
    return _distinct(
        Label(path, entry.encoding, entry.taxonomy, value, strength=entry.strength, confidence=confidence)
        for entry in found
        for value in entry.values
        if value and len(value) <= LIMITS.max_text_length and (entry.taxonomy or entry.encoding != "Isaac")
    )


def class_reader(time: Any) -> Callable[[PrimRecord], frozenset[str]]:
    """Return a function that returns the labels on a prim itself that state its class at `time`, in lower case."""

    def read(record: PrimRecord) -> frozenset[str]:
        prim = record.source.prim
        found = find_labels(prim, semantic_names(prim), time)
        return frozenset(value.lower() for entry in found if entry.states_class for value in entry.values)

    return read
