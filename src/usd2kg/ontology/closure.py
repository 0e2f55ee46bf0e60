"""read_closure: the imports closure of an ontology as triples, for self-contained graphs."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib.resources import as_file
from pathlib import Path
from typing import Any

import pyoxigraph as ox

from usd2kg.knowledge import data_file
from usd2kg.ontology.built_in import BUILT_IN, built_in_document
from usd2kg.ontology.catalog import find_document
from usd2kg.ontology.documents import Document, close_imports, parse_document, parse_import, read_triples
from usd2kg.ontology.model import TBox
from usd2kg.ontology.namespaces import OWL, RDF

__all__ = ["Closure", "read_closure", "without_header"]

_TYPE = ox.NamedNode(f"{RDF}type")
_ONTOLOGY = ox.NamedNode(f"{OWL}Ontology")


@dataclass(frozen=True)
class Closure:
    """The triples of an ontology and its imports, without ontology headers."""

    triples: tuple[ox.Triple, ...]
    """In document order; blank nodes are renamed so that those of different documents differ."""
    documents: tuple[str, ...]
    """IRIs of the documents, the ontology itself first."""
    missing: tuple[str, ...]
    """IRIs of imports that were not found, sorted."""


def read_closure(tbox: TBox, also: Iterable[str] = ()) -> Closure:
    """Return the documents of a TBox, and those of `also` that are in its folder, as triples.

    Raises:
        OntologyError: a document can no longer be read.
    """
    if tbox.source in BUILT_IN:
        with as_file(data_file(BUILT_IN[tbox.source])) as path:
            return _read(path, also)
    return _read(Path(tbox.source), also)


def _read(path: Path, also: Iterable[str]) -> Closure:
    found: dict[str, Document] = {}
    missing: set[str] = set()
    pending = [parse_document(path)]
    for iri in also:
        located = find_document(iri, path.parent)
        if located is not None:
            pending.append(parse_import(located, path.parent))
        elif iri != pending[0].iri:
            missing.add(iri)
    for document in pending:
        closed, _ = close_imports(document)
        for part in closed:
            found.setdefault(part.digest, part)
    documents = list(found.values())
    known = {iri for document in documents for iri in (document.iri, document.version_iri)}
    # The IRI that a document declares may differ from the IRI by which it is imported.
    missing |= {
        iri
        for document in documents
        for iri in document.imports
        if find_document(iri, Path(document.source).parent) is None and built_in_document(iri) is None
    }
    triples: list[ox.Triple] = []
    for number, document in enumerate(documents):
        triples.extend(without_header(read_triples(Path(document.source)), f"d{number}n"))
    return Closure(tuple(triples), tuple(document.iri for document in documents), tuple(sorted(missing - known)))


def without_header(triples: Iterable[ox.Triple], prefix: str) -> Iterator[ox.Triple]:
    """Yield the triples except the ontology header, with blank nodes renamed to `prefix` and a number."""
    triples = list(triples)
    headers = {triple.subject for triple in triples if triple.predicate == _TYPE and triple.object == _ONTOLOGY}
    names: dict[ox.BlankNode, ox.BlankNode] = {}

    def rename(node: Any) -> Any:
        if isinstance(node, ox.BlankNode):
            return names.setdefault(node, ox.BlankNode(f"{prefix}{len(names)}"))
        return node

    for triple in triples:
        if triple.subject not in headers:
            yield ox.Triple(rename(triple.subject), triple.predicate, rename(triple.object))
