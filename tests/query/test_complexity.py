"""Queries that would overflow the engine's stack are refused; long but flat queries run."""

import pyoxigraph as ox
import pytest

from usd2kg.endpoint import EndpointLimits
from usd2kg.endpoint.worker import answer
from usd2kg.errors import GraphError
from usd2kg.query import Dataset, GraphStore
from usd2kg.query.complexity import check_complexity
from usd2kg.stores import EmbeddedStore

MANY = 20_000
REFUSED = {
    "groups": "SELECT * " + "{" * MANY + "?s ?p ?o" + "}" * MANY,
    "brackets": "SELECT * { FILTER(" + "(" * MANY + "1" + ")" * MANY + ") }",
    "nodes": "SELECT * {" + "[<a:p> " * MANY + "1" + "]" * MANY + " ?p ?o}",
    "closed in strings": "SELECT * { FILTER(" + "(')' = " * MANY + "1" + ")" * MANY + ") }",
    "closed in comments": "SELECT * { FILTER(" + "(1<2#>)\n = " * MANY + "1" + ")" * MANY + ") }",
    "in a possible IRI": "SELECT * { FILTER(1<" + "(" * MANY + "1" + ")" * MANY + ">1) }",
    "after a possible string": "SELECT * { FILTER(?a<'>' && " + "(" * MANY + "1" + ")" * MANY + "='') }",
    "negations": "SELECT * { FILTER(" + "!" * MANY + "true) }",
    "unions": "SELECT * {" + " UNION ".join(["{ ?s ?p ?o }"] * MANY) + "}",
    "sums": "SELECT (" + "1+" * MANY + "1 AS ?x) {}",
    "paths": "SELECT * { ?s " + "<a:b>/" * MANY + "<a:b> ?o }",
    "patterns": "SELECT * {" + "?s ?p ?o ." * MANY + "}",
    "conditions": "SELECT ?s { ?s ?p ?o } GROUP BY ?s HAVING " + "(?s = ?s)" * MANY,
    "joins": "SELECT * {" + "{ ?s ?p ?o }" * MANY + "}",
    "columns": "SELECT " + "".join(f"(1 AS ?x{i})" for i in range(MANY)) + " {}",
}
ACCEPTED = {
    "deep": "SELECT * " + "{" * 500 + "?s ?p ?o" + "}" * 500,
    "strings": "SELECT * { ?s ?p '''" + "([{!" * MANY + "''' , \"" + "((" * MANY + '" }',
    "comment": "SELECT * { # " + "(" * MANY + "\n ?s ?p ?o }",
    "addresses": "SELECT * { VALUES ?s {" + "<http://my.lab/a_(b)/c#d> " * MANY + "} }",
    "one after another": "SELECT * { VALUES (?a ?b) {" + "(1 'a') " * MANY + "} }",
}


@pytest.mark.parametrize("name", REFUSED)
def test_refuses_deep_and_long_queries(name: str):
    with pytest.raises(GraphError, match=r"brackets are nested \d+ deep; expected at most 500|operators and clauses"):
        check_complexity(REFUSED[name])


@pytest.mark.parametrize("name", ACCEPTED)
def test_accepts_queries_that_the_engine_can_run(name: str):
    check_complexity(ACCEPTED[name])
    list(ox.Store().query(ACCEPTED[name]))  # type: ignore[arg-type]


def test_accepts_long_data_in_updates(tmp_path):
    store = EmbeddedStore(tmp_path)
    store.update("INSERT DATA {" + "".join(f"<urn:a> <urn:p> {i} .\n" for i in range(MANY)) + "}")
    assert store.select("SELECT (COUNT(*) AS ?n) { ?s ?p ?o }") == [{"n": str(MANY)}]
    with pytest.raises(GraphError, match="brackets are nested"):
        store.update("INSERT { ?s ?p ?o } WHERE " + "{" * MANY + "?s ?p ?o" + "}" * MANY)
    with pytest.raises(GraphError, match="brackets are nested"):
        store.query(REFUSED["groups"], [])


def test_graphs_and_the_endpoint_refuse_deep_queries():
    with pytest.raises(GraphError, match="brackets are nested"):
        GraphStore(Dataset(ox.Store()), "here").sparql(REFUSED["groups"])
    with pytest.raises(GraphError, match="brackets are nested"):
        answer(Dataset(ox.Store()), {}, {"query": REFUSED["groups"], "accept": "*/*"}, EndpointLimits())
