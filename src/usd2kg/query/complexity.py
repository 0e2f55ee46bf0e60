"""check_complexity: reject queries that would overflow the stack of the engine and so kill the process."""

import re
from collections import Counter

from usd2kg.errors import GraphError
from usd2kg.query.settings import COMPLEXITY
from usd2kg.query.unicode_text import check_text

__all__ = ["check_complexity"]

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
    """Raise GraphError for a query or update that would overflow the engine's stack; an update may be of any length.

    Brackets and operators in strings, comments and IRIs with `://` are not counted. Without a parser, `<2>` may be an
    IRI or two comparisons: opening brackets in it are counted, closing ones are not. If it contains a `#` or a quote,
    the text after it could be a comment or a string; from there on, all operators and opening brackets are counted and
    no closing ones, so that no bracket can be hidden.

    Raises:
        GraphError: it is not Unicode text; brackets are nested too deep; or a query has too many operators and clauses,
            or triple patterns.

    >>> check_complexity("SELECT * " + "{" * 501 + "}" * 501)
    Traceback (most recent call last):
    usd2kg.errors.GraphError: SPARQL: brackets are nested 501 deep; expected at most 500, write it flatter
    """
    check_text(sparql, "query")
    counts = _count(sparql)
    # The engine joins adjacent groups one by one, as it does conditions of HAVING, which no keyword separates.
    counts["chain"] += counts["{"] + (counts["("] if re.search("HAVING", sparql, re.IGNORECASE) else 0)
    deepest, operators, triples = counts["deepest"], counts["chain"], counts["triple"]
    if deepest > COMPLEXITY.max_nesting:
        raise GraphError(
            f"SPARQL: brackets are nested {deepest} deep; expected at most {COMPLEXITY.max_nesting}, write it flatter"
        )
    if not is_update and (operators > COMPLEXITY.max_operators or triples > COMPLEXITY.max_triples):
        raise GraphError(
            f"query: has {operators} operators and clauses and {triples} triple patterns or list members; expected at "
            f"most {COMPLEXITY.max_operators} and {COMPLEXITY.max_triples}; split it, or list values with VALUES"
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
    """Count all opening brackets, and no closing ones."""
    for token in _LOOSE.finditer(text):
        counts["depth" if token.lastgroup == "open" else str(token.lastgroup)] += 1
        counts[token.group()] += 1
    counts["deepest"] = max(counts["deepest"], counts["depth"])
