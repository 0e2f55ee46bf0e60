"""What has been told of things already, and decides what else is said of them."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.columns import taken
from usd2kg.relations.containment import Containment
from usd2kg.relations.model import Links
from usd2kg.relations.neighbours import Pairs
from usd2kg.relations.objects import Bodies
from usd2kg.relations.parts import Parts, bodies_of

__all__ = ["Told"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


class Told:
    """What is on, in or part of what: stronger than being close, so that nothing weaker is said of the two."""

    def __init__(self, bodies: Bodies, containment: Containment, parts: Parts) -> None:
        self._count = len(bodies)
        self.is_loose = np.ones(len(bodies), np.bool_)
        """Whether each may rest on something: what moves on a joint does not."""
        self.frame = containment.container.copy()
        """The whole that each is a part of, or else what it is inside of; -1 for neither."""
        self.supporter = np.full(len(bodies), -1)
        """What each is on; one of several; -1 for nothing."""
        self._part_keys = np.concatenate([self._keep_parts(*bodies_of(bodies, links)) for links in parts])
        self._keys = [self._part_keys, *(self._key(links.target, links.anchor) for links in containment.links)]
        moved, _ = bodies_of(bodies, parts.stated)
        self.is_loose[moved[moved >= 0]] = False

    def _keep_parts(self, part: Indices, whole: Indices) -> Indices:
        known = (part >= 0) & (whole >= 0)
        self.frame[part[known]] = whole[known]
        return self._key(part[known], whole[known])

    def carry(self, support: list[Links]) -> list[Links]:
        """Return what is on what without parts on their own wholes, and remember it."""
        kept = [links.where(~np.isin(self._key(links.target, links.anchor), self._part_keys)) for links in support]
        for links in reversed(kept):
            self.supporter[links.target] = links.anchor
            self._keys.append(self._key(links.target, links.anchor))
        return kept

    def _key(self, one: Indices, other: Indices) -> Indices:
        return np.asarray(np.minimum(one, other) * self._count + np.maximum(one, other))

    def without(self, links: Links) -> Links:
        """Return the links of things of which nothing stronger is told."""
        return links.where(~self._are_told(links.target, links.anchor))

    def together(self, pairs: Pairs) -> Pairs:
        """Return the pairs of things that are parts of the same whole or in the same container, or in none."""
        return taken(pairs, self.frame[pairs.one] == self.frame[pairs.other])

    def unrelated(self, pairs: Pairs) -> Pairs:
        """Return the pairs of which nothing stronger is told."""
        return taken(pairs, ~self._are_told(pairs.one, pairs.other))

    def _are_told(self, one: Indices, other: Indices) -> Mask:
        return np.isin(self._key(one, other), np.concatenate(self._keys))
