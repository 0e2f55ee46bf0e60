"""Run a query in two stages: first its leading subquery, then the rest about the few things that it found.

The engine plans a query before it knows how few objects a property path leads to, and then reads all labels of the
graph to join them.
"""

import re
from collections.abc import Callable, Sequence
from typing import Any

__all__ = ["list_found_first"]

_BEGIN = re.compile(r"\{\s*(?P<query>SELECT DISTINCT (?P<variables>\?\w+(?: \?\w+)*) \{)")


def list_found_first(query: str, select: Callable[[str], Sequence[Any]], most: int) -> str:
    """Return a query with the results of its first `{ SELECT DISTINCT ?a ?b { … } }` in place of that subquery.

    Args:
        query: a query of this package, whose strings and comments have no brackets.
        select: runs a SELECT query.
        most: results above which the query is returned as it is.
    """
    found = _BEGIN.search(query)
    if found is None:
        return query
    subquery = found["query"] + _until_closed(query, found.end()) + "}"
    rows = select(subquery)
    if len(rows) > most:
        return query
    values = " ".join(f"({' '.join(map(str, row))})" for row in rows)
    block = query[found.start() : query.index("}", found.start("query") + len(subquery)) + 1]
    return query.replace(block, f"VALUES ({found['variables']}) {{ {values} }}")


def _until_closed(query: str, start: int) -> str:
    """Return the text from `start` to the bracket that closes the group which is open there."""
    depth = 1
    for at in range(start, len(query)):
        depth += {"{": 1, "}": -1}.get(query[at], 0)
        if depth == 0:
            return query[start:at]
    raise ValueError("a bracket is not closed")
