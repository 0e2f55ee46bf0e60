"""label_stage: the classes of a run, as labels in a layer over the stage."""

from collections.abc import Callable
from pathlib import Path

from usd2kg.labels.class_labels import label_maker
from usd2kg.labels.layer import write_labels
from usd2kg.labels.model import ClassLabel, LabelOptions, LabelOutcome, LabelReport
from usd2kg.labels.prim_classes import PrimClass, PrimClasses
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["label_stage"]


def label_stage(
    scene: Path,
    run: PrimClasses,
    tbox: TBox,
    output: Path,
    *,
    options: LabelOptions | None = None,
    style: str = "local",
    has_ancestors: bool = False,
    min_confidence: float = 0.0,
) -> LabelReport:
    """Write a layer over a scene that labels its prims with the classes of a run; return what became of each prim.

    Prims without a class or below `min_confidence` get no label; an unknown confidence passes only
    if it is 0. A class that a person decided is
    written whatever its confidence.

    Raises:
        SceneError: the scene cannot be read.
        OutputError: the layer cannot be written, or there is no such style.
    """
    make = label_maker(tbox, style, has_ancestors=has_ancestors)
    labels, outcomes = _labels(run, make, min_confidence)
    chosen = options or LabelOptions(provenance={"ontology": tbox.ontology_iri})
    written = write_labels(scene, labels, output, chosen)
    every = sorted((*outcomes, *written.outcomes), key=lambda entry: entry.prim_path.split("/"))
    return LabelReport(tuple(every), written.de_instanced)


def _labels(
    run: PrimClasses, make: Callable[[ClassIRI], ClassLabel], min_confidence: float
) -> tuple[dict[str, ClassLabel], list[LabelOutcome]]:
    labels: dict[str, ClassLabel] = {}
    outcomes: list[LabelOutcome] = []
    for answer in run.entries:
        reason = _reason_against(answer, min_confidence)
        if reason or answer.class_iri is None:
            outcomes.append(LabelOutcome(answer.prim_path, "left out", reason))
        else:
            labels[answer.prim_path] = make(answer.class_iri)
    return labels, outcomes


def _reason_against(answer: PrimClass, min_confidence: float) -> str:
    """Return why an answer gives no label; empty if it does."""
    if answer.class_iri is None:
        return f"the run has no class for it{f': {answer.status}' if answer.status else ''}"
    if answer.is_reviewed or min_confidence <= 0:
        return ""
    if answer.confidence is None:
        return f"its class has no confidence, expected at least {min_confidence:g}"
    return f"its class is less sure than {min_confidence:g}" if answer.confidence < min_confidence else ""
