"""Questions in German, French, Spanish and Italian that are translated by the words of the grammar."""

import pytest

from usd2kg.assistant import ask_offline
from usd2kg.assistant.foreign_questions import in_english
from usd2kg.errors import GraphError
from usd2kg.query import GraphStore


@pytest.mark.parametrize(
    ("question", "english"),
    [
        ("Wo kann ich den Topf hinstellen?", "where can i put the pot"),
        ("Wo finde ich einen Tacker?", "where can i find a stapler"),
        ("Wie viele Teller stehen auf dem Esstisch?", "how many plates stand on the dining table"),
        ("Qual è la sedia più alta?", "which is the tallest chair"),
        ("La silla es más alta que la mesa", "the chair is taller than the table"),
        ("Il y a combien de chaises autour de la table ?", "how many chairs around the table"),
        ("Où est-ce que je peux trouver l'armoire ?", "where can i find the wardrobe"),
        ("Quanto è largo il tavolo?", "how wide is the table"),
        ("¿Qué hay debajo de Desk_A1?", "what is there under Desk_A1"),
        ("Cosa c'è nel frigorifero?", "what is there in the refrigerator"),
        ("Zeig mir alle Töpfe ohne Deckel", "show me all pots without lid"),
    ],
)
def test_words_and_their_order(question: str, english: str):
    assert in_english(question) == english


@pytest.mark.parametrize(
    "question",
    [
        "what is in the fridge?",
        "is there a can on the table?",
        "die cast car in a box?",
        "List me all chairs",
        "Fridge?",
    ],
)
def test_english_is_not_translated(question: str):
    assert in_english(question) is None


def test_the_answer_says_how_the_question_was_read(kitchen: GraphStore):
    found = ask_offline(kitchen, "Welcher Stuhl steht am nächsten am Heizkörper?")
    assert [row[0] for row in found.answer.rows] == ["silla_3"]
    assert "ead as “which chair stands nearest to the radiator”" in found.sentence


def test_nothing_follows_from_a_translation(kitchen: GraphStore):
    with pytest.raises(GraphError, match="read as “which pianos are on the table”"):
        ask_offline(kitchen, "Quali pianoforti sono sul tavolo?")


def test_a_place_is_not_left_out(kitchen: GraphStore):
    with pytest.raises(GraphError, match="No apples are in the fridge"):
        ask_offline(kitchen, "Combien de pommes y a-t-il dans le réfrigérateur ?")
    assert ask_offline(kitchen, "¿Cuántas manzanas hay en la mesa?").number == 4
