"""Strategies and options of prompts."""

from dataclasses import dataclass
from enum import StrEnum

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.words import words_of

__all__ = ["PromptOptions", "Strategy"]


class Strategy(StrEnum):
    """What a prompt contains, named by the letters of the study."""

    NAME_ONLY = "A"
    """The name of the object and the TBox."""
    CONTEXT = "B"
    """Also geometry, position and hierarchy."""
    CHAIN_OF_THOUGHT = "C"
    """As B, and the model writes its reasoning before the class."""
    BY_CONCEPT = "concept"
    """One question for all objects that share a concept, with the candidates of the lexical grounder."""
    BY_NAME = "auto"
    """A for objects with an informative name; otherwise C, or B for a reasoning model.

    In the study, context helped only with uninformative names, and written reasoning helped only non-reasoning models.
    """

    def for_name(self, name: str, *, is_thinking: bool) -> "Strategy":
        """Return the strategy for an object called `name`, which depends on the name only for `BY_NAME`."""
        if self is not Strategy.BY_NAME:
            return self
        if words_of(name):
            return Strategy.NAME_ONLY
        return Strategy.CONTEXT if is_thinking else Strategy.CHAIN_OF_THOUGHT


@dataclass(frozen=True, slots=True)
class PromptOptions:
    """Strategy and format of the prompts.

    Raises:
        GroundingError: `objects_per_prompt` is below 1, or two orders of the classes are named.
    """

    strategy: Strategy = Strategy.CONTEXT
    is_tree: bool = False
    """List the classes as a tree instead of alphabetically."""
    shuffle_seed: int | None = None
    """Seed of a random order of the classes, in a tree of the subclasses of each class; None for alphabetical order."""
    has_candidates_first: bool = False
    """List the classes of a shortlist by their rank, then their superclasses and the roots."""
    objects_per_prompt: int = 1
    max_siblings: int = LIMITS.max_siblings
    """Sibling names in a description; the others are counted."""
    has_more_evidence: bool = False
    """Include labels, documentation, oriented size, asset, materials and parts, which the study omits."""
    max_tokens: int = LIMITS.max_output_tokens
    """Limit of output tokens."""
    temperature: float = 0.0
    is_thinking: bool = False

    def __post_init__(self) -> None:
        if self.objects_per_prompt < 1:
            raise GroundingError(f"{self.objects_per_prompt} objects in a prompt; expected 1 or more")
        if self.has_candidates_first and self.shuffle_seed is not None:
            raise GroundingError(
                "the classes of a prompt cannot be shuffled and have the candidates first; "
                "expected one order: leave out --shuffle or --candidates-first"
            )
