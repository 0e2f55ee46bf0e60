"""From a noun phrase to classes: each word that may be its head is asked what it names."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise
from math import log
from typing import NamedTuple

from usd2kg.grounding.embedded.heads import likelihood, propensity
from usd2kg.grounding.embedded.lexicon import Lexicon, sense_weight
from usd2kg.grounding.embedded.names import NamePhrase, NameReader
from usd2kg.grounding.embedded.naming import Match, Namer
from usd2kg.grounding.embedded.sizes import surprise
from usd2kg.grounding.embedded.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.words import split_identifier

__all__ = ["Matcher", "Size"]

_RESPELLED = 0.9
_LEAST = 0.05
_LEAST_SHARE = 0.4
"""Of its score a match keeps so much however unlikely its reading is: it is still a candidate."""
_WRONG_SIZE, _RIGHT_SIZE = 0.05, 10.0
"""How much a size that is wrong or right for what a thing is called makes a reading less or more likely, at most."""
_SIZE_POWER, _SIZE_OFFSET = 0.6, 0.3
"""How far `surprise` is heard: models of things vary more than things do, and many names are of parts."""
_NEAR_KIND = 1
"""Steps up in the taxonomy to a thing whose usual size is taken for one's own."""
_AGREEING = 0.8
"""Other matches of a reading count for their classes if they score this much of its best."""
_SMALLEST_PLACE = 2.0
"""Metres: what is smaller is no room, yard or aisle, but may be named after one."""

Size = tuple[float, float, float]


class _Reading(NamedTuple):
    """One way to tell the head of a name from what follows it."""

    weight: float
    matches: list[Match]

    def best_by_class(self) -> dict[ClassIRI, Match]:
        """Return the best match of each class."""
        return {match.class_iri: match for match in sorted(self.matches, key=lambda match: match.score)}

    def speaks_for(self, match: Match) -> float:
        """Return 1 for a match that is as good as the best one, less for a lesser sense of the word."""
        return 1.0 if match.score > _AGREEING * max(found.score for found in self.matches) else match.score


class Matcher:
    """Finds the classes for the phrases of one TBox."""

    def __init__(self, tbox: TBox, lexicon: Lexicon, taxonomy: Taxonomy, reader: NameReader) -> None:
        self._taxonomy = taxonomy
        self._reader = reader
        self._namer = Namer(tbox, lexicon, taxonomy, reader)

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
            self._reading(phrase, end, features, named) for end, features, named in self.ends(phrase, parents, size)
        ]
        total = sum(reading.weight for reading in readings)
        best: dict[ClassIRI, Match] = {}
        shares: dict[ClassIRI, float] = {}
        for reading in readings:
            for iri, match in reading.best_by_class().items():
                # Readings that agree on a class add up: a door handle and a lever are handles both.
                shares[iri] = shares.get(iri, 0.0) + reading.weight / total * reading.speaks_for(match)
                if iri not in best or best[iri].score * shares[iri] < match.score * reading.weight / total:
                    best[iri] = match
        answers = [
            Match(iri, match.score * (_LEAST_SHARE + (1 - _LEAST_SHARE) * shares[iri]), match.explanation)
            for iri, match in best.items()
        ]
        return sorted(answers, key=lambda match: (-match.score, match.class_iri)), total

    def _reading(self, phrase: NamePhrase, end: int, features: Mapping[str, float], named: list[Match]) -> "_Reading":
        """Return the reading in which the phrase proper ends before word number `end`."""
        note = f" (the thing in “{' '.join(phrase.words)}”)" if phrase.words[end:] else ""
        note += "".join(f" (“{written}” read as “{read}”)" for written, read in phrase.corrections)
        share = _RESPELLED if phrase.corrections else 1.0
        matches = [Match(match.class_iri, match.score * share, match.explanation + note) for match in named]
        return _Reading(likelihood(features), matches)

    def ends(
        self, phrase: NamePhrase, parents: tuple[str, ...], size: Size | None
    ) -> list[tuple[int, dict[str, float], list[Match]]]:
        """Return the ends of the phrase proper that name something, nearest first.

        Each is the number of words before it, the features of `heads`, and what is named there.
        """
        places = (*phrase.context, *_words_above(parents))
        heads = [(end, *self._namer.name(phrase.words[:end], places)) for end in range(1, len(phrase.words) + 1)]
        named = [
            (end, {**self._features(phrase, end, run, found, size), "linked": float(_is_within(end, heads))}, found)
            for end, run, found in heads
            if found
        ]
        return [*named, *self._turned(phrase, size)]

    def _turned(self, phrase: NamePhrase, size: Size | None) -> Iterator[tuple[int, dict[str, float], list[Match]]]:
        """Yield the ends at which the head stands before the word that tells its kind, as in `plate_dinner`."""
        for at, (head, kind) in enumerate(pairwise(phrase.words), start=1):
            run = (kind, self._taxonomy.singular(head))
            found = list(self._namer.by_term("".join(run)))
            if found and not phrase.is_glued(at):
                features = self._features(phrase, at + 1, run, found, size)
                yield at + 1, features | {"turned": 1.0}, found

    def _features(
        self, phrase: NamePhrase, end: int, run: tuple[str, ...], found: list[Match], size: Size | None
    ) -> dict[str, float]:
        after = phrase.words[end:]
        is_lone = len(run) == 1
        fit = None if size is None else self._fit(run, size)
        telling = 1 - self._reader.trailing(run[-1], is_last=not after) if is_lone and len(phrase.words) > 1 else 1.0
        return {
            "score": log(max(match.score for match in found)),
            "telling": log(max(telling, _LEAST)),
            "compound": float(not is_lone),
            "size": fit or 0.0,
            "no_usual_size": float(size is not None and fit is None),
            "guessed": float(any(read == run[-1] for _, read in phrase.corrections)),
            "behind": float(len(after)),
            "glued": float(phrase.is_glued(end)),
            "propensity": propensity(run[-1]) if is_lone else 0.0,
            "propensity_behind": sum(map(propensity, after)),
            "linked": 0.0,
            "turned": 0.0,
            "place": float(self._reader.is_place(run[-1])),
        }

    def _fit(self, run: tuple[str, ...], size: Size) -> float | None:
        """Return the logarithm of how much likelier a size makes it that a thing is called so; None if unknown."""
        if len(run) == 1 and max(size) < _SMALLEST_PLACE and self._reader.is_place(run[0]):
            return log(_WRONG_SIZE)
        # Of a compound only its own size counts: a spice rack is no rack of usual size.
        value = surprise(size, "".join(run))
        if value is None and len(run) == 1:
            value = self._fit_of_kind(run[0], size)
        if value is None:
            return None
        return max(log(_WRONG_SIZE), min(log(_RIGHT_SIZE), _SIZE_POWER * value + _SIZE_OFFSET))

    def _fit_of_kind(self, word: str, size: Size) -> float | None:
        """Return `surprise` for what a thing is a kind of: a fridge is a refrigerator."""
        sense = max(self._taxonomy.senses(self._taxonomy.singular(word)), key=sense_weight, default=None)
        if sense is None:
            return None
        near = (up for up, hops in self._taxonomy.walk_up(sense.synset) if hops <= _NEAR_KIND)
        values = (surprise(size, self._taxonomy.name(up).replace(" ", "")) for up in near)
        return next((value for value in values if value is not None), None)


def _is_within(end: int, heads: Iterable[tuple[int, tuple[str, ...], list[Match]]]) -> bool:
    """Return whether a term that ends later begins at the head or before it: the swab of a `cotton_swab_jar`."""
    return any(later > end > later - len(run) for later, run, _ in heads)


def _words_above(parents: tuple[str, ...]) -> tuple[str, ...]:
    """Return the words of the names above, nearest first."""
    return tuple(word.lower() for parent in reversed(parents) for word in split_identifier(parent))
