"""`inside`: objects enclosed by a container, or standing in an open one."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import concatenate_rows, first_of_each_group, is_on_cycle, ratios, select_rows
from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership, corners_of, overlap_areas
from usd2kg.relations.enclosure import measure_enclosures, measure_flanks
from usd2kg.relations.model import Links, margin_above, margin_score
from usd2kg.relations.thresholds import InsideRule, RelationRules, StandingInRule
from usd2kg.shapes import overlapping_pairs

__all__ = ["Containment", "find_inside"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


class Containment(NamedTuple):
    """The `inside` links, and the container of each object."""

    links: list[Links]
    container: Indices
    """Index of the container of each object, -1 for none. A dome is none, since what it covers stands below it."""


class _Agreement(NamedTuple):
    """What surfaces say of pairs that their boxes suggest, one row each."""

    agrees: Mask
    is_shallow: Mask
    """Whether all agrees but the depth of the cavity below the target."""
    is_covered: Mask
    """Whether the anchor surrounds the target from above, and is open below."""


class _ContainmentPairs(NamedTuple):
    """Pairs of a target and a possible container."""

    target: Indices
    anchor: Indices
    ratio: Array
    confidence: Array
    sticks_out: Mask
    """Whether the target stands in the container and protrudes at its top."""
    is_surrounded: Mask
    """Whether only the surface of the anchor may show that it contains the target, and not its class."""


def find_inside(boxed: BoxedObjects, classes: ClassMembership, wholes: Indices, rules: RelationRules) -> Containment:
    """Return the container of each object: the smallest that encloses it or that it stands in.

    The class decides what is a container: a chair under a table is in the table's box but not inside the table. A
    whole contains its drawers, of any class.

    Args:
        boxed: the objects.
        classes: membership in class lists.
        wholes: index of the whole of each object, -1 for none.
        rules: the thresholds.
    """
    can_contain = classes.can_contain[boxed.scene_index]
    is_drawer = classes.are_drawers[boxed.scene_index]
    may_be_in = (classes.may_be_placed & ~classes.are_in("not_contained"))[boxed.scene_index]
    has_parts = bool((wholes >= 0).any())
    is_open = can_contain & ~classes.are_in("closed")[boxed.scene_index]
    never = (
        (classes.are_in("not_containers") & ~classes.are_in("covers"))
        | classes.are_in("walls")
        | classes.are_in("not_neighbours")
    )
    is_room_sized = boxed.size.min(axis=1) >= rules.room.min_side
    is_room_sized &= boxed.size[:, 2] >= rules.room.min_height
    may_surround = boxed.has_surface & ~(can_contain | never[boxed.scene_index] | is_room_sized)
    found = [_no_pairs()]
    for i, j in overlapping_pairs(boxed.lower, boxed.upper):
        for target, anchor in ((i, j), (j, i)):
            may = may_be_in[target] & can_contain[anchor]
            if has_parts:
                may |= may_be_in[target] & is_drawer[target] & (wholes[target] == anchor)
                may &= ~_overlap_as_parts(target, anchor, wholes, is_drawer)
            may &= _overlap_vertically(boxed, target, anchor)
            found.append(_enclosed(boxed, target[may], anchor[may], rules.inside))
            is_around = may_be_in[target] & may_surround[anchor] & ~may
            if has_parts:
                is_around &= ~((wholes[target] == anchor) & _are_fronts(boxed, target, anchor, rules.inside))
            is_around &= _overlap_vertically(boxed, target, anchor)
            found.append(_by_surface(_enclosed(boxed, target[is_around], anchor[is_around], rules.inside)))
            stands = may & is_open[anchor]
            found.append(_standing(boxed, target[stands], anchor[stands], rules.standing_in))
            # A jar without its lid, and a glass of any other name.
            stands = is_around | (may & ~is_open[anchor] & boxed.has_surface[anchor])
            found.append(_by_surface(_standing(boxed, target[stands], anchor[stands], rules.standing_in)))
    pairs = concatenate_rows(found)
    pairs = select_rows(pairs, ~_are_lids(boxed, pairs, classes.are_in("covers")[boxed.scene_index]))
    agreement = _surfaces_agree(boxed, pairs, is_open, wholes, rules)
    agrees = agreement.agrees | _are_on_contents(boxed, pairs, agreement, rules)
    pairs, is_covered = select_rows(pairs, agrees), agreement.is_covered[agrees]
    covered = pairs.target[is_covered] * len(boxed) + pairs.anchor[is_covered]
    return _smallest(boxed, select_rows(pairs, ~_are_on_top(boxed, pairs, ~is_open, rules)), covered, rules)


def _no_pairs() -> _ContainmentPairs:
    nothing, no_number = np.zeros(0, np.int64), np.zeros(0)
    return _ContainmentPairs(nothing, nothing, no_number, no_number, np.zeros(0, np.bool_), np.zeros(0, np.bool_))


def _by_surface(pairs: _ContainmentPairs) -> _ContainmentPairs:
    return pairs._replace(is_surrounded=np.ones(len(pairs.target), np.bool_))


def _overlap_as_parts(target: Indices, anchor: Indices, wholes: Indices, is_drawer: Mask) -> Mask:
    """Return for each pair whether it overlaps as parts do: a cabinet in its drawer, a drawer behind a taller front."""
    are_beside = is_drawer[target] & is_drawer[anchor] & (wholes[target] >= 0) & (wholes[target] == wholes[anchor])
    return np.asarray((wholes[anchor] == target) | are_beside)


def _are_fronts(boxed: BoxedObjects, target: Indices, anchor: Indices, rule: InsideRule) -> Mask:
    """Return for each pair whether the target is a thin upright sheet at a side of the anchor, as an inset door is."""
    thickness, depth = boxed.size[target, :2], boxed.size[anchor, :2]
    below = boxed.lower[target, :2] - boxed.lower[anchor, :2]
    above = boxed.upper[anchor, :2] - boxed.upper[target, :2]
    is_at_side = np.minimum(below, above) <= thickness
    return np.asarray((is_at_side & (thickness <= rule.max_front_share * depth)).any(axis=1))


def _overlap_vertically(boxed: BoxedObjects, target: Indices, anchor: Indices) -> Mask:
    return np.asarray(
        (boxed.lower[target, 2] < boxed.upper[anchor, 2]) & (boxed.upper[target, 2] > boxed.lower[anchor, 2])
    )


def _shares(boxed: BoxedObjects, target: Indices, anchor: Indices) -> Array:
    """Return the share of the target's extent in the anchor's box along each axis, (n, 3)."""
    low = np.maximum(boxed.lower[target], boxed.lower[anchor])
    high = np.minimum(boxed.upper[target], boxed.upper[anchor])
    size = boxed.size[target]
    # An extent of 0 is either in or out, so that a flat napkin can be in a drawer.
    share = np.where(size > 0, np.clip(high - low, 0, None) / np.where(size > 0, size, 1.0), high >= low)
    return np.asarray(share, np.float64)


def _enclosed(boxed: BoxedObjects, target: Indices, anchor: Indices, rule: InsideRule) -> _ContainmentPairs:
    ratio = np.minimum(_shares(boxed, target, anchor).prod(axis=1), 1.0)
    middle = boxed.middle[target]
    is_good = (
        (ratio >= rule.min_volume_ratio)
        & (boxed.volume[target] < boxed.volume[anchor])
        & ((middle >= boxed.lower[anchor]) & (middle <= boxed.upper[anchor])).all(axis=1)
    )
    clear = margin_score(margin_above(ratio, rule.min_volume_ratio))
    no = np.zeros(len(target), np.bool_)
    return select_rows(_ContainmentPairs(target, anchor, ratio, clear, no, no), is_good)


def _standing(boxed: BoxedObjects, target: Indices, anchor: Indices, rule: StandingInRule) -> _ContainmentPairs:
    shares = _shares(boxed, target, anchor)
    over, depth = shares[:, 0] * shares[:, 1], shares[:, 2]
    above_floor = boxed.lower[target, 2] - boxed.lower[anchor, 2]
    least = np.where(above_floor > rule.same_level, rule.min_overlap_ratio, rule.min_level_overlap_ratio)
    is_root = boxed.foot_area[target] <= rule.max_root_ratio * boxed.area[anchor]
    is_root &= boxed.has_surface[anchor] & (depth < rule.min_depth_share)
    least_depth = np.where(is_root, rule.min_rooted_share, rule.min_depth_share)
    is_good = (
        (boxed.upper[target, 2] > boxed.upper[anchor, 2])
        & (above_floor >= -rule.same_level)
        & (depth >= least_depth)
        & (over >= least)
        & (boxed.area[target] <= rule.max_area_ratio * boxed.area[anchor])
    )
    clear = margin_score(margin_above(over, least), margin_above(depth, least_depth))
    no = np.zeros(len(target), np.bool_)
    return select_rows(_ContainmentPairs(target, anchor, over * depth, clear, ~no, no), is_good)


def _are_lids(boxed: BoxedObjects, pairs: _ContainmentPairs, is_lid: Mask) -> Mask:
    """Return for each pair whether the target closes the anchor, in whose upper half it is: a lid over a box or a pot.

    It is broader than the anchor, or a lid by its class, and sticks out. A plant is broader than its pot, but its stem
    is not.
    """
    lower, upper = boxed.feet
    feet = (upper - lower)[pairs.target, :2]
    closes = (feet > boxed.size[pairs.anchor, :2]).all(axis=1) | (is_lid[pairs.target] & pairs.sticks_out)
    return np.asarray(closes & (boxed.lower[pairs.target, 2] > boxed.middle[pairs.anchor, 2]))


def _are_on_contents(
    boxed: BoxedObjects, pairs: _ContainmentPairs, agreement: _Agreement, rules: RelationRules
) -> Mask:
    """Return for each shallow pair whether the target lies on what the anchor contains, from the bottom up."""
    is_on = np.zeros(len(pairs.target), np.bool_)
    inside: dict[int, list[int]] = {}
    for pair in np.flatnonzero(agreement.agrees).tolist():
        inside.setdefault(int(pairs.anchor[pair]), []).append(int(pairs.target[pair]))
    pending = np.flatnonzero(agreement.is_shallow)
    for pair in pending[np.argsort(boxed.lower[pairs.target[pending], 2], kind="stable")].tolist():
        target, contents = int(pairs.target[pair]), inside.get(int(pairs.anchor[pair]), [])
        shared = overlap_areas(
            boxed.lower[[target]], boxed.upper[[target]], boxed.lower[contents], boxed.upper[contents]
        )
        gap = np.abs(boxed.lower[target, 2] - boxed.upper[contents, 2])
        is_on[pair] = bool(
            ((shared > rules.on.min_overlap_ratio * boxed.area[target]) & (gap <= rules.on.max_gap)).any()
        )
        if is_on[pair]:
            contents.append(target)
    return is_on


def _surfaces_agree(
    boxed: BoxedObjects, pairs: _ContainmentPairs, is_open: Mask, wholes: Indices, rules: RelationRules
) -> _Agreement:
    """Return for each pair whether the surface of the anchor encloses the target.

    Without a surface, it does. Drawers are in their whole, whose surface may be that of its front or of a solid.
    """
    count = len(pairs.target)
    agreement = _Agreement(np.ones(count, np.bool_), np.zeros(count, np.bool_), np.zeros(count, np.bool_))
    is_drawer = (wholes[pairs.target] == pairs.anchor) & ~pairs.is_surrounded
    known = np.flatnonzero(boxed.has_surface[pairs.anchor] & ~is_drawer)
    some, rule = select_rows(pairs, known), rules.inside
    found = measure_enclosures(boxed, some.target, some.anchor)
    is_in = (found.beside >= rule.min_beside) & (found.below >= rule.min_below)
    is_in |= found.caged >= rule.min_caged
    is_in &= (found.buried <= rule.max_buried) | ~is_open[some.anchor]
    is_around = np.minimum(np.minimum(found.below, found.above), found.beside) >= rule.min_surrounded
    is_around &= some.is_surrounded
    around = np.flatnonzero(is_around)
    flanks = measure_flanks(boxed, some.target[around], some.anchor[around], rule.min_cavity_depth)
    is_around[around] = flanks >= rule.min_surrounded
    depth = boxed.upper[some.anchor, 2] - boxed.lower[some.target, 2]
    is_deep = depth >= rule.min_cavity_depth * boxed.size[some.anchor, :2].min(axis=1)
    is_walled = (found.beside >= rule.min_walled) & (found.below >= rule.min_surrounded)
    is_free = found.buried <= rule.max_buried
    is_around = (is_around | (is_walled & is_deep)) & is_free
    shares = _shares(boxed, some.target, some.anchor)
    # A dome over a cake.
    is_covered = (found.beside >= rule.min_walled) & (found.above >= rule.min_walled) & (shares == 1).all(axis=1)
    is_covered &= some.is_surrounded & (found.below < rule.min_below)
    stands = (found.beside >= rules.standing_in.min_beside) | (found.caged >= rule.min_caged)
    stands &= is_walled | (shares[:, 2] >= rules.standing_in.min_depth_share)
    stands &= ~some.is_surrounded | (is_walled & is_free & is_deep)
    is_around |= is_covered
    agreement.agrees[known] = np.where(some.sticks_out, stands, np.where(some.is_surrounded, is_around, is_in))
    agreement.is_shallow[known] = some.is_surrounded & ~some.sticks_out & is_walled & is_free & ~is_around
    agreement.is_covered[known] = is_covered
    return agreement


def _are_on_top(boxed: BoxedObjects, pairs: _ContainmentPairs, is_closed: Mask, rules: RelationRules) -> Mask:
    """Return for each pair whether the target is on top of the anchor and thus not inside it.

    The top is the highest broad level, in the upper third: a worktop is lower than its box if it has an upstand. The
    ledge beside the top of a closed object counts as well.
    """
    over = np.full(len(pairs.target), -np.inf)
    top = np.full(len(pairs.target), -np.inf)
    has_levels = np.array([bool(obj.support_levels) for obj in boxed.objects], np.bool_)
    for pair in np.flatnonzero(has_levels[pairs.anchor]).tolist():
        target, anchor = pairs.target[pair], pairs.anchor[pair]
        lower, upper = corners_of(boxed.objects[anchor].support_levels)
        shared = overlap_areas(boxed.lower[[target]], boxed.upper[[target]], lower, upper)
        is_over = shared > rules.on.min_overlap_ratio * boxed.area[target]
        over[pair], top[pair] = max(upper[is_over, 2], default=-np.inf), upper[:, 2].max()
    stands = boxed.lower[pairs.target, 2] > over - rules.on.max_sink
    highest = np.where(is_closed[pairs.anchor], top, over)
    share = ratios(highest - boxed.lower[pairs.anchor, 2], boxed.size[pairs.anchor, 2])
    return np.asarray(stands & (share > rules.inside.max_floor_share))


def _smallest(boxed: BoxedObjects, pairs: _ContainmentPairs, covered: Indices, rules: RelationRules) -> Containment:
    """Return the smallest container of each object; `covered` has the keys of the pairs with a dome."""
    keys = (boxed.rank[pairs.anchor], pairs.sticks_out, boxed.volume[pairs.anchor])
    best = first_of_each_group(pairs.target, keys)
    is_round = is_on_cycle(_pointers(boxed, pairs, best), pairs.target[best])
    # Of a bin and the bag in it, the one that starts lower is outside.
    starts_higher = boxed.lower[pairs.target[best], 2] > boxed.lower[pairs.anchor[best], 2]
    best = best[~is_round | starts_higher]
    links = []
    is_surrounded, sticks_out = pairs.is_surrounded[best], pairs.sticks_out[best]
    chosen_by = {
        rules.inside.rule: ~(is_surrounded | sticks_out),
        rules.standing_in.rule: sticks_out,
        rules.inside.surrounded_rule: is_surrounded & ~sticks_out,
    }
    for rule, is_chosen in chosen_by.items():
        chosen = best[is_chosen]
        numbers = {"insideRatio": pairs.ratio[chosen]}
        links.append(
            Links("inside", rule, pairs.target[chosen], pairs.anchor[chosen], numbers, pairs.confidence[chosen])
        )
    has_floor = best[~np.isin(pairs.target[best] * len(boxed) + pairs.anchor[best], covered)]
    return Containment(links, _pointers(boxed, pairs, has_floor))


def _pointers(boxed: BoxedObjects, pairs: _ContainmentPairs, chosen: Indices) -> Indices:
    pointers = np.full(len(boxed), -1)
    pointers[pairs.target[chosen]] = pairs.anchor[chosen]
    return pointers
