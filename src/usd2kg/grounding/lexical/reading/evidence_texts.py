"""Texts of an object that may name it, by source; and names that modelling programs generate."""

import re

from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.reading.object_words import ObjectWords
from usd2kg.grounding.lexical.settings import EVIDENCE
from usd2kg.knowledge import word_set
from usd2kg.words import words_of

__all__ = ["is_generated_name", "texts_of"]

_PRIMITIVES = word_set("lexical", "primitives")
_ARTICLES = word_set("lexical", "articles")
_RELATION_WORDS = word_set("lexical", "relation_words")
_NUMBERED_BOX = re.compile(r"[a-z]_?\d{3,}$", re.IGNORECASE)


def is_generated_name(name: str) -> bool:
    """Return whether a modelling program named an object after a primitive: `pCube3`, `polySurface12`, `Box003`.

    `Box_3` may be a box.
    """
    words = words_of(name)
    return _PRIMITIVES.issuperset(words) and bool(
        _NUMBERED_BOX.search(name) if words == ("box",) else name[-1:].isdigit()
    )


def texts_of(words: ObjectWords) -> list[tuple[str, str]]:
    """Return (evidence group, text) of the sources of words, the most reliable first."""
    texts = [("name", words.name), ("name", words.display_name)]
    texts += [("asset", asset) for asset in words.asset]
    texts += [("labels", label) for label in words.labels]
    texts.append(("documentation", _first_noun_phrase(words.documentation)))
    texts += [("hierarchy", group) for group in reversed(words.groups) if _is_plural(group)]
    texts += [
        ("parts", part) for part in words.parts[: EVIDENCE.max_parts] if not _PRIMITIVES.issuperset(words_of(part))
    ]
    return [(group, text) for group, text in dict.fromkeys(texts) if text]


def _first_noun_phrase(documentation: str) -> str:
    """Return the first words of a description, at most 6, up to punctuation or a word such as “for” or “with”."""
    words: list[str] = []
    for word in documentation.replace("\n", " ").split():
        bare = word.strip(".,;:!?()\"'").lower()
        if words and bare in _RELATION_WORDS:
            break
        if bare not in _ARTICLES:
            words.append(bare)
        if word[-1:] in ".,;:!?":
            break
    return " ".join(words[:6])


def _is_plural(name: str) -> bool:
    """Return whether a group is named after its members (`mugs`, `wallUnits`) rather than a place."""
    words = words_of(name)
    return bool(words) and load_taxonomy().singular(words[-1]) != words[-1]
