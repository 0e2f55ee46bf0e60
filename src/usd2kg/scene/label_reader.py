"""The labels that prims and objects carry, in whatever encoding."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from pxr import UsdGeom

from usd2kg.scene.label_encodings import LONGEST, find_labels, semantic_names
from usd2kg.scene.model import NO_LABELS, Label, ObjectLabels
from usd2kg.scene.outline import PrimRecord

__all__ = ["LabelReader", "read_labels"]

_MOST_PARTS = 64


class LabelReader:
    """Reads the labels of objects at one time; what stands above several objects is read once."""

    def __init__(self, time: Any, known: Mapping[str, tuple[Label, ...]] | None = None) -> None:
        """Read at `time`; `known` gives the labels of the prims that were read already, by path."""
        self._time = time
        self._known = known or {}
        self._above: dict[str, tuple[Label, ...]] = {}

    def read(self, records: list[PrimRecord]) -> ObjectLabels:
        """Return the labels of the object whose own records are `records`, its prim first."""
        own = self._read(records[0].prim) if records[0].is_labelled else ()
        inherited = _distinct([*own, *self._inherited(records[0].parent)])[len(own) :]
        below = [label for prim in _parts(records) for label in self._read(prim)]
        if not (own or inherited or below):
            return NO_LABELS
        return ObjectLabels(own, inherited, _distinct(below)[:_MOST_PARTS])

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


def _parts(records: list[PrimRecord]) -> Iterator[Any]:
    for record in records:
        if record.is_labelled and record is not records[0]:
            yield record.prim
        if record.has_subsets:
            yield from (subset.GetPrim() for subset in UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(record.prim)))


def _distinct(labels: Iterable[Label]) -> tuple[Label, ...]:
    first: dict[tuple[str, str, str], Label] = {}
    for label in labels:
        first.setdefault((label.encoding, label.taxonomy, label.value), label)
    return tuple(first.values())


def read_labels(prim: Any, time: Any) -> tuple[Label, ...]:
    """Return the labels that stand on `prim` itself at `time`, in all encodings, applied schema or not.

    Blank values and values beyond 200 characters are left out; `lint_labels` reports them. A Multiverse class prim
    that does not exist still gives the name in its path. What a layer above blocks is none.
    """
    names = semantic_names(prim)
    if not names:
        return ()
    path = str(prim.GetPath())
    return _distinct(
        Label(path, entry.encoding, entry.taxonomy, value, strength=entry.strength)
        for entry in find_labels(prim, names, time)
        for value in entry.values
        if value and len(value) <= LONGEST and (entry.taxonomy or entry.encoding != "Isaac")
    )
