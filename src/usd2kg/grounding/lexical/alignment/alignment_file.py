"""The alignment of a TBox with concepts and terms as a file: SSSOM/TSV that a person can read and edit."""

import hashlib
import logging
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.grounding.lexical.alignment.alignment_rows import (
    AlignmentRow,
    RowKind,
    format_rows,
    parse_rows,
)
from usd2kg.grounding.lexical.alignment.artificial_root import root_synonyms, with_root
from usd2kg.grounding.lexical.alignment.built_alignment import build_alignment
from usd2kg.grounding.lexical.alignment.lexicon import Lexicon, home_classes_of, make_lexicon
from usd2kg.grounding.lexical.alignment.lexicon_editor import LexiconEditor
from usd2kg.grounding.lexical.alignment.terms import Term, TermKind, term_key
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
        key=lambda row: (row.class_iri, [*RowKind].index(row.kind), row.label or row.subject, row.subject, row.tool),
    )
    assert lexicon.default_class is not None, "a rooted TBox has a default class"
    return format_rows(rows, rooted, lexicon.default_class)


_TERM_REASONS = {
    TermKind.LABEL: "the label of the class",
    TermKind.SYNONYM: "a name for objects of the class",
    TermKind.LENT: "a name of the home vocabulary for a class with this label",
    TermKind.HEAD: "the head noun of the label",
    TermKind.LISTED: "a name of a shipped list",
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
        self,
        tbox: TBox,
        taxonomy: Taxonomy,
        synonyms: Mapping[ClassIRI, tuple[str, ...]],
        *,
        use_lists: bool = True,
    ) -> tuple[TBox, Lexicon]:
        """Return the TBox with an artificial root that applies to most objects, and its lexicon from the file.

        A file without `default_class` in its header changes the alignment that is built, with the shipped lists if
        `use_lists`. Rows of a person come last.

        Raises:
            GroundingError: the file is malformed, or names a class or concept that does not exist.
        """
        default, content_hash, rows = parse_rows(self.path, self.text, tbox)
        self._warn_of_other_nouns(rows, taxonomy)
        if default is None:
            built = build_alignment(tbox, taxonomy, synonyms, use_lists=use_lists)
            return built.tbox, built.edited(taxonomy, rows, str(self.path))
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
        editor = LexiconEditor(str(self.path), rooted, taxonomy, make_lexicon(rooted, {}, {}, {}, default, home))
        editor.add_all(row for row in rows if not _is_decided(row))
        editor.edit_all(row for row in rows if _is_decided(row))
        return rooted, editor.lexicon()

    def _warn_of_other_nouns(self, rows: Iterable[AlignmentRow], taxonomy: Taxonomy) -> None:
        """Warn of a person's rows whose label is no noun for their concept: the concept decides."""
        for row in rows:
            if row.kind is RowKind.CONCEPT and row.is_curated and row.label:
                nouns = {taxonomy.concept_iri(sense.synset) for sense in taxonomy.senses(term_key(row.label, taxonomy))}
                if nouns and row.subject not in nouns:
                    problem = f"line {row.line}: “{row.label}” is no noun for {row.subject}, which the row is about"
                    logger.warning("%s: %s; correct one of them", self.path, problem)


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
    return row.is_curated or row.is_negated or bool(row.tool)
