"""Readiness of an ontology for grounding: its deficiencies, and classes to add."""

from usd2kg.readiness.check import OntologyReport, check_ontology
from usd2kg.readiness.suggested_classes import Proposal, SuggestedClass, format_suggestions, suggest_classes

__all__ = [
    "OntologyReport",
    "Proposal",
    "SuggestedClass",
    "check_ontology",
    "format_suggestions",
    "suggest_classes",
]
