"""From a noun phrase to classes: the TBox's terms first, then what the head noun is a kind of."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import log
from typing import NamedTuple

from usd2kg.grounding.embedded.heads import likelihood, propensity
from usd2kg.grounding.embedded.lexicon import Lexicon, sense_weight
from usd2kg.grounding.embedded.names import NamePhrase, NameReader
from usd2kg.grounding.embedded.sizes import surprise
from usd2kg.grounding.embedded.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.words import split_identifier

__all__ = ["Match", "Matcher"]

_TERM, _COMPOUND_KIND, _KIND = 0.97, 0.88, 0.82
_HOP_DECAY = 0.965
_ROOT_SHARE = 0.75
_RESPELLED = 0.9
_PLACED = 0.95
_LEAST = 0.05
_LEAST_SHARE = 0.4
"""Of its score a match keeps so much however unlikely its reading is: it is still a candidate."""
_WRONG_SIZE, _RIGHT_SIZE = 0.05, 10.0
"""How much a size that is wrong or right for what a thing is called makes a reading less or more likely, at most."""
_SIZE_POWER, _SIZE_OFFSET = 0.6, 0.3
"""How far `surprise` is heard: models of things vary more than things do, and many names are of parts."""
_AGREEING = 0.8
"""Other matches of a reading count for their classes if they score this much of its best."""
_SMALLEST_PLACE = 2.0
"""Metres: what is smaller is no room, yard or aisle, but may be named after one."""

Size = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Match:
    """A class that a phrase may name."""

    class_iri: ClassIRI
    score: float
    """From 0 to 1; an uncalibrated guess at being right."""
    explanation: str


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
        self._tbox = tbox
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._reader = reader
        self._roots = frozenset(tbox.roots)

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
        ends = range(1, len(phrase.words) + 1)
        readings = [found for end in ends if (found := self._reading(phrase, end, parents, size))]
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

    def _reading(self, phrase: NamePhrase, end: int, parents: tuple[str, ...], size: Size | None) -> "_Reading | None":
        """Return the reading in which the phrase proper ends before word number `end`; None if that names nothing."""
        found = self.features(phrase, end, parents, size)
        if found is None:
            return None
        features, named = found
        note = f" (the thing in “{' '.join(phrase.words)}”)" if phrase.words[end:] else ""
        note += "".join(f" (“{written}” read as “{read}”)" for written, read in phrase.corrections)
        share = _RESPELLED if phrase.corrections else 1.0
        matches = [Match(match.class_iri, match.score * share, match.explanation + note) for match in named]
        return _Reading(likelihood(features), matches)

    def features(
        self, phrase: NamePhrase, end: int, parents: tuple[str, ...], size: Size | None
    ) -> tuple[dict[str, float], list[Match]] | None:
        """Return the features of `heads` for the phrase that ends before word number `end`, and what it names there.

        None if it names nothing.
        """
        words, after = phrase.words[:end], phrase.words[end:]
        run, found = self._at_head(words, (*phrase.context, *_words_above(parents)))
        if not found:
            return None
        is_lone = len(run) == 1
        fit = None if size is None else self._fit(run, size)
        telling = 1 - self._reader.trailing(run[-1], is_last=not after) if is_lone and len(phrase.words) > 1 else 1.0
        features = {
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
            "place": float(self._reader.is_place(run[-1])),
        }
        return features, found

    def _fit(self, run: tuple[str, ...], size: Size) -> float | None:
        """Return the logarithm of how much likelier a size makes it that a thing is called so; None if unknown."""
        if len(run) == 1 and max(size) < _SMALLEST_PLACE and self._reader.is_place(run[0]):
            return log(_WRONG_SIZE)
        # Of a compound only its own size counts: a spice rack is no rack of usual size.
        value = surprise(size, "".join(run))
        if value is None:
            return None
        return max(log(_WRONG_SIZE), min(log(_RIGHT_SIZE), _SIZE_POWER * value + _SIZE_OFFSET))

    def _at_head(self, words: tuple[str, ...], places: tuple[str, ...]) -> tuple[tuple[str, ...], list[Match]]:
        """Return the longest run of words that ends with the last one and is known, and its matches."""
        is_modifier = self._reader.is_modifier(words[-1])
        for start in range(len(words)):
            run = words[start:]
            if is_modifier and len(run) == 1:
                break
            key = "".join((*run[:-1], self._taxonomy.singular(run[-1])))
            found = [*self._by_term(key), *self._by_kind(key, len(run) > 1)]
            if found:
                return run, [*self._in_place(key, run[-1], found, places), *found]
        return (), []

    def _by_term(self, key: str) -> list[Match]:
        term = self._lexicon.terms.get(key)
        if term is None:
            return []
        named = "is the label of" if term.weight == 1.0 else "is a name for"
        text = f"“{term.text}” {named} {self._label(term.class_iri)}"
        return [Match(term.class_iri, _TERM * term.weight, text)]

    def _in_place(self, key: str, head: str, found: list[Match], places: tuple[str, ...]) -> Iterator[Match]:
        """Yield the class that is named after the place: a cabinet in the kitchen is a kitchen cabinet.

        A word that is a class's own label needs no place to be understood.
        """
        term = self._lexicon.terms.get(key)
        if term is not None and term.weight == 1.0:
            return
        above = {match.class_iri for match in found}
        for place in places:
            special = self._lexicon.terms.get(place + key) or self._lexicon.terms.get(place + head)
            if special is None or special.class_iri in above or special.class_iri in self._roots:
                continue
            if any(self._tbox.is_subclass(special.class_iri, iri) for iri in above):
                label = self._label(special.class_iri)
                text = f"a “{key}” in “{place}” is a {special.text}, which is {label}"
                yield Match(special.class_iri, _TERM * special.weight * _PLACED, text)
                return

    def _by_kind(self, key: str, is_compound: bool) -> Iterator[Match]:
        """Yield for each sense of a noun the nearest class above it in the taxonomy."""
        for sense in self._taxonomy.senses(key):
            for synset, hops in self._taxonomy.walk_up(sense.synset):
                anchor = self._lexicon.anchors.get(synset)
                if anchor is None:
                    continue
                score = (_COMPOUND_KIND if is_compound else _KIND) * sense_weight(sense) * _HOP_DECAY**hops
                if anchor.class_iri in self._roots:
                    score *= _ROOT_SHARE
                yield Match(
                    anchor.class_iri, score * anchor.weight, self._kinds(sense.synset, synset, anchor.class_iri)
                )
                break

    def _kinds(self, synset: int, target: int, class_iri: ClassIRI) -> str:
        names = [self._taxonomy.name(step) for step in self._taxonomy.path_up(synset, target)]
        chain = names if len(names) <= 4 else [*names[:2], "…", names[-1]]
        kinds = " is a kind of ".join(f"“{name}”" if name != "…" else name for name in chain)
        return f"{kinds}, which is {self._label(class_iri)}"

    def _label(self, class_iri: ClassIRI) -> str:
        return self._tbox.by_iri[class_iri].local_name


def _words_above(parents: tuple[str, ...]) -> tuple[str, ...]:
    """Return the words of the names above, nearest first."""
    return tuple(word.lower() for parent in reversed(parents) for word in split_identifier(parent))
