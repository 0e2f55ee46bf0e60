"""Suggested subclasses for concepts that only have a coarse class in the scenes: 39 books grounded to Artifact."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import pyoxigraph as ox

from usd2kg.graph.vocabulary import DCTERMS, OWL, PREFIXES, RDF, RDFS, SKOS, XSD, Triple, named_node, text
from usd2kg.grounding import Concept, Grounding, Prediction, Status, concepts_named
from usd2kg.grounding.lexical.alignment.english_labels import in_english
from usd2kg.grounding.model import reviewer_iri
from usd2kg.ontology import ClassIRI, OntologyClass, TBox
from usd2kg.readiness.settings import SUGGESTION
from usd2kg.words import words_of

__all__ = ["Proposal", "SuggestedClass", "format_suggestions", "suggest_classes"]

_ANNOTATIONS = (SKOS.exactMatch, SKOS.example, SKOS.editorialNote, DCTERMS.creator, DCTERMS.created)


class Proposal(NamedTuple):
    """A person's proposal of a class."""

    reviewer: str
    """A name, or an IRI such as an ORCID iD."""
    time: str
    """ISO 8601."""
    comment: str


class _Found(NamedTuple):
    """The objects of one concept."""

    concept: Concept
    objects: list[str]
    parents: Counter[ClassIRI]


@dataclass(frozen=True)
class SuggestedClass:
    """A class that the ontology lacks."""

    label: str
    concept: Concept | None
    """The concept of the objects, if the label is that of the concept."""
    parent: ClassIRI
    """The lowest class that more than half of the objects have; those with a doubtful class count for its root."""
    objects: tuple[str, ...]
    """Prim paths, in scene order; those of several scenes follow each other."""
    proposals: tuple[Proposal, ...] = ()
    """The person who proposed the class; empty if it follows from the concepts."""


def suggest_classes(groundings: Iterable[Grounding], tbox: TBox) -> list[SuggestedClass]:
    """Return the concepts of objects without a class of that name in the ontology, most frequent first.

    Args:
        groundings: of one or several scenes.
        tbox: the ontology of the groundings.
    """
    # Other names of a class may be kinds of it: in the home TBox, “book” is one of artifacts.
    english = in_english(tbox).by_iri
    named = {iri for cls in english.values() for name in (cls.label, cls.local_name) for iri in concepts_named(name)}
    found: dict[str, _Found] = {}
    for grounding in groundings:
        for prediction in grounding.predictions:
            if (concept := _certain_concept(prediction, grounding)) is None or concept.iri in named:
                continue
            assert prediction.class_iri is not None, "only objects with a class have a certain concept"
            if concept.iri in _concepts_of_head(english[prediction.class_iri]):
                continue
            one = found.setdefault(concept.iri, _Found(concept, [], Counter()))
            one.objects.append(prediction.prim_path)
            one.parents[_certain_class(prediction, tbox)] += 1
    suggested = (
        SuggestedClass(one.concept.label, one.concept, _common_parent(one.parents, tbox), tuple(one.objects))
        for one in found.values()
    )
    return sorted(suggested, key=lambda one: (-len(one.objects), one.label, one.parent))


def _common_parent(parents: Counter[ClassIRI], tbox: TBox) -> ClassIRI:
    """Return the lowest class that more than half of the objects have; the most frequent one if there is none."""
    above = Counter[ClassIRI]()
    for iri, count in parents.items():
        above.update(dict.fromkeys(tbox.closure(iri), count))
    shared = [iri for iri, count in above.items() if 2 * count > parents.total()]
    return max(shared or parents, key=lambda iri: (tbox.depths[iri] if shared else 0, above[iri], iri))


def _certain_class(prediction: Prediction, tbox: TBox) -> ClassIRI:
    """Return the class of an object; the root above it if the class is doubtful."""
    iri = prediction.class_iri
    assert iri is not None, "only objects with a class have a certain concept"
    if prediction.status is Status.REVIEWED or (prediction.confidence or 0.0) >= SUGGESTION.min_class_confidence:
        return iri
    return min((root for root in tbox.roots if root in tbox.closure(iri)), default=iri)


def _concepts_of_head(cls: OntologyClass) -> tuple[str, ...]:
    """Return the concepts of the last word of a label: `DesignedChair` are chairs."""
    words = words_of(cls.label)
    return concepts_named(words[-1]) if words else ()


def _certain_concept(prediction: Prediction, grounding: Grounding) -> Concept | None:
    if prediction.class_iri is None or (prediction.concept_confidence or 0.0) < SUGGESTION.min_confidence:
        return None
    return grounding.concepts.get(prediction.concept or "")


def format_suggestions(suggested: Sequence[SuggestedClass], tbox: TBox) -> str:
    """Return suggested classes as an OWL ontology in Turtle that imports the ontology that they extend."""
    base = f"{tbox.ontology_iri.rstrip('#/')}/suggested"
    triples = [ox.Triple(*triple) for triple in dict.fromkeys(_triples(suggested, tbox, base))]
    found = ox.serialize(triples, format=ox.RdfFormat.TURTLE, prefixes={**PREFIXES, "": f"{base}#"})
    assert found is not None, "text is returned if no output is given"
    return found.decode()


def _triples(suggested: Sequence[SuggestedClass], tbox: TBox, base: str) -> Iterator[Triple]:
    ontology = ox.NamedNode(base)
    yield ontology, RDF.type, OWL.Ontology
    if not tbox.ontology_iri.startswith("file:"):
        yield ontology, OWL.imports, ox.NamedNode(tbox.ontology_iri)
    for annotation in _ANNOTATIONS:
        yield annotation, RDF.type, OWL.AnnotationProperty
    parents: dict[str, list[ClassIRI]] = {}
    for one in suggested:
        # Two people may mean different things by one name: a unit of furniture and one of lights.
        above = parents.setdefault(_class_name(one.label), [])
        above += [] if one.parent in above else [one.parent]
        number = above.index(one.parent) + 1
        node = ox.NamedNode(f"{base}#{_class_name(one.label)}{f'_{number}' if number > 1 else ''}")
        yield node, RDF.type, OWL.Class
        yield node, RDFS.label, text(one.label)
        yield node, RDFS.subClassOf, ox.NamedNode(one.parent)
        if one.concept is not None:
            yield node, SKOS.exactMatch, ox.NamedNode(one.concept.iri)
        if one.proposals:
            yield from _triples_of_proposals(one, node)
            continue
        count = f"{len(one.objects)} objects" if len(one.objects) > 1 else "1 object"
        yield node, SKOS.editorialNote, text(f"suggested by usd2kg for {count}")
        for path in one.objects[: SUGGESTION.max_examples]:
            yield node, SKOS.example, text(path)


def _triples_of_proposals(one: SuggestedClass, node: ox.NamedNode) -> Iterator[Triple]:
    """Yield who proposed a class, when and why, and for which objects."""
    for path in one.objects:
        yield node, SKOS.example, text(path)
    for proposal in one.proposals:
        yield node, DCTERMS.creator, named_node(reviewer_iri(proposal.reviewer)) or text(proposal.reviewer)
        yield node, DCTERMS.created, ox.Literal(proposal.time, datatype=XSD.dateTime)
        if proposal.comment:
            yield node, SKOS.editorialNote, text(proposal.comment)


def _class_name(label: str) -> str:
    """Return a label in camel case, as the local name of an IRI.

    >>> _class_name("13 amp socket")
    '_13AmpSocket'
    """
    name = "".join(word[:1].upper() + word[1:] for word in re.findall(r"\w+", label))
    return f"_{name}" if name[:1].isdigit() else name
