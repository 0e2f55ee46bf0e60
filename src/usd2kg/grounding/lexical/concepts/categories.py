"""Categories of common usage that WordNet does not model as hypernyms: a stapler is office stationery."""

from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from typing import NamedTuple

from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.knowledge import read_rows

__all__ = ["Category", "KindNames", "find_synset", "invert_categories", "members_of"]

KindNames = Callable[[int], tuple[str, ...]]
"""Synset → names of the categories that it is a member of."""


class Category(NamedTuple):
    """One row of `data/categories.csv`."""

    synset_count: int
    """Number of synsets in the category."""
    members: tuple[str, ...]
    """Nouns for `find_synset`, each with all its hyponyms."""


def members_of(category: str, taxonomy: Taxonomy) -> Iterator[tuple[int, int]]:
    """Yield (synset, number of synsets in the category) for each member; `category` is a name without spaces."""
    found = _load_categories().get(category)
    if found is not None:
        synsets = (find_synset(member, taxonomy) for member in found.members)
        yield from ((synset, found.synset_count) for synset in synsets if synset is not None)


def find_synset(name: str, taxonomy: Taxonomy) -> int | None:
    """Return the synset of a noun's first sense, or of the second for `nail#2`; None if there is none."""
    lemma, _, rank = name.replace(" ", "").replace("-", "").partition("#")
    senses = taxonomy.senses(lemma)[int(rank or 1) - 1 :]
    return senses[0].synset if senses else None


def invert_categories(taxonomy: Taxonomy) -> dict[int, tuple[str, ...]]:
    """Return synset → names of the categories that it is a member of itself, not by a hypernym."""
    kinds: dict[int, list[str]] = {}
    for row in read_rows("categories.csv"):
        names = row["kinds"].split("|")
        for member in row["members"].split("|"):
            synset = find_synset(member, taxonomy)
            if synset is not None:
                kinds.setdefault(synset, []).extend(names)
    return {synset: tuple(names) for synset, names in kinds.items()}


@lru_cache(maxsize=1)
def _load_categories() -> Mapping[str, Category]:
    """Return name without spaces → category."""
    return {
        name: Category(int(row["things"]), tuple(row["members"].split("|")))
        for row in read_rows("categories.csv")
        for name in row["kinds"].replace(" ", "").replace("-", "").split("|")
    }
