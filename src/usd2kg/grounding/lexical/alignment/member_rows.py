"""Alignment rows from lists of class members, by a language model or shipped with usd2kg."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from usd2kg.grounding.lexical.alignment.alignment_rows import SHIPPED_LISTS, AlignmentRow, RowKind
from usd2kg.grounding.lexical.alignment.label_words import normalise_label
from usd2kg.grounding.lexical.alignment.terms import TermKind
from usd2kg.grounding.lexical.concepts.senses import usual_sense
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.settings import ALIGNMENT
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["ClassMembers", "rows_of_members"]


@dataclass(frozen=True, slots=True)
class ClassMembers:
    """The members of one class, as nouns.

    `notebook` is a noun in its usual sense, `notebook#2` in the second sense of the taxonomy, `notebook#0` in a sense
    that the taxonomy lacks.
    """

    class_iri: ClassIRI
    belongs: tuple[str, ...]
    """Nouns for things that belong to the class and to none of its subclasses."""
    excluded: tuple[str, ...]
    """Nouns for things that belong elsewhere."""


def rows_of_members(
    members: Sequence[ClassMembers], tool: str, tbox: TBox, taxonomy: Taxonomy
) -> Iterator[AlignmentRow]:
    """Yield a term for each noun, and a concept for its sense if the taxonomy has it.

    A noun of several classes belongs to the deepest of them, since lists of general classes also name things of their
    subclasses. The order of the rows does not matter when they are applied.

    Args:
        members: the lists.
        tool: who named the nouns: a model string, or `SHIPPED_LISTS`.
        tbox: the classes.
        taxonomy: the nouns.
    """
    terms: dict[str, ClassIRI] = {}
    meanings: dict[int, set[str]] = {}
    for one in members:
        for term, synset in _read_nouns(one.belongs, taxonomy):
            if term not in terms or tbox.depths[terms[term]] < tbox.depths[one.class_iri]:
                terms[term] = one.class_iri
            if synset is not None:
                meanings.setdefault(synset, set()).add(term)
    concepts = {
        synset: _class_of_most(named, terms, taxonomy.label(synset), tbox) for synset, named in meanings.items()
    }
    writer = _Writer(tool, taxonomy)
    yield from (writer.term(term, iri) for term, iri in terms.items())
    yield from (writer.concept(synset, iri) for synset, iri in concepts.items())
    for one in members:
        refused = set(_read_nouns(one.excluded, taxonomy))
        for term in sorted({term for term, _ in refused}):
            if terms.get(term) != one.class_iri:
                yield writer.term(term, one.class_iri, is_negated=True)
        for synset in sorted({synset for _, synset in refused if synset is not None}):
            if concepts.get(synset) != one.class_iri:
                yield writer.concept(synset, one.class_iri, is_negated=True)


def _read_nouns(nouns: Sequence[str], taxonomy: Taxonomy) -> Iterator[tuple[str, int | None]]:
    """Yield (term, synset or None) for each noun, without texts that have no words."""
    for noun in nouns:
        word, _, number = noun.partition("#")
        if not (term := normalise_label(word, taxonomy)):
            continue
        key = term.replace(" ", "")
        if number.isdecimal():
            sense = next(iter(taxonomy.senses(key)[int(number) - 1 : int(number)]), None)
        else:
            sense = usual_sense(key, taxonomy)
        yield term, sense.synset if sense is not None else None


def _class_of_most(named: set[str], terms: Mapping[str, ClassIRI], label: str, tbox: TBox) -> ClassIRI:
    """Return the class of most terms for a concept; on a tie, that of its label, then the deepest."""
    counts = Counter(terms[term] for term in named)
    return max(sorted(counts), key=lambda iri: (counts[iri], terms.get(label) == iri, tbox.depths[iri]))


class _Writer:
    """Creates rows with common fields."""

    def __init__(self, tool: str, taxonomy: Taxonomy) -> None:
        self._tool = tool
        self._taxonomy = taxonomy
        self._is_shipped = tool == SHIPPED_LISTS

    def term(self, term: str, iri: ClassIRI, *, is_negated: bool = False) -> AlignmentRow:
        """Return the row of a term and a class."""
        return self._row(RowKind.TERM, term, "", iri, is_negated)

    def concept(self, synset: int, iri: ClassIRI, *, is_negated: bool = False) -> AlignmentRow:
        """Return the row of a concept and a class."""
        subject, label = self._taxonomy.concept_iri(synset), self._taxonomy.label(synset)
        return self._row(RowKind.CONCEPT, subject, label, iri, is_negated)

    def _row(self, kind: RowKind, subject: str, label: str, iri: ClassIRI, is_negated: bool) -> AlignmentRow:
        verdict = f"{'does not belong' if is_negated else 'belongs'} to the class"
        return AlignmentRow(
            kind=kind,
            subject=subject,
            class_iri=iri,
            confidence=ALIGNMENT.listed_confidence if self._is_shipped else ALIGNMENT.model_confidence,
            label=label,
            reason=f"shipped: reviewed list, it {verdict}" if self._is_shipped else f"the model says that it {verdict}",
            term_kind=TermKind.LISTED if self._is_shipped else TermKind.MODEL,
            tool=self._tool,
            is_negated=is_negated,
        )
