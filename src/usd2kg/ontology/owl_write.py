"""write_functional_syntax: RDF → OWL 2 functional syntax."""

from collections.abc import Mapping
from typing import Any

import pyhornedowl

from usd2kg.errors import OntologyError

__all__ = ["write_functional_syntax"]


def write_functional_syntax(n_triples: str, prefixes: Mapping[str, str], source: str) -> str:
    """Return an ontology in OWL 2 functional syntax, axiom annotations included, in a deterministic order.

    Args:
        n_triples: the ontology as N-Triples (OWL 2 Mapping to RDF Graphs).
        prefixes: name → namespace.
        source: name of the input, for messages.

    Raises:
        OntologyError: the triples are not an ontology.
    """
    # The type hints of py-horned-owl omit the RDF syntaxes.
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
