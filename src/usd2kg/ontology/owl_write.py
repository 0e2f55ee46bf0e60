"""OWL 2 functional syntax, written from RDF."""

from collections.abc import Mapping
from typing import Any

import pyhornedowl

from usd2kg.errors import OntologyError

__all__ = ["write_functional_syntax"]


def write_functional_syntax(n_triples: str, prefixes: Mapping[str, str], source: str) -> str:
    """Return an ontology in OWL 2 functional syntax; annotations of axioms stay with their axioms.

    Axioms stand in an order that depends on the ontology alone.

    Args:
        n_triples: the ontology as N-Triples (OWL 2 Mapping to RDF Graphs).
        prefixes: name → namespace, for namespaces whose terms have plain names.
        source: where the ontology comes from, for messages.

    Raises:
        OntologyError: the triples are no ontology.
    """
    # Its type hints leave out the RDF syntaxes that it reads.
    turtle: Any = "ttl"
    try:
        ontology = pyhornedowl.open_ontology_from_string(n_triples, turtle)
    except ValueError as error:
        raise OntologyError(
            f"{source}: cannot be read as OWL ({error}); expected a graph that declares its terms"
        ) from error
    for name, namespace in sorted(prefixes.items()):
        ontology.add_prefix_mapping(name, namespace)
    text: str = ontology.save_to_string("ofn")
    return text
