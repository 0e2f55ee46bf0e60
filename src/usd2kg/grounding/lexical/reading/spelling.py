"""Read a token as known words: as it stands, singular, split, with missing vowels, or with corrected spelling."""

from functools import cached_property, lru_cache
from itertools import chain

from rapidfuzz import process
from rapidfuzz.distance import OSA

from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.reading.english_words import is_english_word
from usd2kg.grounding.lexical.reading.shortening import consonants_of
from usd2kg.grounding.lexical.reading.word_frequencies import log_prior
from usd2kg.grounding.lexical.reading.word_kinds import PLACEMENTS, THING_DOMAINS, WordKinds
from usd2kg.grounding.lexical.settings import SPELLING
from usd2kg.words import is_content_word

__all__ = ["SpellingCorrector"]


class SpellingCorrector:
    """Corrects spelling towards the words of one lexicon and the taxonomy."""

    def __init__(self, lexicon: Lexicon, taxonomy: Taxonomy, kinds: WordKinds) -> None:
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._kinds = kinds
        self.correct = lru_cache(maxsize=16384)(self._correct)
        """(lower-case token, edits allowed at most) → known words; the token itself if none are similar enough."""

    def _correct(self, word: str, max_edits: int = SPELLING.max_edits) -> tuple[str, ...]:
        if self._kinds.is_known(word):
            return self._words_of_term(word)
        singular = self._taxonomy.singular(word)
        if singular != word:
            return (singular,)
        is_english = is_english_word(word)
        # One wrong letter in a long word is more likely than two joined words.
        slip = self._respell(word, 1) if len(word) >= SPELLING.min_long_letters and not is_english else None
        found = slip or self._restore_vowels(word) or self._split(word)
        if found is None and not is_english:
            found = self._respell(word, 1 if len(word) < SPELLING.min_letters_for_two_edits else max_edits)
        return found or (word,)

    def _words_of_term(self, word: str) -> tuple[str, ...]:
        """Return the words of a term whose joined form is not a noun (`slidecabinet`); otherwise the word itself."""
        term = self._lexicon.terms.get(word)
        words = tuple(term.text.split()) if term is not None and word not in self._taxonomy else ()
        return words if "".join(words) == word else (word,)

    def _split(self, word: str) -> tuple[str, ...] | None:
        """Return known words that a token joins, the longest last word first, without trailing pipeline tokens."""
        least = SPELLING.min_joined_letters
        for at in range(least, len(word) - least + 1):
            left, right = word[:at], self._taxonomy.singular(word[at:])
            if not is_content_word(right):
                return self._known_words(left)
            is_head = right not in PLACEMENTS and self._kinds.is_object(right)
            if is_head and (before := self._known_words(left)):
                return (*before, right)
        return None

    def _known_words(self, word: str) -> tuple[str, ...] | None:
        """Return letters as known words of any kind, the longest last word first; None if they are not."""
        if self._kinds.is_known(word) or is_english_word(word):
            return (word,)
        least = SPELLING.min_joined_letters
        for at in range(least, len(word) - least + 1):
            if self._kinds.is_known(word[at:]) and (before := self._known_words(word[:at])):
                return (*before, word[at:])
        return None

    def _restore_vowels(self, word: str) -> tuple[str, ...] | None:
        """Return the most frequent noun with all consonants of a word in order and more vowels: `microwv`."""
        consonants = consonants_of(word)
        if not SPELLING.min_consonants <= len(consonants) < len(word):
            return None
        longer = range(len(word) + 1, len(word) + SPELLING.max_missing_vowels + 1)
        near = chain.from_iterable(self._nouns.get((word[0], length), ()) for length in longer)
        alike = [noun for noun in near if consonants_of(noun) == consonants and _is_subsequence(word, noun)]
        return (max(alike, key=log_prior),) if alike else None

    def _respell(self, word: str, max_edits: int) -> tuple[str, ...] | None:
        """Return the best noun within some edits: fewest edits, then doubled letters, swapped letters, prior."""
        if len(word) < SPELLING.min_doubled_letters or not word.isalpha():
            return None
        ranked: list[tuple[int, bool, bool, float, str]] = []
        for length in range(len(word) - max_edits, len(word) + max_edits + 1):
            nouns = self._nouns.get((word[0], length), [])
            near = process.extract(
                word, nouns, scorer=OSA.distance, score_cutoff=max_edits, limit=SPELLING.max_candidates
            )
            for noun, edits, _ in near:
                is_foreign = noun not in self._lexicon.vocabulary
                is_doubled = _without_doubles(noun) == _without_doubles(word)
                is_anagram = sorted(noun) == sorted(word)
                if self._is_plausible_slip(word, is_foreign=is_foreign, is_doubled=is_doubled, is_anagram=is_anagram):
                    loss = -log_prior(noun) + SPELLING.foreign_loss * is_foreign
                    ranked.append((int(edits), not is_doubled, not is_anagram, loss, noun))
        return (min(ranked)[-1],) if ranked else None

    def _is_plausible_slip(self, word: str, *, is_foreign: bool, is_doubled: bool, is_anagram: bool) -> bool:
        """Return whether a word may be a misspelling of a noun with these relations to it.

        Short words are corrected only to words of the TBox, and the shortest only by a doubled letter: too many other
        nouns are similar. A participle is not a misspelt noun unless its letters are swapped.
        """
        if is_foreign and len(word) < SPELLING.min_foreign_letters:
            return False
        if len(word) < SPELLING.min_letters and not is_doubled:
            return False
        return is_anagram or not word.endswith("ed")

    @cached_property
    def _nouns(self) -> dict[tuple[str, int], list[str]]:
        """(First letter, length) → nouns that a misspelt word may mean; built on first use."""
        found: dict[tuple[str, int], list[str]] = {}
        nouns = {word for word in self._taxonomy.words(THING_DOMAINS) if len(word) > 3}
        for word in sorted(nouns | self._lexicon.vocabulary.keys()):
            found.setdefault((word[0], len(word)), []).append(word)
        return found


def _is_subsequence(letters: str, word: str) -> bool:
    rest = iter(word)
    return all(letter in rest for letter in letters)


def _without_doubles(word: str) -> str:
    return "".join(letter for letter, before in zip(word, " " + word, strict=False) if letter != before)
