"""respelled: a question with its misspelt words corrected."""

from functools import cache

from rapidfuzz import process
from rapidfuzz.distance import OSA

from usd2kg.assistant.composition.words import is_function_word
from usd2kg.grounding import is_english_word
from usd2kg.knowledge import read_cells, word_map, word_set
from usd2kg.query.lookup import Nouns

__all__ = ["respelled"]

_SHORTEST = 5
"""Letters of the shortest word that is corrected: too many short words are one letter apart."""
_LONG = 8
"""Letters of a word in which two may be wrong."""
_GRAMMAR = (
    *(("grammar", name) for name in ("adverbs", "holding_verbs", "place_verbs", "requests")),
    *(("query", name) for name in ("question_words", "operators", "empty_adjectives")),
)


def respelled(text: str, nouns: Nouns) -> str | None:
    """Return a question with the words that neither English nor the graph has replaced by the nearest that one has.

    None if all words are known, or one of them has no nearest word.
    """
    words = text.split()
    found = [_corrected(word, nouns) for word in words]
    return None if None in found or found == words else " ".join(filter(None, found))


def _corrected(written: str, nouns: Nouns) -> str | None:
    """Return a word as it is if it is known, else the nearest of the graph, or of everyday words; None without one."""
    core = written.strip("?!.,;:\"'“”()")
    word = core.lower()
    if not word.isalpha() or core[1:] != word[1:] or len(word) < _SHORTEST or _is_known(word, nouns):
        return written
    most = 1 + (len(word) >= _LONG)
    for vocabulary in (nouns.vocabulary, _everyday_words()):
        near = process.extract(word, vocabulary, scorer=OSA.distance, score_cutoff=most, limit=2)
        if len(near) == 1 or (near and near[0][1] < near[1][1]):
            return written.replace(core, near[0][0])
        if near:
            return None
    return None


def _is_known(word: str, nouns: Nouns) -> bool:
    return is_function_word(word) or word in _everyday_words() or nouns.knows(word) or is_english_word(word)


@cache
def _everyday_words() -> tuple[str, ...]:
    """Return the words of the grammar, and the nouns of everyday objects in the singular and in the plural."""
    grammar = {word for table, name in _GRAMMAR for phrase in word_set(table, name) for word in phrase.split()}
    nouns = {word for noun, _ in read_cells("everyday_objects.csv", "noun", "places") for word in noun.split()}
    prepositions = {word for phrase in word_map("query", "relation_words") for word in phrase.split()}
    words = {*grammar, *prepositions, *nouns, *(f"{noun}s" for noun in nouns)}
    return tuple(sorted(word for word in words if word.isalpha() and len(word) >= _SHORTEST))
