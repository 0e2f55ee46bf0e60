"""Ground an open stage and label it in its session layer. Imports nothing of Omniverse."""

from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from pxr import Usd

from usd2kg.errors import OutputError
from usd2kg.grounding import Grounding, ground
from usd2kg.labels import (
    LABEL_MODES,
    LabelOptions,
    LabelReport,
    classes_of_grounding,
    label_session,
    parse_encodings,
    remove_session_labels,
)
from usd2kg.ontology import TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import Scene, read_scene

__all__ = [
    "GroundedObjects",
    "GroundedStage",
    "LabelSettings",
    "ground_objects",
    "ground_stage",
    "label_objects",
    "read_objects",
    "remove_labels",
]


@dataclass(frozen=True)
class LabelSettings:
    """The settings of the extension."""

    ontology: str = ""
    """An OWL file; empty for the built-in ontology that suits the stage."""
    encodings: str = "semantics"
    """Comma-separated encodings, as for `usd2kg label --encoding`."""
    mode: str = "new"
    """What happens to prims with labels, as for `usd2kg label --mode`."""
    min_confidence: float = 0.0
    """Objects whose class is less certain get no label."""

    @cached_property
    def label_options(self) -> LabelOptions:
        """The settings as options of usd2kg.

        Raises:
            OutputError: an encoding or the mode is unknown.
        """
        mode = next((known for known in LABEL_MODES if known == self.mode), None)
        if mode is None:
            raise OutputError(f"mode {self.mode}: expected one of {', '.join(LABEL_MODES)}")
        return LabelOptions(parse_encodings(self.encodings, "encodings"), mode)


@dataclass(frozen=True)
class GroundedObjects:
    """The objects of a stage with their classes, before anything is written."""

    scene: Scene
    tbox: TBox
    grounding: Grounding


@dataclass(frozen=True)
class GroundedStage:
    """The result of grounding and labelling a stage."""

    objects: GroundedObjects
    report: LabelReport
    """What was written for each prim."""

    @property
    def labelled(self) -> int:
        """Number of prims whose labels were written, replaced or completed."""
        counts = self.report.counts
        return len(self.report.outcomes) - counts["kept"] - counts["left out"]

    @property
    def summary(self) -> str:
        """One line for the user."""
        classes = Counter(p.class_iri for p in self.objects.grounding.predictions if p.class_iri is not None)
        counts = self.report.counts
        parts = [f"{self.labelled} labelled"]
        parts += [f"{counts['kept']} keep their own labels"] if counts["kept"] else []
        parts += [f"{counts['left out']} left out"] if counts["left out"] else []
        found = f"{len(self.objects.scene.objects)} objects of {len(classes)} classes"
        return f"{found}: {', '.join(parts)}"


def ground_stage(
    stage: Usd.Stage, ontology: Path | str | None = None, settings: LabelSettings | None = None
) -> GroundedStage:
    """Ground the objects of an open stage and label them in its session layer; other layers stay untouched.

    Labels of an earlier call are replaced.

    Args:
        stage: the open stage, read with its session layer and current variants.
        ontology: an OWL file; default: that of the settings.
        settings: encodings, mode and confidence; default: UsdSemantics on prims without labels.

    Raises:
        Usd2kgError: the stage has no objects, the ontology cannot be read, or a setting is invalid.
    """
    settings = settings or LabelSettings()
    grounded = ground_objects(read_objects(stage), ontology or settings.ontology or None)
    return label_objects(stage, grounded, settings)


def read_objects(stage: Usd.Stage) -> Scene:
    """Return the objects of an open stage.

    Earlier labels are removed first: they would be evidence for themselves.

    Raises:
        SceneError: the stage has no objects.
    """
    remove_labels(stage)
    return read_scene(stage)


def ground_objects(scene: Scene, ontology: Path | str | None = None) -> GroundedObjects:
    """Return the class of each object. Needs no stage, so it may run in another thread.

    Raises:
        OntologyError: the ontology cannot be read.
    """
    tbox = open_tbox(ontology, scene)
    return GroundedObjects(scene, tbox, ground(scene, tbox))


def label_objects(stage: Usd.Stage, objects: GroundedObjects, settings: LabelSettings | None = None) -> GroundedStage:
    """Write the classes as labels into the session layer of the stage.

    Raises:
        OutputError: a setting is invalid, or the stage has no session layer.
    """
    settings = settings or LabelSettings()
    report = label_session(
        stage,
        classes_of_grounding(objects.grounding),
        objects.tbox,
        options=settings.label_options,
        min_confidence=settings.min_confidence,
    )
    return GroundedStage(objects, report)


def remove_labels(stage: Usd.Stage) -> bool:
    """Remove the labels that were written; return whether there were any."""
    return remove_session_labels(stage)
