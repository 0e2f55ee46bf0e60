"""Things: the objects that words mean."""

import re
from dataclasses import dataclass

from usd2kg.errors import GraphError
from usd2kg.query.lookup.prepositions import preposition_pattern
from usd2kg.query.lookup.word_forms import is_plural

__all__ = ["Things", "UnknownWordError"]


_MODIFIER = re.compile(rf" (?:that|with|without|of|within|nearest|closest|furthest|farthest|{preposition_pattern()})\b")
"""Where the modifier after a noun begins."""


class UnknownWordError(GraphError):
    """A word is neither a name in the graph nor a noun that the lexicon knows."""


@dataclass(frozen=True)
class Things:
    """The objects that words mean; none if the words are understood and no object is meant."""

    iris: tuple[str, ...]
    text: str
    """The words, without articles."""
    note: str = ""
    """How unusual words were read; empty if as they are."""
    is_by_name: bool = False
    """Whether the words only occur in the names of things that are something else: `shoes` in ShoeRack."""

    @property
    def suffix(self) -> str:
        """The note, to be added to a sentence."""
        return f" ({self.note})" if self.note else ""

    @property
    def absence(self) -> str:
        """The clause that there are no such things."""
        noun = _MODIFIER.split(self.text, maxsplit=1)[0]
        return f"there {'are' if is_plural(noun) else 'is'} no {self.text} in this scene{self.suffix}"
