"""AnchorMap: compare relations before and after, even if the path of the anchor has changed."""

from collections import Counter
from collections.abc import Iterable, Sequence

from usd2kg.diff.match import ObjectMatch
from usd2kg.diff.object_state import Link, ObjectState
from usd2kg.diff.paths import ancestor_paths, differing_prefixes

__all__ = ["AnchorMap"]


class AnchorMap:
    """Old → new anchor path: for objects by their match, for room groups by the objects below them."""

    def __init__(
        self, matches: Sequence[ObjectMatch], removed: Iterable[ObjectState], added: Iterable[ObjectState]
    ) -> None:
        self._objects = {match.old.prim_path: match.new.prim_path for match in matches}
        self._matched_new = set(self._objects.values())
        old = [*(match.old for match in matches), *removed]
        new = [*(match.new for match in matches), *added]
        self._removed = {state.prim_path for state in old} - self._objects.keys()
        self._added = {state.prim_path for state in new} - self._matched_new
        self._groups = _match_groups(_group_anchors(old), _group_anchors(new), matches)

    def gained_and_lost(self, match: ObjectMatch, kinds: frozenset[str]) -> tuple[tuple[Link, ...], tuple[Link, ...]]:
        """Return the relations of the new object alone, and those of the old object alone."""
        old, new = ({link for link in state.links if link.kind in kinds} for state in (match.old, match.new))
        if not (old or new):
            return (), ()
        before = {(link.kind, self._old_key(link.anchor)): link for link in old}
        after = {(link.kind, self._new_key(link.anchor)): link for link in new}
        gained = sorted(link for key, link in after.items() if key not in before)
        lost = sorted(link for key, link in before.items() if key not in after)
        return tuple(gained), tuple(lost)

    def carriers(self, match: ObjectMatch, kinds: Iterable[str]) -> list[str]:
        """Return the new paths of the objects that may carry this one: unchanged anchors, then unchanged ancestors.

        Args:
            match: the object.
            kinds: the kinds of relations in which an anchor carries the object.
        """
        new = {link.anchor for link in match.new.links if link.kind in kinds}
        kept = {self._objects.get(link.anchor) for link in match.old.links if link.kind in kinds} & new
        new_ancestors = set(ancestor_paths(match.new.prim_path))
        ancestors = (self._objects.get(path) for path in ancestor_paths(match.old.prim_path))
        kept_ancestors = (path for path in ancestors if path in new_ancestors)
        return [path for path in (*sorted(filter(None, kept)), *kept_ancestors) if path is not None]

    def _old_key(self, anchor: str) -> tuple[str, str]:
        """Return the type of an old anchor and its new path; equal to the `_new_key` of the same anchor."""
        if anchor in self._objects:
            return "object", self._objects[anchor]
        return ("removed", anchor) if anchor in self._removed else ("group", self._groups.get(anchor, anchor))

    def _new_key(self, anchor: str) -> tuple[str, str]:
        if anchor in self._matched_new:
            return "object", anchor
        return "added" if anchor in self._added else "group", anchor


def _group_anchors(states: Sequence[ObjectState]) -> set[str]:
    """Return the anchors that are not objects: room groups."""
    return {link.anchor for state in states for link in state.links} - {state.prim_path for state in states}


def _match_groups(old: set[str], new: set[str], matches: Iterable[ObjectMatch]) -> dict[str, str]:
    """Return old → new path of the groups that disappeared, by the renamed objects below them; most objects first."""
    removed, added = old - new, new - old
    if not (removed and added):
        return {}
    votes = Counter(differing_prefixes(m.old.prim_path, m.new.prim_path) for m in matches if m.by != "path")
    candidates = []
    for (before, after), count in votes.items():
        for path in removed:
            target = after + path.removeprefix(before)
            if (path == before or path.startswith(before + "/")) and target in added:
                candidates.append((-count, sorted((path, target)), path, target))
    found: dict[str, str] = {}
    for _, _, path, target in sorted(candidates):
        if path not in found and target not in found.values():
            found[path] = target
    return found
