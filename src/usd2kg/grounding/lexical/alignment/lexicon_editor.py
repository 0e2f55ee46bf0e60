"""Apply rows of an alignment to a lexicon: those of a file, of lists of members, and of people."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property

from usd2kg.errors import GroundingError
from usd2kg.grounding.lexical.alignment.alignment_rows import SHIPPED_LISTS, AlignmentRow, RowKind, written_class
from usd2kg.grounding.lexical.alignment.artificial_root import NO_CLASS_IRI
from usd2kg.grounding.lexical.alignment.lexicon import CategoryMember, Lexicon, make_lexicon
from usd2kg.grounding.lexical.alignment.terms import AlignedClass, Term, TermKind, term_key
from usd2kg.grounding.lexical.concepts.senses import usual_sense
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["LexiconEditor"]


class LexiconEditor:
    """Adds rows to a lexicon."""

    def __init__(self, source: str, tbox: TBox, taxonomy: Taxonomy, lexicon: Lexicon) -> None:
        """Create an editor of a copy of a lexicon; `source` names the rows in error messages."""
        self._source = source
        self._tbox = tbox
        self._taxonomy = taxonomy
        self._lexicon = lexicon
        self._terms = dict(lexicon.terms)
        self._sense_classes = dict(lexicon.sense_classes)
        self._curated = set(lexicon.curated_synsets)
        self._listed = set(lexicon.listed_synsets)
        self._shipped: set[int] = set()
        """Those of `_listed` by shipped lists."""
        self._excluded = {synset: set(classes) for synset, classes in lexicon.excluded_classes.items()}
        self._members = {synset: [*members] for synset, members in lexicon.category_members.items()}

    def lexicon(self) -> Lexicon:
        """Return the lexicon with all rows."""
        found = make_lexicon(
            self._tbox,
            self._terms,
            self._sense_classes,
            {synset: members for synset, members in self._members.items() if members},
            self._lexicon.default_class,
            self._lexicon.home_classes,
        )
        return replace(
            found,
            curated_synsets=frozenset(self._curated),
            listed_synsets=frozenset(self._listed),
            excluded_classes={synset: frozenset(classes) for synset, classes in self._excluded.items() if classes},
        )

    def add_all(self, rows: Iterator[AlignmentRow]) -> None:
        """Add built rows: each replaces an earlier row for the same subject."""
        for row in rows:
            self._check_class(row)
            if row.kind is RowKind.TERM:
                self._terms[row.subject.replace(" ", "")] = Term(row.class_iri, row.subject, row.term_kind)
            elif row.kind is RowKind.CONCEPT:
                self._sense_classes[self._synset(row)] = AlignedClass(row.class_iri, row.confidence)
            else:
                self._add_member(row)

    def edit_all(self, rows: Iterable[AlignmentRow]) -> None:
        """Add rows that take precedence over built rows: from shipped lists, then from models, then from people."""
        for row in sorted(rows, key=_order):
            self._check_class(row)
            if row.kind is RowKind.TERM:
                self._edit_term(row)
            elif row.is_negated:
                self._remove_concept(row)
            elif row.kind is RowKind.CONCEPT:
                self._edit_concept(row)
            else:
                self._add_member(row)

    def _edit_term(self, row: AlignmentRow) -> None:
        key = term_key(row.subject, self._taxonomy)
        known = self._terms.get(key)
        if known is not None and self._is_kept(known.class_iri, _authority_of_term(known), row):
            return
        if not row.is_negated:
            self._terms[key] = Term(row.class_iri, row.subject, _TERM_KINDS[_authority(row)])
        elif known is not None and known.class_iri == row.class_iri:
            del self._terms[key]

    def _is_kept(self, known: ClassIRI, authority: int, row: AlignmentRow) -> bool:
        """Return whether a subject keeps its class: the higher authority decides, or a model by a subclass."""
        is_narrower = row.class_iri != known and self._tbox.is_subclass(row.class_iri, known)
        return authority > _authority(row) and not (authority == _SHIPPED and is_narrower)

    def _remove_concept(self, row: AlignmentRow) -> None:
        synset = self._synset(row)
        known = self._sense_classes.get(synset)
        if known is not None and known.class_iri == row.class_iri:
            if self._keeps_concept(row, synset, known):
                return
            del self._sense_classes[synset]
            self._listed.discard(synset)
        self._exclude(synset, row.class_iri)
        members = self._members.get(synset, [])
        self._members[synset] = [member for member in members if member.aligned.class_iri != row.class_iri]

    def _exclude(self, synset: int, class_iri: ClassIRI) -> None:
        self._excluded.setdefault(synset, set()).add(class_iri)

    def _keeps_concept(self, row: AlignmentRow, synset: int, known: AlignedClass) -> bool:
        authority = _LABEL if known.weight == 1.0 else _SHIPPED if synset in self._shipped else _BUILT
        return self._is_kept(known.class_iri, authority, row)

    def _edit_concept(self, row: AlignmentRow) -> None:
        """Align a concept. If a person did, names that mean it or a concept below it no longer lead elsewhere."""
        synset = self._synset(row)
        known = self._sense_classes.get(synset)
        if known is not None and self._keeps_concept(row, synset, known):
            return
        self._sense_classes[synset] = AlignedClass(row.class_iri, row.confidence)
        self._members.pop(synset, None)
        self._excluded.get(synset, set()).discard(row.class_iri)
        if _is_by_tool(row):
            self._listed.add(synset)
            if _authority(row) == _SHIPPED:
                self._shipped.add(synset)
            return
        self._listed.discard(synset)
        self._curated.add(synset)
        self._lift_exclusions(synset, row.class_iri)
        for key, own in self._terms_below.get(synset, ()):
            term = self._terms.get(key)
            is_kept = term is None or term.kind in {TermKind.LABEL, TermKind.CURATED}
            if term is None or is_kept or self._tbox.is_subclass(term.class_iri, row.class_iri):
                continue
            del self._terms[key]
            self._unalign_below(own, term.class_iri)

    def _lift_exclusions(self, synset: int, class_iri: ClassIRI) -> None:
        """Let a synset and all that is below it belong to a class."""
        for own, classes in self._excluded.items():
            if class_iri in classes and any(up == synset for up, _ in self._taxonomy.walk_up(own)):
                classes.discard(class_iri)

    @cached_property
    def _terms_below(self) -> Mapping[int, Sequence[tuple[str, int]]]:
        """Synset → (key, usual synset) of the terms that mean it or a hyponym."""
        below: dict[int, list[tuple[str, int]]] = {}
        for key in self._terms:
            if (sense := usual_sense(key, self._taxonomy)) is not None:
                for up, _ in self._taxonomy.walk_up(sense.synset):
                    below.setdefault(up, []).append((key, sense.synset))
        return below

    def _unalign_below(self, synset: int, class_iri: ClassIRI) -> None:
        known = self._sense_classes.get(synset)
        if known is not None and known.class_iri == class_iri:
            del self._sense_classes[synset]

    def _add_member(self, row: AlignmentRow) -> None:
        member = CategoryMember(AlignedClass(row.class_iri, row.confidence), max(1, row.category_size))
        self._members.setdefault(self._synset(row), []).append(member)

    def _check_class(self, row: AlignmentRow) -> None:
        if row.class_iri == NO_CLASS_IRI and NO_CLASS_IRI not in self._tbox.by_iri:
            raise GroundingError(
                f"{self._source}: line {row.line}: the class is {written_class(row.class_iri)}, but the ontology has a "
                "class for all objects; expected a class, or the predicate modifier Not"
            )

    def _synset(self, row: AlignmentRow) -> int:
        synset = self._taxonomy.find_concept(row.subject)
        if synset is None:
            raise GroundingError(
                f"{self._source}: line {row.line}: {row.subject!r} is not a known concept; expected a synset of "
                "WordNet 3.1, like wn:02873453-n, or leave subject_id empty and name a term in subject_label"
            )
        return synset


_BUILT, _MODEL, _SHIPPED, _LABEL, _PERSON = range(5)
"""Who decided, in ascending authority."""
_TERM_KINDS = {_MODEL: TermKind.MODEL, _SHIPPED: TermKind.LISTED, _PERSON: TermKind.CURATED}


def _order(row: AlignmentRow) -> int:
    # A model is asked after the lists are known, and may only add to them.
    return (_SHIPPED, _MODEL, _PERSON).index(_authority(row))


def _authority(row: AlignmentRow) -> int:
    if not _is_by_tool(row):
        return _PERSON
    return _SHIPPED if row.tool == SHIPPED_LISTS else _MODEL


def _authority_of_term(term: Term) -> int:
    return {TermKind.LABEL: _LABEL, TermKind.LISTED: _SHIPPED}.get(term.kind, _BUILT)


def _is_by_tool(row: AlignmentRow) -> bool:
    return bool(row.tool) and not row.is_curated
