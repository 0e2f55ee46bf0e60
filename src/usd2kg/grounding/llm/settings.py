"""Settings of the language-model grounder, from `knowledge/settings/llm.toml`."""

from decimal import Decimal
from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "BATCH",
    "COMMANDS",
    "CONCEPTS",
    "DECODING",
    "DEGENERATION",
    "ESTIMATES",
    "MEMBERS",
    "SAMPLING",
    "BatchSettings",
    "CommandSettings",
    "ConceptQuestionSettings",
    "DecodingSettings",
    "DegenerationSettings",
    "EstimateSettings",
    "MemberSettings",
    "SamplingSettings",
]


class DegenerationSettings(NamedTuple):
    """Criteria for a degenerate completion."""

    window_characters: int
    check_interval_characters: int
    check_interval_tokens: int
    min_loop_characters: int
    min_repetitions: int
    period_scales: tuple[int, ...]
    max_distinct_fragments: int
    min_growing_run: int


class DecodingSettings(NamedTuple):
    """Constrained decoding of a model in this process."""

    max_text_tokens: int
    max_unread_probability: float
    max_predictions: int


class SamplingSettings(NamedTuple):
    """Sampling of several completions of a prompt."""

    temperature: float


class BatchSettings(NamedTuple):
    """Batch jobs."""

    price_percent: int

    @property
    def price_share(self) -> Decimal:
        """The price of a token as a share of its price in single requests."""
        return Decimal(self.price_percent) / 100


class EstimateSettings(NamedTuple):
    """Estimates of token counts, for use before a server has counted them."""

    bytes_per_token: int
    pixels_per_token: int
    reasoning_tokens: int
    noun_tokens: int


class MemberSettings(NamedTuple):
    """Questions about the things that belong to each class."""

    classes_per_prompt: int
    nouns_per_class: int
    max_noun_characters: int


class ConceptQuestionSettings(NamedTuple):
    """Questions about groups of objects that share a concept."""

    concepts_per_prompt: int
    max_readings: int
    max_broader: int
    max_siblings: int
    max_parents: int
    max_assets: int
    max_candidates: int


class CommandSettings(NamedTuple):
    """Texts that may command the model."""

    max_words: int


DEGENERATION = read_settings("llm", "degeneration", DegenerationSettings)
DECODING = read_settings("llm", "decoding", DecodingSettings)
BATCH = read_settings("llm", "batch", BatchSettings)
SAMPLING = read_settings("llm", "sampling", SamplingSettings)
ESTIMATES = read_settings("llm", "estimates", EstimateSettings)
MEMBERS = read_settings("llm", "members", MemberSettings)
CONCEPTS = read_settings("llm", "concepts", ConceptQuestionSettings)
COMMANDS = read_settings("llm", "commands", CommandSettings)
