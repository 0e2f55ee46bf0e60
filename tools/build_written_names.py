"""Write the word sequences of names in scenes, from which the reader of names counts words and bigrams.

Usage: python -m tools.build_written_names

Reads the names in the training lists by the authors of `benchmarks/names` and `benchmarks/ontologies`. A line is a
sequence of known words; misspellings, abbreviations and brands split a name. Run it again after adding a list.
"""

from collections.abc import Iterator
from functools import lru_cache
from itertools import groupby

from benchmarks.names.lists import AUTHORS, HOME_TABLE, ONTOLOGY_TABLE, PUBLIC_ONTOLOGIES, read_names
from tools.data_files import write_data_file
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.reading.english_words import is_english_word
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.languages import language_of
from usd2kg.ontology import load_home_tbox
from usd2kg.words import words_of

OUTPUT = "written_names.txt"
MIN_LENGTH = 3
"""Shorter words are usually codes."""


def main() -> None:
    """Write the file."""
    lines = build_written_names()
    print(f"{write_data_file(OUTPUT, lines.encode())}: {lines.count(chr(10))} sequences of words")


def build_written_names() -> str:
    """Return the content of the file: one sequence per line, sorted."""
    lines = sorted(run for name in names() for run in known_runs(name))
    return "\n".join(lines) + "\n"


def names() -> Iterator[str]:
    """Yield the names of the training lists by the authors."""
    for names in (*read_names(HOME_TABLE), *read_names(ONTOLOGY_TABLE)):
        # Lists with public ontologies repeat names of the home table.
        if names.split == "train" and names.ontology not in PUBLIC_ONTOLOGIES:
            yield from (row["name"] for row in names.rows if row["source"] == AUTHORS)


def known_runs(name: str) -> Iterator[str]:
    """Yield the sequences of known words in a name, in the singular."""
    words = [word for word in words_of(name) if word.isalpha() and len(word) >= MIN_LENGTH]
    for known, run in groupby(words, is_known):
        if known:
            yield " ".join(join_compounds(list(map(load_taxonomy().singular, run))))


def join_compounds(words: list[str]) -> Iterator[str]:
    """Yield words, with two joined if they form a closed compound: `CupBoard` is a cupboard."""
    taxonomy = load_taxonomy()
    at = 0
    while at < len(words):
        pair = "".join(words[at : at + 2])
        is_one = at + 1 < len(words) and pair in taxonomy and not taxonomy.is_phrase(pair)
        yield pair if is_one else words[at]
        at += 2 if is_one else 1


def is_known(word: str) -> bool:
    """Return whether a text is a word in English or another supported language."""
    return reader().kinds.is_known(word) or is_english_word(word) or language_of((word,)) is not None


@lru_cache(maxsize=1)
def reader() -> NameReader:
    """Return a reader with the home vocabulary."""
    taxonomy = load_taxonomy()
    return NameReader(build_lexicon(load_home_tbox(), taxonomy, home_names()), taxonomy)


if __name__ == "__main__":
    main()
