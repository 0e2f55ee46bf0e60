"""`attached-to` in a container: hangers on the rail of a wardrobe."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import first_of_each_group, rounded
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.distances import exact_distances
from usd2kg.relations.interlock import are_interlocked
from usd2kg.relations.model import Links, margin_below, margin_score
from usd2kg.relations.stronger import StrongerRelations
from usd2kg.relations.thresholds import AttachedRule
from usd2kg.shapes import overlapping_pairs

__all__ = ["find_hung_inside"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


def find_hung_inside(
    boxed: BoxedObjects, stronger: StrongerRelations, is_low: Mask, is_left_out: Mask, rule: AttachedRule
) -> Links:
    """Return the `attached-to` links of contents that nothing in their container supports, and that hook on something.

    What they hook on is above their middle and in the same container; it hangs there itself, is a part of the
    container, or touches the container, which then holds it, as a wardrobe its rail.

    Args:
        boxed: the objects.
        stronger: the relations found so far.
        is_low: whether each object rests on a surface of its container.
        is_left_out: objects that neither hang nor hold.
        rule: the thresholds.
    """
    container = stronger.container
    is_content = stronger.may_hover & (container >= 0) & ~is_low & ~is_left_out
    # What is on something that nothing supports may carry it: a hanger its coat.
    is_content |= (stronger.supporter >= 0) & is_content[stronger.supporter] & ~is_low & ~is_left_out
    inside = np.where(container >= 0, container, stronger.frame)
    target, anchor = _hooked(boxed, np.flatnonzero(is_content), inside, is_left_out, rule)
    is_held = (stronger.frame >= 0) & (stronger.frame != container)
    own = np.unique(anchor[is_content[anchor]])
    gap = exact_distances(boxed, own, container[own], np.full(len(own), rule.max_touch))
    rails, rail_gap = own[gap <= rule.max_touch], gap[gap <= rule.max_touch]
    is_held[rails] = True
    chosen = np.zeros(len(target), np.bool_)
    is_found = np.zeros(len(boxed), np.bool_)
    while len(some := np.flatnonzero(is_held[anchor] & ~is_found[target] & ~np.isin(target, rails))):
        best = some[first_of_each_group(target[some], (boxed.rank[anchor[some]], rounded(boxed.volume[anchor[some]])))]
        chosen[best] = True
        is_found[target[best]] = is_held[target[best]] = True
    target, anchor = target[chosen], anchor[chosen]
    is_used = np.isin(rails, anchor)
    target = np.concatenate([target, rails[is_used]])
    anchor = np.concatenate([anchor, container[rails[is_used]]])
    gap = np.concatenate([np.zeros(int(chosen.sum())), rail_gap[is_used]])
    confidence = margin_score(margin_below(gap, np.full(len(gap), rule.max_touch)))
    return Links("attached-to", rule.rule, target, anchor, {"gap": gap}, confidence)


def _hooked(
    boxed: BoxedObjects, targets: Indices, inside: Indices, is_left_out: Mask, rule: AttachedRule
) -> tuple[Indices, Indices]:
    """Return the pairs of a target and what it hooks on, in the same container."""
    found = [(np.zeros(0, np.int64), np.zeros(0, np.int64))]
    others = np.flatnonzero(np.isin(inside, inside[targets]) & ~is_left_out & (inside >= 0))
    ends = boxed.lower[targets], boxed.upper[targets], (boxed.lower[others], boxed.upper[others])
    for i, j in overlapping_pairs(*ends):
        target, anchor = targets[i], others[j]
        is_good = (target != anchor) & (inside[target] == inside[anchor])
        is_good &= boxed.lower[anchor, 2] >= boxed.middle[target, 2]
        is_good &= are_interlocked(boxed, target, anchor, rule.min_interlock)
        found.append((target[is_good], anchor[is_good]))
    target, anchor = (np.concatenate(column) for column in zip(*found, strict=True))
    meets = exact_distances(boxed, target, anchor, np.full(len(target), rule.max_touch)) <= rule.max_touch
    return target[meets], anchor[meets]
