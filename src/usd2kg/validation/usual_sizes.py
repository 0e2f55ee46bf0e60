"""The usual size of things of a class: from our table of classes, else by the class's label from that of nouns."""

import csv
import io
from functools import lru_cache
from importlib.resources import files

from usd2kg.grounding.lexical.concepts.sizes import typical_extents
from usd2kg.ontology import expand_curie

__all__ = ["usual_extent"]

_SIDES = ("width_m", "depth_m", "height_m")


@lru_cache(maxsize=1)
def _class_extents() -> dict[str, float]:
    text = (files("usd2kg") / "data" / "class_sizes.csv").read_text("utf-8")
    rows = csv.DictReader(io.StringIO(text, newline=""), strict=True)
    return {expand_curie(row["class"]): max(float(row[side]) for side in _SIDES) for row in rows}


def usual_extent(class_iri: str, label: str) -> float | None:
    """Return the usual longest extent of things of a class in metres; None if it is not known.

    Args:
        class_iri: the class.
        label: its label in small letters.
    """
    known = _class_extents().get(class_iri)
    if known is not None:
        return known
    extents = typical_extents(label.replace(" ", ""))
    return extents[0] if extents is not None else None
