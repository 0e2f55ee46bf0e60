"""The alignment of a TBox with concepts and terms as a file: SSSOM/TSV that a person can read and edit."""

import hashlib
import logging
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain
from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.grounding.lexical.alignment.alignment_rows import (
    AlignmentRow,
    RowKind,
    format_rows,
    parse_rows,
    written_class,
)
from usd2kg.grounding.lexical.alignment.default_root import (
    NO_CLASS_IRI,
    build_rooted_lexicon,
    root_synonyms,
    with_root,
)
from usd2kg.grounding.lexical.alignment.lexicon import CategoryMember, Lexicon, home_classes_of, make_lexicon
from usd2kg.grounding.lexical.alignment.terms import AlignedClass, Term, TermKind, term_key
from usd2kg.grounding.lexical.concepts.senses import usual_sense
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["AlignmentFile", "format_alignment", "read_alignment_file"]

logger = logging.getLogger(__name__)


def format_alignment(rooted: TBox, lexicon: Lexicon, taxonomy: Taxonomy, others: Iterable[AlignmentRow] = ()) -> str:
    """Return a lexicon as SSSOM/TSV, ordered by class; `AlignmentFile.apply` builds the same lexicon from it.

    Args:
        rooted: the TBox, as `build_rooted_lexicon` returns it.
        lexicon: its lexicon.
        taxonomy: the concepts.
        others: further rows, such as a language model's.
    """
    rows = sorted(
        chain(_term_rows(lexicon), _concept_rows(lexicon, taxonomy), _category_rows(lexicon, taxonomy), others),
        key=lambda row: (row.class_iri, [*RowKind].index(row.kind), row.label or row.subject, row.subject, row.model),
    )
    assert lexicon.default_class is not None, "a rooted TBox has a default class"
    return format_rows(rows, rooted, lexicon.default_class)


_TERM_REASONS = {
    TermKind.LABEL: "the label of the class",
    TermKind.SYNONYM: "a name for objects of the class",
    TermKind.LENT: "a name of the home vocabulary for a class with this label",
    TermKind.HEAD: "the head noun of the label",
    TermKind.MODEL: "a name by a language model",
    TermKind.CURATED: "a name chosen by a person",
}
_OTHER_REASON = "same meaning as a label, or no more specific class"


def _term_rows(lexicon: Lexicon) -> Iterator[AlignmentRow]:
    for term in lexicon.terms.values():
        yield AlignmentRow(
            kind=RowKind.TERM,
            subject=term.text,
            class_iri=term.class_iri,
            confidence=term.kind.weight,
            reason=_TERM_REASONS[term.kind],
            term_kind=term.kind,
            is_kind=_is_kind(term, lexicon),
        )


def _is_kind(term: Term, lexicon: Lexicon) -> bool:
    """Return whether a term names a kind of the class: the home vocabulary lists kinds, not synonyms."""
    is_home_name = term.kind is TermKind.SYNONYM and term.class_iri in lexicon.home_classes
    return is_home_name or term.kind is TermKind.LENT


def _concept_rows(lexicon: Lexicon, taxonomy: Taxonomy) -> Iterator[AlignmentRow]:
    named: dict[tuple[int, ClassIRI], tuple[Term, str]] = {}
    for key, term in lexicon.terms.items():
        senses = taxonomy.senses(key)
        for number, sense in enumerate(senses, start=1):
            which = f", sense {number} of {len(senses)}" if len(senses) > 1 else ""
            pair = sense.synset, term.class_iri
            if term.kind is TermKind.LABEL or pair not in named:
                named[pair] = term, f"“{term.text}” is {_TERM_REASONS[term.kind]}{which}"
    for synset, aligned in lexicon.sense_classes.items():
        own, reason = named.get((synset, aligned.class_iri), (None, _OTHER_REASON))
        yield AlignmentRow(
            kind=RowKind.CONCEPT,
            subject=taxonomy.concept_iri(synset),
            class_iri=aligned.class_iri,
            confidence=aligned.weight,
            label=taxonomy.label(synset),
            reason=reason,
            is_kind=own is not None and _is_kind(own, lexicon),
        )


def _category_rows(lexicon: Lexicon, taxonomy: Taxonomy) -> Iterator[AlignmentRow]:
    for synset, members in lexicon.category_members.items():
        for member in members:
            yield AlignmentRow(
                kind=RowKind.CATEGORY,
                subject=taxonomy.concept_iri(synset),
                class_iri=member.aligned.class_iri,
                confidence=member.aligned.weight,
                label=taxonomy.label(synset),
                reason=f"counts among it in common usage, with {member.synset_count - 1} other concepts",
                category_size=member.synset_count,
            )


@dataclass(frozen=True)
class AlignmentFile:
    """An alignment as it was read; equal if its content is."""

    path: Path = field(compare=False)
    text: str

    @property
    def digest(self) -> str:
        """`sha256:` and the hash of the content."""
        return f"sha256:{hashlib.sha256(self.text.encode()).hexdigest()}"

    def apply(
        self, tbox: TBox, taxonomy: Taxonomy, synonyms: Mapping[ClassIRI, tuple[str, ...]]
    ) -> tuple[TBox, Lexicon]:
        """Return the TBox below one class that is true of most objects, and its lexicon by the file.

        A file without `default_class` in its header changes the alignment that is built. Rows of a person come last.

        Raises:
            GroundingError: the file is malformed, or names a class or concept that does not exist.
        """
        default, content_hash, rows = parse_rows(self.path, self.text, tbox)
        if default is None:
            rooted, lexicon = build_rooted_lexicon(tbox, taxonomy, synonyms)
            editor = _Editor(self.path, rooted, taxonomy, lexicon)
            edits: Sequence[AlignmentRow] = rows
        else:
            if content_hash and content_hash != tbox.content_hash:
                problem = "was written for another version of the ontology, so classes that are new have no rows"
                advice = "write it again with usd2kg ontology align, and copy the rows of people into it"
                logger.warning("%s: %s; %s", self.path, problem, advice)
            if all(map(_is_decided, rows)):
                problem = "has a default_class, so it replaces the alignment that is built, but has none of its rows"
                advice = "delete the line default_class to change the alignment that is built"
                logger.warning("%s: %s; %s", self.path, problem, advice)
            rooted = with_root(tbox, default, taxonomy)
            home = home_classes_of(rooted, root_synonyms(rooted, synonyms))
            editor = _Editor(self.path, rooted, taxonomy, make_lexicon(rooted, {}, {}, {}, default, home))
            editor.add_all(row for row in rows if not _is_decided(row))
            edits = [row for row in rows if _is_decided(row)]
        # A person has the last word.
        editor.edit_all(sorted(edits, key=lambda row: not _is_by_model(row)))
        return rooted, editor.lexicon()


def read_alignment_file(path: Path) -> AlignmentFile:
    """Return an alignment file; `AlignmentFile.apply` parses it.

    Raises:
        GroundingError: the file cannot be read as text.
    """
    try:
        return AlignmentFile(path, path.read_text("utf-8-sig"))
    except (OSError, UnicodeDecodeError) as error:
        raise GroundingError(
            f"{path}: cannot be read as an alignment ({error}); expected a file of usd2kg ontology align"
        ) from error


def _is_decided(row: AlignmentRow) -> bool:
    return row.is_curated or row.is_negated or bool(row.model)


def _is_by_model(row: AlignmentRow) -> bool:
    return bool(row.model) and not row.is_curated


class _Editor:
    """Adds rows to a lexicon."""

    def __init__(self, path: Path, tbox: TBox, taxonomy: Taxonomy, lexicon: Lexicon) -> None:
        self._path = path
        self._tbox = tbox
        self._taxonomy = taxonomy
        self._lexicon = lexicon
        self._terms = dict(lexicon.terms)
        self._sense_classes = dict(lexicon.sense_classes)
        self._curated = set(lexicon.curated_synsets)
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
        return replace(found, curated_synsets=frozenset(self._curated))

    def add_all(self, rows: Iterator[AlignmentRow]) -> None:
        """Add rows that were built: each replaces what the file has for the subject before it."""
        for row in rows:
            self._check_class(row)
            if row.kind is RowKind.TERM:
                self._terms[row.subject.replace(" ", "")] = Term(row.class_iri, row.subject, row.term_kind)
            elif row.kind is RowKind.CONCEPT:
                self._sense_classes[self._synset(row)] = AlignedClass(row.class_iri, row.confidence)
            else:
                self._add_member(row)

    def edit_all(self, rows: Sequence[AlignmentRow]) -> None:
        """Add rows of a person, which take precedence over what was built."""
        for row in rows:
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
        if _is_by_model(row) and known is not None and known.kind is TermKind.LABEL:
            return
        if row.is_negated:
            if known is not None and known.class_iri == row.class_iri:
                del self._terms[key]
        else:
            kind = TermKind.MODEL if _is_by_model(row) else TermKind.CURATED
            self._terms[key] = Term(row.class_iri, row.subject, kind)

    def _remove_concept(self, row: AlignmentRow) -> None:
        synset = self._synset(row)
        known = self._sense_classes.get(synset)
        if known is not None and known.class_iri == row.class_iri and not (_is_by_model(row) and known.weight == 1.0):
            del self._sense_classes[synset]
        members = self._members.get(synset, [])
        self._members[synset] = [member for member in members if member.aligned.class_iri != row.class_iri]

    def _edit_concept(self, row: AlignmentRow) -> None:
        """Align a concept. If a person did, names that mean it or a concept below it no longer lead elsewhere."""
        synset = self._synset(row)
        known = self._sense_classes.get(synset)
        if _is_by_model(row) and known is not None and known.weight == 1.0:
            return
        self._sense_classes[synset] = AlignedClass(row.class_iri, row.confidence)
        self._members.pop(synset, None)
        if _is_by_model(row):
            return
        self._curated.add(synset)
        for key, own in self._terms_below.get(synset, ()):
            term = self._terms.get(key)
            is_kept = term is None or term.kind in {TermKind.LABEL, TermKind.CURATED}
            if term is None or is_kept or self._tbox.is_subclass(term.class_iri, row.class_iri):
                continue
            del self._terms[key]
            self._unalign_below(own, term.class_iri)

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
                f"{self._path}: line {row.line}: the class is {written_class(row.class_iri)}, but the ontology has a "
                "class for all objects; expected a class, or the predicate modifier Not"
            )

    def _synset(self, row: AlignmentRow) -> int:
        synset = self._taxonomy.find_concept(row.subject)
        if synset is None:
            raise GroundingError(
                f"{self._path}: line {row.line}: {row.subject!r} is no known concept; expected a synset of WordNet "
                "3.1, like wn:02873453-n, or leave subject_id empty and name a term in subject_label"
            )
        return synset
