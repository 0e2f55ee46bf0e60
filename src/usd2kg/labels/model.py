"""Input and result of writing labels: the label of a class, options, and an outcome for each prim."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, get_args

from usd2kg.ontology import ClassIRI
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
"""`written`: the prim had no label; `replaced`: its class labels were replaced; `completed`: missing encodings or
taxonomies were added; `kept`: its labels are unchanged; `left out`: it gets no label."""
OUTCOMES: tuple[Outcome, ...] = get_args(Outcome)


@dataclass(frozen=True, slots=True)
class ClassLabel:
    """A class and optionally a concept, as written in labels."""

    token: str
    """The label, such as `Cup`."""
    iri: ClassIRI
    local_name: str
    """Local name of the IRI, which is Multiverse's `rdf:conceptName`."""
    namespace: str
    """The IRI without its local name."""
    ancestors: tuple[str, ...] = ()
    """Tokens of the superclasses to write, most general first; empty if they are not written."""
    qcodes: tuple[str, ...] = ()
    """Wikidata items."""
    definition: str = ""
    names: frozenset[str] = frozenset()
    """Labels and synonyms of the class, to recognise existing labels."""
    concept: str = ""
    """Noun for the concept of the object, independent of its class; empty if it has none."""
    confidence: float | None = None
    """Confidence of the prediction; None if it is unknown, or a person decided."""


@dataclass(frozen=True, slots=True)
class LabelOptions:
    """How labels are written."""

    encodings: tuple[Encoding, ...] = ("UsdSemantics",)
    mode: LabelMode = "new"
    """`new` labels only prims without labels; `overwrite` replaces all class labels of a prim in all encodings; `skip`
    keeps all labels and adds missing encodings and taxonomies if the existing labels name the same class."""
    is_bare: bool = False
    """Whether the layer contains only labels; otherwise it is a root layer over the source."""
    de_instances: bool = False
    """Whether `instanceable` is set to false where a prim inside an instance is labelled."""
    provenance: Mapping[str, str] = field(default_factory=dict)
    """Origin of the labels, for `customLayerData`."""


@dataclass(frozen=True, slots=True)
class LabelOutcome:
    """The outcome for one prim."""

    prim_path: str
    outcome: Outcome
    reason: str
    """Why the prim was kept or left out; empty otherwise."""


@dataclass(frozen=True)
class LabelReport:
    """The outcomes of writing one layer."""

    outcomes: tuple[LabelOutcome, ...]
    """One per requested prim, by path."""
    de_instanced: tuple[str, ...] = ()
    """Paths of the instances for which the layer turns off instancing."""

    @cached_property
    def counts(self) -> Mapping[Outcome, int]:
        """Outcome → number of prims."""
        return Counter(entry.outcome for entry in self.outcomes)
