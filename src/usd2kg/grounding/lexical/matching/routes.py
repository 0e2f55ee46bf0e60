"""Rank the classes that a noun may mean in an ontology that shares no class with the home vocabulary.

A route leads from a noun to a class: by a term of the class, by a hypernym of a sense of the noun, or by a category
of common usage. Nouns at the end of a compound contribute routes too. A conditional logit (McFadden, 1974) ranks
the classes: the share of a class is Σ exp(Σ weight · feature) over its routes, normalised over all routes of the noun.
`tools/fit_routes.py` fits the weights and writes them to `data/routes.json`.
"""

import json
import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import cache, lru_cache
from operator import mul
from typing import NamedTuple

from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.alignment.terms import AlignedClass, Term, TermKind
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.settings import ROUTES
from usd2kg.knowledge import read_text
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["Route", "RouteFeatures", "Routes", "class_shares", "route_strength"]


class RouteFeatures(NamedTuple):
    """Features of one route; truth values are 0 or 1."""

    term: float = 0.0
    """Whether the noun is a label of the class."""
    label: float = 0.0
    """Whether the route ends at the label of the class, in its best sense; 0 for categories."""
    partial: float = 0.0
    """Whether the route begins at the end of the noun: a side plate is a plate."""
    usual: float = 0.0
    """Whether the sense is the noun's first; 1 for terms."""
    steps: float = 0.0
    """Hypernym steps to a class that is not general; 0 for categories."""
    steps_to_general: float = 0.0
    """Hypernym steps to a general class; 0 for categories."""
    by_category: float = 0.0
    """Whether the route is by a category."""
    log_category_size: float = 0.0
    """Logarithm of the number of synsets in the category."""
    has_more_specific: float = 0.0
    """Whether the same sense also leads to a subclass."""
    log_below: float = 0.0
    """Logarithm of the number of subclasses, the class included."""
    default: float = 0.0
    """Whether the class is the default class."""
    general: float = 0.0
    """Whether the class is a root or the default class."""


class Route(NamedTuple):
    """A route from a noun to a class."""

    class_iri: ClassIRI
    features: RouteFeatures
    origin: Term | tuple[int, int, AlignedClass]
    """The term; or the synset of the sense, the hypernym that leads to the class, and the class there."""


class Routes:
    """The routes to the classes of one TBox."""

    def __init__(self, tbox: TBox, lexicon: Lexicon, taxonomy: Taxonomy) -> None:
        self._tbox = tbox
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._subclass_counts = Counter(above for cls in tbox.classes for above in tbox.closure(cls.iri))
        if lexicon.default_class is not None and not tbox.children[lexicon.default_class]:
            # A residual class is as general as a root.
            self._subclass_counts[lexicon.default_class] = len(tbox.classes)
        self.rank = lru_cache(maxsize=4096)(self._rank)
        """Words of a noun → class → (share, its strongest route)."""

    def _rank(self, words: tuple[str, ...]) -> Mapping[ClassIRI, tuple[float, Route]]:
        routes = self.find(words)
        strongest = {
            route.class_iri: route for route in sorted(routes, key=lambda route: route_strength(route.features))
        }
        return {iri: (share, strongest[iri]) for iri, share in class_shares(routes).items()}

    def find(self, words: Sequence[str]) -> list[Route]:
        """Return all routes from a noun, its head last."""
        routes: list[Route] = []
        for start in range(len(words)):
            key = "".join((*words[start:-1], self._taxonomy.singular(words[-1])))
            routes.extend(self._by_term(key, is_partial=start > 0))
            for rank, sense in enumerate(self._taxonomy.senses(key)):
                routes.extend(self._by_sense(sense.synset, is_partial=start > 0, is_usual=rank == 0))
        return routes

    def _by_term(self, key: str, *, is_partial: bool) -> Iterator[Route]:
        term = self._lexicon.terms.get(key)
        if term is not None:
            is_label = float(term.kind is TermKind.LABEL)
            features = self._features(
                term.class_iri, term=is_label, label=is_label, partial=float(is_partial), usual=1.0
            )
            yield Route(term.class_iri, features, term)

    def _by_sense(self, synset: int, *, is_partial: bool, is_usual: bool) -> Iterator[Route]:
        links: list[tuple[int, int, AlignedClass, int | None]] = []
        excluded: frozenset[ClassIRI] = frozenset()
        for up, steps in self._taxonomy.walk_up(synset):
            excluded |= self._lexicon.excluded_classes.get(up, frozenset())
            found: list[tuple[int, int, AlignedClass, int | None]] = []
            if up in self._lexicon.sense_classes:
                found.append((up, steps, self._lexicon.sense_classes[up], None))
            members = self._lexicon.category_members.get(up, ())
            found.extend((up, steps, member.aligned, member.synset_count) for member in members)
            links.extend(link for link in found if link[2].class_iri not in excluded)
        classes = {aligned.class_iri for _, _, aligned, _ in links}
        passed = {iri for iri in classes if any(one != iri and self._tbox.is_subclass(one, iri) for one in classes)}
        for up, steps, aligned, synset_count in links:
            iri = aligned.class_iri
            is_category, is_general = synset_count is not None, iri in self._lexicon.general_classes
            counted_steps = 0.0 if is_category else float(min(steps, ROUTES.max_steps))
            features = self._features(
                iri,
                label=float(aligned.weight == 1.0 and not is_category),
                partial=float(is_partial),
                usual=float(is_usual),
                steps=0.0 if is_general else counted_steps,
                steps_to_general=counted_steps if is_general else 0.0,
                by_category=float(is_category),
                log_category_size=math.log(synset_count) if synset_count is not None else 0.0,
                has_more_specific=float(iri in passed),
            )
            yield Route(iri, features, (synset, up, aligned))

    def _features(self, iri: ClassIRI, **known: float) -> RouteFeatures:
        return RouteFeatures(
            log_below=math.log(self._subclass_counts[iri]),
            default=float(iri == self._lexicon.default_class),
            general=float(iri in self._lexicon.general_classes),
            **known,
        )


def class_shares(routes: Sequence[Route]) -> dict[ClassIRI, float]:
    """Return class → its share of the strength of all routes; the shares add up to 1."""
    strengths: dict[ClassIRI, float] = {}
    for route in routes:
        strengths[route.class_iri] = strengths.get(route.class_iri, 0.0) + route_strength(route.features)
    total = sum(strengths.values())
    return {iri: strength / total for iri, strength in strengths.items()}


def route_strength(features: RouteFeatures) -> float:
    """Return exp(Σ weight · feature)."""
    return math.exp(sum(map(mul, _weights(), features)))


@cache
def _weights() -> RouteFeatures:
    return RouteFeatures(**json.loads(read_text("routes.json"))["weights"])
