"""DictionaryGrounder: the dictionary baseline of the study, an exact lookup of the prim name."""

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path

from usd2kg.errors import GroundingError, OntologyError
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.model import Candidate, Prediction, Status
from usd2kg.knowledge import read_text
from usd2kg.ontology import TBox

__all__ = ["DictionaryGrounder"]


class DictionaryGrounder:
    """Looks up the exact prim name in a table of (name, class)."""

    name = "dictionary"
    is_calibrated = False

    def __init__(self, pairs: Mapping[str, str], source: str) -> None:
        """Create a grounder from name → class (IRI, CURIE or local name); `source` names the table in `settings`."""
        self._pairs = dict(pairs)
        self._source = source

    @classmethod
    def from_csv(cls, path: Path) -> "DictionaryGrounder":
        """Return a grounder over the columns `name` and `class` of a CSV file.

        Raises:
            GroundingError: the file is missing or lacks a column.
        """
        try:
            text = path.read_text("utf-8-sig")
        except (OSError, UnicodeDecodeError) as error:
            raise GroundingError(
                f"{path}: cannot be read as a CSV file with the columns name,class ({error})"
            ) from error
        return cls(_read_pairs(text, str(path)), str(path))

    @classmethod
    def multiverse(cls) -> "DictionaryGrounder":
        """Return a grounder over the dictionary of Multiverse-Knowledge, the baseline of the study."""
        text = read_text("multiverse_dictionary.csv")
        return cls(_read_pairs(text, "multiverse"), "multiverse")

    @property
    def settings(self) -> Mapping[str, str]:
        """The settings that affect its predictions."""
        return {"dictionary": self._source}

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view)."""
        return [self._predict(path, view, tbox) for path, view in views]

    def _predict(self, path: str, view: ObjectView, tbox: TBox) -> Prediction:
        class_name = self._pairs.get(view.name)
        if class_name is None:
            return Prediction(path, None, None, Status.REFUSED, self.name, f"“{view.name}” is not in the dictionary")
        try:
            iri = tbox.resolve(class_name)
        except OntologyError:
            text = f"the dictionary says {class_name}, which is not a class of the TBox"
            return Prediction(path, None, None, Status.UNREADABLE, self.name, text)
        text = f"“{view.name}” is in the dictionary as {class_name}"
        return Prediction(path, iri, 1.0, Status.GROUNDED, self.name, text, ("name",), (Candidate(iri, 1.0),))


def _read_pairs(text: str, source: str) -> dict[str, str]:
    rows = csv.DictReader(text.splitlines())
    try:
        if not {"name", "class"} <= set(rows.fieldnames or ()):
            found = ", ".join(rows.fieldnames or ()) or "nothing"
            raise GroundingError(f"{source}: line 1 has the columns {found}; expected name,class")
        return {row["name"]: row["class"] for row in rows if row["name"] and row["class"]}
    except csv.Error as error:
        raise GroundingError(f"{source}: line {rows.line_num} is not CSV ({error}); expected name,class") from error
