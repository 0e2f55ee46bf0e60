"""ReviewState: the verdict on each object, who may undo what, and where reviewers disagree."""

from collections.abc import Iterable, Mapping
from dataclasses import replace

from usd2kg.errors import GroundingError
from usd2kg.grounding import Decision
from usd2kg.studio.verdicts import OPEN, Action, Event, Suggestion, Verdict, VerdictChange, VerdictKind

__all__ = ["ReviewState"]


class ReviewState:
    """The verdicts that a sequence of events leads to.

    Undo and redo are events of their own: the sequence only grows, so that undo is unlimited and survives a restart.
    One thread applies events; others may read at the same time, so iteration is over copies.
    """

    def __init__(self, events: Iterable[Event] = ()) -> None:
        self._verdicts: dict[str, Verdict] = {}
        self._events: dict[int, Event] = {}
        self._numbers_of: dict[str, list[int]] = {}
        """Prim path → numbers of the events that concern it."""
        self._before: dict[int, Mapping[str, Verdict]] = {}
        self._done: dict[str, list[int]] = {}
        """Reviewer → numbers of the decisions that can be undone, the last one at the end."""
        self._undone: dict[str, list[int]] = {}
        """Reviewer → numbers of the decisions that can be made again, the next one at the end."""
        self._by_reviewer: dict[str, dict[str, Verdict]] = {}
        """Prim path → reviewer → last verdict of that reviewer."""
        self._is_settled: set[str] = set()
        for event in events:
            self.apply(event)

    @property
    def version(self) -> int:
        """Number of the last event; 0 without events."""
        return max(self._events, default=0)

    def verdict(self, prim_path: str) -> Verdict:
        """Return the current verdict on an object."""
        return self._verdicts.get(prim_path, OPEN)

    def history(self, prim_path: str) -> list[tuple[Event, Verdict]]:
        """Return the events that concern an object, oldest first, each with the verdict that it set."""
        events = [self._events[number] for number in list(self._numbers_of.get(prim_path, ()))]
        return [(event, c.verdict) for event in events for c in event.changes if c.prim_path == prim_path]

    def decisions(self) -> dict[str, Decision]:
        """Return prim path → decision, for the objects whose class is settled."""
        return {
            path: Decision(verdict.class_iri, verdict.reviewer, verdict.comment, verdict.time)
            for path, verdict in list(self._verdicts.items())
            if verdict.kind in {VerdictKind.CLASS, VerdictKind.NO_CLASS}
        }

    def standing(self) -> list[Event]:
        """Return the decisions that are not undone, oldest first."""
        return [self._events[number] for number in sorted(n for done in list(self._done.values()) for n in list(done))]

    def is_conflict(self, prim_path: str) -> bool:
        """Return whether reviewers disagree about an object, and nobody has decided after seeing both verdicts."""
        given = [v for v in list(self._by_reviewer.get(prim_path, {}).values()) if v.kind is not VerdictKind.OPEN]
        return prim_path not in self._is_settled and any(not given[0].agrees(other) for other in given[1:])

    def by_reviewer(self) -> Mapping[str, Mapping[str, Verdict]]:
        """Return prim path → reviewer → last verdict."""
        return {path: dict(given) for path, given in list(self._by_reviewer.items())}

    # Making events.

    def decide(
        self,
        verdicts: Mapping[str, Verdict],
        reviewer: str,
        time: str,
        seen: int,
        *,
        suggested: Mapping[str, Suggestion | None] | None = None,
        concept: str = "",
        is_audit: bool = False,
    ) -> Event:
        """Return the event that sets the verdicts on several objects; `apply` makes it current.

        Args:
            verdicts: prim path → kind, class and comment.
            reviewer: who decides.
            time: when, as ISO 8601 in UTC.
            seen: number of the last event that the reviewer had seen.
            suggested: prim path → what was suggested.
            concept: IRI of the concept, if the decision is about all its objects.
            is_audit: whether the objects were drawn at random.
        """
        number = self.version + 1
        signed = {
            verdict: replace(verdict, event=number)
            if verdict.kind is VerdictKind.OPEN
            else replace(verdict, reviewer=reviewer, time=time, event=number)
            for verdict in set(verdicts.values())
        }
        known = suggested or {}
        changes = tuple(VerdictChange(path, signed[verdict], known.get(path)) for path, verdict in verdicts.items())
        before = min(seen, number - 1)
        return Event(number, Action.DECIDE, reviewer, time, changes, before, concept=concept, is_audit=is_audit)

    def can_undo(self, reviewer: str) -> bool:
        """Return whether a reviewer has a decision to undo."""
        return bool(self._done.get(reviewer))

    def can_redo(self, reviewer: str) -> bool:
        """Return whether a reviewer has undone a decision since the last one."""
        return bool(self._undone.get(reviewer))

    def undo(self, reviewer: str, time: str) -> Event:
        """Return the event that takes back a reviewer's last decision.

        Objects about which somebody else has decided since keep that verdict.

        Raises:
            GroundingError: there is nothing to undo.
        """
        if not self.can_undo(reviewer):
            raise GroundingError(f"{reviewer or 'this reviewer'} has no decision to undo")
        number = self._done[reviewer][-1]
        return self._revert(Action.UNDO, number, self._before[number], reviewer, time)

    def redo(self, reviewer: str, time: str) -> Event:
        """Return the event that makes a reviewer's last undone decision again.

        Raises:
            GroundingError: there is nothing to redo.
        """
        if not self.can_redo(reviewer):
            raise GroundingError(f"{reviewer or 'this reviewer'} has no decision to make again")
        number = self._undone[reviewer][-1]
        after = {change.prim_path: change.verdict for change in self._events[number].changes}
        return self._revert(Action.REDO, number, after, reviewer, time)

    def _revert(
        self, action: Action, reverted: int, verdicts: Mapping[str, Verdict], reviewer: str, time: str
    ) -> Event:
        number = self.version + 1
        changes = []
        for path, verdict in verdicts.items():
            current = self.verdict(path)
            is_own = current.reviewer in {"", reviewer}
            changes.append(VerdictChange(path, replace(verdict, event=number) if is_own else current))
        return Event(number, action, reviewer, time, tuple(changes), number - 1, reverted)

    # Applying events.

    def before(self, event: Event) -> dict[str, Verdict]:
        """Return prim path → verdict that is current before an event is applied."""
        return {change.prim_path: self.verdict(change.prim_path) for change in event.changes}

    def apply(self, event: Event) -> None:
        """Make the verdicts of an event current."""
        self._before[event.number] = self.before(event)
        self._events[event.number] = event
        for change in event.changes:
            self._numbers_of.setdefault(change.prim_path, []).append(event.number)
            self._apply_change(event, change)
        done, undone = (stacks.setdefault(event.reviewer, []) for stacks in (self._done, self._undone))
        if event.action is Action.DECIDE:
            done.append(event.number)
            undone.clear()
        elif event.action is Action.UNDO and done:
            undone.append(done.pop())
        elif event.action is Action.REDO and undone:
            done.append(undone.pop())

    def _apply_change(self, event: Event, change: VerdictChange) -> None:
        path, verdict = change.prim_path, change.verdict
        given = self._by_reviewer.setdefault(path, {})
        others = [other for who, other in given.items() if who != event.reviewer]
        if others and all(other.event <= event.seen for other in others):
            self._is_settled.add(path)
        else:
            self._is_settled.discard(path)
        self._verdicts[path] = verdict
        given[event.reviewer] = verdict if verdict.reviewer == event.reviewer else OPEN
