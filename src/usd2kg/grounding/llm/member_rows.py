"""Rows of an alignment file from what a language model says belongs to each class."""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from usd2kg.grounding.lexical.alignment.alignment_rows import AlignmentRow, RowKind
from usd2kg.grounding.lexical.alignment.label_words import normalise_label
from usd2kg.grounding.lexical.alignment.terms import TermKind
from usd2kg.grounding.lexical.concepts.senses import usual_sense
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.settings import ALIGNMENT
from usd2kg.grounding.llm.class_members import ClassMembers
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["rows_of_members"]


def rows_of_members(
    members: Iterable[ClassMembers], model: str, tbox: TBox, taxonomy: Taxonomy
) -> Iterator[AlignmentRow]:
    """Yield a term for each noun, and a concept for its usual sense if the taxonomy has it.

    A noun of several classes belongs to the deepest of them, since the model also names things of superclasses.

    Args:
        members: the answers.
        model: the model string.
        tbox: the classes.
        taxonomy: the nouns.
    """
    found = list(members)
    chosen: dict[str, ClassIRI] = {}
    for answer in found:
        for noun in answer.belongs:
            text = normalise_label(noun, taxonomy)
            known = chosen.get(text)
            if text and (known is None or tbox.depths[known] < tbox.depths[answer.class_iri]):
                chosen[text] = answer.class_iri
    for text, iri in chosen.items():
        yield from _make_rows(text, iri, model, taxonomy)
    for answer in found:
        for noun in answer.excluded:
            text = normalise_label(noun, taxonomy)
            if text and chosen.get(text) != answer.class_iri:
                yield from _make_rows(text, answer.class_iri, model, taxonomy, is_negated=True)


def _make_rows(
    text: str, iri: ClassIRI, model: str, taxonomy: Taxonomy, *, is_negated: bool = False
) -> Iterator[AlignmentRow]:
    term = AlignmentRow(
        kind=RowKind.TERM,
        subject=text,
        class_iri=iri,
        confidence=ALIGNMENT.model_confidence,
        reason=f"the model says that it {'does not belong' if is_negated else 'belongs'} to the class",
        term_kind=TermKind.MODEL,
        model=model,
        is_negated=is_negated,
    )
    yield term
    if (sense := usual_sense(text.replace(" ", ""), taxonomy)) is not None:
        concept, label = taxonomy.concept_iri(sense.synset), taxonomy.label(sense.synset)
        yield replace(term, kind=RowKind.CONCEPT, subject=concept, label=label)
