"""PrototypeReader: what the prototypes of point instancers state about their copies."""

from functools import partial
from typing import Any

from usd2kg.scene.bounds import BoxReader
from usd2kg.scene.evidence import NO_EVIDENCE, asset_arcs, asset_names, part_names, stated_fields
from usd2kg.scene.instancers import Prototype
from usd2kg.scene.label_reader import LabelReader
from usd2kg.scene.masses import MassReader
from usd2kg.scene.metadata import MaterialReader
from usd2kg.scene.model import NO_LABELS, Diagnostic
from usd2kg.scene.outline import Outline, PrimRecord
from usd2kg.scene.stage import UNREADABLE, error_text
from usd2kg.scene.traversal import outline_prototype

__all__ = ["PrototypeReader"]


class PrototypeReader:
    """Reads each prototype once, however many instancers draw it."""

    def __init__(self, masses: MassReader, boxes: BoxReader, labels: LabelReader, notes: list[Diagnostic]) -> None:
        """Read at the time of `boxes`; `notes` receives the problems."""
        self._masses = masses
        self._boxes = boxes
        self._labels = labels
        self._notes = notes
        self._known: dict[str, Prototype] = {}

    def read(self, prim: Any, instancer: PrimRecord) -> Prototype:
        """Return what a prototype states about the copies that an instancer draws."""
        path = prim.GetPath().pathString
        if path not in self._known:
            with outline_prototype(prim, self._boxes.time) as outline:
                self._known[path] = self._read(prim, outline)
        found = self._known[path]
        # A copy is below its instancer, wherever the prototype is.
        labels = self._labels.inherit(found.fields["labels"], instancer)
        return found._replace(fields={**found.fields, "labels": labels})

    def _read(self, prim: Any, outline: Outline) -> Prototype:
        records, name = outline.records, prim.GetName()
        named = {
            "type_name": str(prim.GetTypeName()),
            "display_name": prim.GetDisplayName(),
            "documentation": prim.GetDocumentation().strip(),
            "instance_of": prim.GetPath().pathString,
            "parts": part_names(records) if records else (),
        }
        nothing = {**NO_EVIDENCE, "labels": NO_LABELS, "asset": asset_names(prim.GetAssetInfo(), asset_arcs(prim))}
        if not records:
            # It is inactive, abstract or invisible.
            return Prototype(name, {**named, **nothing})
        try:
            mass = self._masses.read(records, partial(self._boxes.read_point_below, records[0]))
            labels = self._labels if outline.labelled_prims else None
            stated = stated_fields(records, MaterialReader(self._boxes.time), labels, self._boxes.time)
        except UNREADABLE as error:
            reason = error_text(error) or "OpenUSD gives no reason"
            message = f"its evidence cannot be read ({reason}); only the names and boxes of its copies are"
            self._notes.append(Diagnostic("unreadable", message, records[0].path))
            return Prototype(name, {**named, **nothing})
        # An identifier names one thing, not all copies.
        return Prototype(name, {**named, **stated, "mass_kg": mass.kg, "source_id": ""}, mass.center)
