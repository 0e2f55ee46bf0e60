"""fetch_ontology: download the documents of a known ontology into a folder for offline use.

Nothing else in `usd2kg.ontology` uses the network.
"""

import hashlib
import re
import urllib.error
import urllib.request
from collections.abc import Callable
from http.client import HTTPException, InvalidURL
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from usd2kg.errors import OntologyError, OutputError
from usd2kg.files import write_whole
from usd2kg.knowledge import read_bytes
from usd2kg.ontology.catalog import CATALOG, format_catalog
from usd2kg.ontology.known_ontologies import KnownDocument, KnownOntology
from usd2kg.ontology.limits import DOWNLOAD
from usd2kg.ontology.sniff import sniff_syntax

__all__ = ["fetch_ontology", "shown_address"]

_ACCEPT = "text/turtle, application/rdf+xml, text/owl-functional, application/owl+xml, */*;q=0.5"
_SCHEMES = {"http", "https"}


def fetch_ontology(
    ontology: KnownOntology,
    folder: Path,
    *,
    accepts_changed: bool = False,
    report: Callable[[str], None] = lambda line: None,
) -> Path:
    """Download the documents of an ontology with a catalog, and return the file to load; write a built-in one.

    Documents that exist with the right hash are not downloaded. All are downloaded before any is written, so that the
    folder never holds half of a new version.

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
    data, shown = _download(document.address), shown_address(document.address)
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


class _WebOnly(urllib.request.HTTPRedirectHandler):
    """Follows redirects to http and https only."""

    def redirect_request(self, *args: Any) -> urllib.request.Request | None:
        address = args[-1]
        if urlsplit(address).scheme not in _SCHEMES:
            raise urllib.error.URLError(f"it redirects to {shown_address(address)}, which is not a web address")
        return super().redirect_request(*args)


def _opener() -> urllib.request.OpenerDirector:
    opener = urllib.request.OpenerDirector()
    for handler in (
        urllib.request.ProxyHandler(),
        urllib.request.HTTPHandler(),
        urllib.request.HTTPSHandler(),
        urllib.request.HTTPDefaultErrorHandler(),
        urllib.request.HTTPErrorProcessor(),
        _WebOnly(),
    ):
        opener.add_handler(handler)
    return opener


def shown_address(address: str) -> str:
    """Return a web address without user, password, query and fragment, which may be secret, for printing.

    >>> shown_address("https://me:secret@lab.example/onto.ttl?key=1")
    'https://lab.example/onto.ttl'
    """
    place = re.split(r"[?#]", address, maxsplit=1)[0]
    return re.sub(r"^([^/]*//)[^/]*@", r"\1", place)


def _download(address: str) -> bytes:
    shown = shown_address(address)
    # Plain http is accepted because some ontologies are not served otherwise; the hash protects the content.
    if address.partition(":")[0].lower() not in _SCHEMES:
        raise OntologyError(f"{shown}: is not a web address; expected https://… or http://…")
    try:
        request = urllib.request.Request(address, headers={"Accept": _ACCEPT, "User-Agent": "usd2kg"})
        with _opener().open(request, timeout=DOWNLOAD.timeout_s) as answer:
            data: bytes = answer.read(DOWNLOAD.document_bytes + 1)
            promised = answer.headers.get("Content-Length", "")
    except urllib.error.HTTPError as error:
        error.close()
        raise OntologyError(f"{shown}: the server answered {error.code}; expected 200") from error
    except (ValueError, InvalidURL) as error:
        raise OntologyError(f"{shown}: is not a valid address; fix it in the registry") from error
    except HTTPException as error:
        raise OntologyError(
            f"{shown}: the server did not answer in HTTP ({type(error).__name__}); try again"
        ) from error
    except OSError as error:
        reason = getattr(error, "reason", error)
        raise OntologyError(f"{shown}: cannot be reached ({reason}); is this machine online?") from error
    if len(data) > DOWNLOAD.document_bytes:
        raise OntologyError(f"{shown}: is longer than {DOWNLOAD.document_bytes:,} bytes; expected an ontology")
    # A sized read does not report a connection that ended early.
    if promised.isascii() and promised.isdigit() and len(data) < int(promised):
        raise OntologyError(f"{shown}: ended after {len(data):,} of {int(promised):,} bytes; try again")
    return data


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
