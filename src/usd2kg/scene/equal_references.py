"""Find prims whose contents are composed of the same specs, such as two references to one asset without overrides."""

from collections.abc import Sequence
from typing import Any

from pxr import Usd

from usd2kg.scene.outline import PrimRecord

__all__ = ["ContentKey", "EqualReferences", "content_key", "may_share_contents"]

ContentKey = tuple[tuple[str, str, float, float], ...]
"""(layer, path of the spec or empty, offset and scale of its times) of each spec of a prim."""


def may_share_contents(stage: Any) -> bool:
    """Return whether equal keys mean equal contents on a stage.

    They do not where a path decides what is composed below it: with a population mask, with payloads that are loaded
    selectively, and with relocates or expression variables in a layer.
    """
    is_whole = stage.GetPopulationMask() == Usd.StagePopulationMask.All()
    is_loaded = stage.GetLoadRules() == Usd.StageLoadRules.LoadAll()
    if not (is_whole and is_loaded):
        return False
    return not any(layer.HasRelocates() or layer.HasExpressionVariables() for layer in stage.GetUsedLayers())


def content_key(prim: Any) -> ContentKey | None:
    """Return what the prims below a prim are composed of; None if only the prim itself can tell.

    Each opinion about a prim below needs a spec whose parent is a spec of the prim. So two prims have equal contents if
    the same specs with children, in the same layers, at the same times, compose them. Specs without children hold
    opinions about the prim itself only, such as its place.
    """
    key = []
    for spec, offset in prim.GetPrimStackWithLayerOffsets():
        if spec.nameChildrenOrder:
            return None
        has_arcs = len(spec.variantSelections) or spec.hasInheritPaths or spec.hasSpecializes
        path = spec.path.pathString if has_arcs or len(spec.nameChildren) else ""
        key.append((spec.layer.identifier, path, offset.offset, offset.scale))
    return tuple(key)


class EqualReferences:
    """The references and payloads of a stage that came first in the traversal, by what they contain."""

    def __init__(self, stage: Any, labelled_prims: Sequence[Any], special_reasons: frozenset[str]) -> None:
        """Create it without references.

        Args:
            stage: the stage.
            labelled_prims: the prims with semantic labels so far, in traversal order; it grows.
            special_reasons: reasons of pruned prims that are reported with their paths.
        """
        self._may_share = may_share_contents(stage)
        self._labelled_prims = labelled_prims
        self._special_reasons = special_reasons
        self._first: dict[ContentKey, PrimRecord] = {}
        self._labels_before: dict[int, int] = {}
        """id of a first reference → number of labelled prims before those below it."""
        self._copyable: dict[int, bool] = {}
        """id of a first reference → see `_is_copyable`."""
        self._with_clips: dict[int, bool] = {}

    def find(self, root: PrimRecord) -> PrimRecord | None:
        """Return the first reference with the same contents as a prim, if its records may be copied; else None."""
        if not self._may_share or root.is_gprim or root.is_unresolved or not root.is_asset:
            return None
        if root.prim.IsInstanceProxy() or self._has_clips(root):
            return None
        key = content_key(root.prim)
        if key is None:
            return None
        first = self._first.setdefault(key, root)
        if first is root:
            self._labels_before[id(root)] = len(self._labelled_prims)
            return None
        return first if first.is_hidden == root.is_hidden and self._is_copyable(first) else None

    def _has_clips(self, record: PrimRecord) -> bool:
        """Return whether value clips at or above a prim may hold values of the prims below it."""
        if record.parent is None:
            return False
        if id(record) not in self._with_clips:
            is_clipped = record.prim.HasAuthoredMetadata("clips")
            self._with_clips[id(record)] = is_clipped or self._has_clips(record.parent)
        return self._with_clips[id(record)]

    def _is_copyable(self, first: PrimRecord) -> bool:
        """Return whether nothing below a reference is read or reported by its path, such as joints and labels."""
        if id(first) not in self._copyable:
            is_special = self._holds_special(first) or self._holds_labels(first)
            below = (record for record in first.walk() if record is not first)
            self._copyable[id(first)] = not is_special and all(map(self._is_plain, below))
        return self._copyable[id(first)]

    def _holds_labels(self, first: PrimRecord) -> bool:
        """Return whether a prim below a first reference is labelled, be it pruned or not."""
        # The traversal goes deep first: if there are any, the first one after the reference is among them.
        following = self._labels_before[id(first)]
        labelled = self._labelled_prims[following : following + 1]
        return any(prim.GetPath().HasPrefix(first.prim.GetPath()) for prim in labelled)

    def _is_plain(self, record: PrimRecord) -> bool:
        """Return whether a prim has the same values wherever its contents are referenced.

        Classes that it inherits may have other opinions in the layers that refer to it.
        """
        is_special = record.is_instance or record.is_instancer or record.is_unresolved or self._holds_special(record)
        return not is_special and not record.prim.HasAuthoredInherits() and not record.prim.HasAuthoredSpecializes()

    def _holds_special(self, record: PrimRecord) -> bool:
        return any(reason in self._special_reasons for _, reason in record.left_out or ())
