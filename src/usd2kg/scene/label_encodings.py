"""The three encodings of semantic labels on prims: names of properties and schemas, and their values.

- OpenUSD's own: `token[] semantics:labels:<taxonomy>`, schema `SemanticsLabelsAPI:<taxonomy>` (UsdSemantics).
- Isaac and Replicator: `semantic:<instance>:params:semanticType` and `semanticData`, schema `SemanticsAPI:<instance>`.
- Multiverse: `rel semanticTag:semanticLabels` and `semanticReports`, to class prims with `rdf:conceptName`.
"""

import re
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from usd2kg.scene.metadata import authored_texts, clean_text
from usd2kg.scene.model import Encoding, Strength
from usd2kg.scene.stage import read_targets
from usd2kg.words import words_of

__all__ = [
    "CLASS_TAXONOMIES",
    "CONCEPT_TAXONOMY",
    "PREDICTION_KEY",
    "QCODE",
    "TAGS",
    "TAG_LABELS",
    "TAG_SCHEMA",
    "USD_LABEL_TYPE",
    "USD_PREFIX",
    "LabelProperty",
    "applied_schemas",
    "class_words",
    "clean_values",
    "find_labels",
    "isaac_instance",
    "isaac_property",
    "isaac_schema",
    "predicted_confidence",
    "property_type",
    "schema_of",
    "semantic_names",
    "tag_targets",
    "usd_schema",
]


USD_PREFIX = "semantics:labels:"
USD_LABEL_TYPE = "token[]"
"""The only attribute type in which OpenUSD reads labels."""
TAG_LABELS = "semanticTag:semanticLabels"
TAG_SCHEMA = "SemanticTagAPI"
TAGS: dict[str, Strength] = {TAG_LABELS: "label", "semanticTag:semanticReports": "report"}
QCODE = re.compile("Q[0-9]+")
CLASS_TAXONOMIES = frozenset({"class", "wikidata_class", "iri", "wikidata_qcode", "qcode", "hierarchy"})
"""Taxonomies whose labels are classes; others hold the room, the state, and so on."""
CONCEPT_TAXONOMY = "concept"
"""Taxonomy whose labels are nouns for the concept of an object, whatever its class."""
_ISAAC = re.compile(r"semantic:(.+):params:semantic(?:Type|Data)")
_SCHEMAS = ("SemanticsLabelsAPI:", "SemanticsAPI:", TAG_SCHEMA)


PREDICTION_KEY = "usd2kg"
"""Key in a prim's `customData` of a dictionary with the `confidence` of a predicted `label`."""


class LabelProperty(NamedTuple):
    """The label that one property holds."""

    property_name: str
    encoding: Encoding
    taxonomy: str
    values: tuple[str, ...]
    """The values with white space and unprintable characters removed."""
    strength: Strength = "label"

    @property
    def states_class(self) -> bool:
        """Whether the label is a class; candidates that a tool proposed are not."""
        return self.strength == "label" and (self.encoding == "Multiverse" or self.taxonomy in CLASS_TAXONOMIES)


def usd_schema(taxonomy: str) -> str:
    """Return OpenUSD's schema of a taxonomy's labels."""
    return f"SemanticsLabelsAPI:{taxonomy}"


def isaac_schema(instance: str) -> str:
    """Return Isaac's schema of the label with the given instance name."""
    return f"SemanticsAPI:{instance}"


def isaac_property(instance: str, half: str) -> str:
    """Return the property name of one half of an Isaac label: `Type` for the taxonomy, `Data` for the value."""
    return f"semantic:{instance}:params:semantic{half}"


def isaac_instance(property_name: str) -> str | None:
    """Return the instance name of a property of an Isaac label; None for other properties."""
    found = _ISAAC.fullmatch(property_name)
    return found[1] if found else None


def schema_of(property_name: str) -> str | None:
    """Return the schema of a label property; None for other properties."""
    if property_name.startswith(USD_PREFIX):
        return usd_schema(property_name.removeprefix(USD_PREFIX))
    instance = isaac_instance(property_name)
    return isaac_schema(instance) if instance else TAG_SCHEMA if property_name in TAGS else None


def applied_schemas(prim: Any) -> list[str]:
    """Return the label schemas of all encodings that are applied to a prim."""
    # Not GetAppliedSchemas, which omits schemas unknown to OpenUSD: Isaac's and Multiverse's.
    return [schema for schema in prim.GetPrimTypeInfo().GetAppliedAPISchemas() if schema.startswith(_SCHEMAS)]


def semantic_names(prim: Any) -> list[str]:
    """Return the names of a prim's authored semantic properties, without those that a stronger layer blocks."""
    names = [name for name in prim.GetAuthoredPropertyNames() if name.startswith("semantic")]
    return [name for name in names if not _is_blocked(prim, name)]


def _is_blocked(prim: Any, name: str) -> bool:
    if relationship := prim.GetRelationship(name):
        # A stronger layer blocks a relationship with an empty list of targets.
        return not read_targets(prim, name) and bool(relationship.HasAuthoredTargets())
    attribute = prim.GetAttribute(name)
    return bool(attribute) and bool(attribute.GetResolveInfo().ValueIsBlocked())


def property_type(prim: Any, name: str) -> str:
    """Return the value type of an authored attribute, such as `token[]`; empty for a relationship."""
    # Not GetTypeName, which returns the type of an applied schema instead of the authored one.
    specs = prim.GetProperty(name).GetPropertyStack()
    return str(getattr(specs[0], "typeName", "")) if specs else ""


def find_labels(prim: Any, names: list[str], time: Any) -> list[LabelProperty]:
    """Return the labels in the properties `names` of a prim at `time`: OpenUSD's, then Isaac's, then Multiverse's."""
    found = []
    for name in names:
        if name.startswith(USD_PREFIX):
            found.append(
                LabelProperty(name, "UsdSemantics", name.removeprefix(USD_PREFIX), clean_values(prim, name, time))
            )
    for instance in dict.fromkeys(instance for name in names if (instance := isaac_instance(name))):
        taxonomy = next(iter(clean_values(prim, isaac_property(instance, "Type"), time)), "")
        data = isaac_property(instance, "Data")
        found.append(LabelProperty(data, "Isaac", taxonomy, clean_values(prim, data, time)))
    # Multiverse repeats its labels among the weaker reports; TAGS lists labels first.
    return found + [
        _read_tag(prim, name, target) for name in TAGS if name in names for target in tag_targets(prim, name)
    ]


def predicted_confidence(prim: Any, found: Iterable[LabelProperty]) -> float | None:
    """Return the confidence that `usd2kg label` stated for the labels of a prim; None if a person has changed them."""
    stated = prim.GetCustomDataByKey(PREDICTION_KEY)
    if not isinstance(stated, Mapping) or not isinstance(stated.get("confidence"), float):
        return None
    values = {value for label in found if label.states_class for value in label.values}
    return float(stated["confidence"]) if stated.get("label") in values else None


def clean_values(prim: Any, name: str, time: Any) -> tuple[str, ...]:
    """Return the texts of an attribute with white space and unprintable characters removed."""
    return tuple(map(clean_text, authored_texts(prim, name, time)))


def tag_targets(prim: Any, name: str) -> list[Any]:
    """Return the paths of the class prims that a Multiverse tag targets."""
    return [target.GetPrimPath() for target in read_targets(prim, name)]


def _read_tag(prim: Any, name: str, target: Any) -> LabelProperty:
    tagged = prim.GetStage().GetPrimAtPath(target)
    concepts, namespaces = (
        clean_values(tagged, rdf, None) if tagged else () for rdf in ("rdf:conceptName", "rdf:namespace")
    )
    taxonomy = next(filter(None, namespaces), target.GetParentPath().name)
    value = next(filter(None, concepts), target.name.removeprefix("_class_"))
    return LabelProperty(name, "Multiverse", taxonomy, (value,), TAGS[name])


def class_words(value: str) -> frozenset[str]:
    """Return the words of a class name: the local name of an IRI, the lemma of `drawer.n.wn.artifact` (WordNet)."""
    lemma = re.split(r"\.[nvasr]\.", re.split(r"[#/]", value)[-1])[0]
    return frozenset(words_of(lemma) or (lemma.lower(),))
