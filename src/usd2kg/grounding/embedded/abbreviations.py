"""Abbreviated names as words: a noisy channel over the words of the TBox, of the taxonomy and of the stage.

A name is read as the words w that make P(w) · P(written | w) largest (Shannon's noisy channel; for spelling Kernighan,
Church and Gale, COLING 1990). P(w) mixes how likely a thing is called so, the TBox's terms and the words of the other
names on the stage. P(written | w) is that of the usual ways to shorten a word: vowels dropped, cut short, or both.
"""

import math
from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from functools import cached_property, lru_cache, reduce
from itertools import accumulate
from typing import NamedTuple

from usd2kg.grounding.embedded.beam import ROOT, Arc, Beam, Path, Piece, log_sum
from usd2kg.grounding.embedded.frequencies import thing_prior
from usd2kg.grounding.embedded.lexicon import Lexicon
from usd2kg.grounding.embedded.shortening import Choice, FormIndex, find_range, forms_of, usual_abbreviations
from usd2kg.grounding.embedded.taxonomy import Taxonomy
from usd2kg.scene import Company

__all__ = ["AbbreviationReader", "Reading"]

_THINGS = frozenset({"artifact", "food", "plant", "substance"})
_TBOX_SHARE, _STAGE_SHARE = 0.55, 0.3
"""Of the words of names, how many are the TBox's, and how many are in another name on the stage."""
_ADJECTIVE = math.log(0.05 / 0.003)
"""How much likelier an adjective is to stand in a name than `thing_prior`, which is about heads, has it."""
_GENERAL = math.log(1 - _TBOX_SHARE - _STAGE_SHARE)
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
_CHOICES = 7
_LONGEST_PIECE = 12


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
        self._known = lru_cache(maxsize=4096)(self._known_piece)

    def read(
        self, tokens: Sequence[str], company: Company | None = None, spelled: Container[str] = ()
    ) -> list[Reading]:
        """Return the likeliest readings of a name, best first.

        Args:
            tokens: its runs of letters, lower case; each may hold several words.
            company: the other objects of the stage, whose names may hold the same words.
            spelled: the tokens that are words in full, which stand for nothing else.
        """
        letters = "".join(tokens)
        ends = list(accumulate(map(len, tokens)))
        borders = [end for end, token in zip(ends, tokens, strict=True) for _ in token]
        whole = {end - len(token): token for end, token in zip(ends, tokens, strict=True) if token in spelled}
        near = None
        if company is not None:
            near = company.words_written(forms_of, self._rate, self._gather, _CHOICES)
        beam = Beam(self._seconds)
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
        return _readings(paths, beam)

    def _pieces(
        self, letters: str, start: int, border: int, near: Callable[[str], Piece | None] | None
    ) -> Iterator[tuple[int, Piece]]:
        """Yield the ends of the pieces that begin at a letter, with what they may be."""
        is_begun = True
        for end in range(start + 1, min(border, start + _LONGEST_PIECE) + 1):
            form = letters[start:end]
            piece = near(form) if near is not None else None
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
        return _piece_of({}, choices or ())

    def _gathering(self, form: str, written: list[_Written]) -> Piece:
        """Return what a form may be, with the words of the stage that may be written so."""
        known = self._known(form)
        reasons = {word: [*scores] for word, scores in known.reasons.items()} if known is not None else {}
        return _piece_of(reasons, [Choice(-found.loss, found.noun) for found in written])

    @cached_property
    def _index(self) -> FormIndex:
        """The words of the TBox and the taxonomy, but for the rarest."""
        words = {*self._taxonomy.words(_THINGS), *self._taxonomy.adjectives, *self._tbox_words}
        priors = {word: self._prior(word) for word in words if len(word) > 2 or word in self._tbox_words}
        return FormIndex({word: prior for word, prior in priors.items() if prior > _RAREST}, _CHOICES)

    def _prior(self, word: str) -> float:
        """Return the log probability of a word in a name, the stage apart."""
        prior = thing_prior(word) + (_ADJECTIVE if word in self._taxonomy.adjectives else 0.0) + _GENERAL
        if word not in self._tbox_words:
            return prior
        # A word is the likelier the more terms hold it, and likelier where people use it.
        return log_sum(prior, math.log(_TBOX_SHARE * self._tbox_words[word] / self._tbox_total))

    def _second_words(self, first: str) -> frozenset[str]:
        """Return the words that make a known compound with a word before them."""
        start, end = find_range(self._compounds, first)
        return frozenset(key[len(first) :] for key in self._compounds[start:end])

    @cached_property
    def _compounds(self) -> list[str]:
        return sorted({*self._lexicon.terms, *self._taxonomy.lemmas})

    def _rating(self, word: str, share: float, score: float) -> _Written:
        score = math.log(_STAGE_SHARE * min(1.0, share)) + score
        return _Written(-score, word, self._taxonomy.singular(word))


@lru_cache(maxsize=1)
def _usual_beginnings() -> frozenset[str]:
    return frozenset(short[:end] for short in usual_abbreviations() for end in range(1, len(short) + 1))


def _piece_of(reasons: dict[str, list[float]], choices: Iterable[Choice]) -> Piece:
    for score, word in choices:
        if word in reasons:
            reasons[word].append(score)
        else:
            reasons[word] = [score]
    words = [(scores[0] if len(scores) == 1 else reduce(log_sum, scores), word) for word, scores in reasons.items()]
    words.sort(reverse=True)
    return Piece(words, reasons, max(map(len, reasons.values()), default=0))


def _readings(paths: list[Path], beam: Beam) -> list[Reading]:
    weights = [math.exp(path[0] - paths[0][0]) for path in paths]
    total = sum(weights)
    readings = [Reading(beam.words(path), weight / total) for path, weight in zip(paths, weights, strict=True)]
    # That it is no word at all is a reading too.
    return [reading for reading in readings if reading.words]
