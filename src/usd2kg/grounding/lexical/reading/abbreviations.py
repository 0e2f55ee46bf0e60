"""Expand abbreviated names with a noisy channel over the words of the TBox, of the taxonomy and of the stage.

The reading of a name maximises P(words) · P(written | words) (Shannon's noisy channel; for spelling: Kernighan, Church
and Gale, COLING 1990). P(words) is a bigram model whose unigrams mix the prior of nouns, words of names in scenes, the
terms of the TBox, the words of other names on the stage, and those of the parent's name. P(written | words) models how
words are shortened: vowels dropped, truncated, or both, and usually all words of a name in one way.
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
from usd2kg.grounding.lexical.reading.name_bigrams import load_name_bigrams
from usd2kg.grounding.lexical.reading.shortening import Expansion, FormIndex, find_range, forms_of, usual_abbreviations
from usd2kg.grounding.lexical.reading.shortening_settings import CHANNEL
from usd2kg.grounding.lexical.reading.shortening_style import log_consistency
from usd2kg.grounding.lexical.reading.word_frequencies import log_prior
from usd2kg.knowledge import word_set
from usd2kg.words import words_of

__all__ = ["AbbreviationReader", "Reading"]

_NOUN_DOMAINS = frozenset({"artifact", "food", "plant", "substance"})
"""WordNet domains of the nouns that names contain."""
_ADJECTIVE_LOG_FACTOR = math.log(CHANNEL.adjective_factor)
_LOG_NOUN_SHARE = math.log(1 - CHANNEL.bigram_share - CHANNEL.tbox_share - CHANNEL.stage_share - CHANNEL.parent_share)
_LOG_COMMON_ABBREVIATION = math.log(CHANNEL.common_abbreviation)
_UNREAD = {
    **{count: (count * math.log(CHANNEL.stray_letter), 0.0) for count in (1, 2)},
    **{
        count: (math.log(CHANNEL.unknown_word), count * math.log(CHANNEL.unknown_letter))
        for count in range(3, CHANNEL.max_unknown_letters + 1)
    },
}
"""Number of letters → log probability that they are not a known word, in two terms: the C of CupC, a brand."""
_PREFIXES = word_set("lexical", "pipeline_prefixes")
_PREFIX = (math.log(CHANNEL.pipeline_prefix), 0.0)
_NEVER = (-math.inf, 0.0)
_NO_WORD = Piece((), {}, 0)
_COMPOUND_BONUS, _MAX_BONUS = math.log(CHANNEL.compound_factor), math.log(CHANNEL.max_bigram_factor)

_Near = Callable[[str], Piece | None]


class Reading(NamedTuple):
    """One expansion of a name."""

    words: tuple[str, ...]
    probability: float
    """Share among all readings found."""


class _StageWord(NamedTuple):
    """A word of the stage that a form may abbreviate; the best sorts first."""

    loss: float
    """The negative score of an `Expansion`."""
    word: str
    noun: str
    """The word in the singular."""


class AbbreviationReader:
    """Expands abbreviated names, for one TBox."""

    def __init__(self, lexicon: Lexicon, taxonomy: Taxonomy) -> None:
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._tbox_words = {word: count for word, count in lexicon.vocabulary.items() if len(word) > 1}
        self._tbox_total = sum(self._tbox_words.values())
        # Scenes cache results by the identity of the function, and each access to a method creates a new object.
        self._rate, self._gather = self._rate_word, self._gather_words
        self._bonuses = lru_cache(maxsize=4096)(self._follower_bonuses)
        self._parent_choices = lru_cache(maxsize=1024)(self._choices_of_parent)
        self._known = lru_cache(maxsize=2048)(self._known_piece)

    def read(
        self,
        tokens: Sequence[str],
        neighbourhood: Neighbourhood | None = None,
        spelled: Container[str] = (),
        parent: str = "",
    ) -> list[Reading]:
        """Return the most probable readings of a name, best first.

        Args:
            tokens: its runs of letters, lower case; each may be several words.
            neighbourhood: the other objects of the stage, whose names may have the same words.
            spelled: the tokens that are words in full.
            parent: the name of the prim above, which may have the same words.
        """
        letters = "".join(tokens)
        ends = list(accumulate(map(len, tokens)))
        borders = [end for end, token in zip(ends, tokens, strict=True) for _ in token]
        whole = {end - len(token): token for end, token in zip(ends, tokens, strict=True) if token in spelled}
        near = self._near(neighbourhood, parent)
        beam = Beam(self._bonuses, _MAX_BONUS)
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
        """Return a function from a form to its piece by other names of the stage, None for an unknown form."""
        if neighbourhood is None:
            by_stage: _Near = _nothing_near
        else:
            by_stage = neighbourhood.words_by_form(forms_of, self._rate, self._gather, CHANNEL.max_choices)
        by_parent = self._parent_choices(parent)
        if not by_parent:
            return by_stage

        def near(form: str) -> Piece | None:
            piece = by_stage(form)
            return piece if form not in by_parent else _with_choices(piece or self._known(form), by_parent[form])

        return near

    def _choices_of_parent(self, parent: str) -> dict[str, list[Expansion]]:
        """Return form → words of a parent's name that it may abbreviate."""
        words = sorted({self._taxonomy.singular(word) for word in words_of(parent) if word.isalpha()})
        found: dict[str, list[Expansion]] = {}
        for word in words:
            for form, score in forms_of(word):
                found.setdefault(form, []).append(Expansion(math.log(CHANNEL.parent_share / len(words)) + score, word))
        return found

    def _pieces(self, letters: str, start: int, border: int, near: _Near) -> Iterator[tuple[int, Piece]]:
        """Yield (end, piece) for the runs of letters that begin at `start`."""
        is_begun = True
        for end in range(start + 1, min(border, start + CHANNEL.max_piece_letters) + 1):
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
        """Return the piece of a form without words of the stage; None if no known form begins with it."""
        choices = self._index.choices(form)
        usual = usual_abbreviations().get(form)
        if usual is not None:
            choices = [*(choices or ()), Expansion(_LOG_COMMON_ABBREVIATION, usual)]
        if choices is None and form not in _abbreviation_prefixes():
            return None
        return _with_choices(None, choices or ())

    def _gather_words(self, form: str, written: list[_StageWord]) -> Piece:
        """Return the piece of a form, with words of the stage."""
        return _with_choices(self._known(form), [Expansion(-found.loss, found.noun) for found in written])

    @cached_property
    def _index(self) -> FormIndex:
        """Index of the words of the TBox, the taxonomy and names, without the rarest."""
        names = load_name_bigrams().counts
        words = {*self._taxonomy.words(_NOUN_DOMAINS), *self._taxonomy.adjectives, *self._tbox_words, *names}
        priors = {word: self._prior(word) for word in words if len(word) > 2 or word in self._tbox_words}
        return FormIndex(
            {word: prior for word, prior in priors.items() if prior > CHANNEL.min_log_prior}, CHANNEL.max_choices
        )

    def _prior(self, word: str) -> float:
        """Return log P(word) in a name, without the stage and the parent."""
        prior = log_prior(word) + _LOG_NOUN_SHARE
        if word in self._taxonomy.adjectives:
            # `log_prior` is about head nouns.
            prior += _ADJECTIVE_LOG_FACTOR
        if word in load_name_bigrams().counts:
            prior = log_sum(prior, math.log(CHANNEL.bigram_share) + load_name_bigrams().log_share(word))
        if word not in self._tbox_words:
            return prior
        return log_sum(prior, math.log(CHANNEL.tbox_share * self._tbox_words[word] / self._tbox_total))

    def _follower_bonuses(self, first: str) -> dict[str, float]:
        """Return next word → log factor on its prior, for compounds and bigrams of names."""
        start, end = find_range(self._compounds, first)
        rests = (key[len(first) :] for key in self._compounds[start:end])
        found = dict.fromkeys(filter(self._index.__contains__, rests), _COMPOUND_BONUS)
        for word, share in load_name_bigrams().followers(first).items():
            ratio = share / math.exp(self._prior(word))
            bonus = math.log(1 - CHANNEL.bigram_trust + CHANNEL.bigram_trust * ratio)
            if bonus > found.get(word, 0.0):
                found[word] = min(bonus, _MAX_BONUS)
        return found

    @cached_property
    def _compounds(self) -> list[str]:
        # Only compounds of several written words: names do not abbreviate the parts of “bookcase” separately.
        terms = (key for key, term in self._lexicon.terms.items() if " " in term.text)
        return sorted([*terms, *self._taxonomy.phrases()])

    def _rate_word(self, word: str, share: float, score: float) -> _StageWord:
        score = math.log(CHANNEL.stage_share * min(1.0, share)) + score
        return _StageWord(-score, word, self._taxonomy.singular(word))


@lru_cache(maxsize=1)
def _abbreviation_prefixes() -> frozenset[str]:
    return frozenset(short[:end] for short in usual_abbreviations() for end in range(1, len(short) + 1))


def _nothing_near(_form: str) -> Piece | None:
    return None


def _with_choices(piece: Piece | None, choices: Iterable[Expansion]) -> Piece:
    """Return a piece with further choices."""
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
    # The reading without words is left out; its share is the probability that the letters abbreviate none.
    return [reading for reading in readings if reading.words]
