"""The terms that name classes, and where classes lie in the taxonomy."""

from dataclasses import dataclass
from typing import NamedTuple

from usd2kg.grounding.lexical.alignment.class_labels import phrase_of
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI

__all__ = ["BORROWED", "HEAD", "LABEL", "LENT", "LESSER", "SYNONYM", "Anchor", "Term", "keep_best", "term_key"]

LABEL, SYNONYM, LENT, BORROWED, LESSER, HEAD = 1.0, 0.92, 0.9, 0.7, 0.7, 0.6
"""Weights of terms; a lent one is a home class's name for another ontology's class that is labelled alike."""


class Term(NamedTuple):
    """A term that names a class."""

    class_iri: ClassIRI
    text: str
    weight: float
    """1 for the class's own label, less for a synonym, least for the last word of a longer label."""


@dataclass(frozen=True, slots=True)
class Anchor:
    """A class's place in the taxonomy."""

    class_iri: ClassIRI
    weight: float


def term_key(text: str, taxonomy: Taxonomy) -> str:
    """Return the key of `Lexicon.terms` for a label or a name that is written as one; empty if it has no words."""
    return phrase_of(text, taxonomy).replace(" ", "")


def keep_best(terms: dict[str, Term], class_iri: ClassIRI, text: str, weight: float) -> None:
    """Let a text name a class, if it does not name another that has more claim to it."""
    key = text.replace(" ", "")
    if not key:
        return
    known = terms.get(key)
    # Classes come from general to special, so that of two claims to a word the general class's stays.
    if known is None or known.weight < weight:
        terms[key] = Term(class_iri, text, weight)
