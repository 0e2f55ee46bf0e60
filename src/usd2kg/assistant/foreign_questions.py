"""in_english: a question in German, French, Spanish or Italian → its words in English, in the order of English."""

import re
from collections.abc import Mapping, Sequence
from functools import cache

from usd2kg.assistant.rewording import read_rules, reword
from usd2kg.assistant.sentences import plural
from usd2kg.knowledge import word_map, word_set
from usd2kg.languages import is_plural_form, translate

__all__ = ["in_english"]

_LANGUAGES = ("de", "es", "fr", "it")
_NOTHING = "-"
"""Stands for the translation of a word that English lacks."""
_MAX_PHRASE = 6
"""Words of the longest phrase of the tables."""
_MIN_GRAMMAR = 2
"""Fewest words of the grammar of a language by which a question is in it."""
_ELIDED = re.compile(r"\b(\w{1,5}')(?=\w)")
_NAME = re.compile(r"\w*[\d_/]\w*|\w+[A-Z]\w*")
_PLURAL_BEFORE = frozenset(["all", "all the", "both", "how many", "these", "two", "three", "four", "five", "six", "no"])
_GENITIVE = frozenset(["des", "eines"])
"""German articles before a noun whose ending is no plural."""
_OF = frozenset(["de", "d'", "di", "da", "à"])
"""Words between the nouns of a Romance compound: bottle of wine."""


def in_english(text: str) -> str | None:
    """Return a question in English, translated by the words of its language; None if it is English.

    >>> in_english("Welcher Eimer steht am weitesten vom Mülleimer entfernt?")
    'which bucket stands furthest from the trash can'
    >>> in_english("Quelle est la chaise la plus haute ?")
    'which is the tallest chair'
    >>> in_english("which bucket is the tallest?")
    """
    tokens = _tokens(text)
    language = _language_of(tokens)
    if language is None:
        return None
    words = " ".join(_translated(tokens, language)).replace(" ,", ",")
    return reword(words, read_rules("word_order.txt"))


def _tokens(text: str) -> list[str]:
    """Return the words in lower case, but for names, with elided words apart, and the commas."""
    plain = text.replace("\N{RIGHT SINGLE QUOTATION MARK}", "'")
    words = re.findall(r",|[^\s,;.:?!¿¡()\"«»]+", _ELIDED.sub(r"\1 ", plain))
    return [word if _NAME.fullmatch(word) else word.lower() for word in words]


@cache
def _english() -> frozenset[str]:
    sets = ("be", "definite", "do", "existential", "modals", "people", "universal", "requests")
    words = {word for name in sets for word in word_set("grammar", name)}
    return frozenset(
        {*words, *word_set("query", "question_words"), "and", "from", "in", "no", "of", "on", "to", "with"}
    )


def _language_of(tokens: Sequence[str]) -> str | None:
    """Return the language that more words are of than of English."""
    english = sum(token in _english() for token in tokens)
    counts = {language: _covered(tokens, word_map("questions", language)) for language in _LANGUAGES}
    best = max(counts, key=lambda language: counts[language])
    return best if counts[best] >= _MIN_GRAMMAR and counts[best] > english else None


def _covered(tokens: Sequence[str], table: Mapping[str, str]) -> int:
    at = found = 0
    while at < len(tokens):
        end = _phrase_end(tokens, at, table)
        found += end - at
        at = max(end, at + 1)
    return found


def _phrase_end(tokens: Sequence[str], at: int, table: Mapping[str, str]) -> int:
    """Return the end of the longest phrase of a table that begins at a word; `at` if there is none."""
    ends = range(min(len(tokens), at + _MAX_PHRASE), at, -1)
    return next((end for end in ends if " ".join(tokens[at:end]) in table), at)


def _translated(tokens: Sequence[str], language: str) -> list[str]:
    table = word_map("questions", language)
    found: list[str] = []
    at = 0
    while at < len(tokens):
        end = _phrase_end(tokens, at, table)
        if end > at:
            english = table[" ".join(tokens[at:end])]
            found += [] if english == _NOTHING else [english]
        elif _NAME.fullmatch(tokens[at]) or tokens[at] == ",":
            found.append(tokens[at])
            end = at + 1
        else:
            end = _noun_end(tokens, at, table, language)
            before = tokens[at - 1] if at else ""
            found.append(_noun(tokens[at:end], language, before, found[-1] if found else ""))
        at = end
    return found


def _noun_end(tokens: Sequence[str], at: int, table: Mapping[str, str], language: str) -> int:
    """Return the end of a noun with its adjectives, and with what belongs to it in a Romance compound."""
    end = at
    while end < len(tokens) and _phrase_end(tokens, end, table) == end and not _NAME.fullmatch(tokens[end]):
        if tokens[end] == ",":
            break
        end += 1
        links = language != "de" and end + 1 < len(tokens) and tokens[end] in _OF
        if links and _phrase_end(tokens, end + 1, table) == end + 1 and not _NAME.fullmatch(tokens[end + 1]):
            end += 1
    return end


def _noun(words: Sequence[str], language: str, before: str, english_before: str) -> str:
    """Return the English noun for some words, in the plural if their head is."""
    english = " ".join(translate(tuple(words), language) or words)
    head = words[-1] if language == "de" else words[0]
    is_many = english_before in _PLURAL_BEFORE or (before not in _GENITIVE and is_plural_form(head, language))
    return plural(english) if is_many else english
