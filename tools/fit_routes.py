"""Fit which class of an ontology a noun means, on the lists of `benchmarks/ontologies` that are no tests.

Usage: python tools/fit_routes.py

Writes `src/usd2kg/data/routes.json`: the weights of a conditional logit over the routes from a noun to a
class, and how often the likeliest class is right, with lists of ontologies that the weights were not fitted on.
"""

import json
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon, home_names
from usd2kg.grounding.lexical.alignment.matching import Matcher
from usd2kg.grounding.lexical.alignment.naming import RULED
from usd2kg.grounding.lexical.alignment.routes import Features, Routes
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.reading.head_noun import likelihood
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.ontology import ClassIRI, TBox

ROOT = Path(__file__).parents[1]
OUTPUT = ROOT / "src/usd2kg/data/routes.json"
sys.path.insert(0, str(ROOT))

from benchmarks.names.lists import (  # noqa: E402  (scripts are no packages of the product)
    SHARED_ONTOLOGIES,
    LabelledName,
    iter_ontology_lists,
    resolve_list,
)

RIDGE = 1.0
"""Strength of the pull of the weights, for features of spread 1, to zero."""
ROUNDS, STEP = 3000, 0.5
LARGEST, TINY = 500.0, 1e-9
SECOND = 0.5
"""What a thing counts for which only a class that a person would accept too can be reached."""

Array = NDArray[np.float64]


class Noun(NamedTuple):
    """The routes from the noun that a thing is called by."""

    features: Array
    """(routes, features)."""
    classes: list[ClassIRI]
    """The class that each route leads to."""
    right: frozenset[ClassIRI]
    """The target if there is a route to it, else the other classes that a person would accept."""
    ruled: ClassIRI | None
    """What the rules say by themselves."""
    target: ClassIRI


def main() -> None:
    """Fit, check, write."""
    if not SHARED_ONTOLOGIES.is_dir():
        raise SystemExit(f"{SHARED_ONTOLOGIES} is missing; with three ontologies less the weights would be others")
    nouns: dict[TBox, list[Noun]] = {}
    for names, tbox in iter_ontology_lists(("train",)):
        nouns.setdefault(tbox, []).extend(nouns_of(resolve_list(names, tbox), tbox))
    nouns = {tbox: found for tbox, found in nouns.items() if found}
    told = [count for tbox, own in nouns.items() for count in right_of(own, fit_others(nouns, tbox))]
    weights = fit([noun for found in nouns.values() for noun in found])
    report = {
        "weights": {name: round(float(weight), 3) for name, weight in zip(Features._fields, weights, strict=True)},
        "ontologies": len(nouns),
        "things": len(told),
        "right_when_left_out": round(float(np.mean([by_routes for _, by_routes, _ in told])), 4),
        "right_by_rules": round(float(np.mean([by_rules for by_rules, _, _ in told])), 4),
        "right_mixed_when_left_out": round(float(np.mean([mixed for _, _, mixed in told])), 4),
    }
    OUTPUT.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
    print(OUTPUT.read_text(encoding="utf-8"))


def nouns_of(things: Sequence[LabelledName], tbox: TBox) -> Iterator[Noun]:
    """Yield the routes for the likeliest end of each name that has any; none with classes of the home vocabulary."""
    taxonomy = load_taxonomy()
    lexicon = build_lexicon(tbox, taxonomy, home_names())
    if not lexicon.listed.isdisjoint(tbox.by_iri):
        return
    reader = NameReader(lexicon, taxonomy)
    matcher = Matcher(tbox, lexicon, taxonomy, reader, heeds_routes=False)
    paths = Routes(tbox, lexicon, taxonomy)
    for thing in things:
        assert thing.obj.box
        parents = tuple(thing.obj.prim_path.split("/")[1:-1])
        read = matcher.ends(reader.read(thing.obj.name, parents), parents, thing.obj.box.size)
        # A `plate_dinner` is looked up as a term.
        ends = [(features, named) for _, features, named in read if not features.turned]
        if not ends:
            continue
        _, named = max(ends, key=lambda end: likelihood(end[0]))
        routes = paths.find(named.run)
        classes = [route.class_iri for route in routes]
        if classes:
            right = frozenset([thing.target]) if thing.target in classes else thing.accepted
            yield Noun(np.array([route.features for route in routes]), classes, right, named.class_iri, thing.target)


def fit_others(nouns: Mapping[TBox, Sequence[Noun]], left_out: TBox) -> Array:
    """Return the weights by all ontologies but one."""
    return fit([noun for tbox, found in nouns.items() if tbox is not left_out for noun in found])


def fit(nouns: Sequence[Noun]) -> Array:
    """Return the weights that make the right classes most likely, by gradient ascent on features of equal spread."""
    told = [noun for noun in nouns if not noun.right.isdisjoint(noun.classes)]
    features = np.concatenate([noun.features for noun in told])
    spread = features.std(axis=0) + TINY
    scaled = features / spread
    of_noun = np.repeat(np.arange(len(told)), [len(noun.classes) for noun in told])
    is_right = np.array([iri in noun.right for noun in told for iri in noun.classes])
    weight = np.array([1.0 if noun.target in noun.classes else SECOND for noun in told])[of_noun]
    weights = np.zeros(len(Features._fields))
    for _ in range(ROUNDS):
        powers = np.exp(np.clip(scaled @ weights, -LARGEST, LARGEST))
        shares = powers / np.bincount(of_noun, powers)[of_noun]
        right = powers * is_right
        wanted = right / np.bincount(of_noun, right)[of_noun]
        weights += STEP * (((wanted - shares) * weight) @ scaled - RIDGE * weights) / len(told)
    found: Array = weights / spread
    return found


def right_of(nouns: Sequence[Noun], weights: Array) -> Iterator[tuple[bool, bool, bool]]:
    """Yield for each noun whether the rules, the routes, and both together give the target."""
    for noun in nouns:
        shares: dict[ClassIRI, float] = {}
        for iri, power in zip(noun.classes, np.exp(noun.features @ weights).tolist(), strict=True):
            shares[iri] = shares.get(iri, 0.0) + power
        by_routes = min(shares, key=lambda iri: (-shares[iri], iri))
        mixed = noun.ruled
        if noun.ruled in shares and shares[by_routes] > RULED * shares[noun.ruled]:
            mixed = by_routes
        yield noun.ruled == noun.target, by_routes == noun.target, mixed == noun.target


if __name__ == "__main__":
    main()
