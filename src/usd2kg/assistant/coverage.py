"""Coverage: every word of a question counts. What a reading leaves out is refused, or the answer says it."""

import re
from collections.abc import Sequence

from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.paraphrases import NOUNS_ONLY
from usd2kg.assistant.phrases import Phrase, crosses_clauses
from usd2kg.assistant.sentences import join_words
from usd2kg.knowledge import word_set
from usd2kg.query.lookup import UnknownWordError

__all__ = [
    "check_left",
    "check_nothing",
    "check_requests",
    "is_partial",
    "is_topic",
    "leaves_out",
    "says_less",
    "tells_more",
    "with_notes",
]

_CONDITIONS = word_set("query", "negations") | word_set("assistant", "conditions")
_EMBEDDED = re.compile(r"\b(know|see|check|sure|wonder|tell|ask) (me )?(if|whether)\b", re.IGNORECASE)
"""Begins a question within a clause, which is no condition."""
_REQUEST = re.compile(
    r"(so )?(how|what|which|where|who|whose|why|when|describe|find|give|list|name|show|tell)\b", re.IGNORECASE
)
"""Begins a question of its own."""
_EMPTY_WORDS = word_set("assistant", "fillers") | word_set("query", "determiners")
_OTHER_TIMES = word_set("assistant", "other_times")
_LEFT_OUT = "Not taken into account"
"""Begins what an answer says about words that it leaves out."""
_ABOUT_TIME = frozenset(["changed"])
"""Question types that compare the scene with an older version."""


def _words(text: str) -> list[str]:
    return re.findall(r"[^\W_]+(?:'\w+)?", text.lower())


def check_left(phrase: Phrase) -> None:
    """Check that no part of a question that a reading leaves out changes what is asked.

    Raises:
        UnknownWordError: a part has a negation, a condition or an exception.
    """
    for part in phrase.left:
        words = _words(_EMBEDDED.sub("", part))
        if found := next((word for word in words if word in _CONDITIONS), None):
            raise UnknownWordError(f"{found!r} in {part!r} is not understood")


def check_nothing(found: InterpretedAnswer, phrase: Phrase, guesses: Sequence[str]) -> None:
    """Check that an answer that there is nothing does not come from words that were guessed or left out.

    Args:
        found: the answer.
        phrase: the interpretation of the question.
        guesses: notes on words that were read as something near.

    Raises:
        UnknownWordError: nothing is found, and the words may mean something else.
    """
    if found.answer.rows or found.number or found.verdict:
        return
    if guesses:
        raise UnknownWordError(f"not known: {guesses[0]}, and nothing was found")
    for part in phrase.left:
        if _REQUEST.match(part):
            raise UnknownWordError(f"{part!r} is not understood")


def check_requests(phrase: Phrase) -> None:
    """Check that a reading of one clause leaves out no other that asks for something.

    Raises:
        UnknownWordError: it does.
    """
    if asked := next((part for part in phrase.left if _REQUEST.match(part)), None):
        raise UnknownWordError(f"{asked!r} is not understood")


def is_topic(clause: str) -> bool:
    """Return whether a clause is a definite noun phrase without a verb, which the question is about.

    >>> is_topic("the plates on the table"), is_topic("the butter has to stay cold"), is_topic("long day")
    (True, False, False)
    """
    return clause.lower().startswith("the ") and NOUNS_ONLY.search(clause) is None


def leaves_out(phrase: Phrase) -> bool:
    """Return whether a reading leaves out a part of its question that says something, or takes two clauses for one."""
    return bool(_parts_with_content(phrase)) or crosses_clauses(phrase)


def _parts_with_content(phrase: Phrase) -> list[str]:
    return [part for part in phrase.left if not _EMPTY_WORDS.issuperset(_words(part))]


def with_notes(
    found: InterpretedAnswer, phrase: Phrase, text: str, read_as: Sequence[str], *, is_english: bool
) -> InterpretedAnswer:
    """Return an answer that says which parts of its question were left out, and how unusual words were read.

    Args:
        found: the answer.
        phrase: the interpretation of the question.
        text: the question.
        read_as: notes on nouns, which the sentence may have already.
        is_english: whether the question is English; the German “was” is no past.
    """
    left = _parts_with_content(phrase)
    found = found.with_notes(read_as)
    said = [f"{_LEFT_OUT}: {join_words([f'“{part}”' for part in left])}."] if left else []
    if is_english and phrase.question not in _ABOUT_TIME and not _OTHER_TIMES.isdisjoint(_words(text)):
        said.append("The answer is about the scene as it is, not about another time.")
    return found.with_sentence(" ".join(filter(None, [found.sentence, *said]))) if said else found


_SAYS = re.compile(rf"was read as|{_LEFT_OUT}")


def is_partial(found: InterpretedAnswer) -> bool:
    """Return whether an answer leaves out words of its question, which it says."""
    return _LEFT_OUT in found.sentence


def says_less(found: InterpretedAnswer) -> bool:
    """Return whether an answer leaves out words of its question, or reads them as others."""
    return _SAYS.search(found.sentence) is not None


def tells_more(one: InterpretedAnswer, other: InterpretedAnswer) -> bool:
    """Return whether an answer takes all words as they are, and another does not."""
    return says_less(other) and not says_less(one)
