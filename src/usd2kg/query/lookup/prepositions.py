"""Prepositions of questions and noun phrases, and the relations that they mean."""

from collections.abc import Collection

from usd2kg.knowledge import word_map

__all__ = ["RELATION_OF", "preposition_pattern"]

RELATION_OF = word_map("query", "relation_words")
"""Preposition in lower case → relation."""


def preposition_pattern(relations: Collection[str] | None = None) -> str:
    """Return a regular expression of the prepositions for some relations, or for all; longer ones come first.

    >>> preposition_pattern(["above"]).split("|")
    ['au-dessus de', 'above', 'over', 'über']
    """
    words = [word for word, relation in RELATION_OF.items() if relations is None or relation in relations]
    return "|".join(sorted(words, key=lambda word: (-len(word), word)))
