"""Authored metadata of objects: names, assets, materials, labels and texts; the same in all profiles."""

import re
from collections.abc import Iterator, Sequence

import pyoxigraph as ox

from usd2kg.graph.axiom_annotation import Annotate
from usd2kg.graph.vocabulary import DCTERMS, RDFS, SKOS, U2K, Triple, named_node, text
from usd2kg.scene import Label, SceneObject

__all__ = ["describe_labels_and_texts", "describe_metadata"]

_WIKIDATA_ITEM = re.compile("Q[0-9]+")
_WIKIDATA = "http://www.wikidata.org/entity/"


def describe_metadata(obj: SceneObject, node: ox.NamedNode) -> Iterator[Triple]:
    """Yield names, prim path, documentation, assets, materials and variants of an object."""
    yield node, RDFS.label, text(obj.display_name or obj.name)
    if obj.display_name and obj.display_name != obj.name:
        yield node, SKOS.altLabel, text(obj.name)
    yield node, U2K.primPath, text(obj.prim_path)
    if obj.documentation:
        yield node, RDFS.comment, text(obj.documentation)
    if obj.source_id:
        yield node, DCTERMS.identifier, text(obj.source_id)
    for name in obj.asset:
        yield node, U2K.asset, text(name)
    for name in obj.materials:
        yield node, U2K.material, text(name)
    for name, variant in obj.variants:
        yield node, U2K.variant, text(f"{name}={variant}")


def describe_labels_and_texts(obj: SceneObject, node: ox.NamedNode, annotate: Annotate) -> Iterator[Triple]:
    """Yield semantic labels and texts, annotated with their source; labels reported by a tool are omitted."""
    for label in (*obj.labels.own, *obj.labels.inherited):
        yield from _label(node, U2K.sceneLabel, label, obj.prim_path, annotate)
    for label in obj.labels.of_parts:
        yield from _label(node, U2K.partLabel, label, obj.prim_path, annotate)
    for name, value in obj.texts:
        statement = (node, U2K.text, text(value))
        yield statement
        yield from annotate(statement, [(U2K.property, text(name))])


def _label(
    node: ox.NamedNode, name: ox.NamedNode, label: Label, prim_path: str, annotate: Annotate
) -> Sequence[Triple]:
    if label.strength == "report":
        return ()
    statement: Triple = (node, name, text(label.value))
    source = [(U2K.labelledPrim, text(label.prim_path))] if label.prim_path != prim_path else []
    encoding = [(U2K.labelEncoding, text(label.encoding)), (U2K.labelTaxonomy, text(label.taxonomy))]
    iri = _label_iri(label) if name == U2K.sceneLabel else None
    entity: list[Triple] = [(node, U2K.sceneLabelIri, iri)] if iri is not None else []
    return [statement, *entity, *annotate(statement, [*encoding, *source])]


def _label_iri(label: Label) -> ox.NamedNode | None:
    if label.taxonomy.endswith("qcode") and _WIKIDATA_ITEM.fullmatch(label.value):
        return ox.NamedNode(_WIKIDATA + label.value)
    return named_node(label.iri) if label.iri is not None else None
