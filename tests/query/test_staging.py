"""Queries in two stages."""

import pytest

from usd2kg.query.staging import list_found_first

QUERY = """SELECT ?l WHERE {
  { SELECT DISTINCT ?o ?a { VALUES ?a { <urn:a> } ?o (<urn:p>|<urn:q>)+ ?a } }
  ?o <urn:l> ?l
  OPTIONAL { { SELECT DISTINCT ?o ?a { VALUES ?a { <urn:a> } ?o (<urn:p>|<urn:q>)+ ?a } } ?x ?o ?a }
}"""


def test_lists_the_results_of_the_leading_subquery_everywhere():
    asked: list[str] = []

    def select(query: str) -> list[tuple[str, str]]:
        asked.append(query)
        return [("<urn:x>", "<urn:a>"), ("<urn:y>", "<urn:a>")]

    values = "VALUES (?o ?a) { (<urn:x> <urn:a>) (<urn:y> <urn:a>) }"
    expected = f"SELECT ?l WHERE {{\n  {values}\n  ?o <urn:l> ?l\n  OPTIONAL {{ {values} ?x ?o ?a }}\n}}"
    assert list_found_first(QUERY, select, 2) == expected
    assert asked == ["SELECT DISTINCT ?o ?a { VALUES ?a { <urn:a> } ?o (<urn:p>|<urn:q>)+ ?a }"]


def test_too_many_results_are_not_listed():
    assert list_found_first(QUERY, lambda _: [("<urn:x>", "<urn:a>")] * 3, 2) == QUERY


@pytest.mark.parametrize("query", ["ASK {}", "SELECT ?s { ?s ?p ?o }"])
def test_other_queries_stay(query: str):
    assert list_found_first(query, lambda _: pytest.fail("is not run"), 2) == query
