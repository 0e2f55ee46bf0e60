"""Ontology documents: parse them and resolve their imports locally."""

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Literal
from urllib.parse import unquote
from xml.etree import ElementTree

import pyoxigraph as ox

from usd2kg.errors import OntologyError
from usd2kg.ontology.class_axioms import ClassAxioms
from usd2kg.ontology.entities import refuse_entity_bomb
from usd2kg.ontology.model import OntologyNote
from usd2kg.ontology.owl_syntax import owl_as_rdf, read_owl_axioms
from usd2kg.ontology.rdf_syntax import parse_rdf, read_rdf_axioms
from usd2kg.ontology.sniff import sniff_syntax

__all__ = ["Document", "close_imports", "find_document", "parse_document", "parse_import", "read_triples"]

_CATALOG = "catalog-v001.xml"
_CATALOG_URI = "{urn:oasis:names:tc:entity:xmlns:xml:catalog}uri"
_ENDINGS = {".owl", ".ofn", ".omn", ".owx", ".rdf", ".ttl", ".nt", ".xml", ".jsonld"}
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
    data = _read(path)
    text = _decode(path, data)
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
    text = _decode(path, _read(path))
    syntax = sniff_syntax(text)
    try:
        owl_syntax = _OWL_SYNTAXES.get(syntax or "")
        quads = parse_rdf(owl_as_rdf(text, owl_syntax), "rdf") if owl_syntax else parse_rdf(text, syntax or "ttl")
        return [quad.triple for quad in quads]
    except (ValueError, SyntaxError, MemoryError) as error:
        raise OntologyError(f"{path}: cannot be read as RDF ({_shorten(str(error))}); fix or re-export it") from error


def _read(path: Path) -> bytes:
    if path.is_dir():
        raise OntologyError(f"{path}: is a folder, expected an ontology file; name the file inside it")
    try:
        return path.read_bytes()
    except FileNotFoundError as error:
        raise OntologyError(f"{path}: no such file; expected an ontology ({', '.join(sorted(_ENDINGS))})") from error
    except OSError as error:
        raise OntologyError(f"{path}: cannot be read ({error.strerror}); check its permissions") from error


def _decode(path: Path, data: bytes, expected: str = "an ontology") -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise OntologyError(
            f"{path}: byte {error.start} is not UTF-8 text, expected {expected}; is it a binary or compressed file?"
        ) from error


def _shorten(message: str, limit: int = 200) -> str:
    line = " ".join(message.replace("Failed to open ontology: ", "").split())
    return line if len(line) <= limit else line[: limit - 1] + "…"


def close_imports(document: Document) -> tuple[tuple[Document, ...], tuple[OntologyNote, ...]]:
    """Return `document` with its transitive imports, and a note for each import that is missing.

    Imports are resolved by the OASIS catalog (`catalog-v001.xml`) in the folder of the importing document, then by file
    name in that folder. Nothing is fetched from the network.
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
            path = find_document(iri, Path(current.source).parent)
            if path is None:
                missing.add(iri)
                notes.append(OntologyNote("missing-import", _missing_import(iri, current)))
                continue
            imported = parse_import(path, Path(current.source).parent)
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
        f"{document.source}: imports <{iri}>, which is neither in {_CATALOG} nor in the folder; "
        "the hierarchy is built without it"
    )


def find_document(iri: str, folder: Path) -> Path | None:
    """Return the local file of an ontology, by the catalog of `folder` or by file name; None if there is none."""
    catalog = _read_catalog(folder / _CATALOG)
    if iri in catalog:
        return catalog[iri] if _is_file(catalog[iri]) else None
    name = iri.rstrip("#/").rpartition("/")[2]
    names = [name, *(Path(name).stem + ending for ending in sorted(_ENDINGS))]
    # Look up plain file names only: an IRI must not reach other folders.
    return next((folder / n for n in names if n and n not in {".", ".."} and _is_file(folder / n)), None)


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:
        # A name may be too long for the file system.
        return False


def _read_catalog(path: Path) -> dict[str, Path]:
    if not path.is_file():
        return {}
    text = _decode(path, _read(path), "a catalog")
    try:
        refuse_entity_bomb(text)
        root = ElementTree.fromstring(text)
    except (SyntaxError, ValueError) as error:
        raise OntologyError(f"{path}: the catalog is not well-formed XML ({error}); fix or remove it") from error
    places = {entry.attrib["name"]: unquote(entry.attrib["uri"]) for entry in _entries(root)}
    # Catalogs are untrusted: accept relative paths, not any file of this machine.
    return {iri: path.parent / place for iri, place in places.items() if not _is_absolute(place)}


def _is_absolute(place: str) -> bool:
    return PurePosixPath(place).is_absolute() or bool(PureWindowsPath(place).anchor)


def _entries(root: ElementTree.Element) -> Iterator[ElementTree.Element]:
    for entry in root.iter(_CATALOG_URI):
        if "name" in entry.attrib and "uri" in entry.attrib and "://" not in entry.attrib["uri"]:
            yield entry
