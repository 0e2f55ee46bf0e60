"""Fit the ranking of the classes that a noun may mean, on the training lists of `benchmarks/ontologies`.

Usage: python -m tools.fit_routes

Writes `src/usd2kg/data/routes.json`: the weights of a conditional logit over the routes from a noun to a class, and the
share of right answers with each ontology when the weights are fitted on the others.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from benchmarks.names.lists import SHARED_ONTOLOGIES, LabelledName, iter_ontology_lists, resolve_list
from tools.fitting import Array, fit_conditional_logit, write_weights
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.extent import extent_of
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.matching.phrase_matching import PhraseMatcher
from usd2kg.grounding.lexical.matching.routes import RouteFeatures, Routes
from usd2kg.grounding.lexical.matching.term_matching import TermMatcher
from usd2kg.grounding.lexical.reading.head_noun import head_likelihood
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.ontology import ClassIRI, TBox

RIDGE = 1.0
"""Strength of the L2 penalty on the weights of features scaled to unit variance."""
TINY = 1e-9
"""Added to the spread of a feature, which may be constant."""
ACCEPTED_WEIGHT = 0.5
"""Weight of a noun that has a route to an accepted class but none to the target."""


class Noun(NamedTuple):
    """The routes from the noun of a name."""

    features: Array
    """(routes, features)."""
    classes: list[ClassIRI]
    """The class at the end of each route."""
    right: frozenset[ClassIRI]
    """The target if a route leads to it, else the accepted classes."""
    matched: ClassIRI | None
    """The class of the best match without routes."""
    target: ClassIRI


class Hit(NamedTuple):
    """Whether each method gives the target of a noun."""

    by_match: bool
    """By terms and the nearest aligned hypernym."""
    by_routes: bool


def main() -> None:
    """Fit, cross-validate and write."""
    if not SHARED_ONTOLOGIES.is_dir():
        raise SystemExit(f"{SHARED_ONTOLOGIES} is missing; without its ontologies the weights would differ")
    nouns: dict[TBox, list[Noun]] = {}
    for names, tbox in iter_ontology_lists(("train",)):
        nouns.setdefault(tbox, []).extend(read_nouns(resolve_list(names, tbox), tbox))
    nouns = {tbox: found for tbox, found in nouns.items() if found}
    hits = []
    for tbox, own in nouns.items():
        weights = fit([noun for other, found in nouns.items() if other is not tbox for noun in found])
        hits += [score(noun, weights) for noun in own]
    figures = {
        "ontologies": len(nouns),
        "nouns": len(hits),
        "right_when_left_out": round(float(np.mean([hit.by_routes for hit in hits])), 4),
        "right_without_routes": round(float(np.mean([hit.by_match for hit in hits])), 4),
    }
    weights = fit([noun for found in nouns.values() for noun in found])
    write_weights("routes.json", RouteFeatures._fields, weights, figures, digits=3)


def read_nouns(names: Sequence[LabelledName], tbox: TBox) -> Iterator[Noun]:
    """Yield the routes of the most probable head noun of each name; none if the TBox has home classes."""
    taxonomy = load_taxonomy()
    lexicon = build_lexicon(tbox, taxonomy, home_names())
    if not lexicon.home_classes.isdisjoint(tbox.by_iri):
        return
    reader = NameReader(lexicon, taxonomy)
    matcher = PhraseMatcher(TermMatcher(tbox, lexicon, taxonomy, reader, use_routes=False), taxonomy, reader)
    paths = Routes(tbox, lexicon, taxonomy)
    for labelled in names:
        assert labelled.obj.box
        parents = tuple(labelled.obj.prim_path.split("/")[1:-1])
        read = matcher.head_candidates(
            reader.read(labelled.obj.name, parents), parents, extent_of(labelled.obj.box.size)
        )
        # Inverted names such as `plate_dinner` are looked up as a term.
        ends = [(features, named) for _, features, named in read if not features.inverted]
        if not ends:
            continue
        _, named = max(ends, key=lambda end: head_likelihood(end[0]))
        routes = paths.find(named.words)
        classes = [route.class_iri for route in routes]
        if classes:
            target = labelled.target
            right = frozenset([target]) if target in classes else labelled.accepted
            yield Noun(np.array([route.features for route in routes]), classes, right, named.class_iri, target)


def fit(nouns: Sequence[Noun]) -> Array:
    """Return the weights that make the right classes most likely."""
    solvable = [noun for noun in nouns if not noun.right.isdisjoint(noun.classes)]
    features = np.concatenate([noun.features for noun in solvable])
    spread = features.std(axis=0) + TINY
    weights = fit_conditional_logit(
        features / spread,
        [len(noun.classes) for noun in solvable],
        np.array([iri in noun.right for noun in solvable for iri in noun.classes]),
        np.array([1.0 if noun.target in noun.classes else ACCEPTED_WEIGHT for noun in solvable]),
        ridge=RIDGE,
    )
    return np.asarray(weights / spread)


def score(noun: Noun, weights: Array) -> Hit:
    """Return which methods give the target."""
    shares: dict[ClassIRI, float] = {}
    for iri, power in zip(noun.classes, np.exp(noun.features @ weights).tolist(), strict=True):
        shares[iri] = shares.get(iri, 0.0) + power
    by_routes = min(shares, key=lambda iri: (-shares[iri], iri))
    return Hit(noun.matched == noun.target, by_routes == noun.target)


if __name__ == "__main__":
    main()
