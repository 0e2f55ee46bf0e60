"""Questions whose meaning a modifier changes, made by rule from questions that are answered."""

from collections.abc import Iterator
from typing import NamedTuple

__all__ = ["GOOD_QUESTIONS", "Variant", "variants"]

GOOD_QUESTIONS = (
    "what is on the bar table?",
    "what is in the fridge?",
    "how many cups are on the bar table?",
    "where is the kettle?",
    "how tall is the fridge?",
    "how far is the toaster from the kettle?",
    "is there a cup on the bar table?",
    "is the kettle on the worktop?",
    "is the fridge taller than the toaster?",
    "list all the chairs",
    "which chair is nearest to the fridge?",
    "where can I put the toaster?",
    "is there a piano?",
    "what must be moved to open the fridge?",
    "which lamp hangs lowest?",
)
"""Questions about the demo kitchen."""
_BEFORE = (
    "why",
    "who knows why",
    "since when",
    "if I take the toaster away,",
    "unless the fridge is closed,",
    "after I move the kettle,",
    "supposing the fridge was gone,",
)
_AFTER = (
    "except the kettle",
    "apart from the plates",
    "but not the kettle",
    "if I take the toaster away",
    "yesterday",
    "last week",
    "tomorrow",
    "before lunch",
    "when it rains",
    "instead of the kettle",
    "unless it is closed",
    "and who put it there",
    "and why",
    "only on sundays",
    "half of the time",
    "according to the manual",
    "without the plate",
    "twice",
    "for the last time",
)
_ADJECTIVES = (
    "broken",
    "expensive",
    "borrowed",
    "second",
    "other",
    "dirty",
    "wrong",
    "missing",
    "only",
    "same",
    "average",
)
_NOUNS = (
    "bar table", "fridge", "cups", "apples", "kettle", "toaster", "broom", "cup", "worktop", "chairs", "chair", "sink",
    "knives", "lamp",
)  # fmt: skip
_VERBS = (
    ("is", "is not"),
    ("are", "are not"),
    ("is", "was"),
    ("is", "will be"),
    ("is", "should be"),
    ("is", "is almost"),
    ("is", "is usually"),
    ("is", "is no longer"),
    ("are", "were"),
    ("are", "would be"),
    ("are", "could be"),
    ("how many", "how many more"),
    ("how many", "how few of the"),
    ("how many", "how many percent of"),
    ("a cup", "exactly three cups"),
    ("a cup", "no cup"),
    ("a cup", "only one cup"),
    ("a piano", "no piano"),
    ("the kettle", "either the kettle or the toaster"),
    ("the kettle", "neither the kettle nor the toaster"),
    ("the kettle", "every kettle but one"),
    ("taller", "much taller"),
    ("taller", "twice as tall"),
    ("taller", "not taller"),
    ("taller", "half a metre taller"),
    ("nearest", "second nearest"),
    ("nearest", "least near"),
    ("lowest", "second lowest"),
)


class Variant(NamedTuple):
    """A question and the one that it was made from."""

    good: str
    text: str
    modifier: str


def variants() -> Iterator[Variant]:
    """Yield each question with each modifier that fits it."""
    for good in GOOD_QUESTIONS:
        bare = good.removesuffix("?")
        for words in _BEFORE:
            yield Variant(good, f"{words} {bare}?", words)
        for words in _AFTER:
            yield Variant(good, f"{bare} {words}?", words)
        for noun in _NOUNS:
            if f" {noun}" in bare and (bare.endswith(noun) or f" {noun} " in bare):
                for word in _ADJECTIVES:
                    yield Variant(good, bare.replace(f" {noun}", f" {word} {noun}", 1) + "?", word)
        for old, new in _VERBS:
            if f" {old} " in f" {bare} ":
                yield Variant(good, f" {bare} ".replace(f" {old} ", f" {new} ", 1).strip() + "?", new)
