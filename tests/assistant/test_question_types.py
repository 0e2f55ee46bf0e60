"""Every question type has a method or is a ready question."""

import re
from importlib.resources import files

from tests.graph.records import build_graph, open_store, thing
from usd2kg.assistant.offline import _Answerer
from usd2kg.assistant.phrases import list_phrases
from usd2kg.assistant.units import Units
from usd2kg.ontology import TBox
from usd2kg.query.questions import list_questions


def cue_types() -> set[str]:
    lines = (files("usd2kg.assistant") / "intents.txt").read_text("utf-8").splitlines()
    return {found[1] for line in lines if (found := re.match(r"([\w-]+) (class|thing|pair): ", line))}


def test_each_question_type_can_be_answered(home_tbox: TBox):
    graph = open_store(build_graph(home_tbox, [(thing("/Room/cup", (0, 0, 0), (0.1, 0.1, 0.1)), "Cup")]))
    answerer = _Answerer(graph, is_english=True, units=Units(""), since=None)
    ready = {question.id for question in list_questions()}
    types = {question for question, _, _ in list_phrases()} | cue_types()
    assert len(types) > 60
    assert [question for question in sorted(types - ready) if answerer.find(question) is None] == []
