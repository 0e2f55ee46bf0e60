"""The three encodings of semantic labels: the names of their properties and schemas, and what these say on a prim.

- OpenUSD's own: `token[] semantics:labels:<taxonomy>`, schema `SemanticsLabelsAPI:<taxonomy>` (UsdSemantics).
- Isaac and Replicator: `semantic:<instance>:params:semanticType` and `semanticData`, schema `SemanticsAPI:<instance>`.
- Multiverse: `rel semanticTag:semanticLabels` and `semanticReports`, to class prims with `rdf:conceptName`.
"""

import re
from typing import Any, NamedTuple

from usd2kg.scene.metadata import clean_text, texts_of
from usd2kg.scene.model import Encoding, Strength
from usd2kg.scene.stage import read_targets
from usd2kg.words import words_of

__all__ = [
    "CLASS_TAXONOMIES",
    "LONGEST",
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
    "property_type",
    "schema_of",
    "semantic_names",
    "tag_targets",
    "usd_schema",
]

LONGEST = 200
"""Letters that a label may have."""
USD_PREFIX = "semantics:labels:"
USD_LABEL_TYPE = "token[]"
"""The one type that OpenUSD reads its labels from."""
TAG_LABELS = "semanticTag:semanticLabels"
TAG_SCHEMA = "SemanticTagAPI"
TAGS: dict[str, Strength] = {TAG_LABELS: "label", "semanticTag:semanticReports": "report"}
QCODE = re.compile("Q[0-9]+")
CLASS_TAXONOMIES = frozenset({"class", "wikidata_class", "iri", "wikidata_qcode", "qcode", "hierarchy"})
"""Taxonomies whose labels say what kind of thing a prim is; others tell its room, its state…"""
_ISAAC = re.compile(r"semantic:(.+):params:semantic(?:Type|Data)")
_SCHEMAS = ("SemanticsLabelsAPI:", "SemanticsAPI:", TAG_SCHEMA)


class LabelProperty(NamedTuple):
    """What one property says, its texts cleaned up."""

    property_name: str
    encoding: Encoding
    taxonomy: str
    values: tuple[str, ...]
    strength: Strength = "label"

    @property
    def states_class(self) -> bool:
        """Whether it says what kind of thing the prim is; candidates that a tool brought up do not."""
        return self.strength == "label" and (self.encoding == "Multiverse" or self.taxonomy in CLASS_TAXONOMIES)


def usd_schema(taxonomy: str) -> str:
    """Return the schema that makes a taxonomy's labels known to OpenUSD."""
    return f"SemanticsLabelsAPI:{taxonomy}"


def isaac_schema(instance: str) -> str:
    """Return Isaac's schema for one of a prim's labels."""
    return f"SemanticsAPI:{instance}"


def isaac_property(instance: str, half: str) -> str:
    """Return the name of one half of an Isaac label: `Type`, its taxonomy, or `Data`, the label."""
    return f"semantic:{instance}:params:semantic{half}"


def isaac_instance(property_name: str) -> str | None:
    """Return the instance that a property of an Isaac label belongs to; None if it is none."""
    found = _ISAAC.fullmatch(property_name)
    return found[1] if found else None


def schema_of(property_name: str) -> str | None:
    """Return the schema that a property belongs to; None if it is no label."""
    if property_name.startswith(USD_PREFIX):
        return usd_schema(property_name.removeprefix(USD_PREFIX))
    instance = isaac_instance(property_name)
    return isaac_schema(instance) if instance else TAG_SCHEMA if property_name in TAGS else None


def applied_schemas(prim: Any) -> list[str]:
    """Return the schemas of labels that are applied to a prim, of all encodings."""
    # Not GetAppliedSchemas: it leaves out the schemas that OpenUSD does not know, Isaac's and Multiverse's.
    return [schema for schema in prim.GetPrimTypeInfo().GetAppliedAPISchemas() if schema.startswith(_SCHEMAS)]


def semantic_names(prim: Any) -> list[str]:
    """Return the names of a prim's authored properties about semantics, those left out that a layer above blocks."""
    names = [name for name in prim.GetAuthoredPropertyNames() if name.startswith("semantic")]
    return [name for name in names if not _is_blocked(prim, name)]


def _is_blocked(prim: Any, name: str) -> bool:
    if relationship := prim.GetRelationship(name):
        # What holds no targets says nothing; a layer above blocks a relationship by an empty list.
        return not read_targets(prim, name) and bool(relationship.HasAuthoredTargets())
    attribute = prim.GetAttribute(name)
    return bool(attribute) and bool(attribute.GetResolveInfo().ValueIsBlocked())


def property_type(prim: Any, name: str) -> str:
    """Return the value type of an authored attribute, such as `token[]`; empty for a relationship."""
    # Not GetTypeName: where a schema is applied, that is the schema's type, whatever was authored.
    specs = prim.GetProperty(name).GetPropertyStack()
    return str(getattr(specs[0], "typeName", "")) if specs else ""


def find_labels(prim: Any, names: list[str], time: Any) -> list[LabelProperty]:
    """Return what the properties `names` of a prim say at `time`: OpenUSD's, then Isaac's, then Multiverse's."""
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
    # Multiverse repeats its labels among the reports: the stronger ones come first.
    return found + [_tag(prim, name, target) for name in TAGS if name in names for target in tag_targets(prim, name)]


def clean_values(prim: Any, name: str, time: Any) -> tuple[str, ...]:
    """Return the texts of an attribute, white space and unprintable characters cleaned up."""
    return tuple(map(clean_text, texts_of(prim, name, time)))


def tag_targets(prim: Any, name: str) -> list[Any]:
    """Return the paths of the class prims that a Multiverse tag points to."""
    return [target.GetPrimPath() for target in read_targets(prim, name)]


def _tag(prim: Any, name: str, target: Any) -> LabelProperty:
    tagged = prim.GetStage().GetPrimAtPath(target)
    concepts, namespaces = (
        clean_values(tagged, rdf, None) if tagged else () for rdf in ("rdf:conceptName", "rdf:namespace")
    )
    taxonomy = next(filter(None, namespaces), target.GetParentPath().name)
    value = next(filter(None, concepts), target.name.removeprefix("_class_"))
    return LabelProperty(name, "Multiverse", taxonomy, (value,), TAGS[name])


def class_words(value: str) -> frozenset[str]:
    """Return the words of a class name: of an IRI its local name, of `drawer.n.wn.artifact` (WordNet) the lemma."""
    lemma = re.split(r"\.[nvasr]\.", re.split(r"[#/]", value)[-1])[0]
    return frozenset(words_of(lemma) or (lemma.lower(),))
