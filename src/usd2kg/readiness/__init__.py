"""Readiness of an ontology for grounding: what it lacks, and what to add."""

from usd2kg.readiness.check import OntologyReport, check_ontology

__all__ = [
    "OntologyReport",
    "check_ontology",
]
