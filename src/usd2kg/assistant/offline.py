"""ask_offline: answer a question in English with the ready questions, without a language model."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from usd2kg.assistant.describe import description_answer
from usd2kg.assistant.phrases import Phrase, match_phrase
from usd2kg.errors import GraphError
from usd2kg.query import Answer, GraphStore, term_list
from usd2kg.query.questions import list_questions

__all__ = ["InterpretedAnswer", "ask_offline"]

_UNITS = (("centimet", "cm"), ("millimet", "mm"), ("met", "m"), ("kilo", "kg"), ("gram", "g"))
"""Beginning of a unit's name → symbol, tried in order."""
_RELATIONS = {"on": "on", "in": "inside"}
"""Suffix of a phrase id → relation."""


@dataclass(frozen=True)
class InterpretedAnswer:
    """An answer with the interpretation of its question."""

    understood: str
    """The interpretation in English, for the user to check."""
    answer: Answer
    verdict: bool | None = None
    """Answer to a yes/no question; None for other questions."""
    number: int | None = None
    """Answer to "how many"; None for other questions."""

    def as_json(self) -> dict[str, Any]:
        """Return the interpretation, with the verdict or the number if there is one."""
        result = {"verdict": self.verdict, "number": self.number}
        return {"understood": self.understood, **{key: value for key, value in result.items() if value is not None}}

    def summary(self) -> str:
        """Return yes, no or the number as one line; empty for other questions."""
        if self.number is not None:
            return f"{self.number}\n"
        return "" if self.verdict is None else "yes\n" if self.verdict else "no\n"


def ask_offline(graph: GraphStore, text: str) -> InterpretedAnswer:
    """Return the answer to a question in English.

    Raises:
        GraphError: the question is not understood, or its object or class is not in the graph.
    """
    phrase = match_phrase(text)
    if phrase is None:
        raise GraphError(
            f"question {text!r} is not understood; expected a question like 'what is on the table?', 'where is the "
            "kettle?', 'how many cups are there?' or 'what must be moved to open the drawer?' (usd2kg query --list "
            "shows more); or let a language model write the query with --model"
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
    if verb in {"count", "is", "some"} and relation in _RELATIONS:
        return _related_objects(graph, verb, _RELATIONS[relation], given)
    if question in _INTERPRETERS:
        return _INTERPRETERS[question](graph, **given)
    if question in _LOOKUPS:
        look_up, words = _LOOKUPS[question]
        name = given.get("thing") or given["class"]
        return InterpretedAnswer(f"{words} {name}", look_up(graph, name))
    return _ready_question(graph, question, given)


def _ready_question(graph: GraphStore, question: str, given: Mapping[str, str]) -> InterpretedAnswer:
    """Return the answer to one of the questions that `usd2kg query --list` lists."""
    values = {name: _normalize(name, value) for name, value in given.items()}
    text = next(q.text for q in list_questions() if q.id == question)
    parameters = ", ".join(f"{name} = {value}" for name, value in values.items())
    understood = f"{question}: {text}{f' with {parameters}' if parameters else ''}"
    return InterpretedAnswer(understood, graph.answer(question, values))


def _normalize(name: str, value: str) -> str:
    """Return a parameter value with unit symbols for unit names; a position without commas."""
    if name == "position":
        return " ".join(value.replace(",", " ").split())
    if name in {"distance", "mass"}:
        number = value.rstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ ")
        unit = value[len(number) :].strip().lower()
        return f"{number} {next((symbol for prefix, symbol in _UNITS if unit.startswith(prefix)), unit)}".strip()
    return value


def _related_objects(graph: GraphStore, verb: str, relation: str, given: Mapping[str, str]) -> InterpretedAnswer:
    """Return the objects with a class or name that are on or in another object, directly or indirectly."""
    find = graph.on if relation == "on" else graph.inside
    related = find(given["thing"], is_direct=False)
    answer = _restrict(related, set(_column(_find_any(graph, given["class"]), "path")))
    count = len(answer.rows)
    understood = f"{given['class']} {relation} {given['thing']}"
    return InterpretedAnswer(
        understood, answer, bool(count) if verb == "is" else None, count if verb == "count" else None
    )


def _how_many(graph: GraphStore, **given: str) -> InterpretedAnswer:
    answer = _find_any(graph, given["class"])
    return InterpretedAnswer(f"all {given['class']}", answer, number=len(set(_column(answer, "path"))))


def _how_many_parts(graph: GraphStore, **given: str) -> InterpretedAnswer:
    name, thing = given["class"], given["thing"]
    answer = _restrict(graph.parts_of(thing), set(_column(_find_any(graph, name), "path")))
    return InterpretedAnswer(f"{name} that are parts of {thing}", answer, number=len(answer.rows))


def _is_there(graph: GraphStore, **given: str) -> InterpretedAnswer:
    name = given["class"]
    answer = _find_any(graph, name)
    return InterpretedAnswer(f"whether there is {name}", answer, bool(answer.rows))


def _find_any(graph: GraphStore, name: str) -> Answer:
    """Return where the objects of a name are; a name of no object is the answer “no” or 0, not an error."""
    try:
        return graph.where_is(name)
    except GraphError:
        return Answer(("object", "path"), (), (), "")


def _distance(graph: GraphStore, thing: str, other: str) -> InterpretedAnswer:
    query = _DISTANCE.format(things=term_list(graph.find(thing)), others=term_list(graph.find(other)))
    return InterpretedAnswer(f"the gap between {thing} and {other}, in metres", graph.sparql(query))


def _restrict(answer: Answer, paths: set[str]) -> Answer:
    """Return the rows of an answer whose `path` is one of the given prim paths."""
    kept = [index for index, path in enumerate(_column(answer, "path")) if path in paths]
    return replace(answer, rows=tuple(answer.rows[i] for i in kept), values=tuple(answer.values[i] for i in kept))


def _column(answer: Answer, name: str) -> list[str]:
    at = answer.columns.index(name)
    return [row[at] or "" for row in answer.rows]


_LOOKUPS: Mapping[str, tuple[Callable[[GraphStore, str], Answer], str]] = {
    "on": (GraphStore.on, "on"),
    "inside": (GraphStore.inside, "inside"),
    "near": (GraphStore.near, "near"),
    "above-of": (GraphStore.above, "above"),
    "parts": (GraphStore.parts_of, "parts of"),
    "where": (GraphStore.where_is, "where:"),
    "all": (GraphStore.all_of, "all of class"),
    "about": (description_answer, "all about"),
}
"""Phrase id → method that takes a name, and the beginning of `understood`."""
_INTERPRETERS: Mapping[str, Callable[..., InterpretedAnswer]] = {
    "how-many": _how_many,
    "is-there": _is_there,
    "parts-of": _how_many_parts,
    "distance": _distance,
}
