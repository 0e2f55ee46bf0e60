"""The company an object keeps: the other named objects of its stage, those like it and those beside it."""

import math
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Iterable
from enum import StrEnum
from functools import cached_property
from heapq import nsmallest
from typing import Any, Generic, NamedTuple, TypeVar

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
_MOST_RANKED = 14
"""So many words are kept for a form, where no more are asked for."""


R = TypeVar("R", bound=tuple[Any, ...])
G = TypeVar("G")
J = TypeVar("J")
Ways = Callable[[str], Iterable[tuple[str, float]]]
"""Gives (form, score) of the ways in which a word may be written."""
Rate = Callable[[str, float, float], R]
"""Gives from a word, the share of the objects that bear it and the score of its form what it is worth, least first."""
Gather = Callable[[str, list[R]], G]
"""Makes something of a form and what the words are worth that it may be, the best first."""
Judge = Callable[[str, tuple[str, ...], Vector | None], J | None]
"""Gives from a name, the names above it and a size what the thing is; None if they do not say."""


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


class Companion(NamedTuple):
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
    return _distance(_log_sizes(one), _log_sizes(other))


def _log_sizes(size: Vector) -> Vector:
    short, middle, long = sorted(size)
    return math.log(max(short, _THINNEST)), math.log(max(middle, _THINNEST)), math.log(max(long, _THINNEST))


def _distance(one: Vector, other: Vector) -> float:
    (a, b, c), (x, y, z) = one, other
    return math.sqrt(((a - x) ** 2 + (b - y) ** 2 + (c - z) ** 2) / 3)


class _Stage:
    """What is known of all objects; made once a scene, asked for one target at a time."""

    def __init__(self, scene: Scene) -> None:
        self.objects = scene.objects
        self.families: dict[str, list[int]] = {}
        self.places: list[int] = []
        self.logs = [None if size is None else _log_sizes(size) for size in map(_size, scene.objects)]
        """The logarithms of the extents, the least first."""
        self._written: dict[tuple[Ways, Rate[Any], Gather[Any, Any], int], _Written[Any, Any]] = {}
        self._judgements: dict[Judge[Any], dict[int, Any]] = {}
        for index, obj in enumerate(scene.objects):
            family = self.families.setdefault(_above(obj), [])
            self.places.append(len(family))
            family.append(index)

    @cached_property
    def words(self) -> Counter[str]:
        """Word → number of objects with it in their names."""
        return Counter(word for obj in self.objects for word in dict.fromkeys(words_of(obj.name)))

    @cached_property
    def volumes(self) -> tuple[list[float], list[int]]:
        """The sums of the log extents in order, and the objects that they are of."""
        ordered = sorted((sum(logs), index) for index, logs in enumerate(self.logs) if logs is not None)
        return [volume for volume, _ in ordered], [index for _, index in ordered]

    @cached_property
    def holders(self) -> frozenset[str]:
        """The paths that have objects below them."""
        found: set[str] = set()
        for path in self.families:
            above = path
            while above not in found:
                found.add(above)
                above = above.rpartition("/")[0]
        return frozenset(found)

    def written(self, ways: Ways, rate: Rate[R], gather: Gather[R, G], most: int) -> "_Written[R, G]":
        """Return the words by form, made once."""
        key = ways, rate, gather, most
        if key not in self._written:
            self._written[key] = _Written(self, *key)
        return self._written[key]

    def judgements(self, judge: Judge[J]) -> dict[int, J | None]:
        """Return object → what the judge said of it, of those that it was asked about."""
        return self._judgements.setdefault(judge, {})


class _Written(Generic[R, G]):
    """The words of a stage by the forms in which they may be written, best first."""

    def __init__(self, stage: _Stage, ways: Ways, rate: Rate[R], gather: Gather[R, G], most: int) -> None:
        self._words, self._count = stage.words, len(stage.objects)
        self._rate, self._gather, self._most = rate, gather, most
        self._written: dict[str, list[tuple[str, float]]] = {}
        self._ranked: dict[str, list[tuple[R, str, float]]] = {}
        self._best: dict[str, G] = {}
        self.forms: dict[str, list[str]] = {}
        """Word → the forms in which it may be written."""
        for word in self._words:
            forms = self.forms[word] = []
            for form, score in ways(word):
                forms.append(form)
                self._written.setdefault(form, []).append((word, score))

    def best(self, form: str) -> G | None:
        """Return what is made of the best words that may be written in a form; None if there are none."""
        if form not in self._written:
            return None
        if form not in self._best:
            self._best[form] = self._gather(form, [worth for worth, _, _ in self._rank(form, self._most)])
        return self._best[form]

    def best_without(self, own: frozenset[str], form: str) -> G | None:
        """Return the same for an object that bears the words `own`, which are not to be told of it."""
        # Without its bearer a word of its own may fall behind or out; the others keep their order.
        near = self._rank(form, self._most + len(own))
        if not any(word in own for _, word, _ in near):
            return self.best(form)
        left = [(worth, word, score) for worth, word, score in near if word not in own or self._words[word] > 1]
        found = sorted(self._worth(word, score, 1) if word in own else worth for worth, word, score in left)
        return self._gather(form, found[: self._most]) if found else None

    def _rank(self, form: str, count: int) -> list[tuple[R, str, float]]:
        """Return the best words for a form; of a letter half the stage's words are some."""
        words = self._written.get(form, ())
        ranked = self._ranked.get(form)
        if ranked is None or len(ranked) < min(count, len(words)):
            worths = ((self._worth(word, score), word, score) for word, score in words)
            ranked = self._ranked[form] = nsmallest(max(count, _MOST_RANKED), worths)
        return ranked[:count]

    def _worth(self, word: str, score: float, left_out: int = 0) -> R:
        return self._rate(word, (self._words[word] - left_out) / self._count, score)


class Company:
    """The company of one target, which never tells the target's own name."""

    def __init__(self, stage: _Stage, index: int) -> None:
        self._stage = stage
        self._index = index

    def words_written(self, ways: Ways, rate: Rate[R], gather: Gather[R, G], most: int) -> Callable[[str], G | None]:
        """Return a function that gives for a form what is made of the words in other objects' names that it may be.

        Its argument is a form, letters in lower case; it returns None where there is no such word.

        Args:
            ways: gives (form, score) of all the ways in which a word may be written, each form once.
            rate: gives what a word is worth, as a tuple: the best is the least, and a smaller share makes none better.
            gather: makes of a form and the worth of its words, sorted, what the function returns. It is asked once a
                stage, but for forms of the target's own words.
            most: the number of words for each form.

        The share is that of the objects that bear the word; shares add up to about the words in a name.
        """
        written = self._stage.written(ways, rate, gather, most)
        own = frozenset(words_of(self._stage.objects[self._index].name))
        own_forms = {form for word in own for form in written.forms[word]}

        def best(form: str) -> G | None:
            return written.best_without(own, form) if form in own_forms else written.best(form)

        return best

    def companions(self) -> list[Companion]:
        """Return the objects beside the target and those like it, each once, at the nearest it is."""
        return [self.companion(other, nearness, distance) for other, (nearness, distance) in self._near().items()]

    def judged(self, judge: Judge[J]) -> list[tuple[J, Nearness, float | None, int]]:
        """Return what `judge` says of the companions, each with how near it is and its place in the scene.

        It is asked once an object, and where it says nothing, the companion is left out.
        """
        judgements = self._stage.judgements(judge)
        found = []
        for other, (nearness, distance) in self._near().items():
            if other not in judgements:
                companion = self.companion(other, nearness, distance)
                judgements[other] = judge(companion.name, companion.parents, companion.size)
            judgement = judgements[other]
            if judgement is not None:
                found.append((judgement, nearness, distance, other))
        return found

    def companion(self, other: int, nearness: Nearness, distance: float | None) -> Companion:
        """Return an object of the scene as the target sees it."""
        obj = self._stage.objects[other]
        parents = tuple(name for name in _above(obj).split("/") if name)
        return Companion(obj.name, parents, nearness, distance, _size(obj))

    def _near(self) -> dict[int, tuple[Nearness, float | None]]:
        """Return the companions by their place in the scene, with their nearness and distance."""
        found = self._beside()
        for other, near in self._like():
            found.setdefault(other, near)
        path = self._stage.objects[self._index].prim_path
        if path not in self._stage.holders:
            return found
        # What lies below the target has the target's name among its parents.
        objects, below = self._stage.objects, path + "/"
        return {other: near for other, near in found.items() if not objects[other].prim_path.startswith(below)}

    def _beside(self) -> dict[int, tuple[Nearness, float | None]]:
        stage, own = self._stage, self._index
        logs = stage.logs
        size = logs[own]
        family, place = stage.families[_above(stage.objects[own])], stage.places[own]
        start, end = max(0, place - _MOST_SIBLINGS // 2), place + _MOST_SIBLINGS // 2
        found: dict[int, tuple[Nearness, float | None]] = {}
        for at, other in enumerate(family[start:end], start):
            other_size = logs[other]
            distance = None if size is None or other_size is None else _distance(size, other_size)
            found[other] = Nearness.NEXT if -_NEXT <= at - place <= _NEXT else Nearness.SIBLING, distance
        del found[own]
        return found

    def _like(self) -> list[tuple[int, tuple[Nearness, float | None]]]:
        size = self._stage.logs[self._index]
        if size is None:
            return []
        logs, (volumes, order) = self._stage.logs, self._stage.volumes
        at = bisect_left(volumes, sum(size))
        near = order[max(0, at - _MOST_ALIKE) : at + _MOST_ALIKE]
        nearest = [(_distance(size, other), index) for index in near if (other := logs[index]) and index != self._index]
        nearest.sort()
        twins = sum([distance < _TWIN for distance, _ in nearest[:_MOST_TWINS]])
        return [
            (index, (Nearness.TWIN if rank < twins else Nearness.ALIKE, distance))
            for rank, (distance, index) in enumerate(nearest[: max(twins, _MOST_ALIKE)])
        ]


def companies(scene: Scene) -> list[Company]:
    """Return the company of each object, in scene order."""
    stage = _Stage(scene)
    return [Company(stage, index) for index in range(len(scene.objects))]


def _above(obj: SceneObject) -> str:
    return obj.prim_path.rpartition("/")[0]


def _size(obj: SceneObject) -> Vector | None:
    return obj.oriented_size or (obj.box.size if obj.box else None)
