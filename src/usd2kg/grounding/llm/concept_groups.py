"""group_by_concept: objects → distinct readings of their names → distinct concepts, each with the lexical candidates.

Objects of a group get the same answer, so a group must not mix objects whose answers could differ:

- A masked view is a group by itself, since the naming regime hides what distinguishes it.
- An object whose texts may command the model shares an answer only with objects of the same texts.
- Objects with the same concept that the lexical grounder puts into different classes are in different groups.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.lexical.recognition import describe_concepts, load_recognizer
from usd2kg.grounding.llm.commands import commanding_texts
from usd2kg.grounding.llm.grouping import signature_of
from usd2kg.grounding.llm.prompt_options import Strategy
from usd2kg.grounding.llm.settings import CONCEPTS
from usd2kg.grounding.model import Concept, Prediction
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.words import words_of

__all__ = ["ConceptGroup", "group_by_concept", "reading_of"]


@dataclass(frozen=True, slots=True)
class ConceptGroup:
    """Objects that share one question."""

    members: tuple[int, ...]
    """Their indices in the views."""
    concept: Concept | None
    """The concept that their words name; None if they name none."""
    broader: tuple[str, ...]
    """Labels of its direct hypernyms."""
    candidates: tuple[ClassIRI, ...]
    """The classes that the lexical grounder considers for the first member, best first."""
    readings: tuple[str, ...] = ()
    """The distinct content words of their names; empty for names without words."""
    is_reusable: bool = True
    """Whether the answer can be reused for other objects: no member is masked and no text may command the model."""


def reading_of(name: str) -> str:
    """Return the content words of a name, which are the same for copies of an object; without any, the name itself.

    >>> reading_of("SM_KitchenWorktop_01")
    'kitchen worktop'
    >>> reading_of("obj_042")
    'obj_042'
    """
    return " ".join(words_of(name)) or name


def group_by_concept(views: Sequence[ObjectView], tbox: TBox, *, has_more_evidence: bool = False) -> list[ConceptGroup]:
    """Return the groups of objects that share a concept, in the order of their first members.

    Objects whose words name no concept are grouped by their words. Objects without words are grouped if they differ
    only in a number and in position.

    Args:
        views: the objects.
        tbox: the classes of the candidates.
        has_more_evidence: whether prompts have more than the evidence of the study, such as documentation.
    """
    predictions = LexicalGrounder().ground_views([("", view) for view in views], tbox)
    recognizer = load_recognizer()
    groups: dict[object, list[int]] = {}
    concepts: dict[object, str | None] = {}
    for index, (view, prediction) in enumerate(zip(views, predictions, strict=True)):
        found = recognizer.recognize(view, prediction.words)
        concept = found.concept if found is not None else None
        commands = commanding_texts(view, has_more_evidence=has_more_evidence)
        shared = _shared_key(view, concept) if not commands else (commands, signature_of(view, Strategy.CONTEXT))
        key: object = index if view.is_masked else (shared, prediction.class_iri)
        groups.setdefault(key, []).append(index)
        concepts.setdefault(key, concept)
    known = describe_concepts(iri for iri in concepts.values() if iri is not None)
    return [
        replace(
            _make_group(members, known.get(concepts[key] or ""), known, predictions[members[0]]),
            readings=tuple(dict.fromkeys(text for at in members if (text := " ".join(words_of(views[at].name))))),
            is_reusable=_is_reusable(views[members[0]], has_more_evidence),
        )
        for key, members in groups.items()
    ]


def _is_reusable(view: ObjectView, has_more_evidence: bool) -> bool:
    return not (view.is_masked or commanding_texts(view, has_more_evidence=has_more_evidence))


def _shared_key(view: ObjectView, concept: str | None) -> object:
    words = words_of(view.name)
    if concept is not None:
        return ("concept", concept)
    return ("words", words) if words else ("looks", signature_of(view, Strategy.CONTEXT))


def _make_group(
    members: Sequence[int], concept: Concept | None, known: "dict[str, Concept]", first: Prediction
) -> ConceptGroup:
    broader = tuple(known[iri].label for iri in concept.broader[: CONCEPTS.max_broader]) if concept is not None else ()
    candidates = tuple(candidate.class_iri for candidate in first.candidates[: CONCEPTS.max_candidates])
    return ConceptGroup(tuple(members), concept, broader, candidates)
