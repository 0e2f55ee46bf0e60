"""find_surplus: objects in one place beyond a number that real scenes have."""

from collections import Counter
from collections.abc import Iterable

from usd2kg.scene.model import Box, SceneObject
from usd2kg.scene.settings import LIMITS

__all__ = ["find_surplus"]


def find_surplus(objects: Iterable[SceneObject]) -> frozenset[str]:
    """Return the prim paths of objects whose own box equals that of at least `LIMITS.max_coincident` earlier objects.

    Each pair of objects in one place is a relation, so that thousands of copies that nobody moved apart would be
    millions of relations that say nothing.
    """
    met: Counter[tuple[int, ...]] = Counter()
    surplus = []
    for obj in objects:
        if obj.own_box is not None:
            place = _rounded(obj.own_box)
            met[place] += 1
            if met[place] > LIMITS.max_coincident:
                surplus.append(obj.prim_path)
    return frozenset(surplus)


def _rounded(box: Box) -> tuple[int, ...]:
    return tuple(round(value / LIMITS.coincident_distance) for value in (*box.lower, *box.upper))
