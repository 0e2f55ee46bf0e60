"""Namespace IRIs of the vocabularies in use. They are exact: http and https differ."""

__all__ = [
    "CONCEPT",
    "DCTERMS",
    "DUL",
    "KNOWROB",
    "OBO",
    "OWL",
    "PLACE",
    "PROV",
    "RDF",
    "RDFS",
    "SHACL",
    "SKOS",
    "SOMA",
    "SSSOM",
    "U2K",
    "USD",
    "WORDNET",
    "XSD",
]

RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
RDFS = "http://www.w3.org/2000/01/rdf-schema#"
OWL = "http://www.w3.org/2002/07/owl#"
XSD = "http://www.w3.org/2001/XMLSchema#"
SHACL = "http://www.w3.org/ns/shacl#"
SKOS = "http://www.w3.org/2004/02/skos/core#"
DCTERMS = "http://purl.org/dc/terms/"
PROV = "http://www.w3.org/ns/prov#"
OBO = "http://purl.obolibrary.org/obo/"
SSSOM = "https://w3id.org/sssom/"
SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"
DUL = "http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#"
USD = "https://ease-crc.org/ont/USD.owl#"
U2K = "https://w3id.org/usd2kg#"
"""The usd2kg vocabulary, defined in graph/vocabulary.ttl."""
PLACE = "https://w3id.org/usd2kg/places#"
"""Classes of the built-in TBox of places beyond homes."""
CONCEPT = "https://w3id.org/usd2kg/concept/"
"""Concepts that WordNet lacks, by noun: `13_amp_socket`."""
WORDNET = "http://wordnet-rdf.princeton.edu/id/"
"""Synsets of WordNet 3.1 by offset and part of speech: `03628765-n`."""
KNOWROB = "http://knowrob.org/kb/knowrob.owl#"
