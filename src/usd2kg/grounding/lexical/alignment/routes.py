"""Which class of an ontology a noun means, where usd2kg knows nothing but its terms: all routes from one to the other.

A noun leads to a class by its label or another of its terms, by what it is a kind of in the taxonomy, and by what
people count it among; by each of its meanings, and by the nouns at its end. A conditional logit (McFadden, 1974) tells
how likely a class is meant: its share is Σ exp(Σ weight · feature) over the routes to it. The weights are in
`data/routes.json`, written by `tools/fit_routes.py`.
"""

import json
import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import cache, lru_cache
from operator import mul
from typing import NamedTuple

from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.alignment.terms import LABEL, Anchor, Term
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.knowledge import read_text
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["Features", "Route", "Routes", "shares_of", "strength"]

_MOST_STEPS = 8
"""So many steps up in the taxonomy, or more, are all the same."""


class Features(NamedTuple):
    """What is known of one route."""

    term: float = 0.0
    """Whether the noun is a label of the class."""
    label: float = 0.0
    """Whether what leads to the class means it for sure: its label, in the meaning that fits best; 0 where counted."""
    partial: float = 0.0
    """Whether only the end of the noun is meant: that a side plate is a plate."""
    usual: float = 0.0
    """Whether it is the noun's first meaning, or the noun is a term of the class whatever else it means."""
    steps: float = 0.0
    """Steps up in the taxonomy to a class that is no root; 0 where counted."""
    steps_to_root: float = 0.0
    """The same to a root."""
    counted: float = 0.0
    """Whether people count the thing among the class, and the taxonomy does not."""
    log_counted: float = 0.0
    """Logarithm of the number of things that they count so."""
    passed: float = 0.0
    """Whether the same meaning leads to a class below this one too."""
    log_below: float = 0.0
    """Logarithm of the number of classes below, the class included."""
    default: float = 0.0
    """Whether the class is the one that is true of most things."""


class Route(NamedTuple):
    """A route from a noun to a class."""

    class_iri: ClassIRI
    features: Features
    origin: Term | tuple[int, int, Anchor]
    """The term that the noun is; or its meaning, the synset above that leads to the class, and how."""


class Routes:
    """The routes to the classes of one TBox."""

    def __init__(self, tbox: TBox, lexicon: Lexicon, taxonomy: Taxonomy) -> None:
        self._tbox = tbox
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._below = Counter(above for cls in tbox.classes for above in tbox.closure(cls.iri))
        if lexicon.default is not None and not tbox.children[lexicon.default]:
            # What is called after the rest is as general as a root.
            self._below[lexicon.default] = len(tbox.classes)
        # What a noun means depends on nothing else, and names say the same nouns over and over.
        self.weigh = lru_cache(maxsize=4096)(self._weighing)

    def _weighing(self, run: tuple[str, ...]) -> Mapping[ClassIRI, tuple[float, Route]]:
        """Return how likely each class is meant by the words of a noun, and the route that tells it best."""
        routes = self.find(run)
        clearest = {route.class_iri: route for route in sorted(routes, key=lambda route: strength(route.features))}
        return {iri: (share, clearest[iri]) for iri, share in shares_of(routes).items()}

    def find(self, run: Sequence[str]) -> list[Route]:
        """Return all routes from the words of a noun, the last one its head, to classes."""
        found: list[Route] = []
        for start in range(len(run)):
            key = "".join((*run[start:-1], self._taxonomy.singular(run[-1])))
            found.extend(self._by_term(key, is_partial=start > 0))
            for rank, sense in enumerate(self._taxonomy.senses(key)):
                found.extend(self._from_meaning(sense.synset, is_partial=start > 0, is_usual=rank == 0))
        return found

    def _by_term(self, key: str, *, is_partial: bool) -> Iterator[Route]:
        term = self._lexicon.terms.get(key)
        if term is not None:
            is_label = float(term.weight == LABEL)
            features = self._features(
                term.class_iri, term=is_label, label=is_label, partial=float(is_partial), usual=1.0
            )
            yield Route(term.class_iri, features, term)

    def _from_meaning(self, synset: int, *, is_partial: bool, is_usual: bool) -> Iterator[Route]:
        links: list[tuple[int, int, Anchor, int | None]] = []
        for up, hops in self._taxonomy.walk_up(synset):
            if up in self._lexicon.anchors:
                links.append((up, hops, self._lexicon.anchors[up], None))
            links.extend((up, hops, counted.anchor, counted.things) for counted in self._lexicon.counted.get(up, ()))
        classes = {anchor.class_iri for _, _, anchor, _ in links}
        passed = {iri for iri in classes if any(one != iri and self._tbox.is_subclass(one, iri) for one in classes)}
        for up, hops, anchor, things in links:
            iri = anchor.class_iri
            is_counted, is_root = things is not None, iri in self._lexicon.general
            steps = 0.0 if is_counted else float(min(hops, _MOST_STEPS))
            features = self._features(
                iri,
                label=float(anchor.weight == LABEL and not is_counted),
                partial=float(is_partial),
                usual=float(is_usual),
                steps=0.0 if is_root else steps,
                steps_to_root=steps if is_root else 0.0,
                counted=float(is_counted),
                log_counted=math.log(things) if things is not None else 0.0,
                passed=float(iri in passed),
            )
            yield Route(iri, features, (synset, up, anchor))

    def _features(self, iri: ClassIRI, **known: float) -> Features:
        is_default = float(iri == self._lexicon.default)
        return Features(log_below=math.log(self._below[iri]), default=is_default, **known)


def shares_of(routes: Sequence[Route]) -> dict[ClassIRI, float]:
    """Return how likely each class is meant, of those that the routes lead to."""
    powers: dict[ClassIRI, float] = {}
    for route in routes:
        powers[route.class_iri] = powers.get(route.class_iri, 0.0) + strength(route.features)
    total = sum(powers.values())
    return {iri: power / total for iri, power in powers.items()}


def strength(features: Features) -> float:
    """Return how much a route speaks for its class, up to a factor that all routes of a noun share."""
    return math.exp(sum(map(mul, _weights(), features)))


@cache
def _weights() -> Features:
    text = read_text("routes.json")
    return Features(**json.loads(text)["weights"])
