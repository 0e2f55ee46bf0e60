"""Grounding: scene × TBox → a class for each object, with a confidence, the evidence and an explanation."""

from usd2kg.grounding.base import Grounder
from usd2kg.grounding.cascade import CascadeGrounder
from usd2kg.grounding.concepts import apply_decisions, concepts_named, hypernyms_of, is_english_word
from usd2kg.grounding.context import (
    ABBREVIATED_LENGTH,
    EVIDENCE_GROUPS,
    STUDY_GROUPS,
    NamingRegime,
    ObjectView,
    view_objects,
)
from usd2kg.grounding.decisions import (
    NO_CLASS,
    DecisionOrigin,
    as_decision,
    find_uncertain,
    format_queue,
    read_decisions,
)
from usd2kg.grounding.ground import ground as ground
from usd2kg.grounding.ground import parse_evidence, parse_regime
from usd2kg.grounding.mapping_files import MAPPING_FORMATS, check_format, format_mapping, read_grounding, read_paths
from usd2kg.grounding.model import PERSON, Candidate, Concept, Decision, Grounding, Prediction, Review, Status
from usd2kg.grounding.platt_scaling import PlattScaling, read_scaling
from usd2kg.grounding.registry import GROUNDERS, is_llm_name, make_grounder

__all__ = [
    "ABBREVIATED_LENGTH",
    "EVIDENCE_GROUPS",
    "GROUNDERS",
    "MAPPING_FORMATS",
    "NO_CLASS",
    "PERSON",
    "STUDY_GROUPS",
    "Candidate",
    "CascadeGrounder",
    "Concept",
    "Decision",
    "DecisionOrigin",
    "Grounder",
    "Grounding",
    "NamingRegime",
    "ObjectView",
    "PlattScaling",
    "Prediction",
    "Review",
    "Status",
    "apply_decisions",
    "as_decision",
    "check_format",
    "concepts_named",
    "find_uncertain",
    "format_mapping",
    "format_queue",
    "ground",
    "hypernyms_of",
    "is_english_word",
    "is_llm_name",
    "make_grounder",
    "parse_evidence",
    "parse_regime",
    "read_decisions",
    "read_grounding",
    "read_paths",
    "read_scaling",
    "view_objects",
]
