"""ClassClaim: the class that one run, file or person gives an object, and the claims of a mapping file."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

from usd2kg.errors import GroundingError
from usd2kg.graph.literal_numbers import parse_numbers
from usd2kg.grounding import Prediction, Status, read_grounding
from usd2kg.grounding.sssom_decisions import NO_TERM, VERDICT, is_sssom
from usd2kg.grounding.sssom_file import SssomFile, SssomRow, read_sssom_file
from usd2kg.ontology import ClassIRI, TBox, local_name

__all__ = ["ClassClaim", "claim_of", "class_name", "read_claims"]

_COLUMNS = ("prim_path", "object_id")
_EXPECTED = "expected SSSOM/TSV with the column prim_path, as usd2kg ground --format sssom writes it"
_UNSETTLED = frozenset({"open", "unsure"})
"""Verdicts of a journal that say nothing about the class."""


class ClassClaim(NamedTuple):
    """The class of one object according to one source."""

    class_iri: ClassIRI | None
    """None if the source says that no class fits, or has no answer."""
    label: str
    """Empty without a class."""
    confidence: float | None
    """Probability or score that the grounder gave; None if it gave none, or a person decided."""
    is_decided: bool
    """Whether a person decided."""


def class_name(iri: ClassIRI, tbox: TBox) -> str:
    """Return the label of a class, or its local name if it is not in scope."""
    known = tbox.by_iri.get(iri)
    return known.label if known is not None else local_name(iri)


def claim_of(prediction: Prediction, tbox: TBox) -> ClassClaim:
    """Return the claim of a prediction."""
    iri = prediction.class_iri
    is_decided = prediction.status is Status.REVIEWED
    confidence = None if is_decided else prediction.confidence
    return ClassClaim(iri, class_name(iri, tbox) if iri else "", confidence, is_decided)


def read_claims(path: Path, tbox: TBox) -> dict[str, ClassClaim]:
    """Return prim path → claim of a mapping: JSON of `usd2kg ground`, or SSSOM/TSV, also a journal of decisions.

    Raises:
        GroundingError: the file cannot be read.
    """
    if not is_sssom(path):
        return {p.prim_path: claim_of(p, tbox) for p in read_grounding(path).predictions}
    try:
        file = read_sssom_file(path, path.read_text("utf-8-sig"), _COLUMNS, _EXPECTED)
    except (OSError, UnicodeDecodeError) as error:
        raise GroundingError(f"{path}: cannot be read as SSSOM ({error}); {_EXPECTED}") from error
    return {row.cells["prim_path"]: _claim(row.cells, file, tbox) for row in _settled(file.rows)}


def _settled(rows: Iterable[SssomRow]) -> list[SssomRow]:
    """Return the current rows: of a journal the last one of each prim, if it settles the class."""
    last = {row.cells["prim_path"]: row for row in rows if not row.cells.get("predicate_modifier")}
    return [row for row in last.values() if row.cells.get(VERDICT) not in _UNSETTLED]


def _claim(cells: Mapping[str, str], file: SssomFile, tbox: TBox) -> ClassClaim:
    iri = file.expand(cells["object_id"])
    is_decided = bool(cells.get("reviewer_id") or cells.get("reviewer_label"))
    numbers = parse_numbers(cells.get("confidence") or "")
    confidence = numbers[0] if numbers and not is_decided else None
    if iri == NO_TERM:
        return ClassClaim(None, "", confidence, is_decided)
    return ClassClaim(iri, class_name(iri, tbox), confidence, is_decided)
