"""Words in the names of a stage, by the abbreviated forms that they may have."""

from collections import Counter
from collections.abc import Callable, Iterable
from functools import cached_property
from heapq import nsmallest
from typing import Any, Generic, TypeVar

from usd2kg.grounding.context.settings import NEIGHBOURS
from usd2kg.scene.model import Scene
from usd2kg.words import words_of

__all__ = ["FormWords", "Gather", "Rate", "StageWords", "WriteForms"]

R = TypeVar("R", bound=tuple[Any, ...])
G = TypeVar("G")
WriteForms = Callable[[str], Iterable[tuple[str, float]]]
"""Returns (form, score) for each form of a word."""
Rate = Callable[[str, float, float], R]
"""Returns the rating of a word from its share of objects and the score of its form; the smallest is the best."""
Gather = Callable[[str, list[R]], G]
"""Creates a result from a form and the ratings of its words, best first."""


class StageWords:
    """The words of a stage; computed on first use."""

    def __init__(self, scene: Scene) -> None:
        self._objects = scene.objects
        self._by_form: dict[tuple[WriteForms, Rate[Any], Gather[Any, Any], int], FormWords[Any, Any]] = {}

    @cached_property
    def counts(self) -> Counter[str]:
        """Word → number of objects with it in their names."""
        return Counter(word for obj in self._objects for word in dict.fromkeys(words_of(obj.name)))

    def by_form(self, write_forms: WriteForms, rate: Rate[R], gather: Gather[R, G], most: int) -> "FormWords[R, G]":
        """Return the words by form, computed once for the same arguments; see `Neighbourhood.words_by_form`."""
        key = write_forms, rate, gather, most
        if key not in self._by_form:
            self._by_form[key] = FormWords(self.counts, len(self._objects), *key)
        return self._by_form[key]


class FormWords(Generic[R, G]):
    """The words of a stage by form, best first."""

    def __init__(
        self,
        counts: Counter[str],
        object_count: int,
        write_forms: WriteForms,
        rate: Rate[R],
        gather: Gather[R, G],
        most: int,
    ) -> None:
        self._counts, self._object_count = counts, object_count
        self._rate, self._gather, self._most = rate, gather, most
        self._words: dict[str, list[tuple[str, float]]] = {}
        self._ranked: dict[str, list[tuple[R, str, float]]] = {}
        self._gathered: dict[str, G] = {}
        self._forms: dict[str, list[str]] = {}
        for word in counts:
            forms = self._forms[word] = []
            for form, score in write_forms(word):
                forms.append(form)
                self._words.setdefault(form, []).append((word, score))

    def without_object(self, name: str) -> Callable[[str], G | None]:
        """Return a function from a form to its result without one object called `name`; None for an unused form."""
        own = frozenset(words_of(name))
        own_forms = {form for word in own for form in self._forms[word]}

        def best(form: str) -> G | None:
            return self._best_without(own, form) if form in own_forms else self._best(form)

        return best

    def _best(self, form: str) -> G | None:
        if form not in self._words:
            return None
        if form not in self._gathered:
            self._gathered[form] = self._gather(form, [rating for rating, _, _ in self._rank(form, self._most)])
        return self._gathered[form]

    def _best_without(self, own: frozenset[str], form: str) -> G | None:
        # Without the object, its own words lose one count and may drop in rank; the others keep their order.
        near = self._rank(form, self._most + len(own))
        if not any(word in own for _, word, _ in near):
            return self._best(form)
        left = [(rating, word, score) for rating, word, score in near if word not in own or self._counts[word] > 1]
        ratings = sorted(
            self._rating(word, score, left_out=1) if word in own else rating for rating, word, score in left
        )
        return self._gather(form, ratings[: self._most]) if ratings else None

    def _rank(self, form: str, count: int) -> list[tuple[R, str, float]]:
        """Return the best words for a form; a single letter may abbreviate half the stage's words."""
        words = self._words.get(form, ())
        ranked = self._ranked.get(form)
        if ranked is None or len(ranked) < min(count, len(words)):
            ratings = ((self._rating(word, score), word, score) for word, score in words)
            ranked = self._ranked[form] = nsmallest(max(count, NEIGHBOURS.min_cached_words), ratings)
        return ranked[:count]

    def _rating(self, word: str, score: float, *, left_out: int = 0) -> R:
        return self._rate(word, (self._counts[word] - left_out) / self._object_count, score)
