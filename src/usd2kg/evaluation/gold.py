"""Gold labels: the class of each prim according to a person."""

import csv
import io
import logging
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from usd2kg.errors import EvaluationError, OntologyError
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.scene import Scene

__all__ = ["GoldLabel", "check_gold", "check_unique", "read_gold"]

logger = logging.getLogger(__name__)

_HEADER = "path,class,also"
_REQUIRED_COLUMNS = ("path", "class")
_SECOND_LABELS = "also"


@dataclass(frozen=True, slots=True)
class GoldLabel:
    """The label of one prim."""

    prim_path: str
    target: ClassIRI
    also: frozenset[ClassIRI]
    """Other defensible classes, excluding the target."""


def read_gold(path: Path | str, tbox: TBox) -> tuple[GoldLabel, ...]:
    """Return the labels of a CSV file `path,class,also`, in file order.

    Classes are IRIs, CURIEs or local names that are unique in the scope. `also` is a `|`-separated list. Other columns
    are ignored, unless their name begins like `also`.

    Raises:
        EvaluationError: the file cannot be read, a column is missing or misspelt, a row has more cells than columns, a
            class is not in scope, or a path is repeated.
    """
    path = Path(path)
    try:
        text = path.read_text("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise EvaluationError(f"{path}: cannot be read as gold labels ({error}); expected CSV {_HEADER}") from error
    rows = csv.DictReader(io.StringIO(text, newline=""))
    try:
        return _read_rows(path, rows, tbox)
    except csv.Error as error:
        raise EvaluationError(f"{path}: line {rows.line_num} is not CSV ({error}); expected {_HEADER}") from error


def _read_rows(path: Path, rows: "csv.DictReader[str]", tbox: TBox) -> tuple[GoldLabel, ...]:
    columns = rows.fieldnames or ()
    if not set(columns).issuperset(_REQUIRED_COLUMNS):
        found = f"the columns {', '.join(columns)}" if columns else "no columns"
        raise EvaluationError(f"{path}: line 1 has {found}; expected {_HEADER}")
    for name in columns:
        if name != _SECOND_LABELS and name.strip().casefold().startswith(_SECOND_LABELS):
            expected = f"expected {_SECOND_LABELS!r} for second labels, or another name"
            raise EvaluationError(f"{path}: line 1 has the column {name!r}; {expected}")
    labels = [_label(path, rows.line_num, row, tbox) for row in rows if (row["path"] or "").strip()]
    check_unique(path, (label.prim_path for label in labels))
    if not labels:
        raise EvaluationError(f"{path}: contains no label; expected a row {_HEADER} for each object")
    return tuple(labels)


def _label(path: Path, line: int, row: Mapping[str | None, Any], tbox: TBox) -> GoldLabel:
    prim_path = (row["path"] or "").strip()
    name = (row["class"] or "").strip()
    # DictReader keeps the cells beyond the last column as a list, under the key None.
    if any(cell.strip() for cell in row.get(None) or ()):
        raise EvaluationError(
            f"{path}: line {line}: {prim_path} has more cells than line 1 has columns; separate second labels with |, "
            "and put quotes around a cell with a comma"
        )
    if not name:
        raise EvaluationError(f"{path}: line {line}: {prim_path} has no class; fill it in or remove the row")
    try:
        target = tbox.resolve(name)
        also = frozenset(tbox.resolve(part) for part in (row.get(_SECOND_LABELS) or "").split("|") if part.strip())
    except OntologyError as error:
        raise EvaluationError(f"{path}: line {line}: {error}") from error
    return GoldLabel(prim_path, target, also - {target})


def check_unique(path: Path, prim_paths: Iterable[str]) -> None:
    """Check that a file has one row per prim.

    Raises:
        EvaluationError: it has more than one row for a prim.
    """
    seen: set[str] = set()
    for prim_path in prim_paths:
        if prim_path in seen:
            raise EvaluationError(f"{path}: {prim_path} has more than one row; expected one row per prim")
        seen.add(prim_path)


def check_gold(path: Path, gold: Sequence[GoldLabel], scene: Scene) -> None:
    """Check that gold labels belong to a scene that was read with their paths; warn of those that are not on the stage.

    Raises:
        EvaluationError: none of the paths is on the stage.
    """
    missing = scene.missing_paths
    if len(missing) == len(gold):
        raise EvaluationError(
            f"{path}: none of its {len(gold)} paths is in {scene.source}; expected the gold of this scene"
        )
    if missing:
        problem = "%d of %d gold paths are not on the stage %s, %s for one; they count as wrong"
        logger.warning(f"%s: {problem}", path, len(missing), len(gold), scene.source, missing[0])
