"""Abstaining upward: where the candidates are split, the class above them may be the better answer."""

from collections.abc import Mapping

from usd2kg.ontology import ClassIRI, TBox

__all__ = ["safest_class"]

_SHARPNESS = 2.0
"""Scores rank; squared and made to add up to 1 they are near the shares of right answers."""


def safest_class(scores: Mapping[ClassIRI, float], tbox: TBox) -> ClassIRI:
    """Return the class with the greatest expected hierarchical F1 (Silla and Freitas, 2011) over the candidates.

    With P(k) ∝ score(k)², the class c among the candidates and all classes above them for which
    Σ_k P(k) · F1(↑c, ↑k) is largest; of equal ones the more general.
    """
    total = sum(score**_SHARPNESS for score in scores.values())
    shares = {iri: score**_SHARPNESS / total for iri, score in scores.items()}
    choices = {above for iri in scores for above in tbox.closure(iri)}

    def expected(choice: ClassIRI) -> float:
        given = tbox.closure(choice)
        value: float = sum(
            share * 2 * len(given & tbox.closure(iri)) / (len(given) + len(tbox.closure(iri)))
            for iri, share in shares.items()
        )
        return value

    return min(choices, key=lambda iri: (-round(expected(iri), 9), tbox.depths[iri], iri))
