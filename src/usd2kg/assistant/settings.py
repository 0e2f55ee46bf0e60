"""Settings of assistants, read from `knowledge/settings/assistant.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "OPENING",
    "PLACING",
    "PROMPT",
    "RESULTS",
    "SENTENCES",
    "OpeningSettings",
    "PlacingSettings",
    "PromptSettings",
    "ResultSettings",
    "SentenceSettings",
]


class ResultSettings(NamedTuple):
    """Limits on the results of tools."""

    max_rows: int
    max_listed: int
    max_described: int


class SentenceSettings(NamedTuple):
    """Numbers of things that a sentence names."""

    max_named: int
    max_kinds: int


class PromptSettings(NamedTuple):
    """Limits on the parts of a prompt and on repairs; `max_question` to `max_example` are numbers of characters."""

    max_tokens: int
    max_terms: int
    max_repairs: int
    max_question: int
    max_query: int
    max_error: int
    max_example: int
    examples: tuple[str, ...]


class PlacingSettings(NamedTuple):
    """How free places are searched; lengths are metres."""

    step: float
    clearance: float
    height: float
    max_places: int
    level: float
    max_height: float
    max_flat_top: float


class OpeningSettings(NamedTuple):
    """Which space a door or window without a joint sweeps."""

    max_thickness: float
    margin: float
    max_handle: float


RESULTS = read_settings("assistant", "results", ResultSettings)
SENTENCES = read_settings("assistant", "sentences", SentenceSettings)
PROMPT = read_settings("assistant", "prompt", PromptSettings)
OPENING = read_settings("assistant", "opening", OpeningSettings)
PLACING = read_settings("assistant", "placing", PlacingSettings)
