"""OASIS XML catalogs (version 1.1), which map ontology IRIs to local files, and lookup by file name and header."""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath, PureWindowsPath
from urllib.parse import unquote
from xml.etree import ElementTree

from usd2kg.errors import OntologyError
from usd2kg.ontology.source_files import ENDINGS, decode_text, read_source
from usd2kg.ontology.xml_entities import refuse_entity_bomb

__all__ = ["CATALOG", "find_document", "format_catalog"]

CATALOG = "catalog-v001.xml"
"""File name of a catalog."""
_MAX_FILES, _MAX_HEADER = 200, 1 << 20
"""Files of each kind, and bytes of each, that are searched for the IRI of an ontology."""
_NAMESPACE = "urn:oasis:names:tc:entity:xmlns:xml:catalog"
_URI = f"{{{_NAMESPACE}}}uri"


def find_document(iri: str, folder: Path) -> Path | None:
    """Return the local file of an ontology; None if there is none.

    By the catalog of `folder`, else by the name of a file in it, else by the IRI that a file in it declares.
    """
    catalog = _read_catalog(folder / CATALOG)
    if iri in catalog:
        return catalog[iri] if _is_file(catalog[iri]) and _may_be_opened(catalog[iri], folder) else None
    name = iri.rstrip("#/").rpartition("/")[2]
    names = [name, *(Path(name).stem + ending for ending in ENDINGS)]
    # Look up plain file names only: an IRI must not reach other folders.
    named = (folder / n for n in names if n and n not in {".", ".."} and _is_file(folder / n))
    return next(named, None) or next(_declaring(iri, folder), None)


def _declaring(iri: str, folder: Path) -> Iterator[Path]:
    """Yield the ontology files of a folder that declare an ontology IRI at their beginning."""
    own = re.escape(iri.rstrip("#/")) + "[#/]?"
    header = re.compile(
        rf"<{own}>\s+(a|rdf:type)\s+owl:Ontology|owl:Ontology\s+rdf:about=[\"']{own}[\"']|ontologyIRI=[\"']{own}[\"']"
        rf"|\bOntology(\s*\(|:)\s*<{own}>"
    )
    for ending in ENDINGS:
        for path in filter(_is_file, sorted(folder.glob(f"*{ending}"))[:_MAX_FILES]):
            try:
                with path.open("rb") as file:
                    beginning = file.read(_MAX_HEADER)
            except OSError:
                continue
            # Most files do not mention it, and a search of bytes is fast.
            if iri.rstrip("#/").encode() in beginning and header.search(beginning.decode("utf-8", "replace")):
                yield path


def _may_be_opened(path: Path, folder: Path) -> bool:
    """Return whether a file named by an untrusted catalog is in its folder or has the extension of an ontology."""
    target = path.resolve()
    return target.is_relative_to(folder.resolve()) or target.suffix.lower() in ENDINGS


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:
        # A name may be too long for the file system.
        return False


def _read_catalog(path: Path) -> dict[str, Path]:
    if not path.is_file():
        return {}
    text = decode_text(path, read_source(path), "a catalog")
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
    for entry in root.iter(_URI):
        if "name" in entry.attrib and "uri" in entry.attrib and "://" not in entry.attrib["uri"]:
            yield entry


def format_catalog(files: Mapping[str, str]) -> str:
    """Return the XML of a catalog that maps IRIs to files in its folder."""
    from xml.sax.saxutils import quoteattr  # noqa: PLC0415 - loads the HTTP client

    lines = [f"  <uri name={quoteattr(iri)} uri={quoteattr(file)}/>" for iri, file in files.items()]
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<catalog prefer="public" xmlns="{_NAMESPACE}">',
            *lines,
            "</catalog>\n",
        ]
    )
