"""Numbers in the text of literals."""

import math

__all__ = ["parse_numbers"]


def parse_numbers(text: str) -> tuple[float, ...]:
    """Return the numbers of a text; empty if one of them is malformed or not finite.

    >>> parse_numbers("1 2.5"), parse_numbers("1 two")
    ((1.0, 2.5), ())
    """
    try:
        numbers = tuple(float(word) for word in text.split())
    except ValueError:
        return ()
    return numbers if all(map(math.isfinite, numbers)) else ()
