"""One table says which relation a preposition means, for questions, short questions and noun phrases."""

import pytest

from usd2kg.assistant.phrases import match_phrases
from usd2kg.query.lookup.object_columns import _RELATIONS as COLUMNS
from usd2kg.query.lookup.prepositions import RELATION_OF, preposition_pattern
from usd2kg.query.query_templates import ABOVE, ATTACHED, INSIDE, NEAR, ON, parse_question

SHORT = {"on": ON, "inside": INSIDE, "attached": ATTACHED, "near": NEAR, "above": ABOVE}


def test_all_relations_are_stated_or_measured():
    assert set(RELATION_OF.values()) - COLUMNS.keys() == {"below"}


@pytest.mark.parametrize(("word", "relation"), [item for item in RELATION_OF.items() if item[1] in SHORT])
def test_short_questions_know_the_preposition(word: str, relation: str):
    assert parse_question([word, "the table"]) == (SHORT[relation], "the table")


# Questions read “are hanging” as the verb, and what is on a wall is what hangs there.
@pytest.mark.parametrize("word", [word for word in RELATION_OF if not word.startswith(("hang", "mounted"))])
def test_questions_know_the_preposition(word: str):
    phrase = next(iter(match_phrases(f"how many cups {word} table")), None)
    assert phrase is not None
    assert phrase.given == {"class": "cups", "relation": word, "thing": "table"}


def test_longer_prepositions_come_before_their_beginnings():
    words = preposition_pattern().split("|")
    assert sorted(words, key=len, reverse=True) == sorted(words, key=lambda word: (-len(word), word))
    assert words.index("on top of") < words.index("on")
