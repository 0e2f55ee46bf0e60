"""SSSOM/TSV files (https://mapping-commons.github.io/sssom/spec/), version 1.1: header, CURIEs and rows."""

import csv
import io
import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from usd2kg.errors import GroundingError
from usd2kg.spreadsheet import guard_formula, unguard_formula

__all__ = ["Curies", "SssomFile", "SssomRow", "cell_text", "format_sssom_file", "read_sssom_file"]

_BUILT_IN = {
    "owl": "http://www.w3.org/2002/07/owl#",
    "rdf": "http://www.w3.org/1999/02/22-rdf-syntax-ns#",
    "rdfs": "http://www.w3.org/2000/01/rdf-schema#",
    "semapv": "https://w3id.org/semapv/vocab/",
    "skos": "http://www.w3.org/2004/02/skos/core#",
    "sssom": "https://w3id.org/sssom/",
}
"""Prefixes that are predefined in SSSOM."""
_LOCAL = re.compile(r"[^#/:]+")
"""Local name of an IRI in a namespace."""


class Curies:
    """Shortens IRIs to CURIEs and collects the prefixes in use."""

    def __init__(self, prefixes: Mapping[str, str], used: Iterable[str] = ()) -> None:
        """Create a set of prefixes.

        Args:
            prefixes: prefix → namespace; where two namespaces fit, the later prefix is used.
            used: prefixes to declare in any case.
        """
        self._known = {namespace: prefix for prefix, namespace in prefixes.items()}
        self.used = {prefix: prefixes[prefix] for prefix in used}
        """Prefix → namespace."""

    def shorten(self, iri: str) -> str:
        """Return the CURIE of an IRI; an unknown namespace gets the prefix ns1, ns2…"""
        end = max(iri.rfind("#"), iri.rfind("/"), iri.rfind(":")) + 1
        for namespace in reversed(self._known):
            if iri.startswith(namespace) and _LOCAL.fullmatch(iri, len(namespace)):
                end = len(namespace)
                break
        namespace = iri[:end]
        if namespace not in self._known:
            taken = {*self._known.values()}
            count = next(number for number in range(1, len(taken) + 2) if f"ns{number}" not in taken)
            # In front, so that the given prefixes come first.
            self._known = {namespace: f"ns{count}", **self._known}
        self.used[self._known[namespace]] = namespace
        return f"{self._known[namespace]}:{iri[end:]}"


class SssomRow(NamedTuple):
    """One mapping."""

    line: int
    cells: Mapping[str, str]


class SssomFile(NamedTuple):
    """A parsed file; its CURIEs are not expanded."""

    slots: Mapping[str, str]
    """Header slot → value, without lists and nested values."""
    prefixes: Mapping[str, str]
    """Prefix → namespace."""
    rows: tuple[SssomRow, ...]

    def expand(self, curie: str) -> str:
        """Return the IRI of a CURIE; other text is returned unchanged."""
        prefix, colon, name = curie.partition(":")
        is_curie = colon and prefix in self.prefixes and not name.startswith("//")
        return self.prefixes[prefix] + name if is_curie else curie


def read_sssom_file(
    path: Path, text: str, required: Sequence[str], expected: str, prefixes: Mapping[str, str] | None = None
) -> SssomFile:
    """Return the header and the rows of a file.

    Args:
        path: the file, for errors.
        text: its content.
        required: columns that it must have.
        expected: the end of an error message: what is expected instead.
        prefixes: prefix → namespace, for prefixes that the file does not declare.

    Raises:
        GroundingError: a column is missing, or the text is not TSV.
    """
    lines = [_header_line(line) for line in text.splitlines(keepends=True)]
    start = next((number for number, line in enumerate(lines) if not line.startswith("#")), len(lines))
    slots, declared = _read_header(lines[:start])
    return SssomFile(
        slots, {**(prefixes or {}), **_BUILT_IN, **declared}, tuple(_read_rows(path, lines, start, required, expected))
    )


def _header_line(line: str) -> str:
    """Return a line; if it is one of a header that a spreadsheet has quoted, without the quotes."""
    return next(csv.reader([line], delimiter="\t"))[0] if line.startswith('"#') else line


def _read_header(lines: Iterable[str]) -> tuple[dict[str, str], dict[str, str]]:
    """Return the slots and the curie_map of the header, which is YAML with a `#` before each line."""
    slots: dict[str, str] = {}
    prefixes: dict[str, str] = {}
    is_map = False
    for line in lines:
        if top := re.match(r"#\s?([\w.-]+):\s*(.*?)\s*$", line):
            is_map = top[1] == "curie_map"
            if top[2]:
                slots[top[1]] = _unquote(top[2])
        elif is_map and (pair := re.match(r"#\s+[\"']?([\w.-]*)[\"']?:\s+[\"']?([^\s\"']+)[\"']?\s*$", line)):
            prefixes[pair[1]] = pair[2]
    return slots, prefixes


def _unquote(value: str) -> str:
    """Return the text of a YAML scalar, plain or quoted."""
    try:
        return str(json.loads(value)) if value.startswith('"') else value.strip("'")
    except ValueError:
        return value


def _read_rows(
    path: Path, lines: Sequence[str], start: int, required: Sequence[str], expected: str
) -> Iterator[SssomRow]:
    """Yield the rows below the first `start` lines, each with the number of its last line."""
    rows = csv.DictReader(lines[start:], delimiter="\t", strict=True)
    try:
        missing = [name for name in required if name not in (rows.fieldnames or ())]
        if missing:
            raise GroundingError(f"{path}: line {start + 1} has no column {missing[0]}; {expected}")
        for row in rows:
            cells = {
                name: unguard_formula((value or "").strip()) for name, value in row.items() if isinstance(name, str)
            }
            yield SssomRow(start + rows.line_num, cells)
    except csv.Error as error:
        raise GroundingError(f"{path}: line {start + rows.line_num} is not TSV ({error}); {expected}") from error


def cell_text(text: str) -> str:
    r"""Return text for a cell: on one line, since many TSV readers do not unescape line breaks and tabs.

    Names on a stage are untrusted: control characters, which a terminal would obey, become U+FFFD, and an apostrophe
    precedes what a spreadsheet would evaluate. `read_sssom_file` removes it.

    >>> cell_text("a\tb\x1b[2J"), cell_text("=1+1")
    ('a b\ufffd[2J', "'=1+1")
    """
    return guard_formula(_printable_line(text))


def _printable_line(text: str) -> str:
    line = " ".join(text.split())
    return line if line.isprintable() else "".join(c if c.isprintable() else "\ufffd" for c in line)


def format_sssom_file(
    header: Mapping[str, str],
    curies: Curies,
    extensions: Mapping[str, str],
    columns: Sequence[str],
    rows: Iterable[Mapping[str, str]],
) -> str:
    """Return the text of a file.

    Args:
        header: slot → value.
        curies: the prefixes in use.
        extensions: extension slot or column → CURIE of its property.
        columns: names of the columns.
        rows: column → cell.
    """
    lines = ['sssom_version: "1.1"', "curie_map:"]
    # Every JSON string is a YAML string.
    lines += [f"  {prefix}: {json.dumps(iri)}" for prefix, iri in sorted(curies.used.items())]
    lines += [f"{name}: {json.dumps(_printable_line(value))}" for name, value in header.items()]
    lines.append("extension_definitions:")
    for name, term in extensions.items():
        lines += [f"- slot_name: {name}", f"  property: {term}", "  type_hint: xsd:string"]
    text = io.StringIO(newline="")
    text.writelines(f"#{line}\n" for line in lines)
    writer = csv.DictWriter(text, columns, delimiter="\t", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()
