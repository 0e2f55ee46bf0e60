"""From a Scene and a TBox to a Grounding: a class for every object, how sure, and why."""

from usd2kg.grounding.base import Grounder, ground, parse_evidence, parse_regime
from usd2kg.grounding.cascade import CascadeGrounder
from usd2kg.grounding.decisions import PERSON, Carried, format_queue, read_decisions, unsure_of
from usd2kg.grounding.files import MAPPING_FORMATS, check_format, format_mapping, read_grounding, read_paths
from usd2kg.grounding.model import Candidate, Grounding, Prediction, Review, Status
from usd2kg.grounding.registry import GROUNDERS, is_llm_name, make_grounder
from usd2kg.grounding.scaling import PlattScaling, read_scaling

__all__ = [
    "GROUNDERS",
    "MAPPING_FORMATS",
    "PERSON",
    "Candidate",
    "Carried",
    "CascadeGrounder",
    "Grounder",
    "Grounding",
    "PlattScaling",
    "Prediction",
    "Review",
    "Status",
    "check_format",
    "format_mapping",
    "format_queue",
    "ground",
    "is_llm_name",
    "make_grounder",
    "parse_evidence",
    "parse_regime",
    "read_decisions",
    "read_grounding",
    "read_paths",
    "read_scaling",
    "unsure_of",
]
