"""InterpretedAnswer: an answer in words, with the table and the interpretation of its question."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from usd2kg.query import Answer
from usd2kg.rich_display import RichDisplay

__all__ = ["InterpretedAnswer", "contradict"]


@dataclass(frozen=True)
class InterpretedAnswer(RichDisplay):
    """An answer with the interpretation of its question."""

    understood: str
    """The interpretation in English, for the user to check."""
    answer: Answer
    verdict: bool | None = None
    """Answer to a yes/no question; None for other questions."""
    number: float | None = None
    """Answer to "how many", "how tall" and the like, in metres, kilograms or degrees; None for other questions."""
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

    def with_notes(self, notes: Sequence[str]) -> "InterpretedAnswer":
        """Return the same answer, which also says how unusual words were read."""
        said = [f"{note[:1].upper()}{note[1:]}." for note in dict.fromkeys(notes) if note not in self.sentence]
        return self.with_sentence(" ".join(filter(None, [self.sentence, *said]))) if said else self

    @property
    def paths(self) -> frozenset[str]:
        """The prim paths of the objects in the table."""
        at = [number for number, column in enumerate(self.answer.columns) if column == "path"]
        return frozenset(cell for row in self.answer.rows for number in at if (cell := row[number]))

    def summary(self) -> str:
        """Return the sentence as a line; empty if there is none."""
        return f"{self.sentence}\n" if self.sentence else ""


_SAME = 1e-3
"""Share by which equal numbers may differ."""


def contradict(one: InterpretedAnswer, other: InterpretedAnswer) -> bool:
    """Return whether two answers to one question cannot both be right: other verdicts, numbers or things."""
    if one.verdict is not None and other.verdict is not None:
        return one.verdict is not other.verdict
    if one.number is not None and other.number is not None:
        return abs(one.number - other.number) > _SAME * max(abs(one.number), abs(other.number))
    if one.places and other.places:
        return one.places[0] not in other.places and other.places[0] not in one.places
    return one.paths != other.paths
