"""Messages for SPARQL that does not parse, and for names that the graph does not have."""

import re
from collections.abc import Iterator, Mapping

import pyoxigraph as ox
from rapidfuzz import fuzz, process

from usd2kg.errors import one_line
from usd2kg.graph.vocabulary import OWL, RDF
from usd2kg.query.dataset import QUERY_PREFIXES, Dataset
from usd2kg.query.dataset_clause import graphs_named
from usd2kg.query.settings import LOOKUP

__all__ = ["describe_syntax_error", "unknown_graphs", "unknown_names"]

_PLACE = re.compile(r"error at (\d+):(\d+): expected (?:one of )?(.*)", re.DOTALL)
_EXPECTED = re.compile(r'"([!-~]{1,3})"|\[[^\]]*\]|([A-Z][A-Za-z]* [A-Za-z ]*[a-z])')
"""A token, a set of characters, or a sentence in the engine's list of what it expected; its keywords are arbitrary."""
_FORMS = ("SELECT", "ASK", "CONSTRUCT", "DESCRIBE")
_UPDATES = ("ADD", "CLEAR", "COPY", "CREATE", "DELETE", "DROP", "INSERT", "LOAD", "MOVE", "WITH")
_PROLOGUE = re.compile(r"(?:\s|#[^\n]*\n|PREFIX\s+[^<]*<[^>]*>|BASE\s+<[^>]*>)*", re.IGNORECASE)
_NOT_NAMES = re.compile(r"<[A-Za-z][\w+.-]*:[^<>\n]*>|<[^<>\s]*>|\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])*'|#[^\n]*")
_NAME = re.compile(r"(?<![\w:.-])([A-Za-z][\w-]*)?:([\w-]*)")
_SHOWN = 20
"""Characters of the query that a message quotes."""
_MOST_EXPECTED = 9
"""Longer lists of what the engine expected help nobody."""


def describe_syntax_error(query: str, error: SyntaxError, prefixes: Mapping[str, str] = QUERY_PREFIXES) -> str:
    """Return one line: where the query does not parse, what is there, and what was expected.

    `prefixes` are predefined.

    >>> try:
    ...     ox.Store().query("SELECT * { ?s foo:bar ?o }")
    ... except SyntaxError as error:
    ...     print(describe_syntax_error("SELECT * { ?s foo:bar ?o }", error)[:68])
    query: not valid SPARQL at line 1, column 15: the prefix foo: is not
    """
    start = _PROLOGUE.match(query)
    begin = start.end() if start else 0
    first = re.match(r"\w*", query[begin:])
    word = first[0] if first else ""
    if word.upper() in _UPDATES:
        return f"query: begins with {word}, which changes data; expected {_join(_FORMS)}"
    if not query[begin:].strip():
        return f"query: is empty; expected {_join(_FORMS)}"
    if word.upper() not in _FORMS:
        shown = repr(word or query[begin : begin + _SHOWN].strip())
        return f"query: begins with {shown}; expected {_join(_FORMS)}"
    for prefix, at in _undeclared(query, prefixes):
        known = ", ".join(f"{name}:" for name in sorted(prefixes))
        return (
            f"query: not valid SPARQL at {_place(query, at)}: the prefix {prefix}: is not declared; expected PREFIX "
            f"{prefix}: <…> before the query, or one of {known}"
        )
    found = _PLACE.match(str(error))
    if found is None:
        return f"query: not valid SPARQL ({one_line(error)})"
    lines = query.splitlines() or [""]
    line, column = min(int(found[1]), len(lines)), int(found[2])
    rest = " ".join([lines[line - 1][column - 1 :], *lines[line:]]).strip()
    near = f"before {_quote(rest)}" if rest else "at the end"
    return f"query: not valid SPARQL at line {line}, column {column}, {near}{_expected(found[3])}"


def _expected(text: str) -> str:
    """Return what the engine expected, without sets of characters; nothing if the list is long."""
    found = _EXPECTED.findall(text)
    sentence = next((sentence for _, sentence in found if sentence), "")
    if sentence:
        return f": {sentence}"
    tokens = [token for token, _ in found if token.strip()]
    return f"; expected one of {' '.join(tokens)}" if 0 < len(tokens) <= _MOST_EXPECTED else ""


def _undeclared(query: str, prefixes: Mapping[str, str]) -> Iterator[tuple[str, int]]:
    """Yield the prefixes that are used and neither declared nor predefined, each with its offset."""
    text = _NOT_NAMES.sub(lambda found: " " * len(found[0]), query)
    declared = {name for name, _ in re.findall(r"PREFIX\s+([\w-]*)(\s*):", text, re.IGNORECASE)}
    for found in _NAME.finditer(text):
        prefix = found[1] or ""
        if prefix != "_" and prefix not in declared and prefix not in prefixes:
            yield prefix, found.start()


def unknown_names(query: str, dataset: Dataset) -> list[str]:
    """Return a hint for each prefixed name in a query that the graph does not have, with the nearest one it has."""
    text = _NOT_NAMES.sub(lambda found: " " * len(found[0]), query)
    hints = []
    for prefix, local in dict.fromkeys(_NAME.findall(text)):
        if prefix in {"", "u2kf", "xsd"} or prefix not in dataset.prefixes or not local:
            continue
        if _occurs(ox.NamedNode(dataset.prefixes[prefix] + local), dataset.store):
            continue
        similar = process.extractOne(
            f"{prefix}:{local}",
            _declared_names(dataset),
            scorer=fuzz.ratio,
            processor=str.lower,
            score_cutoff=LOOKUP.min_label_similarity,
        )
        advice = f"; did you mean {similar[0]}?" if similar else ""
        hints.append(f"{prefix}:{local} is not in the graph{advice}")
    return hints


def unknown_graphs(query: str, dataset: Dataset) -> list[str]:
    """Return a hint for each graph in FROM and FROM NAMED that the store does not have."""
    known = {node.value for node in dataset.store.named_graphs()}
    advice = "" if known else "; a file that names no graphs is queried without FROM"
    return [f"FROM <{iri}>: there is no such graph{advice}" for iri in graphs_named(query) if iri not in known]


def _occurs(node: ox.NamedNode, store: ox.Store) -> bool:
    patterns = ((None, node, None), (node, None, None), (None, None, node))
    return any(next(iter(store.quads_for_pattern(*pattern)), None) is not None for pattern in patterns)


def _declared_names(dataset: Dataset) -> list[str]:
    """Return the properties and classes that the graph declares, as prefixed names."""
    kinds = (OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty)
    query = f"SELECT DISTINCT ?s {{ VALUES ?k {{ {' '.join(map(str, kinds))} }} ?s {RDF.type} ?k }}"
    names = []
    for (node,) in dataset.select(query):
        iri = str(node.value)
        names += [
            f"{prefix}:{iri.removeprefix(base)}" for prefix, base in dataset.prefixes.items() if iri.startswith(base)
        ]
    return sorted(names)


def _place(query: str, at: int) -> str:
    before = query[:at]
    return f"line {before.count(chr(10)) + 1}, column {at - before.rfind(chr(10))}"


def _quote(text: str) -> str:
    short = one_line(text)
    return repr(short if len(short) <= _SHOWN else f"{short[:_SHOWN]}…")


def _join(words: tuple[str, ...] | list[str]) -> str:
    *most, last = words
    return f"{', '.join(most)} or {last}" if most else last
