"""Which kind of part each object may be, by its class, its concept and the last noun of its name."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.part_nouns import NounConcepts

__all__ = ["PartRoles", "find_roles"]

Mask = NDArray[np.bool_]


class PartRoles(NamedTuple):
    """Masks over the objects with a box."""

    front: Mask
    """Doors and drawers."""
    drawer: Mask
    handle: Mask
    """Handles, knobs, pulls and latches."""
    front_fitting: Mask
    """Other small things fitted to doors and drawers."""
    shelf: Mask
    """Shelves, racks and rails."""
    lid: Mask
    caster: Mask
    fitting: Mask
    """Parts of what they touch."""
    lamp_part: Mask
    component: Mask
    """Other components by their class."""
    body: Mask
    """Furniture, appliances, cupboards and frames, to which fronts are fitted."""
    fastener: Mask
    """Fasteners, cords and pipes, which are between things rather than parts of one."""
    skeleton: Mask
    """What carries the other parts of a thing."""
    lamp: Mask
    host: Mask
    """What may have fitted parts at all: no rooms, walls, floors and handles."""

    @property
    def part(self) -> Mask:
        """What may be fitted to something."""
        return np.asarray(np.any([self.front, self.handle, self.component, self.named], axis=0))

    @property
    def named(self) -> Mask:
        """What its name alone makes a part."""
        kinds = [self.front_fitting, self.shelf, self.lid, self.caster, self.fitting, self.lamp_part]
        return np.asarray(np.any(kinds, axis=0))


def find_roles(boxed: BoxedObjects, classes: ClassMembership, nouns: Sequence[NounConcepts]) -> PartRoles:
    """Return the roles of the objects with a box.

    Args:
        boxed: the objects with a box.
        classes: the classes of all objects.
        nouns: for each object of the scene, what the nouns of its name mean.
    """
    known = _Roles(boxed, classes, nouns)
    is_tool = known.by_class("tools")
    is_drawer = classes.are_drawers[boxed.scene_index]
    is_loose = (classes.can_contain[boxed.scene_index] & ~is_drawer) | is_tool
    is_front_noun = known.by_noun("front_concepts")
    # The class of `drawer_bar` may be that of drawers.
    is_other_noun = (known.by_noun("handle_concepts") | known.by_noun("front_fittings")) & ~is_front_noun
    is_other_noun |= known.are_only_modified("front_concepts")
    is_case = known.by_class("cases") & ~is_drawer
    # A cupboard may be named after its drawers: `Pedestal_3Drawer`.
    is_named_drawer = known.by_noun("not_laid") & ~is_tool
    is_front_noun &= ~(is_named_drawer & known.by_class("bodies"))
    is_drawer = (is_drawer & ~is_other_noun) | (is_named_drawer & is_front_noun)
    is_front = (known.by_class("fronts") & ~is_other_noun) | (is_front_noun & ~is_tool & ~known.by_class("frames"))
    is_front = (is_front & ~is_case) | is_drawer
    is_handle = known.by_class("handles") | (known.by_either("handle_concepts") & ~is_loose)
    is_handle &= ~is_tool & ~is_front
    is_body = known.by_class("bodies") | known.by_class("frames") | is_case
    is_lamp_part = known.by_either("lamp_parts")
    never = known.by_class("not_wholes") | known.by_class("not_neighbours")
    return PartRoles(
        front=is_front,
        drawer=is_drawer,
        handle=is_handle,
        front_fitting=known.by_either("front_fittings") & ~is_loose & ~is_front & ~is_handle,
        shelf=known.by_either("shelves") & ~is_tool & ~is_front & ~is_handle,
        lid=known.by_either("lids") & ~is_front & ~is_handle,
        caster=known.by_either("casters"),
        fitting=known.by_either("fittings"),
        lamp_part=is_lamp_part,
        component=known.by_class("components") & ~(is_front | is_handle | is_body),
        body=is_body & ~is_front & ~is_handle,
        fastener=known.by_either("fasteners"),
        skeleton=known.are_skeletons(),
        lamp=known.by_class("lamps") & ~is_lamp_part & ~known.are_only_modified("lamps"),
        host=~never & ~is_handle,
    )


class _Roles:
    """Membership of the objects with a box in lists of classes and concepts, by different evidence."""

    def __init__(self, boxed: BoxedObjects, classes: ClassMembership, nouns: Sequence[NounConcepts]) -> None:
        self._chosen = boxed.scene_index
        self._classes = classes
        self._known = list(dict.fromkeys(nouns))
        number = {concepts: index for index, concepts in enumerate(self._known)}
        self._which = np.array([number[concepts] for concepts in nouns], np.int64)[self._chosen]

    def by_class(self, name: str) -> Mask:
        """Whether the class or the concept is in a list."""
        return np.asarray(self._classes.are_in(name)[self._chosen])

    def by_noun(self, name: str) -> Mask:
        """Whether the last noun of the name usually means a concept of a list."""
        listed = self._classes.items_of(name)
        return self._of_each([not listed.isdisjoint(known.usual) for known in self._known])

    def by_either(self, name: str) -> Mask:
        """Whether the class, the concept or the last noun is in a list."""
        return self.by_class(name) | self.by_noun(name)

    def are_skeletons(self) -> Mask:
        """Whether the last noun of the name means what carries the other parts of a thing."""
        return self._of_each([known.is_skeleton for known in self._known])

    def are_only_modified(self, name: str) -> Mask:
        """Whether a word before the last noun means a concept of a list, and the last noun cannot: `drawer_fork`."""
        listed = self._classes.items_of(name)
        is_modifier = [
            bool(known.possible) and listed.isdisjoint(known.possible) and not listed.isdisjoint(known.before)
            for known in self._known
        ]
        return self._of_each(is_modifier) & ~self.by_class(name) & ~self.by_noun(name)

    def _of_each(self, of_known: list[bool]) -> Mask:
        return np.asarray(np.array(of_known, np.bool_)[self._which])
