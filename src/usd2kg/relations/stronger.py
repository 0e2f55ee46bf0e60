"""What has been stronger of things already, and decides what else is said of them."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.adjacency import NearbyPairs
from usd2kg.relations.array_records import select_rows
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.containment import Containment
from usd2kg.relations.model import Links
from usd2kg.relations.part_of import PartLinks, boxed_ends

__all__ = ["StrongerRelations"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


class StrongerRelations:
    """What is on, in or part of what: stronger than being close, so that nothing weaker is said of the two."""

    def __init__(self, boxed: BoxedObjects, containment: Containment, parts: PartLinks) -> None:
        self._count = len(boxed)
        self.is_loose = np.ones(len(boxed), np.bool_)
        """Whether each may rest on something: what moves on a joint does not."""
        self.frame = containment.container.copy()
        """The whole that each is a part of, or else what it is inside of; -1 for neither."""
        self.supporter = np.full(len(boxed), -1)
        """What each is on; one of several; -1 for nothing."""
        self._part_keys = np.concatenate([self._keep_parts(*boxed_ends(boxed, links)) for links in parts])
        self._keys = [self._part_keys, *(self._key(links.target, links.anchor) for links in containment.links)]
        moved, _ = boxed_ends(boxed, parts.stated)
        self.is_loose[moved[moved >= 0]] = False

    def _keep_parts(self, part: Indices, whole: Indices) -> Indices:
        known = (part >= 0) & (whole >= 0)
        self.frame[part[known]] = whole[known]
        return self._key(part[known], whole[known])

    def add_support(self, support: list[Links]) -> list[Links]:
        """Return what is on what without parts on their own wholes, and remember it."""
        kept = [links.where(~np.isin(self._key(links.target, links.anchor), self._part_keys)) for links in support]
        for links in reversed(kept):
            self.supporter[links.target] = links.anchor
            self._keys.append(self._key(links.target, links.anchor))
        return kept

    def _key(self, one: Indices, other: Indices) -> Indices:
        return np.asarray(np.minimum(one, other) * self._count + np.maximum(one, other))

    def drop_implied(self, links: Links) -> Links:
        """Return the links of things of which nothing stronger is stronger."""
        return links.where(~self._are_related(links.target, links.anchor))

    def in_same_frame(self, pairs: NearbyPairs) -> NearbyPairs:
        """Return the pairs of things that are parts of the same whole or in the same container, or in none."""
        return select_rows(pairs, self.frame[pairs.one] == self.frame[pairs.other])

    def drop_related(self, pairs: NearbyPairs) -> NearbyPairs:
        """Return the pairs of which nothing stronger is stronger."""
        return select_rows(pairs, ~self._are_related(pairs.one, pairs.other))

    def _are_related(self, one: Indices, other: Indices) -> Mask:
        return np.isin(self._key(one, other), np.concatenate(self._keys))
