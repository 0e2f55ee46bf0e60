"""The company an object keeps: the other named objects of its stage, those like it and those beside it."""

import math
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

from usd2kg.scene.model import Scene, SceneObject, Vector
from usd2kg.words import words_of

__all__ = ["Companion", "Company", "Nearness", "companies", "size_distance"]

_NEXT = 2
_MOST_SIBLINGS = 48
_MOST_TWINS = 16
_MOST_ALIKE = 24
_THINNEST = 0.002
"""Metres: sheets and decals differ in thickness by nothing that matters."""
_TWIN = 0.01


Ways = Callable[[str], Iterable[tuple[str, float]]]
"""Gives (form, score) of the ways in which a word may be written."""


class Nearness(StrEnum):
    """How near another object is, in the stage's tree or in size."""

    NEXT = "next"
    """One of the two before or the two after it under the same prim."""
    SIBLING = "sibling"
    """Under the same prim."""
    TWIN = "twin"
    """Of the same size, elsewhere."""
    ALIKE = "alike"
    """Of about the same size, elsewhere."""


@dataclass(frozen=True, slots=True)
class Companion:
    """Another object, as a target sees it."""

    name: str
    parents: tuple[str, ...]
    """Names of the prims above, outermost first."""
    nearness: Nearness
    distance: float | None
    """How much the sizes differ, see `size_distance`; None where one of them is unknown."""
    size: Vector | None = None
    """Its own extent in metres, along its own axes where those are turned."""


def size_distance(one: Vector, other: Vector) -> float:
    """Return the root mean square of the three differences of log extent, the extents sorted: 0 for twins.

    0.1 is about a tenth longer all round. Extents below 2 mm count as 2 mm.
    """
    pairs = zip(_log_sizes(one), _log_sizes(other), strict=True)
    return math.sqrt(sum((a - b) ** 2 for a, b in pairs) / 3)


def _log_sizes(size: Vector) -> list[float]:
    return [math.log(max(extent, _THINNEST)) for extent in sorted(size)]


class _Stage:
    """What is known of all objects; made once a scene, asked for one target at a time."""

    def __init__(self, scene: Scene) -> None:
        self.objects = scene.objects
        self.families: dict[str, list[int]] = {}
        self.places: list[int] = []
        self._written: dict[Ways, Mapping[str, list[tuple[str, float]]]] = {}
        for index, obj in enumerate(scene.objects):
            family = self.families.setdefault(_above(obj), [])
            self.places.append(len(family))
            family.append(index)

    @cached_property
    def words(self) -> Counter[str]:
        """Word → number of objects with it in their names."""
        return Counter(word for obj in self.objects for word in dict.fromkeys(words_of(obj.name)))

    def written(self, ways: "Ways") -> Mapping[str, list[tuple[str, float]]]:
        """Return form → (word, score) of the words that may be written so."""
        if ways not in self._written:
            index: dict[str, list[tuple[str, float]]] = {}
            for word in self.words:
                for form, score in ways(word):
                    index.setdefault(form, []).append((word, score))
            self._written[ways] = index
        return self._written[ways]

    @cached_property
    def by_volume(self) -> list[tuple[float, int]]:
        """(sum of the log extents, index) in order."""
        sizes = ((index, _size(obj)) for index, obj in enumerate(self.objects))
        return sorted((sum(_log_sizes(size)), index) for index, size in sizes if size is not None)


class Company:
    """The company of one target, which never tells the target's own name."""

    def __init__(self, stage: _Stage, index: int) -> None:
        self._stage = stage
        self._index = index

    def words_written(self, form: str, ways: Ways) -> list[tuple[str, float, float]]:
        """Return (word, share, score) of the words in other objects' names that may be written as `form`.

        Args:
            form: letters in lower case.
            ways: gives (form, score) of all the ways in which a word may be written.

        The share is that of the objects that bear the word; shares add up to about the words in a name.
        """
        found = []
        for word, score in self._stage.written(ways).get(form, ()):
            count = self._stage.words[word] - (word in self._own_words)
            if count > 0:
                found.append((word, count / len(self._stage.objects), score))
        return found

    @cached_property
    def _own_words(self) -> frozenset[str]:
        return frozenset(words_of(self._stage.objects[self._index].name))

    def companions(self) -> list[Companion]:
        """Return the objects beside the target and those like it, each once, at the nearest it is."""
        found: dict[int, Nearness] = {}
        for index, nearness in (*self._beside(), *self._like()):
            found.setdefault(index, nearness)
        # What lies below the target has the target's name among its parents.
        below = self._stage.objects[self._index].prim_path + "/"
        return [
            self._companion(index, nearness)
            for index, nearness in found.items()
            if not self._stage.objects[index].prim_path.startswith(below)
        ]

    def _beside(self) -> Iterator[tuple[int, Nearness]]:
        stage = self._stage
        family, place = stage.families[_above(stage.objects[self._index])], stage.places[self._index]
        start, end = max(0, place - _MOST_SIBLINGS // 2), place + _MOST_SIBLINGS // 2
        for at in range(start, min(end, len(family))):
            if at != place:
                yield family[at], Nearness.NEXT if abs(at - place) <= _NEXT else Nearness.SIBLING

    def _like(self) -> Iterator[tuple[int, Nearness]]:
        size = _size(self._stage.objects[self._index])
        if size is None:
            return
        ordered = self._stage.by_volume
        at = bisect_left(ordered, (sum(_log_sizes(size)), -1))
        near = [ordered[i][1] for i in range(max(0, at - _MOST_ALIKE), min(len(ordered), at + _MOST_ALIKE))]
        others = [index for index in near if index != self._index]
        distances = {index: size_distance(size, other) for index in others if (other := self._size_of(index))}
        nearest = sorted(distances, key=lambda index: (distances[index], index))
        twins = [index for index in nearest if distances[index] < _TWIN][:_MOST_TWINS]
        yield from ((index, Nearness.TWIN) for index in twins)
        yield from ((index, Nearness.ALIKE) for index in nearest[:_MOST_ALIKE] if index not in twins)

    def _size_of(self, index: int) -> Vector | None:
        return _size(self._stage.objects[index])

    def _companion(self, index: int, nearness: Nearness) -> Companion:
        obj, own, other = self._stage.objects[index], self._size_of(self._index), self._size_of(index)
        distance = size_distance(own, other) if own and other else None
        return Companion(obj.name, tuple(name for name in _above(obj).split("/") if name), nearness, distance, other)


def companies(scene: Scene) -> list[Company]:
    """Return the company of each object, in scene order."""
    stage = _Stage(scene)
    return [Company(stage, index) for index in range(len(scene.objects))]


def _above(obj: SceneObject) -> str:
    return obj.prim_path.rpartition("/")[0]


def _size(obj: SceneObject) -> Vector | None:
    return obj.oriented_size or (obj.box.size if obj.box else None)
