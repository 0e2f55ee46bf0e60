"""HTML of the dialogs: the page of an object, and the legend of the colours."""

from collections.abc import Iterable
from html import escape

from usd2kg.diagrams import Coloring
from usd2kg.grounding import Prediction
from usd2kg.ontology import ClassIRI
from usd2kg.scene import SceneObject
from usd2kg_usdview.core import GroundedStage, find_object

__all__ = ["legend_page", "object_page"]

_MAX_CANDIDATES = 5


def object_page(grounded: GroundedStage, prim_path: str) -> str:
    """Return what is known about the object that a prim belongs to, as HTML."""
    obj = find_object(grounded.scene, prim_path)
    if obj is None:
        return f"<p>{escape(prim_path)} belongs to no object.</p>"
    rows = list(_rows(grounded, obj, grounded.grounding.by_path[obj.prim_path]))
    table = "".join(f"<tr><td><b>{name}</b>&nbsp;</td><td>{value}</td></tr>" for name, value in rows if value)
    return f"<h3>{escape(obj.display_name or obj.name)}</h3><table>{table}</table>"


def legend_page(coloring: Coloring) -> str:
    """Return the colours with their classes and numbers of objects, as HTML."""
    rows = (
        f'<tr><td bgcolor="{entry.color}">&nbsp;&nbsp;&nbsp;&nbsp;</td><td>&nbsp;{escape(entry.label)}</td>'
        f'<td align="right">&nbsp;{len(entry.prim_paths)}</td></tr>'
        for entry in coloring.legend
    )
    return f"<table>{''.join(rows)}</table>"


def _rows(grounded: GroundedStage, obj: SceneObject, prediction: Prediction) -> Iterable[tuple[str, str]]:
    iri = prediction.class_iri
    yield "Prim", escape(obj.prim_path)
    yield "Class", escape(f"{_label(grounded, iri)} <{iri}>" if iri else f"none ({prediction.status.value})")
    yield "Confidence", "" if prediction.confidence is None else f"{prediction.confidence:.2f}"
    yield "Concept", escape(_concept(grounded, prediction))
    yield "Explanation", escape(prediction.explanation)
    yield "Candidates", "<br>".join(escape(line) for line in _candidates(grounded, prediction))
    box = obj.own_box or obj.box
    yield "Size", "" if box is None else " × ".join(f"{length:.3f}" for length in box.size) + " m"


def _label(grounded: GroundedStage, iri: ClassIRI) -> str:
    return grounded.tbox.by_iri[iri].label


def _concept(grounded: GroundedStage, prediction: Prediction) -> str:
    concept = grounded.grounding.concepts.get(prediction.concept or "")
    if concept is None:
        return ""
    confidence = prediction.concept_confidence
    return concept.label if confidence is None else f"{concept.label} ({confidence:.2f})"


def _candidates(grounded: GroundedStage, prediction: Prediction) -> Iterable[str]:
    for candidate in prediction.candidates[:_MAX_CANDIDATES]:
        yield f"{_label(grounded, candidate.class_iri)} (score {candidate.score:.2f})"
