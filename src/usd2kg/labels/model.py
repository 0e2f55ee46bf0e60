"""What labels are to be written, how, and what became of them."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, get_args

from usd2kg.scene.model import Encoding

__all__ = [
    "LABEL_MODES",
    "OUTCOMES",
    "ClassLabel",
    "LabelMode",
    "LabelOptions",
    "LabelOutcome",
    "LabelReport",
    "Outcome",
]

LabelMode = Literal["new", "overwrite", "skip"]
LABEL_MODES: tuple[LabelMode, ...] = get_args(LabelMode)
Outcome = Literal["written", "replaced", "completed", "kept", "left out"]
"""`written`: had no label; `replaced`: its class labels are others now; `completed`: what was missing beside its labels
was added; `kept`: has its labels as before; `left out`: gets none."""
OUTCOMES: tuple[Outcome, ...] = get_args(Outcome)


@dataclass(frozen=True, slots=True)
class ClassLabel:
    """A class as labels say it; objects of one class share it."""

    token: str
    """The label itself: `Cup`."""
    iri: str
    """IRI of the class."""
    concept: str
    """The end of the IRI, `Cup`, which Multiverse calls the concept's name."""
    namespace: str
    """The IRI before it."""
    above: tuple[str, ...] = ()
    """Labels of the classes above that are to be written too, the most general first."""
    qcodes: tuple[str, ...] = ()
    """Wikidata items."""
    definition: str = ""
    names: frozenset[str] = frozenset()
    """Further names by which a label that stands already means the same class."""


@dataclass(frozen=True, slots=True)
class LabelOptions:
    """How labels are written."""

    encodings: tuple[Encoding, ...] = ("UsdSemantics",)
    mode: LabelMode = "new"
    """`new` labels prims that have no label at all; `overwrite` replaces whatever says the class of a prim, in all
    encodings; `skip` keeps every label and adds what is missing, where the labels mean the same class."""
    is_bare: bool = False
    """Whether the layer holds the labels alone; else it is a root layer over the source."""
    de_instances: bool = False
    """Whether instances are broken up where parts inside them are to be labelled."""
    provenance: Mapping[str, str] = field(default_factory=dict)
    """What the layer tells of its origin, in `customLayerData`."""


@dataclass(frozen=True, slots=True)
class LabelOutcome:
    """What became of the label of one prim."""

    prim_path: str
    outcome: Outcome
    reason: str
    """Why it was kept or left out; empty for what was written."""


@dataclass(frozen=True)
class LabelReport:
    """What became of the labels of one layer."""

    outcomes: tuple[LabelOutcome, ...]
    """For each prim that was asked for, by path."""
    de_instanced: tuple[str, ...] = ()
    """Paths of the instances that the layer breaks up."""

    @cached_property
    def counts(self) -> Mapping[Outcome, int]:
        """Outcome → number of prims."""
        return Counter(entry.outcome for entry in self.outcomes)
