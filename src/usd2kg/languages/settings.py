"""Settings of the translation of names, one class per section of `knowledge/settings/languages.toml`."""

from dataclasses import dataclass

from usd2kg.knowledge import read_settings

__all__ = [
    "COMPOUNDS",
    "PHRASES",
    "SPELLING",
    "CompoundSettings",
    "PhraseSettings",
    "VariantSettings",
]


@dataclass(frozen=True, slots=True)
class VariantSettings:
    """Costs of inflected and respelled words."""

    inflection_cost: int
    umlaut_cost: int
    elision_cost: int
    lost_umlaut_cost: int
    min_lost_umlaut: int


@dataclass(frozen=True, slots=True)
class CompoundSettings:
    """Splitting of German compounds."""

    max_letters: int
    min_part: int
    min_revealing_part: int
    part_cost: int


@dataclass(frozen=True, slots=True)
class PhraseSettings:
    """Limits of listed phrases."""

    max_words: int


SPELLING = read_settings("languages", "spelling", VariantSettings)
COMPOUNDS = read_settings("languages", "compounds", CompoundSettings)
PHRASES = read_settings("languages", "phrases", PhraseSettings)
