"""find_proposals: the subclasses that reviewers propose, with the objects that they hold."""

from collections.abc import Iterable, Iterator

from usd2kg.grounding import Concept, Grounding
from usd2kg.ontology import ClassIRI
from usd2kg.readiness import Proposal, SuggestedClass
from usd2kg.studio.object_review import ObjectReview

__all__ = ["find_proposals"]


def find_proposals(states: Iterable[ObjectReview], suggestions: Grounding) -> list[SuggestedClass]:
    """Return the proposed classes, those with the most objects first.

    Labels that differ in case only are one proposal, unless their superclasses differ.

    Args:
        states: the states of all objects, in scene order.
        suggestions: the grounding that was reviewed, for the concepts.
    """
    held: dict[tuple[str, ClassIRI], list[ObjectReview]] = {}
    for state in states:
        verdict = state.verdict
        if verdict.proposal and verdict.class_iri is not None:
            held.setdefault((verdict.proposal.casefold(), verdict.class_iri), []).append(state)
    found = [
        SuggestedClass(
            members[0].verdict.proposal,
            _concept_of(label, members, suggestions),
            parent,
            tuple(state.prim_path for state in members),
            tuple(_proposals(members)),
        )
        for (label, parent), members in held.items()
    ]
    return sorted(found, key=lambda one: (-len(one.objects), one.label, one.parent))


def _concept_of(label: str, members: Iterable[ObjectReview], suggestions: Grounding) -> Concept | None:
    """Return the concept that all objects have, if the label is its own."""
    iris = {state.prediction.concept for state in members}
    concept = suggestions.concepts.get(iris.pop() or "") if len(iris) == 1 else None
    return concept if concept is not None and concept.label.casefold() == label else None


def _proposals(members: Iterable[ObjectReview]) -> Iterator[Proposal]:
    """Yield who proposed a class, the first time of each comment."""
    seen: set[tuple[str, str]] = set()
    for verdict in sorted((state.verdict for state in members), key=lambda verdict: verdict.time):
        if (verdict.reviewer, verdict.comment) not in seen:
            seen.add((verdict.reviewer, verdict.comment))
            yield Proposal(verdict.reviewer, verdict.time, verdict.comment)
