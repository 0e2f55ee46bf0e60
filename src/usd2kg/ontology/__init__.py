"""OWL files → TBox: the classes in scope with labels, comments and hierarchy."""

from typing import TYPE_CHECKING

from usd2kg.lazy_names import lazy_names

if TYPE_CHECKING:
    from usd2kg.ontology.built_in import PLACES_IRI, SOMA_HOME, built_in_document
    from usd2kg.ontology.class_axioms import LABELS
    from usd2kg.ontology.closure import Closure, read_closure, without_header
    from usd2kg.ontology.fetch import fetch_ontology
    from usd2kg.ontology.known_ontologies import KnownOntology, read_registry
    from usd2kg.ontology.linearize import linearize_flat, linearize_tree
    from usd2kg.ontology.load import BUILT_IN_NAMES, load_home_tbox, load_places_tbox, load_tbox
    from usd2kg.ontology.model import ClassIRI, OntologyClass, OntologyNote, TBox, local_name
    from usd2kg.ontology.owl_write import write_functional_syntax
    from usd2kg.ontology.prefixes import PREFIX_NAME, compact_iri, expand_curie

__all__ = [
    "BUILT_IN_NAMES",
    "LABELS",
    "PLACES_IRI",
    "PREFIX_NAME",
    "SOMA_HOME",
    "ClassIRI",
    "Closure",
    "KnownOntology",
    "OntologyClass",
    "OntologyNote",
    "TBox",
    "built_in_document",
    "compact_iri",
    "expand_curie",
    "fetch_ontology",
    "linearize_flat",
    "linearize_tree",
    "load_home_tbox",
    "load_places_tbox",
    "load_tbox",
    "local_name",
    "read_closure",
    "read_registry",
    "without_header",
    "write_functional_syntax",
]

__getattr__ = lazy_names(
    __name__,
    {
        "BUILT_IN_NAMES": "load",
        "LABELS": "class_axioms",
        "PLACES_IRI": "built_in",
        "PREFIX_NAME": "prefixes",
        "SOMA_HOME": "built_in",
        "ClassIRI": "model",
        "Closure": "closure",
        "KnownOntology": "known_ontologies",
        "OntologyClass": "model",
        "OntologyNote": "model",
        "TBox": "model",
        "built_in_document": "built_in",
        "compact_iri": "prefixes",
        "expand_curie": "prefixes",
        "fetch_ontology": "fetch",
        "linearize_flat": "linearize",
        "linearize_tree": "linearize",
        "load_home_tbox": "load",
        "load_places_tbox": "load",
        "load_tbox": "load",
        "local_name": "model",
        "read_closure": "closure",
        "read_registry": "known_ontologies",
        "without_header": "closure",
        "write_functional_syntax": "owl_write",
    },
)
