"""A grounder's view of one object: the permitted evidence, with the name masked by the naming regime.

A regime masks the name of one target at a time; siblings and parents keep theirs. Grounding is leave-one-out: nothing
learned from one view may be used for another, because the siblings of all targets together reveal every name.
"""

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import overload

from usd2kg.grounding.context.neighbours import Neighbourhood, neighbourhoods
from usd2kg.grounding.context.placement import Appearance, BoxGrid, Placement
from usd2kg.grounding.context.settings import LABELS
from usd2kg.scene.model import Scene, SceneObject, Vector
from usd2kg.scene.robots import ROBOT
from usd2kg.words import split_identifier

__all__ = [
    "ABBREVIATED_LENGTH",
    "EVIDENCE_GROUPS",
    "STUDY_GROUPS",
    "NamingRegime",
    "ObjectView",
    "abbreviate",
    "view_objects",
]

STUDY_GROUPS = frozenset({"name", "geometry", "position", "hierarchy"})
"""The groups of evidence that the study uses."""
EVIDENCE_GROUPS = STUDY_GROUPS | {"asset", "labels", "materials", "neighbours", "parts"}
"""All groups of evidence."""
_MASKED_GROUPS = STUDY_GROUPS | {"neighbours"}
"""The groups that masked regimes show: assets, labels, parts and materials would reveal the name."""
_CLASS_TAXONOMIES = frozenset({"class", "concept", "iri", "semantics", "wikidata_class"})
"""Taxonomies of semantic labels whose values name classes or concepts."""
ABBREVIATED_LENGTH = 4
"""Letters kept of each word in the abbreviated regime. Chosen for this project; the study does not publish its own."""


class NamingRegime(StrEnum):
    """How a grounder sees the target's own name."""

    SEMANTIC = "semantic"
    """The authored name."""
    ABBREVIATED = "abbreviated"
    """Vowels removed, each word cut short."""
    OPAQUE = "opaque"
    """A running number: `obj_042`."""
    OPAQUE_ANONYMOUS = "opaque-anonymous"
    """A running number for the target, its siblings and its parents alike."""


class _Siblings(Sequence[str]):
    """The names of the objects under one prim except one; the list is stored once for all of them."""

    def __init__(self, names: Sequence[str], left_out: int) -> None:
        self._names = names
        self._left_out = left_out

    def __len__(self) -> int:
        return len(self._names) - 1

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> list[str]: ...
    def __getitem__(self, index: int | slice) -> str | list[str]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        if index < 0:
            index += len(self)
        if not 0 <= index < len(self):
            raise IndexError(index)
        return self._names[index + (index >= self._left_out)]

    def __iter__(self) -> Iterator[str]:
        return (name for i, name in enumerate(self._names) if i != self._left_out)


@dataclass(frozen=True)
class ObjectView:
    """The evidence about one target. Fields that are empty or None are unknown or may not be used."""

    name: str = ""
    """The prim's name, as the regime shows it."""
    parents: tuple[str, ...] = ()
    """Names of the prims above, outermost first."""
    groups: tuple[str, ...] = ()
    """The last of `parents`: prims between the target and the nearest object above, which only group."""
    siblings: Sequence[str] = ()
    """Names of the other objects under the same prim, in traversal order."""
    size: Vector | None = None
    """Extents of the world-aligned box in metres."""
    oriented_size: Vector | None = None
    """Extents in metres along the object's own axes, where they are rotated against the world's."""
    mass_kg: float | None = None
    position: Vector | None = None
    """World position in metres."""
    placement: Placement | None = None
    """Where it is among the other objects."""
    display_name: str = ""
    documentation: str = ""
    asset: tuple[str, ...] = ()
    labels: tuple[str, ...] = ()
    """Words of its semantic labels on the stage."""
    materials: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()
    neighbourhood: Neighbourhood | None = None
    """The neighbours with their names; None if the regime hides them."""
    is_masked: bool = field(default=False)
    """Whether the regime replaced the name."""

    @property
    def own_size(self) -> Vector | None:
        """The extents along the object's own axes, which rotation does not change; None if unknown."""
        return self.oriented_size or self.size

    @property
    def appearance(self) -> Appearance | None:
        """Its size and stance; None if its size is unknown."""
        if self.own_size is None or self.size is None:
            return None
        is_nested = len(self.groups) < len(self.parents)
        if self.placement is None:
            return Appearance(self.own_size, self.size[2], None, is_nested)
        height = self.size[2] if self.placement.is_laid_out else None
        return Appearance(self.own_size, height, self.placement.elevation, is_nested)


def abbreviate(name: str, length: int = ABBREVIATED_LENGTH) -> str:
    """Return a name with the vowels removed and each word cut to `length` letters, in lower case.

    A word of vowels only keeps its first letter; numbers stay.

    >>> abbreviate("CupCBlue_1")
    'cpcbl1'
    """
    short = []
    for word in split_identifier(name):
        lower = word.lower()
        if lower.isdecimal():
            short.append("".join(str(int(digit)) for digit in lower).lstrip("0") or "0")
        else:
            short.append("".join(c for c in lower if c not in "aeiou")[:length] or lower[0])
    return "".join(short) or name.lower()


def view_objects(
    scene: Scene,
    regime: NamingRegime = NamingRegime.SEMANTIC,
    groups: frozenset[str] | None = None,
    length: int = ABBREVIATED_LENGTH,
) -> Iterator[tuple[SceneObject, ObjectView]]:
    """Yield each object with the view that a grounder has of it.

    Args:
        scene: the scene.
        regime: how the target's name is masked. Masked regimes show the study's groups and the neighbours: assets,
            labels, parts and materials would reveal the name.
        groups: groups of evidence to show; default all that the regime allows.
        length: letters kept of each word in the abbreviated regime.
    """
    allowed = EVIDENCE_GROUPS if regime is NamingRegime.SEMANTIC else _MASKED_GROUPS
    shown = allowed if groups is None else allowed & groups
    masked = _masked_names(scene, regime, length)
    families = _families(scene)
    has_names = "neighbours" in shown and regime is not NamingRegime.OPAQUE_ANONYMOUS
    plan = BoxGrid(scene)
    others = neighbourhoods(scene) if has_names else [None] * len(scene.objects)
    for index, obj in enumerate(scene.objects):
        parents, siblings = _relatives(obj, families, regime)
        grouping = parents[obj.parent_path.count("/") if obj.parent_path else 0 :]
        view = ObjectView(
            name=masked[index] if "name" in shown else "",
            is_masked=regime is not NamingRegime.SEMANTIC,
            neighbourhood=others[index],
            placement=Placement(plan, index, is_anonymous=not has_names) if "position" in shown else None,
        )
        yield obj, _with_evidence(view, obj, shown, parents, grouping, siblings)


def _with_evidence(
    view: ObjectView,
    obj: SceneObject,
    shown: frozenset[str],
    parents: tuple[str, ...],
    grouping: tuple[str, ...],
    siblings: Sequence[str],
) -> ObjectView:
    has_name = "name" in shown and not view.is_masked
    return ObjectView(
        name=view.name,
        is_masked=view.is_masked,
        neighbourhood=view.neighbourhood,
        placement=view.placement,
        parents=parents if "hierarchy" in shown else (),
        groups=grouping if "hierarchy" in shown else (),
        siblings=siblings if "hierarchy" in shown else (),
        size=obj.box.size if obj.box and "geometry" in shown else None,
        oriented_size=obj.oriented_size if "geometry" in shown else None,
        mass_kg=obj.mass_kg if "geometry" in shown else None,
        position=obj.position if "position" in shown else None,
        display_name=obj.display_name if has_name else "",
        documentation=obj.documentation if has_name else "",
        asset=obj.asset if "asset" in shown else (),
        labels=_label_words(obj) if "labels" in shown else (),
        materials=obj.materials if "materials" in shown else (),
        parts=obj.parts if "parts" in shown else (),
    )


def _label_words(obj: SceneObject) -> tuple[str, ...]:
    """Return the class labels of the whole object as names: `drawer` for WordNet's `drawer.n.wn.artifact`.

    A prediction that was written as a label is evidence only if it was as certain as labels are. What is articulated
    like a robot is labelled as one, whatever animal it is named after.
    """
    values = [
        label.iri or label.value
        for label in obj.labels.own or obj.labels.of_whole
        if label.strength == "label"
        and (label.confidence is None or label.confidence >= LABELS.min_confidence)
        and (label.encoding == "Multiverse" or label.taxonomy in _CLASS_TAXONOMIES)
    ]
    local = (re.split(r"[#/]", value.rstrip("#/"))[-1] for value in values)
    stated = tuple(dict.fromkeys(re.split(r"\.[nvasr]\.", name)[0] for name in local))
    return stated if stated or obj.selected_by != ROBOT else ("robot",)


def _masked_names(scene: Scene, regime: NamingRegime, length: int) -> list[str]:
    names = [obj.name for obj in scene.objects]
    if regime is NamingRegime.SEMANTIC:
        return names
    if regime is NamingRegime.ABBREVIATED:
        return _collision_free(names, [abbreviate(name, length) for name in names])
    return [f"obj_{index:03d}" for index in range(1, len(names) + 1)]


def _collision_free(names: list[str], short: list[str]) -> list[str]:
    """Return the short names, numbered if different authored names share one."""
    by_name: dict[str, str] = {}
    owned: set[str] = set()
    counts: Counter[str] = Counter()
    for name, abbreviation in zip(names, short, strict=True):
        if name in by_name:
            continue
        candidate = abbreviation
        while candidate in owned:
            counts[abbreviation] += 1
            candidate = f"{abbreviation}x{counts[abbreviation] + 1}"
        owned.add(candidate)
        by_name[name] = candidate
    return [by_name[name] for name in names]


@dataclass(frozen=True)
class _Families:
    """Siblings by parent prim."""

    names: dict[str, list[str]]
    """Path of the parent → names of its objects."""
    anonymous: dict[str, list[str]]
    """The same with running numbers instead of names."""
    places: dict[str, tuple[str, int]]
    """Path of an object → path of its parent, and its index among its siblings."""


def _families(scene: Scene) -> _Families:
    names: dict[str, list[str]] = {}
    places: dict[str, tuple[str, int]] = {}
    for obj in scene.objects:
        above = obj.prim_path.rpartition("/")[0]
        family = names.setdefault(above, [])
        places[obj.prim_path] = (above, len(family))
        family.append(obj.name)
    anonymous = {above: [f"sibling_{i}" for i in range(1, len(family) + 1)] for above, family in names.items()}
    return _Families(names, anonymous, places)


def _relatives(obj: SceneObject, families: _Families, regime: NamingRegime) -> tuple[tuple[str, ...], Sequence[str]]:
    above, place = families.places[obj.prim_path]
    parents = tuple(name for name in above.split("/") if name)
    siblings: Sequence[str] = _Siblings(families.names[above], place)
    if regime is NamingRegime.OPAQUE_ANONYMOUS:
        parents = tuple(f"group_{depth}" for depth in range(1, len(parents) + 1))
        siblings = _Siblings(families.anonymous[above], place)
    return parents, siblings
