"""Rank the classes of an ontology that nobody prepared by what kinds of things a name means.

Labels and comments of a foreign ontology seldom use the words of WordNet: muffin tins are baking moulds there. So the
words of a name and of all kinds that it may be, by hypernyms and by categories of common usage, are compared with all
labels and comments: by the cosine of TF-IDF vectors (Salton and Buckley, 1988), and by that of the vectors of words,
for which a tap is like a faucet. A conditional logit (McFadden, 1974) over these cosines and the score of the head noun
ranks the classes. `tools/fit_kind_ranking.py` fits its weights on ontologies and names, and writes them to
`data/kind_ranking.json`.
"""

import json
import math
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from functools import cache, lru_cache, partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.grounding.lexical.alignment.label_words import words_of_label
from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.concepts.categories import KindNames
from usd2kg.grounding.lexical.concepts.extent import Extent
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.concepts.word_vectors import load_word_vectors
from usd2kg.grounding.lexical.matching.head_matching import Match
from usd2kg.grounding.lexical.matching.phrase_matching import PhraseMatcher
from usd2kg.grounding.lexical.reading.noun_phrase import NamePhrase, NameReader
from usd2kg.grounding.lexical.settings import KIND_RANKING
from usd2kg.knowledge import read_text
from usd2kg.ontology import ClassIRI, OntologyClass, TBox

__all__ = ["KindFeatures", "KindRanker"]

Values = NDArray[np.float64]
Heads = Sequence[tuple[float, tuple[str, ...]]]
"""Probability and words of each known compound that ends at a possible head noun."""


class KindFeatures(NamedTuple):
    """Features of a class for a name; each has shape (classes,).

    The texts of a class are its label, its comment, and the labels of the classes above it. Cosines of TF-IDF vectors
    are 0 to 1; `similar_…` are cosines of vectors of words, -1 to 1.
    """

    log_score: Values
    """Logarithm of the score of the class by the head noun, at least that of `min_score`."""
    score: Values
    """The score itself; 0 without one."""
    label_kinds: Values
    """Cosine of the label and the kinds."""
    comment_kinds: Values
    above_kinds: Values
    comment_name: Values
    """Cosine of the comment and the name."""
    label_parents: Values
    """Cosine of the label and the names above."""
    comment_parents: Values
    similar_label_kinds: Values
    similar_comment_kinds: Values
    similar_above_kinds: Values
    similar_label_name: Values
    similar_label_head: Values
    """Cosine of the label and a known compound at a head noun, times the probability of the head noun; the highest."""
    similar_comment_name: Values
    similar_above_name: Values
    similar_label_parents: Values
    similar_comment_parents: Values
    is_default: Values
    """Whether it is the default class."""


class KindRanker:
    """The classes of one TBox, ranked by the kinds of what a name means."""

    # Where most things have a general class only, a similar label is chance.
    is_for_any_stage = False

    def __init__(
        self,
        tbox: TBox,
        lexicon: Lexicon,
        taxonomy: Taxonomy,
        reader: NameReader,
        matcher: PhraseMatcher,
        kinds: KindNames,
    ) -> None:
        self._tbox = tbox
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._reader = reader
        self._matcher = matcher
        self._kinds = kinds
        self.classes = tuple(cls.iri for cls in tbox.classes)
        """The columns of the features."""
        self._places = {iri: place for place, iri in enumerate(self.classes)}
        self._is_default = np.array([float(iri == lexicon.default_class) for iri in self.classes])
        labels = {cls.iri: self._label_words(cls) for cls in tbox.classes}
        comments = [[self._words(cls.comment)] for cls in tbox.classes]
        above = [[[word for up in sorted(tbox.closure(iri) - {iri}) for word in labels[up][0]]] for iri in self.classes]
        texts = list(zip(labels.values(), comments, above, strict=True))
        counts = Counter(
            word for of_class in texts for word in {word for kind in of_class for words in kind for word in words}
        )
        self._idf = {word: self._inverse_frequency(count) for word, count in counts.items()}
        self._unseen = self._inverse_frequency(0)
        self._labels, self._comments, self._above = (
            _Index([[self._unit_vector(dict.fromkeys(words, 1.0)) for words in of_class] for of_class in column])
            for column in zip(*texts, strict=True)
        )
        self._vectors = load_word_vectors()
        self._near_labels, self._near_comments, self._near_above = (
            _NearIndex([[self._embed(words) for words in of_class] for of_class in column])
            for column in zip(*texts, strict=True)
        )
        # Names share words and kinds.
        self._kind_words = lru_cache(maxsize=16384)(self._split_kind)
        self._kinds_of = lru_cache(maxsize=4096)(self._find_kinds_of)
        self._head_similarity = lru_cache(maxsize=4096)(self._compute_head_similarity)
        self._name_words = lru_cache(maxsize=4096)(self._read_name_words)

    def rank(
        self, phrase: NamePhrase, parents: tuple[str, ...], extent: Extent | None, matches: Sequence[Match]
    ) -> tuple[Match, ...]:
        """Return the classes as `ClassRanker.rank` does; the best one gets the highest score of a match.

        The matches are returned unchanged if there are none, or if a person decided the best one.
        """
        if not matches or matches[0].is_listed:
            return tuple(matches)
        heads = self._matcher.head_shares(phrase, parents, extent)
        kinds = self.find_kinds(heads)
        utilities = _weights() @ np.stack(self.features(phrase, parents, heads, kinds, matches))
        utilities[[self._places[iri] for iri in self._excluded_classes(heads)]] = -np.inf
        shares = np.exp(utilities - utilities.max())
        own = {match.class_iri: match for match in reversed(matches)}
        highest = max(match.score for match in matches)
        ranked = []
        for place in np.argsort(-shares, kind="stable")[: KIND_RANKING.max_classes].tolist():
            iri, score = self.classes[place], highest * float(shares[place])
            if iri in own:
                ranked.append(own[iri]._replace(score=score))
            else:
                reason = partial(self._explain, phrase, kinds, iri)
                ranked.append(Match(iri, score, reason, phrase, len(phrase.words)))
        return tuple(ranked)

    def _excluded_classes(self, heads: Heads) -> set[ClassIRI]:
        """Return the classes that nothing of a kind belongs to which the likely head nouns may mean."""
        if not self._lexicon.excluded_classes:
            return set()
        lemmas = ["".join(words) for share, words in heads if share >= KIND_RANKING.min_head_share]
        synsets = {sense.synset for lemma in lemmas for sense in self._taxonomy.senses(lemma)}
        kinds = {up for synset in synsets for up, _ in self._taxonomy.walk_up(synset)}
        excluded = (self._lexicon.excluded_classes.get(synset, frozenset()) for synset in kinds)
        return {iri for classes in excluded for iri in classes if iri in self._places}

    def find_kinds(self, heads: Heads) -> Mapping[tuple[str, ...], float]:
        """Return the words of each kind that a name may mean → its weight, 0 to 1.

        Args:
            heads: as `PhraseMatcher.head_shares` returns them.
        """
        kinds: dict[tuple[str, ...], float] = {}
        for share, words in heads:
            if share < KIND_RANKING.min_head_share:
                continue
            for kind, weight in self._kinds_of(words).items():
                kinds[kind] = max(kinds.get(kind, 0.0), share * weight)
        return kinds

    def features(
        self,
        phrase: NamePhrase,
        parents: tuple[str, ...],
        heads: Heads,
        kinds: Mapping[tuple[str, ...], float],
        matches: Sequence[Match],
    ) -> KindFeatures:
        """Return the features of all classes for a name; see `rank` and `find_kinds`."""
        scores = np.zeros(len(self.classes))
        for match in reversed(matches):
            scores[self._places[match.class_iri]] = match.score
        weights: dict[str, float] = {}
        for kind, weight in kinds.items():
            for word in kind:
                weights[word] = max(weights.get(word, 0.0), weight)
        name_words = dict.fromkeys(map(self._taxonomy.singular, phrase.words), 1.0)
        place_words = dict.fromkeys((word for text in parents for word in self._name_words(text)), 1.0)
        bag, name, place = map(self._unit_vector, (weights, name_words, place_words))
        near_bag, near_name, near_place = map(self._vectors.embed, (weights, name_words, place_words))
        return KindFeatures(
            log_score=np.log(np.maximum(scores, KIND_RANKING.min_score)),
            score=scores,
            label_kinds=self._labels.cosines(bag),
            comment_kinds=self._comments.cosines(bag),
            above_kinds=self._above.cosines(bag),
            comment_name=self._comments.cosines(name),
            label_parents=self._labels.cosines(place),
            comment_parents=self._comments.cosines(place),
            similar_label_kinds=self._near_labels.cosines(near_bag),
            similar_comment_kinds=self._near_comments.cosines(near_bag),
            similar_above_kinds=self._near_above.cosines(near_bag),
            similar_label_name=self._near_labels.cosines(near_name),
            similar_label_head=self._similarity_of_heads(heads),
            similar_comment_name=self._near_comments.cosines(near_name),
            similar_above_name=self._near_above.cosines(near_name),
            similar_label_parents=self._near_labels.cosines(near_place),
            similar_comment_parents=self._near_comments.cosines(near_place),
            is_default=self._is_default,
        )

    def _find_kinds_of(self, words: tuple[str, ...]) -> Mapping[tuple[str, ...], float]:
        """Return the words of each kind that a compound, or a shorter one at its end, belongs to → its weight."""
        words = (*words[:-1], self._taxonomy.singular(words[-1]))
        kinds: dict[tuple[str, ...], float] = {}

        def add(kind: str, weight: float) -> None:
            key = self._kind_words(kind)
            kinds[key] = max(kinds.get(key, 0.0), weight)

        for start in range(len(words)):
            tail = KIND_RANKING.tail_factor**start
            add(" ".join(words[start:]), tail)
            senses = self._taxonomy.senses("".join(words[start:]))
            for sense, share in zip(senses, KIND_RANKING.sense_weights, strict=False):
                for up, steps in self._taxonomy.walk_up(sense.synset):
                    weight = tail * share * KIND_RANKING.step_factor**steps
                    for lemma in (self._taxonomy.name(up), self._taxonomy.label(up)):
                        add(lemma, weight)
                    for kind in self._kinds(up):
                        add(kind, weight * KIND_RANKING.category_factor)
        return kinds

    def _split_kind(self, kind: str) -> tuple[str, ...]:
        return tuple(map(self._taxonomy.singular, re.split(r"[\s-]+", kind)))

    def _similarity_of_heads(self, heads: Heads) -> Values:
        if not heads:
            return np.zeros(len(self.classes))
        return np.asarray(np.max([share * self._head_similarity(words) for share, words in heads], axis=0))

    def _compute_head_similarity(self, words: tuple[str, ...]) -> Values:
        """Return the cosine of each label and a compound, (classes,)."""
        return self._near_labels.cosines(self._embed((*words[:-1], self._taxonomy.singular(words[-1]))))

    def _embed(self, words: Iterable[str]) -> NDArray[np.float32]:
        return self._vectors.embed(dict.fromkeys(words, 1.0))

    def _read_name_words(self, name: str) -> tuple[str, ...]:
        return tuple(map(self._taxonomy.singular, self._reader.read(name, ()).words))

    def _label_words(self, cls: OntologyClass) -> list[list[str]]:
        """Return the words of each distinct name of a class, at least one."""
        names = dict.fromkeys([cls.readable_name, cls.label, *cls.alt_labels])
        return [list(words) for words in dict.fromkeys(tuple(self._words(name)) for name in names)]

    def _words(self, text: str) -> list[str]:
        return [self._taxonomy.singular(word) for word in words_of_label(text)]

    def _unit_vector(self, weights: Mapping[str, float]) -> dict[str, float]:
        weighted = {word: weight * self._idf.get(word, self._unseen) for word, weight in weights.items()}
        length = math.sqrt(sum([value * value for value in weighted.values()])) or 1.0
        return {word: value / length for word, value in weighted.items()}

    def _inverse_frequency(self, count: int) -> float:
        return math.log((len(self.classes) + 1) / (count + 0.5)) + KIND_RANKING.least_idf

    def _explain(self, phrase: NamePhrase, kinds: Mapping[tuple[str, ...], float], iri: ClassIRI) -> str:
        label, place = self._tbox.by_iri[iri].readable_name, self._places[iri]

        def similarity(kind: tuple[str, ...]) -> float:
            own = self._labels.cosines(self._unit_vector(dict.fromkeys(kind, 1.0)))
            return kinds[kind] * float(own[place] + self._near_labels.cosines(self._embed(kind))[place])

        kind = max(sorted(kinds), key=similarity)
        name = " ".join(phrase.words)
        if similarity(kind) < KIND_RANKING.min_explained:
            return f"the kinds of things that “{name}” may be fit the description of {label} best"
        return f"“{name}” may be a kind of “{' '.join(kind)}”, which is like {label}"


class _Index:
    """Vectors of the texts of each class, by word."""

    def __init__(self, vectors: Sequence[Sequence[Mapping[str, float]]]) -> None:
        columns: dict[str, list[tuple[int, float]]] = {}
        owners: list[int] = []
        for place, texts in enumerate(vectors):
            for vector in texts:
                for word, value in vector.items():
                    columns.setdefault(word, []).append((len(owners), value))
                owners.append(place)
        self._columns = {word: tuple(map(np.array, zip(*entries, strict=True))) for word, entries in columns.items()}
        self._owners = np.array(owners)
        self._size = len(vectors)

    def cosines(self, vector: Mapping[str, float]) -> Values:
        """Return the highest cosine of a vector and a text of each class, (classes,)."""
        best = np.zeros(self._size)
        found = [(self._columns[word], value) for word, value in vector.items() if word in self._columns]
        if found:
            rows = np.concatenate([column[0] for column, _ in found])
            values = np.concatenate([value * column[1] for column, value in found])
            np.maximum.at(best, self._owners, np.bincount(rows, values, minlength=len(self._owners)))
        return best


class _NearIndex:
    """Vectors of the texts of each class, at least one."""

    def __init__(self, vectors: Sequence[Sequence[NDArray[np.float32]]]) -> None:
        self._matrix = np.array([vector for texts in vectors for vector in texts])
        self._starts = np.cumsum([0, *map(len, vectors[:-1])])

    def cosines(self, vector: NDArray[np.float32]) -> Values:
        """Return the highest cosine of a vector and a text of each class, (classes,)."""
        return np.maximum.reduceat(self._matrix @ vector, self._starts).astype(np.float64)


@cache
def _weights() -> Values:
    weights: dict[str, float] = json.loads(read_text("kind_ranking.json"))["weights"]
    return np.array([weights[name] for name in KindFeatures._fields])
