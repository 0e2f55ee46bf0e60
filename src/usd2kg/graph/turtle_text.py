"""TurtleText: statements as Turtle text, straight from their terms."""

import re
from collections.abc import Iterable, Mapping
from functools import lru_cache

import pyoxigraph as ox

from usd2kg.graph.vocabulary import RDF, XSD, Triple

__all__ = ["TurtleText"]

_TERMS = 8192
"""Texts of terms that are kept; affects only speed and memory."""
_LOCAL = re.compile(r"(?:[A-Za-z0-9_:](?:[A-Za-z0-9_:.-]*[A-Za-z0-9_:-])?)?")
"""The part of an IRI after its namespace that needs no escape (Turtle 1.1, PN_LOCAL, in ASCII)."""
_ESCAPED = re.compile(r"[~!$&'()*+,;=/?#@%]|^[.-]|\.$")
_ESCAPABLE = re.compile(r"[A-Za-z0-9_:.~!$&'()*+,;=/?#@%-]*")
_BARE = {
    f"<{XSD.integer.value}>": re.compile(r"[+-]?[0-9]+"),
    f"<{XSD.decimal.value}>": re.compile(r"[+-]?[0-9]*\.[0-9]+"),
    f"<{XSD.double.value}>": re.compile(r"[+-]?(?:\d+\.\d*|\.?\d+)[eE][+-]?[0-9]+"),
    f"<{XSD.boolean.value}>": re.compile("true|false"),
}
"""Datatype → values that Turtle writes without quotes."""


class TurtleText:
    """Writes statements as pyoxigraph does, without an object for each.

    To copy the terms into a triple takes longer than to write it.
    """

    def __init__(self, prefixes: Mapping[str, str]) -> None:
        """Create it with prefix → namespace; a longer namespace is preferred."""
        self._names = {iri: name for name, iri in prefixes.items()}
        self._namespace = re.compile("|".join(map(re.escape, sorted(self._names, key=len, reverse=True))) or r"\Z")
        self._text = lru_cache(maxsize=_TERMS)(self._make_text)
        self._verb = lru_cache(maxsize=_TERMS)(self._make_verb)

    def statements(self, triples: Iterable[Triple] | Iterable[ox.Triple]) -> str:
        """Return triples in the given order; neighbours with the same subject or predicate share it."""
        subject: object = None
        predicate: object = None
        text, verb = self._text, self._verb
        pieces: list[str] = []
        for one, name, value in triples:
            # Most neighbours share the subject, and the comparison of IRIs takes as long as all the rest.
            if one is not subject and one != subject:
                pieces += (" .\n", text(one), " ", verb(name), " ", text(value))
                subject, predicate = one, name
            elif name is not predicate and name != predicate:
                pieces += (" ;\n\t", verb(name), " ", text(value))
                predicate = name
            else:
                pieces += (" , ", text(value))
        return "".join(pieces[1:]) + " .\n" if pieces else ""

    def _make_verb(self, predicate: ox.NamedNode) -> str:
        return "a" if predicate == RDF.type else self._text(predicate)

    def _make_text(self, term: ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple) -> str:
        if isinstance(term, ox.NamedNode):
            return self._shortened(term.value)
        if isinstance(term, ox.Triple):
            return f"<<( {' '.join(map(self._text, term))} )>>"
        text = str(term)
        if isinstance(term, ox.BlankNode) or text.endswith('"'):
            return text
        quoted, mark, datatype = text.rpartition("^^")
        if not mark or not quoted.endswith('"'):
            return text
        bare = _BARE.get(datatype)
        if bare is not None and bare.fullmatch(quoted, 1, len(quoted) - 1):
            return quoted[1:-1]
        return f"{quoted}^^{self._shortened(datatype[1:-1])}"

    def _shortened(self, iri: str) -> str:
        found = self._namespace.match(iri)
        if found is None:
            return f"<{iri}>"
        name, local = self._names[found[0]], iri[found.end() :]
        if _LOCAL.fullmatch(local):
            return f"{name}:{local}"
        return f"{name}:" + _ESCAPED.sub(r"\\\g<0>", local) if _ESCAPABLE.fullmatch(local) else f"<{iri}>"
