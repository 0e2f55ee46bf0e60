"""Score classes by the context of an object: its neighbours, its size and stance, and the kind of place it is in."""

from functools import cached_property, lru_cache, partial
from typing import NamedTuple

import numpy as np

from usd2kg.grounding.context.neighbours import SAME_SIZE, AskVote, Nearness, Neighbour, Neighbourhood
from usd2kg.grounding.context.placement import Appearance, PlacedObject, ScoreObject
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.class_posterior import (
    NO_POSTERIOR,
    ClassPosterior,
    PosteriorModel,
    log_likelihoods_of_appearance,
    match_everyday_nouns,
    neighbour_weights,
)
from usd2kg.grounding.lexical.concepts.extent import extent_of
from usd2kg.grounding.lexical.concepts.places import (
    PLACE_TEXTS,
    PLACES,
    Floats,
    Stance,
    log_place_likelihoods_of_appearance,
    log_place_likelihoods_of_noun,
    log_stance_likelihoods,
    place_probabilities,
    places_named,
    stance_of,
)
from usd2kg.grounding.lexical.concepts.sizes import Size, everyday_nouns, round_size, size_log_likelihoods
from usd2kg.grounding.lexical.evidence_combination import ScoredClass
from usd2kg.grounding.lexical.matching.phrase_matching import PhraseMatcher
from usd2kg.grounding.lexical.name_evidence import NameEvidence
from usd2kg.grounding.lexical.neighbour_vote import Vote, count_votes, siblings_as_neighbours, vote_of
from usd2kg.grounding.lexical.reading.evidence_texts import is_generated_name
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.grounding.lexical.reading.shared_prefix import shared_prefix, without_prefix
from usd2kg.grounding.lexical.settings import VOTE
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.table_cache import TableCache

__all__ = ["AppearanceKey", "ContextEvidence", "Surroundings"]

_PLACE_DIGITS = 6
"""Decimals of the probabilities of places: two more than those of a confidence."""

_NEARNESS_TEXTS = {
    Nearness.NEXT: "right beside it",
    Nearness.SIBLING: "in the same group",
    Nearness.SAME_SIZE: "of the same size",
    Nearness.SIMILAR_SIZE: "of about the same size",
}


class AppearanceKey(NamedTuple):
    """What an object looks like and where, equal for copies that stand alike in places of one kind."""

    size: Size
    """Rounded extents in metres."""
    stance: Stance
    places: tuple[str, ...]
    """The kinds of place that names above mention."""


class Surroundings(NamedTuple):
    """What an object looks like and where it is, equal for copies in the same surroundings."""

    appearance: Appearance
    places: tuple[float, ...]
    """Probability of each kind of place, rounded."""


class ContextEvidence:
    """Scores classes by context, for one TBox."""

    def __init__(
        self, tbox: TBox, words: NameEvidence, reader: NameReader, matcher: PhraseMatcher, tables: TableCache
    ) -> None:
        self._tables = tables
        self._tbox = tbox
        self._words = words
        self._reader = reader
        self._matcher = matcher
        # Copies of one model have the same size and stance.
        self._posterior_by_appearance = lru_cache(maxsize=8192)(self._compute_posterior_by_appearance)
        self._posterior = lru_cache(maxsize=1024)(self._compute_posterior)
        self._log_places_of_appearance = lru_cache(maxsize=1024)(_log_places_of_appearance)
        # Scenes cache results by the identity of the function, and each access to a method creates a new object.
        self._find_prefix = partial(shared_prefix, names_object=reader.names_known_noun)
        self._vote = lru_cache(maxsize=64)(self._make_vote)
        self._place = lru_cache(maxsize=64)(self._make_place)

    @cached_property
    def _model(self) -> PosteriorModel:
        return PosteriorModel(
            self._tables.get("nouns", list, partial(match_everyday_nouns, self._words.match), encode=list)
        )

    def shared_prefix(self, view: ObjectView) -> tuple[str, ...]:
        """Return the parts that nearly all names of the stage begin with; empty in masked regimes."""
        if view.is_masked or view.neighbourhood is None:
            return ()
        return view.neighbourhood.of_stage(self._find_prefix)

    def appearance_key(self, view: ObjectView) -> AppearanceKey | None:
        """Return what `posterior_by_appearance` depends on; None if the size is unknown."""
        seen = view.appearance
        if seen is None:
            return None
        return AppearanceKey(round_size(seen.size), stance_of(seen), places_named(view.parents))

    def posterior_by_appearance(self, key: AppearanceKey | None) -> ClassPosterior:
        """Return class probabilities given size, stance and the places that names above mention; ignores the name."""
        return NO_POSTERIOR if key is None else self._posterior_by_appearance(key)

    def _compute_posterior_by_appearance(self, key: AppearanceKey) -> ClassPosterior:
        log_likelihoods = size_log_likelihoods(key.size) + log_stance_likelihoods(key.stance)
        return self._model.posterior(log_likelihoods, place_probabilities(np.zeros(len(PLACES)), key.places))

    def surroundings(self, view: ObjectView) -> Surroundings | None:
        """Return what `posterior` depends on; None if the size is unknown."""
        if view.appearance is None:
            return None
        places = place_probabilities(self._log_places_around(view), places_named(view.parents))
        return Surroundings(view.appearance, tuple(places.round(_PLACE_DIGITS).tolist()))

    def posterior(self, seen: Surroundings | None) -> ClassPosterior:
        """Return class probabilities given size, stance, surrounding objects and places that names above mention."""
        return NO_POSTERIOR if seen is None else self._posterior(seen)

    def _compute_posterior(self, seen: Surroundings) -> ClassPosterior:
        return self._model.posterior(log_likelihoods_of_appearance(seen.appearance), np.array(seen.places))

    def score_appearance(self, view: ObjectView) -> list[tuple[str, str, ClassPosterior]]:
        """Return (evidence group, what is seen, class probabilities given that alone): size, stance, and place."""
        seen = view.appearance
        if seen is None:
            return []
        anywhere = np.full(len(PLACES), 1 / len(PLACES))
        around = place_probabilities(self._log_places_around(view), places_named(view.parents))
        nothing = np.zeros(len(everyday_nouns()))
        by_place = self._model.posterior(nothing, around)
        size = " × ".join(f"{extent:.2f}" for extent in sorted(seen.size, reverse=True))
        elevation = "" if seen.elevation is None else f", {seen.elevation:.1f} m above the ground"
        place = "by the objects around" if by_place.place is None else f"in what seems {PLACE_TEXTS[by_place.place]}"
        return [
            ("size", f"{size} m", self._model.posterior(size_log_likelihoods(seen.size), anywhere)),
            (
                "stance",
                f"as it stands{elevation}",
                self._model.posterior(log_stance_likelihoods(stance_of(seen)), anywhere),
            ),
            ("place", place, by_place),
        ]

    @cached_property
    def prior(self) -> ClassPosterior:
        """Class probabilities of an object of which nothing is known."""
        return self._model.posterior(np.zeros(len(everyday_nouns())), np.full(len(PLACES), 1 / len(PLACES)))

    def explain_posterior(self, seen: Surroundings | None, place: str | None, iri: ClassIRI) -> str:
        """Return one sentence for a class that size and place support."""
        elevation = None if seen is None else seen.appearance.elevation
        where = "" if elevation is None else f", {elevation:.1f} m above the ground"
        among = f", in what seems {PLACE_TEXTS[place]}" if place else ""
        label = self._tbox.by_iri[iri].readable_name
        return f"its name does not identify it; by its size{where}{among}, it is most probably {label}"

    def score_neighbours(self, view: ObjectView) -> list[ScoredClass]:
        """Return the classes of neighbours with their share of the votes."""
        if view.neighbourhood is not None:
            return self._score_neighbourhood(view.neighbourhood, self.shared_prefix(view))
        siblings = siblings_as_neighbours(view.siblings, view.parents)
        vote_of_sibling = self._vote(())
        voted = ((vote_of_sibling(found.name, found.parents, found.size), found) for found in siblings)
        votes = count_votes((vote, found.nearness, found.distance, found) for vote, found in voted if vote is not None)
        return [
            ScoredClass("hierarchy", iri, share, partial(self._explain_neighbour, iri, votes.heaviest[iri][-1]))
            for iri, share in votes.shares.items()
        ]

    def _score_neighbourhood(self, neighbourhood: Neighbourhood, prefix: tuple[str, ...]) -> list[ScoredClass]:
        votes = count_votes(neighbourhood.votes(self._vote(prefix)))

        def explain(iri: ClassIRI) -> str:
            _, nearness, distance, other = votes.heaviest[iri]
            return self._explain_neighbour(iri, neighbourhood.neighbour(other, nearness, distance))

        return [ScoredClass("neighbours", iri, share, partial(explain, iri)) for iri, share in votes.shares.items()]

    def _explain_neighbour(self, iri: ClassIRI, neighbour: Neighbour) -> str:
        where = _NEARNESS_TEXTS[neighbour.nearness]
        is_same_size = neighbour.distance is not None and neighbour.distance < SAME_SIZE
        is_stated = neighbour.nearness in {Nearness.SAME_SIZE, Nearness.SIMILAR_SIZE}
        size = ", of the same size," if is_same_size and not is_stated else ""
        return f"“{neighbour.name}” {where}{size} is {self._tbox.by_iri[iri].readable_name}"

    def _make_vote(self, prefix: tuple[str, ...]) -> AskVote[Vote]:
        """Return the function that returns the vote of an object of a stage whose names share a prefix."""

        def vote(name: str, parents: tuple[str, ...], size: Size | None) -> Vote | None:
            return self._vote_of_neighbour(without_prefix(name, prefix), parents, size)

        return vote

    def _make_place(self, prefix: tuple[str, ...]) -> ScoreObject:
        """Return a function from an object to its evidence for each kind of place, see `_log_places_of_neighbour`."""

        def place(other: PlacedObject) -> Floats:
            return self._log_places_of_neighbour(other._replace(name=without_prefix(other.name, prefix)))

        return place

    def _vote_of_neighbour(self, name: str, parents: tuple[str, ...], size: Size | None) -> Vote | None:
        return None if is_generated_name(name) else vote_of(self._words.match(name, parents, extent_of(size)))

    def _log_places_around(self, view: ObjectView) -> Floats:
        """Return the log likelihood of each kind of place given the surrounding objects, (places,)."""
        if view.placement is not None:
            logs, metres = view.placement.around(self._place(self.shared_prefix(view)), VOTE.max_placed)
            return neighbour_weights(metres) @ logs if len(logs) else np.zeros(len(PLACES))
        siblings = [self._log_places_of_name(name, view.parents) for name in view.siblings[: VOTE.max_placed]]
        return sum(siblings, start=np.zeros(len(PLACES))) * neighbour_weights(VOTE.sibling_distance)

    def _log_places_of_neighbour(self, other: PlacedObject) -> Floats:
        """Return the log likelihood of each kind of place by an object's name or, without one, its size, (places,)."""
        by_name = self._log_places_of_name(other.name, other.parents)
        if by_name.any():
            return by_name
        return self._log_places_of_appearance(other.appearance)

    def _log_places_of_name(self, name: str, parents: tuple[str, ...]) -> Floats:
        row = None if is_generated_name(name) else self._matcher.find_object_row(self._reader.read(name, parents))
        return np.zeros(len(PLACES)) if row is None else log_place_likelihoods_of_noun(row)


def _log_places_of_appearance(seen: Appearance) -> Floats:
    return log_place_likelihoods_of_appearance(log_likelihoods_of_appearance(seen))
