"""What people count among a general kind that the taxonomy has elsewhere: to an office, staplers are stationery."""

from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import NamedTuple

from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.knowledge import read_rows

__all__ = ["Category", "members_of", "synset_of"]


class Category(NamedTuple):
    """A general kind."""

    things: int
    """The number of meanings that belong to it, of all nouns."""
    members: tuple[str, ...]
    """What belongs to it, with all that is below: names for `synset_of`."""


def members_of(kind: str, taxonomy: Taxonomy) -> Iterator[tuple[int, int]]:
    """Yield (synset, number of things of the kind) of what belongs to a kind, written without spaces; maybe nothing."""
    category = _load_categories().get(kind)
    if category is not None:
        synsets = (synset_of(member, taxonomy) for member in category.members)
        yield from ((synset, category.things) for synset in synsets if synset is not None)


def synset_of(name: str, taxonomy: Taxonomy) -> int | None:
    """Return the first meaning of a name, or for `nail#2` the second; None if the taxonomy has none."""
    lemma, _, meaning = name.replace(" ", "").replace("-", "").partition("#")
    senses = taxonomy.senses(lemma)[int(meaning or 1) - 1 :]
    return senses[0].synset if senses else None


@lru_cache(maxsize=1)
def _load_categories() -> Mapping[str, Category]:
    """Return the kinds of `data/categories.csv` by their names without spaces."""
    return {
        kind: Category(int(row["things"]), tuple(row["members"].split("|")))
        for row in read_rows("categories.csv")
        for kind in row["kinds"].replace(" ", "").replace("-", "").split("|")
    }
