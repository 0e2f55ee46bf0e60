"""Typical size of a class: from `class_sizes.csv` by its IRI, else from `everyday_objects.csv` by its label."""

from functools import lru_cache

from usd2kg.grounding.lexical.concepts.sizes import typical_extents
from usd2kg.knowledge import read_rows
from usd2kg.ontology import expand_curie

__all__ = ["typical_class_extent"]

_SIDES = ("width_m", "depth_m", "height_m")


@lru_cache(maxsize=1)
def _class_extents() -> dict[str, float]:
    rows = read_rows("class_sizes.csv")
    return {expand_curie(row["class"]): max(float(row[side]) for side in _SIDES) for row in rows}


def typical_class_extent(class_iri: str, label: str) -> float | None:
    """Return the typical longest extent of a class in metres; None if unknown.

    Args:
        class_iri: the class.
        label: its label in lower case.
    """
    known = _class_extents().get(class_iri)
    if known is not None:
        return known
    extents = typical_extents(label.replace(" ", ""))
    return extents[0] if extents is not None else None
