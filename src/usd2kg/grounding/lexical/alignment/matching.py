"""From a noun phrase to classes: each word that may be its head is asked what it names."""

from collections.abc import Sequence
from functools import lru_cache
from math import log
from operator import itemgetter
from typing import NamedTuple

from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.alignment.naming import Match, Namer
from usd2kg.grounding.lexical.concepts.senses import sense_weight
from usd2kg.grounding.lexical.concepts.sizes import Size, surprise, thing_row
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.reading.head_noun import Features, likelihood, propensity
from usd2kg.grounding.lexical.reading.noun_phrase import NamePhrase, NameReader
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.words import words_of

__all__ = ["Matcher", "Named"]

_RESPELLED = 0.9
_LEAST = 0.05
_LEAST_SHARE = 0.2
"""Of its score a match keeps so much however unlikely its reading is: it is still a candidate."""
_WRONG_SIZE, _RIGHT_SIZE = 0.05, 10.0
"""How much a size that is wrong or right for what a thing is called makes a reading less or more likely, at most."""
_LOG_WRONG, _LOG_RIGHT = log(_WRONG_SIZE), log(_RIGHT_SIZE)
_SIZE_POWER, _SIZE_OFFSET = 0.6, 0.3
"""How far `surprise` is heard: models of things vary more than things do, and many names are of parts."""
_NEAR_KIND = 1
"""Steps up in the taxonomy to a thing whose usual size is taken for one's own."""
_AGREEING = 0.8
"""Other matches of a reading count for their classes if they score this much of its best."""
_SMALLEST_PLACE = 2.0
"""Metres. What is called after a place and is smaller all round is something in the place or of it."""


class _Answer(NamedTuple):
    """What one class has of a reading."""

    match: Match
    """The best one of the class."""
    score: float
    share: float
    """1 for a match that is as good as the best one, less for a lesser sense of the word."""


class _Head(NamedTuple):
    """What is known of a word as the head of a name."""

    place: float
    """1 if it may be a place, else 0."""
    telling: float
    """Logarithm of how likely it does more than describe, at the end of a name of several words."""
    telling_within: float
    """The same before the last word."""
    propensity: float
    kinds: tuple[str, ...]
    """What it is a kind of, itself first, without spaces: things whose usual size may be taken for its own."""


class _Above(NamedTuple):
    """What the name of the parent says."""

    written: frozenset[str]
    """Its words as they are written, if there are several: `mugs` is no `mug`."""
    words: tuple[str, ...]
    """Its words as they were understood."""
    understood: frozenset[str]
    """The same as a set."""


_NO_PARENT = _Above(frozenset(), (), frozenset())


class Named(NamedTuple):
    """What the words up to one of them name."""

    run: tuple[str, ...]
    """The words at the end that are known together; empty if they name nothing."""
    matches: tuple[Match, ...]
    log_score: float
    """Logarithm of the score of the best match."""
    answers: tuple[_Answer, ...]
    """The best match of each class."""
    class_iri: ClassIRI | None
    """The class of the best match; None if they name nothing."""


_NOTHING = Named((), (), 0.0, (), None)


class Matcher:
    """Finds the classes for the phrases of one TBox."""

    def __init__(
        self, tbox: TBox, lexicon: Lexicon, taxonomy: Taxonomy, reader: NameReader, *, heeds_routes: bool = True
    ) -> None:
        """Begin; for `heeds_routes` see `Namer`."""
        self._tbox = tbox
        self._taxonomy = taxonomy
        self._reader = reader
        self._namer = Namer(tbox, lexicon, taxonomy, reader, heeds_routes=heeds_routes)
        self.is_fallback = self._namer.is_fallback
        # What a word is depends on nothing else, and the readings of a name say the same words over and over.
        self._head = lru_cache(maxsize=16384)(self._knowing)
        self._named = lru_cache(maxsize=4096)(self._naming)
        self._above = lru_cache(maxsize=4096)(self._reading_above)
        self._named_turned = lru_cache(maxsize=4096)(self._naming_turned)

    def match(self, phrase: NamePhrase, parents: tuple[str, ...], size: Size | None = None) -> list[Match]:
        """Return the classes a phrase may name, best first; none if no word of it is known.

        Each word at which the phrase proper may end is tried as its head: the bowl of `bowl_salad_oak`. How likely
        that is weighs what follows (materials, flavours, colours and places may, another thing hardly), whether a term
        of several words ends there, and whether a thing called so has about the given size.

        Args:
            phrase: the name.
            parents: the names of the prims above, outermost first.
            size: extents of the object in metres, in any order.
        """
        return self.weigh(phrase, parents, size)[0]

    def weigh(
        self, phrase: NamePhrase, parents: tuple[str, ...], size: Size | None = None
    ) -> tuple[list[Match], float]:
        """Return the classes a phrase may name as `match` does, and how likely a thing of that size is called so."""
        readings = [
            (likelihood(features), named.answers, end) for end, features, named in self.ends(phrase, parents, size)
        ]
        total = sum([weight for weight, _, _ in readings])
        best: dict[ClassIRI, tuple[float, float, Match, int]] = {}
        shares: dict[ClassIRI, float] = {}
        for weight, answers, end in readings:
            for match, score, share in answers:
                iri = match.class_iri
                # Readings that agree on a class add up: a door handle and a lever are handles both.
                shares[iri] = shares.get(iri, 0.0) + weight / total * share
                if iri not in best or best[iri][0] < score * weight:
                    best[iri] = score * weight, score, match, end
        matches = [
            Match(iri, score * (_LEAST_SHARE + (1 - _LEAST_SHARE) * shares[iri]), match.reason, phrase, end)
            for iri, (_, score, match, end) in best.items()
        ]
        return sorted(matches, key=lambda match: (-match.score, match.class_iri)), total

    def thing(self, phrase: NamePhrase) -> int | None:
        """Return the row of the everyday thing that a phrase names by its last words, see `thing_rows`; maybe None."""
        if not phrase.words:
            return None
        *before, last = phrase.words
        singular = self._taxonomy.singular(last)
        runs = ["".join(before[start:]) + singular for start in range(len(phrase.words))]
        rows = (thing_row(noun) for noun in (*runs, *self._head(last).kinds))
        return next((row for row in rows if row is not None), None)

    def ends(
        self, phrase: NamePhrase, parents: tuple[str, ...], size: Size | None
    ) -> list[tuple[int, Features, Named]]:
        """Return the ends of the phrase proper that name something, nearest first.

        Each is the number of words before it, the features of `heads`, and what is named there.
        """
        words, places, is_respelled = (
            phrase.words,
            self._namer.places(phrase.context, parents),
            bool(phrase.corrections),
        )
        above = self._above(parents[-1]) if parents else _NO_PARENT
        whole = phrase.context or above.words
        heads = [self._named_of(whole, words[:end], places, is_respelled) for end in range(1, len(words) + 1)]
        linked = _are_within(heads)
        found = [
            (end, self._features(phrase, end, named, size, above, is_linked=linked[end - 1]), named)
            for end, named in enumerate(heads, start=1)
            if named.run and not (self._is_too_small(named.run, size) and self._is_beside_unknown(end, words))
        ]
        if phrase.is_head_last:
            return [reading for reading in found if reading[0] == len(words)]
        turned = []
        for at in range(1, len(words)):
            # The head may stand before the word that tells its kind, as in `plate_dinner`.
            named = self._named_turned(words[at - 1], words[at], is_respelled)
            # Written as one it does so at the beginning, as in `BowlSalad`, where the two are no term as they stand.
            may_be_turned = not phrase.is_glued(at) or (at == 1 and len(heads[at].run) == 1)
            if named.run and may_be_turned:
                # A dinner plate is a plate: what speaks for the plate must not speak against the dinner plate.
                found = [read for read in found if read[0] != at or not self._is_more_telling(named, read[2])]
                turned.append((at + 1, self._features(phrase, at + 1, named, size, above, is_turned=True), named))
        return [*found, *turned]

    def _named_of(
        self, whole: tuple[str, ...], words: tuple[str, ...], places: tuple[str, ...], is_respelled: bool
    ) -> Named:
        """Return what words name by themselves, or as a part of something: the `seat_left` of a couch is a couch seat.

        Args:
            whole: the words of the name above, or of the part of the name that repeats it.
            words: the name up to an end.
            places: see `Namer.places`.
            is_respelled: whether a word was corrected.
        """
        named = self._named(words, places, is_respelled)
        of = self._namer.whole_of(words, whole)
        if not of:
            return named
        part = self._named((*of, *words), places, is_respelled)
        # That a cabinet in the kitchen is a kitchen cabinet is known from the places.
        is_placed = self._reader.kinds.is_place(of[-1]) and self._is_below(part, named)
        return named if part.class_iri == named.class_iri or is_placed else part

    def _is_more_telling(self, turned: Named, plain: Named) -> bool:
        """Return whether a turned term is of a kind of what the head is alone: a `cabinet_wall`, no first-aid one."""
        return len(plain.run) == 1 and self._is_below(turned, plain)

    def _is_below(self, special: Named, general: Named) -> bool:
        one, other = special.class_iri, general.class_iri
        return one is not None and other is not None and one != other and self._tbox.is_subclass(one, other)

    def _reading_above(self, parent: str) -> _Above:
        words, written = self._reader.read(parent).words, words_of(parent)
        return _Above(frozenset(written) if len(written) > 1 else frozenset(), words, frozenset(words))

    def _naming(self, words: tuple[str, ...], places: tuple[str, ...], is_respelled: bool) -> Named:
        return _named(*self._namer.name(words, places), is_respelled)

    def _naming_turned(self, head: str, kind: str, is_respelled: bool) -> Named:
        run = (kind, self._taxonomy.singular(head))
        return _named(run, self._namer.name_compound(run), is_respelled)

    def _features(
        self,
        phrase: NamePhrase,
        end: int,
        named: Named,
        size: Size | None,
        above: _Above,
        *,
        is_linked: bool = False,
        is_turned: bool = False,
    ) -> Features:
        run, behind = named.run, phrase.words[end:]
        head, is_lone = self._head(run[-1]), len(run) == 1
        fit = None if size is None else self._fit(run, size, head, phrase.words[: max(0, end - 1)])
        is_shared = above.understood.issuperset(phrase.words[:end]) and not above.understood.issuperset(behind)
        # By position: this is asked for each end of each reading of a name.
        return Features(
            named.log_score,
            (head.telling_within if behind else head.telling) if is_lone and len(phrase.words) > 1 else 0.0,
            0.0 if is_lone else 1.0,
            1.0 if behind and not is_lone else 0.0,
            fit or 0.0,
            1.0 if size is not None and fit is None else 0.0,
            1.0 if any(read == run[-1] for _, read in phrase.corrections) else 0.0,
            1.0 if behind else 0.0,
            float(phrase.glued_on(end)),
            head.propensity if is_lone else 0.0,
            sum([self._head(word).propensity for word in behind]) / len(behind) if behind else 0.0,
            1.0 if is_linked else 0.0,
            1.0 if is_turned else 0.0,
            head.place,
            1.0 if is_shared else 0.0,
            1.0 if is_lone and end > 1 and run[-1] in above.written else 0.0,
        )

    def _fit(self, run: tuple[str, ...], size: Size, head: _Head, before: tuple[str, ...]) -> float | None:
        """Return the logarithm of how much likelier a size makes it that a thing is called so; None if unknown."""
        is_lone = len(run) == 1
        if self._is_too_small(run, size):
            return _LOG_WRONG
        # Of a compound only its own size counts: a spice rack is no rack of usual size.
        value = surprise(size, "".join(run))
        if is_lone:
            # The door in `upper_cabinet_shaker_door` may have the size of a cabinet's.
            special = (surprise(size, word + run[0]) for word in before)
            value = max((found for found in (value, *special) if found is not None), default=None)
        if value is None and is_lone:
            values = (surprise(size, kind) for kind in head.kinds)
            value = next((value for value in values if value is not None), None)
        return None if value is None else max(_LOG_WRONG, min(_LOG_RIGHT, _SIZE_POWER * value + _SIZE_OFFSET))

    def _is_too_small(self, run: tuple[str, ...], size: Size | None) -> bool:
        """Return whether a word is a place for which a thing is too small: a `kitchen_scails` is no kitchen."""
        return size is not None and len(run) == 1 and max(size) < _SMALLEST_PLACE and self._head(run[0]).place > 0

    def _is_beside_unknown(self, end: int, words: tuple[str, ...]) -> bool:
        """Return whether a name has other words than the one at an end, and none of them is known."""
        others = (*words[: end - 1], *words[end:])
        return bool(others) and not any(map(self._reader.kinds.is_known, others))

    def _knowing(self, word: str) -> _Head:
        telling, within = (1 - self._reader.kinds.trailing(word, is_last=is_last) for is_last in (True, False))
        return _Head(
            place=float(self._reader.kinds.is_place(word)),
            telling=log(max(telling, _LEAST)),
            telling_within=log(max(within, _LEAST)),
            propensity=propensity(word),
            kinds=self._near_kinds(word),
        )

    def _near_kinds(self, word: str) -> tuple[str, ...]:
        """Return what a thing is a kind of, nearest first: a fridge is a refrigerator."""
        sense = max(self._taxonomy.senses(self._taxonomy.singular(word)), key=sense_weight, default=None)
        if sense is None:
            return ()
        near = [up for up, hops in self._taxonomy.walk_up(sense.synset) if hops <= _NEAR_KIND]
        return tuple(self._taxonomy.name(up).replace(" ", "") for up in near)


def _named(run: tuple[str, ...], matches: tuple[Match, ...], is_respelled: bool) -> Named:
    """Return what a run of words names; if they were misspelt it counts for less."""
    if not matches:
        return _NOTHING
    part = _RESPELLED if is_respelled else 1.0
    scores = sorted([(match.score * part, match) for match in matches], key=itemgetter(0))
    best = {match.class_iri: (match, score) for score, match in scores}
    good = _AGREEING * scores[-1][0]
    answers = [_Answer(match, score, 1.0 if score > good else score) for match, score in best.values()]
    return Named(run, matches, log(max([match.score for match in matches])), tuple(answers), scores[-1][1].class_iri)


def _are_within(heads: Sequence[Named]) -> list[bool]:
    """Return for each head whether a term that ends later begins at it or before: the swab of a `cotton_swab_jar`."""
    within, first = [False] * len(heads), len(heads)
    for end in range(len(heads), 0, -1):
        within[end - 1] = first < end
        first = min(first, end - len(heads[end - 1].run))
    return within
