"""CURIEs with well-known prefixes."""

import re
from collections.abc import Mapping

from usd2kg.ontology import namespaces

__all__ = ["PREFIXES", "PREFIX_NAME", "compact_iri", "expand_curie"]

PREFIX_NAME = re.compile(r"[A-Za-z][\w-]*", re.ASCII)
"""A prefix that every RDF syntax allows."""

PREFIXES = {
    "soma": namespaces.SOMA,
    "dul": namespaces.DUL,
    "usd": namespaces.USD,
    "knowrob": namespaces.KNOWROB,
    "owl": namespaces.OWL,
    "rdf": namespaces.RDF,
    "rdfs": namespaces.RDFS,
    "xsd": namespaces.XSD,
    "prov": namespaces.PROV,
    "sssom": namespaces.SSSOM,
    "skos": namespaces.SKOS,
    "obo": namespaces.OBO,
    "place": namespaces.PLACE,
}


def expand_curie(curie: str, declared: Mapping[str, str] | None = None) -> str:
    """Return the IRI of a CURIE, by the prefixes of this project or of a file; other text is returned unchanged.

    >>> expand_curie("soma:Cup")
    'http://www.ease-crc.org/ont/SOMA.owl#Cup'
    """
    prefix, colon, local = curie.partition(":")
    namespace = (PREFIXES.get(prefix.lower()) or (declared or {}).get(prefix)) if colon else None
    return namespace + local if namespace else curie


def compact_iri(iri: str) -> str:
    """Return the CURIE of an IRI in a known namespace, else the IRI itself.

    >>> compact_iri("http://www.ease-crc.org/ont/SOMA.owl#Cup")
    'soma:Cup'
    """
    for prefix, namespace in PREFIXES.items():
        if iri.startswith(namespace) and len(iri) > len(namespace):
            return f"{prefix}:{iri[len(namespace) :]}"
    return iri
