"""Reviewed lists of members of the classes of public ontologies, shipped in `data/class_members.csv`."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from functools import cache

from usd2kg.grounding.lexical.alignment.alignment_rows import SHIPPED_LISTS, AlignmentRow, RowKind
from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.alignment.member_rows import ClassMembers, rows_of_members
from usd2kg.grounding.lexical.alignment.terms import TermKind
from usd2kg.grounding.lexical.concepts.senses import usual_sense
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.knowledge import read_rows, read_text, word_map
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["count_listed_classes", "shipped_rows"]

_TABLE = "class_members.csv"


def shipped_rows(tbox: TBox, lexicon: Lexicon, taxonomy: Taxonomy) -> list[AlignmentRow]:
    """Return the rows of the shipped lists for the classes of a TBox; none for most ontologies.

    Args:
        tbox: the classes, which are matched by IRI.
        lexicon: what their labels give.
        taxonomy: the nouns.
    """
    lists = _lists_for(tbox)
    if not lists:
        return []
    own = _OwnClasses(tbox, lexicon, taxonomy, lists)
    rows = rows_of_members(list(lists.values()), SHIPPED_LISTS, tbox, taxonomy)
    return [row for row in rows if row.is_negated or not own.names_more_specific(row)]


def count_listed_classes() -> Mapping[str, int]:
    """Return name of an ontology → number of its classes with a list."""
    return Counter(name for row in read_rows(_TABLE) for name in row["ontologies"].split("|"))


class _OwnClasses:
    """Classes without a list, such as those with which a user extends a public ontology."""

    def __init__(
        self, tbox: TBox, lexicon: Lexicon, taxonomy: Taxonomy, lists: Mapping[ClassIRI, ClassMembers]
    ) -> None:
        self._tbox = tbox
        self._taxonomy = taxonomy
        own = {iri for iri in tbox.by_iri.keys() - lists.keys() if not lists.keys().isdisjoint(tbox.closure(iri))}
        self._by_term = {
            key: term.class_iri
            for key, term in lexicon.terms.items()
            if term.kind is TermKind.LABEL and term.class_iri in own
        }
        self._by_synset = {
            synset: aligned.class_iri
            for synset, aligned in lexicon.sense_classes.items()
            if aligned.weight == 1.0 and aligned.class_iri in own
        }

    def names_more_specific(self, row: AlignmentRow) -> bool:
        """Return whether the label of such a subclass of a row's class means the row's noun or a hypernym.

        The lists do not know the subclass: where a user adds a class of vests below clothing, a safety vest is a vest.
        """
        return any(iri != row.class_iri and self._tbox.is_subclass(iri, row.class_iri) for iri in self._named(row))

    def _named(self, row: AlignmentRow) -> list[ClassIRI]:
        if row.kind is RowKind.CONCEPT:
            synset = self._taxonomy.find_concept(row.subject)
            words: list[str] = []
        else:
            words = row.subject.split()
            sense = usual_sense("".join(words), self._taxonomy)
            synset = sense.synset if sense is not None else None
        above = [up for up, _ in self._taxonomy.walk_up(synset)] if synset is not None else []
        keys = ["".join(words[start:]) for start in range(len(words))]
        return [
            *(self._by_term[key] for key in keys if key in self._by_term),
            *(self._by_synset[up] for up in above if up in self._by_synset),
        ]


def _lists_for(tbox: TBox) -> Mapping[ClassIRI, ClassMembers]:
    """Return the lists of the classes of a TBox; versions of an ontology with other namespaces share theirs."""
    versions = word_map("lexical", "namespace_versions")
    keys = {}
    for cls in tbox.classes:
        namespace = cls.iri.removesuffix(cls.local_name)
        keys[cls.iri] = versions.get(namespace, namespace), cls.local_name
    # Most ontologies have no list: a search is faster than parsing the table.
    text = read_text(_TABLE)
    if not any(f"\n{namespace}" in text for namespace in {namespace for namespace, _ in keys.values()}):
        return {}
    lists = _read_lists()
    found = {iri: lists.get(namespace + name) for iri, (namespace, name) in keys.items()}
    return {iri: replace(one, class_iri=iri) for iri, one in found.items() if one is not None}


@cache
def _read_lists() -> Mapping[ClassIRI, ClassMembers]:
    def nouns(cell: str) -> tuple[str, ...]:
        return tuple(filter(None, cell.split("|")))

    rows = read_rows(_TABLE)
    return {row["class"]: ClassMembers(row["class"], nouns(row["things"]), nouns(row["not_things"])) for row in rows}
