"""Group: the things that a noun phrase means, with how many of them a sentence is about."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

from usd2kg.errors import GraphError
from usd2kg.query.lookup import Things

__all__ = ["ANY", "EACH", "NO", "Filter", "Group", "Quantity", "exactly"]


class Quantity(NamedTuple):
    """How many things a sentence is about, from `low` to `high`; or each of them."""

    low: int
    high: float = float("inf")
    is_each: bool = False
    is_most: bool = False
    """Whether the things with the highest number are meant: which desk has the most books."""

    def holds(self, count: int, total: int | None = None) -> bool:
        """Return whether a number of things is such a quantity; `total` is how many there are, for each of them."""
        return 0 < count == total if self.is_each and total is not None else self.low <= count <= self.high


ANY = Quantity(1)
NO = Quantity(0, 0)
EACH = Quantity(1, is_each=True)


def exactly(count: int) -> Quantity:
    """Return a quantity that is a number."""
    return Quantity(count, count)


class Filter(NamedTuple):
    """A modifier or a predicate: chooses those of some things to which it applies."""

    choose: Callable[[Sequence[str]], Collection[str]]
    """Raises `GraphError` if the graph does not know."""
    guesses: tuple[str, ...] = ()
    """How words in it were read that are not known as they are."""
    cost: int = 0
    """How far its reading is from the words, as in `Group`."""
    is_relative: bool = False
    """Whether the choice depends on the other things: the largest of them."""


@dataclass(frozen=True)
class Group:
    """The things that a noun phrase means."""

    noun: Things
    """What the noun means, before its modifiers."""
    text: str
    """The noun phrase, without its determiner."""
    filters: tuple[Filter, ...] = ()
    quantity: Quantity | None = None
    """From the determiner; None without one, and for a definite one."""
    is_definite: bool = False
    is_plural: bool = False
    is_joined: bool = False
    """Whether it is the things of several nouns."""
    is_general: bool = False
    """Whether the noun means any thing."""
    guesses: tuple[str, ...] = ()
    """How words were read that are not known as they are."""
    cost: int = 0
    """How far the reading is from the words: 0 if all of them are understood as they are."""
    said: str = ""
    """What modifiers and predicates after the noun say of the things, as it is written."""

    def keep(self, one: Filter, text: str, said: str = "") -> "Group":
        """Return the things to which a further modifier applies."""
        return replace(
            self,
            text=text,
            said=f"{self.said} {said}".strip(),
            filters=(*self.filters, one),
            guesses=(*self.guesses, *one.guesses),
            cost=self.cost + one.cost,
        )

    @cached_property
    def iris(self) -> tuple[str, ...]:
        """The objects, in the order of the noun's.

        Raises:
            GraphError: the graph does not know to which things a modifier applies.
        """
        iris = self.noun.iris
        for one in self.filters:
            kept = set(one.choose(iris))
            iris = tuple(iri for iri in iris if iri in kept)
        return iris

    @property
    def things(self) -> Things:
        """The objects with their text."""
        return Things(self.iris, self.text, self.noun.note)

    def existing(self) -> Sequence[str]:
        """Return the objects, at least one.

        Raises:
            GraphError: there are none.
        """
        if not self.iris:
            raise GraphError(self.things.absence)
        return self.iris
