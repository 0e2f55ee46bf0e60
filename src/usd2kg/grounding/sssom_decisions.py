"""Decisions of people in an SSSOM/TSV mapping file, https://mapping-commons.github.io/sssom/spec/."""

import logging
from collections.abc import Iterable, Mapping
from pathlib import Path

from usd2kg.errors import GroundingError, OntologyError
from usd2kg.grounding.model import Decision
from usd2kg.grounding.sssom_file import SssomFile, SssomRow, read_sssom_file
from usd2kg.ontology import ClassIRI, TBox

__all__ = [
    "EXPECTED",
    "NO_TERM",
    "REQUIRED",
    "VERDICT",
    "is_decided",
    "is_sssom",
    "last_rows",
    "read_class",
    "read_sssom_decisions",
]

logger = logging.getLogger(__name__)

NO_TERM = "https://w3id.org/sssom/NoTermFound"
"""SSSOM's object of a subject that no class fits."""
VERDICT = "verdict"
"""Column of a journal: what a person decided."""
_DECIDED = ("class", "no-class")
"""The verdicts that settle the class; `unsure` and `open` do not."""
_CURATED = "ManualMappingCuration"
_TYPE = "http://www.w3.org/1999/02/22-rdf-syntax-ns#type"
REQUIRED = ("prim_path", "predicate_id", "object_id", "mapping_justification")
EXPECTED = "expected SSSOM/TSV with the column prim_path, as usd2kg ground --format sssom writes it"


def is_sssom(path: Path) -> bool:
    """Return whether a file name ends in .tsv."""
    return path.suffix.lower() == ".tsv"


def read_sssom_decisions(path: Path, text: str, tbox: TBox) -> dict[str, Decision]:
    """Return prim path → decision for the rows that a person curated or reviewed; other rows are ignored.

    A reviewed row has a reviewer (reviewer_id or reviewer_label); a curated row has the justification
    semapv:ManualMappingCuration. Negated rows (predicate_modifier) give no decision; sssom:NoTermFound is the decision
    that no class fits. In a journal, which has the column `verdict`, the last row of a prim is valid.

    Raises:
        GroundingError: a column is missing, a predicate is not rdf:type, a class is not in scope, or a prim has two.
    """
    file = read_sssom_file(path, text, REQUIRED, EXPECTED)
    decisions: dict[str, Decision] = {}
    for line, cells in last_rows(file):
        if not is_decided(cells):
            continue
        where = f"{path}: line {line}"
        decision = Decision(
            read_class(where, cells, file, tbox),
            file.expand(cells.get("reviewer_id", "")) or cells.get("reviewer_label", "").replace(r"\|", "|"),
            comment=cells.get("comment", "") if VERDICT in cells else "",
            time=cells.get("decided_at") or cells.get("review_date", ""),
        )
        if decisions.setdefault(cells["prim_path"], decision).class_iri != decision.class_iri:
            raise GroundingError(f"{where}: {cells['prim_path']} has two decisions; leave one")
    if file.rows and not decisions:
        problem = "none of its %d rows was decided by a person, so none is a decision; fill in reviewer_label"
        logger.warning(f"%s: {problem}", path, len(file.rows))
    return decisions


def last_rows(file: SssomFile) -> Iterable[SssomRow]:
    """Return the rows; of a journal the last one of each prim."""
    if not any(VERDICT in row.cells for row in file.rows):
        return file.rows
    return {row.cells["prim_path"]: row for row in file.rows}.values()


def is_decided(cells: Mapping[str, str]) -> bool:
    """Return whether a person curated or reviewed a row, and settled the class."""
    has_reviewer = bool(cells.get("reviewer_id") or cells.get("reviewer_label"))
    is_curated = cells["mapping_justification"].endswith(_CURATED)
    is_open = cells.get(VERDICT, _DECIDED[0]) not in _DECIDED
    return (has_reviewer or is_curated) and not cells.get("predicate_modifier") and not is_open


def read_class(where: str, cells: Mapping[str, str], file: SssomFile, tbox: TBox) -> ClassIRI | None:
    """Return the class of a row; None if no class fits.

    Raises:
        GroundingError: the prim path is empty, the predicate is not rdf:type, or the class is not in scope.
    """
    if not cells["prim_path"]:
        raise GroundingError(f"{where}: prim_path is empty; {EXPECTED}")
    if file.expand(cells["predicate_id"]) != _TYPE:
        raise GroundingError(f"{where}: the predicate is {cells['predicate_id']!r}; expected rdf:type, or no reviewer")
    if file.expand(cells["object_id"]) == NO_TERM:
        return None
    try:
        return tbox.resolve(file.expand(cells["object_id"]))
    except OntologyError as error:
        raise GroundingError(f"{where}: {error}") from error
