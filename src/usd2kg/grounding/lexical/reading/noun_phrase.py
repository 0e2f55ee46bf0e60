"""Reading an object's name as a noun phrase: which of its words says what it is."""

from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import chain, pairwise, takewhile

from rapidfuzz import process
from rapidfuzz.distance import OSA

from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.reading.english_words import is_common_word, is_english_word
from usd2kg.grounding.lexical.reading.shortening import consonants_of, usual_abbreviations
from usd2kg.grounding.lexical.reading.tokens import (
    Token,
    is_half,
    is_reference,
    read_parent,
    shared_beginning,
    tokens_of,
)
from usd2kg.grounding.lexical.reading.word_frequencies import thing_prior
from usd2kg.grounding.lexical.reading.word_kinds import PLACEMENTS, THING_DOMAINS, WordKinds
from usd2kg.languages import language_of, translate
from usd2kg.words import is_telling

__all__ = ["NamePhrase", "NameReader"]

_SHORTEST_RESPELLED = 6
"""Words shorter than this are corrected towards the TBox's own words only: among all nouns too many are near."""
_MOST_WORDS = 16
"""Words of a name that are read; display names are free text, and no thing's name is longer."""
_SHORTEST_PART = 3
"""Letters of the longest part of a term that is written in parts: of `t_shirt` or `test_tube`."""
_LONGEST_TERM = 5
"""Words of a term that is looked for around a word that alone says nothing."""
_LONG = 7
"""Letters of a word that is long enough to be told by its spelling."""
_ENDINGS = frozenset(["tor"])
"""Nouns that many words end with by chance: an operator is no opera's hill, nor its gate, which German calls so."""
_LEAST_CONSONANTS = 4
"""Letters of a word without its vowels that are enough to know it by, where it has some vowels left."""
_MOST_DROPPED = 4
"""Vowels that may be missing from such a word."""
_SHORTEST_UNKNOWN, _SHORTEST_DOUBLED = 5, 4
"""Shorter words that are unknown are abbreviations sooner than misspelt. Those with the least letters may lack but the
second of a double one."""
_WITH = frozenset(["with", "without", "w", "wo"])
"""What stands before what a thing has besides: the lid of a `toy_bin_w_lid`."""
_WHERE = frozenset(["on", "in", "under", "over", "behind", "beside", "for", "of", "from", "at"])
"""What stands before where a thing is, or what it is for: the rack of a `towel_on_rack`."""
_PARTICLED = frozenset(
    "add bolt build carry check clip cut drop fit hang lean lock log lift plug pop pull push roll screw sign slide "
    "slip snap stand stick strap take tie walk".split()
)
"""Verbs that may look like nouns before one of these: a `clip_on_lamp` is a lamp."""


@dataclass(frozen=True, slots=True)
class NamePhrase:
    """The words of a name, as they were understood."""

    words: tuple[str, ...]
    """Modifiers first, the head noun last; empty if the name says nothing."""
    context: tuple[str, ...] = ()
    """Words of the name that refer to the thing's parent or place (`cabinet10` in `cabinet10_drawer`)."""
    corrections: tuple[tuple[str, str], ...] = ()
    """(as written, as read) of the words that were corrected or split."""
    glued: tuple[bool, ...] = field(default=(), compare=False)
    """For each word whether it is written on to the one before, as in `RoomWindow`; empty if that is unknown."""
    is_head_last: bool = field(default=False, compare=False)
    """Whether the last word is the head for certain: grammar told it, in a language that puts heads first."""

    def is_glued(self, at: int) -> bool:
        """Return whether word number `at` is written on to the one before."""
        return at < len(self.glued) and self.glued[at]

    def glued_on(self, at: int) -> int:
        """Return how many words from number `at` on are written on to those before."""
        return sum(1 for _ in takewhile(bool, self.glued[at:]))


class NameReader:
    """Reads names with the words of one lexicon and the taxonomy."""

    def __init__(self, lexicon: Lexicon, taxonomy: Taxonomy) -> None:
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self.kinds = WordKinds(lexicon, taxonomy)
        # What a name or a word says depends on nothing else, and both are asked for over and over.
        self.read = lru_cache(maxsize=4096)(self._read)
        self.correct = lru_cache(maxsize=16384)(self._correct)

    @cached_property
    def _by_first_letter_and_length(self) -> dict[tuple[str, int], list[str]]:
        """(First letter, length) → the words that a misspelt one may mean; needed only where one is met."""
        found: dict[tuple[str, int], list[str]] = {}
        thing_words = {word for word in self._taxonomy.words(THING_DOMAINS) if len(word) > 3}
        for word in sorted(thing_words | self._lexicon.vocabulary.keys()):
            found.setdefault((word[0], len(word)), []).append(word)
        return found

    def _read(self, name: str, parents: tuple[str, ...] = ()) -> NamePhrase:
        """Return the phrase behind a name; `parents` are the names of the prims above, outermost first."""
        tokens = self._telling(self._without_additions(tokens_of(name)))[:_MOST_WORDS]
        tokens, references = self._part_references(tokens, parents)
        words: list[str] = []
        glued: list[bool] = []
        corrections: list[tuple[str, str]] = []
        translated = self._translated(_texts(tokens))
        if translated is not None:
            at = shared_beginning(tokens, parents)
            if (of_the_rest := self._translated(_texts(tokens[at:]))) is not None:
                # Below `armario_dormitorio` an `armario_puerta` is its door.
                translated, tokens, references = of_the_rest, tokens[at:], [*references, *tokens[:at]]
            return _translation(_texts(tokens), translated, context=_texts(references))
        others = [token.text for token in tokens if token.text not in usual_abbreviations()]
        # Among other unknown words an abbreviation is better read with them, by what the stage speaks of.
        is_spelled = any(map(self.kinds.is_known, others)) if others else len(tokens) > 1
        for token in tokens:
            read = self._spelled_out(token.text) if is_spelled else self.correct(token.text)
            as_written = {(token.text,), (self._taxonomy.singular(token.text),)}
            words.extend(read)
            glued.extend([token.is_glued, *[True] * (len(read) - 1)])
            if read not in as_written:
                corrections.append((token.text, " ".join(read)))
        context = tuple(word for token in references for word in self._spelled_out(token.text))
        return NamePhrase(tuple(words), context, tuple(corrections), tuple(glued))

    def _without_additions(self, tokens: list[Token]) -> list[Token]:
        """Return the tokens before the one that says what a thing has besides, or where it is, if they name a thing."""
        for at in range(1, len(tokens)):
            is_told = self._begins_addition(tokens, at) or self._begins_place(tokens, at)
            if is_told and any(is_telling(token.text) for token in tokens[at + 1 :]):
                return tokens[:at]
        return tokens

    def _begins_addition(self, tokens: list[Token], at: int) -> bool:
        is_with = tokens[at].text in _WITH
        return is_with and any(self.kinds.names_thing(self._taxonomy.singular(token.text)) for token in tokens[:at])

    def _begins_place(self, tokens: list[Token], at: int) -> bool:
        before = tokens[at - 1].text
        if tokens[at].text not in _WHERE or before in _PARTICLED or before in self._taxonomy.adjectives:
            return False
        is_compound = "".join(token.text for token in tokens[at - 1 : at + 2]) in self._taxonomy
        return (
            self.kinds.is_noun(self._taxonomy.singular(before))
            and not is_compound
            and not self._term_around(tokens, at)
        )

    def _telling(self, tokens: list[Token]) -> list[Token]:
        """Return the tokens that say something: those of a pipeline (`low`, `test`) only in a term: `TestTube`."""
        kept = {at for at, token in enumerate(tokens) if is_telling(token.text)}
        for at in range(min(len(tokens), _MOST_WORDS)):
            if at not in kept:
                kept.update(self._term_around(tokens, at))
        return [tokens[at] for at in sorted(kept)]

    def _term_around(self, tokens: list[Token], at: int) -> range:
        """Return where the longest term with more words than token `at` stands around it; nowhere if there is none."""
        runs = [
            range(start, end)
            for start in range(max(0, at - _LONGEST_TERM), at + 1)
            for end in range(at + 1, min(len(tokens), start + _LONGEST_TERM) + 1)
            # The `A_rt` of a side is no art.
            if end - start > 1 and any(len(token.text) >= _SHORTEST_PART for token in tokens[start:end])
        ]
        terms = [run for run in runs if "".join(tokens[i].text for i in run) in self._lexicon.terms]
        return max(terms, key=len, default=range(0))

    def _spelled_out(self, word: str) -> tuple[str, ...]:
        """Return an agreed abbreviation among words that are spelled out (`butter_knf`) in full."""
        usual = usual_abbreviations().get(word)
        return tuple(usual.split()) if usual is not None and word not in self._lexicon.terms else self.correct(word)

    def phrase(self, words: tuple[str, ...]) -> NamePhrase:
        """Return the phrase of a name's words that are spelled out, in whatever language."""
        translated = self._translated(words)
        return NamePhrase(words) if translated is None else _translation(words, translated)

    def _translated(self, words: tuple[str, ...]) -> tuple[str, ...] | None:
        """Return the name in English, head noun last, if it is in another language and no term of the TBox."""
        is_english = all(word in self._taxonomy or word in self._taxonomy.adjectives for word in words)
        # A `chaise longue` and a `hors d'oeuvre` are English as compounds.
        is_borrowed = any("".join(pair) in self._taxonomy for pair in pairwise(words))
        if is_english or is_borrowed or "".join(words) in self._lexicon.terms:
            return None
        return translate(words)

    def _part_references(self, tokens: list[Token], parents: tuple[str, ...]) -> tuple[list[Token], list[Token]]:
        """Part the words that repeat a parent's name from those that are the thing's own."""
        written = {token.text for token in tokens}
        above: set[tuple[str, str]] = set()
        for parent in map(read_parent, parents):
            # All of its words must be repeated: below `knifeBlock` a `breadKnife` is a knife. A number tells by itself.
            is_whole = parent.telling <= written
            above.update(parent.words if is_whole else (word for word in parent.words if word[1]))
        references = [token for token in tokens if above and is_reference(token, above)]
        if not references:
            return tokens, []
        # Below `Mug` a `coffee_mug` is a mug of its own; below `Toilet` a `toilet_seat` is no seat of any kind.
        pairs = [pair for pair in pairwise(tokens) if self._is_term(pair)]
        references = [
            token for token in references if token.number or not any(is_half(token, pair, references) for pair in pairs)
        ]
        own = [token for token in tokens if token not in references]
        # Below `Bread` a `GrainBread` is no grain, but below `Pot` a `LidPot` is a lid.
        is_member = tokens[-1] in references and not tokens[-1].number
        words = [word for token in own for word in self.correct(token.text)]
        if all(self.kinds.may_describe(word) or (is_member and self.kinds.is_flavour(word)) for word in words):
            return tokens, []
        return own, references

    def _is_term(self, pair: tuple[Token, Token]) -> bool:
        return pair[0].text + self._taxonomy.singular(pair[1].text) in self._lexicon.terms

    def _correct(self, word: str) -> tuple[str, ...]:
        """Return a word as known words: itself, its singular, a compound split, or the nearest spelling."""
        if self.kinds.is_known(word):
            return self._parts_of_term(word)
        singular = self._taxonomy.singular(word)
        if singular != word:
            return (singular,)
        if is_common_word(word):
            return (word,)
        is_english = is_english_word(word)
        # A long word with one letter amiss is misspelt sooner than made of two words.
        slip = self._respell(word, 1) if len(word) >= _LONG and not is_english else None
        parts = slip or self._with_vowels(word) or self._split(word)
        return parts or (None if is_english else self._respell(word, 1 if len(word) < 8 else 2)) or (word,)

    def _parts_of_term(self, word: str) -> tuple[str, ...]:
        """Return the words of a term that is written as one (`slidecabinet`), if the language does not do so too."""
        term = self._lexicon.terms.get(word)
        parts = tuple(term.text.lower().split()) if term is not None and word not in self._taxonomy else ()
        return parts if "".join(parts) == word else (word,)

    def _split(self, word: str) -> tuple[str, ...] | None:
        """Split a compound into known words, the longest last word first; pipeline tokens at the end fall off."""
        for at in range(3, len(word) - 2):
            left, right = word[:at], self._taxonomy.singular(word[at:])
            if not is_telling(right):
                return self._known_words(left)
            is_head = right not in PLACEMENTS and right not in _ENDINGS and self.kinds.names_thing(right)
            if is_head and (before := self._known_words(left)):
                return (*before, right)
        return None

    def _known_words(self, word: str) -> tuple[str, ...] | None:
        """Return a run of letters as known words of any kind, the longest last word first."""
        if self.kinds.is_known(word) or is_english_word(word):
            return (word,)
        for at in range(3, len(word) - 2):
            if self.kinds.is_known(word[at:]) and (before := self._known_words(word[:at])):
                return (*before, word[at:])
        return None

    def _with_vowels(self, word: str) -> tuple[str, ...] | None:
        """Return the noun of which a word has all consonants in order and some of the vowels: `microwv`."""
        consonants = consonants_of(word)
        if not _LEAST_CONSONANTS <= len(consonants) < len(word):
            return None
        longer = range(len(word) + 1, len(word) + _MOST_DROPPED + 1)
        near = chain.from_iterable(self._by_first_letter_and_length.get((word[0], length), ()) for length in longer)
        alike = [found for found in near if consonants_of(found) == consonants and _is_within(word, found)]
        return (max(alike, key=thing_prior),) if alike else None

    def _respell(self, word: str, budget: int) -> tuple[str, ...] | None:
        if len(word) < _SHORTEST_DOUBLED or not word.isalpha():
            return None
        is_doubled_only = len(word) < _SHORTEST_UNKNOWN
        ranked: list[tuple[int, bool, bool, float, str]] = []
        for length in range(len(word) - budget, len(word) + budget + 1):
            alike = self._by_first_letter_and_length.get((word[0], length), [])
            near = process.extract(word, alike, scorer=OSA.distance, score_cutoff=budget, limit=8)
            for candidate, distance, _ in near:
                # The TBox's own words first: they are what the scene is likely to be about.
                is_foreign = candidate not in self._lexicon.vocabulary
                is_short = is_foreign and len(word) < _SHORTEST_RESPELLED
                is_doubling = _undoubled(candidate) == _undoubled(word)
                if not is_short and (is_doubling or not is_doubled_only) and _may_be_slip(word, candidate):
                    is_disorder = sorted(candidate) == sorted(word)
                    loss = -thing_prior(candidate) + 2 * is_foreign
                    ranked.append((int(distance), not is_doubling, not is_disorder, loss, candidate))
        return (min(ranked)[-1],) if ranked else None


def _may_be_slip(word: str, candidate: str) -> bool:
    """Return whether a word may be a misspelt noun; a participle is none, unless its letters are just in disorder.

    >>> _may_be_slip("squeezed", "squeezer"), _may_be_slip("lampshaed", "lampshade")
    (False, True)
    """
    return not word.endswith("ed") or sorted(candidate) == sorted(word)


def _is_within(letters: str, word: str) -> bool:
    """Return whether a word holds some letters in their order."""
    rest = iter(word)
    return all(letter in rest for letter in letters)


def _undoubled(word: str) -> str:
    return "".join(letter for letter, before in zip(word, " " + word, strict=False) if letter != before)


def _texts(tokens: list[Token]) -> tuple[str, ...]:
    return tuple(token.text for token in tokens)


def _translation(words: tuple[str, ...], english: tuple[str, ...], context: tuple[str, ...] = ()) -> NamePhrase:
    corrections = ((" ".join(words), " ".join(english)),)
    return NamePhrase(english, context, corrections, is_head_last=language_of(words) != "de")
