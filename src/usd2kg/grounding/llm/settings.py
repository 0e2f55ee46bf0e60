"""Settings of the language-model grounder, from `knowledge/settings/llm.toml`."""

from dataclasses import dataclass
from decimal import Decimal

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


@dataclass(frozen=True, slots=True)
class DegenerationSettings:
    """Criteria for a degenerate completion."""

    window_characters: int
    check_interval_characters: int
    check_interval_tokens: int
    min_loop_characters: int
    min_repetitions: int
    period_scales: tuple[int, ...]
    max_distinct_fragments: int
    min_growing_run: int


@dataclass(frozen=True, slots=True)
class DecodingSettings:
    """Constrained decoding of a model in this process."""

    max_text_tokens: int
    max_unread_probability: float
    max_predictions: int


@dataclass(frozen=True, slots=True)
class SamplingSettings:
    """Sampling of several completions of a prompt."""

    temperature: float


@dataclass(frozen=True, slots=True)
class BatchSettings:
    """Batch jobs."""

    price_percent: int

    @property
    def price_share(self) -> Decimal:
        """The price of a token as a share of its price in single requests."""
        return Decimal(self.price_percent) / 100


@dataclass(frozen=True, slots=True)
class EstimateSettings:
    """Estimates of token counts, for use before a server has counted them."""

    bytes_per_token: int
    pixels_per_token: int
    reasoning_tokens: int
    noun_tokens: int


@dataclass(frozen=True, slots=True)
class MemberSettings:
    """Questions about the things that belong to each class."""

    classes_per_prompt: int
    nouns_per_class: int
    max_noun_characters: int


@dataclass(frozen=True, slots=True)
class ConceptQuestionSettings:
    """Questions about groups of objects that share a concept."""

    concepts_per_prompt: int
    max_readings: int
    max_broader: int
    max_siblings: int
    max_parents: int
    max_assets: int
    max_candidates: int


@dataclass(frozen=True, slots=True)
class CommandSettings:
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
