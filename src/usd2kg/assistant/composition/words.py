"""Words of a question, and the functions that words have in its grammar."""

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cache

from usd2kg.errors import GraphError
from usd2kg.knowledge import word_set
from usd2kg.query.lookup.amounts import NUMBER_WORDS, is_amount, read_amount
from usd2kg.query.lookup.body_measures import COMPARED, MEASURES, SUPERLATIVES, Measure
from usd2kg.query.lookup.prepositions import RELATION_OF

__all__ = ["BE", "DO", "Words", "is_function_word", "read_number", "split_words"]

BE = word_set("grammar", "be")
DO = word_set("grammar", "do")
_PREPOSITIONS: Mapping[str, str] = {**RELATION_OF, "from": "inside", "into": "inside", "onto": "on", "off": "on"}
"""Preposition → relation; longer ones are tried first."""
_SHORT_FORMS = (
    (re.compile(r"\b(is|are|was|were|do|does|did|has|have|could|can)n'?t\b"), r"\1 not"),
    (re.compile(r"\bcannot\b"), "can not"),
    (re.compile(r"\b(what|which|where|who|that|there|it|how)'s\b"), r"\1 is"),
    (re.compile(r"\b(\w+)'re\b"), r"\1 are"),
    (re.compile(r"\b(i|we|you|they)'ve\b"), r"\1 have"),
    # What has been put somewhere is there.
    (re.compile(r"\bhas( not)? (just )?been\b"), r"is\1"),
    (re.compile(r"\bhave( not)? (just )?been\b"), r"are\1"),
)
_OPERATORS = word_set("query", "operators")
_FUNCTION_WORDS = (
    BE
    | DO
    | word_set("query", "question_words")
    | word_set("query", "negations")
    | word_set("query", "connectives")
    | _OPERATORS
    | word_set("grammar", "universal")
    | word_set("grammar", "existential")
    | word_set("grammar", "definite")
    | {word for word in _PREPOSITIONS if " " not in word}
    | word_set("query", "relational_nouns")
    | word_set("grammar", "attributes")
    | SUPERLATIVES.keys()
    | COMPARED.keys()
    | {"there", "they", "them", "i", "than", "that", "between", "nearest", "closest", "made", ","}
)


def is_function_word(word: str) -> bool:
    """Return whether a word has a function in the grammar and is no part of a noun, unless the lexicon lists that."""
    return word.lower() in _FUNCTION_WORDS


def split_words(text: str) -> list[str]:
    """Return the words of a question and its commas, without adverbs that do not change what is meant.

    >>> split_words("What's really on the desk, please?")
    ['what', 'is', 'on', 'the', 'desk']
    """
    short = text
    for pattern, long in _SHORT_FORMS:
        short = re.sub(pattern.pattern, long, short, flags=re.IGNORECASE)
    words = [word for part in short.split() for word in re.findall(r"[,;]|[^,;]+", part)]
    words = [word.strip('?!:"“”') if len(word) > 1 else word for word in words]
    words = [word.removesuffix(".") for word in words if word]
    # Names keep their case.
    words = [word if re.search(r"[A-Z].*[A-Z_]|[/_]|\d", word) else word.lower() for word in words]
    kept: list[str] = []
    at = 0
    while at < len(words):
        # What is here? The adverb is all that follows the verb.
        end = _longest_at(words, at, _adverbs())
        if end > at and len(words) > 2:
            at = end
        else:
            kept.append(words[at])
            at += 1
    while kept and kept[-1] == ",":
        kept.pop()
    return kept


@cache
def _adverbs() -> frozenset[str]:
    return word_set("grammar", "adverbs")


def _longest_at(words: Sequence[str], at: int, phrases: Collection[str]) -> int:
    """Return the end of the longest of some phrases that begins at a word; `at` if there is none.

    >>> _longest_at(["on", "top", "of", "it"], 0, {"on", "on top of"})
    3
    """
    for end in range(min(len(words), at + 5), at, -1):
        if " ".join(words[at:end]).lower() in phrases:
            return end
    return at


def read_number(word: str) -> int | None:
    """Return the number that a word is; None for other words.

    >>> read_number("three"), read_number("12"), read_number("cups")
    (3, 12, None)
    """
    return NUMBER_WORDS.get(word.lower()) or (int(word) if word.isdecimal() else None)


class Words:
    """The words of one question, with what some of them mean wherever they stand."""

    def __init__(self, text: str) -> None:
        """Split a question, see `split_words`."""
        self._words = split_words(text)

    def __len__(self) -> int:
        """Return the number of words."""
        return len(self._words)

    def __getitem__(self, place: slice) -> list[str]:
        """Return some of the words."""
        return self._words[place]

    def word(self, at: int) -> str:
        """Return the word at a place in lower case; empty after the last."""
        return self._words[at].lower() if at < len(self._words) else ""

    def text(self, start: int, end: int) -> str:
        """Return some of the words."""
        return " ".join(self._words[start:end]).replace(" ,", ",")

    def after(self, at: int, phrases: Collection[str]) -> int:
        """Return the end of the longest of some phrases that begins at a word; `at` if there is none."""
        return _longest_at(self._words, at, phrases)

    def relation(self, start: int, at: int) -> Iterator[tuple[str, int]]:
        """Yield the relation that a preposition means, also with the verb before it: hanging from."""
        for first in dict.fromkeys((start, at)):
            if (end := _longest_at(self._words, first, _PREPOSITIONS)) > first:
                yield _PREPOSITIONS[" ".join(self._words[first:end]).lower()], end
                return

    def amount(self, at: int) -> tuple[float, str, int] | None:
        """Return an amount in metres or kilograms, its unit, and where it ends."""
        for end in range(min(len(self._words), at + 5), at, -1):
            text = self.text(at, end)
            if is_amount(text):
                try:
                    value, unit = read_amount(text)
                except GraphError:
                    continue
                return value, unit, end
        return None

    def superlative(self, at: int) -> tuple[Measure, int, int] | None:
        """Return the measure of a superlative, 1 for the most and -1 for the least, and where it ends."""
        word, following = self.word(at), self.word(at + 1)
        if read_number(word) is not None and following in SUPERLATIVES:
            measure, sign = SUPERLATIVES[following]
            return measure, sign, at + 2
        if word in SUPERLATIVES:
            measure, sign = SUPERLATIVES[word]
            return measure, sign, at + 1
        if word in COMPARED and self.word(at - 1) == "the" and following not in {"", "than", ",", "one"}:
            # The taller ladder, of two.
            measure, sign = COMPARED[word]
            return measure, sign, at + 1
        if word in {"most", "least"} and following in MEASURES:
            return MEASURES[following], 1 if word == "most" else -1, at + 2
        return None
