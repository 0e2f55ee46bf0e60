"""Conversion of queries and answers to and from the SPARQL Protocol."""

import pyoxigraph as ox

from usd2kg.errors import StoreError
from usd2kg.query.answer import Answer, make_answer

__all__ = ["parse_results"]


def parse_results(body: bytes, sparql: str) -> Answer:
    """Return the answer in a response body: SPARQL results JSON or N-Triples.

    Raises:
        StoreError: the body is in neither format, or contains a literal of more than 16 MiB.
    """
    try:
        if not body.lstrip().startswith(b"{"):
            triples = sorted(map(tuple, ox.parse(body, format=ox.RdfFormat.N_TRIPLES)), key=lambda t: list(map(str, t)))
            return make_answer(("subject", "predicate", "object"), [triple[:3] for triple in triples], sparql)
        found = ox.parse_query_results(body, format=ox.QueryResultsFormat.JSON)
        if isinstance(found, ox.QueryBoolean):
            return Answer(("answer",), ((str(bool(found)).lower(),),), ((bool(found),),), sparql)
        columns = tuple(variable.value for variable in found.variables)
        return make_answer(columns, [tuple(solution[c] for c in columns) for solution in found], sparql)
    except MemoryError as error:
        # The parser holds at most 16 MiB of one value.
        raise StoreError(f"the answer contains an overlong literal ({error}); query a part of it (SUBSTR)") from error
    except (SyntaxError, UnicodeDecodeError) as error:
        raise StoreError(
            f"the server's answer is neither SPARQL results JSON nor N-Triples ({error}); check that it is a SPARQL "
            "server"
        ) from error
