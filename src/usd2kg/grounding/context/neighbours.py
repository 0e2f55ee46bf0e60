"""Neighbours of an object: named objects beside it in the stage's tree, and objects of its size elsewhere."""

import math
from bisect import bisect_left
from collections.abc import Callable, Sequence
from enum import StrEnum
from functools import cached_property
from typing import Any, NamedTuple, TypeVar

from usd2kg.grounding.context.settings import NEIGHBOURS
from usd2kg.grounding.context.stage_words import FormWords, Gather, Rate, StageWords, WriteForms
from usd2kg.scene.model import Scene, SceneObject, Vector

__all__ = ["SAME_SIZE", "AskVote", "Nearness", "Neighbour", "Neighbourhood", "neighbourhoods", "size_distance"]

SAME_SIZE = NEIGHBOURS.same_size
"""`size_distance` below which two sizes are equal."""

R = TypeVar("R", bound=tuple[Any, ...])
G = TypeVar("G")
V = TypeVar("V")
AskVote = Callable[[str, tuple[str, ...], Vector | None], V | None]
"""Returns the vote of an object by its name, the names above it and its extents; None for no vote."""


class Nearness(StrEnum):
    """How a neighbour is related to an object."""

    NEXT = "next"
    """One of the two siblings before it or after it."""
    SIBLING = "sibling"
    """Another object under the same prim."""
    SAME_SIZE = "same-size"
    """Of equal size, elsewhere."""
    SIMILAR_SIZE = "similar-size"
    """Of similar size, elsewhere."""


class Neighbour(NamedTuple):
    """Another object of the stage."""

    name: str
    parents: tuple[str, ...]
    """Names of the prims above, outermost first."""
    nearness: Nearness
    distance: float | None
    """Difference of size, see `size_distance`; None if a size is unknown."""
    size: Vector | None = None
    """Extents in metres, along the neighbour's own axes if those are rotated."""


def size_distance(one: Vector, other: Vector) -> float:
    """Return the root mean square difference of the log extents, each sorted; 0 for equal sizes, no unit.

    0.1 is about 10 % in every direction. Extents below 2 mm count as 2 mm.
    """
    return _distance(_log_extents(one), _log_extents(other))


def _log_extents(size: Vector) -> Vector:
    """Return the logarithms of the extents, shortest first."""
    least = NEIGHBOURS.min_extent
    short, middle, long = sorted(size)
    return math.log(max(short, least)), math.log(max(middle, least)), math.log(max(long, least))


def _distance(one: Vector, other: Vector) -> float:
    (a, b, c), (x, y, z) = one, other
    return math.sqrt(((a - x) ** 2 + (b - y) ** 2 + (c - z) ** 2) / 3)


class _StageIndex:
    """Objects of a stage by parent and by size, shared by all its neighbourhoods."""

    def __init__(self, scene: Scene) -> None:
        self.objects = scene.objects
        self.words = StageWords(scene)
        self.siblings: dict[str, list[int]] = {}
        """Path of a parent prim → its objects."""
        self.places: list[int] = []
        """Object → its index among its siblings."""
        self.log_extents = [None if size is None else _log_extents(size) for size in map(_size_of, scene.objects)]
        self._votes: dict[AskVote[Any], _Votes[Any]] = {}
        self._of_names: dict[Callable[[Sequence[str]], Any], Any] = {}
        for index, obj in enumerate(scene.objects):
            siblings = self.siblings.setdefault(_parent_path(obj), [])
            self.places.append(len(siblings))
            siblings.append(index)

    @cached_property
    def by_volume(self) -> tuple[list[float], list[int]]:
        """The log volumes in ascending order, and the objects that have them."""
        ordered = sorted((sum(logs), index) for index, logs in enumerate(self.log_extents) if logs is not None)
        return [volume for volume, _ in ordered], [index for _, index in ordered]

    @cached_property
    def ancestors(self) -> frozenset[str]:
        """Paths of prims with objects below them."""
        found: set[str] = set()
        for path in self.siblings:
            above = path
            while above not in found:
                found.add(above)
                above = above.rpartition("/")[0]
        return frozenset(found)

    def of_names(self, find: Callable[[Sequence[str]], G]) -> G:
        """Return the results of `find` for the names of all objects, computed once for each `find`."""
        if find not in self._of_names:
            self._of_names[find] = find([obj.name for obj in self.objects])
        found: G = self._of_names[find]
        return found

    def votes(self, vote: AskVote[V]) -> "_Votes[V]":
        """Return object → its vote."""
        if vote not in self._votes:
            self._votes[vote] = _Votes(vote, self.objects)
        return self._votes[vote]


class _Votes(dict[int, V | None]):
    """Object → its vote, asked on first use."""

    def __init__(self, vote: AskVote[V], objects: Sequence[SceneObject]) -> None:
        super().__init__()
        self._vote, self._objects = vote, objects

    def __missing__(self, index: int) -> V | None:
        obj = self._objects[index]
        own = self[index] = self._vote(obj.name, _parents(obj), _size_of(obj))
        return own


class Neighbourhood:
    """The neighbours of one object.

    It never reveals the object's own name, so masked regimes stay leave-one-out.
    """

    def __init__(self, stage: _StageIndex, index: int) -> None:
        self._stage = stage
        self._index = index

    def words_by_form(
        self, write_forms: WriteForms, rate: Rate[R], gather: Gather[R, G], most: int
    ) -> Callable[[str], G | None]:
        """Return a function from an abbreviated form to the result of `gather` on the stage's words with that form.

        The function returns None for a form that no word of another object has.

        Args:
            write_forms: yields (form, score) for each form of a word, each form once.
            rate: rates a word by its share of objects and the score of its form, as a tuple; the smallest is the best,
                and a smaller share never rates better.
            gather: makes the result from a form and the ratings of its words, best first. Called once a stage for each
                form, except for forms of the object's own words.
            most: number of words kept for each form.
        """
        words: FormWords[R, G] = self._stage.words.by_form(write_forms, rate, gather, most)
        return words.without_object(self._stage.objects[self._index].name)

    def of_stage(self, find: Callable[[Sequence[str]], G]) -> G:
        """Return the results of `find` for the names of all objects of the stage, computed once per stage.

        The object's own name is among them: not for masked regimes.
        """
        return self._stage.of_names(find)

    def votes(self, vote: AskVote[V]) -> list[tuple[V, Nearness, float | None, int]]:
        """Return (vote, nearness, size distance, index in the scene) of each neighbour that votes.

        `vote` is called once for each object of the stage.
        """
        votes = self._stage.votes(vote)
        found = self._find_voters(votes).items()
        return [(own, *near, other) for other, near in found if (own := votes[other]) is not None]

    def neighbour(self, other: int, nearness: Nearness, distance: float | None) -> Neighbour:
        """Return an object of the scene as a neighbour."""
        obj = self._stage.objects[other]
        return Neighbour(obj.name, _parents(obj), nearness, distance, _size_of(obj))

    def _find_voters(self, votes: "_Votes[V]") -> dict[int, tuple[Nearness, float | None]]:
        """Return neighbour that votes → nearness and size distance, siblings first."""
        found = self._find_siblings(votes)
        for other, near in self._find_similar(votes):
            found.setdefault(other, near)
        path = self._stage.objects[self._index].prim_path
        if path not in self._stage.ancestors:
            return found
        # Descendants have the object's name among their parents.
        objects, below = self._stage.objects, path + "/"
        return {other: near for other, near in found.items() if not objects[other].prim_path.startswith(below)}

    def _find_siblings(self, votes: "_Votes[V]") -> dict[int, tuple[Nearness, float | None]]:
        stage, own = self._stage, self._index
        size = stage.log_extents[own]
        siblings, place = stage.siblings[_parent_path(stage.objects[own])], stage.places[own]
        reach = NEIGHBOURS.max_siblings // 2
        start = max(0, place - reach)
        found: dict[int, tuple[Nearness, float | None]] = {}
        for at, other in enumerate(siblings[start : place + reach], start):
            if other == own or votes[other] is None:
                continue
            other_size = stage.log_extents[other]
            distance = None if size is None or other_size is None else _distance(size, other_size)
            is_next = abs(at - place) <= NEIGHBOURS.next_places
            found[other] = Nearness.NEXT if is_next else Nearness.SIBLING, distance
        return found

    def _find_similar(self, votes: "_Votes[V]") -> list[tuple[int, tuple[Nearness, float | None]]]:
        own = self._index
        size = self._stage.log_extents[own]
        if size is None:
            return []
        logs, (volumes, order) = self._stage.log_extents, self._stage.by_volume
        at, reach = bisect_left(volumes, sum(size)), NEIGHBOURS.max_similar_size
        near = order[max(0, at - reach) : at + reach]
        if not any(index != own and votes[index] is not None for index in near):
            return []
        nearest = [(_distance(size, other), index) for index in near if (other := logs[index]) and index != own]
        nearest.sort()
        equal = sum([distance < SAME_SIZE for distance, _ in nearest[: NEIGHBOURS.max_same_size]])
        return [
            (index, (Nearness.SAME_SIZE if rank < equal else Nearness.SIMILAR_SIZE, distance))
            for rank, (distance, index) in enumerate(nearest[: max(equal, reach)])
            if votes[index] is not None
        ]


def neighbourhoods(scene: Scene) -> list[Neighbourhood]:
    """Return the neighbourhood of each object, in scene order."""
    stage = _StageIndex(scene)
    return [Neighbourhood(stage, index) for index in range(len(scene.objects))]


def _parent_path(obj: SceneObject) -> str:
    return obj.prim_path.rpartition("/")[0]


def _parents(obj: SceneObject) -> tuple[str, ...]:
    """Return the names of the prims above an object, outermost first."""
    return tuple(filter(None, _parent_path(obj).split("/")))


def _size_of(obj: SceneObject) -> Vector | None:
    return obj.oriented_size or (obj.box.size if obj.box else None)
