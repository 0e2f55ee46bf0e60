"""Other wordings of a question mean the same; what has another meaning is left as it is."""

import pytest

from usd2kg.assistant.paraphrases import paraphrases


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Out of all mugs, which one is furthest away from the sink?", "which mugs is furthest from the sink"),
        ("I'm at the sink; which cup do I reach first?", "which cup is nearest to the sink"),
        ("which way to the sink?", "where is the sink"),
        ("the sink is how wide?", "how wide is the sink"),
        ("is the sink over two metres wide?", "is the sink wider than two metres"),
        ("Between sofa and table, how big the gap is?", "distance between sofa and table"),
        ("hw many cups r there", "how many cups are there"),
        ("on the table, what is there?", "what is there on the table"),
    ],
)
def test_a_wording_is_offered(text: str, expected: str):
    assert expected in [*paraphrases(text)]


@pytest.mark.parametrize(
    "text",
    [
        "where is the cup?",
        "what is opposite the table?",
        # The pronoun means what was named; the clauses stay apart.
        "the bin, what is it standing on?",
    ],
)
def test_clauses_with_a_pronoun_and_known_forms_are_not_joined(text: str):
    assert not any("," not in other for other in paraphrases(text))
