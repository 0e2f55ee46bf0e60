"""Decisions of people: the classes they chose for prims, and the queue of prims that need a decision.

A queue is a CSV file with an empty column `decision`. Filled in, it is a file of decisions.
"""

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from usd2kg.errors import GroundingError, OntologyError
from usd2kg.grounding.model import PERSON, Decision, Grounding, Prediction, Review, Status
from usd2kg.grounding.settings import QUEUE
from usd2kg.grounding.sssom_decisions import is_sssom, read_sssom_decisions
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.spreadsheet import guard_formula

__all__ = [
    "NO_CLASS",
    "DecisionOrigin",
    "as_decision",
    "decide",
    "find_uncertain",
    "format_queue",
    "make_decision",
    "read_decisions",
]

NO_CLASS = "none"
"""The decision that no class fits, in a CSV file."""
_EXPECTED = "expected CSV with the columns path and decision (or class)"
_QUEUE_COLUMNS = ("path", "decision", "reviewer", "comment", "answer", "confidence", "alternatives", "explanation")


def read_decisions(path: Path | str, tbox: TBox) -> dict[str, Decision]:
    """Return prim path → decision from a CSV file, without the rows whose decision is empty.

    The class is in the column `decision`, or else `class`: an IRI, a CURIE, a unique local name or label, or `none`.
    The columns `reviewer`, `comment` and `time` are optional. A file whose name ends in .tsv is read as SSSOM, see
    `read_sssom_decisions`.

    Raises:
        GroundingError: the file cannot be read, a column is missing, a class is not in scope, or a prim has two.
    """
    path = Path(path)
    try:
        text = path.read_text("utf-8-sig")
        if is_sssom(path):
            return read_sssom_decisions(path, text, tbox)
        rows = csv.DictReader(text.splitlines())
        return _read_rows(path, rows, tbox)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise GroundingError(f"{path}: cannot be read as decisions ({error}); {_EXPECTED}") from error


def _read_rows(path: Path, rows: "csv.DictReader[str]", tbox: TBox) -> dict[str, Decision]:
    columns = rows.fieldnames or ()
    column = next((name for name in ("decision", "class") if name in columns), None)
    if column is None or "path" not in columns:
        raise GroundingError(f"{path}: line 1 has the columns {', '.join(columns) or 'nothing'}; {_EXPECTED}")
    decisions: dict[str, Decision] = {}
    for row in rows:
        prim_path, name = ((row[key] or "").strip() for key in ("path", column))
        if not prim_path or not name:
            continue
        try:
            iri = None if name == NO_CLASS else tbox.resolve(name)
        except OntologyError as error:
            raise GroundingError(f"{path}: line {rows.line_num}: {error}") from error
        reviewer, comment, time = ((row.get(key) or "").strip() for key in ("reviewer", "comment", "time"))
        decision = Decision(iri, reviewer, comment, time)
        if decisions.setdefault(prim_path, decision).class_iri != iri:
            raise GroundingError(f"{path}: line {rows.line_num}: {prim_path} has two decisions; leave one")
    return decisions


class DecisionOrigin(NamedTuple):
    """The origin of a decision that was made when the object had another prim path."""

    prim_path: str
    """The path in the decision."""
    reason: str
    """Why it is the same object, as text."""


def as_decision(decision: ClassIRI | Decision) -> Decision:
    """Return a decision, given as such or as a class alone."""
    return Decision(decision) if isinstance(decision, str) else decision


def decide(
    prediction: Prediction, decision: ClassIRI | Decision, tbox: TBox, origin: DecisionOrigin | None = None
) -> Prediction:
    """Return a prediction with a person's decision; `origin` is given if it was made about another path."""
    made = as_decision(decision)
    predicted = "no class" if prediction.class_iri is None else tbox.by_iri[prediction.class_iri].local_name
    decided = prediction.reviewed(made.class_iri, made.reviewer, confidence=1.0, comment=made.comment, time=made.time)
    return replace(
        decided,
        explanation=f"{_explain(origin)}; predicted {predicted}: {prediction.explanation}",
        decided_for=origin.prim_path if origin is not None else "",
    )


def make_decision(prim_path: str, decision: ClassIRI | Decision, origin: DecisionOrigin | None = None) -> Prediction:
    """Return a person's decision about an object without a prediction; `origin` is given as for `decide`."""
    made = as_decision(decision)
    return Prediction(
        prim_path=prim_path,
        class_iri=made.class_iri,
        confidence=1.0,
        status=Status.REVIEWED,
        grounder=PERSON,
        explanation=_explain(origin),
        review=Review(made.reviewer, None, None, None, made.comment, made.time) if made.reviewer else None,
        decided_for=origin.prim_path if origin is not None else "",
    )


def _explain(origin: DecisionOrigin | None) -> str:
    of_another_path = f" for {origin.prim_path}, the same object ({origin.reason})" if origin is not None else ""
    return f"decided by a person{of_another_path}"


def find_uncertain(grounding: Grounding, min_confidence: float) -> list[Prediction]:
    """Return the predictions without a class or below `min_confidence`, the least confident first.

    Prims that are not on the stage are left out.
    """
    found = [p for p in grounding.predictions if p.class_iri is None or (p.confidence or 0.0) < min_confidence]
    return sorted((p for p in found if p.status is not Status.MISSING), key=lambda p: p.confidence or 0.0)


def format_queue(predictions: Sequence[Prediction], tbox: TBox) -> str:
    """Return the queue as CSV, with empty columns `decision`, `reviewer` and `comment` for a person to fill in."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_QUEUE_COLUMNS)
    for prediction in predictions:
        confidence = "" if prediction.confidence is None else f"{prediction.confidence:.4f}"
        answer = tbox.by_iri[prediction.class_iri].local_name if prediction.class_iri else ""
        alternatives = "|".join(_alternatives(prediction, tbox))
        explanation = guard_formula(prediction.explanation)
        writer.writerow((prediction.prim_path, "", "", "", answer, confidence, alternatives, explanation))
    return text.getvalue()


def _alternatives(prediction: Prediction, tbox: TBox) -> Iterator[str]:
    others = [c.class_iri for c in prediction.candidates if c.class_iri != prediction.class_iri]
    return (tbox.by_iri[iri].local_name for iri in others[: QUEUE.max_alternatives])
