"""fetch_ontology: the documents of a known ontology, from the network, into a folder that can be used offline.

Nothing else in this package uses the network.
"""

import hashlib
import urllib.error
import urllib.request
from collections.abc import Callable, Sequence
from pathlib import Path
from urllib.parse import urlsplit
from xml.sax.saxutils import quoteattr

from usd2kg.errors import OntologyError, OutputError
from usd2kg.files import write_whole
from usd2kg.ontology.registry import KnownDocument, KnownOntology
from usd2kg.ontology.sniff import sniff_syntax

__all__ = ["fetch_ontology"]

_ACCEPT = "text/turtle, application/rdf+xml, text/owl-functional, application/owl+xml, */*;q=0.5"
_TIMEOUT_S = 60.0
_MOST_BYTES = 200_000_000


def fetch_ontology(
    ontology: KnownOntology,
    folder: Path,
    *,
    takes_changed: bool = False,
    tell: Callable[[str], None] = lambda line: None,
) -> Path:
    """Fetch an ontology's documents with a catalog for them, and return the file to load.

    Documents that are in the folder already, with the right hash, are not fetched. All are fetched before any is
    written, so that a folder never holds a part of a new version.

    Args:
        ontology: what is fetched.
        folder: where to; made if it is not there.
        takes_changed: whether a document is taken though its hash is not the known one.
        tell: told a line for each document.

    Raises:
        OntologyError: a document cannot be fetched, is no ontology, or is another one than known.
        OutputError: the folder cannot be written to.
    """
    fetched = {}
    for document in ontology.documents:
        path = folder / document.file
        if document.sha256 and path.is_file() and _digest(path.read_bytes()) == document.sha256:
            tell(f"{path}: is there already")
            continue
        fetched[path] = _fetch(document, takes_changed=takes_changed)
        tell(f"{path}: {len(fetched[path]):,} bytes from {document.address}, sha256 {_digest(fetched[path])}")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: cannot be made ({error.strerror}); choose another folder") from error
    for path, data in fetched.items():
        write_whole(path, data)
    write_whole(folder / "catalog-v001.xml", _catalog(ontology.documents).encode())
    return folder / ontology.documents[0].file


def _fetch(document: KnownDocument, *, takes_changed: bool) -> bytes:
    data = _download(document.address)
    try:
        is_ontology = sniff_syntax(data.decode("utf-8-sig")) is not None
    except UnicodeDecodeError:
        is_ontology = False
    if not is_ontology:
        raise OntologyError(
            f"{document.address}: gave {data[:40]!r}, expected an ontology; has <{document.iri}> moved?"
        )
    found = _digest(data)
    if document.sha256 and found != document.sha256 and not takes_changed:
        raise OntologyError(
            f"{document.address}: sha256 is {found}, expected {document.sha256}: it is another version; look at it, "
            "and take it with --changed if it is right"
        )
    return data


def _download(address: str) -> bytes:
    parts = urlsplit(address)
    # Plain http is for what only http offers; the hash then vouches for the bytes.
    if parts.scheme not in {"http", "https"}:
        raise OntologyError(f"{address}: is no web address; expected https://… or http://…")
    request = urllib.request.Request(address, headers={"Accept": _ACCEPT, "User-Agent": "usd2kg"})
    try:
        with urllib.request.urlopen(request, timeout=_TIMEOUT_S) as answer:
            data: bytes = answer.read(_MOST_BYTES + 1)
    except urllib.error.HTTPError as error:
        raise OntologyError(f"{address}: the server answered {error.code} {error.reason}; expected 200") from error
    except (OSError, ValueError) as error:
        reason = getattr(error, "reason", error)
        raise OntologyError(f"{address}: cannot be reached ({reason}); is this machine online?") from error
    if len(data) > _MOST_BYTES:
        raise OntologyError(f"{address}: is longer than {_MOST_BYTES:,} bytes; expected an ontology")
    return data


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _catalog(documents: Sequence[KnownDocument]) -> str:
    """Return an OASIS XML catalog that leads from IRIs to the files beside it."""
    lines = [f"  <uri name={quoteattr(document.iri)} uri={quoteattr(document.file)}/>" for document in documents]
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            '<catalog prefer="public" xmlns="urn:oasis:names:tc:entity:xmlns:xml:catalog">',
            *lines,
            "</catalog>\n",
        ]
    )
