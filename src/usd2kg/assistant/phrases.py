"""match_phrases: question → question type and its parameters, by the patterns in `phrases.txt`."""

import re
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from itertools import count
from typing import NamedTuple

from usd2kg.query.lookup.amounts import NUMBER_WORDS
from usd2kg.query.lookup.prepositions import DIRECTLY, preposition_pattern

__all__ = ["HEADINGS", "Phrase", "crosses_clauses", "list_phrases", "match_phrases", "normalize", "split_clauses"]


class Phrase(NamedTuple):
    """A question that was understood."""

    question: str
    """Id in `phrases.txt`: that of a ready question, or another such as `where`, `how-many`, `rel-what`."""
    given: Mapping[str, str]
    """Parameter → its text in the question; omitted parameters are missing."""
    is_english: bool = True
    left: tuple[str, ...] = ()
    """Parts of the question that the interpretation does not use: other clauses, and what `.*` of a pattern matched."""


_PARAMETERS = {
    "thing": "[^?]+?",
    "other": "[^?]+?",
    "class": "[^?]+?",
    # “Within two metres of” is a distance.
    "relation": rf"(?:{DIRECTLY})?(?!within (?:\d|an? |half |{'|'.join(NUMBER_WORDS)}))(?:{preposition_pattern()})",
    "distance": r"<number> ?((milli|centi)?met(er|re)s?|mm|cm|m)?",
    "amount": r"<number> ?([a-z]+|\")",
    "sides": r"<number>( ?[a-z]+)? ?(by|x|×) ?<number>( ?[a-z]+)?( ?(by|x|×) ?<number> ?[a-z]+)?",
    "mass": r"<number> ?(kilos?|(kilo)?grams?|kg|g)?",
    "position": r"-?<number>,? +-?<number>,? +-?<number>",
}
_POLITE = re.compile(
    r"(please|pls|(can|could) you(?! (see|find|spot|have)\b)|would you|"
    r"tell me(?! about)|is it true that|can it be that|(can|could) (someone|somebody|anyone|anybody) (tell me|say)|"
    r"(i|we) (want|need|would like|have) to know|i'd like to know|i wonder|"
    r"(does|do) (you|anyone|anybody|someone|somebody) know|"
    r"let me know|"
    r"find out|check|see|hey|hi|hello|robot|ok|okay|oh|so|well|sorry|excuse me|"
    r"for (my|the|our) (report|records?|notes|list|plan|drawing|inventory)|"
    r"and|bitte|s'il te plaît|por favor|per favore),?\s+(please )?",
    re.IGNORECASE,
)
_TRAILING = re.compile(
    r",?\s+(please|pls|thanks|thank you|bitte|in total|altogether|all together|overall|in all|anywhere|at all|exactly|"
    r"right now|just now|now|at the moment|at present|currently|for me|yes or no|or not|i mean|right|correct|or what|"
    r"(is not|are not) (it|there|they)|"
    r"if (you have|there is|there's) (one|any|some)|what are my options|any ideas?|what do you (suggest|think))$",
    re.IGNORECASE,
)
_TOGETHER = re.compile(
    r"^(?:how (?:much|heavy)|what) (?:do|does|are|is) (?P<thing>.+?)(?: weigh)?,? "
    r"(?:in total|altogether|all together|together|combined|overall|in all)$",
    re.IGNORECASE,
)
"""Asks for a sum of weights."""
_COMMENT = re.compile(
    r",\s+(?:[^,]+ (?:together|altogether|included|combined|counted|in total)|(?:including|counting) [^,]+)$",
    re.IGNORECASE,
)
"""A remark on what is counted, which does not change the question: `doors, folding doors included`."""
_HERE = re.compile(r"\s+(right here|in here|here in this room|(around|over|somewhere) here)\b", re.IGNORECASE)
_PLACED = re.compile(
    r"(?<=\w )(?<!been )(?<!be )(standing|set|lying|sitting|hanging|resting|placed|located|mounted|positioned|kept|"
    r"stored|loaded|left|dropped|stacked|parked|put|found|hidden|piled) "
    r"(?=(on|in|inside|at|by|near|under|next|beside|below|above|behind|between) \S)",
    re.IGNORECASE,
)
"""Participles that add nothing to the preposition after them."""
_CONTRACTIONS = (
    (re.compile(r"\b(is|are|was|were)n'?t\b", re.IGNORECASE), r"\1 not"),
    (re.compile(r"^((?:what|which) \w+)'s (?=(?:the|my|our|this|that|these|those)\b)", re.IGNORECASE), r"\1 is "),
)
"""Contracted forms, and the words that they stand for."""
HEADINGS = {"# German, French, Spanish and Italian.": False, "# English.": True}
"""Heading of patterns → whether they are English."""
_LEFT = "left_"
"""Begins the names of groups for what a pattern leaves out."""
_CLAUSE_END = re.compile(r"[,;!?:] | -+ ")
_APOSTROPHE = "\u2019"


@cache
def list_phrases() -> Sequence[tuple[str, re.Pattern[str], bool]]:
    """Return the id, the pattern of a whole question, and whether it is English, in the order of trial."""
    words: dict[str, str] = {name: f"(?P<{name}>{pattern})" for name, pattern in _PARAMETERS.items()}
    phrases = []
    is_english = True
    for line in (files("usd2kg.assistant") / "phrases.txt").read_text("utf-8").splitlines():
        if definition := re.fullmatch(r"<(\w+)> = (.+)", line):
            words[definition[1]] = definition[2]
        elif line in HEADINGS:
            is_english = HEADINGS[line]
        elif phrase := re.fullmatch(r"([\w-]+): (.+)", line):
            phrases.append((phrase[1], re.compile(_expand(phrase[2], words), re.IGNORECASE), is_english))
    return tuple(phrases)


def _expand(pattern: str, words: Mapping[str, str]) -> str:
    """Return a pattern with all `<word>` definitions expanded recursively; group names `(?P<name>` are kept."""
    while (expanded := re.sub(r"(?<!\?P)<(\w+)>", lambda found: words[found[1]], pattern)) != pattern:
        pattern = expanded
    numbers = count()
    return re.sub(r"\.[*+]\??", lambda found: f"(?P<{_LEFT}{next(numbers)}>{found[0]})", pattern)


def match_phrases(text: str) -> list[Phrase]:
    """Return the interpretations of a question by the first pattern that matches all of it, and each of its clauses.

    >>> match_phrases("Please tell me, what's on the table?")
    [Phrase(question='rel-what', given={'relation': 'on', 'thing': 'the table'}, is_english=True, left=())]
    """
    whole = normalize(text)
    clauses = split_clauses(whole)
    # A remark before or after the question: I have some rubbish, where can I throw it away?
    found = [
        _match(whole),
        *(_match(clause, (*clauses[:at], *clauses[at + 1 :])) for at, clause in reversed([*enumerate(clauses)])),
    ]
    # A noun over two clauses is the last resort: where is the oven, please?
    return sorted((phrase for phrase in found if phrase is not None), key=crosses_clauses)


def crosses_clauses(phrase: Phrase) -> bool:
    """Return whether a parameter of an interpretation is in more than one clause."""
    return any(_CLAUSE_END.search(value) for value in phrase.given.values())


def _match(asked: str, others: Sequence[str] = ()) -> Phrase | None:
    for question, pattern, is_english in list_phrases():
        if found := pattern.fullmatch(asked):
            groups = {name: value.strip() for name, value in found.groupdict().items() if value}
            given = {name: value for name, value in groups.items() if not name.startswith(_LEFT)}
            unused = [value for name, value in groups.items() if name.startswith(_LEFT) and value]
            return Phrase(question, given, is_english, (*others, *unused))
    return None


def split_clauses(text: str) -> list[str]:
    """Return the clauses of a question, normalised; none if it is a single one.

    >>> split_clauses("I have some rubbish, where can I throw it away")
    ['I have some rubbish', 'where can I throw it away']
    """
    clauses = [clause for part in re.split(r"[,;.!?:]+ | -+ ", text) if (clause := normalize(part))]
    return clauses if len(clauses) > 1 else []


def normalize(text: str) -> str:
    """Return a question on one line, without what is only polite."""
    asked = " ".join(text.replace(_APOSTROPHE, "'").split()).strip(" ?!.,¿¡")
    for contraction, words in _CONTRACTIONS:
        asked = contraction.sub(words, asked)
    whole = asked
    while polite := _POLITE.match(asked):
        asked = asked[polite.end() :]
    if asked != whole:
        # “If” is a part of “tell me if”; alone, it begins a condition.
        asked = re.sub(r"^(if|whether) ", "", asked, flags=re.IGNORECASE)
    asked = _TOGETHER.sub(r"total weight of \g<thing>", asked)
    while (shorter := _TRAILING.sub("", asked).strip(" ?!.,")) != asked:
        asked = shorter
    asked = _COMMENT.sub("", asked).strip(" ?!.,")
    asked = re.sub(
        r"\b((directly|immediately) (?=(above|below|under|over|behind|next|beside)\b)|"
        r"exactly (?=(above|below|under|over|on|in|behind|next|beside)\b))",
        "",
        asked,
    )
    asked = _PLACED.sub("", re.sub(r"\b[ld]'(?=\w)", "", asked, flags=re.IGNORECASE))
    asked = re.sub(
        r"\s+(right here|in here|here in this room|(around|over|somewhere) here)\b", "", asked, flags=re.IGNORECASE
    )
    asked = re.sub(
        r"^(which|what)( one)? of (the |these |those )?(two |three |four )?", r"\1 ", asked, flags=re.IGNORECASE
    )
    asked = re.sub(r"\b(that'?s|which'?s) ", "that is ", asked, flags=re.IGNORECASE)
    if not re.search(r"\b(than|or)\b", asked):
        asked = re.sub(r"\b(closer|nearer) (?=to\b)", "nearest ", asked, flags=re.IGNORECASE)
    return re.sub(r"^(what|where)(?:'s|s)\b", r"\1 is", asked, flags=re.IGNORECASE)
