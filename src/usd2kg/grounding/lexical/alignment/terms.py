"""Terms that name classes, and classes aligned with WordNet synsets."""

from enum import Enum
from typing import NamedTuple

from usd2kg.grounding.lexical.alignment.label_words import normalise_label
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.settings import TERMS
from usd2kg.ontology import ClassIRI

__all__ = ["AlignedClass", "Term", "TermKind", "keep_best", "term_key"]


class TermKind(Enum):
    """Origin of a term."""

    LABEL = "label"
    """The class's own label or local name."""
    SYNONYM = "synonym"
    """An alternative label, or a name of the home vocabulary for a class with the same IRI."""
    LENT = "lent"
    """A name of the home vocabulary, for a class of another ontology with the same label."""
    HEAD = "head"
    """The head noun of a longer label."""
    LISTED = "listed"
    """Named by a list that usd2kg ships for the class."""
    MODEL = "model"
    """Named by a language model in an alignment file."""
    CURATED = "curated"
    """Chosen by a person in an alignment file."""

    @property
    def weight(self) -> float:
        """How far the term is trusted to mean the class, 0 to 1."""
        return _WEIGHTS[self]


_WEIGHTS = {
    TermKind.LABEL: TERMS.label_weight,
    TermKind.SYNONYM: TERMS.synonym_weight,
    TermKind.LENT: TERMS.lent_weight,
    TermKind.HEAD: TERMS.head_weight,
    TermKind.LISTED: TERMS.listed_weight,
    TermKind.MODEL: TERMS.listed_weight,
    TermKind.CURATED: 1.0,
}


class Term(NamedTuple):
    """A term that names a class."""

    class_iri: ClassIRI
    text: str
    """Lower case, the last word in the singular."""
    kind: TermKind


class AlignedClass(NamedTuple):
    """A class that a synset is aligned with."""

    class_iri: ClassIRI
    weight: float
    """How far the synset is trusted to mean the class, 0 to 1."""


def term_key(text: str, taxonomy: Taxonomy) -> str:
    """Return the key of a label in `Lexicon.terms`: its words joined; empty if it has none."""
    return normalise_label(text, taxonomy).replace(" ", "")


def keep_best(terms: dict[str, Term], term: Term) -> None:
    """Add a term unless its text names a class with at least the same weight already."""
    key = term.text.replace(" ", "")
    if not key:
        return
    known = terms.get(key)
    # Callers pass classes from general to specific: at equal weight, the term of the more general class stays.
    if known is None or known.kind.weight < term.kind.weight:
        terms[key] = term
