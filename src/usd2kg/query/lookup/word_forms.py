"""Words of names and questions: singulars, and what adds no meaning."""

import re
from functools import lru_cache
from itertools import takewhile

from usd2kg.grounding import concepts_named, hypernyms_of
from usd2kg.knowledge import word_set
from usd2kg.words import split_identifier

__all__ = [
    "IRREGULAR_PLURALS",
    "common_stem",
    "is_noun",
    "is_place",
    "is_plural",
    "name_parts",
    "name_words",
    "noun_words",
    "singular",
    "split_phrase",
]

_FILLERS = word_set("query", "determiners")
_WHOLE_PLACES = word_set("query", "whole_places")
_PLACE_KINDS = word_set("query", "place_kinds")
IRREGULAR_PLURALS = {
    "mouse": "mice",
    "knife": "knives",
    "shelf": "shelves",
    "person": "people",
    "leaf": "leaves",
    "loaf": "loaves",
    "half": "halves",
    "scarf": "scarves",
}
_IRREGULAR = {many: one for one, many in IRREGULAR_PLURALS.items()}
_ENDINGS = (
    ("ies", "y"),
    ("sses", "ss"),
    ("ches", "ch"),
    ("shes", "sh"),
    ("xes", "x"),
    ("s", ""),
)
_PLACED = r"(lies|lie|stands?|sits?|hangs?|rests?|leans?)"
_BEFORE_PLACE = (
    r"(?=((\w+) )?(on|in|inside|at|by|near|under|next|beside|below|above|behind|nearest|closest|furthest|to|from)\b)"
)
_RELATIVE = re.compile(
    rf"\b(that|which|who) ((is|are|was|were) |{_PLACED} {_BEFORE_PLACE})"
    rf"|(?<=\w )(standing|lying|sitting|hanging|resting|placed|located|exactly) {_BEFORE_PLACE}"
    r"|(?<=\w )directly (?!(on|upon|in|inside)\b)"
    rf"{_BEFORE_PLACE}",
    re.IGNORECASE,
)
"""Relative pronouns with their verb, and participles and adverbs before a preposition."""
_VOWELS = frozenset("aeiouy")
_MIN_STEM = 2
"""Fewest letters that remain before a stripped ending."""


@lru_cache(maxsize=65536)
def singular(word: str) -> str:
    """Return an approximate singular; errors cancel out where both sides of a comparison are stemmed.

    >>> [singular(word) for word in ("boxes", "knives", "gloves", "gas", "TVs")]
    ['box', 'knife', 'glove', 'gas', 'TV']
    """
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    for ending, replacement in _ENDINGS:
        stem = word.removesuffix(ending)
        # Acronyms such as TV have few letters, and no vowels.
        least = _MIN_STEM + (ending == "s" and not _VOWELS.isdisjoint(stem.lower()))
        if stem != word and len(stem) >= least and not word.endswith("ss"):
            return stem + replacement
    return word


def is_place(noun: str) -> bool:
    """Return whether a noun means a place such as a room or a shop."""
    return noun in _WHOLE_PLACES or not _PLACE_KINDS.isdisjoint(hypernyms_of(noun))


def is_plural(noun: str) -> bool:
    """Return whether the last word of a noun is a plural.

    >>> is_plural("wine glasses"), is_plural("glass"), is_plural("sheep")
    (True, False, False)
    """
    return singular(last := noun.rsplit(maxsplit=1)[-1]) != last if noun else False


def common_stem(word: str) -> str:
    """Return the prefix that the singular and the plural of a noun share.

    >>> common_stem("knife"), common_stem("battery"), common_stem("cup")
    ('kni', 'batter', 'cup')
    """
    same = takewhile(lambda pair: pair[0] == pair[1], zip(word, IRREGULAR_PLURALS.get(word, word), strict=False))
    return "".join(letter for letter, _ in same).removesuffix("y")


def noun_words(text: str) -> frozenset[str]:
    """Return the words of a name in the singular, without numbers.

    >>> sorted(noun_words("DiningTables_02"))
    ['dining', 'table']
    """
    return frozenset(singular(word.lower()) for word in split_identifier(text) if not word.isdigit())


@lru_cache(maxsize=65536)
def name_words(text: str) -> frozenset[str]:
    """Return the words of a name in the singular, and its numbers without leading zeros.

    >>> sorted(name_words("DiningTables_02"))
    ['2', 'dining', 'table']
    """
    return frozenset(name_parts(text))


def name_parts(text: str) -> list[str]:
    """Return the words of a name in the singular, and its numbers without leading zeros, in order.

    >>> name_parts("DiningTables_02")
    ['dining', 'table', '2']
    """
    parts = (word.lower() for word in split_identifier(text))
    return [part.lstrip("0") or "0" if part.isdigit() else singular(part) for part in parts]


def is_noun(text: str) -> bool:
    """Return whether the lexicon knows a noun, or all words of a compound."""
    return bool(text) and bool(concepts_named(text) or all(concepts_named(singular(word)) for word in text.split()))


def split_phrase(text: str) -> list[str]:
    """Return the words of a noun phrase without articles and words that add nothing.

    >>> split_phrase("all the cups that are on the table, please")
    ['cups', 'on', 'table']
    """
    words = _RELATIVE.sub("", text.strip(" ?!.,;")).split()
    while words and words[0].lower() in _FILLERS:
        words = words[1:]
    while len(words) > 1 and words[-1].lower() in {"here", "there", "please"}:
        words = words[:-1]
    cleaned = " ".join(word.rstrip(",;:") for word in words)
    for tail in (" in here", " in this scene", " in the scene"):
        cleaned = cleaned.removesuffix(tail)
    # A letter at the end is a part of a name: shelf A.
    *before, last = cleaned.split() or [""]
    kept = [*(word for word in before if word.lower() not in {"the", "a", "an"}), last]
    return [word if "/" in word or "_" in word else word.lower() for word in kept if word]
