"""How a model is asked."""

from dataclasses import dataclass
from enum import StrEnum

from usd2kg.errors import GroundingError
from usd2kg.words import words_of

__all__ = ["PromptOptions", "Strategy"]


class Strategy(StrEnum):
    """How a model is asked, by the letters of the study."""

    NAME_ONLY = "A"
    """The name and the TBox."""
    CONTEXT = "B"
    """Geometry, position and hierarchy beside the name."""
    CHAIN_OF_THOUGHT = "C"
    """The same, and the reasoning is written out before the class."""
    BY_NAME = "auto"
    """A for objects whose name says something; else C, or B for a model that reasons by itself.

    In the study context helped only where names said nothing, and written reasoning only models without their own.
    """

    def for_name(self, name: str, *, is_thinking: bool) -> "Strategy":
        """Return the strategy for an object that is called so; another than `BY_NAME` is itself."""
        if self is not Strategy.BY_NAME:
            return self
        if words_of(name):
            return Strategy.NAME_ONLY
        return Strategy.CONTEXT if is_thinking else Strategy.CHAIN_OF_THOUGHT


@dataclass(frozen=True, slots=True)
class PromptOptions:
    """What a prompt depends on beside the objects and the TBox.

    Raises:
        GroundingError: a prompt would ask about no object.
    """

    strategy: Strategy = Strategy.CONTEXT
    is_tree: bool = False
    """Whether the classes are listed as a tree instead of alphabetically."""
    shuffle_seed: int | None = None
    """Seed of a random order of the classes (in a tree, of those below one class); None keeps the alphabet."""
    objects_per_prompt: int = 1
    max_siblings: int = 48
    """Siblings that are named; the others are counted."""
    has_more_evidence: bool = False
    """Whether labels, documentation, own axes, asset, materials and parts are told too, which the study does not."""
    max_tokens: int = 4096
    """Output tokens after which the model is cut off."""
    temperature: float = 0.0
    is_thinking: bool = False

    def __post_init__(self) -> None:
        if self.objects_per_prompt < 1:
            raise GroundingError(f"{self.objects_per_prompt} objects in a prompt; expected 1 or more")
