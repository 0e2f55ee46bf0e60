"""Rows of an alignment file: SSSOM/TSV text ↔ records."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from usd2kg.errors import GroundingError, OntologyError
from usd2kg.grounding.lexical.alignment.artificial_root import NO_CLASS, NO_CLASS_IRI
from usd2kg.grounding.lexical.alignment.terms import TermKind
from usd2kg.grounding.lexical.settings import ALIGNMENT
from usd2kg.grounding.sssom_file import Curies, SssomFile, SssomRow, cell_text, format_sssom_file, read_sssom_file
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.ontology.namespaces import CONCEPT, SKOS, U2K, WORDNET
from usd2kg.ontology.prefixes import PREFIXES
from usd2kg.version import VERSION

__all__ = ["SHIPPED_LISTS", "AlignmentRow", "RowKind", "format_rows", "parse_rows", "written_class"]

SHIPPED_LISTS = "usd2kg member lists"
"""Name, in a row's `tool`, of the lists in `data/class_members.csv`."""
_NO_TERM = "https://w3id.org/sssom/NoTermFound"
_UNSPECIFIED_LICENSE = "https://w3id.org/sssom/license/unspecified"
_LITERAL = "rdfs literal"
_CURATED = "semapv:ManualMappingCuration"
_PREFIXES = {
    **PREFIXES,
    "concept": CONCEPT,
    "semapv": "https://w3id.org/semapv/vocab/",
    "skos": SKOS,
    "sssom": "https://w3id.org/sssom/",
    "u2k": U2K,
    "wn": WORDNET,
    "xsd": "http://www.w3.org/2001/XMLSchema#",
}
_COLUMNS = (
    *("subject_id", "subject_label", "subject_type", "predicate_id", "predicate_modifier", "object_id", "object_label"),
    *("mapping_justification", "mapping_tool", "reviewer_label", "confidence", "comment"),
    *("term_kind", "category_size"),
)
_REQUIRED = ("subject_label", "predicate_id", "object_id", "mapping_justification")
_EXTENSIONS = {
    "default_class": "u2k:defaultClass",
    "term_kind": "u2k:termKind",
    "category_size": "u2k:categorySize",
}
_EXPECTED = "expected an alignment as usd2kg ontology align writes it"
_HOW_TO_EDIT = (
    "To change where a concept or term belongs, edit object_id and write semapv:ManualMappingCuration as the "
    "justification; a concept takes everything below it along. Rows can be added and deleted. The confidence of a term "
    "follows from its term_kind."
)


class RowKind(Enum):
    """What a row aligns with a class; the value is its predicate."""

    TERM = "skos:exactMatch"
    """A word or compound that names the class; the subject is a literal."""
    CONCEPT = "skos:closeMatch"
    """A concept whose objects belong to the class, as do those of its hyponyms.

    `skos:exactMatch` if fully trusted, `skos:broadMatch` if it is a kind of the class.
    """
    CATEGORY = "skos:broadMatch"
    """A concept that counts among the class in common usage; the row has a category size."""


@dataclass(frozen=True, slots=True)
class AlignmentRow:
    """One mapping to a class."""

    kind: RowKind
    subject: str
    """A term in lower case, or the IRI of a concept."""
    class_iri: ClassIRI
    """`NO_CLASS_IRI` for a subject without a class."""
    confidence: float
    """How far the subject is trusted to mean the class, 0 to 1."""
    label: str = ""
    """The noun of a concept."""
    reason: str = ""
    term_kind: TermKind = TermKind.SYNONYM
    """Origin of a term."""
    category_size: int = 0
    """Number of concepts in the category."""
    tool: str = ""
    """The language model that named the subject, or `SHIPPED_LISTS`; empty if neither did, or a person decided."""
    is_kind: bool = False
    """Whether the subject is a kind of the class rather than the class itself; only for writing."""
    is_curated: bool = False
    """Whether a person decided."""
    reviewers: tuple[str, ...] = ()
    """Who decided; only for writing."""
    is_negated: bool = False
    """Whether the subject does not belong to the class."""
    line: int = 0
    """Line in the file."""


def format_rows(rows: Sequence[AlignmentRow], tbox: TBox, default: ClassIRI | None = None) -> str:
    """Return the text of a file.

    Args:
        rows: in the order to be written.
        tbox: the classes.
        default: the class of objects without a more specific one; None for a file that only changes an alignment.
    """
    curies = Curies(_prefixes(tbox), used=("semapv", "skos", "sssom", "u2k", "wn", "xsd"))
    cells = [_cells_of(row, tbox, curies) for row in rows]
    header = {
        "mapping_set_id": f"https://w3id.org/usd2kg/alignment/{tbox.content_hash.removeprefix('sha256:')}",
        "mapping_set_title": f"Concepts and terms of {tbox.ontology_iri}",
        "license": _UNSPECIFIED_LICENSE,
        "mapping_tool": "usd2kg",
        "mapping_tool_version": VERSION,
        "comment": _HOW_TO_EDIT,
        "subject_source": "https://wordnet.princeton.edu/",
        "subject_source_version": "3.1",
        **({} if tbox.ontology_iri.startswith("file:") else {"object_source": curies.shorten(tbox.ontology_iri)}),
        "object_source_version": tbox.content_hash,
        **({} if default is None else {"default_class": curies.shorten(written_class(default))}),
    }
    return format_sssom_file(header, curies, _EXTENSIONS, _COLUMNS, cells)


def _prefixes(tbox: TBox) -> dict[str, str]:
    return {**tbox.prefixes_beside(_PREFIXES), **_PREFIXES}


def written_class(iri: ClassIRI) -> str:
    """Return the IRI of a class as in the file."""
    return _NO_TERM if iri == NO_CLASS_IRI else iri


def _cells_of(row: AlignmentRow, tbox: TBox, curies: Curies) -> dict[str, str]:
    is_term = row.kind is RowKind.TERM
    is_exact = row.kind is RowKind.CONCEPT and row.confidence == 1.0
    predicate = "skos:exactMatch" if is_exact else "skos:broadMatch" if row.is_kind else row.kind.value
    return {
        "subject_id": "" if is_term else curies.shorten(row.subject),
        "subject_label": cell_text(row.subject if is_term else row.label),
        "subject_type": _LITERAL if is_term else "skos concept",
        "predicate_id": predicate,
        "predicate_modifier": "Not" if row.is_negated else "",
        "object_id": curies.shorten(written_class(row.class_iri)),
        "object_label": _class_label(row.class_iri, tbox),
        "mapping_justification": _justification(row),
        "mapping_tool": cell_text(row.tool),
        "reviewer_label": "|".join(cell_text(name).replace("|", r"\|") for name in row.reviewers),
        "confidence": f"{row.confidence * _share_right(row.kind):g}",
        "comment": cell_text(row.reason),
        "term_kind": row.term_kind.value if is_term else "",
        "category_size": str(row.category_size) if row.category_size else "",
    }


def _share_right(kind: RowKind) -> float:
    """Return the probability that a row of full weight is right: categories of common usage hold in part."""
    return ALIGNMENT.category_confidence if kind is RowKind.CATEGORY else 1.0


def _justification(row: AlignmentRow) -> str:
    if row.is_curated:
        return _CURATED
    is_known = row.kind is RowKind.CATEGORY or row.term_kind is TermKind.LENT or bool(row.tool)
    return "semapv:BackgroundKnowledgeBasedMatching" if is_known else "semapv:LexicalMatching"


def _class_label(iri: ClassIRI, tbox: TBox) -> str:
    return NO_CLASS if iri == NO_CLASS_IRI else cell_text(tbox.by_iri[iri].label)


def parse_rows(path: Path, text: str, tbox: TBox) -> tuple[ClassIRI | None, str, list[AlignmentRow]]:
    """Return the default class, the hash of the ontology and the rows of a file.

    The default class is None and the hash empty if the header does not have them: the file only changes an alignment.

    Raises:
        GroundingError: the file is malformed, a class is not in scope, or a subject has two classes; the message has
            the line.
    """
    file = read_sssom_file(path, text, _REQUIRED, _EXPECTED, _prefixes(tbox))
    default = None
    if named := file.slots.get("default_class"):
        lines = enumerate(text.splitlines(), start=1)
        number = next(number for number, line in lines if re.match(r"\"?#\s?default_class:", line))
        default = _parse_class(f"{path}: line {number}", file.expand(named), file, tbox)
    rows = [_parse_row(f"{path}: line {row.line}", row, file, tbox) for row in file.rows]
    _check_unique(path, rows)
    return default, _ontology_hash(file), rows


def _ontology_hash(file: SssomFile) -> str:
    return file.slots.get("object_source_version", "")


def _check_unique(path: Path, rows: Iterable[AlignmentRow]) -> None:
    """Raise GroundingError if a concept or term has two classes; a person's row may override a built row."""
    seen: dict[tuple[RowKind, str, bool], AlignmentRow] = {}
    for row in rows:
        if row.kind is RowKind.CATEGORY or row.is_negated or row.tool:
            continue
        subject = row.subject.replace(" ", "") if row.kind is RowKind.TERM else row.subject
        first = seen.setdefault((row.kind, subject, row.is_curated), row)
        if first.class_iri != row.class_iri:
            named = repr(row.label or row.subject)
            raise GroundingError(
                f"{path}: line {row.line}: {named} has another class on line {first.line}; leave one of them"
            )


def _parse_row(where: str, row: SssomRow, file: SssomFile, tbox: TBox) -> AlignmentRow:
    cells = row.cells
    is_term = cells.get("subject_type", "") == _LITERAL or not cells.get("subject_id")
    predicate = cells["predicate_id"]
    predicates = {kind.value for kind in RowKind}
    if predicate not in predicates:
        expected = ", ".join(sorted(predicates))
        raise GroundingError(f"{where}: the predicate is {predicate!r}; expected one of {expected}")
    subject = cells["subject_label"].lower() if is_term else file.expand(cells["subject_id"])
    if not subject:
        raise GroundingError(f"{where}: has no subject; expected a concept in subject_id or a term in subject_label")
    modifier = cells.get("predicate_modifier", "")
    if modifier not in {"", "Not"}:
        raise GroundingError(f"{where}: the predicate modifier is {modifier!r}; expected Not, or nothing")
    class_iri = _parse_class(where, file.expand(cells["object_id"]), file, tbox)
    size = _parse_size(where, cells.get("category_size", ""))
    is_category = predicate == RowKind.CATEGORY.value and size > 0
    is_curated = _is_curated(cells, class_iri, file, tbox)
    kind = RowKind.TERM if is_term else RowKind.CATEGORY if is_category else RowKind.CONCEPT
    return AlignmentRow(
        kind=kind,
        subject=subject,
        class_iri=class_iri,
        confidence=_parse_confidence(where, cells.get("confidence", ""), _share_right(kind)),
        label=cells["subject_label"],
        term_kind=_parse_term_kind(where, cells.get("term_kind", "")),
        category_size=size,
        tool="" if is_curated else cells.get("mapping_tool", ""),
        is_curated=is_curated,
        is_negated=bool(modifier),
        line=row.line,
    )


def _is_curated(cells: Mapping[str, str], class_iri: ClassIRI, file: SssomFile, tbox: TBox) -> bool:
    """Return whether a person decided: by justification, by reviewer, or by a class without the label in its row."""
    if file.expand(cells["mapping_justification"]) == file.expand(_CURATED):
        return True
    label = cells.get("object_label", "")
    # In another version of the ontology, the class may have another label.
    is_comparable = label and _ontology_hash(file) == tbox.content_hash
    is_changed = is_comparable and cell_text(label) != _class_label(class_iri, tbox)
    return bool(is_changed or cells.get("reviewer_label") or cells.get("reviewer_id"))


def _parse_class(where: str, text: str, file: SssomFile, tbox: TBox) -> ClassIRI:
    if text == _NO_TERM:
        return NO_CLASS_IRI
    try:
        return tbox.resolve(text)
    except OntologyError as error:
        source = file.expand(file.slots.get("object_source", ""))
        is_other = source and _ontology_hash(file) != tbox.content_hash
        origin = f"; the alignment was written for {source}" if is_other else ""
        raise GroundingError(f"{where}: {error}{origin}") from error


def _parse_confidence(where: str, text: str, share_right: float) -> float:
    """Return the weight of a row."""
    try:
        confidence = float(text or "1")
    except ValueError:
        confidence = math.nan
    if not 0 < confidence <= 1:
        raise GroundingError(f"{where}: the confidence is {text!r}; expected a number above 0, at most 1")
    return min(round(confidence / share_right, 6), 1.0)


def _parse_term_kind(where: str, text: str) -> TermKind:
    kinds = {kind.value: kind for kind in TermKind}
    if text and text not in kinds:
        raise GroundingError(f"{where}: the term kind is {text!r}; expected one of {', '.join(kinds)}")
    return kinds[text or TermKind.SYNONYM.value]


def _parse_size(where: str, text: str) -> int:
    if text and not text.isdecimal():
        raise GroundingError(f"{where}: the category size is {text!r}; expected the number of concepts in the category")
    return int(text or "0")
