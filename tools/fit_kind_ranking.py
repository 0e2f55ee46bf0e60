"""Fit the ranking of classes by the kinds of a noun, on the training and calibration lists of `benchmarks/ontologies`.

Usage: python -m tools.fit_kind_ranking

Writes `src/usd2kg/data/kind_ranking.json`: the weights of a conditional logit over the classes of an ontology, and the
share of right answers with each ontology when the weights are fitted on the others.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from benchmarks.names.lists import LabelledName, iter_ontology_lists, resolve_list
from tools.fitting import Array, fit_conditional_logit, write_weights
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.categories import invert_categories
from usd2kg.grounding.lexical.concepts.extent import extent_of
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.matching.kind_ranking import KindFeatures, KindRanker
from usd2kg.grounding.lexical.matching.phrase_matching import PhraseMatcher
from usd2kg.grounding.lexical.matching.term_matching import TermMatcher
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.ontology import ClassIRI, TBox

SPLITS = ("train", "calibration")
RIDGE = 2.0
"""Strength of the L2 penalty on the weights of features scaled to unit variance."""
TINY = 1e-9
"""Added to the spread of a feature, which may be constant."""


class Name(NamedTuple):
    """One labelled name."""

    features: Array
    """(classes, features)."""
    is_right: Array
    """(classes,): whether a class is the target."""
    was_right: bool
    """Whether the best match by the head noun is the target."""


def main() -> None:
    """Fit, cross-validate and write."""
    names: dict[ClassIRI, list[Name]] = {}
    for listed, tbox in iter_ontology_lists(SPLITS, public=False):
        names.setdefault(tbox.roots[0], []).extend(read_names(resolve_list(listed, tbox), tbox))
    hits, probabilities = [], []
    for ontology, own in names.items():
        weights = fit([name for other, found in names.items() if other != ontology for name in found])
        for name in own:
            utilities = name.features @ weights
            best = int(np.argmax(utilities))
            hits.append(bool(name.is_right[best]))
            probabilities.append(1.0 / float(np.exp(utilities - utilities[best]).sum()))
    everything = [name for found in names.values() for name in found]
    figures = {
        "ontologies": len(names),
        "names": len(everything),
        "right_when_left_out": round(float(np.mean(hits)), 4),
        "mean_probability_when_left_out": round(float(np.mean(probabilities)), 4),
        "right_by_head_noun": round(float(np.mean([name.was_right for name in everything])), 4),
    }
    write_weights("kind_ranking.json", KindFeatures._fields, fit(everything), figures, digits=3)


def read_names(labelled: Sequence[LabelledName], tbox: TBox) -> Iterator[Name]:
    """Yield the features of each name whose head noun has a class."""
    taxonomy = load_taxonomy()
    lexicon = build_lexicon(tbox, taxonomy, home_names())
    reader = NameReader(lexicon, taxonomy)
    matcher = PhraseMatcher(TermMatcher(tbox, lexicon, taxonomy, reader), taxonomy, reader)
    names = invert_categories(taxonomy)
    ranker = KindRanker(tbox, lexicon, taxonomy, reader, matcher, lambda synset: names.get(synset, ()))
    for one in labelled:
        assert one.obj.box
        parents = tuple(one.obj.prim_path.split("/")[1:-1])
        phrase = reader.read(one.obj.name, parents)
        extent = extent_of(one.obj.box.size)
        matches = matcher.match(phrase, parents, extent)
        if not matches:
            continue
        heads = matcher.head_shares(phrase, parents, extent)
        features = np.stack(ranker.features(phrase, parents, heads, ranker.find_kinds(heads), matches), axis=1)
        is_right = np.array([iri == one.target for iri in ranker.classes])
        if is_right.any():
            yield Name(features, is_right, matches[0].class_iri == one.target)


def fit(names: Sequence[Name]) -> Array:
    """Return the weights that make the targets most likely."""
    features = np.concatenate([name.features for name in names])
    spread = features.std(axis=0) + TINY
    weights = fit_conditional_logit(
        features / spread,
        [len(name.features) for name in names],
        np.concatenate([name.is_right for name in names]),
        np.ones(len(names)),
        ridge=RIDGE,
    )
    return np.asarray(weights / spread)


if __name__ == "__main__":
    main()
