"""Routes from room to room through doors."""

import heapq
from collections import defaultdict
from functools import cached_property
from typing import NamedTuple

import numpy as np

from usd2kg.query.bodies import BodyIndex
from usd2kg.query.dataset import Dataset
from usd2kg.query.settings import PASSAGE

__all__ = ["RouteFinder", "Step"]

_CONNECTIONS = "SELECT DISTINCT ?door ?room WHERE { ?door u2k:connects ?room } ORDER BY ?door ?room"
_ROOMS = "SELECT DISTINCT ?thing ?room WHERE { ?thing u2k:inRoom ?room } ORDER BY ?thing ?room"


class Step(NamedTuple):
    """A door on a route."""

    number: int
    """From 1."""
    room: str
    """IRI of the room that it leads into."""
    length: float
    """Metres from the middle of the first door of the route to that of this one, straight from door to door."""


class RouteFinder:
    """The shortest routes of one graph; its connections are read at the first call."""

    def __init__(self, dataset: Dataset, bodies: BodyIndex) -> None:
        self._dataset = dataset
        self._bodies = bodies
        self._found: dict[tuple[str, str], dict[str, Step]] = {}

    def find(self, start: str, end: str) -> dict[str, Step]:
        """Return door → its step on the shortest route; empty if there is none, or both ends are in one room.

        Args:
            start: IRI of a room, or of an object, which is in a room.
            end: the same.
        """
        if (start, end) not in self._found:
            self._found[start, end] = self._search(self._room_of(start), self._room_of(end))
        return self._found[start, end]

    @cached_property
    def _rooms(self) -> dict[str, list[str]]:
        """Door → the two rooms that it connects. Windows, which are lower than doors, are left out."""
        found: dict[str, list[str]] = defaultdict(list)
        for row in self._dataset.select(_CONNECTIONS):
            body = self._bodies.find(row["door"].value)
            if body.lower is None or body.upper is None or body.upper[2] - body.lower[2] < PASSAGE.min_door_height:
                continue
            found[row["door"].value].append(row["room"].value)
        return {door: rooms for door, rooms in found.items() if len(rooms) > 1}

    @cached_property
    def _doors(self) -> dict[str, list[str]]:
        """Room → its doors."""
        found: dict[str, list[str]] = defaultdict(list)
        for door, rooms in self._rooms.items():
            for room in rooms:
                found[room].append(door)
        return found

    @cached_property
    def _in_room(self) -> dict[str, str]:
        return {row["thing"].value: row["room"].value for row in self._dataset.select(_ROOMS)}

    def _room_of(self, iri: str) -> str:
        return iri if iri in self._doors else self._in_room.get(iri, iri)

    def _search(self, start: str, end: str) -> dict[str, Step]:
        """Dijkstra's algorithm over pairs of a door and the room that it leads into."""
        if start == end:
            return {}
        waiting: list[tuple[float, tuple[str, ...], tuple[Step, ...], str]] = [(0.0, (), (), start)]
        seen: set[tuple[str, str]] = set()
        while waiting:
            length, doors, steps, room = heapq.heappop(waiting)
            if room == end:
                return dict(zip(doors, steps, strict=True))
            if doors and (doors[-1], room) in seen:
                continue
            seen.update((door, room) for door in doors[-1:])
            for door in self._doors.get(room, ()):
                far = length + (self._apart(doors[-1], door) if doors else 0.0)
                for other in self._rooms[door]:
                    if other != room and door not in doors:
                        step = Step(len(doors) + 1, other, far)
                        heapq.heappush(waiting, (far, (*doors, door), (*steps, step), other))
        return {}

    def _apart(self, one: str, other: str) -> float:
        """Return the distance of the middles of two doors in the floor plane, and the height between their feet."""
        first, second = (self._bodies.find(iri) for iri in (one, other))
        if first.lower is None or first.upper is None or second.lower is None or second.upper is None:
            return 0.0
        along = (first.lower + first.upper - second.lower - second.upper) / 2
        return float(np.hypot(np.hypot(along[0], along[1]), first.lower[2] - second.lower[2]))
