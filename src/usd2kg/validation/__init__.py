"""Checking a graph: shapes, clashes with the ontology, and what is hard to believe."""

from usd2kg.validation.axioms import Axioms
from usd2kg.validation.elk import ElkAnswer, ElkClash, ask_elk, elk_jars
from usd2kg.validation.finding import Finding, Severity, sort_findings
from usd2kg.validation.objects import GraphObject, read_objects
from usd2kg.validation.rules import Rule, Rules, read_rules
from usd2kg.validation.shapes import shapes_text
from usd2kg.validation.validate import ValidationReport, imports_of, ontology_of, validate_graph

__all__ = [
    "Axioms",
    "ElkAnswer",
    "ElkClash",
    "Finding",
    "GraphObject",
    "Rule",
    "Rules",
    "Severity",
    "ValidationReport",
    "ask_elk",
    "elk_jars",
    "imports_of",
    "ontology_of",
    "read_objects",
    "read_rules",
    "shapes_text",
    "sort_findings",
    "validate_graph",
]
