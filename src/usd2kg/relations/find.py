"""find_relations: all kinds of relations of a scene, in order."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from usd2kg.garbage import paused_collection
from usd2kg.grounding import Grounding
from usd2kg.ontology import TBox
from usd2kg.relations.between import find_between
from usd2kg.relations.columns import taken
from usd2kg.relations.containment import find_containment
from usd2kg.relations.implied import Told
from usd2kg.relations.model import ALL_KINDS, SYMMETRIC_KINDS, VIEWPOINT_KINDS, Links, Relation
from usd2kg.relations.neighbours import Pairs, find_near, find_neighbours, find_next_to, find_touching
from usd2kg.relations.objects import Bodies, Classes
from usd2kg.relations.options import RelationOptions
from usd2kg.relations.parts import Parts, find_parts, wholes_of
from usd2kg.relations.rooms import find_rooms
from usd2kg.relations.sides import find_sides
from usd2kg.relations.support import find_support
from usd2kg.relations.vertical import find_above, reversed_links
from usd2kg.scene import Scene

__all__ = ["find_relations"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


def find_relations(
    scene: Scene, tbox: TBox, grounding: Grounding, options: RelationOptions | None = None
) -> tuple[Relation, ...]:
    """Return the relations of all objects that have a box, by target in scene order, and kind by kind.

    Boxes are each object's own, without the objects nested below it. Symmetric relations are there once.

    Args:
        scene: the objects.
        tbox: the classes they were grounded to.
        grounding: the class of each object.
        options: which kinds are found, by which rules and from which viewpoint.
    """
    options = options or RelationOptions()
    kinds = options.chosen_kinds
    finder = _Finder(scene, tbox, grounding, options)
    with paused_collection():
        links = [found for found in finder.find(kinds) if found.kind in kinds]
        return _assembled([*(obj.prim_path for obj in scene.objects), *finder.groups], links)


class _Finder:
    """Finds kind after kind; what stands in what and on what is known first, since the others go by it."""

    def __init__(self, scene: Scene, tbox: TBox, grounding: Grounding, options: RelationOptions) -> None:
        self.scene = scene
        self.rules = options.chosen_rules
        self.viewpoint = options.viewpoint
        self.classes = Classes(self.rules.classes, tbox, grounding, scene.objects)
        self.bodies = Bodies(scene.objects)
        self.groups: list[str] = []
        """Paths of group prims that are rooms."""

    def find(self, kinds: frozenset[str]) -> Iterator[Links]:
        """Yield the links of some kinds, and maybe of others; they count all objects of the scene, then the groups."""
        parts = find_parts(self.scene, self.bodies, self.classes, self.rules.part_of)
        yield from parts
        if len(self.bodies) and kinds - {"part-of"}:
            for links in self._of_bodies(kinds, parts):
                yield self._renumbered(links)

    def _of_bodies(self, kinds: frozenset[str], parts: Parts) -> Iterator[Links]:
        wholes = wholes_of(self.bodies, parts)
        containment = find_containment(self.bodies, self.classes, wholes, self.rules)
        yield from containment.links
        told = Told(self.bodies, containment, parts)
        support = told.carry(find_support(self.bodies, self.classes, told.is_loose, containment.container, self.rules))
        yield from support
        if "room" in kinds:
            found = find_rooms(self.scene.objects, self.bodies, self.classes, self.rules.room)
            self.groups = found.groups
            yield found.links
        takes_part = ~self.classes.are_in("not_neighbours")[self.bodies.number]
        if kinds & {"above", "below"}:
            above = find_above(self.bodies, takes_part, told.frame, told.supporter, self.rules.above)
            above = told.without(above)
            yield above
            yield reversed_links("below", above)
        yield from self._of_neighbours(kinds, takes_part, told)

    def _of_neighbours(self, kinds: frozenset[str], takes_part: Mask, told: Told) -> Iterator[Links]:
        sides = kinds & frozenset(VIEWPOINT_KINDS)
        if kinds & SYMMETRIC_KINDS or sides:
            walls = self.classes.are_in("walls")[self.bodies.number]
            around = told.together(find_neighbours(self.bodies, takes_part | walls, self.rules))
            pairs = told.unrelated(taken(around, takes_part[around.one] & takes_part[around.other]))
            yield from self._of_pairs(kinds, pairs, around)
            if sides and self.viewpoint is not None:
                yield from find_sides(self.bodies, pairs, self.viewpoint, self.rules.side)
        if "between" in kinds:
            yield find_between(self.bodies, takes_part, told, self.rules.between)

    def _of_pairs(self, kinds: frozenset[str], pairs: Pairs, around: Pairs) -> Iterator[Links]:
        is_told = np.zeros(len(pairs.one), np.bool_)
        if "touching" in kinds:
            links, found = find_touching(self.bodies, pairs, self.rules)
            is_told |= found
            yield links
        if "next-to" in kinds:
            links, found = find_next_to(self.bodies, pairs, around, self.rules.next_to)
            is_told |= found
            yield links
        if "near" in kinds:
            yield find_near(self.bodies, taken(pairs, ~is_told), around, self.rules.near)

    def _renumbered(self, links: Links) -> Links:
        """Return links that count all objects of the scene instead of those with a box."""
        number = np.concatenate([self.bodies.number, len(self.scene.objects) + np.arange(len(self.groups))])
        other = None if links.other is None else number[links.other]
        return links._replace(target=number[links.target], anchor=number[links.anchor], other=other)


def _assembled(paths: Sequence[str], links: list[Links]) -> tuple[Relation, ...]:
    """Return the links as relations, sorted by target, kind and anchor."""
    if not links:
        return ()
    relations = [relation for found in links for relation in _relations(paths, found)]
    rank = {kind: place for place, kind in enumerate(ALL_KINDS)}
    kinds = np.concatenate([np.full(len(found.target), rank[found.kind]) for found in links])
    target = np.concatenate([found.target for found in links])
    anchor = np.concatenate([found.anchor for found in links])
    return tuple([relations[index] for index in np.lexsort((anchor, kinds, target)).tolist()])


def _relations(paths: Sequence[str], links: Links) -> Iterator[Relation]:
    names = list(links.numbers)
    columns = [links.numbers[name].tolist() for name in names]
    count = len(links.target)
    numbers = (
        (dict(zip(names, row, strict=True)) for row in zip(*columns, strict=True))
        if names
        else ({} for _ in range(count))
    )
    confidence = [None] * count if links.confidence is None else links.confidence.tolist()
    others = [None] * count if links.other is None else [paths[index] for index in links.other.tolist()]
    rows = zip(links.target.tolist(), links.anchor.tolist(), numbers, confidence, others, strict=True)
    for target, anchor, known, clear, other in rows:
        yield Relation(links.kind, paths[target], paths[anchor], links.rule, known, clear, other)
