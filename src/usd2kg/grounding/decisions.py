"""What people decide: their classes for prims, and the queue of what they are asked about.

A queue is a CSV file with an empty column `decision`; filled in, it is read back as decisions.
"""

import csv
import io
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from usd2kg.errors import GroundingError, OntologyError
from usd2kg.grounding.model import Grounding, Prediction, Status
from usd2kg.grounding.sssom_decisions import is_sssom, read_sssom_decisions
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["PERSON", "Carried", "decided", "format_queue", "read_decisions", "unsure_of"]

PERSON = "person"
"""The grounder's id of what a person decided."""
_EXPECTED = "expected CSV with the columns path and decision (or class)"
_QUEUE_COLUMNS = ("path", "decision", "answer", "confidence", "alternatives", "explanation")
_MOST_ALTERNATIVES = 4
_FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""What a spreadsheet takes for the beginning of a formula."""


def read_decisions(path: Path, tbox: TBox) -> dict[str, ClassIRI]:
    """Return prim path → the class that a person decided on, from a CSV file; rows without a decision are left out.

    The class is in the column `decision`, or else `class`: an IRI, a CURIE, or a local name that is unique. A file
    whose name ends in .tsv is SSSOM, of which only rows count that a person curated or reviewed.

    Raises:
        GroundingError: the file cannot be read, a column is missing, a class is not in scope, or a prim has two.
    """
    try:
        text = path.read_text("utf-8-sig")
        if is_sssom(path):
            return read_sssom_decisions(path, text, tbox)
        rows = csv.DictReader(text.splitlines())
        return _read_rows(path, rows, tbox)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise GroundingError(f"{path}: cannot be read as decisions ({error}); {_EXPECTED}") from error


def _read_rows(path: Path, rows: "csv.DictReader[str]", tbox: TBox) -> dict[str, ClassIRI]:
    columns = rows.fieldnames or ()
    column = next((name for name in ("decision", "class") if name in columns), None)
    if column is None or "path" not in columns:
        raise GroundingError(f"{path}: line 1 has the columns {', '.join(columns) or 'nothing'}; {_EXPECTED}")
    decisions: dict[str, ClassIRI] = {}
    for row in rows:
        prim_path, name = ((row[key] or "").strip() for key in ("path", column))
        if not prim_path or not name:
            continue
        try:
            iri = tbox.resolve(name)
        except OntologyError as error:
            raise GroundingError(f"{path}: line {rows.line_num}: {error}") from error
        if decisions.setdefault(prim_path, iri) != iri:
            raise GroundingError(f"{path}: line {rows.line_num}: {prim_path} has two decisions; leave one")
    return decisions


class Carried(NamedTuple):
    """Where a decision comes from that was made when the thing had another prim path."""

    prim_path: str
    """The path that the person decided about."""
    reason: str
    """Why it is the same thing, in words."""


def decided(prim_path: str, class_iri: ClassIRI, carried: Carried | None = None) -> Prediction:
    """Return what a person decided, as a prediction."""
    if carried is None:
        return Prediction(prim_path, class_iri, 1.0, Status.REVIEWED, PERSON, "a person decided so")
    explanation = f"a person decided so about {carried.prim_path}, the same thing ({carried.reason})"
    decided_for = carried.prim_path
    return Prediction(prim_path, class_iri, 1.0, Status.REVIEWED, PERSON, explanation, decided_for=decided_for)


def unsure_of(grounding: Grounding, least_confidence: float) -> list[Prediction]:
    """Return the predictions that a person should see: less sure than that or without a class, the least sure first."""
    found = [p for p in grounding.predictions if p.class_iri is None or (p.confidence or 0.0) < least_confidence]
    return sorted((p for p in found if p.status is not Status.MISSING), key=lambda p: p.confidence or 0.0)


def format_queue(predictions: Sequence[Prediction], tbox: TBox) -> str:
    """Return the queue as CSV: what a person fills in is the column `decision`."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_QUEUE_COLUMNS)
    for found in predictions:
        confidence = "" if found.confidence is None else f"{found.confidence:.4f}"
        answer = tbox.by_iri[found.class_iri].local_name if found.class_iri else ""
        others = "|".join(_alternatives(found, tbox))
        writer.writerow((found.prim_path, "", answer, confidence, others, _plain(found.explanation)))
    return text.getvalue()


def _alternatives(found: Prediction, tbox: TBox) -> Iterator[str]:
    others = [candidate.class_iri for candidate in found.candidates if candidate.class_iri != found.class_iri]
    return (tbox.by_iri[iri].local_name for iri in others[:_MOST_ALTERNATIVES])


def _plain(text: str) -> str:
    """Return a text that no spreadsheet takes for a formula."""
    return "'" + text if text.startswith(_FORMULA) else text
