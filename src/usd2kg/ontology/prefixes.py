"""Well-known prefixes. IRIs are exact: http and https differ."""

__all__ = ["PREFIXES", "compact_iri", "expand_curie"]

PREFIXES = {
    "soma": "http://www.ease-crc.org/ont/SOMA.owl#",
    "dul": "http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#",
    "usd": "https://ease-crc.org/ont/USD.owl#",
    "knowrob": "http://knowrob.org/kb/knowrob.owl#",
    "owl": "http://www.w3.org/2002/07/owl#",
    "rdf": "http://www.w3.org/1999/02/22-rdf-syntax-ns#",
    "rdfs": "http://www.w3.org/2000/01/rdf-schema#",
    "xsd": "http://www.w3.org/2001/XMLSchema#",
    "prov": "http://www.w3.org/ns/prov#",
    "sssom": "https://w3id.org/sssom/",
    "skos": "http://www.w3.org/2004/02/skos/core#",
    "obo": "http://purl.obolibrary.org/obo/",
}


def expand_curie(curie: str) -> str:
    """Return the IRI of a CURIE; text without a known prefix is returned unchanged.

    >>> expand_curie("soma:Cup")
    'http://www.ease-crc.org/ont/SOMA.owl#Cup'
    """
    prefix, colon, local = curie.partition(":")
    namespace = PREFIXES.get(prefix.lower()) if colon else None
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
