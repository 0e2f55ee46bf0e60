"""Recognise the concept of an object from its own words: a sense of a noun, independent of any ontology."""

import json
import math
from collections.abc import Iterable
from functools import lru_cache, partial
from operator import mul
from typing import NamedTuple

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.concepts.extent import Extent, extent_of
from usd2kg.grounding.lexical.concepts.home_names import home_words
from usd2kg.grounding.lexical.concepts.senses import sense_weight
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy, load_taxonomy
from usd2kg.grounding.lexical.matching.head_matching import HeadMatches, Match
from usd2kg.grounding.lexical.matching.phrase_matching import PhraseMatcher
from usd2kg.grounding.lexical.reading.evidence_texts import is_generated_name, texts_of
from usd2kg.grounding.lexical.reading.noun_phrase import NamePhrase, NameReader
from usd2kg.grounding.lexical.reading.object_words import ObjectWords, object_words
from usd2kg.grounding.lexical.reading.shared_prefix import shared_prefix, view_without_prefix
from usd2kg.grounding.lexical.settings import CONCEPT, MATCHING, READING
from usd2kg.grounding.model import Concept
from usd2kg.knowledge import read_text
from usd2kg.words import words_of

__all__ = [
    "ConceptRecognizer",
    "ConfidenceWeights",
    "Recognition",
    "concepts_of_noun",
    "describe_concepts",
    "load_recognizer",
    "share_features",
]


class Recognition(NamedTuple):
    """A concept that an object's words name."""

    concept: str
    """Its IRI."""
    share: float
    """Its share of the scores of all senses that the words may have, 0 to 1."""

    @property
    def confidence(self) -> float:
        """The probability that the concept is right, calibrated on names of objects in homes and workplaces."""
        return round(_confidence_weights().probability(self.share), 4)


class ConfidenceWeights(NamedTuple):
    """P(right) = 1 / (1 + exp(-(intercept + slope · log-odds of the share)))."""

    intercept: float
    slope: float

    def probability(self, share: float) -> float:
        """Return the probability that the concept with a share is right."""
        return 1 / (1 + math.exp(-sum(map(mul, self, share_features(share)))))


def share_features(share: float) -> ConfidenceWeights:
    """Return the features of a share; shares near 1 mean one known sense, not certainty."""
    clipped = min(share, CONCEPT.max_share)
    return ConfidenceWeights(1.0, math.log(clipped / (1 - clipped)))


@lru_cache(maxsize=1)
def _confidence_weights() -> ConfidenceWeights:
    return ConfidenceWeights(**json.loads(read_text("concept_confidence.json"))["weights"])


class ConceptRecognizer:
    """Recognises concepts with the noun taxonomy alone, so that they are the same for every ontology."""

    def __init__(self, taxonomy: Taxonomy) -> None:
        # Not all words of compound names are nouns of the taxonomy: the night of a nightstand.
        self._reader = NameReader(Lexicon({}, {}, home_words().counts, None, frozenset(), frozenset(), {}), taxonomy)
        self._senses = _SenseMatcher(taxonomy, self._reader)
        self._matcher = PhraseMatcher(self._senses, taxonomy, self._reader)
        # Scenes cache results by the identity of the function, and each access to a method creates a new object.
        self._find_prefix = partial(shared_prefix, names_object=self._reader.names_known_noun)
        self._recognize_text = lru_cache(maxsize=8192)(self._read_and_match)
        self._recognize_words = lru_cache(maxsize=1024)(self._recognize_texts)

    def recognize(self, view: ObjectView, words: tuple[str, ...] = ()) -> Recognition | None:
        """Return the concept that an object's words name; None if they name none.

        Args:
            view: the object. Masked regimes hide its words.
            words: what a grounder read the name as, used if the name is abbreviated; empty if it read it as written.
        """
        if not view.is_masked and view.neighbourhood is not None:
            view = view_without_prefix(view, view.neighbourhood.of_stage(self._find_prefix))
        if words and (view.is_masked or not self._is_spelled_out(view.name)):
            return self._match(self._reader.phrase(words), view.parents, extent_of(view.own_size))
        if view.is_masked:
            return None
        return self._recognize_words(object_words(view, self._reader))

    def _recognize_texts(self, words: ObjectWords) -> Recognition | None:
        """Return the concept of the first text that names one, or of a label that contradicts it."""
        named = self._recognize_first(words)
        stated = self._recognize_first(words.labels_alone()) if words.labels else None
        if named is None or stated is None or self._senses.is_subclass(named.concept, stated.concept):
            return named
        return stated

    def _recognize_first(self, words: ObjectWords) -> Recognition | None:
        for group, text in texts_of(words):
            is_name = group == "name"
            if group == "parts" or (is_name and is_generated_name(text)):
                continue
            if group == "hierarchy" and not is_generated_name(words.name) and self._is_spelled_out(words.name):
                # The notepad in the group of nightstands is none.
                return None
            extent = extent_of(words.extent.size) if is_name and words.extent is not None else None
            found = self._recognize_text(text.rstrip("0123456789_"), words.parents if is_name else (), extent)
            if found is not None:
                return found
        return None

    def _is_spelled_out(self, name: str) -> bool:
        phrase = self._reader.read(name)
        return not phrase.corrections and all(map(self._reader.kinds.is_known, phrase.words))

    def _read_and_match(self, text: str, parents: tuple[str, ...], extent: Extent | None) -> Recognition | None:
        return self._match(self._reader.read(text, parents), parents, extent)

    def _match(self, phrase: NamePhrase, parents: tuple[str, ...], extent: Extent | None) -> Recognition | None:
        matches = self._matcher.match(phrase, parents, extent)
        if not matches:
            return None
        return Recognition(matches[0].class_iri, matches[0].score / sum(match.score for match in matches))


class _SenseMatcher:
    """Matches nouns and compounds with their senses."""

    def __init__(self, taxonomy: Taxonomy, reader: NameReader) -> None:
        self._taxonomy = taxonomy
        self._reader = reader
        self._match_noun = lru_cache(maxsize=4096)(self._senses_of)
        self._match_compound_head = lru_cache(maxsize=4096)(partial(self._senses_of, is_compound=True))

    def match(self, words: tuple[str, ...], places: tuple[str, ...]) -> HeadMatches:
        """Return the longest known compound that ends with the last word, and its senses.

        A compound that only the home vocabulary knows has the senses of its last noun: a house wall is a wall.
        """
        *before, last = words
        singular = self._taxonomy.singular(last)
        # A word alone is no modifier: a safe, a notepad.
        may_be_head = not self._reader.kinds.is_modifier(last) or (
            not before and self._reader.kinds.is_object(singular)
        )
        for start in range(len(words) if may_be_head else len(before)):
            key = "".join(before[start:]) + singular
            matches = self._match_noun(key, start < len(before))
            if not matches and key in home_words().compounds:
                matches = self._match_compound_head(singular)
            if matches:
                return HeadMatches(words[start:], matches)
        return HeadMatches((), ())

    def match_compound(self, words: tuple[str, str]) -> tuple[Match, ...]:
        """Return the senses of a compound of two words; empty if it is not known as a compound."""
        return self._match_noun("".join(words), True)

    def place_words(
        self, words: tuple[str, ...], context: tuple[str, ...], parents: tuple[str, ...]
    ) -> tuple[str, ...]:
        """Return no words: a cabinet in the kitchen is a cabinet."""
        return ()

    def whole_words(self, words: tuple[str, ...], whole: tuple[str, ...]) -> tuple[str, ...]:
        """Return the last words of the name of a whole that form a compound with the words of its part."""
        *before, last = words
        key = "".join(before) + self._taxonomy.singular(last)
        starts = (start for start in range(len(whole)) if self._taxonomy.is_phrase("".join(whole[start:]) + key))
        start = next(starts, None)
        return () if start is None else whole[start:]

    def is_subclass(self, special: str, general: str) -> bool:
        """Return whether a concept is a hyponym of another, or the same."""
        above, target = self._taxonomy.find_concept(special), self._taxonomy.find_concept(general)
        return above is not None and any(up == target for up, _ in self._taxonomy.walk_up(above))

    def _senses_of(self, noun: str, is_compound: bool) -> tuple[Match, ...]:
        if len(noun) < READING.min_noun_letters and noun not in home_words().short_names:
            return ()
        score = MATCHING.compound_score if is_compound else MATCHING.noun_score
        return tuple(
            Match(self._taxonomy.concept_iri(sense.synset), score * sense_weight(sense), partial(_explain, noun))
            for sense in self._taxonomy.senses(noun)
        )


def _explain(noun: str) -> str:
    return f"“{noun}” names it"


def concepts_of_noun(noun: str) -> tuple[str, ...]:
    """Return the IRIs of the senses of a noun or compound, in the singular or plural, the usual one first.

    >>> concepts_of_noun("Couches")[0] == concepts_of_noun("sofa")[0]
    True
    """
    taxonomy = load_taxonomy()
    *before, last = words_of(noun) or [""]
    key = "".join(before) + taxonomy.singular(last)
    senses = sorted(taxonomy.senses(key), key=sense_weight, reverse=True)
    return tuple(taxonomy.concept_iri(sense.synset) for sense in senses)


def describe_concepts(iris: Iterable[str]) -> dict[str, Concept]:
    """Return IRI → concept for some concepts and all their hypernyms, sorted by IRI."""
    taxonomy = load_taxonomy()
    synsets = {synset for iri in iris if (synset := taxonomy.find_concept(iri)) is not None}
    everything = {up for synset in synsets for up, _ in taxonomy.walk_up(synset)}
    concepts = (
        Concept(
            iri=taxonomy.concept_iri(synset),
            label=taxonomy.label(synset),
            broader=tuple(map(taxonomy.concept_iri, taxonomy.above(synset))),
        )
        for synset in everything
    )
    return {concept.iri: concept for concept in sorted(concepts, key=lambda concept: concept.iri)}


@lru_cache(maxsize=1)
def load_recognizer() -> ConceptRecognizer:
    """Return the recogniser with the package's taxonomy; it has no state from scenes."""
    return ConceptRecognizer(load_taxonomy())
