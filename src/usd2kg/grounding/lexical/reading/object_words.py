"""ObjectWords: what an object's own words and size say, equal for copies of one model."""

from typing import NamedTuple

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.concepts.extent import Extent, extent_of
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader

__all__ = ["ObjectWords", "object_words"]


class ObjectWords(NamedTuple):
    """The texts and the size of an object without the numbers that tell copies apart."""

    name: str
    parents: tuple[str, ...]
    """Names of the prims above, outermost first."""
    groups: tuple[str, ...]
    """The last of `parents`: prims between the object and the nearest object above."""
    display_name: str
    documentation: str
    asset: tuple[str, ...]
    labels: tuple[str, ...]
    parts: tuple[str, ...]
    extent: Extent | None
    """None if the size is unknown."""

    def labels_alone(self) -> "ObjectWords":
        """Return the labels without the other words."""
        return ObjectWords("", self.parents, (), "", "", (), self.labels, (), self.extent)


def object_words(view: ObjectView, reader: NameReader) -> ObjectWords:
    """Return the words of an object, with the numbers that matter to a reader of names."""
    name, parents = reader.equalize(view.name, view.parents)
    outer = len(parents) - len(view.groups)
    groups = parents[outer:] if view.parents[outer:] == view.groups else view.groups
    return ObjectWords(
        name,
        parents,
        groups,
        view.display_name,
        view.documentation,
        view.asset,
        view.labels,
        view.parts,
        extent_of(view.own_size),
    )
