"""`usd2kg.knowledge` reads the package data."""

import gzip
from dataclasses import dataclass

import pytest

from usd2kg.knowledge import (
    read_bytes,
    read_cells,
    read_compressed,
    read_rows,
    read_settings,
    read_text,
    word_map,
    word_set,
)


@dataclass(frozen=True)
class BootstrapSettings:
    resamples: int
    seed: int


def test_reads_a_file_as_text_bytes_and_rows():
    assert read_bytes("abbreviations.csv").decode() == read_text("abbreviations.csv")
    assert {"short": "btl", "word": "bottle"} in read_rows("abbreviations.csv")
    assert ("bottle", "btl") in read_cells("abbreviations.csv", "word", "short")


def test_rejects_an_unknown_column():
    with pytest.raises(ValueError, match="is not in list"):
        read_cells("abbreviations.csv", "word", "colour")


@pytest.mark.parametrize("name", ["bert_vocab", "english_words", "frequencies", "wordnet", "wordnet_labels"])
def test_decompresses_a_file(name: str):
    assert read_compressed(f"{name}.txt.gz") == gzip.decompress(read_bytes(f"{name}.txt.gz"))


def test_caches_word_sets():
    words = word_set("identifiers", "production_tokens")
    assert {"sm", "lod", "geo"} <= words
    assert word_set("identifiers", "production_tokens") is words


def test_reads_a_word_map():
    assert word_map("languages", "es_noun_replacements") == {"z": "ces"}


def test_rejects_an_unknown_word_list():
    with pytest.raises(KeyError, match="colours"):
        word_set("identifiers", "colours")


def test_rejects_a_word_list_as_a_map():
    with pytest.raises(TypeError, match=r"production_tokens in knowledge/words/identifiers.toml is a list"):
        word_map("identifiers", "production_tokens")


def test_reads_settings_as_a_dataclass():
    settings = read_settings("evaluation", "bootstrap", BootstrapSettings)
    assert settings == BootstrapSettings(resamples=2000, seed=20240229)


def test_reads_lists_in_settings_as_tuples(monkeypatch: pytest.MonkeyPatch):
    @dataclass
    class Limits:
        sizes: tuple[float, ...]

    monkeypatch.setattr("usd2kg.knowledge._read_settings_file", lambda _: {"limits": {"sizes": [0.5, 2.0]}})
    assert read_settings("shapes", "limits", Limits) == Limits((0.5, 2.0))


def test_rejects_an_unknown_settings_section():
    with pytest.raises(KeyError, match="colours"):
        read_settings("evaluation", "colours", BootstrapSettings)


def test_rejects_a_dataclass_with_other_keys_than_the_section():
    @dataclass
    class OtherSettings:
        resamples: int

    message = r"seed is only in \[bootstrap\] in knowledge/settings/evaluation.toml or only in OtherSettings"
    with pytest.raises(TypeError, match=message):
        read_settings("evaluation", "bootstrap", OtherSettings)
