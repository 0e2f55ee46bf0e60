"""weigh_candidates: what speaks for each candidate of one object, and against it, source by source."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import NamedTuple

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.concepts.sizes import typical_extents
from usd2kg.grounding.lexical.context_evidence import ContextEvidence
from usd2kg.grounding.lexical.evidence_combination import ScoredClass
from usd2kg.grounding.lexical.name_evidence import NameEvidence
from usd2kg.grounding.lexical.reading.shared_prefix import view_without_prefix
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["CandidateEvidence", "weigh_candidates"]


class CandidateEvidence(NamedTuple):
    """What one source says about one class."""

    group: str
    """name, asset, labels, documentation, hierarchy, parts, neighbours, size, stance or place."""
    explanation: str
    """One sentence or phrase for a person."""
    score: float | None = None
    """How well words match, or the share of the neighbours' votes, from 0 to 1; None for the other groups."""
    likelihood_ratio: float | None = None
    """How much more probable the class is by the size, stance or place alone: P(class | seen) / P(class); else None."""


def weigh_candidates(
    words: NameEvidence, context: ContextEvidence, view: ObjectView, candidates: Iterable[ClassIRI], tbox: TBox
) -> Mapping[ClassIRI, tuple[CandidateEvidence, ...]]:
    """Return the evidence about each candidate, also from the sources that did not decide.

    Args:
        words: the evidence of the words.
        context: the evidence of other objects, size and place.
        view: the object.
        candidates: the classes.
        tbox: their ontology.
    """
    shown = view_without_prefix(view, context.shared_prefix(view))
    by_words = words.score_sources(words.words_of(shown), is_made_for_it=words.is_made_for_stage(shown))
    sources = chain(chain.from_iterable(by_words), words.score_abbreviation(shown))
    scored = _best_by_group([*sources, *context.score_neighbours(view)])
    appearance = context.score_appearance(view)

    def by_appearance(iri: ClassIRI) -> Iterator[CandidateEvidence]:
        prior = context.prior.probability(iri)
        for group, seen, posterior in appearance if prior > 0 else ():
            usual = _usual_size(iri, tbox) if group == "size" else ""
            yield CandidateEvidence(group, seen + usual, likelihood_ratio=posterior.probability(iri) / prior)

    return {
        iri: (
            *(CandidateEvidence(each.group, each.explain(), score=each.score) for each in scored.get(iri, ())),
            *by_appearance(iri),
        )
        for iri in candidates
    }


def _best_by_group(scored: Iterable[ScoredClass]) -> dict[ClassIRI, list[ScoredClass]]:
    """Return class → the best of each evidence group, in the order of the groups."""
    best: dict[tuple[ClassIRI, str], ScoredClass] = {}
    for each in scored:
        known = best.get((each.class_iri, each.group))
        if known is None or known.score < each.score:
            best[each.class_iri, each.group] = each
    found: dict[ClassIRI, list[ScoredClass]] = {}
    for (iri, _), each in best.items():
        found.setdefault(iri, []).append(each)
    return found


def _usual_size(iri: ClassIRI, tbox: TBox) -> str:
    """Return the typical extents of a class, longest first; empty if its label is no everyday object."""
    extents = typical_extents(tbox.by_iri[iri].label.lower().replace(" ", ""))
    return "" if extents is None else f", usually {' × '.join(f'{extent:.2f}' for extent in extents)} m"
