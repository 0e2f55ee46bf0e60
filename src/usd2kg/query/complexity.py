"""Queries that are nested too deep, or chained too long, for the engine's stack: it would end the process."""

import re
from collections import Counter

from usd2kg.errors import GraphError

__all__ = ["check_complexity"]

# The engine recurses for each of these; a stack of 8 MiB bears about twice as many.
_MOST_NESTED = 500
_MOST_CHAINED = 1000
_MOST_TRIPLES = 1000
_CHAIN = r"&&|\|\||[!/|^*+]|-(?![A-Za-z])|\b(?:AS|OPTIONAL|UNION|MINUS|FILTER|BIND|SELECT|GRAPH)\b"
_TRIPLE = r"[;,]|\.(?!\d)"
_LONG_STRINGS = r"'''(?s:\\.|(?!''').)*'''|" + r'"""(?s:\\.|(?!""").)*"""'
_STRINGS = r"'(?:\\.|[^'\\\n\r])*'|" + r'"(?:\\.|[^"\\\n\r])*"'
_IRI_REST = r'[^<>"{}|^`\\\s]*>'
_COUNTED = rf"(?P<open>[(\[{{])|(?P<chain>{_CHAIN})|(?P<triple>{_TRIPLE})"
_LOOSE = re.compile(_COUNTED, re.IGNORECASE)
_TOKEN = re.compile(
    rf"{_LONG_STRINGS}|{_STRINGS}|\#[^\n\r]*|<[a-z][\w+.-]*://{_IRI_REST}|\\.|(?P<angle><{_IRI_REST})|"
    rf"(?P<close>[)\]}}])|{_COUNTED}",
    re.IGNORECASE,
)


def check_complexity(sparql: str, *, is_update: bool = False) -> None:
    """Refuse a query or an update on which the engine would run out of its stack; an update's data may be long.

    Strings, comments and IRIs with `://` do not count. Whether `<2>` is an IRI or two comparisons depends on the
    grammar: what opens in there counts, and what closes does not. If it holds a # or a quote, what follows may be a
    comment or a string or not, so from there on nothing is left out and nothing closes: no bracket can be hidden.

    Raises:
        GraphError: brackets within each other more than 500 deep; in a query also more than 1,000 operators and
            clauses, or 1,000 triple patterns.

    >>> check_complexity("SELECT * " + "{" * 501 + "}" * 501)
    Traceback (most recent call last):
    usd2kg.errors.GraphError: SPARQL: brackets are nested 501 deep; expected at most 500, so write it flatter
    """
    counts = _count(sparql)
    # Groups side by side are joined one by one, and so are the conditions of HAVING, which have no word between them.
    counts["chain"] += counts["{"] + (counts["("] if re.search("HAVING", sparql, re.IGNORECASE) else 0)
    deepest, chained, triples = counts["deepest"], counts["chain"], counts["triple"]
    if deepest > _MOST_NESTED:
        raise GraphError(
            f"SPARQL: brackets are nested {deepest} deep; expected at most {_MOST_NESTED}, so write it flatter"
        )
    if not is_update and (chained > _MOST_CHAINED or triples > _MOST_TRIPLES):
        raise GraphError(
            f"query: has {chained} operators and clauses and {triples} triple patterns or list members; expected at "
            f"most {_MOST_CHAINED} and {_MOST_TRIPLES}, so ask in several queries, or list values with VALUES"
        )


def _count(sparql: str) -> Counter[str]:
    counts: Counter[str] = Counter()
    for token in _TOKEN.finditer(sparql):
        kind, text = token.lastgroup, token.group()
        if kind == "angle":
            is_open_ended = "#" in text or "'" in text
            _count_loosely(counts, sparql[token.start() :] if is_open_ended else text)
            if is_open_ended:
                break
        elif kind in {"open", "close"}:
            counts["depth"] += 1 if kind == "open" else -1
            counts[text] += 1
            counts["deepest"] = max(counts["deepest"], counts["depth"])
        elif kind is not None:
            counts[kind] += 1
    return counts


def _count_loosely(counts: Counter[str], text: str) -> None:
    """Count as if all that opens stayed open."""
    for token in _LOOSE.finditer(text):
        counts["depth" if token.lastgroup == "open" else str(token.lastgroup)] += 1
        counts[token.group()] += 1
    counts["deepest"] = max(counts["deepest"], counts["depth"])
