"""parse_intent: what a question asks, by its cue and the noun phrases around it, in any order of words."""

import re
from collections.abc import Sequence
from functools import cache
from importlib.resources import files
from itertools import count
from typing import NamedTuple

from usd2kg.assistant.phrases import HEADINGS, Phrase, normalize, split_clauses
from usd2kg.grounding import concepts_named
from usd2kg.knowledge import word_set
from usd2kg.query.lookup.prepositions import preposition_pattern

__all__ = ["parse_intent"]

_BREAK = "|"
"""Stands for words that were left out: nouns on both sides are two noun phrases."""
_FILLERS = word_set("assistant", "fillers")
_NO_SENSE = re.compile(
    r"\b(one|some|any|each|all|both) of (the |them |these )?|\b(piece|pieces|pair|set) of\b|\bfor me\b"
    r"|\b(of |i mean )?(both|all|any|every) (kind|type|sort|model)s?\b",
    re.IGNORECASE,
)
"""Phrases that do not change the answer."""
_LINKS = (
    "of than and or with without no nothing within nearest closest furthest farthest bigger larger smaller taller "
    "higher wider heavier lighter longer shorter between from to for but"
)
_LINK = rf"(?:{preposition_pattern()}|{'|'.join(_LINKS.split())})"
_LINKED = re.compile(rf"(?: ?\{_BREAK})* (?={_LINK}\b)|(?:^|(?<= ))({_LINK})(?: ?\{_BREAK})+ ")
_LOOSE = re.compile(r"^(?:(?:of|and|or|to|for|from) )+|(?: (?:of|and|or|to|for|from))+$")
"""Links without a noun on one side."""
_PAIR = re.compile(r"(?:between |from |of )?(?P<thing>.+?) (?:(?:and|to|from|or|\|) (?P<other>.+)|(?P<next>\S+))")


_MEASURES = frozenset(["adjective", "area", "noun", "square"])
"""Groups of a cue that name a measure."""


class _Intent(NamedTuple):
    question: str
    argument: str
    cue: re.Pattern[str]
    is_english: bool


@cache
def _intents() -> Sequence[_Intent]:
    intents, is_english = [], True
    for line in (files("usd2kg.assistant") / "intents.txt").read_text("utf-8").splitlines():
        is_english = HEADINGS.get(line, is_english)
        if found := re.fullmatch(r"([\w-]+) (class|thing|pair): (.+)", line):
            numbers = count()
            cue = re.sub(r"\.\*\??", lambda wild: f"(?P<inner_{next(numbers)}>{wild[0]})", found[3])  # noqa: B023
            intents.append(_Intent(found[1], found[2], re.compile(cue, re.IGNORECASE), is_english))
    return tuple(intents)


def parse_intent(text: str) -> Phrase | None:
    """Return the interpretation of a question by the first cue of `intents.txt` in it; None if its words do not fit.

    All words beside the cue and fillers must be one noun phrase, or two for a distance: a word that is left over would
    change what is asked.

    >>> parse_intent("hey, can you tell me where I'd find the info desk please")
    Phrase(question='where', given={'thing': 'info desk'}, is_english=True, left=())
    """
    whole = normalize(text)
    clauses = (whole, *reversed(split_clauses(whole)))
    # A clause with a clear cue tells more than the last one.
    found = ((at, _parse(clause, intent)) for intent in _intents() for at, clause in enumerate(clauses))
    at, phrase = next(((at, phrase) for at, phrase in found if phrase is not None), (0, None))
    others = tuple(reversed([clause for other, clause in enumerate(clauses) if other not in (0, at)]))
    return phrase if phrase is None or not at else phrase._replace(left=others)


def _parse(text: str, intent: _Intent) -> Phrase | None:
    question, argument, cue, is_english = intent
    if cue.search(text) is None:
        return None
    if question == "how-many" and len(cue.findall(text)) > 1:
        # How many cups and how many plates are two questions.
        return None
    # Words within a cue are a part of the noun phrase: which of the doors opens.
    phrase = _noun_phrase(cue.sub(lambda found: f" {_BREAK} {_inner_words(found)} {_BREAK} ", text))
    if argument == "pair":
        pair = _PAIR.fullmatch(phrase)
        given = {"thing": pair["thing"], "other": pair["other"] or pair["next"]} if pair is not None else {}
    else:
        given = {argument: phrase} if phrase else {}
    if not given or any(_BREAK in noun for noun in given.values()):
        return None
    measured = _measured(text, cue) if question == "measure" else {}
    return Phrase(question, {**given, **measured}, is_english)


def _inner_words(found: re.Match[str]) -> str:
    """Return the words that `.*` of a cue matched."""
    return " ".join(value for name, value in found.groupdict().items() if name.startswith("inner_") and value)


def _measured(text: str, cue: re.Pattern[str]) -> dict[str, str]:
    """Return the measure that a question names; the size if it names several."""
    words = {
        word.lower()
        for found in cue.finditer(text)
        if (word := next((value for name, value in found.groupdict().items() if value and name in _MEASURES), ""))
    }
    return {"adjective": words.pop() if len(words) == 1 else "size"}


def _noun_phrase(text: str) -> str:
    """Return a text without fillers; those between two nouns leave a break."""
    words = _NO_SENSE.sub(f" {_BREAK} ", text).replace(",", f" {_BREAK} ").split()
    words = [word.strip("?!.,") for word in words]
    before = ["", *words]
    kept = [
        _BREAK if word.lower() in _FILLERS and not (last.isalpha() and concepts_named(f"{last} {word}")) else word
        for last, word in zip(before, words, strict=False)
    ]
    phrase = re.sub(rf"(?: ?\{_BREAK} ?)+", f" {_BREAK} ", " ".join(filter(None, kept))).strip(f" {_BREAK}")
    linked = " ".join(_LINKED.sub(lambda found: f"{found[1]} " if found[1] else " ", phrase).split())
    return _LOOSE.sub("", linked)
