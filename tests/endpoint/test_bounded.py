"""Untrusted queries are stopped at the limits, and the next query is answered."""

from collections.abc import Callable

import pytest

from tests.graph.records import build_graph, open_store, thing
from usd2kg.assistant.describe import describe_objects
from usd2kg.assistant.offline import ask_offline
from usd2kg.endpoint import BoundedQueries, EndpointLimits
from usd2kg.errors import GraphError, StoreError
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore

CUPS = "SELECT ?label { ?o u2k:primPath ?p ; rdfs:label ?label } ORDER BY ?label"
ENDLESS = "SELECT (COUNT(*) AS ?n) { ?a ?b ?c . ?d ?e ?f . ?g ?h ?i . ?j ?k ?l }"


@pytest.fixture(scope="module")
def graph(home_tbox: TBox) -> GraphStore:
    return open_store(
        build_graph(home_tbox, [(thing(f"/Cup_{i}", (i, 0, 0), (0.1, 0.1, 0.1)), "Cup") for i in range(9)])
    )


def test_answers_equal_those_of_the_graph(graph: GraphStore):
    with BoundedQueries(graph) as run:
        assert run(CUPS) == graph.sparql(CUPS)
        assert run("ASK { ?o a soma:Cup }").values == ((True,),)
        construct = "CONSTRUCT { ?o a soma:Cup } WHERE { ?o a soma:Cup }"
        assert sorted(run(construct).rows) == sorted(graph.sparql(construct).rows)


def test_stops_an_endless_query_and_answers_the_next(graph: GraphStore):
    with BoundedQueries(graph, EndpointLimits(seconds=1, workers=1)) as run:
        with pytest.raises(GraphError, match="stopped after 1 s; simplify it"):
            run(ENDLESS)
        assert len(run(CUPS).rows) == 9


@pytest.mark.parametrize(
    ("query", "message"),
    [
        ("SELEC", "begins with 'SELEC'"),
        ("DELETE WHERE { ?s ?p ?o }", "begins with DELETE, which changes data"),
        ("SELECT * { SERVICE <http://127.0.0.1/> { ?s ?p ?o } }", "SERVICE contacts another server"),
    ],
)
def test_reports_why_a_query_is_refused(graph: GraphStore, query: str, message: str):
    with BoundedQueries(graph) as run, pytest.raises(GraphError, match=message):
        run(query)


def test_an_answer_with_a_text_that_is_too_long_is_an_error(graph: GraphStore):
    doubled = "SELECT (STRLEN(?x) AS ?n) ?x { BIND('0123456789abcdef' AS ?x0) "
    doubled += " ".join(f"BIND(CONCAT(?x{i}, ?x{i}) AS ?x{i + 1})" for i in range(20)) + " BIND(?x20 AS ?x) }"
    with BoundedQueries(graph) as run:
        with pytest.raises(StoreError, match=r"the answer contains an overlong literal .*; query a part of it"):
            run(doubled + "  LIMIT 2")
        assert run("ASK { ?o a soma:Cup }").values == ((True,),)


@pytest.mark.parametrize("query", ["SELECT ?x { BIND('\ud800' AS ?x) }", "ASK {} # \udfff"])
def test_a_query_with_half_a_character_is_an_error(graph: GraphStore, query: str):
    with BoundedQueries(graph) as run:
        for ask in (run, graph.sparql):
            with pytest.raises(GraphError, match="half of a character; expected text in Unicode"):
                ask(query)


@pytest.mark.parametrize("ask", [ask_offline, describe_objects])
def test_a_name_with_half_a_character_is_an_error(graph: GraphStore, ask: Callable[[GraphStore, str], object]):
    with pytest.raises(GraphError, match="half of a character; expected text in Unicode"):
        ask(graph, "where is the mug\ud83d?")
