"""Sentences about things and numbers."""

import re
from collections import Counter
from collections.abc import Sequence

from usd2kg.assistant.settings import SENTENCES
from usd2kg.query.lookup import SceneFacts
from usd2kg.query.lookup.amounts import NUMBER_NAMES, NUMBER_WORDS
from usd2kg.query.lookup.prepositions import preposition_pattern
from usd2kg.query.lookup.word_forms import IRREGULAR_PLURALS

__all__ = [
    "agree",
    "begin_sentence",
    "count_phrase",
    "join_few",
    "join_words",
    "name_things",
    "number_text",
    "plural",
    "split_number",
    "the_thing",
    "yes_or_no",
]

_MODIFIED = re.compile(rf"(?P<noun>.+?)(?P<rest> (?:of|that|with|without|{preposition_pattern()}) .+)")
_SAME_PLURAL = frozenset(["cutlery", "equipment", "furniture", "scissors", "sheep", "stairs"])


_SINGULAR = {"are": "is", "do": "does", "have": "has", "were": "was"}
_VERB = re.compile(rf"that ({'|'.join([*_SINGULAR, *_SINGULAR.values()])})\b")
_PLACED = re.compile(rf"that (?:is|are) (?=(?:\w+ing )?(?:{preposition_pattern()})\b)")


def agree(said: str, count: int) -> str:
    """Return what a question says of things in the number of the things, and without a verb before a place.

    >>> agree("that are on the table", 2), agree("that have two drawers", 1), agree("that is red", 2)
    ('on the table', 'that has two drawers', 'that are red')
    """
    said = _PLACED.sub("", said)
    forms = _SINGULAR if count == 1 else {one: many for many, one in _SINGULAR.items()}
    return _VERB.sub(lambda found: f"that {forms.get(found[1], found[1])}", said)


def begin_sentence(text: str) -> str:
    """Return a text with its first letter as a capital; names keep their case."""
    return text[:1].upper() + text[1:]


def join_words(words: Sequence[str], last: str = "and") -> str:
    """Return words as a list in English.

    >>> join_words(["a cup", "a plate", "two forks"])
    'a cup, a plate and two forks'
    """
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} {last} {words[-1]}" if words else ""


def join_few(words: Sequence[str]) -> str:
    """Return the first few of some words as a list in English, and the number of the others.

    >>> join_few(["A", "B", "C", "D", "E", "F"])
    'A, B, C, D and 2 more'
    """
    rest = len(words) - SENTENCES.max_named
    return join_words([*words[: SENTENCES.max_named], *([f"{rest} more"] if rest > 0 else [])])


def yes_or_no(verdict: bool, reason: str) -> str:
    """Return a verdict with its reason, which is a sentence.

    >>> yes_or_no(True, "There is a cup.")
    'Yes: there is a cup.'
    """
    return f"{'Yes' if verdict else 'No'}: {reason[:1].lower()}{reason[1:]}"


def count_phrase(count: int, noun: str) -> str:
    """Return a number and a noun.

    >>> count_phrase(1, "oven"), count_phrase(2, "box"), count_phrase(20, "computer mouse"), count_phrase(0, "knife")
    ('an oven', 'two boxes', '20 computer mice', 'no knives')
    """
    if count == 1:
        return f"{'an' if noun[:1].lower() in 'aeiou' else 'a'} {noun}"
    number = NUMBER_NAMES[count] if count < len(NUMBER_NAMES) else str(count)
    return f"{number} {plural(noun)}"


def the_thing(kind: str, label: str) -> str:
    """Return a thing by its kind and name, or by one of them if the name is the kind or begins with it as a word.

    >>> the_thing("cup", "Mug_2"), the_thing("room", "room 1"), the_thing("table", "Table")
    ('the cup Mug_2', 'room 1', 'the table')
    """
    if label.lower() == kind.lower():
        return f"the {kind}"
    return label if label.lower().startswith(f"{kind.lower()} ") else f"the {kind} {label}"


def plural(noun: str) -> str:
    """Return the plural of a noun, approximately.

    >>> plural("knife"), plural("bookshelf"), plural("glass"), plural("chest of drawers"), plural("cup on table")
    ('knives', 'bookshelves', 'glasses', 'chests of drawers', 'cups on table')
    """
    if modified := _MODIFIED.fullmatch(noun):
        return f"{plural(modified['noun'])}{modified['rest']}"
    *before, last = noun.split()
    if last in _SAME_PLURAL or (last.endswith("s") and not last.endswith("ss")):
        return noun
    irregular = next((one for one in IRREGULAR_PLURALS if last.endswith(one)), None)
    if irregular is not None:
        many = last.removesuffix(irregular) + IRREGULAR_PLURALS[irregular]
    elif last.endswith(("s", "x", "z", "ch", "sh")):
        many = f"{last}es"
    elif last.endswith("y") and last[-2:-1] not in "aeiou":
        many = f"{last[:-1]}ies"
    else:
        many = f"{last}s"
    return " ".join([*before, many])


def name_things(facts: SceneFacts, iris: Sequence[str]) -> str:
    """Return what some objects are, by number and kind: two cups and a kettle."""
    counts = Counter(facts.kind(iri) for iri in iris)
    kinds = sorted(counts, key=lambda kind: (-counts[kind], kind))
    named = [count_phrase(counts[kind], kind) for kind in kinds[: SENTENCES.max_kinds]]
    if rest := sum(counts[kind] for kind in kinds[SENTENCES.max_kinds :]):
        named.append(count_phrase(rest, "other thing"))
    return join_words(named)


def split_number(text: str) -> tuple[int, str]:
    """Return the number before a noun, 1 without one, and the noun.

    >>> split_number("two mugs"), split_number("the 3 cups"), split_number("any cup")
    ((2, 'mugs'), (3, 'cups'), (1, 'any cup'))
    """
    first, _, rest = text.removeprefix("the ").partition(" ")
    number = NUMBER_WORDS.get(first.lower()) or (int(first) if first.isdecimal() else None)
    return (1, text) if number is None or not rest else (number, rest)


def number_text(value: float, unit: str) -> str:
    """Return a quantity with a suitable unit: metres below 1 as centimetres, kilograms below 1 as grams.

    >>> number_text(0.31, "m"), number_text(1.85, "m"), number_text(0.4, "kg"), number_text(3900, "kg")
    ('31 cm', '1.85 m', '400 g', '3,900 kg')
    >>> number_text(180.5, "kg"), number_text(180, "kg")
    ('180.5 kg', '180 kg')
    """
    if unit == "m" and abs(value) < 1:
        return f"{value * 100:.3g} cm"
    if unit == "kg" and abs(value) < 1:
        return f"{value * 1000:.3g} g"
    if abs(value) >= 1000:
        return f"{value:,.0f} {unit}"
    number = f"{value:.1f}".removesuffix(".0") if abs(value) >= 100 else f"{value:.3g}"
    return f"{number} {unit}"
