"""Scores of a grounder, and of a second annotator, on labelled names."""

from collections.abc import Sequence
from typing import NamedTuple

from benchmarks.bare import bare_scene
from benchmarks.intervals import wilson
from benchmarks.names.lists import LabelledName
from usd2kg.grounding import Grounder, NamingRegime, ground
from usd2kg.ontology import TBox

__all__ = ["Tally", "second_annotator_lines", "tally_agreement", "tally_answers"]


class Tally(NamedTuple):
    """Counts over some labelled names."""

    count: int = 0
    exact: int = 0
    """Answers that are the target."""
    accepted: int = 0
    """Answers that are the target or another accepted class."""
    confidence: float = 0.0
    """Sum of the confidences."""

    def plus(self, other: "Tally") -> "Tally":
        """Return the counts of both."""
        return Tally(*(a + b for a, b in zip(self, other, strict=True)))

    def __str__(self) -> str:
        return f"{_share(self.exact, self.count)}  {_share(self.accepted, self.count)}"


def _share(right: int, count: int) -> str:
    if not count:
        return f"{'–':>17}"
    low, high = wilson(right, count)
    return f"{100 * right / count:5.1f} [{100 * low:4.1f}–{100 * high:5.1f}]"


def tally_answers(
    names: Sequence[LabelledName],
    tbox: TBox,
    regime: NamingRegime = NamingRegime.SEMANTIC,
    grounder: Grounder | str = "lexical",
) -> Tally:
    """Ground one list as one scene and count the right answers."""
    scene = bare_scene("a list of names", [name.obj for name in names])
    answers = ground(scene, tbox, grounder, regime=regime).by_path
    pairs = [(name, answers[name.obj.prim_path]) for name in names]
    return Tally(
        count=len(pairs),
        exact=sum(answer.class_iri == name.target for name, answer in pairs),
        accepted=sum(answer.class_iri in name.accepted for name, answer in pairs),
        confidence=sum(answer.confidence or 0.0 for _, answer in pairs),
    )


def tally_agreement(firsts: Sequence[LabelledName], seconds: Sequence[LabelledName]) -> Tally:
    """Count the second annotator's classes that the first one chose or accepts."""
    pairs = list(zip(firsts, seconds, strict=True))
    return Tally(
        count=len(pairs),
        exact=sum(second.target == first.target for first, second in pairs),
        accepted=sum(second.target in first.accepted for first, second in pairs),
    )


def second_annotator_lines(names: Sequence[LabelledName], tbox: TBox) -> list[str]:
    """Return the agreement of two annotators and of the grounder with each, on names that both labelled."""
    pairs = [(name, name.second) for name in names if name.second]
    firsts, seconds = [first for first, _ in pairs], [second for _, second in pairs]
    rows = {
        "second annotator against the first": tally_agreement(firsts, seconds),
        "grounder against the first": tally_answers(firsts, tbox),
        "grounder against the second": tally_answers(seconds, tbox),
    }
    return [f"  {label:<36}{len(pairs):>5}  {tally}" for label, tally in rows.items()]
