"""Validation of a graph: SHACL shapes, contradictions with its ontology, and implausible objects."""

from usd2kg.validation.axiom_index import AxiomIndex
from usd2kg.validation.elk import ElkAnswer, ElkClash, ask_elk, elk_jars
from usd2kg.validation.finding import Finding, Severity, sort_findings
from usd2kg.validation.graph_objects import GraphObject, read_graph_objects
from usd2kg.validation.plausibility_rules import Rule, Rules, read_rules
from usd2kg.validation.shacl import read_shapes
from usd2kg.validation.validate import ValidationReport, imports_of, ontology_of, validate_graph

__all__ = [
    "AxiomIndex",
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
    "read_graph_objects",
    "read_rules",
    "read_shapes",
    "sort_findings",
    "validate_graph",
]
