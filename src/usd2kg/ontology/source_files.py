"""Read ontology files and catalogs as text, with errors that name the file."""

from pathlib import Path

from usd2kg.errors import OntologyError

__all__ = ["ENDINGS", "decode_text", "read_source"]

ENDINGS = (".jsonld", ".nt", ".ofn", ".omn", ".owl", ".owx", ".rdf", ".ttl", ".xml")
"""File extensions of ontologies, sorted."""


def read_source(path: Path) -> bytes:
    """Return the bytes of a file.

    Raises:
        OntologyError: the file is missing, a folder, or unreadable.
    """
    if path.is_dir():
        raise OntologyError(f"{path}: is a folder, expected an ontology file; name the file inside it")
    try:
        return path.read_bytes()
    except FileNotFoundError as error:
        raise OntologyError(f"{path}: no such file; expected an ontology ({', '.join(ENDINGS)})") from error
    except OSError as error:
        raise OntologyError(f"{path}: cannot be read ({error.strerror}); check its permissions") from error


def decode_text(path: Path, data: bytes, expected: str = "an ontology") -> str:
    """Return the text of UTF-8 bytes, with or without a byte order mark.

    Raises:
        OntologyError: the bytes are not UTF-8; the message names `expected`.
    """
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise OntologyError(
            f"{path}: byte {error.start} is not UTF-8 text, expected {expected}; is it a binary or compressed file?"
        ) from error
