"""VolumeGrounder: the LV-NN baseline of the study, the nearest typical box by log volume. Names are ignored."""

import csv
import io
import math
from collections.abc import Mapping, Sequence
from pathlib import Path

from usd2kg.errors import GroundingError, OntologyError
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.model import Candidate, Prediction, Status
from usd2kg.grounding.settings import BASELINES
from usd2kg.knowledge import read_text
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.ontology.prefixes import expand_curie

__all__ = ["VolumeGrounder"]

_SIDES = ("width_m", "depth_m", "height_m")
_COLUMNS = ("class", *_SIDES, "origin")
_UNITS = (("m³", 1.0), ("l", 1e-3), ("ml", 1e-6), ("mm³", 1e-9))
"""Units for explanations with their size in cubic metres, largest first."""
_UNIT_THRESHOLD = 0.1
"""Smallest amount in a unit: 0.5 l rather than 500 ml."""


class VolumeGrounder:
    """Compares the volume of an object's box with a typical volume of each class."""

    name = "volume"
    is_calibrated = False

    def __init__(self, volumes: Mapping[str, float] | None = None, source: str = "written by hand") -> None:
        """Create a grounder.

        Args:
            volumes: class (IRI, CURIE or local name) → typical volume of its box in cubic metres; by default the
                built-in estimates for the classes of SOMA-HOME.
            source: origin of `volumes`, for `settings` and error messages.

        Raises:
            GroundingError: a volume is not positive and finite.
        """
        if volumes is None:
            text = read_text("class_sizes.csv")
            volumes, source = _read_volumes(text, "class_sizes.csv"), "built-in"
        for class_name, volume in volumes.items():
            if not (math.isfinite(volume) and volume > 0):
                raise GroundingError(f"{source}: {class_name} has the volume {volume}; expected cubic metres above 0")
        self._volumes = dict(volumes)
        self._source = source

    @classmethod
    def from_csv(cls, path: Path) -> "VolumeGrounder":
        """Return a grounder over the columns `class,width_m,depth_m,height_m,origin` of a CSV file.

        Raises:
            GroundingError: the file is missing, lacks a column, or a row is invalid.
        """
        try:
            text = path.read_text("utf-8-sig")
        except (OSError, UnicodeDecodeError) as error:
            raise GroundingError(
                f"{path}: cannot be read as a CSV file with the columns {','.join(_COLUMNS)} ({error})"
            ) from error
        return cls(_read_volumes(text, str(path)), str(path))

    @property
    def settings(self) -> Mapping[str, str]:
        """The settings that affect its predictions."""
        return {"class_sizes": self._source, "smallest_side_m": str(BASELINES.smallest_side_m)}

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view).

        Raises:
            GroundingError: no class of the TBox has a typical volume, or one class has two.
        """
        typical = self._resolve_volumes(tbox)
        return [self._predict(path, view, tbox, typical) for path, view in views]

    def _resolve_volumes(self, tbox: TBox) -> dict[ClassIRI, float]:
        typical: dict[ClassIRI, float] = {}
        for class_name, volume in self._volumes.items():
            try:
                iri = tbox.resolve(class_name)
            except OntologyError:
                continue  # The table may cover more classes than the TBox has.
            if typical.setdefault(iri, volume) != volume:
                raise GroundingError(
                    f"{self._source}: {class_name} has the volumes {typical[iri]} and {volume}; "
                    "expected one for each class"
                )
        if not typical:
            raise GroundingError(
                f"{self._source}: has a size for none of the {len(tbox.classes)} classes of {tbox.source}; "
                f"give typical sizes of these classes in a CSV file with the columns {','.join(_COLUMNS)}"
            )
        return typical

    def _predict(self, path: str, view: ObjectView, tbox: TBox, typical: Mapping[ClassIRI, float]) -> Prediction:
        volume = _box_volume(view)
        if volume is None:
            return Prediction(path, None, None, Status.REFUSED, self.name, "it has no box to measure")
        # The smaller over the larger volume is exp(-|ln v - ln v_c|): nearest in log volume, and 1 where both agree.
        scored = (Candidate(iri, min(volume, prior) / max(volume, prior)) for iri, prior in typical.items())
        candidates = tuple(sorted(scored, key=lambda c: (-c.score, c.class_iri))[: BASELINES.max_candidates])
        best = candidates[0]
        text = (
            f"its box holds {_format_volume(volume)}, nearest is {tbox.by_iri[best.class_iri].readable_name} "
            f"with {_format_volume(typical[best.class_iri])}"
        )
        return Prediction(path, best.class_iri, best.score, Status.GROUNDED, self.name, text, ("geometry",), candidates)


def _box_volume(view: ObjectView) -> float | None:
    """Return the volume of an object's box in cubic metres; None if there is no box or it is not finite."""
    if view.size is None:
        return None
    volume = math.prod(max(side, BASELINES.smallest_side_m) for side in view.size)
    return volume if math.isfinite(volume) else None


def _format_volume(volume: float) -> str:
    """Return a volume in cubic metres with a readable unit."""
    unit, factor = next(((unit, factor) for unit, factor in _UNITS if volume >= _UNIT_THRESHOLD * factor), _UNITS[-1])
    amount = volume / factor
    return f"{amount:.2f} {unit}" if amount < 10 else f"{amount:.0f} {unit}"


def _read_volumes(text: str, source: str) -> dict[str, float]:
    # From a stream: splitting into lines would break cells with line breaks.
    rows = csv.DictReader(io.StringIO(text, newline=""), strict=True)
    volumes: dict[str, float] = {}
    lines: dict[ClassIRI, int] = {}
    try:
        missing = [column for column in _COLUMNS if column not in (rows.fieldnames or ())]
        if missing:
            found = ",".join(rows.fieldnames or ()) or "nothing"
            raise GroundingError(
                f"{source}: line 1 has the columns {found}, without {','.join(missing)}; expected {','.join(_COLUMNS)}"
            )
        for row in rows:
            where = f"{source}: line {rows.line_num}"
            if len(row) > len(rows.fieldnames or ()):
                raise GroundingError(f"{where} has more cells than line 1; expected metres as in 0.08, with a point")
            class_name = (row["class"] or "").strip()
            if not class_name:
                raise GroundingError(f"{where} names no class; expected an IRI, a CURIE or a local name")
            earlier = lines.setdefault(expand_curie(class_name), rows.line_num)
            if earlier != rows.line_num:
                raise GroundingError(f"{where}: {class_name} is already in line {earlier}; expected each class once")
            volumes[class_name] = math.prod(_read_side(row, side, where) for side in _SIDES)
    except csv.Error as error:
        raise GroundingError(f"{source}: line {rows.reader.line_num}: {error}; expected a CSV file") from error
    return volumes


def _read_side(row: Mapping[str, str | None], column: str, where: str) -> float:
    written = (row[column] or "").strip()
    try:
        side = float(written)
    except ValueError:
        side = math.nan
    if not (math.isfinite(side) and side > 0):
        raise GroundingError(f"{where}: {column} of {row['class']} is {written!r}; expected metres above 0, as in 0.08")
    return side
