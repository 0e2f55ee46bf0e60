"""How likely a meaning of a noun is meant by the name of an object on a stage."""

from usd2kg.grounding.lexical.concepts.taxonomy import Sense

__all__ = ["sense_weight", "unmade_weight"]

_DOMAIN_WEIGHTS = {
    "artifact": 1.0,
    "food": 0.9,
    "person": 0.8,
    "substance": 0.6,
    "communication": 0.4,
    "group": 0.4,
    "top": 0.3,
}
_OTHER_DOMAIN = 0.45
_RANK_DECAY = 0.93


def sense_weight(sense: Sense) -> float:
    """Return how likely a sense is meant by the name of an object on a stage: artifacts first."""
    return _DOMAIN_WEIGHTS.get(sense.domain, _OTHER_DOMAIN) * _RANK_DECAY ** (sense.rank - 1)


def unmade_weight(sense: Sense) -> float:
    """Return the same for a thing that nobody made, where no made thing is meant."""
    return _RANK_DECAY ** (sense.rank - 1)
