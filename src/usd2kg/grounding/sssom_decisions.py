"""Decisions of people in an SSSOM/TSV mapping file, https://mapping-commons.github.io/sssom/spec/."""

import csv
import logging
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from usd2kg.errors import GroundingError, OntologyError
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["is_sssom", "read_sssom_decisions"]

logger = logging.getLogger(__name__)

_CURATED = "ManualMappingCuration"
_TYPE = "http://www.w3.org/1999/02/22-rdf-syntax-ns#type"
_NO_TERM = "https://w3id.org/sssom/NoTermFound"
_BUILT_IN = {
    "owl": "http://www.w3.org/2002/07/owl#",
    "rdf": "http://www.w3.org/1999/02/22-rdf-syntax-ns#",
    "rdfs": "http://www.w3.org/2000/01/rdf-schema#",
    "semapv": "https://w3id.org/semapv/vocab/",
    "skos": "http://www.w3.org/2004/02/skos/core#",
    "sssom": "https://w3id.org/sssom/",
}
"""Prefixes that are predefined in SSSOM."""
_REQUIRED = ("prim_path", "predicate_id", "object_id", "mapping_justification")
_EXPECTED = "expected SSSOM/TSV with the column prim_path, as usd2kg ground --format sssom writes it"


class _Row(NamedTuple):
    line: int
    cells: Mapping[str, str]


def is_sssom(path: Path) -> bool:
    """Return whether a file name ends in .tsv."""
    return path.suffix.lower() == ".tsv"


def read_sssom_decisions(path: Path, text: str, tbox: TBox) -> dict[str, ClassIRI]:
    """Return prim path → class for the rows that a person curated or reviewed; other rows are ignored.

    A reviewed row has a reviewer (reviewer_id or reviewer_label); a curated row has the justification
    semapv:ManualMappingCuration. Negated rows (predicate_modifier) and sssom:NoTermFound give no class.

    Raises:
        GroundingError: a column is missing, a predicate is not rdf:type, a class is not in scope, or a prim has two.
    """
    prefixes = _BUILT_IN | dict(_read_prefixes(text))
    decisions: dict[str, ClassIRI] = {}
    rows = list(_read_rows(path, text))
    for line, cells in rows:
        if not _is_decided(cells) or _expand(cells["object_id"], prefixes) == _NO_TERM:
            continue
        iri = _read_class(f"{path}: line {line}", cells, prefixes, tbox)
        if decisions.setdefault(cells["prim_path"], iri) != iri:
            raise GroundingError(f"{path}: line {line}: {cells['prim_path']} has two decisions; leave one")
    if rows and not decisions:
        problem = "none of its %d rows was decided by a person, so none is a decision; fill in reviewer_label"
        logger.warning(f"%s: {problem}", path, len(rows))
    return decisions


def _is_decided(cells: Mapping[str, str]) -> bool:
    has_reviewer = bool(cells.get("reviewer_id") or cells.get("reviewer_label"))
    is_curated = cells["mapping_justification"].endswith(_CURATED)
    return (has_reviewer or is_curated) and not cells.get("predicate_modifier")


def _read_class(where: str, cells: Mapping[str, str], prefixes: Mapping[str, str], tbox: TBox) -> ClassIRI:
    if not cells["prim_path"]:
        raise GroundingError(f"{where}: prim_path is empty; {_EXPECTED}")
    if _expand(cells["predicate_id"], prefixes) != _TYPE:
        raise GroundingError(f"{where}: the predicate is {cells['predicate_id']!r}; expected rdf:type, or no reviewer")
    try:
        return tbox.resolve(_expand(cells["object_id"], prefixes))
    except OntologyError as error:
        raise GroundingError(f"{where}: {error}") from error


def _expand(curie: str, prefixes: Mapping[str, str]) -> str:
    prefix, colon, name = curie.partition(":")
    return prefixes[prefix] + name if colon and prefix in prefixes and not name.startswith("//") else curie


def _read_prefixes(text: str) -> Iterator[tuple[str, str]]:
    """Yield the prefixes of the curie_map in the header, which is YAML with a `#` before each line."""
    is_inside = False
    for line in text.splitlines():
        if not line.startswith("#"):
            return
        if re.match(r"#\s?\S", line) and not re.match(r"#\s{2,}", line):
            is_inside = bool(re.match(r"#\s?curie_map:\s*$", line))
        elif is_inside and (found := re.match(r"#\s+[\"']?([\w.-]*)[\"']?:\s+[\"']?([^\s\"']+)[\"']?\s*$", line)):
            yield found[1], found[2]


def _read_rows(path: Path, text: str) -> Iterator[_Row]:
    """Yield the rows, each with the number of its last line."""
    lines = text.splitlines(keepends=True)
    start = next((number for number, line in enumerate(lines) if not line.startswith("#")), len(lines))
    rows = csv.DictReader(lines[start:], delimiter="\t", strict=True)
    try:
        missing = [name for name in _REQUIRED if name not in (rows.fieldnames or ())]
        if missing:
            raise GroundingError(f"{path}: line {start + 1} has no column {missing[0]}; {_EXPECTED}")
        for row in rows:
            cells = {name: (value or "").strip() for name, value in row.items() if isinstance(name, str)}
            yield _Row(start + rows.line_num, cells)
    except csv.Error as error:
        raise GroundingError(f"{path}: line {start + rows.line_num} is not TSV ({error}); {_EXPECTED}") from error
