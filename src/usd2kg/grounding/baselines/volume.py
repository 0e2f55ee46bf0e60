"""The study's LV-NN baseline: the class whose common-sense box is nearest in log volume. Names are not looked at."""

import csv
import io
import math
from collections.abc import Mapping, Sequence
from pathlib import Path

from usd2kg.errors import GroundingError, OntologyError
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.model import Candidate, Prediction, Status
from usd2kg.knowledge import read_text
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.ontology.prefixes import expand_curie

__all__ = ["SMALLEST_SIDE", "VolumeGrounder"]

SMALLEST_SIDE = 0.001
"""Metres. A thinner side counts as this: a sheet has a box without volume, and zero has no logarithm."""
_SIDES = ("width_m", "depth_m", "height_m")
_COLUMNS = ("class", *_SIDES, "origin")
_CANDIDATES = 8
_UNITS = (("m³", 1.0), ("l", 1e-3), ("ml", 1e-6), ("mm³", 1e-9))
"""Unit of volume → cubic metres, largest first."""


class VolumeGrounder:
    """Compares the volume of an object's box with one typical volume of each class."""

    name = "volume"
    is_calibrated = False

    def __init__(self, volumes: Mapping[str, float] | None = None, source: str = "written by hand") -> None:
        """Make the grounder.

        Args:
            volumes: class (IRI, CURIE or local name) → typical volume of its box in cubic metres; by default what
                we think typical of the classes of SOMA-HOME.
            source: where `volumes` are from, for the record.

        Raises:
            GroundingError: a volume is not positive and finite.
        """
        if volumes is None:
            text = read_text("class_sizes.csv")
            volumes, source = _read_volumes(text, "class_sizes.csv"), "built-in"
        for named, volume in volumes.items():
            if not (math.isfinite(volume) and volume > 0):
                raise GroundingError(f"{source}: {named} has the volume {volume}; expected cubic metres above 0")
        self._volumes = dict(volumes)
        self._source = source

    @classmethod
    def from_csv(cls, path: Path) -> "VolumeGrounder":
        """Return a grounder over the columns `class,width_m,depth_m,height_m,origin` of a CSV file.

        Raises:
            GroundingError: the file is missing, has not these columns, or a row cannot be read.
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
        """The settings that its answers depend on."""
        return {"class_sizes": self._source, "smallest_side_m": str(SMALLEST_SIDE)}

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view).

        Raises:
            GroundingError: no class of the TBox has a typical volume, or one class has two.
        """
        priors = self._priors_of(tbox)
        return [self._predict(path, view, tbox, priors) for path, view in views]

    def _priors_of(self, tbox: TBox) -> dict[ClassIRI, float]:
        priors: dict[ClassIRI, float] = {}
        for named, volume in self._volumes.items():
            try:
                iri = tbox.resolve(named)
            except OntologyError:
                continue  # sizes may be of more classes than one TBox has
            if priors.setdefault(iri, volume) != volume:
                raise GroundingError(
                    f"{self._source}: {named} has the volumes {priors[iri]} and {volume}; expected one for each class"
                )
        if not priors:
            raise GroundingError(
                f"{self._source}: has a size for none of the {len(tbox.classes)} classes of {tbox.source}; "
                f"give typical sizes of these classes in a CSV file with the columns {','.join(_COLUMNS)}"
            )
        return priors

    def _predict(self, path: str, view: ObjectView, tbox: TBox, priors: Mapping[ClassIRI, float]) -> Prediction:
        volume = _box_volume(view)
        if volume is None:
            return Prediction(path, None, None, Status.REFUSED, self.name, "it has no box to measure")
        # The smaller over the larger volume is exp(-|ln v - ln v_c|): nearest in log volume, and 1 where both agree.
        scored = (Candidate(iri, min(volume, prior) / max(volume, prior)) for iri, prior in priors.items())
        candidates = tuple(sorted(scored, key=lambda c: (-c.score, c.class_iri))[:_CANDIDATES])
        best = candidates[0]
        text = (
            f"its box holds {_in_words(volume)}, nearest is {tbox.by_iri[best.class_iri].readable_name} "
            f"with {_in_words(priors[best.class_iri])}"
        )
        return Prediction(path, best.class_iri, best.score, Status.GROUNDED, self.name, text, ("geometry",), candidates)


def _box_volume(view: ObjectView) -> float | None:
    """Return the volume of an object's box in cubic metres, None without a box of finite size."""
    if view.size is None:
        return None
    volume = math.prod(max(side, SMALLEST_SIDE) for side in view.size)
    return volume if math.isfinite(volume) else None


def _in_words(volume: float) -> str:
    # From 0.1 of a unit on: people say 0.5 l, not 500 ml.
    unit, factor = next(((unit, factor) for unit, factor in _UNITS if volume >= 0.1 * factor), _UNITS[-1])
    amount = volume / factor
    return f"{amount:.2f} {unit}" if amount < 10 else f"{amount:.0f} {unit}"


def _read_volumes(text: str, source: str) -> dict[str, float]:
    # As a stream, so that a quoted line break stays inside its cell.
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
            named = (row["class"] or "").strip()
            if not named:
                raise GroundingError(f"{where} names no class; expected an IRI, a CURIE or a local name")
            earlier = lines.setdefault(expand_curie(named), rows.line_num)
            if earlier != rows.line_num:
                raise GroundingError(f"{where}: {named} is already in line {earlier}; expected each class once")
            volumes[named] = math.prod(_read_side(row, side, where) for side in _SIDES)
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
