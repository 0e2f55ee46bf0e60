"""Relations that are stronger than adjacency and suppress weaker ones between the same objects."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.adjacency import NearbyPairs
from usd2kg.relations.array_records import select_rows
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.containment import Containment
from usd2kg.relations.foot_contacts import ROUNDING
from usd2kg.relations.model import Links
from usd2kg.relations.part_of import PartLinks, boxed_ends

__all__ = ["StrongerRelations"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


class StrongerRelations:
    """The `on`, `inside`, `attached-to` and `part-of` relations found so far."""

    def __init__(self, boxed: BoxedObjects, containment: Containment, parts: PartLinks) -> None:
        self._count = len(boxed)
        self.is_loose = np.ones(len(boxed), np.bool_)
        """Whether each object may rest on another.

        Parts that move on a joint may only if they reach below what they move on: wheels, not drawers and doors.
        """
        self.container = containment.container
        """Index of the container of each object; -1 for none."""
        self.frame = containment.container.copy()
        """The whole of each object, else its container; -1 for neither."""
        self.supporter = np.full(len(boxed), -1)
        """One supporter of each object; -1 for none."""
        self.is_attached = np.zeros(len(boxed), np.bool_)
        """Whether each object is attached to another."""
        self._whole = np.full(len(boxed), -1)
        self._attached_to = np.full(len(boxed), -1)
        self._part_keys = np.concatenate([self._keep_parts(*boxed_ends(boxed, links)) for links in parts])
        self._keys = [self._part_keys, *(self._key(links.target, links.anchor) for links in containment.links)]
        moved, hung = boxed_ends(boxed, parts.stated)
        moved, hung = moved[(moved >= 0) & (hung >= 0)], hung[(moved >= 0) & (hung >= 0)]
        self._bears = np.zeros(len(boxed), np.bool_)
        self._bears[moved] = boxed.lower[moved, 2] < boxed.lower[hung, 2] - ROUNDING
        self.is_loose[moved] = self._bears[moved]

    def _keep_parts(self, part: Indices, whole: Indices) -> Indices:
        known = (part >= 0) & (whole >= 0)
        self.frame[part[known]] = whole[known]
        self._whole[part[known]] = whole[known]
        return self._key(part[known], whole[known])

    def add_support(self, support: list[Links]) -> list[Links]:
        """Record `on` links and return them without those between a part and its own whole.

        A whole that stands on its parts is on what these stand on: a trolley on casters is on the floor.
        """
        support = self._pass_on(support)
        kept = [links.where(~np.isin(self._key(links.target, links.anchor), self._part_keys)) for links in support]
        for links in reversed(kept):
            self.supporter[links.target] = links.anchor
            self._keys.append(self._key(links.target, links.anchor))
        return kept

    def _pass_on(self, support: list[Links]) -> list[Links]:
        """Return `on` links with what a part is on instead of the part, where its own whole is on it."""
        below = np.full(self._count, -1)
        for links in reversed(support):
            is_outside = links.anchor != self._whole[links.target]
            below[links.target[is_outside]] = links.anchor[is_outside]
        passed: list[Links] = []
        known = np.zeros(0, np.int64)
        for links in support:
            is_own = (self._whole[links.anchor] == links.target) & (below[links.anchor] >= 0)
            anchor = np.where(is_own, below[links.anchor], links.anchor)
            key = links.target * self._count + anchor
            is_new = ~np.isin(key, known) & (anchor != links.target)
            is_new[np.setdiff1d(np.arange(len(key)), np.unique(key, return_index=True)[1])] = False
            known = np.concatenate([known, key])
            passed.append(links._replace(anchor=anchor).where(is_new))
        return passed

    def raise_to_wholes(self, support: list[Links]) -> list[Links]:
        """Return `on` links of wholes that rest on nothing themselves, with what their wheels are on."""
        is_supported = np.zeros(self._count, np.bool_)
        for links in support:
            is_supported[links.target] = True
        raised: list[Links] = []
        for links in support:
            whole = self._whole[links.target]
            is_borne = self._bears[links.target] & (whole >= 0) & ~is_supported[whole] & (links.anchor != whole)
            found = links._replace(target=whole).where(is_borne)
            _, first = np.unique(found.target, return_index=True)
            is_first = np.zeros(len(found.target), np.bool_)
            is_first[first] = True
            raised.append(found.where(is_first))
            is_supported[found.target] = True
        return raised

    def replace_support(self, support: list[Links], links: Links) -> list[Links]:
        """Record `attached-to` links instead of the support of their targets, and return the `on` links left."""
        is_moved = np.zeros(self._count, np.bool_)
        is_moved[links.target] = True
        left = self.withdraw_support(support, is_moved)
        self.add_attached(links)
        return left

    def withdraw_support(self, support: list[Links], is_moved: Mask) -> list[Links]:
        """Forget the support of the objects of a mask, and return the `on` links left."""
        moved = [self._key(found.target, found.anchor)[is_moved[found.target]] for found in support]
        self._keys = [keys[~np.isin(keys, np.concatenate(moved))] for keys in self._keys]
        self.supporter[is_moved] = -1
        return [found.where(~is_moved[found.target]) for found in support]

    def add_ties(self, one: Indices, other: Indices) -> None:
        """Record pairs of objects, neither of which is on or attached to the other by another rule."""
        self._keys.append(self._key(one, other))

    def add_attached(self, links: Links) -> Links:
        """Record `attached-to` links and return them."""
        self.is_attached[links.target] = True
        self._attached_to[links.target] = links.anchor
        self._keys.append(self._key(links.target, links.anchor))
        return links

    @property
    def is_free(self) -> Mask:
        """Whether each object is on, in, part of and attached to nothing."""
        return np.asarray((self.supporter < 0) & (self.frame < 0) & ~self.is_attached)

    @property
    def may_hover(self) -> Mask:
        """Whether each object is on, part of and attached to nothing, though it may be in something."""
        return np.asarray((self.supporter < 0) & (self.frame == self.container) & ~self.is_attached)

    @property
    def holder(self) -> Indices:
        """The supporter of each object, else its whole or container, else what it is attached to; -1 for none."""
        holder = np.where(self.supporter >= 0, self.supporter, self.frame)
        return np.where(holder >= 0, holder, self._attached_to)

    def _key(self, one: Indices, other: Indices) -> Indices:
        return np.asarray(np.minimum(one, other) * self._count + np.maximum(one, other))

    def drop_implied(self, links: Links) -> Links:
        """Return the links between objects without a stronger relation."""
        return links.where(~self.are_related(links.target, links.anchor))

    def in_same_frame(self, pairs: NearbyPairs) -> NearbyPairs:
        """Return the pairs with the same whole or container, or with neither."""
        return select_rows(pairs, self.frame[pairs.one] == self.frame[pairs.other])

    def drop_related(self, pairs: NearbyPairs) -> NearbyPairs:
        """Return the pairs without a stronger relation."""
        return select_rows(pairs, ~self.are_related(pairs.one, pairs.other))

    def are_related(self, one: Indices, other: Indices) -> Mask:
        """Return for each pair whether one of the relations holds between the two."""
        return np.isin(self._key(one, other), np.concatenate(self._keys))
