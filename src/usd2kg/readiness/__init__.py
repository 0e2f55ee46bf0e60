"""How well an ontology will ground, and what to add to it."""

from usd2kg.readiness.check import OntologyReport, check_ontology

__all__ = [
    "OntologyReport",
    "check_ontology",
]
