"""match_phrase: question in English → id of a ready question and its parameters, by the patterns in `phrases.txt`."""

import re
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import NamedTuple

__all__ = ["Phrase", "list_phrases", "match_phrase"]


class Phrase(NamedTuple):
    """A question that was understood."""

    question: str
    """Id in `phrases.txt`: that of a ready question, or another such as `on`, `where`, `how-many`, `is-on`."""
    given: Mapping[str, str]
    """Parameter → its text in the question; omitted parameters are missing."""


_PARAMETERS = {
    "thing": "[^?]+?",
    "other": "[^?]+?",
    "class": "[^?]+?",
    "distance": r"<number> ?((milli|centi)?met(er|re)s?|mm|cm|m)?",
    "mass": r"<number> ?(kilos?|(kilo)?grams?|kg|g)?",
    "position": r"-?<number>,? +-?<number>,? +-?<number>",
}
_POLITE = re.compile(
    r"(please|can you|could you|would you|tell me(?! about)|i want to know|do you know|hey|ok|so),?\s+", re.IGNORECASE
)
_APOSTROPHE = "\u2019"


@cache
def list_phrases() -> Sequence[tuple[str, re.Pattern[str]]]:
    """Return pairs of an id and the pattern of a whole question, in the order in which they are tried."""
    words: dict[str, str] = {name: f"(?P<{name}>{pattern})" for name, pattern in _PARAMETERS.items()}
    phrases = []
    for line in (files("usd2kg.assistant") / "phrases.txt").read_text("utf-8").splitlines():
        if definition := re.fullmatch(r"<(\w+)> = (.+)", line):
            words[definition[1]] = definition[2]
        elif phrase := re.fullmatch(r"([\w-]+): (.+)", line):
            phrases.append((phrase[1], re.compile(_expand(phrase[2], words), re.IGNORECASE)))
    return tuple(phrases)


def _expand(pattern: str, words: Mapping[str, str]) -> str:
    """Return a pattern with all `<word>` definitions expanded recursively; group names `(?P<name>` are kept."""
    while (expanded := re.sub(r"(?<!\?P)<(\w+)>", lambda found: words[found[1]], pattern)) != pattern:
        pattern = expanded
    return pattern


def match_phrase(text: str) -> Phrase | None:
    """Return the interpretation of a question; None if no pattern matches.

    >>> match_phrase("Please tell me, what's on the table?")
    Phrase(question='on', given={'thing': 'the table'})
    """
    asked = " ".join(text.replace(_APOSTROPHE, "'").split()).strip(" ?!.,")
    while polite := _POLITE.match(asked):
        asked = asked[polite.end() :]
    asked = re.sub(r"^(what|where)'s\b", r"\1 is", asked, flags=re.IGNORECASE)
    for question, pattern in list_phrases():
        if found := pattern.fullmatch(asked):
            return Phrase(question, {name: value.strip() for name, value in found.groupdict().items() if value})
    return None
