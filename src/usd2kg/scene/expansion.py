"""check_expansion: reject stages whose nested instances expand to too many prims."""

from collections import Counter
from collections.abc import Iterable
from typing import Any

from pxr import Usd

from usd2kg.errors import SceneError
from usd2kg.scene.settings import LIMITS

__all__ = ["check_expansion"]

_READ = Usd.PrimIsActive & Usd.PrimIsDefined & ~Usd.PrimIsAbstract
"""Predicate of the prims to read; other prims are never expanded."""


def check_expansion(stage: Any, source: str) -> None:
    """Raise SceneError if a stage has more than `LIMITS.max_prims` prims, those of all instances included.

    Instances may nest: ten in each of nine prototypes are a billion prims in a file of 6 kB. The count needs each
    prototype once.
    """
    if not stage.GetPrototypes():
        return
    count, instances = _count_below(stage.GetPseudoRoot())
    sizes = _expanded_sizes(instances)
    total = count + _expanded(instances, sizes)
    if total > LIMITS.max_prims:
        largest = max(instances, key=lambda prototype: instances[prototype] * sizes[prototype])
        raise SceneError(
            f"{source}: its instances stand for {total:,} prims, expected at most {LIMITS.max_prims:,}; instances such "
            f"as {_an_instance(stage, largest)} hold {sizes[largest]:,} each; deactivate or flatten nested instances"
        )


def _count_below(root: Any) -> tuple[int, Counter[Any]]:
    """Return the number of prims below a prim, those of instances not included, and prototype → its instances."""
    instances: Counter[Any] = Counter()
    count = -1
    for prim in Usd.PrimRange(root, _READ):
        count += 1
        if prim.IsInstance():
            instances[prim.GetPrototype()] += 1
    return count, instances


def _expanded_sizes(prototypes: Iterable[Any]) -> dict[Any, int]:
    """Return prototype → prims below it, those of nested instances included. Prototypes cannot contain themselves."""
    sizes: dict[Any, int] = {}
    counts: dict[Any, tuple[int, Counter[Any]]] = {}
    pending = list(prototypes)
    while pending:
        prototype = pending[-1]
        if prototype not in counts:
            counts[prototype] = _count_below(prototype)
        count, nested = counts[prototype]
        missing = [other for other in nested if other not in sizes]
        if missing:
            pending.extend(missing)
        else:
            sizes[pending.pop()] = count + _expanded(nested, sizes)
    return sizes


def _expanded(instances: Counter[Any], sizes: dict[Any, int]) -> int:
    return sum(number * sizes[prototype] for prototype, number in instances.items())


def _an_instance(stage: Any, prototype: Any) -> str:
    """Return the path of an instance of a prototype, which itself has a generated name."""
    instances = [prim.GetPath().pathString for prim in prototype.GetInstances() if not prim.IsInPrototype()]
    return str(min(instances, default=prototype.GetPath().pathString))
