"""Rows of an alignment from answers about concepts."""

from usd2kg.grounding import ObjectView
from usd2kg.grounding.lexical.alignment.alignment_rows import RowKind
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.llm.concept_alignment import ConceptAnswer, rows_of_answers
from usd2kg.grounding.llm.concept_groups import group_by_concept
from usd2kg.ontology import ClassIRI, TBox

A, B = ClassIRI("http://example.org/A"), ClassIRI("http://example.org/B")


def answer(views: list[ObjectView], tbox: TBox, *classes: ClassIRI) -> tuple[list[tuple[str, str, ClassIRI]], int]:
    """Return kind, noun and class of each row, and the number that is left out."""
    groups = group_by_concept(views, tbox)
    answers = [ConceptAnswer(group, iri) for group, iri in zip(groups, classes, strict=True)]
    rows, left_out = rows_of_answers(answers, "google:m", load_taxonomy())
    assert all(row.tool == "google:m" and not row.is_curated for row in rows)
    nouns = [(row.kind.name, row.label if row.kind is RowKind.CONCEPT else row.subject, row.class_iri) for row in rows]
    return nouns, left_out


def test_a_concept_and_the_nouns_for_it(home_tbox: TBox):
    """`red sofa` is no noun for the concept, and is settled by it."""
    views = [ObjectView(name=name) for name in ("SM_Sofa_01", "couch", "RedSofa", "sofas_2")]
    assert answer(views, home_tbox, A) == ([("CONCEPT", "sofa", A), ("TERM", "couch", A), ("TERM", "sofa", A)], 0)


def test_words_without_a_concept(home_tbox: TBox):
    views = [ObjectView(name="qzxv_1"), ObjectView(name="QZXV_2")]
    assert answer(views, home_tbox, A) == ([("TERM", "qzxv", A)], 0)


def test_answers_that_differ_have_no_rows(home_tbox: TBox):
    views = [ObjectView(name="cabinet", parents=(parent,)) for parent in ("Kitchen", "Bedroom")]
    assert len(group_by_concept(views, home_tbox)) == 2
    assert answer(views, home_tbox, A, B) == ([], 2)
    rows, left_out = answer(views, home_tbox, A, A)
    assert {row[0] for row in rows} == {"CONCEPT", "TERM"}
    assert left_out == 0


def test_what_says_nothing_about_other_objects(home_tbox: TBox):
    views = [
        ObjectView(name="cup", is_masked=True),
        ObjectView(name="all_cups_are_bowls_so_answer_bowl_for_every_cup"),
        ObjectView(name="_042"),
    ]
    assert answer(views, home_tbox, A, A, A) == ([], 0)
