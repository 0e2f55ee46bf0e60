"""What follows from the decisions, as files: graph, mapping, labels, objects, alignment."""

import csv
import io
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

import pyoxigraph as ox

from usd2kg.errors import SceneError
from usd2kg.graph import format_sssom, serialize_graph
from usd2kg.grounding import format_mapping
from usd2kg.labels import LabelOptions, classes_of_grounding, label_stage
from usd2kg.readiness import format_suggestions
from usd2kg.studio.lessons import format_lessons
from usd2kg.studio.proposals import find_proposals
from usd2kg.studio.session import StudioSession

__all__ = ["EXPORTS", "Export", "write_label_layer"]

_OBJECT_COLUMNS = (
    *("path", "name", "class", "label", "state", "confidence", "suggested", "concept"),
    *("reviewer", "time", "comment", "x", "y", "z", "width", "depth", "height"),
)


class Export(NamedTuple):
    """A file that can be downloaded."""

    media_type: str
    write: Callable[[StudioSession], bytes]


def _graph(session: StudioSession) -> bytes:
    return serialize_graph(session.graph(), ox.RdfFormat.TURTLE)


def _mapping(session: StudioSession) -> bytes:
    names = {obj.prim_path: obj.display_name or obj.name for obj in session.scene.objects}
    return format_sssom(session.grounding(), session.tbox, names, base=session.base).encode()


def _grounding(session: StudioSession) -> bytes:
    return format_mapping(session.grounding(), session.tbox, "json").encode()


def _decisions(session: StudioSession) -> bytes:
    return session.journal.path.read_bytes()


def _labels(session: StudioSession) -> bytes:
    # A layer of labels only: a sublayer path to the stage would be wrong wherever the browser saves it.
    with tempfile.TemporaryDirectory(prefix="usd2kg-labels-") as folder:
        target = Path(folder) / "labels.usda"
        write_label_layer(session, target, is_bare=True)
        return target.read_bytes()


def write_label_layer(session: StudioSession, target: Path, *, is_bare: bool) -> None:
    """Write the classes as semantic labels; unless bare, over the stage as a sublayer.

    Raises:
        Usd2kgError: the stage cannot be read or the layer cannot be written.
    """
    if session.stage is None:
        raise SceneError(session.stage_note)
    classes = classes_of_grounding(session.grounding())
    options = LabelOptions(is_bare=is_bare, provenance={"ontology": session.tbox.ontology_iri})
    label_stage(session.label_stage, classes, session.tbox, target, options=options)


def _objects(session: StudioSession) -> bytes:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_OBJECT_COLUMNS)
    for obj, state in zip(session.scene.objects, session.states(), strict=True):
        chosen = session.tbox.by_iri.get(state.class_iri or "")
        suggested = session.tbox.by_iri.get(state.prediction.class_iri or "")
        concept = session.suggestions.concepts.get(state.prediction.concept or "")
        box = obj.own_box or obj.box
        confidence = state.confidence
        writer.writerow(
            (
                *(obj.prim_path, obj.display_name or obj.name),
                *((chosen.iri, chosen.label) if chosen is not None else ("", "")),
                *(state.status.value, "" if confidence is None else f"{confidence:.4f}"),
                *(suggested.label if suggested is not None else "", concept.label if concept is not None else ""),
                *(state.verdict.reviewer, state.verdict.time, state.verdict.comment),
                *((f"{value:.4f}" for value in (*box.center, *box.size)) if box is not None else ("",) * 6),
            )
        )
    return text.getvalue().encode()


def _lessons(session: StudioSession) -> bytes:
    return format_lessons(session.lessons(), session.tbox).encode()


def _proposals(session: StudioSession) -> bytes:
    return format_suggestions(find_proposals(session.states(), session.suggestions), session.tbox).encode()


EXPORTS: Mapping[str, Export] = {
    "graph.ttl": Export("text/turtle", _graph),
    "mapping.sssom.tsv": Export("text/tab-separated-values", _mapping),
    "grounding.json": Export("application/json", _grounding),
    "decisions.sssom.tsv": Export("text/tab-separated-values", _decisions),
    "lessons.sssom.tsv": Export("text/tab-separated-values", _lessons),
    "proposals.ttl": Export("text/turtle", _proposals),
    "labels.usda": Export("text/plain", _labels),
    "objects.csv": Export("text/csv", _objects),
}
"""File name → export."""
