"""Registry of published ontologies: addresses, versions and hashes of their documents."""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from usd2kg.errors import OntologyError
from usd2kg.knowledge import data_file
from usd2kg.ontology.built_in import BUILT_IN
from usd2kg.ontology.catalog import CATALOG

__all__ = ["KnownDocument", "KnownOntology", "read_registry"]

_FILE_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,100}")
_SHA256 = re.compile(r"[0-9a-f]{64}|")


@dataclass(frozen=True, slots=True)
class KnownDocument:
    """One document of an ontology."""

    iri: str
    """IRI by which other documents import it."""
    file: str
    """Name of the local file, without a path."""
    address: str
    """URL to fetch it from."""
    sha256: str
    """Hexadecimal SHA-256 of the bytes; empty to accept any."""


@dataclass(frozen=True, slots=True)
class KnownOntology:
    """An ontology and the documents it needs."""

    name: str
    title: str
    version: str
    licence: str
    documents: tuple[KnownDocument, ...]
    """The ontology itself first, then what it imports; empty if it cannot be fetched by name."""
    website: str = ""
    """Where to get an ontology that has no documents and is not built in."""
    built_in: str = ""
    """Name of the data file of a built-in ontology."""


def read_registry(path: Path | None = None) -> Mapping[str, KnownOntology]:
    """Return name → ontology, from the built-in registry or from a file of the same form.

    Raises:
        OntologyError: the file cannot be read, or an entry is malformed.
    """
    source = str(path) if path is not None else "registry.toml"
    try:
        text = (path or data_file("registry.toml")).read_text(encoding="utf-8")
        entries = tomllib.loads(text)["ontology"]
        known = [_ontology(source, entry) for entry in entries]
    except OSError as error:
        raise OntologyError(
            f"{source}: cannot be read ({error.strerror}); expected a registry of ontologies"
        ) from error
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise OntologyError(
            f"{source}: is not a registry ({error!r}); expected [[ontology]] tables with name, title, version, licence "
            "and [[ontology.document]] with iri, file, address, sha256"
        ) from error
    return {ontology.name: ontology for ontology in known}


def _ontology(source: str, entry: Mapping[str, Any]) -> KnownOntology:
    name, title, version, licence = (str(entry[key]) for key in ("name", "title", "version", "licence"))
    documents = tuple(_document(source, document) for document in entry.get("document", ()))
    website, built_in = (str(entry.get(key, "")) for key in ("website", "built_in"))
    if not documents and not website and built_in not in BUILT_IN.values():
        raise OntologyError(f"{source}: the ontology {name!r} has no [[ontology.document]] and no website; add one")
    return KnownOntology(name, title, version, licence, documents, website, built_in)


def _document(source: str, entry: Mapping[str, Any]) -> KnownDocument:
    document = KnownDocument(*(str(entry[key]) for key in ("iri", "file", "address", "sha256")))
    if not _FILE_NAME.fullmatch(document.file):
        raise OntologyError(
            f"{source}: the file {document.file!r} is not a plain file name; expected one without a path"
        )
    # Some file systems ignore case.
    if document.file.lower() == CATALOG:
        raise OntologyError(f"{source}: the file {document.file!r} is reserved for the catalog; choose another name")
    if not _SHA256.fullmatch(document.sha256):
        raise OntologyError(f"{source}: {document.file}: sha256 is not 64 hexadecimal digits; fix it or leave it empty")
    return document
