"""Which whole each part is fitted to: by its kind, the group that both are in, and how they meet."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import first_of_each_group, ratios, rounded
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.distances import box_gaps, surface_distances
from usd2kg.relations.model import Links, margin_below, margin_score
from usd2kg.relations.part_roles import PartRoles
from usd2kg.relations.thresholds import PartOfRule
from usd2kg.shapes import overlapping_pairs
from usd2kg.shapes.mesh_distance import Solid, mesh_distance

__all__ = ["find_fitted"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_UP = 2
_NO_FIT = 3
_FAR = 2
"""Distance of groups that have nothing to do with each other."""


class _Pairs(NamedTuple):
    """Pairs of a part and a possible whole, one row each."""

    part: Indices
    whole: Indices
    groups: Indices
    """0 for the same group, 1 for a whole in the group above."""
    gaps: Array
    """(n, 3), between the boxes."""

    def where(self, chosen: Mask) -> "_Pairs":
        return _Pairs(self.part[chosen], self.whole[chosen], self.groups[chosen], self.gaps[chosen])


def find_fitted(boxed: BoxedObjects, roles: PartRoles, is_free: Mask, rule: PartOfRule) -> Links:
    """Return `part-of` links of parts to the best-fitting whole of their group or of the group above it."""
    found = [_fit(boxed, roles, pairs, rule) for pairs in _near_pairs(boxed, roles, is_free, rule)]
    pairs, order = (zip(*found, strict=True)) if found else ((), ())
    if not pairs:
        return _links(boxed, np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 3)), rule)
    part, whole, groups, gaps = (np.concatenate(column) for column in zip(*pairs, strict=True))
    rank = np.concatenate(order)
    met = np.clip((rule.max_gap - gaps) / (boxed.size[part] + rule.max_gap), 0, 1).prod(axis=1)
    best = first_of_each_group(part, (boxed.rank[whole], -rounded(met), rank, groups))
    return _links(boxed, part[best], whole[best], gaps[best], rule)


def _near_pairs(boxed: BoxedObjects, roles: PartRoles, is_free: Mask, rule: PartOfRule) -> Iterator[_Pairs]:
    family, family_above = _families(boxed)
    parts = np.flatnonzero(roles.part & is_free)
    wholes = np.flatnonzero(roles.host & np.isin(family, np.concatenate([family[parts], family_above[parts]])))
    reach = max(rule.max_gap, rule.max_hinge_gap)
    lower, upper = boxed.lower[parts] - reach, boxed.upper[parts] + reach
    for i, j in overlapping_pairs(lower, upper, (boxed.lower[wholes], boxed.upper[wholes])):
        part, whole = parts[i], wholes[j]
        groups = np.where(family[part] == family[whole], 0, np.where(family_above[part] == family[whole], 1, _FAR))
        is_good = (part != whole) & (groups < _FAR)
        part, whole = part[is_good], whole[is_good]
        yield _Pairs(part, whole, groups[is_good], box_gaps(boxed, part, whole))


def _families(boxed: BoxedObjects) -> tuple[Indices, Indices]:
    """Return for each object the number of the prim above it, and of the one above that; -1 for none."""
    above = [obj.prim_path.rpartition("/")[0] for obj in boxed.objects]
    number = {path: index for index, path in enumerate(dict.fromkeys(above))}
    # The stage is no group.
    outer = {path: number.get(path.rpartition("/")[0] or "/", -1) for path in number}
    return np.array([number[path] for path in above], np.int64), np.array([outer[path] for path in above], np.int64)


def _fit(boxed: BoxedObjects, roles: PartRoles, pairs: _Pairs, rule: PartOfRule) -> tuple[_Pairs, Indices]:
    """Return the pairs that fit, and how well the kinds of both go together; 0 is best."""
    rank = np.full(len(pairs.part), _NO_FIT, np.int64)
    for fits, order in (*_fit_by_boxes(boxed, roles, pairs, rule), *_fit_by_surfaces(boxed, roles, pairs, rule)):
        rank[fits] = np.minimum(rank[fits], order)
    return pairs.where(rank < _NO_FIT), rank[rank < _NO_FIT]


def _fit_by_boxes(boxed: BoxedObjects, roles: PartRoles, pairs: _Pairs, rule: PartOfRule) -> Iterator[tuple[Mask, int]]:
    """Yield which pairs fit by their kinds and boxes, and how well their kinds go together."""
    part, whole = pairs.part, pairs.whole
    is_met = (pairs.gaps <= rule.max_gap).all(axis=1)
    is_fitted = is_met & (boxed.upright_volume[part] < boxed.upright_volume[whole])
    is_front, is_body = roles.front[whole], roles.body[whole]
    yield is_fitted & roles.handle[part] & is_front, 0
    yield is_fitted & roles.front_fitting[part] & is_front & _are_beside_face(boxed, pairs), 0
    yield is_fitted & (roles.front | roles.handle)[part] & is_body, 1
    yield is_fitted & roles.drawer[part] & _are_slid_in(boxed, pairs, rule) & ~is_front, 2
    is_covered = roles.component[whole] | is_front | is_body
    yield is_fitted & roles.component[part] & is_covered & _are_covers(boxed, pairs, rule), 2
    yield is_fitted & roles.front[part] & ~is_front & _are_shut(boxed, pairs, rule), 2
    yield is_fitted & roles.caster[part] & ~roles.caster[whole] & _are_beneath(boxed, pairs, rule), 0
    # Neither is smaller than its whole: a shade is around the lamp, a lid may be deeper than a case.
    yield is_met & roles.lamp_part[part] & roles.lamp[whole], 0
    yield roles.lid[part] & ~roles.lid[whole] & _are_hinged(boxed, pairs, rule), 0


def _fit_by_surfaces(
    boxed: BoxedObjects, roles: PartRoles, pairs: _Pairs, rule: PartOfRule
) -> Iterator[tuple[Mask, int]]:
    """Yield which pairs fit by their kinds and surfaces, and how well their kinds go together."""
    part, whole = pairs.part, pairs.whole
    is_fitted = (pairs.gaps <= rule.max_gap).all(axis=1) & (boxed.upright_volume[part] < boxed.upright_volume[whole])
    is_in = is_fitted & roles.shelf[part] & roles.body[whole] & _are_slid_in(boxed, pairs, rule)
    is_in[is_in] = _are_fixed_in(boxed, pairs.where(is_in), rule)
    yield is_in, 0
    # A handle of a case, a pane in its frame, a rack on a door.
    is_on = (roles.handle | roles.fitting)[part] & ~roles.fitting[whole]
    is_on = is_fitted & (is_on | (roles.shelf[part] & roles.front[whole] & _are_beside_face(boxed, pairs)))
    is_carried = (roles.component | roles.shelf)[part] & ~(roles.skeleton | roles.fastener)[part]
    is_on |= is_fitted & is_carried & roles.skeleton[whole] & _are_slid_in(boxed, pairs, rule)
    is_on[is_on] = _are_touching(boxed, pairs.where(is_on), rule)
    yield is_on, 2


def _are_slid_in(boxed: BoxedObjects, pairs: _Pairs, rule: PartOfRule) -> Mask:
    shared = np.clip(-pairs.gaps, 0, None).prod(axis=1)
    return np.asarray(ratios(shared, boxed.volume[pairs.part]) >= rule.min_slid_in)


def _are_beside_face(boxed: BoxedObjects, pairs: _Pairs) -> Mask:
    """Return for each pair whether the part is in front of a face of the whole with its middle, and not longer."""
    middle = boxed.middle[pairs.part]
    is_shorter = boxed.size[pairs.part].max(axis=1) <= boxed.size[pairs.whole].max(axis=1)
    is_between = (middle >= boxed.lower[pairs.whole]) & (middle <= boxed.upper[pairs.whole])
    return np.asarray(is_shorter & is_between[:, _UP] & is_between[:, :_UP].any(axis=1))


def _are_touching(boxed: BoxedObjects, pairs: _Pairs, rule: PartOfRule) -> Mask:
    reach = np.full(len(pairs.part), rule.max_gap)
    return np.asarray(surface_distances(boxed, pairs.part, pairs.whole, reach) <= rule.max_gap)


def _are_covers(boxed: BoxedObjects, pairs: _Pairs, rule: PartOfRule) -> Mask:
    """Return for each pair whether the part is a sheet that covers an upright face of the whole: a door by its form."""
    return _are_sheets_before(boxed, pairs, rule.min_covered, np.abs(pairs.gaps[:, :_UP]) <= rule.max_gap)


def _are_shut(boxed: BoxedObjects, pairs: _Pairs, rule: PartOfRule) -> Mask:
    """Return for each pair whether the part is a sheet as large as an upright face of the whole, before or in it."""
    return _are_sheets_before(boxed, pairs, rule.min_shut, pairs.gaps[:, :_UP] <= rule.max_gap)


def _are_sheets_before(boxed: BoxedObjects, pairs: _Pairs, min_share: float, is_before: Mask) -> Mask:
    part, whole = pairs.part, pairs.whole
    shared = ratios(-pairs.gaps, np.maximum(boxed.size[part], boxed.size[whole]))
    found = np.zeros(len(part), np.bool_)
    for axis, across in ((0, 1), (1, 0)):
        is_thin = (boxed.size[part].argmin(axis=1) == axis) & (boxed.size[part, axis] < boxed.size[whole, axis])
        found |= is_before[:, axis] & is_thin & (shared[:, [across, _UP]] >= min_share).all(axis=1)
    return found


def _are_beneath(boxed: BoxedObjects, pairs: _Pairs, rule: PartOfRule) -> Mask:
    """Return for each pair whether the part is upright, the whole starts at its upper half, and is over half of it."""
    part, whole = pairs.part, pairs.whole
    shared = ratios(np.clip(-pairs.gaps[:, :_UP], 0, None).prod(axis=1), boxed.area[part])
    is_under = (boxed.lower[whole, _UP] >= boxed.middle[part, _UP]) & (boxed.upper[whole, _UP] > boxed.upper[part, _UP])
    is_upright = boxed.size[part, _UP] >= rule.min_upright * boxed.size[part, :_UP].max(axis=1)
    return np.asarray(is_upright & is_under & (shared >= rule.min_beneath))


def _are_hinged(boxed: BoxedObjects, pairs: _Pairs, rule: PartOfRule) -> Mask:
    """Return for each pair whether the part stands along a side of the rim of the whole, as an open lid does."""
    part, whole = pairs.part, pairs.whole
    size = boxed.size[part]
    is_raised = size[:, _UP] >= rule.min_raised * size[:, :_UP].max(axis=1)
    rise = boxed.lower[part, _UP] - boxed.upper[whole, _UP]
    is_at_rim = (np.abs(rise) <= rule.max_hinge_gap) & (boxed.upper[part, _UP] > boxed.upper[whole, _UP])
    along = ratios(-pairs.gaps, np.maximum(size, boxed.size[whole]))
    over = ratios(-pairs.gaps, boxed.size[whole])
    found = np.zeros(len(part), np.bool_)
    for axis, across in ((0, 1), (1, 0)):
        is_edge = (pairs.gaps[:, across] <= rule.max_hinge_gap) & (over[:, across] <= rule.max_leaning)
        found |= (along[:, axis] >= rule.min_hinge) & is_edge
    return np.asarray(found & is_raised & is_at_rim)


def _are_fixed_in(boxed: BoxedObjects, pairs: _Pairs, rule: PartOfRule) -> Mask:
    """Return for each pair whether both ends of the part meet the inner sides of the whole along x or y."""
    found = [
        any(_meets_both_sides(boxed, part, whole, axis, rule.max_shelf_gap) for axis in range(_UP))
        for part, whole in zip(pairs.part.tolist(), pairs.whole.tolist(), strict=True)
    ]
    return np.array(found, np.bool_)


def _meets_both_sides(boxed: BoxedObjects, part: int, whole: int, axis: int, reach: float) -> bool:
    surface = boxed.surfaces[whole]
    if surface is None:
        ends = boxed.size[whole, axis] - boxed.size[part, axis]
        return bool(ends <= 2 * reach)
    around = Solid(boxed.lower[whole], boxed.upper[whole], surface)
    for end in (boxed.lower, boxed.upper):
        # Only the middle of the end, since what stands on a board is near that board everywhere.
        point = boxed.middle[part].copy()
        point[axis] = end[part, axis]
        if not np.isfinite(mesh_distance(Solid(point, point, None), around, reach)):
            return False
    return True


def _links(boxed: BoxedObjects, part: Indices, whole: Indices, gaps: Array, rule: PartOfRule) -> Links:
    gap = np.clip(gaps.max(axis=1, initial=0), 0, None)
    confidence = margin_score(margin_below(gap, rule.max_gap))
    target, anchor = boxed.scene_index[part], boxed.scene_index[whole]
    return Links("part-of", rule.fitted_rule, target, anchor, {"gap": gap}, confidence)
