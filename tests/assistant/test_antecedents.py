"""Pronouns: what was named before takes their place."""

import pytest

from usd2kg.assistant import ask_offline
from usd2kg.assistant.antecedents import with_antecedent
from usd2kg.query import GraphStore

THINGS = {"bucket", "sink", "lamp", "lamps", "table", "cup", "like", "bar table"}


@pytest.mark.parametrize(
    ("question", "read"),
    [
        # The subject of a clause is meant, and where it is belongs to it.
        ("The bucket under the sink, what is inside of it?", "what is inside of the bucket under the sink"),
        ("There is a cup on the table. Where is it?", "Where is the cup on the table"),
        ("The lamp: what is it fastened to?", "what is the lamp fastened to"),
        # What follows a preposition is meant where nothing else is named.
        ("I sat at the table, how high is it?", "how high is the table"),
        ("The lamps by the sink, how many of them are on?", "how many of the lamps by the sink are on"),
        # A verb is no noun, and the longest noun is read.
        ("I'd like a lamp, where can I find one?", "where can I find the lamp"),
        ("We wiped the bar table, is it wide?", "is the bar table wide"),
        # The nearer of two clauses.
        ("The lamp is old. The cup is new. Where is it?", "Where is the cup"),
    ],
)
def test_the_noun_takes_the_place_of_the_pronoun(question: str, read: str):
    assert with_antecedent(question, THINGS.__contains__) == read


@pytest.mark.parametrize("question", ["Where is it?", "The lamps are old, where is it?", "The lamp, where is the cup?"])
def test_without_a_noun_in_the_same_number_there_is_no_reading(question: str):
    assert with_antecedent(question, THINGS.__contains__) is None


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        ("The vase on the sideboard, what is it standing on?", "Vase on sideboard is on the cupboard Cuboard."),
        # Alone, the last clause would be about a fastener: the wall socket.
        ("The clock: what is it fastened to?", "There is a wall."),
    ],
)
def test_a_reading_that_uses_all_words_is_preferred(kitchen: GraphStore, question: str, answer: str):
    assert ask_offline(kitchen, question).sentence == answer
