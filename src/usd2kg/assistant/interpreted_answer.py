"""InterpretedAnswer: an answer in words, with the table and the interpretation of its question."""

from dataclasses import dataclass, replace
from typing import Any

from usd2kg.query import Answer
from usd2kg.rich_display import RichDisplay

__all__ = ["InterpretedAnswer"]


@dataclass(frozen=True)
class InterpretedAnswer(RichDisplay):
    """An answer with the interpretation of its question."""

    understood: str
    """The interpretation in English, for the user to check."""
    answer: Answer
    verdict: bool | None = None
    """Answer to a yes/no question; None for other questions."""
    number: float | None = None
    """Answer to "how many", "how tall" and the like, in metres or kilograms; None for other questions."""
    sentence: str = ""
    """The answer in English; empty if the table is all."""
    places: tuple[str, ...] = ()
    """Prim paths of the places that are named, the best first."""

    def as_json(self) -> dict[str, Any]:
        """Return the interpretation and the sentence, with the verdict or the number if there is one."""
        result = {"verdict": self.verdict, "number": self.number, "places": list(self.places) or None}
        known = {key: value for key, value in result.items() if value is not None}
        return {"understood": self.understood, "sentence": self.sentence, **known}

    def with_sentence(self, sentence: str) -> "InterpretedAnswer":
        """Return the same answer with another sentence."""
        return replace(self, sentence=sentence)

    def summary(self) -> str:
        """Return the sentence as a line; empty if there is none."""
        return f"{self.sentence}\n" if self.sentence else ""
