"""Find the spatial relations of a scene, kind by kind."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from usd2kg.garbage import paused_collection
from usd2kg.grounding import Grounding
from usd2kg.ontology import TBox, expand_curie
from usd2kg.relations.above_below import find_above, reverse_links
from usd2kg.relations.adjacency import (
    NearbyPairs,
    find_near,
    find_nearby_pairs,
    find_next_to,
    find_touching,
    measure_surface_distances,
)
from usd2kg.relations.array_records import select_rows
from usd2kg.relations.attachment import Attached, find_attached
from usd2kg.relations.between import find_between
from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.connections import (
    find_connections,
    locate_in_boxes,
    locate_in_plans,
    openings_in_walls,
)
from usd2kg.relations.containment import find_inside
from usd2kg.relations.derived_room import DerivedRoom
from usd2kg.relations.doubtful_support import (
    find_doubtful,
    find_held_at_mounts,
    find_held_beside_support,
    find_stuck,
    without_unheld,
)
from usd2kg.relations.floor_plan import draw_floor_plans
from usd2kg.relations.hung_inside import find_hung_inside
from usd2kg.relations.leads import Leads, find_leads
from usd2kg.relations.model import ALL_KINDS, ROOM_KINDS, SYMMETRIC_KINDS, VIEWPOINT_KINDS, Links, Relation
from usd2kg.relations.object_kinds import ObjectKind, find_kinds
from usd2kg.relations.openings import find_openings
from usd2kg.relations.options import RelationOptions
from usd2kg.relations.part_nouns import find_noun_concepts
from usd2kg.relations.part_of import PartLinks, find_parts, wholes_of
from usd2kg.relations.plan_membership import find_plan_members
from usd2kg.relations.room_membership import find_rooms, placed_in_rooms
from usd2kg.relations.sides import find_sides
from usd2kg.relations.stronger import StrongerRelations
from usd2kg.relations.support import Support, find_support
from usd2kg.relations.weak_support import are_unbalanced, find_hovering, find_propped
from usd2kg.scene import Scene
from usd2kg.tracing import traced

__all__ = ["find_relations"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


@traced("relate", lambda relations: {"relations": len(relations)})
def find_relations(
    scene: Scene, tbox: TBox, grounding: Grounding, options: RelationOptions | None = None
) -> tuple[Relation, ...]:
    """Return the relations of all objects that have a box, sorted by target in scene order, then kind and anchor.

    The box of an object excludes the objects nested below it. Symmetric relations are listed once.
    """
    options = options or RelationOptions()
    kinds = options.chosen_kinds
    finder = _Finder(scene, tbox, grounding, options)
    with paused_collection():
        links = [found for found in finder.find(kinds) if found.kind in kinds]
        paths = [*(obj.prim_path for obj in scene.objects), *finder.groups]
        return _sorted_relations(paths, links, {room.name: room for room in finder.derived})


class _Finder:
    """Finds relations kind by kind: `part-of`, `inside` and `on` first, since they suppress weaker kinds."""

    def __init__(self, scene: Scene, tbox: TBox, grounding: Grounding, options: RelationOptions) -> None:
        self.scene = scene
        self.rules = options.chosen_rules
        self.viewpoint = options.viewpoint
        self.classes = ClassMembership(self.rules.classes, self._kinds(tbox, grounding))
        self.nouns = find_noun_concepts(scene, grounding, self.rules.part_of)
        self.boxed = BoxedObjects(scene.objects, self.rules.geometry, scene.surfaces)
        self.groups: list[str] = []
        """Paths of the group prims that are rooms, or names of the derived rooms."""
        self.derived: list[DerivedRoom] = []

    def _kinds(self, tbox: TBox, grounding: Grounding) -> list[ObjectKind]:
        """Return the kind of each object; nothing is known of what is too narrow for the building or room of its class.

        A bank of cages is no bank.
        """
        found = find_kinds(self.scene, tbox, grounding)
        spaces = frozenset(map(expand_curie, self.rules.classes.spaces))
        for index, obj in enumerate(self.scene.objects):
            is_narrow = obj.own_box is not None and min(obj.own_box.size[:2]) < self.rules.room.min_side
            if is_narrow and not spaces.isdisjoint(found[index].above):
                found[index] = ObjectKind()
        return found

    def find(self, kinds: frozenset[str]) -> Iterator[Links]:
        """Yield the links of the kinds, and possibly of others; indices count all objects, then the groups."""
        parts = find_parts(self.scene, self.boxed, self.classes, self.nouns, self.rules.part_of)
        yield from parts
        if len(self.boxed) and kinds - {"part-of"}:
            for links in self._of_boxed(kinds, parts):
                yield self._to_scene_indices(links)

    def _of_boxed(self, kinds: frozenset[str], parts: PartLinks) -> Iterator[Links]:
        wholes = wholes_of(self.boxed, parts)
        containment = find_inside(self.boxed, self.classes, wholes, self.rules)
        yield from containment.links
        stronger = StrongerRelations(self.boxed, containment, parts)
        loose, container = stronger.is_loose, containment.container
        support = find_support(self.boxed, self.classes, loose, container, wholes, self.rules)
        firm = without_unheld(self.boxed, self.classes, stronger.frame, support.links, self.rules.attached)
        resting = stronger.add_support([*firm, *stronger.raise_to_wholes(firm)])
        leads, at_end = self._leads(stronger, resting)
        # What would tip over and touches a wall hangs there.
        tipping = resting[0].target[are_unbalanced(self.boxed, resting[0])]
        is_at_wall = find_held_at_mounts(self.boxed, self.classes, np.unique(tipping), self.rules.attached)
        is_stuck = find_stuck(self.boxed, self.classes, resting[0], self.rules.attached)
        resting = stronger.withdraw_support(resting, is_at_wall | is_stuck | at_end)
        yield stronger.add_attached(leads.links)
        stronger.add_ties(leads.lead, leads.thing)
        # What is near a wall hangs there rather than hovering over what is below; the rest may hang from what hovers.
        is_doubtful = find_doubtful(self.boxed, self.classes, stronger, resting, self.rules.attached)
        doubtful = [links.where(is_doubtful[links.target]) for links in resting]
        stronger.withdraw_support(resting, is_doubtful)
        is_left = stronger.is_free & ~is_doubtful
        hovering = find_hovering(self.boxed, support.near, is_left, containment.container, self.rules)
        attached = find_attached(
            self.boxed,
            self.classes,
            stronger,
            self.rules.attached,
            needs_mount=True,
            doubtful=doubtful,
            hovering=hovering,
        )
        stronger.add_attached(attached.links)
        stronger.add_support([links.where(~stronger.is_attached[links.target]) for links in doubtful])
        resting = [links.where(~(is_doubtful & stronger.is_attached)[links.target]) for links in resting]
        beside = find_held_beside_support(self.boxed, self.classes, resting[0], attached.links, self.rules.attached)
        inside, is_hung = self._hung_inside(stronger, support)
        resting = stronger.withdraw_support(resting, is_hung)
        yield stronger.add_attached(inside)
        yield from stronger.replace_support(resting, beside)
        yield beside
        yield from self._propped(attached, support)
        may_hover = stronger.may_hover & ~support.at_floor
        # A hook does not rest on the cup that hangs from it.
        over_others = select_rows(support.near, stronger.holder[support.near.anchor] != support.near.target)
        over = find_hovering(self.boxed, over_others, may_hover, containment.container, self.rules)
        yield from stronger.add_support([over])
        fixed = find_attached(self.boxed, self.classes, stronger, self.rules.attached, needs_mount=False)
        stronger.add_attached(fixed.links)
        yield from self._propped(fixed, support)
        if kinds & ROOM_KINDS:
            yield from self._rooms(wholes)
        takes_part = ~self.classes.are_in("not_neighbours")[self.boxed.scene_index]
        if kinds & {"above", "below"}:
            above = find_above(self.boxed, takes_part, stronger.frame, stronger.supporter, self.rules.above)
            above = stronger.drop_implied(above)
            yield above
            yield reverse_links("below", above)
        yield from self._adjacent(kinds, takes_part, stronger)

    def _leads(self, stronger: StrongerRelations, resting: list[Links]) -> tuple[Leads, Mask]:
        """Return the cables with what they end in, and which objects only seem to rest on one at whose end they are."""
        is_whole = stronger.frame == stronger.container
        leads = find_leads(self.boxed, self.classes, is_whole, stronger.holder, self.rules.attached)
        at_end = np.zeros(len(self.boxed), np.bool_)
        for links in resting:
            at_end[links.target[leads.tie(links, len(self.boxed))]] = True
        return leads, at_end

    def _hung_inside(self, stronger: StrongerRelations, support: Support) -> tuple[Links, Mask]:
        """Return the `attached-to` links of what hangs in a container, and which objects hang so."""
        surfaces = self.classes.are_in("not_contained") | self.classes.are_in("mounts")
        is_fitted = surfaces[self.boxed.scene_index]
        inside = find_hung_inside(self.boxed, stronger, support.at_floor, is_fitted, self.rules.attached)
        is_hung = np.zeros(len(self.boxed), np.bool_)
        is_hung[inside.target] = True
        return inside, is_hung

    def _propped(self, attached: Attached, support: Support) -> Iterator[Links]:
        """Yield `attached-to` links, but `on` links where the anchor is below the feet of the target as well."""
        mount = self.classes.are_in("mounts")[self.boxed.scene_index]
        propped = find_propped(self.boxed, support.near, attached.links.where(~attached.at_fixture), self.rules)
        # Nothing hangs from what is below it.
        lowest = self.boxed.lower[attached.links.target, 2] + self.rules.attached.max_touch
        is_below = (self.boxed.upper[attached.links.anchor, 2] <= lowest) & ~mount[attached.links.anchor]
        yield attached.links.where(~np.isin(attached.links.target, propped.target) & ~is_below)
        yield propped

    def _rooms(self, wholes: Indices) -> Iterator[Links]:
        found = find_rooms(self.scene.objects, self.boxed, self.classes, self.rules.room)
        openings = find_openings(self.boxed, self.classes, self.rules.room_plan)
        # Not the doors of furniture.
        is_frame = self.classes.are_in("frames")[self.boxed.scene_index]
        fixed = openings[(wholes[openings] < 0) | is_frame[wholes[openings]]]
        if len(found.boxes.number):
            self.groups = found.groups
            yield found.links
            walls = np.flatnonzero(self.classes.are_in("room_walls")[self.boxed.scene_index])
            fixed = openings_in_walls(self.boxed, fixed, walls, self.rules.connects)
            locate = locate_in_boxes(*found.boxes)
        else:
            words = frozenset(self.rules.room.words)
            plans, self.derived = draw_floor_plans(self.boxed, self.classes, openings, self.rules.room_plan, words)
            self.groups = [room.name for room in self.derived]
            placed = np.setdiff1d(placed_in_rooms(self.boxed, self.classes), openings)
            yield from find_plan_members(self.boxed, plans, self.derived, placed, self.rules.room_plan)
            locate = locate_in_plans(plans, len(self.boxed))
        if len(fixed):
            yield find_connections(self.boxed, fixed, locate, self.rules.connects)

    def _adjacent(self, kinds: frozenset[str], takes_part: Mask, stronger: StrongerRelations) -> Iterator[Links]:
        sides = kinds & frozenset(VIEWPOINT_KINDS)
        if kinds & SYMMETRIC_KINDS or sides:
            walls = self.classes.are_in("walls")[self.boxed.scene_index]
            around = stronger.in_same_frame(find_nearby_pairs(self.boxed, takes_part | walls, self.rules))
            pairs = stronger.drop_related(select_rows(around, takes_part[around.one] & takes_part[around.other]))
            pairs = measure_surface_distances(self.boxed, pairs, self.rules)
            yield from self._symmetric(kinds, pairs, around)
            if sides and self.viewpoint is not None:
                yield from find_sides(self.boxed, pairs, self.viewpoint, self.rules.side)
        if "between" in kinds:
            yield find_between(self.boxed, takes_part, stronger, self.rules.between)

    def _symmetric(self, kinds: frozenset[str], pairs: NearbyPairs, around: NearbyPairs) -> Iterator[Links]:
        is_implied = np.zeros(len(pairs.one), np.bool_)
        if "touching" in kinds:
            links, found = find_touching(self.boxed, pairs, self.rules)
            is_implied |= found
            yield links
        if "next-to" in kinds:
            links, found = find_next_to(self.boxed, pairs, around, self.rules)
            is_implied |= found
            yield links
        if "near" in kinds:
            yield find_near(self.boxed, select_rows(pairs, ~is_implied), around, self.rules)

    def _to_scene_indices(self, links: Links) -> Links:
        """Return links with indices among all objects of the scene instead of those with a box."""
        number = np.concatenate([self.boxed.scene_index, len(self.scene.objects) + np.arange(len(self.groups))])
        other = None if links.other is None else number[links.other]
        return links._replace(target=number[links.target], anchor=number[links.anchor], other=other)


def _sorted_relations(
    paths: Sequence[str], links: list[Links], derived: Mapping[str, DerivedRoom]
) -> tuple[Relation, ...]:
    """Return the links as relations, sorted by target, kind and anchor."""
    if not links:
        return ()
    relations = [relation for found in links for relation in _relations(paths, found, derived)]
    rank = {kind: place for place, kind in enumerate(ALL_KINDS)}
    kinds = np.concatenate([np.full(len(found.target), rank[found.kind]) for found in links])
    target = np.concatenate([found.target for found in links])
    anchor = np.concatenate([found.anchor for found in links])
    return tuple([relations[index] for index in np.lexsort((anchor, kinds, target)).tolist()])


def _relations(paths: Sequence[str], links: Links, derived: Mapping[str, DerivedRoom]) -> Iterator[Relation]:
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
    # Only these kinds have anchors without a prim.
    rooms = derived if links.kind in ROOM_KINDS else {}
    rows = zip(links.target.tolist(), links.anchor.tolist(), numbers, confidence, others, strict=True)
    for target, anchor, known, clear, other in rows:
        to = paths[anchor]
        yield Relation(links.kind, paths[target], to, links.rule, known, clear, other, rooms.get(to))
