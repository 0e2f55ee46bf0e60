"""Files of groundings: CSV for other tools, JSON for reading back, and lists of prim paths."""

import csv
import io
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from usd2kg.errors import GroundingError
from usd2kg.grounding.model import Candidate, Concept, Grounding, Prediction, Review, Status
from usd2kg.ontology import TBox

__all__ = ["MAPPING_FORMATS", "check_format", "format_mapping", "read_grounding", "read_paths"]

MAPPING_FORMATS = ("csv", "json")
_COLUMNS = (
    *("path", "class", "label", "confidence", "status", "grounder"),
    *("concept", "concept_label", "concept_confidence"),
)
_FORMAT = "usd2kg-grounding/1"


def format_mapping(grounding: Grounding, tbox: TBox, file_format: str) -> str:
    """Return the mapping of prims to classes as `csv` or `json`.

    CSV has the columns path, class (IRI), label, confidence, status, grounder, concept (IRI), concept_label and
    concept_confidence; unknown cells are empty.
    JSON holds the whole grounding; `read_grounding` reads it.

    Raises:
        GroundingError: the format is unknown.
    """
    check_format(file_format)
    if file_format == "csv":
        return _format_csv(grounding, tbox)
    return json.dumps({"format": _FORMAT, **asdict(grounding)}, indent=1, ensure_ascii=False) + "\n"


def check_format(file_format: str) -> None:
    """Raise GroundingError if the format of a mapping is unknown."""
    if file_format not in MAPPING_FORMATS:
        known = ", ".join(MAPPING_FORMATS)
        raise GroundingError(f"format {file_format!r} is unknown; expected one of {known}, or sssom with usd2kg ground")


def _format_csv(grounding: Grounding, tbox: TBox) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_COLUMNS)
    for p in grounding.predictions:
        label = tbox.by_iri[p.class_iri].label if p.class_iri else ""
        concept = grounding.concepts.get(p.concept or "")
        writer.writerow(
            (
                *(p.prim_path, p.class_iri or "", label, _number(p.confidence), p.status.value, p.grounder),
                *(("", "", "") if concept is None else (concept.iri, concept.label, _number(p.concept_confidence))),
            )
        )
    return text.getvalue()


def _number(confidence: float | None) -> str:
    return "" if confidence is None else f"{confidence:.4f}"


def read_grounding(path: Path | str) -> Grounding:
    """Return the grounding in a JSON file that `format_mapping` wrote.

    Raises:
        GroundingError: the file is missing or has another format.
    """
    path = Path(path)
    try:
        data = json.loads(path.read_text("utf-8"))
        if data.pop("format") != _FORMAT:
            raise ValueError("another format")
        predictions = tuple(_read_prediction(item) for item in data.pop("predictions"))
        concepts = {iri: _read_concept(item) for iri, item in data.pop("concepts", {}).items()}
        return Grounding(predictions=predictions, concepts=concepts, **data)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise GroundingError(
            f"{path}: cannot be read as a grounding ({error}); expected JSON written by usd2kg ground --format json"
        ) from error


def _read_prediction(item: dict[str, Any]) -> Prediction:
    item["status"] = Status(item["status"])
    item["evidence"] = tuple(item["evidence"])
    item["candidates"] = tuple(Candidate(**candidate) for candidate in item["candidates"])
    # Older files have neither `words` nor `review`.
    item["words"] = tuple(item.get("words", ()))
    if item.get("review") is not None:
        review = item["review"]
        predicted = review["predicted_status"]
        item["review"] = Review(**{**review, "predicted_status": Status(predicted) if predicted else None})
    return Prediction(**item)


def _read_concept(item: dict[str, Any]) -> Concept:
    return Concept(**{**item, "broader": tuple(item["broader"])})


def read_paths(path: Path | str) -> list[str]:
    """Return the prim paths in the column `path` of a CSV file, in order, without duplicates.

    Raises:
        GroundingError: the file cannot be read or has no such column.
    """
    path = Path(path)
    try:
        rows = csv.DictReader(path.read_text("utf-8-sig").splitlines())
    except (OSError, UnicodeDecodeError) as error:
        raise GroundingError(f"{path}: cannot be read as a CSV file with a column 'path' ({error})") from error
    try:
        if "path" not in (rows.fieldnames or ()):
            found = ", ".join(rows.fieldnames or ()) or "nothing"
            raise GroundingError(f"{path}: line 1 has the columns {found}; expected a column 'path'")
        return list(dict.fromkeys(row["path"].strip() for row in rows if row["path"] and row["path"].strip()))
    except csv.Error as error:
        raise GroundingError(f"{path}: line {rows.line_num} is not CSV ({error}); expected a column 'path'") from error
