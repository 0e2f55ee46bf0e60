"""A word that changes what is asked never gets the answer without it: it is refused, or the answer says so."""

from collections.abc import Mapping

import pytest

from tests.assistant.question_variants import GOOD_QUESTIONS, variants
from usd2kg.assistant import ask_offline
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.errors import GraphError
from usd2kg.query import GraphStore

_SAID = ("Not taken into account:", "not about another time", "was read as", "excludes nothing")


@pytest.fixture(scope="module")
def good_answers(kitchen: GraphStore) -> Mapping[str, InterpretedAnswer]:
    return {text: ask_offline(kitchen, text) for text in GOOD_QUESTIONS}


@pytest.mark.parametrize("every", [7, pytest.param(1, marks=pytest.mark.slow)])
def test_no_modifier_is_left_out_in_silence(
    kitchen: GraphStore, good_answers: Mapping[str, InterpretedAnswer], every: int
):
    asked = [(good, text) for good, text, _ in variants()][::every]
    silent = []
    for good, text in asked:
        try:
            found = ask_offline(kitchen, text)
        except GraphError:
            continue
        usual = good_answers[good]
        is_same = (found.verdict, found.number, found.answer.rows) == (usual.verdict, usual.number, usual.answer.rows)
        if is_same and not any(note in found.sentence for note in _SAID):
            silent.append(text)
    assert len(asked) > 600 / every
    assert not silent


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("I am hungry, where is the kettle?", "Not taken into account: “I am hungry”."),
        ("where was the kettle?", "The answer is about the scene as it is, not about another time."),
        ("where is the breakfast toaster?", "“breakfast toaster” was read as “toaster”"),
        ("what does the breakfast toaster stand on?", "“breakfast toaster” was read as “toaster”"),
    ],
)
def test_the_answer_says_what_it_leaves_out(kitchen: GraphStore, text: str, said: str):
    assert said in ask_offline(kitchen, text).sentence


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("if I take the toaster away, where is the kettle?", "if"),
        ("where is the second kettle?", "second"),
        ("where is the kettle, not the pot?", "not"),
        ("how many more apples are there?", "more"),
    ],
)
def test_a_refusal_names_the_word(kitchen: GraphStore, text: str, word: str):
    with pytest.raises(GraphError, match=f"'.*{word}"):
        ask_offline(kitchen, text)
