"""Abbreviated names as words: a noisy channel over the words of the TBox, of the taxonomy and of the stage.

A name is read as the words w that make P(w) · P(written | w) largest (Shannon's noisy channel; for spelling Kernighan,
Church and Gale, COLING 1990). P(w) mixes how likely a thing is called so, the words of names in scenes, the TBox's
terms and the words of the other names on the stage; a word depends on the one before it. P(written | w) is that of the
usual ways to shorten words: vowels dropped, cut short, or both, mostly all words of a name alike.
"""

import math
from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from functools import cached_property, lru_cache, reduce
from itertools import accumulate
from typing import NamedTuple

from usd2kg.grounding.context.neighbours import Neighbourhood
from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.reading.beam_search import ROOT, Arc, Beam, Piece, log_sum
from usd2kg.grounding.lexical.reading.name_bigrams import load_written_names
from usd2kg.grounding.lexical.reading.shortening import Choice, FormIndex, find_range, forms_of, usual_abbreviations
from usd2kg.grounding.lexical.reading.shortening_style import log_consistency
from usd2kg.grounding.lexical.reading.word_frequencies import thing_prior
from usd2kg.words import words_of

__all__ = ["AbbreviationReader", "Reading"]

_THINGS = frozenset({"artifact", "food", "plant", "substance"})
_NAMES_SHARE, _TBOX_SHARE, _STAGE_SHARE, _PARENT_SHARE = 0.5, 0.1, 0.2, 0.07
"""Of the words of names, how many are those of names everywhere, of the TBox, of other names on the stage, and of the
name of the prim above."""
_ADJECTIVE = math.log(0.05 / 0.003)
"""How much likelier an adjective is to stand in a name than `thing_prior`, which is about heads, has it."""
_GENERAL = math.log(1 - _NAMES_SHARE - _TBOX_SHARE - _STAGE_SHARE - _PARENT_SHARE)
_RAREST = -15.5
_USUAL = math.log(0.002)
"""An abbreviation that people have agreed on, before the stage is heard."""
_ANY_LETTER = math.log(0.0004)
"""A single letter or pair that stands for no word: the C of CupC."""
_UNKNOWN_WORD, _UNKNOWN_LETTER = math.log(0.02), math.log(0.06)
"""A word that nobody knows, a brand say, of three to six letters that may be any."""
_UNREAD = {
    **{count: (count * _ANY_LETTER, 0.0) for count in (1, 2)},
    **{count: (_UNKNOWN_WORD, count * _UNKNOWN_LETTER) for count in (3, 4, 5, 6)},
}
"""Number of letters → what it costs that they are no word, in two terms."""
_PREFIXES = frozenset(["sm", "sk", "skm", "prop", "prp"])
_PREFIX = (math.log(0.1), 0.0)
"""A word of a pipeline that is written on to the beginning of a name: the SM of `smtckck`, a static mesh."""
_NEVER = (-math.inf, 0.0)
_NO_WORD = Piece((), {}, 0)
_TOLD_BY_NAMES = 0.9
"""How far names are believed in which word follows another."""
_COMPOUND, _MOST_BONUS = math.log(25), math.log(200)
"""How much likelier two words are together if they make a known compound, and at most by the names they are in."""
_CHOICES = 7
_LONGEST_PIECE = 12

_Near = Callable[[str], Piece | None]


class Reading(NamedTuple):
    """One way to read a name."""

    words: tuple[str, ...]
    probability: float
    """Among all readings of the name that were found."""


class _Written(NamedTuple):
    """A word of the stage that a form may stand for; the best sorts first."""

    loss: float
    """Minus the score of a `Choice`."""
    word: str
    noun: str
    """The word in the singular."""


class AbbreviationReader:
    """Reads abbreviated names with the words of one TBox."""

    def __init__(self, lexicon: Lexicon, taxonomy: Taxonomy) -> None:
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._tbox_words = {word: count for word, count in lexicon.vocabulary.items() if len(word) > 1}
        self._tbox_total = sum(self._tbox_words.values())
        self._rate, self._gather = self._rating, self._gathering
        """One function for all scenes: each remembers what it was told by it."""
        self._seconds = lru_cache(maxsize=4096)(self._second_words)
        self._of_parent = lru_cache(maxsize=1024)(self._choices_of_parent)
        self._known = lru_cache(maxsize=2048)(self._known_piece)

    def read(
        self,
        tokens: Sequence[str],
        neighbourhood: Neighbourhood | None = None,
        spelled: Container[str] = (),
        parent: str = "",
    ) -> list[Reading]:
        """Return the likeliest readings of a name, best first.

        Args:
            tokens: its runs of letters, lower case; each may hold several words.
            neighbourhood: the other objects of the stage, whose names may hold the same words.
            spelled: the tokens that are words in full, which stand for nothing else.
            parent: the name of the prim above, whose words may stand in this one too.
        """
        letters = "".join(tokens)
        ends = list(accumulate(map(len, tokens)))
        borders = [end for end, token in zip(ends, tokens, strict=True) for _ in token]
        whole = {end - len(token): token for end, token in zip(ends, tokens, strict=True) if token in spelled}
        near = self._near(neighbourhood, parent)
        beam = Beam(self._seconds, _MOST_BONUS)
        paths = [ROOT]
        arcs: list[list[Arc]] = [[] for _ in range(len(letters) + 1)]
        for at in range(len(letters)):
            starts = beam.starts(paths)
            if starts.ordered and at in whole:
                word = whole[at]
                arcs[at + len(word)].append(Arc(starts, _NEVER, Piece([(0.0, word)], {word: [0.0]}, 1)))
            elif starts.ordered:
                for end, piece in self._pieces(letters, at, borders[at], near):
                    is_prefix = at == 0 and letters[:end] in _PREFIXES
                    unread = _PREFIX if is_prefix else _UNREAD.get(end - at, _NEVER)
                    arcs[end].append(Arc(starts, unread, piece))
            paths = beam.best(arcs[at + 1])
        scored = []
        for path in paths:
            words = beam.words(path)
            scored.append((path[0] + log_consistency(letters, words, whole), words))
        return _readings(scored)

    def _near(self, neighbourhood: Neighbourhood | None, parent: str) -> _Near:
        """Return a function that gives what a form may be by the other names of the stage, None for nothing."""
        if neighbourhood is None:
            beside: _Near = _nothing_near
        else:
            beside = neighbourhood.words_by_form(forms_of, self._rate, self._gather, _CHOICES)
        above = self._of_parent(parent)
        if not above:
            return beside

        def near(form: str) -> Piece | None:
            piece = beside(form)
            return piece if form not in above else _with_choices(piece or self._known(form), above[form])

        return near

    def _choices_of_parent(self, parent: str) -> dict[str, list[Choice]]:
        """Return form → the words of the name of a parent that may be written so."""
        words = sorted({self._taxonomy.singular(word) for word in words_of(parent) if word.isalpha()})
        found: dict[str, list[Choice]] = {}
        for word in words:
            for form, score in forms_of(word):
                found.setdefault(form, []).append(Choice(math.log(_PARENT_SHARE / len(words)) + score, word))
        return found

    def _pieces(self, letters: str, start: int, border: int, near: _Near) -> Iterator[tuple[int, Piece]]:
        """Yield the ends of the pieces that begin at a letter, with what they may be."""
        is_begun = True
        for end in range(start + 1, min(border, start + _LONGEST_PIECE) + 1):
            form = letters[start:end]
            piece = near(form)
            if is_begun:
                known = self._known(form)
                is_begun = known is not None
                piece = piece or known
            if piece is not None and piece.words:
                yield end, piece
            elif end - start in _UNREAD:
                yield end, _NO_WORD

    def _known_piece(self, form: str) -> Piece | None:
        """Return what a form may be, the stage apart; None if nothing that begins so is a form either."""
        choices = self._index.choices(form)
        usual = usual_abbreviations().get(form)
        if usual is not None:
            choices = [*(choices or ()), Choice(_USUAL, usual)]
        if choices is None and form not in _usual_beginnings():
            return None
        return _with_choices(None, choices or ())

    def _gathering(self, form: str, written: list[_Written]) -> Piece:
        """Return what a form may be, with the words of the stage that may be written so."""
        return _with_choices(self._known(form), [Choice(-found.loss, found.noun) for found in written])

    @cached_property
    def _index(self) -> FormIndex:
        """The words of the TBox and the taxonomy, but for the rarest."""
        names = load_written_names().counts
        words = {*self._taxonomy.words(_THINGS), *self._taxonomy.adjectives, *self._tbox_words, *names}
        priors = {word: self._prior(word) for word in words if len(word) > 2 or word in self._tbox_words}
        return FormIndex({word: prior for word, prior in priors.items() if prior > _RAREST}, _CHOICES)

    def _prior(self, word: str) -> float:
        """Return the log probability of a word in a name, the stage apart."""
        prior = thing_prior(word) + (_ADJECTIVE if word in self._taxonomy.adjectives else 0.0) + _GENERAL
        if word in load_written_names().counts:
            prior = log_sum(prior, math.log(_NAMES_SHARE) + load_written_names().log_share(word))
        if word not in self._tbox_words:
            return prior
        # A word is the likelier the more terms hold it, and likelier where people use it.
        return log_sum(prior, math.log(_TBOX_SHARE * self._tbox_words[word] / self._tbox_total))

    def _second_words(self, first: str) -> dict[str, float]:
        """Return the words that are likelier behind a word, and how much: they make a compound, or are so in names."""
        start, end = find_range(self._compounds, first)
        rests = (key[len(first) :] for key in self._compounds[start:end])
        found = dict.fromkeys(filter(self._index.__contains__, rests), _COMPOUND)
        for word, share in load_written_names().followers(first).items():
            bonus = math.log(1 - _TOLD_BY_NAMES + _TOLD_BY_NAMES * share / math.exp(self._prior(word)))
            if bonus > found.get(word, 0.0):
                found[word] = min(bonus, _MOST_BONUS)
        return found

    @cached_property
    def _compounds(self) -> list[str]:
        # The parts of a word that people write as one are no words of a name.
        terms = (key for key, term in self._lexicon.terms.items() if " " in term.text)
        return sorted([*terms, *self._taxonomy.phrases()])

    def _rating(self, word: str, share: float, score: float) -> _Written:
        score = math.log(_STAGE_SHARE * min(1.0, share)) + score
        return _Written(-score, word, self._taxonomy.singular(word))


@lru_cache(maxsize=1)
def _usual_beginnings() -> frozenset[str]:
    return frozenset(short[:end] for short in usual_abbreviations() for end in range(1, len(short) + 1))


def _nothing_near(_form: str) -> Piece | None:
    return None


def _with_choices(piece: Piece | None, choices: Iterable[Choice]) -> Piece:
    """Return what letters may be by some choices besides."""
    reasons = {word: [*scores] for word, scores in piece.reasons.items()} if piece is not None else {}
    for score, word in choices:
        if word in reasons:
            reasons[word].append(score)
        else:
            reasons[word] = [score]
    words = [(scores[0] if len(scores) == 1 else reduce(log_sum, scores), word) for word, scores in reasons.items()]
    words.sort(reverse=True)
    return Piece(words, reasons, max(map(len, reasons.values()), default=0))


def _readings(scored: list[tuple[float, tuple[str, ...]]]) -> list[Reading]:
    scored.sort(key=lambda found: (-found[0], found[1]))
    weights = [math.exp(score - scored[0][0]) for score, _ in scored]
    total = sum(weights)
    readings = [Reading(words, weight / total) for (_, words), weight in zip(scored, weights, strict=True)]
    # That it is no word at all is a reading too.
    return [reading for reading in readings if reading.words]
