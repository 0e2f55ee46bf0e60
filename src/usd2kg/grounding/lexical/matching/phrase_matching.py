"""Match a noun phrase with classes: every word that may be its head noun is matched and weighted."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from math import log
from typing import NamedTuple

from usd2kg.grounding.lexical.concepts.extent import Extent
from usd2kg.grounding.lexical.concepts.senses import usual_sense
from usd2kg.grounding.lexical.concepts.sizes import (
    everyday_object_row,
    size_log_likelihood_ratio,
)
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.matching.head_matching import HeadMatcher, HeadMatches, Match
from usd2kg.grounding.lexical.reading.head_noun import HeadFeatures, head_likelihood, head_log_odds
from usd2kg.grounding.lexical.reading.noun_phrase import NamePhrase, NameReader
from usd2kg.grounding.lexical.settings import HEAD_NOUN
from usd2kg.ontology import ClassIRI
from usd2kg.words import words_of

__all__ = ["HeadCandidate", "PhraseMatcher"]

_MIN_LOG_RATIO, _MAX_LOG_RATIO = log(HEAD_NOUN.min_size_ratio), log(HEAD_NOUN.max_size_ratio)


class _ClassScore(NamedTuple):
    """A class that the words up to one head noun may mean."""

    match: Match
    """Its best match."""
    score: float
    share: float
    """1 if the score is close to that of the best class, otherwise the score."""


class HeadCandidate(NamedTuple):
    """The possible meanings of the words up to one head noun."""

    words: tuple[str, ...]
    """The known compound that ends with the head noun; empty if the head noun is unknown."""
    matches: tuple[Match, ...]
    log_score: float
    """Logarithm of the score of the best match."""
    classes: tuple[_ClassScore, ...]
    """The best match of each class."""
    class_iri: ClassIRI | None
    """The class of the best match; None without matches."""


_UNKNOWN_HEAD = HeadCandidate((), (), 0.0, (), None)


class _WordTraits(NamedTuple):
    """Properties of a word as a head noun."""

    is_place: bool
    log_not_modifier: float
    """Logarithm of the probability that the word, last in a name of several words, is not a modifier."""
    log_not_modifier_within: float
    """The same for a word before the last."""
    log_odds: float
    """See `head_log_odds`."""
    kinds: tuple[str, ...]
    """The lemmas of the word's usual sense and its direct hypernyms, without spaces, nearest first."""


class _ParentWords(NamedTuple):
    """Words of the name of the parent prim."""

    written: frozenset[str]
    """As written, if there are several: `mugs` does not repeat `mug`."""
    words: tuple[str, ...]
    """As read."""
    known: frozenset[str]
    """The same as a set."""


_NO_PARENT = _ParentWords(frozenset(), (), frozenset())


class PhraseMatcher:
    """Matches noun phrases with the meanings of their head nouns: classes of a TBox, or concepts."""

    def __init__(self, heads: HeadMatcher, taxonomy: Taxonomy, reader: NameReader) -> None:
        self._taxonomy = taxonomy
        self._reader = reader
        self._heads = heads
        # The readings of a name repeat the same words.
        self._traits = lru_cache(maxsize=16384)(self._find_traits)
        self._head = lru_cache(maxsize=4096)(self._match_head)
        self._inverted_head = lru_cache(maxsize=4096)(self._match_inverted_head)
        self._parent_words = lru_cache(maxsize=4096)(self._read_parent_words)
        # Copies of one model have the same name and size.
        self._known_matches = lru_cache(maxsize=16384)(self._find_matches)

    def match(self, phrase: NamePhrase, parents: tuple[str, ...], extent: Extent | None = None) -> list[Match]:
        """Return the classes that a phrase may mean, best first; none if no word is known.

        Each word is tried as the head noun: the bowl of `bowl_salad_oak`. Its weight depends on what follows, on
        whether a known compound ends there, and on whether such an object has the given size.

        Args:
            phrase: the name.
            parents: the names of the prims above, outermost first.
            extent: the size of the object.
        """
        return self.match_with_likelihood(phrase, parents, extent)[0]

    def match_with_likelihood(
        self, phrase: NamePhrase, parents: tuple[str, ...], extent: Extent | None = None
    ) -> tuple[list[Match], float]:
        """Return the classes as `match` does, and the likelihood of such a name for an object of that size."""
        places, parent = self._surroundings(phrase, parents)
        matches, likelihood = self._known_matches(phrase, phrase.glued, places, parent, extent)
        return list(matches), likelihood

    def _surroundings(self, phrase: NamePhrase, parents: tuple[str, ...]) -> tuple[tuple[str, ...], _ParentWords]:
        parent = self._parent_words(parents[-1]) if parents else _NO_PARENT
        # Copies are usually below many prims that have nothing to do with them.
        parent = parent if self._is_related(phrase, parent) else _NO_PARENT
        return self._heads.place_words(phrase.words, phrase.context, parents), parent

    def _is_related(self, phrase: NamePhrase, parent: _ParentWords) -> bool:
        """Return whether the words of the parent may affect the matches of a phrase."""
        words = phrase.words
        nouns = {*words, *map(self._taxonomy.singular, words)}
        if not (parent.known.isdisjoint(nouns) and parent.written.isdisjoint(nouns)):
            return True
        ends = range(1, len(words) + 1)
        return not phrase.context and any(self._heads.whole_words(words[:end], parent.words) for end in ends)

    def _find_matches(
        self,
        phrase: NamePhrase,
        glued: tuple[bool, ...],
        places: tuple[str, ...],
        parent: _ParentWords,
        extent: Extent | None,
    ) -> tuple[tuple[Match, ...], float]:
        """Return the classes, best first, and the likelihood; `glued` tells apart phrases that compare equal."""
        assert glued == phrase.glued
        heads = [
            (head_likelihood(features), head.classes, end)
            for end, features, head in self._head_candidates(phrase, places, parent, extent)
        ]
        total = sum([weight for weight, _, _ in heads])
        best: dict[ClassIRI, tuple[float, _ClassScore, int]] = {}
        shares: dict[ClassIRI, float] = {}
        for weight, classes, end in heads:
            for found in classes:
                iri = found.match.class_iri
                # Heads that agree on a class add up: a door handle and a lever are both handles.
                shares[iri] = shares.get(iri, 0.0) + weight / total * found.share
                if iri not in best or best[iri][0] < found.score * weight:
                    best[iri] = found.score * weight, found, end
        base = HEAD_NOUN.min_share
        matches = [
            found.match._replace(score=found.score * (base + (1 - base) * shares[iri]), phrase=phrase, end=end)
            for iri, (_, found, end) in best.items()
        ]
        return tuple(sorted(matches, key=lambda match: (-match.score, match.class_iri))), total

    def head_shares(
        self, phrase: NamePhrase, parents: tuple[str, ...], extent: Extent | None
    ) -> list[tuple[float, tuple[str, ...]]]:
        """Return each known compound that the words up to a possible head noun end with, and its probability."""
        found = [
            (head_likelihood(features), head.words)
            for _, features, head in self.head_candidates(phrase, parents, extent)
        ]
        total = sum([likelihood for likelihood, _ in found])
        return [(likelihood / total, words) for likelihood, words in found]

    def find_object_row(self, phrase: NamePhrase) -> int | None:
        """Return the row in `everyday_objects.csv` of the object that a phrase names by its last words, or None."""
        if not phrase.words:
            return None
        *before, last = phrase.words
        singular = self._taxonomy.singular(last)
        compounds = ["".join(before[start:]) + singular for start in range(len(phrase.words))]
        rows = (everyday_object_row(noun) for noun in (*compounds, *self._traits(last).kinds))
        return next((row for row in rows if row is not None), None)

    def head_candidates(
        self, phrase: NamePhrase, parents: tuple[str, ...], extent: Extent | None
    ) -> list[tuple[int, HeadFeatures, HeadCandidate]]:
        """Return the words that may be the head noun, in order, as (number of words up to it, features, meaning)."""
        return self._head_candidates(phrase, *self._surroundings(phrase, parents), extent)

    def _head_candidates(
        self, phrase: NamePhrase, places: tuple[str, ...], parent: _ParentWords, size: Extent | None
    ) -> list[tuple[int, HeadFeatures, HeadCandidate]]:
        words = phrase.words
        is_corrected = bool(phrase.corrections)
        whole = phrase.context or parent.words
        heads = [self._head_of_part(whole, words[:end], places, is_corrected) for end in range(1, len(words) + 1)]
        inside = _are_inside_compounds(heads)
        candidates = [
            (end, self._features(phrase, end, head, size, parent, is_inside=inside[end - 1]), head)
            for end, head in enumerate(heads, start=1)
            if head.words
        ]
        if phrase.is_head_last:
            return [candidate for candidate in candidates if candidate[0] == len(words)]
        inverted = []
        for end, head in self._inverted_compounds(phrase, heads, is_corrected):
            # The head alone must not compete with its compound: a `plate_dinner` is a dinner plate.
            candidates = [
                known for known in candidates if known[0] != end - 1 or not self._is_inversion_of(head, known[2])
            ]
            inverted.append((end, self._features(phrase, end, head, size, parent, is_inverted=True), head))
        return [*candidates, *inverted]

    def _inverted_compounds(
        self, phrase: NamePhrase, heads: Sequence[HeadCandidate], is_corrected: bool
    ) -> Iterator[tuple[int, HeadCandidate]]:
        """Yield (number of words, meaning) of compounds whose head noun comes first, as in `plate_dinner`.

        In camel case (`BowlSalad`) only the first two words are tried, unless they are a known compound as written.
        """
        words = phrase.words
        for at in range(1, len(words)):
            head = self._inverted_head(words[at - 1], words[at], is_corrected)
            if head.words and (not phrase.is_glued(at) or (at == 1 and len(heads[at].words) == 1)):
                yield at + 1, head

    def _head_of_part(
        self, whole: tuple[str, ...], words: tuple[str, ...], places: tuple[str, ...], is_corrected: bool
    ) -> HeadCandidate:
        """Return the meanings of words alone or as a part of a whole: the `seat_left` of a couch is a couch seat.

        Args:
            whole: the words of the parent's name, or of the part of the name that repeats it.
            words: the words of the name up to a head noun.
            places: see `HeadMatcher.place_words`.
            is_corrected: whether the spelling of a word was corrected.
        """
        head = self._head(words, places, is_corrected)
        prefix = self._heads.whole_words(words, whole)
        if not prefix:
            return head
        part = self._head((*prefix, *words), places, is_corrected)
        # `place_words` covers subclasses named after a place: a cabinet in the kitchen.
        is_in_place = self._reader.kinds.is_place(prefix[-1]) and self._is_strict_subclass(part, head)
        return head if part.class_iri == head.class_iri or is_in_place else part

    def _is_inversion_of(self, inverted: HeadCandidate, head: HeadCandidate) -> bool:
        return len(head.words) == 1 and self._is_strict_subclass(inverted, head)

    def _is_strict_subclass(self, one: HeadCandidate, other: HeadCandidate) -> bool:
        special, general = one.class_iri, other.class_iri
        if special is None or general is None or special == general:
            return False
        return self._heads.is_subclass(special, general)

    def _read_parent_words(self, parent: str) -> _ParentWords:
        words, written = self._reader.read(parent).words, words_of(parent)
        return _ParentWords(frozenset(written) if len(written) > 1 else frozenset(), words, frozenset(words))

    def _match_head(self, words: tuple[str, ...], places: tuple[str, ...], is_corrected: bool) -> HeadCandidate:
        return _head_candidate(self._heads.match(words, places), is_corrected)

    def _match_inverted_head(self, head: str, modifier: str, is_corrected: bool) -> HeadCandidate:
        words = (modifier, self._taxonomy.singular(head))
        return _head_candidate(HeadMatches(words, self._heads.match_compound(words)), is_corrected)

    def _features(
        self,
        phrase: NamePhrase,
        end: int,
        head: HeadCandidate,
        size: Extent | None,
        parent: _ParentWords,
        *,
        is_inside: bool = False,
        is_inverted: bool = False,
    ) -> HeadFeatures:
        noun, is_single = head.words[-1], len(head.words) == 1
        traits, behind = self._traits(noun), phrase.words[end:]
        log_ratio = None
        if size is not None:
            log_ratio = self._size_log_ratio(head.words, size, traits, phrase.words[: max(0, end - 1)])
        log_not_modifier = traits.log_not_modifier_within if behind else traits.log_not_modifier
        # Positional, since this runs for each word of each reading of a name.
        return HeadFeatures(
            head.log_score,
            log_not_modifier if is_single and len(phrase.words) > 1 else 0.0,
            0.0 if is_single else 1.0,
            1.0 if behind and not is_single else 0.0,
            log_ratio or 0.0,
            1.0 if size is not None and log_ratio is None else 0.0,
            1.0 if any(read == noun for _, read in phrase.corrections) else 0.0,
            1.0 if behind else 0.0,
            float(phrase.glued_on(end)),
            traits.log_odds if is_single else 0.0,
            sum([self._traits(word).log_odds for word in behind]) / len(behind) if behind else 0.0,
            1.0 if is_inside else 0.0,
            1.0 if is_inverted else 0.0,
            float(traits.is_place),
            1.0 if parent.known.issuperset(phrase.words[:end]) and not parent.known.issuperset(behind) else 0.0,
            1.0 if is_single and end > 1 and noun in parent.written else 0.0,
        )

    def _size_log_ratio(
        self, words: tuple[str, ...], extent: Extent, traits: _WordTraits, before: tuple[str, ...]
    ) -> float | None:
        """Return the bounded log-likelihood ratio of a size for a noun; None if its usual size is unknown.

        A compound has only its own usual size: a spice rack is not the size of a rack. A single noun may have the usual
        size of a compound with any word before it, or else that of a hypernym.
        """
        is_single = len(words) == 1
        if is_single and traits.is_place and extent.is_below_places:
            return _MIN_LOG_RATIO
        size = extent.size
        ratio = size_log_likelihood_ratio(size, "".join(words))
        if is_single:
            compounds = (size_log_likelihood_ratio(size, word + words[0]) for word in before)
            ratio = max((found for found in (ratio, *compounds) if found is not None), default=None)
            if ratio is None:
                by_kind = (size_log_likelihood_ratio(size, kind) for kind in traits.kinds)
                ratio = next((found for found in by_kind if found is not None), None)
        if ratio is None:
            return None
        return max(_MIN_LOG_RATIO, min(_MAX_LOG_RATIO, HEAD_NOUN.size_power * ratio + HEAD_NOUN.size_offset))

    def _find_traits(self, word: str) -> _WordTraits:
        last, within = (1 - self._reader.kinds.modifier_share(word, is_last=is_last) for is_last in (True, False))
        return _WordTraits(
            is_place=self._reader.kinds.is_place(word),
            log_not_modifier=log(max(last, HEAD_NOUN.min_not_modifier)),
            log_not_modifier_within=log(max(within, HEAD_NOUN.min_not_modifier)),
            log_odds=head_log_odds(word),
            kinds=self._near_kinds(word),
        )

    def _near_kinds(self, word: str) -> tuple[str, ...]:
        sense = usual_sense(self._taxonomy.singular(word), self._taxonomy)
        if sense is None:
            return ()
        near = [up for up, steps in self._taxonomy.walk_up(sense.synset) if steps <= HEAD_NOUN.size_steps]
        return tuple(self._taxonomy.name(up).replace(" ", "") for up in near)


def _head_candidate(found: HeadMatches, is_corrected: bool) -> HeadCandidate:
    """Return a head noun with its matches; corrected spelling lowers the scores."""
    words, matches = found
    if not matches:
        return _UNKNOWN_HEAD
    factor = HEAD_NOUN.corrected_factor if is_corrected else 1.0
    ascending = sorted(matches, key=lambda match: match.score)
    best = {match.class_iri: (match, match.score * factor) for match in ascending}
    min_equal = HEAD_NOUN.equal_score_ratio * ascending[-1].score * factor
    classes = [_ClassScore(match, score, 1.0 if score > min_equal else score) for match, score in best.values()]
    return HeadCandidate(words, matches, log(ascending[-1].score), tuple(classes), ascending[-1].class_iri)


def _are_inside_compounds(heads: Sequence[HeadCandidate]) -> list[bool]:
    """Return for each head noun whether a later compound contains it: the swab of a `cotton_swab_jar`."""
    inside, first = [False] * len(heads), len(heads)
    for end in range(len(heads), 0, -1):
        inside[end - 1] = first < end
        first = min(first, end - len(heads[end - 1].words))
    return inside
