"""Build the data file of foreign words from `knowledge/glosses.csv`, and list the inflected forms that are English."""

from itertools import chain

from tools.data_files import csv_bytes, read_source_rows
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.reading.english_words import is_english_word
from usd2kg.languages.inflection import Entry, compound_forms, fold, word_forms

__all__ = ["build_glosses"]

_COLUMNS = ("language", "word", "english", "homograph", "role")
_NO_INFLECTION = frozenset({"link", "with"})


def build_glosses() -> bytes:
    """Return the CSV file: the source, and a row without a gloss for each inflected form that is an English word.

    German `burger` is a form of `burg`, and Italian `canoe` of `canoa`: alone, they are English.
    """
    rows = [tuple(row[column] for column in _COLUMNS) for row in read_source_rows("glosses.csv")]
    entries = [
        Entry(lang, word, tuple(english.split()), mark == "yes", role) for lang, word, english, mark, role in rows
    ]
    known = {(entry.language, fold(entry.word, entry.language)) for entry in entries}
    found: set[tuple[str, str]] = set()
    for entry in entries:
        if " " in entry.word or entry.role in _NO_INFLECTION:
            continue
        for text, form in chain(word_forms(entry), compound_forms(entry) if entry.language == "de" else ()):
            if form.reveals_language and (entry.language, text) not in known and _is_english(text):
                found.add((entry.language, text))
    return csv_bytes(_COLUMNS, [*rows, *((language, text, "", "yes", "") for language, text in sorted(found))])


def _is_english(text: str) -> bool:
    taxonomy = load_taxonomy()
    return text in taxonomy or text in taxonomy.adjectives or is_english_word(text)
