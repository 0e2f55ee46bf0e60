"""Score the classes that the words of an object support: its name, asset, labels, documentation, groups and parts."""

from collections.abc import Iterator, Sequence
from functools import cached_property, lru_cache, partial

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.concepts.extent import Extent, extent_of
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.evidence_combination import ScoredClass
from usd2kg.grounding.lexical.matching.head_matching import ClassRanker, Match
from usd2kg.grounding.lexical.matching.phrase_matching import PhraseMatcher
from usd2kg.grounding.lexical.reading.abbreviations import AbbreviationReader, Reading
from usd2kg.grounding.lexical.reading.english_words import SHORTEST_WORD, is_english_word
from usd2kg.grounding.lexical.reading.evidence_texts import texts_of
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.grounding.lexical.reading.object_words import ObjectWords, object_words
from usd2kg.grounding.lexical.reading.shortening import may_be_short
from usd2kg.grounding.lexical.settings import ABBREVIATED_NAME, EVIDENCE, KIND_RANKING
from usd2kg.languages import translate
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.words import is_content_word, split_identifier

__all__ = ["NameEvidence"]

_WEIGHTS = {
    "name": EVIDENCE.name_weight,
    "asset": EVIDENCE.asset_weight,
    "documentation": EVIDENCE.documentation_weight,
    "hierarchy": EVIDENCE.group_weight,
    "labels": EVIDENCE.label_weight,
    "parts": EVIDENCE.part_weight,
}
_SOURCES = {
    "asset": "asset",
    "documentation": "documentation",
    "hierarchy": "group",
    "labels": "label",
    "parts": "parts",
}
"""Evidence group → its name in explanations."""


class NameEvidence:
    """Scores classes by words, for one TBox."""

    def __init__(
        self,
        tbox: TBox,
        lexicon: Lexicon,
        taxonomy: Taxonomy,
        reader: NameReader,
        matcher: PhraseMatcher,
        ranker: ClassRanker | None = None,
    ) -> None:
        self._tbox = tbox
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._reader = reader
        self._matcher = matcher
        self._ranker = ranker
        self._match_equalized = lru_cache(maxsize=8192)(self._match)

    def words_of(self, view: ObjectView) -> ObjectWords:
        """Return what the words of a view depend on."""
        return object_words(view, self._reader)

    def match(
        self,
        text: str,
        parents: tuple[str, ...],
        extent: Extent | None = None,
        is_made_for_it: bool = False,
    ) -> tuple[Match, ...]:
        """Return the classes that a text means, best first.

        Args:
            text: a name, or another text.
            parents: the names above, outermost first.
            extent: the size of the object; None if it is unknown, or the text is not its name.
            is_made_for_it: whether the ontology is made for the stage.
        """
        return self._match_equalized(*self._reader.equalize(text, parents), extent, is_made_for_it)

    def score_words(self, words: ObjectWords, *, is_made_for_it: bool) -> list[ScoredClass]:
        """Return the classes that words support, best first; reading stops at the first clear source.

        A label that contradicts a clear name or asset decides: somebody stated it about this object, and the name is
        often that of an asset.

        Args:
            words: the words of the object.
            is_made_for_it: see `is_made_for_stage`.
        """
        scored = self._score_until_clear(words, is_made_for_it)
        if words.labels and scored and scored[0].group in {"name", "asset"}:
            stated = self._score_until_clear(words.labels_alone(), is_made_for_it)
            if stated and stated[0].score >= EVIDENCE.clear_score and self._contradicts(stated[0], scored[0]):
                return stated
        return scored

    def _contradicts(self, stated: ScoredClass, named: ScoredClass) -> bool:
        """Return whether a label states another class than the name, and not just a more general one."""
        classes = (named.class_iri, stated.class_iri)
        return all(iri in self._tbox.by_iri for iri in classes) and not self._tbox.is_subclass(*classes)

    def _score_until_clear(self, words: ObjectWords, is_made_for_it: bool) -> list[ScoredClass]:
        scored: list[ScoredClass] = []
        for found in self.score_sources(words, is_made_for_it=is_made_for_it):
            scored = sorted([*scored, *found], key=lambda each: (-each.score, each.class_iri))
            if scored and scored[0].score >= EVIDENCE.clear_score:
                break
        return scored

    def score_sources(self, words: ObjectWords, *, is_made_for_it: bool) -> Iterator[list[ScoredClass]]:
        """Yield the classes that each source of words supports, the most reliable source first; see `score_words`."""
        for group, text in texts_of(words):
            if group in {"hierarchy", "parts"} and self._reader.names_known_noun(words.name):
                # The name is understood and no class fits, so groups and parts could only add a wrong class: a tulip
                # has a stem, and so has a pipe.
                break
            is_name = group == "name"
            above, extent = (words.parents, words.extent) if is_name else ((), None)
            matches = self.match(text, above, extent, is_made_for_it)
            weight = _WEIGHTS[group]
            yield [
                ScoredClass(
                    group, m.class_iri, m.score * weight, partial(_explain_match, m, group), is_listed=m.is_listed
                )
                for m in matches
            ]

    def score_abbreviation(self, view: ObjectView) -> list[ScoredClass]:
        """Return the classes of the readings of an abbreviated name; none if all its words are known."""
        tokens = [part.lower() for part in split_identifier(view.name) if part.isalpha()]
        tokens = [token for token in tokens if is_content_word(token)][: ABBREVIATED_NAME.max_tokens]
        if not tokens or (not view.is_masked and self._is_spelled_out(tokens)):
            return []
        spelled = {token for token in tokens if len(token) >= SHORTEST_WORD and self._is_word(token)}
        return self._score_readings(view, self._read_abbreviation(view, tokens, spelled))

    def complete(self, view: ObjectView, scored: list[ScoredClass]) -> list[ScoredClass]:
        """Return the scores with the unknown words of a clear name expanded: the blade of a `fan_bld`.

        Args:
            view: the object.
            scored: the classes by the known words alone; returned unchanged if no expansion is likely.
        """
        words = self._last_words(self.words_of(view), is_made_for_it=self.is_made_for_stage(view))
        spelled = self._spelled_words(words)
        if spelled.issuperset(words):
            return scored
        readings = self._read_abbreviation(view, words, spelled)
        if (
            not readings
            or readings[0].probability < ABBREVIATED_NAME.min_probability
            or spelled.issuperset(readings[0].words)
        ):
            return scored
        likely = [reading for reading in readings if reading.probability > ABBREVIATED_NAME.negligible_probability]
        rest = 1 - readings[0].probability
        expanded = [
            *self._score_readings(view, likely),
            *(found._replace(score=rest * found.score) for found in scored),
        ]
        return sorted(expanded, key=lambda found: (-found.score, found.class_iri))

    def is_complete(self, words: ObjectWords, *, is_made_for_it: bool) -> bool:
        """Return whether a clear name has no word that `complete` may expand."""
        last = self._last_words(words, is_made_for_it=is_made_for_it)
        return self._spelled_words(last).issuperset(last)

    def _last_words(self, words: ObjectWords, *, is_made_for_it: bool) -> tuple[str, ...]:
        matches = self.match(words.name, words.parents, words.extent, is_made_for_it)
        return matches[0].phrase.words[-ABBREVIATED_NAME.max_tokens :] if matches else ()

    def _spelled_words(self, words: Sequence[str]) -> set[str]:
        return {word for word in words if self._is_word(word) or not may_be_short(word)}

    def _read_abbreviation(self, view: ObjectView, words: Sequence[str], spelled: set[str]) -> list[Reading]:
        parent = view.parents[-1] if view.parents else ""
        return self._abbreviations.read(words, view.neighbourhood, spelled, parent)

    def _score_readings(self, view: ObjectView, readings: Sequence[Reading]) -> list[ScoredClass]:
        """Return the classes of the readings of a name, weighted by probability and fit of the size."""
        shares: dict[ClassIRI, float] = {}
        best: dict[ClassIRI, tuple[float, Reading, Match]] = {}
        # The remaining probability is that the letters abbreviate no word.
        total = ABBREVIATED_NAME.unmatched_weight * (1 - sum(reading.probability for reading in readings))
        for reading in readings:
            phrase = self._reader.phrase(reading.words)
            matches, likelihood = self._matcher.match_with_likelihood(phrase, view.parents, extent_of(view.own_size))
            weight = reading.probability * max(likelihood, ABBREVIATED_NAME.unmatched_weight)
            total += weight
            if matches:
                iri, share = matches[0].class_iri, weight * matches[0].score
                shares[iri] = shares.get(iri, 0.0) + share
                if iri not in best or best[iri][0] < share:
                    best[iri] = share, reading, matches[0]
        return [
            ScoredClass(
                "name",
                iri,
                share / total,
                partial(_explain_reading, view.name, reading, match),
                reading.words,
                match.is_listed,
            )
            for (iri, share), (_, reading, match) in ((item, best[item[0]]) for item in shares.items())
        ]

    @cached_property
    def _abbreviations(self) -> AbbreviationReader:
        # Built on first use: most stages spell their names out.
        return AbbreviationReader(self._lexicon, self._taxonomy)

    def _is_spelled_out(self, tokens: Sequence[str]) -> bool:
        """Return whether all words of a name are known, or it is a name in another language."""
        return all(map(self._is_word, tokens)) or translate(tuple(tokens)) is not None

    def _is_word(self, word: str) -> bool:
        return self._reader.kinds.is_known(word) or is_english_word(word)

    def is_made_for_stage(self, view: ObjectView) -> bool:
        """Return whether the ontology has specific classes for most objects of the stage; True without a stage."""
        if self._ranker is None or self._ranker.is_for_any_stage or view.is_masked or view.neighbourhood is None:
            return True
        return view.neighbourhood.of_stage(self._has_specific_classes)

    def _has_specific_classes(self, names: Sequence[str]) -> bool:
        """Return whether the head nouns of most names lead to another class than the default class."""
        some = sorted(set(names))[:: len(set(names)) // KIND_RANKING.stage_names + 1]
        found = [matches[0].class_iri for name in some if (matches := self.match(name, ()))]
        general = sum(iri == self._lexicon.default_class for iri in found)
        return general <= KIND_RANKING.max_general_share * max(len(found), KIND_RANKING.min_stage_names)

    def _match(
        self, text: str, parents: tuple[str, ...], extent: Extent | None, is_made_for_it: bool
    ) -> tuple[Match, ...]:
        phrase = self._reader.read(text, parents)
        matches = self._matcher.match(phrase, parents, extent)
        if self._ranker is None or not (is_made_for_it or self._ranker.is_for_any_stage):
            return tuple(matches)
        return self._ranker.rank(phrase, parents, extent, matches)


def _explain_match(match: Match, group: str) -> str:
    return match.explanation if group == "name" else f"{match.explanation} (from its {_SOURCES[group]})"


def _explain_reading(name: str, reading: Reading, match: Match) -> str:
    return f"“{name}” may be short for “{' '.join(reading.words)}”: {match.explanation}"
