"""ask_offline: a question in plain English, answered from the ready questions, without any model."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from usd2kg.assistant.describe import description_answer
from usd2kg.assistant.phrases import Phrase, match_phrase
from usd2kg.errors import GraphError
from usd2kg.graph import Answer, GraphStore, list_questions

__all__ = ["AskedAnswer", "ask_offline"]

_LONG_UNITS = (("centimet", "cm"), ("millimet", "mm"), ("met", "m"), ("kilo", "kg"), ("gram", "g"))
_RELATED = {"on": "on", "in": "inside"}


@dataclass(frozen=True)
class AskedAnswer:
    """An answer, and how the question was understood."""

    understood: str
    """In words, for the person to check."""
    answer: Answer
    """Its table, and the SPARQL that gave it."""
    verdict: bool | None = None
    """Yes or no, where that was asked."""


def ask_offline(graph: GraphStore, text: str) -> AskedAnswer:
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


def _answer(graph: GraphStore, phrase: Phrase) -> AskedAnswer:
    question, given = phrase
    verb, _, relation = question.partition("-")
    if verb in {"count", "is", "some"} and relation in _RELATED:
        return _some_related(graph, verb, _RELATED[relation], given)
    if question == "how-many":
        answer = graph.all_of(given["class"])
        return AskedAnswer(f"all of class {given['class']}, counted", answer)
    simple = {
        "on": graph.on,
        "inside": graph.inside,
        "near": graph.near,
        "above-of": graph.above,
        "parts": graph.parts_of,
        "where": graph.where_is,
    }
    if question in simple:
        words = {"above-of": "above", "parts": "parts of", "where": "where is"}.get(question, question)
        return AskedAnswer(f"{words} {given['thing']}", simple[question](given["thing"]))
    if question == "all":
        return AskedAnswer(f"all of class {given['class']}", graph.all_of(given["class"]))
    if question == "about":
        return AskedAnswer(f"all about {given['thing']}", description_answer(graph, given["thing"]))
    return _listed(graph, question, given)


def _listed(graph: GraphStore, question: str, given: Mapping[str, str]) -> AskedAnswer:
    """Return the answer to a question of `usd2kg query --list`."""
    values = {name: _plain_value(name, value) for name, value in given.items()}
    text = next(q.text for q in list_questions() if q.id == question)
    told = ", ".join(f"{name} = {value}" for name, value in values.items())
    return AskedAnswer(f"{question}: {text}{f' with {told}' if told else ''}", graph.answer(question, values))


def _plain_value(name: str, value: str) -> str:
    if name == "position":
        return " ".join(value.replace(",", " ").split())
    if name in {"distance", "mass"}:
        number = value.rstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ ")
        unit = value[len(number) :].strip().lower()
        return f"{number} {next((short for long, short in _LONG_UNITS if unit.startswith(long)), unit)}".strip()
    return value


def _some_related(graph: GraphStore, verb: str, relation: str, given: Mapping[str, str]) -> AskedAnswer:
    """Return the things of a class, or of a name, that are on or in a thing, or on or in something there."""
    find = graph.on if relation == "on" else graph.inside
    related = find(given["thing"], is_direct=False)
    nodes = set(_paths(graph, given["class"]))
    column = related.columns.index("path")
    kept = [index for index, row in enumerate(related.rows) if row[column] in nodes]
    answer = replace(related, rows=tuple(related.rows[i] for i in kept), values=tuple(related.values[i] for i in kept))
    return AskedAnswer(f"{given['class']} {relation} {given['thing']}", answer, bool(kept) if verb == "is" else None)


def _paths(graph: GraphStore, name: str) -> list[str]:
    """Return the prim paths of all things that a person may mean by a class or a name."""
    answer = graph.where_is(name)
    column = answer.columns.index("path")
    return [row[column] or "" for row in answer.rows]
