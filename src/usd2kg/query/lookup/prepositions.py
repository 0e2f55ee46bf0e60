"""Prepositions of questions and noun phrases, and the relations that they mean."""

import re
from collections.abc import Collection

from usd2kg.knowledge import word_map

__all__ = ["DIRECTLY", "RELATION_OF", "SIDES", "is_direct", "preposition_pattern", "relation_of"]

RELATION_OF = word_map("query", "relation_words")
"""Preposition in lower case → relation."""
SIDES = ("left", "right", "front", "behind")
"""Relations that need a viewpoint, which a graph may lack."""
DIRECTLY = r"(?:directly|immediately) (?=(?:on|upon|in|inside|into)\b)"
"""Regular expression of the adverb by which what is on a tray on a table is not on the table."""


def relation_of(preposition: str) -> str:
    """Return the relation that a preposition means, also after an adverb.

    >>> relation_of("on top of"), relation_of("directly on")
    ('on', 'on')
    """
    return RELATION_OF[re.sub(DIRECTLY, "", preposition.lower())]


def is_direct(preposition: str) -> bool:
    """Return whether an adverb before a preposition excludes what is over another thing."""
    return re.match(DIRECTLY, preposition.lower()) is not None


def preposition_pattern(relations: Collection[str] | None = None) -> str:
    """Return a regular expression of the prepositions for some relations, or for all; longer ones come first.

    >>> preposition_pattern(["above"]).split("|")
    ['au-dessus de', 'above', 'over', 'über']
    """
    words = [word for word, relation in RELATION_OF.items() if relations is None or relation in relations]
    return "|".join(sorted(words, key=lambda word: (-len(word), word)))
