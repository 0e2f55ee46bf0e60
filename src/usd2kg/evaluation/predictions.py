"""Read the answers of any method, to score them like those of a grounder."""

import csv
import io
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from usd2kg.errors import EvaluationError, OntologyError
from usd2kg.evaluation.gold import check_unique
from usd2kg.grounding import Grounding, Prediction, Status, read_grounding
from usd2kg.grounding.sssom_decisions import EXPECTED, REQUIRED, is_sssom, last_rows, read_class
from usd2kg.grounding.sssom_file import read_sssom_file
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.scene import Scene
from usd2kg.version import VERSION

__all__ = ["read_predictions"]

_EXPECTED = "expected CSV with the columns path and class, and confidence if there is one"
_UNKNOWN = "unknown"
"""Naming regime and evidence of answers from elsewhere."""


def read_predictions(path: Path | str, scene: Scene, tbox: TBox) -> Grounding:
    """Return the answers in a file as a grounding of a scene; the name of the file stands for the grounder.

    The file is CSV with the columns `path`, `class` (an IRI, a CURIE or a unique local name; empty for no answer) and,
    if known, `confidence` from 0 to 1; or JSON or SSSOM (.tsv), as `usd2kg ground` writes them.

    Raises:
        EvaluationError: the file cannot be read, a column is missing, a class is not in scope, a confidence is not from
            0 to 1, or a path is repeated.
        GroundingError: a JSON or SSSOM file cannot be read.
    """
    path = Path(path)
    try:
        text = path.read_text("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise EvaluationError(f"{path}: cannot be read as answers ({error}); {_EXPECTED}") from error
    if path.suffix.lower() == ".json":
        found = _read_json(path, tbox)
    else:
        found = list(_read_sssom(path, text, tbox) if is_sssom(path) else _read_csv(path, text, tbox))
    check_unique(path, (prediction.prim_path for prediction in found))
    return Grounding(
        scene=scene.source,
        scene_hash=scene.content_hash,
        ontology=tbox.ontology_iri,
        ontology_hash=tbox.content_hash,
        grounder=path.name,
        settings={"regime": _UNKNOWN, "evidence": _UNKNOWN},
        is_calibrated=False,
        tool_version=VERSION,
        predictions=tuple(found),
    )


def _read_json(path: Path, tbox: TBox) -> list[Prediction]:
    found = list(read_grounding(path).predictions)
    foreign = next((p for p in found if p.class_iri is not None and p.class_iri not in tbox.by_iri), None)
    if foreign is not None:
        raise EvaluationError(
            f"{path}: the class {foreign.class_iri} of {foreign.prim_path} is not in scope; give the ontology of the "
            "answers with --ontology"
        )
    return [replace(p, grounder=path.name) for p in found]


def _read_sssom(path: Path, text: str, tbox: TBox) -> Iterator[Prediction]:
    file = read_sssom_file(path, text, REQUIRED, EXPECTED)
    for line, cells in last_rows(file):
        # A negated row says what an object is not.
        if not cells.get("predicate_modifier"):
            where = f"{path}: line {line}"
            iri = read_class(where, cells, file, tbox)
            yield _prediction(path, where, cells["prim_path"], iri, cells.get("confidence", ""))


def _read_csv(path: Path, text: str, tbox: TBox) -> Iterator[Prediction]:
    rows = csv.DictReader(io.StringIO(text, newline=""))
    try:
        columns = rows.fieldnames or ()
        if "path" not in columns or "class" not in columns:
            raise EvaluationError(f"{path}: line 1 has the columns {', '.join(columns) or 'nothing'}; {_EXPECTED}")
        for row in rows:
            prim_path, name, confidence = ((row.get(key) or "").strip() for key in ("path", "class", "confidence"))
            if prim_path:
                where = f"{path}: line {rows.line_num}"
                yield _prediction(path, where, prim_path, _resolve(where, name, tbox), confidence)
    except csv.Error as error:
        raise EvaluationError(f"{path}: line {rows.line_num} is not CSV ({error}); {_EXPECTED}") from error


def _resolve(where: str, name: str, tbox: TBox) -> ClassIRI | None:
    try:
        return tbox.resolve(name) if name else None
    except OntologyError as error:
        raise EvaluationError(f"{where}: {error}; leave the cell empty for no answer") from error


def _prediction(path: Path, where: str, prim_path: str, iri: ClassIRI | None, confidence: str) -> Prediction:
    status = Status.REFUSED if iri is None else Status.GROUNDED
    number = _confidence(where, confidence) if iri is not None and confidence else None
    return Prediction(prim_path, iri, number, status, path.name, f"read from {path.name}")


def _confidence(where: str, text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if not 0 <= number <= 1:
        raise EvaluationError(f"{where}: the confidence is {text!r}; expected a number from 0 to 1, or an empty cell")
    return number
