"""Settings of the reading of abbreviations, one record per section of `knowledge/settings/lexical.toml`.

The TOML file documents each value beside it: unit, meaning and origin.
"""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = ["CHANNEL", "SHORTENING", "ChannelSettings", "ShorteningSettings"]


class ChannelSettings(NamedTuple):
    """Noisy channel of abbreviations."""

    bigram_share: float
    tbox_share: float
    stage_share: float
    parent_share: float
    adjective_factor: float
    min_log_prior: float
    common_abbreviation: float
    stray_letter: float
    unknown_word: float
    unknown_letter: float
    max_unknown_letters: int
    pipeline_prefix: float
    bigram_trust: float
    compound_factor: float
    max_bigram_factor: float
    max_choices: int
    max_piece_letters: int
    next_word: float
    beam_width: int
    max_log_loss: float
    max_pieces: int
    consistent_share: float
    max_gap_letters: int
    gap_letter: float
    common_form: float


class ShorteningSettings(NamedTuple):
    """Ways of shortening words."""

    full_share: float
    skeleton_share: float
    skeleton_with_first_vowel_share: float
    truncated_share: float
    length_shares: tuple[float, ...]
    max_letters: int
    max_letters_with_vowels: int


CHANNEL = read_settings("lexical", "channel", ChannelSettings)
SHORTENING = read_settings("lexical", "shortening", ShorteningSettings)
