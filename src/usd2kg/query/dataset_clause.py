"""The dataset clauses of a query: FROM and FROM NAMED (SPARQL 1.1 Query Language, section 13.2)."""

import re
from collections.abc import Iterator

__all__ = ["graphs_named", "names_dataset"]

_IRI = r"<[^<>\"{}|^`\\\s]*>"
_SKIPPED = (
    r"'''(?s:\\.|(?!''').)*'''|" + r'"""(?s:\\.|(?!""").)*"""' + r"|'(?:\\.|[^'\\\n\r])*'|"
    r'"(?:\\.|[^"\\\n\r])*"' + rf"|#[^\n\r]*|{_IRI}"
)
# FROM is a keyword of these clauses only; a variable, a prefix, a local name or a language tag can have its letters.
_TOKEN = re.compile(
    rf"{_SKIPPED}|(?<![\w?$:@.%\\-])(?P<clause>FROM)(?![\w:.%-])(?:\s|#[^\n\r]*[\n\r])*(?:NAMED\b)?\s*(?P<iri>{_IRI})?",
    re.IGNORECASE,
)


def names_dataset(sparql: str) -> bool:
    """Return whether a query names the graphs that it is about.

    >>> names_dataset("SELECT ?from FROM <urn:kitchen> { ?s ?p ?from }")
    True
    >>> names_dataset('SELECT ?from { ?s ?p "FROM <urn:kitchen>" } # FROM <urn:kitchen>')
    False
    """
    return any(True for _ in _clauses(sparql))


def graphs_named(sparql: str) -> list[str]:
    """Return the IRIs in the dataset clauses of a query, those written in full."""
    return [found["iri"][1:-1] for found in _clauses(sparql) if found["iri"]]


def _clauses(sparql: str) -> Iterator[re.Match[str]]:
    return (found for found in _TOKEN.finditer(sparql) if found["clause"])
