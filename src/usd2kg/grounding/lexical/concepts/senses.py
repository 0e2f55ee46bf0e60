"""Prior of the senses of a noun in the name of an object in a scene."""

from usd2kg.grounding.lexical.concepts.taxonomy import Sense, Taxonomy
from usd2kg.grounding.lexical.settings import SENSE

__all__ = ["sense_weight", "usual_sense"]

_DOMAIN_WEIGHTS = {
    "artifact": SENSE.artifact,
    "food": SENSE.food,
    "person": SENSE.person,
    "substance": SENSE.substance,
    "communication": SENSE.communication,
    "group": SENSE.group,
    "top": SENSE.top,
}


def sense_weight(sense: Sense) -> float:
    """Return the weight of a sense, 0 to 1: artifacts and frequent senses first."""
    return _DOMAIN_WEIGHTS.get(sense.domain, SENSE.other_domain) * SENSE.rank_decay ** (sense.rank - 1)


def usual_sense(noun: str, taxonomy: Taxonomy) -> Sense | None:
    """Return the sense of a noun with the largest weight; None for an unknown noun."""
    return max(taxonomy.senses(noun), key=sense_weight, default=None)
