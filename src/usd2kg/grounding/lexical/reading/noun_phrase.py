"""Read a prim name as a noun phrase: its words in English, the head noun last."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import pairwise, takewhile

from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.reading.copy_numbers import without_copy_numbers
from usd2kg.grounding.lexical.reading.shortening import usual_abbreviations
from usd2kg.grounding.lexical.reading.spelling import SpellingCorrector
from usd2kg.grounding.lexical.reading.tokens import Token, is_compound_part, is_reference, parent_tokens, tokens_of
from usd2kg.grounding.lexical.reading.word_kinds import WordKinds
from usd2kg.grounding.lexical.settings import READING, SPELLING
from usd2kg.knowledge import word_set
from usd2kg.languages import language_of, translate
from usd2kg.words import is_content_word

__all__ = ["NamePhrase", "NameReader"]

_WITH_WORDS = word_set("lexical", "with_words")
_PREPOSITIONS = word_set("lexical", "prepositions")


@dataclass(frozen=True, slots=True)
class NamePhrase:
    """The words of a name."""

    words: tuple[str, ...]
    """Lower case; usually modifiers first and the head noun last. Empty if the name has no words."""
    context: tuple[str, ...] = ()
    """Words that refer to the parent or place: `cabinet10` in `cabinet10_drawer`."""
    corrections: tuple[tuple[str, str], ...] = ()
    """(as written, as read) of the words that were corrected, split or translated."""
    glued: tuple[bool, ...] = field(default=(), compare=False)
    """For each word whether it follows without a separator, as in `RoomWindow`; empty if unknown."""
    is_head_last: bool = field(default=False, compare=False)
    """Whether the last word is certainly the head noun: the name is translated from a language that puts it first."""

    def is_glued(self, at: int) -> bool:
        """Return whether the word at an index follows without a separator."""
        return at < len(self.glued) and self.glued[at]

    def glued_on(self, at: int) -> int:
        """Return the number of words from an index on that follow without a separator."""
        return sum(1 for _ in takewhile(bool, self.glued[at:]))


class NameReader:
    """Reads names with one lexicon and the taxonomy."""

    def __init__(self, lexicon: Lexicon, taxonomy: Taxonomy) -> None:
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self.kinds = WordKinds(lexicon, taxonomy)
        self._spelling = SpellingCorrector(lexicon, taxonomy, self.kinds)
        self._read_equalized = lru_cache(maxsize=16384)(self._read)
        self._tokens = lru_cache(maxsize=4096)(self._find_tokens)
        # Most names do not refer to the prims above.
        self._read_tokens = lru_cache(maxsize=16384)(self._compute_phrase)

    def read(self, name: str, parents: tuple[str, ...] = ()) -> NamePhrase:
        """Return the phrase of a name below other names, outermost first."""
        return self._read_equalized(*self.equalize(name, parents))

    def equalize(self, name: str, parents: tuple[str, ...]) -> tuple[str, tuple[str, ...]]:
        """Return a name and the names above as `without_copy_numbers` does; unchanged if numbers have a meaning."""
        return (name, parents) if self._digits_in_terms else without_copy_numbers(name, parents)

    def _read(self, name: str, parents: tuple[str, ...]) -> NamePhrase:
        tokens, references = self._split_references(self._tokens(name), parents)
        return self._read_tokens(tuple(Token(token.text, "", token.is_glued) for token in tokens), _texts(references))

    def _find_tokens(self, name: str) -> list[Token]:
        """Return the tokens of a name that may describe an object."""
        return self._content_tokens(self._cut_additions(tokens_of(name)))[: READING.max_words]

    def _compute_phrase(self, tokens: tuple[Token, ...], references: tuple[str, ...]) -> NamePhrase:
        """Return the phrase of a name.

        Args:
            tokens: its own tokens without numbers.
            references: the texts of the tokens that refer to a prim above.
        """
        translated = self._translate(_texts(tokens))
        if translated is not None:
            return _translation(_texts(tokens), translated, context=references)
        # An abbreviation among unknown words is left to the abbreviation reader, which knows the stage's words.
        others = [token.text for token in tokens if token.text not in usual_abbreviations()]
        is_spelled_out = any(map(self.kinds.is_known, others)) if others else len(tokens) > 1
        words: list[str] = []
        glued: list[bool] = []
        corrections: list[tuple[str, str]] = []
        last_object = self._index_of_last_object(tokens)
        for at, token in enumerate(tokens):
            # Before a word that names an object, an unknown word is rather a name: `robomaker_bucket` has no robomower.
            max_edits = 1 if at < last_object else SPELLING.max_edits
            correct = self._spell_out if is_spelled_out else self._spelling.correct
            read = correct(token.text, max_edits)
            words.extend(read)
            glued.extend([token.is_glued, *[True] * (len(read) - 1)])
            if read not in {(token.text,), (self._taxonomy.singular(token.text),)}:
                corrections.append((token.text, " ".join(read)))
        context = tuple(word for text in references for word in self._spell_out(text, SPELLING.max_edits))
        return NamePhrase(tuple(words), context, tuple(corrections), tuple(glued))

    def phrase(self, words: tuple[str, ...]) -> NamePhrase:
        """Return the phrase of words that are spelled out, in any language."""
        translated = self._translate(words)
        return NamePhrase(words) if translated is None else _translation(words, translated)

    def names_known_noun(self, name: str) -> bool:
        """Return whether the last word of a name is a noun that the taxonomy knows, and not a modifier."""
        words = self.read(name).words
        if not words or len(words[-1]) < READING.min_noun_letters:
            return False
        return not self.kinds.is_modifier(words[-1]) and self.kinds.is_noun(words[-1])

    def _cut_additions(self, tokens: list[Token]) -> list[Token]:
        """Return the tokens before a preposition, if they name an object: `toy_bin_w_lid`, `towel_on_rack`."""
        for at in range(1, len(tokens)):
            is_cut = self._begins_attribute(tokens, at) or self._begins_location(tokens, at)
            if is_cut and any(is_content_word(token.text) for token in tokens[at + 1 :]):
                return tokens[:at]
        return tokens

    def _begins_attribute(self, tokens: list[Token], at: int) -> bool:
        is_with = tokens[at].text in _WITH_WORDS
        return is_with and any(self.kinds.is_object(self._taxonomy.singular(token.text)) for token in tokens[:at])

    def _begins_location(self, tokens: list[Token], at: int) -> bool:
        before = tokens[at - 1].text
        if tokens[at].text not in _PREPOSITIONS or before in self._taxonomy.adjectives:
            return False
        is_compound = "".join(token.text for token in tokens[at - 1 : at + 2]) in self._taxonomy
        return (
            self.kinds.is_noun(self._taxonomy.singular(before))
            and not is_compound
            and not self._term_around(tokens, at)
        )

    def _content_tokens(self, tokens: list[Token]) -> list[Token]:
        """Return the tokens without pipeline tokens (`low`, `test`), unless a term contains them: `TestTube`."""
        kept = {at for at, token in enumerate(tokens) if is_content_word(token.text)}
        for at in range(min(len(tokens), READING.max_words)):
            if at not in kept and self._may_be_in_term(tokens[at].text):
                kept.update(self._term_around(tokens, at))
        return [tokens[at] for at in sorted(kept)]

    def _may_be_in_term(self, text: str) -> bool:
        return not text.isdecimal() or text in self._digits_in_terms

    @cached_property
    def _digits_in_terms(self) -> str:
        return " ".join(re.findall(r"\d+", " ".join(self._lexicon.terms)))

    def _term_around(self, tokens: list[Token], at: int) -> range:
        """Return the indices of the longest term of several tokens that contains one; empty if there is none."""
        most = READING.max_term_words
        runs = [
            range(start, end)
            for start in range(max(0, at - most), at + 1)
            for end in range(at + 1, min(len(tokens), start + most) + 1)
            # `A_rt`, the right side of A, is not art.
            if end - start > 1 and any(len(token.text) >= READING.min_noun_letters for token in tokens[start:end])
        ]
        terms = [run for run in runs if "".join(tokens[i].text for i in run) in self._lexicon.terms]
        return max(terms, key=len, default=range(0))

    def _index_of_last_object(self, tokens: Sequence[Token]) -> int:
        """Return the index of the last token that names an object as it stands; -1 if there is none."""
        return next((at for at in reversed(range(len(tokens))) if self._names_object(tokens[at].text)), -1)

    def _names_object(self, word: str) -> bool:
        singular = self._taxonomy.singular(word)
        return len(singular) >= READING.min_noun_letters and self.kinds.is_object(singular)

    def _spell_out(self, word: str, max_edits: int) -> tuple[str, ...]:
        """Return a word as known words, with a common abbreviation in full: the knife of a `butter_knf`."""
        usual = usual_abbreviations().get(word)
        if usual is not None and word not in self._lexicon.terms:
            return tuple(usual.split())
        return self._spelling.correct(word, max_edits)

    def _translate(self, words: tuple[str, ...]) -> tuple[str, ...] | None:
        """Return a name in English, head noun last; None if it is English or a term of the TBox."""
        is_english = all(word in self._taxonomy or word in self._taxonomy.adjectives for word in words)
        # Loans such as “chaise longue” are compounds of the taxonomy.
        is_loan = any("".join(pair) in self._taxonomy for pair in pairwise(words))
        if is_english or is_loan or "".join(words) in self._lexicon.terms:
            return None
        return translate(words)

    def _split_references(self, tokens: list[Token], parents: tuple[str, ...]) -> tuple[list[Token], list[Token]]:
        """Return the object's own tokens, and those that refer to a prim above."""
        written = {token.text for token in tokens}
        above: set[tuple[str, str]] = set()
        for parent in map(parent_tokens, parents):
            # A name refers to a parent by all its words or by a number: a `breadKnife` below `knifeBlock` is a knife.
            is_whole = parent.content <= written
            above.update(parent.numbered if is_whole else (token for token in parent.numbered if token[1]))
        references = [token for token in tokens if above and is_reference(token, above)]
        if not references:
            return tokens, []
        # Below `Mug` a `coffee_mug` is a mug, not a coffee.
        pairs = [pair for pair in pairwise(tokens) if self._is_term(pair)]
        references = [
            token
            for token in references
            if token.number or not any(is_compound_part(token, pair, references) for pair in pairs)
        ]
        own = [token for token in tokens if token not in references]
        if all(self.kinds.may_modify_parent(word) for token in own for word in self._spelling.correct(token.text)):
            return tokens, []
        return own, references

    def _is_term(self, pair: tuple[Token, Token]) -> bool:
        return pair[0].text + self._taxonomy.singular(pair[1].text) in self._lexicon.terms


def _texts(tokens: Sequence[Token]) -> tuple[str, ...]:
    return tuple(token.text for token in tokens)


def _translation(words: tuple[str, ...], english: tuple[str, ...], context: tuple[str, ...] = ()) -> NamePhrase:
    corrections = ((" ".join(words), " ".join(english)),)
    return NamePhrase(english, context, corrections, is_head_last=language_of(words) != "de")
