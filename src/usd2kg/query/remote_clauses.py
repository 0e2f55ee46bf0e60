"""Queries that would have this machine ask another one."""

import re

__all__ = ["has_remote_clause"]

_BLANK = r"(?:\s|#[^\n\r]*[\n\r])*"
_NAME = r"(?:[?$][^\s{]*|<[^>]*>|[^\s{}<>\"']*:[^\s{]*)"
_SERVICE = re.compile(rf"SERVICE{_BLANK}(?:SILENT{_BLANK})?{_NAME}{_BLANK}\{{", re.IGNORECASE)
_LOAD = re.compile(rf"LOAD{_BLANK}(?:SILENT{_BLANK})?(?:<[^>]*>|[^\s{{}}<>\"']*:)", re.IGNORECASE)


def has_remote_clause(sparql: str) -> bool:
    """Return whether a query or an update could ask another server: it may hold a SERVICE or a LOAD clause.

    What is a comment, a string or an IRI depends on the grammar: in `FILTER(1<2)SERVICE#>` there is no IRI. So this
    looks everywhere, and takes a string that reads like such a clause for one; it never misses a clause.

    >>> has_remote_clause("SELECT * { SERVICE <http://10.0.0.1/> { ?s ?p ?o } }")
    True
    >>> has_remote_clause('SELECT * { ?s rdfs:label "Service Trolley" . OPTIONAL { ?s ?p ?o } }')
    False
    """
    return bool(_SERVICE.search(sparql) or _LOAD.search(sparql))
