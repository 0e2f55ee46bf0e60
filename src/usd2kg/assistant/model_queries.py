"""ask_model: a language model writes the SPARQL query for a question; it is checked, run within limits and shown."""

import json
from collections.abc import Callable
from importlib.resources import files

from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.settings import PROMPT
from usd2kg.errors import GraphError, GroundingError
from usd2kg.grounding.llm.completion import Completion, Finish, Request
from usd2kg.grounding.llm.prompt_text import quote
from usd2kg.query import Answer, GraphStore
from usd2kg.query.questions import list_questions

__all__ = ["ask_model", "write_request"]

Complete = Callable[[Request], Completion]
RunQuery = Callable[[str], Answer]

_SCHEMA = {
    "type": "object",
    "properties": {"query": {"type": "string"}},
    "required": ["query"],
    "additionalProperties": False,
}

_PREDICATES = """
SELECT ?p (COUNT(*) AS ?n) (SAMPLE(?o) AS ?example) WHERE {
  ?s ?p ?o . FILTER(!isBlank(?o))
} GROUP BY ?p ORDER BY DESC(?n) ?p"""
_CLASSES = """
SELECT ?class ?label (COUNT(?o) AS ?n) WHERE {
  ?o u2k:primPath ?path ; a ?class . OPTIONAL { ?class rdfs:label ?label }
} GROUP BY ?class ?label ORDER BY DESC(?n) ?class"""


def ask_model(graph: GraphStore, text: str, complete: Complete, run: RunQuery | None = None) -> InterpretedAnswer:
    """Return the answer to a question by a query that a language model writes.

    A query that fails is sent back with the error, at most `max_repairs` times.

    Args:
        graph: the graph; the prompt contains its properties, classes and counts, but no list of objects.
        text: the question.
        complete: calls the model.
        run: runs a query; by default `GraphStore.sparql`, which has no time limit.

    Raises:
        GroundingError: the model cannot be called, or its completion contains no query.
        GraphError: its last query fails.
    """
    request = write_request(graph, text)
    for attempt in range(PROMPT.max_repairs + 1):
        query = _read_query(complete(request))
        try:
            return InterpretedAnswer("a query written by the model", (run or graph.sparql)(query))
        except GraphError as error:
            if attempt == PROMPT.max_repairs:
                raise GraphError(f"the model's query fails: {error}; it was: {' '.join(query.split())}") from error
            request = _repair(write_request(graph, text), query, str(error))
    raise AssertionError("the loop returns or raises")


def write_request(graph: GraphStore, text: str) -> Request:
    """Return the prompt for a query; a pure function of graph and question."""
    template = (files("usd2kg.assistant") / "templates" / "sparql.txt").read_text("utf-8")
    examples = "\n\n".join(q.sparql.strip() for q in list_questions() if q.id in PROMPT.examples)
    system = template.format(terms=_properties(graph), classes=_classes(graph), examples=examples)
    return _request(system, f"Question: {quote(text, PROMPT.max_question)}")


def _repair(request: Request, query: str, error: str) -> Request:
    query, error = quote(query, PROMPT.max_query), quote(error, PROMPT.max_error)
    return _request(request.system, f"{request.user}\n\nThis query fails:\n{query}\nError: {error}\nCorrect it.")


def _request(system: str, user: str) -> Request:
    return Request(system=system, user=user, schema=_SCHEMA, max_tokens=PROMPT.max_tokens)


def _read_query(completion: Completion) -> str:
    if completion.finish is not Finish.STOP:
        raise GroundingError(f"the model's answer was cut off ({completion.finish.value}); expected one SPARQL query")
    try:
        query = json.loads(completion.text)["query"]
    except (ValueError, KeyError, TypeError):
        query = None
    if not isinstance(query, str) or not query.strip():
        raise GroundingError(f"the model answered {completion.text[:80]!r}; expected JSON with a SPARQL query")
    return query


def _properties(graph: GraphStore) -> str:
    """Return the most frequent properties, one per line, with their count and an example value."""
    rows = graph.sparql(_PREDICATES).rows[: PROMPT.max_terms]
    return "\n".join(
        f"<{name}> {count} times, e.g. {quote(value or '', PROMPT.max_example)}" for name, count, value in rows
    )


def _classes(graph: GraphStore) -> str:
    rows = graph.sparql(_CLASSES).rows[: PROMPT.max_terms]
    return "\n".join(f"<{iri}> {quote(label or '')}: {count}" for iri, label, count in rows)
