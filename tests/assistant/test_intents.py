"""Questions that no pattern fits: by a cue and the noun phrases around it."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from usd2kg.assistant.intents import parse_intent
from usd2kg.assistant.phrases import Phrase


@pytest.mark.parametrize(
    ("text", "question", "given_words"),
    [
        ("hey, can you tell me where I'd find the info desk please", "where", {"thing": "info desk"}),
        ("Count the tablets for me, and I mean both kinds.", "how-many", {"class": "tablets"}),
        ("what is the width and depth of a low bookshelf", "measure", {"thing": "low bookshelf", "adjective": "size"}),
        ("wardrobe height", "measure", {"thing": "wardrobe", "adjective": "height"}),
        ("distance sofa armchair", "distance", {"thing": "sofa", "other": "armchair"}),
        (
            "how much space is there between the coffee table and the sofa",
            "distance",
            {"thing": "coffee table", "other": "sofa"},
        ),
        ("which burners have nothing on them", "all", {"class": "burners nothing on"}),
        ("robot, pick up the mug next to the kettle", "where", {"thing": "mug next to kettle"}),
        ("List everything red near the trash can", "all", {"class": "everything red near trash can"}),
    ],
)
def test_the_words_beside_the_cue_are_what_is_asked_about(text: str, question: str, given_words: dict[str, str]):
    found = parse_intent(text)
    assert found is not None
    assert (found.question, found.given) == (question, given_words)


@pytest.mark.parametrize("text", ["what brand is the microwave", "is the fridge running", "who lives here", ""])
def test_two_nouns_without_a_link_are_not_one_phrase(text: str):
    assert parse_intent(text) is None


@pytest.mark.parametrize("text", ["wie viele Stühle stehen hier", "où se trouve la chaise"])
def test_cues_of_other_languages_are_known_as_such(text: str):
    found = parse_intent(text)
    assert found is not None
    assert not found.is_english


@given(st.text(max_size=80))
def test_any_text_is_read_or_left(text: str):
    assert isinstance(parse_intent(text), Phrase | None)
