"""Building of the alignment of a TBox with concepts and terms, when none is read from a file."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from usd2kg.grounding.lexical.alignment.alignment_rows import SHIPPED_LISTS, AlignmentRow
from usd2kg.grounding.lexical.alignment.artificial_root import build_rooted_lexicon
from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.alignment.lexicon_editor import LexiconEditor
from usd2kg.grounding.lexical.alignment.member_lists import shipped_rows
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["BuiltAlignment", "build_alignment"]


@dataclass(frozen=True, slots=True)
class BuiltAlignment:
    """What labels, synonyms and the shipped lists give."""

    tbox: TBox
    """The classes below the artificial root."""
    lexicon: Lexicon
    """By labels and synonyms alone."""
    rows: Sequence[AlignmentRow]
    """Of the shipped lists."""

    def edited(self, taxonomy: Taxonomy, edits: Sequence[AlignmentRow] = (), source: str = SHIPPED_LISTS) -> Lexicon:
        """Return the lexicon with the rows of the lists, and further rows.

        Args:
            taxonomy: the concepts.
            edits: rows of models and people, which come after the lists.
            source: where `edits` come from, for error messages.

        Raises:
            GroundingError: an edit names a class or concept that does not exist.
        """
        rows = [*self.rows, *edits]
        if not rows:
            return self.lexicon
        editor = LexiconEditor(source, self.tbox, taxonomy, self.lexicon)
        editor.edit_all(rows)
        return editor.lexicon()


def build_alignment(
    tbox: TBox, taxonomy: Taxonomy, synonyms: Mapping[ClassIRI, tuple[str, ...]], *, use_lists: bool = True
) -> BuiltAlignment:
    """Return the alignment of a TBox.

    Args:
        tbox: the classes.
        taxonomy: the concepts.
        synonyms: class IRI → names in addition to the TBox's own labels.
        use_lists: whether the lists of what belongs to a class that usd2kg ships count.
    """
    rooted, lexicon = build_rooted_lexicon(tbox, taxonomy, synonyms)
    return BuiltAlignment(rooted, lexicon, shipped_rows(rooted, lexicon, taxonomy) if use_lists else ())
