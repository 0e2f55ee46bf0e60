"""with_antecedent: a question about what was named before, with the noun in place of the pronoun."""

import re
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from usd2kg.assistant.paraphrases import NOUNS_ONLY
from usd2kg.assistant.phrases import split_clauses
from usd2kg.knowledge import word_set
from usd2kg.query.lookup.prepositions import RELATION_OF
from usd2kg.query.lookup.word_forms import is_plural

__all__ = ["with_antecedent"]

_PRONOUN = re.compile(r"\b(it|them|they)\b|(?<=there )one\b|(?<=find )one\b|(?<=see )one\b", re.IGNORECASE)
_MAX_WORDS = 20
"""Words before a pronoun among which its noun is looked for."""
_MAX_NOUN = 4
"""Words of a noun."""
_DETERMINERS = word_set("query", "determiners") | word_set("grammar", "definite") | word_set("grammar", "existential")
_PREPOSITIONS = frozenset(phrase.split()[-1] for phrase in RELATION_OF) | {"of", "with", "for", "to", "from", "by"}
_NO_NOUNS = word_set("assistant", "fillers") | word_set("query", "connectives")
"""Words that are in no noun."""
_BEFORE_VERBS = word_set("grammar", "people") | word_set("grammar", "modals")


def with_antecedent(text: str, is_noun: Callable[[str], bool]) -> str | None:
    """Return the clause of a question with a pronoun, and in its place what was named before; None if there is nothing.

    A subject or an object is more likely to be meant than what follows a preposition (Grosz, Joshi and Weinstein 1995,
    Centering), and a nearer one than one farther off. Where it is, up to the end of its clause, belongs to it.

    Args:
        text: the question.
        is_noun: whether words name things.

    >>> with_antecedent("The bucket under the sink, what is in it?", {"bucket", "sink"}.__contains__)
    'what is in the bucket under the sink'
    """
    clauses = split_clauses(text)
    for at, clause in reversed([*enumerate(clauses)][1:]):
        if (pronoun := _PRONOUN.search(clause)) is None:
            continue
        many = pronoun[0].lower() in {"them", "they"}
        named = [
            noun for before in reversed(clauses[:at]) for noun in _nouns(before, is_noun) if noun.is_plural is many
        ]
        if named:
            # Sorting keeps the order of equals: the nearest first.
            best = min(named, key=lambda noun: noun.is_oblique)
            return f"{clause[: pronoun.start()]}the {best.phrase}{clause[pronoun.end() :]}"
    return None


class _Noun(NamedTuple):
    phrase: str
    """With the place that follows it."""
    is_plural: bool
    is_oblique: bool
    """Whether it follows a preposition."""


def _nouns(clause: str, is_noun: Callable[[str], bool]) -> Iterator[_Noun]:
    """Yield the nouns of a clause from its end, the longest at each place."""
    words = clause.split()[-_MAX_WORDS:]
    end = len(words)
    while end:
        start = next(
            (start for start in range(max(0, end - _MAX_NOUN), end) if _is_named(words, start, end, is_noun)), end
        )
        if start < end:
            noun, place = " ".join(words[start:end]), words[end:]
            is_place = bool(place) and place[0].lower() in _PREPOSITIONS and not NOUNS_ONLY.search(" ".join(place))
            yield _Noun(" ".join([noun, *place] if is_place else [noun]), is_plural(noun), _is_oblique(words[:start]))
        end = min(start, end - 1)


def _is_named(words: Sequence[str], start: int, end: int, is_noun: Callable[[str], bool]) -> bool:
    """Return whether some of the words are a noun, and no verb: I would like."""
    before = words[start - 1].lower() if start else ""
    is_verb = before in _BEFORE_VERBS or before.endswith(("'d", "'ll"))
    inside = words[start:end]
    return not is_verb and _NO_NOUNS.isdisjoint(word.lower() for word in inside) and is_noun(" ".join(inside))


def _is_oblique(before: Sequence[str]) -> bool:
    """Return whether the words before a noun end in a preposition, with or without a determiner."""
    governing = [word.lower() for word in before if word.lower() not in _DETERMINERS]
    return bool(governing) and governing[-1] in _PREPOSITIONS
