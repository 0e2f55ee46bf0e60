"""usual_size: how large things of a kind usually are, for what is not in the scene."""

from collections.abc import Mapping
from functools import cache

from usd2kg.knowledge import read_rows
from usd2kg.query.lookup.word_forms import singular

__all__ = ["usual_size"]

_UP = {
    "l": ("middle_m", "short_m", "long_m"),
    "m": ("long_m", "short_m", "middle_m"),
    "s": ("long_m", "middle_m", "short_m"),
}
"""Side that is usually up → the columns of width, depth and height."""


def usual_size(noun: str) -> tuple[float, float, float] | None:
    """Return width, depth and height in metres of things of a kind as they usually stand; None for an unknown kind.

    A container with something in it is as large as the container.

    >>> usual_size("vase of flowers") == usual_size("vase")
    True
    """
    words = noun.lower().partition(" of ")[0].split()
    names = (" ".join([*words[start:-1], singular(words[-1])]) for start in range(len(words)))
    row = next((_rows()[name] for name in names if name in _rows()), None)
    if row is None:
        return None
    width, depth, height = (float(row[column]) for column in _UP[row["up"][0]])
    return width, depth, height


@cache
def _rows() -> Mapping[str, Mapping[str, str]]:
    return {row["noun"]: row for row in read_rows("everyday_objects.csv")}
