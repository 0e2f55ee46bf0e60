"""ask_model: a language model writes the SPARQL for a question; it is checked, run within limits, and shown."""

import json
from collections.abc import Callable
from importlib.resources import files

from usd2kg.assistant.offline import InterpretedAnswer
from usd2kg.errors import GraphError, GroundingError
from usd2kg.grounding.llm.completion import Completion, Finish, Request
from usd2kg.grounding.llm.text import quote
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
_MOST_TOKENS = 1024
_MOST_TERMS = 80
_EXAMPLES = ("same-surface", "heavy-near", "which-where")
_REPAIRS = 2

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

    A query that does not parse, updates, or asks another server is handed back with the reason, twice at most.

    Args:
        graph: the graph; what it holds is described to the model: terms, classes and counts, and no object.
        text: the question.
        complete: asks the model.
        run: runs a query; the graph itself by default, which knows no limits of time.

    Raises:
        GroundingError: the model cannot be asked, or writes no query.
        GraphError: its last query cannot be run.
    """
    request = write_request(graph, text)
    for attempt in range(_REPAIRS + 1):
        query = _query_of(complete(request))
        try:
            return InterpretedAnswer("a query that the model wrote", (run or graph.sparql)(query))
        except GraphError as error:
            if attempt == _REPAIRS:
                shown = " ".join(query.split())
                raise GraphError(f"the model's query cannot be run: {error}; it was: {shown}") from error
            request = _repair(write_request(graph, text), query, str(error))
    raise AssertionError("the loop returns or raises")


def write_request(graph: GraphStore, text: str) -> Request:
    """Return the prompt that asks a model for a query; a pure function of graph and question."""
    template = (files("usd2kg.assistant") / "templates" / "sparql.txt").read_text("utf-8")
    examples = "\n\n".join(q.sparql.strip() for q in list_questions() if q.id in _EXAMPLES)
    system = template.format(terms=_terms(graph), classes=_classes(graph), examples=examples)
    return Request(system=system, user=f"Question: {quote(text, 2000)}", schema=_SCHEMA, most_tokens=_MOST_TOKENS)


def _repair(request: Request, query: str, error: str) -> Request:
    user = (
        f"{request.user}\n\nThis query cannot be run:\n{quote(query, 4000)}\nReason: {quote(error, 500)}\n"
        "Write one that can."
    )
    return Request(system=request.system, user=user, schema=_SCHEMA, most_tokens=_MOST_TOKENS)


def _query_of(completion: Completion) -> str:
    if completion.finish is not Finish.STOP:
        raise GroundingError(f"the model's answer was cut off ({completion.finish.value}); expected one SPARQL query")
    try:
        query = json.loads(completion.text)["query"]
    except (ValueError, KeyError, TypeError):
        query = None
    if not isinstance(query, str) or not query.strip():
        raise GroundingError(f"the model wrote {completion.text[:80]!r}; expected JSON with a SPARQL query")
    return query


def _terms(graph: GraphStore) -> str:
    """Return the properties of a graph, with how often they are used and a value as an example."""
    rows = graph.sparql(_PREDICATES).rows[:_MOST_TERMS]
    return "\n".join(f"<{name}> {count} times, e.g. {quote(value or '', 60)}" for name, count, value in rows)


def _classes(graph: GraphStore) -> str:
    rows = graph.sparql(_CLASSES).rows[:_MOST_TERMS]
    return "\n".join(f"<{iri}> {quote(label or '')}: {count}" for iri, label, count in rows)
