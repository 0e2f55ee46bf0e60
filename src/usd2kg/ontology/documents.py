"""Ontology documents: parse them and resolve their imports locally."""

import hashlib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import pyoxigraph as ox

from usd2kg.errors import OntologyError
from usd2kg.ontology.built_in import built_in_document
from usd2kg.ontology.catalog import CATALOG, find_document
from usd2kg.ontology.class_axioms import ClassAxioms
from usd2kg.ontology.model import OntologyNote
from usd2kg.ontology.owl_syntax import owl_as_rdf, read_owl_axioms
from usd2kg.ontology.rdf_syntax import parse_rdf, read_rdf_axioms
from usd2kg.ontology.sniff import sniff_syntax
from usd2kg.ontology.source_files import decode_text, read_source

__all__ = ["Document", "close_imports", "parse_document", "parse_import", "read_triples"]

_SYNTAXES = {
    "ofn": "OWL functional syntax",
    "omn": "Manchester syntax",
    "owx": "OWL/XML",
    "rdf": "RDF/XML",
    "ttl": "Turtle or N-Triples",
    "jsonld": "JSON-LD",
}
_OWL_SYNTAXES: dict[str, Literal["ofn", "omn", "owx"]] = {"ofn": "ofn", "omn": "omn", "owx": "owx"}


@dataclass(frozen=True)
class Document:
    """One parsed ontology document."""

    source: str
    iri: str
    version_iri: str | None
    imports: tuple[str, ...]
    """Imported IRIs, sorted."""
    axioms: ClassAxioms
    digest: str
    """SHA-256 of the bytes, hexadecimal."""


def parse_document(path: Path, *, quotes: bool = True) -> Document:
    """Return the parsed ontology at `path`.

    Args:
        path: the file.
        quotes: whether error messages may quote the content of the file.

    Raises:
        OntologyError: the file is missing, malformed, or in an unknown syntax.
    """
    data = read_source(path)
    text = decode_text(path, data)
    syntax = sniff_syntax(text)
    known = ", ".join(_SYNTAXES.values())
    if syntax is None:
        found = f" (begins with {' '.join(text[:60].split())!r})" if quotes else ""
        raise OntologyError(f"{path}: not an ontology{found}, expected one of {known}")
    try:
        owl_syntax = _OWL_SYNTAXES.get(syntax)
        axioms = read_owl_axioms(text, owl_syntax) if owl_syntax else read_rdf_axioms(text, syntax)
    except (ValueError, SyntaxError, MemoryError) as error:
        found = f" ({_shorten(str(error))})" if quotes else ""
        raise OntologyError(
            f"{path}: looks like {_SYNTAXES[syntax]} but does not parse{found}; fix or re-export it"
        ) from error
    return Document(
        source=str(path),
        iri=axioms.ontology_iri or path.resolve().as_uri(),
        version_iri=axioms.version_iri,
        imports=tuple(sorted(axioms.imports)),
        axioms=axioms,
        digest=hashlib.sha256(data).hexdigest(),
    )


def read_triples(path: Path) -> list[ox.Triple]:
    """Return the document at `path` as RDF triples (OWL 2 Mapping to RDF Graphs), in any syntax.

    Raises:
        OntologyError: the file is missing, malformed, or in an unknown syntax.
    """
    text = decode_text(path, read_source(path))
    syntax = sniff_syntax(text)
    try:
        owl_syntax = _OWL_SYNTAXES.get(syntax or "")
        quads = parse_rdf(owl_as_rdf(text, owl_syntax), "rdf") if owl_syntax else parse_rdf(text, syntax or "ttl")
        return [quad.triple for quad in quads]
    except (ValueError, SyntaxError, MemoryError) as error:
        raise OntologyError(f"{path}: cannot be read as RDF ({_shorten(str(error))}); fix or re-export it") from error


def _shorten(message: str, limit: int = 200) -> str:
    line = " ".join(message.replace("Failed to open ontology: ", "").split())
    return line if len(line) <= limit else line[: limit - 1] + "…"


def close_imports(document: Document) -> tuple[tuple[Document, ...], tuple[OntologyNote, ...]]:
    """Return `document` with its transitive imports, and a note for each import that is missing.

    Imports are resolved by the OASIS catalog (`catalog-v001.xml`) in the folder of the importing document, then by file
    name in that folder, then by the IRI that a file there declares, then by the built-in ontologies. Nothing is fetched
    from the network.
    """
    found = {document.iri: document}
    if document.version_iri:
        found[document.version_iri] = document
    notes: list[OntologyNote] = []
    missing: set[str] = set()
    pending = [document]
    while pending:
        current = pending.pop()
        for iri in current.imports:
            if iri in found or iri in missing:
                continue
            folder = Path(current.source).parent
            path = find_document(iri, folder)
            built_in = built_in_document(iri) if path is None else None
            if built_in is not None:
                found[iri] = replace(parse_document(built_in), iri=iri)
                continue
            if path is None:
                missing.add(iri)
                notes.append(OntologyNote("missing-import", _missing_import(iri, current)))
                continue
            imported = parse_import(path, folder)
            # An import may resolve to a document that declares another ontology IRI: register it under both.
            found[iri] = imported
            if imported.iri not in found or imported.iri == iri:
                pending.append(imported)
    distinct = {doc.digest: doc for doc in found.values()}
    others = sorted((doc for doc in distinct.values() if doc.digest != document.digest), key=lambda doc: doc.iri)
    return (document, *others), tuple(sorted(notes, key=lambda note: note.message))


def parse_import(path: Path, folder: Path) -> Document:
    """Return the parsed ontology that a document in `folder` imports.

    Raises:
        OntologyError: as `parse_document`. A file outside the folder is never quoted: an untrusted catalog may have
            chosen it.
    """
    return parse_document(path, quotes=path.resolve().is_relative_to(folder.resolve()))


def _missing_import(iri: str, document: Document) -> str:
    return (
        f"{document.source}: imports <{iri}>, which neither {CATALOG} nor a file in the folder names; "
        "the hierarchy is built without it"
    )
