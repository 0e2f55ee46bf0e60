"""label_stage: the classes of a run, as labels in a layer over the stage."""

from collections.abc import Callable
from pathlib import Path

from usd2kg.labels.classes import label_maker
from usd2kg.labels.layer import write_labels
from usd2kg.labels.model import ClassLabel, LabelOptions, LabelOutcome, LabelReport
from usd2kg.labels.runs import Answer, Run
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["label_stage"]


def label_stage(
    scene: Path,
    run: Run,
    tbox: TBox,
    output: Path,
    *,
    options: LabelOptions | None = None,
    naming: str = "local",
    has_ancestors: bool = False,
    at_least: float = 0.0,
) -> LabelReport:
    """Write a layer over a scene that labels its prims with the classes of a run; return what became of each prim.

    What has no class, or a class that is less sure than `at_least` or of unknown confidence where that is above 0,
    gets no label. What a person decided does, however sure they said they were.

    Raises:
        SceneError: the scene cannot be read.
        OutputError: the layer cannot be written, or there is no such naming.
    """
    make = label_maker(tbox, naming, has_ancestors=has_ancestors)
    labels, outcomes = _labels(run, make, at_least)
    chosen = options or LabelOptions(provenance={"ontology": tbox.ontology_iri})
    written = write_labels(scene, labels, output, chosen)
    every = sorted((*outcomes, *written.outcomes), key=lambda entry: entry.prim_path.split("/"))
    return LabelReport(tuple(every), written.de_instanced)


def _labels(
    run: Run, make: Callable[[ClassIRI], ClassLabel], at_least: float
) -> tuple[dict[str, ClassLabel], list[LabelOutcome]]:
    labels: dict[str, ClassLabel] = {}
    outcomes: list[LabelOutcome] = []
    for answer in run.answers:
        reason = _reason_against(answer, at_least)
        if reason or answer.class_iri is None:
            outcomes.append(LabelOutcome(answer.prim_path, "left out", reason))
        else:
            labels[answer.prim_path] = make(answer.class_iri)
    return labels, outcomes


def _reason_against(answer: Answer, at_least: float) -> str:
    """Return why an answer gives no label; empty if it does."""
    if answer.class_iri is None:
        return f"the run has no class for it{f': {answer.status}' if answer.status else ''}"
    if answer.is_reviewed or at_least <= 0:
        return ""
    if answer.confidence is None:
        return f"its class has no confidence, expected at least {at_least:g}"
    return f"its class is less sure than {at_least:g}" if answer.confidence < at_least else ""
