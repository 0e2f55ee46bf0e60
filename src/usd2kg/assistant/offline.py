"""ask_offline: a question in plain English, answered from the ready questions, without any model."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from usd2kg.assistant.describe import description_answer
from usd2kg.assistant.phrases import Phrase, match_phrase
from usd2kg.errors import GraphError
from usd2kg.query import Answer, GraphStore, term_list
from usd2kg.query.questions import list_questions

__all__ = ["InterpretedAnswer", "ask_offline"]

_LONG_UNITS = (("centimet", "cm"), ("millimet", "mm"), ("met", "m"), ("kilo", "kg"), ("gram", "g"))
_RELATED = {"on": "on", "in": "inside"}


@dataclass(frozen=True)
class InterpretedAnswer:
    """An answer, and how the question was understood."""

    understood: str
    """In words, for the person to check."""
    answer: Answer
    """Its table, and the SPARQL that gave it."""
    verdict: bool | None = None
    """Yes or no, where that was asked."""
    number: int | None = None
    """How many, where that was asked."""

    def as_json(self) -> dict[str, Any]:
        """Return how it was understood, and yes, no or a number where one of these was asked."""
        said = {"verdict": self.verdict, "number": self.number}
        return {"understood": self.understood, **{name: value for name, value in said.items() if value is not None}}

    def summary(self) -> str:
        """Return yes, no or a number on a line of its own, where one of these was asked; else nothing."""
        if self.number is not None:
            return f"{self.number}\n"
        return "" if self.verdict is None else "yes\n" if self.verdict else "no\n"


def ask_offline(graph: GraphStore, text: str) -> InterpretedAnswer:
    """Return the answer to a question in English, by the ready questions.

    Raises:
        GraphError: the question is not understood, or what it asks about is not in the graph.
    """
    phrase = match_phrase(text)
    if phrase is None:
        raise GraphError(
            f"question {text!r} is not understood; ask like 'what is on the table?', 'where is the kettle?', 'how many "
            "cups are there?' or 'what must be moved to open the drawer?' (usd2kg query --list has more), "
            "or let a model write the query with --model"
        )
    return _answer(graph, phrase)


_DISTANCE = """
SELECT ?object ?path ?other ?other_path ?distance_m WHERE {{
  VALUES ?a {{ {things} }} VALUES ?b {{ {others} }}
  ?a rdfs:label ?object ; u2k:primPath ?path . ?b rdfs:label ?other ; u2k:primPath ?other_path .
  BIND(u2kf:gap(?a, ?b) AS ?distance_m)
}} ORDER BY ?distance_m ?path"""


def _answer(graph: GraphStore, phrase: Phrase) -> InterpretedAnswer:
    question, given = phrase
    verb, _, relation = question.partition("-")
    if verb in {"count", "is", "some"} and relation in _RELATED:
        return _some_related(graph, verb, _RELATED[relation], given)
    if question in _OTHERS:
        return _OTHERS[question](graph, **given)
    if question in _SPOKEN:
        ask, words = _SPOKEN[question]
        named = given.get("thing") or given["class"]
        return InterpretedAnswer(f"{words} {named}", ask(graph, named))
    return _listed(graph, question, given)


def _how_many(graph: GraphStore, **given: str) -> InterpretedAnswer:
    answer = graph.where_is(given["class"])
    return InterpretedAnswer(f"all {given['class']}", answer, number=len(set(_column(answer, "path"))))


def _listed(graph: GraphStore, question: str, given: Mapping[str, str]) -> InterpretedAnswer:
    """Return the answer to a question of `usd2kg query --list`."""
    values = {name: _plain_value(name, value) for name, value in given.items()}
    text = next(q.text for q in list_questions() if q.id == question)
    told = ", ".join(f"{name} = {value}" for name, value in values.items())
    return InterpretedAnswer(f"{question}: {text}{f' with {told}' if told else ''}", graph.answer(question, values))


def _plain_value(name: str, value: str) -> str:
    if name == "position":
        return " ".join(value.replace(",", " ").split())
    if name in {"distance", "mass"}:
        number = value.rstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ ")
        unit = value[len(number) :].strip().lower()
        return f"{number} {next((short for long, short in _LONG_UNITS if unit.startswith(long)), unit)}".strip()
    return value


def _some_related(graph: GraphStore, verb: str, relation: str, given: Mapping[str, str]) -> InterpretedAnswer:
    """Return the things of a class, or of a name, that are on or in a thing, or on or in something there."""
    find = graph.on if relation == "on" else graph.inside
    related = find(given["thing"], is_direct=False)
    answer = _only(related, set(_column(graph.where_is(given["class"]), "path")))
    found = len(answer.rows)
    told = f"{given['class']} {relation} {given['thing']}"
    return InterpretedAnswer(told, answer, bool(found) if verb == "is" else None, found if verb == "count" else None)


def _some_parts(graph: GraphStore, **given: str) -> InterpretedAnswer:
    name, thing = given["class"], given["thing"]
    answer = _only(graph.parts_of(thing), set(_column(graph.where_is(name), "path")))
    return InterpretedAnswer(f"{name} that are parts of {thing}", answer, number=len(answer.rows))


def _is_there(graph: GraphStore, **given: str) -> InterpretedAnswer:
    name = given["class"]
    try:
        answer = graph.where_is(name)
    except GraphError:
        # That nothing is called so is the answer here.
        answer = Answer(("object",), (), (), "")
    return InterpretedAnswer(f"whether there is {name}", answer, bool(answer.rows))


def _distance(graph: GraphStore, thing: str, other: str) -> InterpretedAnswer:
    query = _DISTANCE.format(things=term_list(graph.find(thing)), others=term_list(graph.find(other)))
    return InterpretedAnswer(f"the gap between {thing} and {other}, in metres", graph.sparql(query))


def _only(answer: Answer, paths: set[str]) -> Answer:
    """Return the rows of an answer that are about the prims at these paths."""
    kept = [index for index, path in enumerate(_column(answer, "path")) if path in paths]
    return replace(answer, rows=tuple(answer.rows[i] for i in kept), values=tuple(answer.values[i] for i in kept))


def _column(answer: Answer, name: str) -> list[str]:
    at = answer.columns.index(name)
    return [row[at] or "" for row in answer.rows]


_SPOKEN: Mapping[str, tuple[Callable[[GraphStore, str], Answer], str]] = {
    "on": (GraphStore.on, "on"),
    "inside": (GraphStore.inside, "inside"),
    "near": (GraphStore.near, "near"),
    "above-of": (GraphStore.above, "above"),
    "parts": (GraphStore.parts_of, "parts of"),
    "where": (GraphStore.where_is, "where:"),
    "all": (GraphStore.all_of, "all of class"),
    "about": (description_answer, "all about"),
}
"""Question → how it is answered for what is named, and how it is told back."""
_OTHERS: Mapping[str, Callable[..., InterpretedAnswer]] = {
    "how-many": _how_many,
    "is-there": _is_there,
    "parts-of": _some_parts,
    "distance": _distance,
}
