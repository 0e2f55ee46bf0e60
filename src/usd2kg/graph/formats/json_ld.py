"""JSON-LD for people who write JavaScript: short keys, numbers as numbers, one object for each thing of the scene.

The context is data/context_soma.jsonld or data/context_plain.jsonld, written into each file, so that none is fetched,
and after it the scene's base and a short name for each class. What belongs to an object, its shape, its place, why it
has its class, is nested in it; all else is referred to by id.
"""

import json
import math
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.graph.formats.document import refuse_rdf12
from usd2kg.graph.vocabulary import OWL, RDF, U2K, USD, XSD

__all__ = ["CONTEXTS", "context_text", "json_ld_pieces"]

CONTEXTS = ("soma", "plain")
"""Profiles that have a context each."""

_SAFE_LOCAL = re.compile(r"[\w~%-][\w.~%-]*", flags=re.ASCII)
"""What follows a prefix or the base without being read as anything else."""
_TERM = re.compile(r"[A-Za-z_]\w*", flags=re.ASCII)
_JSON_NUMBER = re.compile(r"-?(0|[1-9][0-9]*)(\.[0-9]+)?([eE][+-]?[0-9]+)?", flags=re.ASCII)
_REALS = frozenset({XSD["double"].value, XSD["float"].value})
_MOST_EXACT = 2**53
"""Beyond this, JavaScript has no exact integers."""
_PART = "-"

Json = Any
Node = ox.NamedNode | ox.BlankNode


class _Key(NamedTuple):
    """How the values of a property are written."""

    name: str
    kind: str = ""
    """What its text means: @id, @vocab, the IRI of a datatype, or empty."""
    is_list: bool = False
    is_reverse: bool = False


def context_text(profile: str) -> str:
    """Return the context of a profile, as a JSON-LD document.

    Raises:
        GraphError: there is no such profile.
    """
    if profile not in CONTEXTS:
        raise GraphError(f"profile {profile!r} has no context; expected one of {', '.join(CONTEXTS)}")
    return (files("usd2kg.graph.formats") / f"context_{profile}.jsonld").read_text("utf-8")


@cache
def _context(profile: str) -> dict[str, Json]:
    context: dict[str, Json] = json.loads(context_text(profile))["@context"]
    return context


def json_ld_pieces(triples: Sequence[ox.Triple], base: str, source: str) -> Iterator[bytes]:
    """Yield the file, one object a line, in the order in which the triples first speak of each.

    Numbers come back with the same value and datatype, but spelt as JSON-LD spells them: 0.3 as 3.0E-1.

    Raises:
        GraphError: a triple needs RDF 1.2.
    """
    compaction = _Compaction(triples, base)
    context = json.dumps([compaction.context, compaction.own], ensure_ascii=False, indent=1)
    yield f'{{"@context": {context},\n"@graph": ['.encode()
    separator = "\n"
    for entry in _Entries(triples, compaction, source).roots():
        yield (separator + json.dumps(entry, ensure_ascii=False)).encode()
        separator = ",\n"
    yield b"\n]}\n"


class _Compaction:
    """Short forms of IRIs."""

    def __init__(self, triples: Sequence[ox.Triple], base: str) -> None:
        is_soma = any(triple.object == USD.Prim and triple.predicate == RDF.type for triple in triples)
        self.context = _context("soma" if is_soma else "plain")
        self.base = base if base.endswith("/") else ""
        self._namespaces = {iri: name for name, iri in self.context.items() if str(iri)[-1] in "#/"}
        self._keys = dict(self._read_keys())
        self._ranks = {name: rank for rank, name in enumerate(self.context)}
        self._classes: dict[str, str] = {}
        for node in dict.fromkeys(triple.object for triple in triples if triple.predicate == RDF.type):
            if not isinstance(node, ox.NamedNode):
                continue
            name = re.split("[#/]", node.value)[-1]
            if _TERM.fullmatch(name) and name not in self.context and name not in self._classes.values():
                self._classes[node.value] = name
        terms = {name: self.curie(iri) for iri, name in self._classes.items()}
        self.own = ({"@base": self.base} if self.base else {}) | terms

    def _read_keys(self) -> Iterator[tuple[str, _Key]]:
        for name, term in self.context.items():
            definition = {"@id": term} if isinstance(term, str) else term
            curie = definition.get("@id") or definition["@reverse"]
            if not curie.startswith("@") and curie[-1] not in "#/":
                kind = definition.get("@type", "")
                if not kind.startswith("@"):
                    kind = self.expand(kind)
                yield self.expand(curie), _Key(name, kind, "@container" in definition, "@reverse" in definition)

    def expand(self, curie: str) -> str:
        prefix, _, name = curie.partition(":")
        return str(self.context[prefix]) + name if name else curie

    def key(self, predicate: str) -> _Key:
        if predicate not in self._keys:
            self._keys[predicate] = _Key(self.curie(predicate))
        return self._keys[predicate]

    def rank(self, key: _Key) -> int:
        """Return the place of a key among others: as in the context, and what it does not know before the last."""
        return self._ranks.get(key.name, len(self._ranks) - 2)

    def curie(self, iri: str) -> str:
        end = max(iri.rfind("#"), iri.rfind("/")) + 1
        prefix = self._namespaces.get(iri[:end])
        return f"{prefix}:{iri[end:]}" if prefix and _SAFE_LOCAL.fullmatch(iri, end) else self._absolute(iri)

    def _absolute(self, iri: str) -> str:
        scheme, _, rest = iri.partition(":")
        if scheme in self.context and not rest.startswith("//"):
            raise GraphError(f"<{iri}>: would be read as the prefix {scheme!r} in JSON-LD; choose .ttl or .nt")
        return iri

    def id(self, node: Node) -> str:
        if isinstance(node, ox.BlankNode):
            return f"_:{node.value}"
        iri: str = node.value
        if self.base and iri.startswith(self.base) and _SAFE_LOCAL.fullmatch(iri, len(self.base)):
            return iri[len(self.base) :]
        return self.curie(iri)

    def type(self, node: Node) -> str:
        return self._classes.get(node.value) or self._vocab(node)

    def _vocab(self, node: Node) -> str:
        return f"_:{node.value}" if isinstance(node, ox.BlankNode) else self.curie(node.value)

    def value(self, term: Node | ox.Literal, key: _Key) -> Json:
        if isinstance(term, ox.Literal):
            return _literal(term, key.kind, self)
        if key.kind == "@id":
            return self.id(term)
        if key.kind == "@vocab":
            known = self._keys.get(term.value)
            return known.name if known is not None and not known.is_reverse else self._vocab(term)
        return {"id": self.id(term)}


def _literal(literal: ox.Literal, kind: str, compaction: _Compaction) -> Json:
    """Return a literal, bare where the key, or JSON itself, says its datatype."""
    datatype = literal.datatype.value
    if literal.language:
        return {"@value": literal.value, "@language": literal.language}
    if datatype == XSD.string.value:
        return literal.value if not kind else {"@value": literal.value}
    native = _native(literal.value, datatype)
    if datatype == kind:
        return literal.value if native is None else native
    is_told = native is not None and not (datatype in _REALS and float(native).is_integer())
    if not kind and is_told and datatype != XSD["float"].value:
        return native
    return {"@value": literal.value, "@type": compaction.curie(datatype)}


def _native(text: str, datatype: str) -> float | bool | int | None:
    """Return the number or truth value that JSON has for a literal; None where it has none."""
    if datatype == XSD.boolean.value:
        return {"true": True, "false": False}.get(text)
    if datatype == XSD.integer.value and re.fullmatch("0|-?[1-9][0-9]*", text) and abs(int(text)) <= _MOST_EXACT:
        return int(text)
    if datatype in _REALS and _JSON_NUMBER.fullmatch(text):
        value = float(text)
        # JSON has no -0 that survives every reader.
        if math.isfinite(value) and str(value) != "-0.0":
            return int(value) if value.is_integer() and abs(value) <= _MOST_EXACT else value
    return None


@dataclass
class _Entry:
    """What is said of one node."""

    types: list[Node] = field(default_factory=list)
    values: dict[_Key, list[Node | ox.Literal]] = field(default_factory=dict)


class _Entries:
    def __init__(self, triples: Sequence[ox.Triple], compaction: _Compaction, source: str) -> None:
        self._compaction = compaction
        self._entries: dict[Node, _Entry] = {}
        self._count: Counter[Node] = Counter()
        for triple in triples:
            refuse_rdf12(triple, "JSON-LD", source)
            self._add(triple)
        self._nested: dict[Node, Node] = {}
        self._find_nested(triples)

    def _entry(self, node: Node) -> _Entry:
        if node not in self._entries:
            self._entries[node] = _Entry()
        return self._entries[node]

    def _add(self, triple: ox.Triple) -> None:
        subject, predicate, value = triple.subject, triple.predicate, triple.object
        assert not isinstance(subject, ox.Triple), "triple terms were refused"
        assert not isinstance(value, ox.Triple), "triple terms were refused"
        entry = self._entry(subject)
        if predicate == RDF.type and not isinstance(value, ox.Literal):
            entry.types.append(value)
            return
        key = self._compaction.key(predicate.value)
        if key.is_reverse:
            if not isinstance(value, ox.Literal):
                self._entry(value).values.setdefault(key, []).append(subject)
                self._count[subject] += 1
                return
            key = _Key(self._compaction.curie(predicate.value))
        entry.values.setdefault(key, []).append(value)
        if not isinstance(value, ox.Literal):
            self._count[value] += 1

    def _find_nested(self, triples: Sequence[ox.Triple]) -> None:
        """Find what is told within another: statements about it, and its parts that only it refers to."""
        for triple in triples:
            subject, value = triple.subject, triple.object
            if isinstance(subject, ox.Triple) or not isinstance(value, ox.NamedNode):
                continue
            if triple.predicate == OWL.annotatedSource and self._count[subject] == 1:
                self._nested[subject] = value
            elif value in self._entries and self._count[value] == 1 and _is_part(value, subject):
                self._nested.setdefault(value, subject)

    def roots(self) -> Iterator[dict[str, Json]]:
        """Yield the objects that are in no other, each with those that are in it."""
        done: set[Node] = set()
        for node in self._entries:
            if node not in self._nested:
                yield self._write(node, done)
        for node in self._entries:
            # Parts that run in a circle are in nothing that was written.
            if node not in done:
                yield self._write(node, done)

    def _write(self, node: Node, done: set[Node]) -> dict[str, Json]:
        done.add(node)
        entry, compaction = self._entries[node], self._compaction
        written: dict[str, Json] = {"id": compaction.id(node)}
        if entry.types:
            # Everything is a named individual; what else it is tells more.
            kinds = sorted(entry.types, key=lambda kind: (kind == OWL.NamedIndividual, kind in {USD.Prim, U2K.Object}))
            written["type"] = [compaction.type(kind) for kind in kinds]
        for key, terms in sorted(entry.values.items(), key=lambda item: compaction.rank(item[0])):
            values = [self._value(term, key, node, done) for term in terms]
            written[key.name] = values if key.is_list or len(values) > 1 else values[0]
        return written

    def _value(self, term: Node | ox.Literal, key: _Key, owner: Node, done: set[Node]) -> Json:
        if not isinstance(term, ox.Literal) and self._nested.get(term) == owner and term not in done:
            return self._write(term, done)
        return self._compaction.value(term, key)


def _is_part(value: ox.NamedNode, subject: Node) -> bool:
    """Return whether a node belongs to the other, or both to one object, by their IRIs."""
    owner, hyphen, _ = value.value.rpartition(_PART)
    return bool(hyphen) and owner in {subject.value, subject.value.rpartition(_PART)[0]} and value != subject
