"""Names without the numbers that tell copies apart, so that all copies are read once."""

import re
from functools import lru_cache

__all__ = ["without_copy_numbers"]

_NUMBER = re.compile(r"[0-9]+")
_LAST_NUMBER = re.compile(r"[0-9]+\Z")
_SHORT, _LONG = "0", "000"
"""What stands for the last number of a name; modelling programs number boxes with three digits or more."""
_OF_PARENT = "00"
"""What stands for the last number of a name above; not the same, lest the name seems to repeat it."""


def without_copy_numbers(name: str, parents: tuple[str, ...]) -> tuple[str, tuple[str, ...]]:
    """Return a name and the names above with equal last numbers for all copies; they read the same as before.

    Unchanged if the name and a name above share a number, which makes the name refer to the prim above.

    >>> without_copy_numbers("oak_chair_17", ("World", "Flat_3"))
    ('oak_chair_0', ('World', 'Flat_00'))
    >>> without_copy_numbers("cabinet10_drawer", ("cabinet10",))
    ('cabinet10_drawer', ('cabinet10',))
    """
    equalized, numbers = _equalize_parents(parents)
    if numbers is None or not numbers.isdisjoint(_NUMBER.findall(name)):
        return name, parents
    last = _LAST_NUMBER.search(name)
    if last is None:
        return name, equalized
    start = last.start()
    return name[:start] + (_SHORT if len(name) - start < len(_LONG) else _LONG), equalized


@lru_cache(maxsize=4096)
def _equalize_parents(parents: tuple[str, ...]) -> tuple[tuple[str, ...], frozenset[str] | None]:
    """Return the names above with equal last numbers, and the numbers that no equalized name may have.

    None if one of them is what stands for the last number of a name.
    """
    numbers = frozenset(number for parent in parents for number in _NUMBER.findall(parent))
    if not numbers.isdisjoint((_SHORT, _LONG)):
        return parents, None
    return tuple(_LAST_NUMBER.sub(_OF_PARENT, parent) for parent in parents), numbers | {_OF_PARENT}
