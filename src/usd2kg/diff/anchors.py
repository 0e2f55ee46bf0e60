"""Relations before and after: the same one, where its anchor has another path now."""

from collections import Counter
from collections.abc import Iterable, Sequence

from usd2kg.diff.match import ObjectMatch
from usd2kg.diff.object_state import Link, ObjectState
from usd2kg.diff.paths import above, differing_prefixes

__all__ = ["AnchorMap"]


class AnchorMap:
    """Which path an anchor of a relation has now: a thing by its match, a room that is a mere group by its things."""

    def __init__(
        self, matches: Sequence[ObjectMatch], removed: Iterable[ObjectState], added: Iterable[ObjectState]
    ) -> None:
        self._things = {match.old.prim_path: match.new.prim_path for match in matches}
        old = [*(match.old for match in matches), *removed]
        new = [*(match.new for match in matches), *added]
        self._gone = {thing.prim_path for thing in old} - self._things.keys()
        self._came = {thing.prim_path for thing in new} - set(self._things.values())
        self._groups = _match_groups(_groups_of(old), _groups_of(new), matches)

    def gained_and_lost(self, match: ObjectMatch, kinds: frozenset[str]) -> tuple[tuple[Link, ...], tuple[Link, ...]]:
        """Return the relations that a thing has only now, and those that it had only before."""
        old, new = ({link for link in thing.links if link.kind in kinds} for thing in (match.old, match.new))
        if not (old or new):
            return (), ()
        now = {(link.kind, self._now(link.anchor)): link for link in old}
        then = {(link.kind, (link.anchor, link.anchor in self._came)): link for link in new}
        gained = sorted(link for key, link in then.items() if key not in now)
        lost = sorted(link for key, link in now.items() if key not in then)
        return tuple(gained), tuple(lost)

    def carriers(self, match: ObjectMatch, kinds: Iterable[str]) -> list[str]:
        """Return the new paths of the things that it is on, in or below both before and after."""
        new = {link.anchor for link in match.new.links if link.kind in kinds}
        kept = {self._things.get(link.anchor) for link in match.old.links if link.kind in kinds} & new
        new_parents = set(above(match.new.prim_path))
        parents = (self._things.get(path) for path in above(match.old.prim_path))
        nested = (path for path in parents if path in new_parents)
        return [*sorted(path for path in kept if path is not None), *(path for path in nested if path is not None)]

    def _now(self, anchor: str) -> tuple[str, bool]:
        """Return the new path; what is gone keeps its own, apart from another thing that may have that one now."""
        if anchor in self._things:
            return self._things[anchor], False
        return (anchor, anchor not in self._came) if anchor in self._gone else (self._groups.get(anchor, anchor), False)


def _groups_of(things: Sequence[ObjectState]) -> set[str]:
    paths = {thing.prim_path for thing in things}
    return {link.anchor for thing in things for link in thing.links} - paths


def _match_groups(old: set[str], new: set[str], matches: Iterable[ObjectMatch]) -> dict[str, str]:
    """Return old path → new path of the groups that are gone, where things below them lead to one that came."""
    gone, came = old - new, new - old
    if not (gone and came):
        return {}
    votes = Counter(differing_prefixes(m.old.prim_path, m.new.prim_path) for m in matches if m.by != "path")
    likely = []
    for (before, after), count in votes.items():
        for path in gone:
            led_to = after + path.removeprefix(before)
            if (path == before or path.startswith(before + "/")) and led_to in came:
                likely.append((-count, sorted((path, led_to)), path, led_to))
    found: dict[str, str] = {}
    for _, _, path, led_to in sorted(likely):
        if path not in found and led_to not in found.values():
            found[path] = led_to
    return found
