"""label_stage, label_session: write grounded classes as labels over a scene, or to an open stage."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from pxr import Sdf, Usd

from usd2kg.labels.author import author_labels
from usd2kg.labels.class_labels import label_maker
from usd2kg.labels.layer import write_labels
from usd2kg.labels.model import ClassLabel, LabelOptions, LabelOutcome, LabelReport
from usd2kg.labels.prim_classes import PrimClass, PrimClasses
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.scene.session_layer import add_to_session, remove_from_session
from usd2kg.tracing import traced

__all__ = ["label_session", "label_stage", "remove_session_labels"]

_CONTENT = "labels"


@traced("label", lambda report: {"prims": len(report.outcomes)})
def label_stage(
    scene: Path | Usd.Stage,
    classes: PrimClasses,
    tbox: TBox,
    output: Path,
    *,
    options: LabelOptions | None = None,
    style: str = "local",
    has_ancestors: bool = False,
    min_confidence: float = 0.0,
) -> LabelReport:
    """Write a layer over a scene that labels its prims with their classes; return the outcome for each prim.

    Args:
        scene: the stage's root layer, or the open stage.
        classes: the class of each prim.
        tbox: the ontology of the classes.
        output: the layer to write, `.usda`, `.usdc` or `.usd`.
        options: see `LabelOptions`.
        style: one of `LABEL_STYLES`.
        has_ancestors: whether to write the superclasses as well.
        min_confidence: classes with a lower or no confidence are omitted unless a person decided them; 0 keeps all.

    Raises:
        SceneError: the scene cannot be read.
        OutputError: the layer cannot be written, or the style is unknown.
    """
    make = label_maker(tbox, style, has_ancestors=has_ancestors)
    labels, left_out = _make_labels(classes, make, min_confidence)
    chosen = options or LabelOptions(provenance={"ontology": tbox.ontology_iri})
    return _complete_report(write_labels(scene, labels, output, chosen), left_out)


def label_session(
    stage: Usd.Stage,
    classes: PrimClasses,
    tbox: TBox,
    *,
    options: LabelOptions | None = None,
    style: str = "local",
    has_ancestors: bool = False,
    min_confidence: float = 0.0,
) -> LabelReport:
    """Label the prims of an open stage in its session layer; return the outcome for each prim.

    Earlier labels of this function are replaced. No other layer changes, and no file is written. The arguments are
    those of `label_stage`.

    Raises:
        OutputError: the stage has no session layer, or the style is unknown.
    """
    make = label_maker(tbox, style, has_ancestors=has_ancestors)
    labels, left_out = _make_labels(classes, make, min_confidence)
    # Labels of an earlier call would count as existing labels.
    remove_session_labels(stage)
    opinions = Sdf.Layer.CreateAnonymous()
    written = author_labels(stage, labels, opinions, options or LabelOptions())
    add_to_session(stage, opinions, _CONTENT)
    return _complete_report(written, left_out)


def remove_session_labels(stage: Usd.Stage) -> bool:
    """Remove the labels that `label_session` wrote; return whether there were any."""
    return remove_from_session(stage, _CONTENT)


def _complete_report(written: LabelReport, left_out: list[LabelOutcome]) -> LabelReport:
    outcomes = sorted((*left_out, *written.outcomes), key=lambda entry: entry.prim_path.split("/"))
    return LabelReport(tuple(outcomes), written.de_instanced)


def _make_labels(
    classes: PrimClasses, make: Callable[[ClassIRI], ClassLabel], min_confidence: float
) -> tuple[dict[str, ClassLabel], list[LabelOutcome]]:
    labels: dict[str, ClassLabel] = {}
    left_out: list[LabelOutcome] = []
    for entry in classes.entries:
        if reason := _reason_to_leave_out(entry, min_confidence):
            left_out.append(LabelOutcome(entry.prim_path, "left out", reason))
        elif entry.class_iri is not None:
            confidence = None if entry.is_reviewed else entry.confidence
            labels[entry.prim_path] = replace(make(entry.class_iri), concept=entry.concept, confidence=confidence)
    return labels, left_out


def _reason_to_leave_out(entry: PrimClass, min_confidence: float) -> str:
    """Return why a prim gets no label; empty if it gets one."""
    if entry.class_iri is None:
        return f"the run has no class for it{f': {entry.status}' if entry.status else ''}"
    if entry.is_reviewed or min_confidence <= 0:
        return ""
    if entry.confidence is None:
        return f"unknown confidence, expected at least {min_confidence:g}"
    return f"confidence below {min_confidence:g}" if entry.confidence < min_confidence else ""
