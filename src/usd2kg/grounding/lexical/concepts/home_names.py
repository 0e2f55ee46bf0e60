"""Names of objects by class of the built-in home TBox, and their words."""

from collections import Counter
from collections.abc import Mapping
from functools import lru_cache
from itertools import chain
from typing import Any, NamedTuple

from usd2kg.grounding.lexical.settings import READING
from usd2kg.knowledge import read_rows
from usd2kg.ontology import ClassIRI, load_home_tbox
from usd2kg.table_cache import open_table_cache

__all__ = ["HomeWords", "home_names", "home_words"]


class HomeWords(NamedTuple):
    """The words of the names, lower case."""

    counts: Mapping[str, int]
    """Word → number of occurrences in all names."""
    last_counts: Mapping[str, int]
    """Word → number of compounds that it ends."""
    before_counts: Mapping[str, int]
    """Word → number of its occurrences in compounds before the last word."""
    compounds: frozenset[str]
    """The names of several words, joined."""
    short_names: frozenset[str]
    """Names that are shorter than nouns usually must be: a TV, a PC."""


@lru_cache(maxsize=1)
def home_names() -> Mapping[ClassIRI, tuple[str, ...]]:
    """Return the names of objects by class of the built-in home TBox: labels, synonyms, and `data/home_names.csv`."""
    home = load_home_tbox()
    names = {cls.iri: [cls.label, *cls.alt_labels] for cls in home.classes}
    by_local_name = {cls.local_name: cls.iri for cls in home.classes}
    for row in read_rows("home_names.csv"):
        names[by_local_name[row["class"]]] += row["names"].split("|")
    return {iri: tuple(found) for iri, found in names.items()}


@lru_cache(maxsize=1)
def home_words() -> HomeWords:
    """Return the words of the names; they are kept between commands."""
    return open_table_cache(()).get("home-words", _of_json, _count_words, _as_json)


def _count_words() -> HomeWords:
    names = [name.lower().split() for name in chain.from_iterable(home_names().values())]
    compounds = [words for words in names if len(words) > 1]
    return HomeWords(
        counts=Counter(chain.from_iterable(names)),
        last_counts=Counter(words[-1] for words in compounds),
        before_counts=Counter(chain.from_iterable(words[:-1] for words in compounds)),
        compounds=frozenset("".join(words) for words in compounds),
        short_names=frozenset(name for name in map(" ".join, names) if len(name) < READING.min_noun_letters),
    )


def _as_json(words: HomeWords) -> list[Any]:
    counts = [[" ".join(found), [*found.values()]] for found in words[:3]]
    return [*counts, *(" ".join(sorted(found)) for found in words[3:])]


def _of_json(kept: Any) -> HomeWords:
    *counts, compounds, short_names = kept
    counts, last_counts, before_counts = (dict(zip(words.split(), numbers, strict=True)) for words, numbers in counts)
    return HomeWords(counts, last_counts, before_counts, frozenset(compounds.split()), frozenset(short_names.split()))
