"""SPARQL clauses that make the engine contact another server."""

import re

__all__ = ["REMOTE_QUERY", "REMOTE_UPDATE", "has_remote_clause"]

REMOTE_QUERY = "query: SERVICE contacts another server, which is not allowed; remove that clause"
"""Message for a refused query."""
REMOTE_UPDATE = "update: LOAD and SERVICE contact another server, which is not allowed; load a file instead"
"""Message for a refused update."""

_BLANK = r"(?:\s|#[^\n\r]*[\n\r])*"
_NAME = r"(?:[?$][^\s{]*|<[^>]*>|[^\s{}<>\"']*:[^\s{]*)"
_SERVICE = re.compile(rf"SERVICE{_BLANK}(?:SILENT{_BLANK})?{_NAME}{_BLANK}\{{", re.IGNORECASE)
_LOAD = re.compile(rf"LOAD{_BLANK}(?:SILENT{_BLANK})?(?:<[^>]*>|[^\s{{}}<>\"']*:)", re.IGNORECASE)


def has_remote_clause(sparql: str) -> bool:
    """Return whether a query or update may contain a SERVICE or LOAD clause.

    Only a parser can distinguish comments, strings and IRIs: `FILTER(1<2)SERVICE#>` contains no IRI. Therefore the
    search includes comments and strings: it may report a string that looks like a clause, but misses no clause.

    >>> has_remote_clause("SELECT * { SERVICE <http://10.0.0.1/> { ?s ?p ?o } }")
    True
    >>> has_remote_clause('SELECT * { ?s rdfs:label "Service Trolley" . OPTIONAL { ?s ?p ?o } }')
    False
    """
    return bool(_SERVICE.search(sparql) or _LOAD.search(sparql))
