"""Rank the classes of a whole name with the nouns that a language model named for each class.

The head noun decides the class of most names, but a word before it decides some: an oxygen wall socket is a gas outlet.
So a name is also compared with each noun as a whole, by the cosine of their TF-IDF vectors over words and letter
n-grams (Salton and Buckley, 1988).
"""

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from usd2kg.grounding.lexical.alignment.terms import Term
from usd2kg.grounding.lexical.concepts.extent import Extent
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.matching.head_matching import Match
from usd2kg.grounding.lexical.reading.noun_phrase import NamePhrase
from usd2kg.grounding.lexical.settings import MATCHING, SIMILARITY
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["SimilarMembers"]


class SimilarMembers:
    """The terms of one TBox, searched by similarity."""

    is_for_any_stage = True

    def __init__(self, terms: Iterable[Term], taxonomy: Taxonomy, tbox: TBox) -> None:
        self._terms = tuple(terms)
        self._taxonomy = taxonomy
        self._tbox = tbox
        features = [self._features(term.text.split()) for term in self._terms]
        counts = Counter(feature for found in features for feature in found)
        self._idf = {feature: self._inverse_frequency(count) for feature, count in counts.items()}
        columns: dict[str, list[tuple[int, float]]] = {}
        for row, found in enumerate(features):
            for feature, value in self._unit_vector(found).items():
                columns.setdefault(feature, []).append((row, value))
        self._columns = {feature: _column(entries) for feature, entries in columns.items()}

    def rank(
        self, phrase: NamePhrase, parents: tuple[str, ...], extent: Extent | None, matches: Sequence[Match]
    ) -> tuple[Match, ...]:
        """Return the matches of a name and the classes of similar terms, ranked by both, as `ClassRanker.rank` does.

        The best one gets the highest score of a match, or the score of a term times its cosine if that is higher. The
        names above and the size do not matter.
        """
        similar = self._find(phrase.words)
        own = {match.class_iri: match for match in matches}
        if not similar:
            return tuple(matches)
        sums = {
            iri: (own[iri].score if iri in own else 0.0)
            + SIMILARITY.weight * (similar[iri][0] if iri in similar else 0.0)
            for iri in dict.fromkeys([*own, *similar])
        }
        best_own = max((match.score for match in matches), default=0.0)
        unit = max(best_own, MATCHING.term_score * next(iter(similar.values()))[0]) / (max(sums.values()) or 1.0)
        ranked = []
        for iri, value in sums.items():
            if iri in own and (iri not in similar or own[iri].score == best_own):
                ranked.append(own[iri]._replace(score=unit * value))
            else:
                reason = partial(self._explain, phrase, similar[iri][1])
                ranked.append(Match(iri, unit * value, reason, phrase, len(phrase.words), is_listed=True))
        return tuple(sorted(ranked, key=lambda match: (-match.score, match.class_iri)))

    def _find(self, words: Sequence[str]) -> dict[ClassIRI, tuple[float, Term]]:
        """Return class → (cosine, term) of its most similar term, the most similar first."""
        cosines = np.zeros(len(self._terms))
        for feature, value in self._unit_vector(self._features(words)).items():
            if feature in self._columns:
                rows, values = self._columns[feature]
                cosines[rows] += value * values
        found: dict[ClassIRI, tuple[float, Term]] = {}
        for row in np.argsort(-cosines, kind="stable")[: SIMILARITY.max_terms].tolist():
            if cosines[row] >= SIMILARITY.min_cosine:
                term = self._terms[row]
                found.setdefault(term.class_iri, (min(1.0, float(cosines[row])), term))
        return found

    def _features(self, words: Sequence[str]) -> dict[str, float]:
        singulars = [self._taxonomy.singular(word) for word in words]
        text, length = f" {' '.join(singulars)} ", SIMILARITY.letters
        letters = {f"letters {text[at : at + length]}" for at in range(len(text) - length + 1)}
        return dict.fromkeys(map("word {}".format, singulars), 1.0) | dict.fromkeys(letters, SIMILARITY.letters_value)

    def _unit_vector(self, features: Mapping[str, float]) -> dict[str, float]:
        unseen = self._inverse_frequency(0)
        weighted = {feature: value * self._idf.get(feature, unseen) for feature, value in features.items()}
        length = math.sqrt(sum(value * value for value in weighted.values())) or 1.0
        return {feature: value / length for feature, value in weighted.items()}

    def _inverse_frequency(self, count: int) -> float:
        return math.log((len(self._terms) + 1) / (count + 0.5))

    def _explain(self, phrase: NamePhrase, term: Term) -> str:
        label = self._tbox.by_iri[term.class_iri].readable_name
        return f"“{' '.join(phrase.words)}” is like “{term.text}”, which is in the alignment a name for {label}"


def _column(entries: Sequence[tuple[int, float]]) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    rows, values = zip(*entries, strict=True)
    return np.array(rows), np.array(values)
