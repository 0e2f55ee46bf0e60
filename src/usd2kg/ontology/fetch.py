"""fetch_ontology: download the documents of a known ontology into a folder for offline use.

Nothing else in `usd2kg.ontology` uses the network.
"""

import hashlib
from collections.abc import Callable
from pathlib import Path

from usd2kg.download import download, shown_address
from usd2kg.errors import OntologyError, OutputError
from usd2kg.files import write_whole
from usd2kg.knowledge import read_bytes
from usd2kg.ontology.catalog import CATALOG, format_catalog
from usd2kg.ontology.known_ontologies import KnownDocument, KnownOntology
from usd2kg.ontology.limits import DOWNLOAD
from usd2kg.ontology.sniff import sniff_syntax

__all__ = ["fetch_ontology"]

_ACCEPT = "text/turtle, application/rdf+xml, text/owl-functional, application/owl+xml, */*;q=0.5"


def fetch_ontology(
    ontology: KnownOntology,
    folder: Path,
    *,
    accepts_changed: bool = False,
    report: Callable[[str], None] = lambda line: None,
) -> Path:
    """Download the documents of an ontology with a catalog, and return the file to load; write a built-in one.

    Documents that exist with the right hash are not downloaded. All documents are downloaded before any is written, so
    that the folder never contains a partial version.

    Args:
        ontology: the registry entry.
        folder: destination, created if it does not exist.
        accepts_changed: accept documents whose hash differs from the registry.
        report: called with one line per document.

    Raises:
        OntologyError: the registry has no documents of it, or a document cannot be downloaded, is not an ontology, or
            differs from the registry.
        OutputError: the folder cannot be written to.
    """
    if ontology.built_in:
        return _write_built_in(ontology, folder, report)
    if not ontology.documents:
        raise OntologyError(
            f"ontology {ontology.name!r} cannot be fetched by name; download it from {ontology.website}"
        )
    fetched = {}
    for document in ontology.documents:
        path = folder / document.file
        if document.sha256 and path.is_file() and _digest(path.read_bytes()) == document.sha256:
            report(f"{path}: up to date")
            continue
        fetched[path] = _fetch(document, accepts_changed=accepts_changed)
        length, source = len(fetched[path]), shown_address(document.address)
        report(f"{path}: {length:,} bytes from {source}, sha256 {_digest(fetched[path])}")
    _make_folder(folder)
    for path, data in fetched.items():
        write_whole(path, data)
    catalog = format_catalog({document.iri: document.file for document in ontology.documents})
    write_whole(folder / CATALOG, catalog.encode())
    return folder / ontology.documents[0].file


def _write_built_in(ontology: KnownOntology, folder: Path, report: Callable[[str], None]) -> Path:
    data = read_bytes(ontology.built_in)
    _make_folder(folder)
    path = folder / ontology.built_in
    write_whole(path, data)
    report(f"{path}: {len(data):,} bytes, built in")
    return path


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: cannot be created ({error.strerror}); choose another folder") from error


def _fetch(document: KnownDocument, *, accepts_changed: bool) -> bytes:
    shown = shown_address(document.address)
    chunks = download(
        document.address,
        max_bytes=DOWNLOAD.document_bytes,
        timeout_s=DOWNLOAD.timeout_s,
        error=OntologyError,
        accept=_ACCEPT,
    )
    data = b"".join(chunks)
    try:
        is_ontology = sniff_syntax(data.decode("utf-8-sig")) is not None
    except UnicodeDecodeError:
        is_ontology = False
    if not is_ontology:
        raise OntologyError(f"{shown}: returned {data[:40]!r}; expected an ontology; has <{document.iri}> moved?")
    found = _digest(data)
    if document.sha256 and found != document.sha256 and not accepts_changed:
        raise OntologyError(
            f"{shown}: sha256 is {found}, expected {document.sha256}: this is another version; "
            "inspect it, and accept it with --changed"
        )
    return data


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
