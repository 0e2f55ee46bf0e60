"""HeadMatcher: resolves the words up to a head noun to classes of a TBox or to concepts."""

from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol

from usd2kg.grounding.lexical.concepts.extent import Extent
from usd2kg.grounding.lexical.reading.noun_phrase import NamePhrase
from usd2kg.ontology import ClassIRI

__all__ = ["ClassRanker", "HeadMatcher", "HeadMatches", "Match"]


class Match(NamedTuple):
    """A class or concept that a phrase may mean."""

    class_iri: ClassIRI
    """IRI of the class or concept."""
    score: float
    """0 to 1, uncalibrated."""
    reason: Callable[[], str]
    """Returns why; a function because most reasons are never shown."""
    phrase: NamePhrase = NamePhrase(())
    """The whole name."""
    end: int = 0
    """Number of words up to the head noun, which is the last of them."""
    is_listed: bool = False
    """Whether a list of what belongs to the class, or a person, names the noun or a hypernym."""

    @property
    def explanation(self) -> str:
        """One sentence for a person."""
        words, corrections = self.phrase.words, self.phrase.corrections
        behind = f" (the head noun of “{' '.join(words)}”)" if words[self.end :] else ""
        read = "".join(f" (“{written}” read as “{read}”)" for written, read in corrections)
        return self.reason() + behind + read


class HeadMatches(NamedTuple):
    """The longest known compound that ends with a head noun, and the classes that it may mean."""

    words: tuple[str, ...]
    """Empty if not even the head noun is known."""
    matches: tuple[Match, ...]


class HeadMatcher(Protocol):
    """Matches nouns and compounds."""

    def match(self, words: tuple[str, ...], places: tuple[str, ...]) -> HeadMatches:
        """Return the longest known compound that ends with the last word, and its possible meanings."""
        ...

    def match_compound(self, words: tuple[str, str]) -> tuple[Match, ...]:
        """Return the possible meanings of a two-word compound; empty if the compound is unknown."""
        ...

    def place_words(
        self, words: tuple[str, ...], context: tuple[str, ...], parents: tuple[str, ...]
    ) -> tuple[str, ...]:
        """Return the words for places that matter to `match`, nearest first.

        Args:
            words: the words of a name.
            context: words of a name that refer to its parent or place.
            parents: the names above, outermost first.
        """
        ...

    def whole_words(self, words: tuple[str, ...], whole: tuple[str, ...]) -> tuple[str, ...]:
        """Return the last words of the name of a whole that form a compound with the words of its part; usually none.

        The `seat_left` of a couch is a couch seat.
        """
        ...

    def is_subclass(self, special: ClassIRI, general: ClassIRI) -> bool:
        """Return whether one meaning is a kind of the other, or the same."""
        ...


class ClassRanker(Protocol):
    """Ranks the classes of a whole name."""

    @property
    def is_for_any_stage(self) -> bool:
        """Whether it also ranks names of a stage that the ontology is not made for."""
        ...

    def rank(
        self, phrase: NamePhrase, parents: tuple[str, ...], extent: Extent | None, matches: Sequence[Match]
    ) -> tuple[Match, ...]:
        """Return the classes of a name, best first.

        Args:
            phrase: the name.
            parents: the names of the prims above, outermost first.
            extent: the size of the object.
            matches: the classes by the head noun, best first.
        """
        ...
