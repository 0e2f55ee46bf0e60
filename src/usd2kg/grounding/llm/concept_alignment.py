"""rows_of_answers: a model's answers about concepts as rows of an alignment, which later runs reuse."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from usd2kg.grounding.lexical.alignment.alignment_rows import AlignmentRow, RowKind
from usd2kg.grounding.lexical.alignment.label_words import normalise_label
from usd2kg.grounding.lexical.alignment.terms import TermKind
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.settings import ALIGNMENT
from usd2kg.grounding.llm.concept_groups import ConceptGroup
from usd2kg.ontology import ClassIRI

__all__ = ["ConceptAnswer", "rows_of_answers"]


@dataclass(frozen=True, slots=True)
class ConceptAnswer:
    """The class that a model chose for a group of objects."""

    group: ConceptGroup
    class_iri: ClassIRI


def rows_of_answers(answers: Sequence[ConceptAnswer], tool: str, taxonomy: Taxonomy) -> tuple[list[AlignmentRow], int]:
    """Return the rows, and the number of concepts and terms omitted because their answers conflict.

    An answer about a concept gives a row for the concept and a row for each noun in the names that denotes it. An
    answer about words without a concept gives a row for these words. Answers about the same concept conflict if the
    lexical grounder put its objects into different classes, for example by their places; then none of them generalizes
    to later objects.

    Args:
        answers: the answers.
        tool: the model string.
        taxonomy: the concepts.
    """
    classes: dict[tuple[RowKind, str, str], set[ClassIRI]] = {}
    for answer in answers:
        for subject in _subjects(answer.group, taxonomy):
            classes.setdefault(subject, set()).add(answer.class_iri)
    rows = [
        AlignmentRow(
            kind,
            subject,
            min(iris),
            ALIGNMENT.model_confidence,
            label,
            reason="the model's answer about objects of this name",
            term_kind=TermKind.MODEL,
            tool=tool,
        )
        for (kind, subject, label), iris in sorted(classes.items(), key=lambda item: (item[0][0].name, *item[0][1:]))
        if len(iris) == 1
    ]
    return rows, len(classes) - len(rows)


def _subjects(group: ConceptGroup, taxonomy: Taxonomy) -> Iterator[tuple[RowKind, str, str]]:
    """Yield kind, subject and label of each row of a group."""
    if not group.is_reusable:
        return
    concept = group.concept
    if concept is not None:
        yield RowKind.CONCEPT, concept.iri, concept.label
    for reading in group.readings:
        term = normalise_label(reading, taxonomy)
        senses = (taxonomy.concept_iri(sense.synset) for sense in taxonomy.senses(term.replace(" ", "")))
        if term and (concept is None or concept.iri in senses):
            yield RowKind.TERM, term, ""
