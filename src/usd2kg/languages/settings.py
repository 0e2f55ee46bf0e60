"""Settings of the translation of names, one class per section of `knowledge/settings/languages.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "COMPOUNDS",
    "PHRASES",
    "SPELLING",
    "CompoundSettings",
    "PhraseSettings",
    "VariantSettings",
]


class VariantSettings(NamedTuple):
    """Costs of inflected and respelled words."""

    inflection_cost: int
    umlaut_cost: int
    elision_cost: int
    lost_umlaut_cost: int
    min_lost_umlaut: int


class CompoundSettings(NamedTuple):
    """Splitting of German compounds."""

    max_letters: int
    min_part: int
    min_head: int
    min_revealing_part: int
    part_cost: int


class PhraseSettings(NamedTuple):
    """Limits of listed phrases."""

    max_words: int


SPELLING = read_settings("languages", "spelling", VariantSettings)
COMPOUNDS = read_settings("languages", "compounds", CompoundSettings)
PHRASES = read_settings("languages", "phrases", PhraseSettings)
