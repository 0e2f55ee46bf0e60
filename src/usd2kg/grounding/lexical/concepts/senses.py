"""Prior of the senses of a noun in the name of an object in a scene."""

from functools import cache

from usd2kg.grounding.lexical.concepts.taxonomy import Sense, Taxonomy
from usd2kg.grounding.lexical.settings import DOMAIN_FREQUENCY, SENSE

__all__ = ["sense_weight", "usual_sense"]


def sense_weight(sense: Sense) -> float:
    """Return the weight of a sense, 0 to 1: artifacts and frequent senses first."""
    return _domain_weight(sense.domain) * SENSE.rank_decay ** (sense.rank - 1)


def usual_sense(noun: str, taxonomy: Taxonomy) -> Sense | None:
    """Return the sense of a noun with the largest weight; None for an unknown noun."""
    return max(taxonomy.senses(noun), key=sense_weight, default=None)


@cache
def _domain_weight(domain: str) -> float:
    weight: float = DOMAIN_FREQUENCY.of(domain) ** SENSE.domain_power
    return weight
