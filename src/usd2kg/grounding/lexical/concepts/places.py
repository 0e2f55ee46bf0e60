"""Likelihood of an object's place and stance for everyday objects: evidence where the name is uninformative.

The columns `places`, `stands` and `up` of `data/everyday_objects.csv` are common sense, written by hand.
"""

import math
from bisect import bisect_right
from collections.abc import Iterable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.context.placement import Appearance
from usd2kg.grounding.lexical.concepts.sizes import everyday_object_rows
from usd2kg.grounding.lexical.settings import PLACE, SIZE, STANCE
from usd2kg.knowledge import word_map
from usd2kg.words import split_identifier

__all__ = [
    "PLACES",
    "PLACE_TEXTS",
    "Floats",
    "Stance",
    "log_place_likelihoods_of_appearance",
    "log_place_likelihoods_of_noun",
    "log_stance_likelihoods",
    "noun_priors",
    "place_probabilities",
    "places_named",
    "stance_of",
]

PLACE_TEXTS = {
    "kitchen": "a kitchen",
    "dining": "a dining area",
    "living": "a living room",
    "bedroom": "a bedroom",
    "bathroom": "a bathroom",
    "hall": "a hall",
    "utility": "a utility room",
    "child": "a children's room",
    "office": "an office",
    "workshop": "a workshop",
    "warehouse": "a warehouse",
    "laboratory": "a laboratory",
    "shop": "a shop",
    "gym": "a gym",
    "outdoors": "a place outdoors",
}
"""Kind of place as in the table → its name in explanations."""
PLACES = tuple(PLACE_TEXTS)
"""Kinds of place, in the order of all (places,) arrays."""

_PLACES_BY_WORD = word_map("lexical", "place_words")
"""Word in a prim name above → kinds of place that it indicates, separated by spaces."""

Floats = npt.NDArray[np.float64]


class _PlaceTable(NamedTuple):
    """The place and stance columns of `everyday_objects.csv`."""

    counts: Floats
    """(nouns, places): mean number of such objects in a place of the kind."""
    at_height: Floats
    """(elevation ranges, nouns): share of the objects with their lowest point there."""
    nested: Floats
    """(nouns,): share of the objects below another object in the stage's tree."""
    upright: Floats
    """(3, nouns): share of the objects whose longest, middle or shortest extent is vertical."""
    equal: Floats
    """(2, nouns): share of the objects whose long and middle, or middle and short extents are equal."""


@lru_cache(maxsize=4096)
def places_named(names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the kinds of place that prim names mention.

    >>> places_named(("KitchenDining", "shelf_02"))
    ('kitchen', 'dining')
    """
    words = (word.lower() for name in names for word in split_identifier(name))
    return tuple(place for word in words for place in _PLACES_BY_WORD.get(word, "").split())


def place_probabilities(log_likelihoods: Floats, named: Iterable[str] = ()) -> Floats:
    """Return the probability of each kind of place, (places,).

    Args:
        log_likelihoods: log P(objects around | place) up to a constant, (places,).
        named: kinds of place that names above mention, see `places_named`.
    """
    logs = log_likelihoods.copy()
    for place in named:
        logs[PLACES.index(place)] -= math.log(PLACE.uninformative_share)
    powers = np.exp(logs - logs.max())
    result: Floats = powers / powers.sum()
    return result


def log_place_likelihoods_of_noun(row: int) -> Floats:
    """Return log P(the everyday object in a row is there | place) up to a constant, (places,)."""
    logs: Floats = _log_place_likelihoods()[row]
    return logs


def log_place_likelihoods_of_appearance(log_likelihoods: Floats) -> Floats:
    """Return log P(an object of this size and stance is there | place) up to a constant, (places,).

    Args:
        log_likelihoods: log P(size, stance | noun) for each noun, (nouns,).
    """
    likely = np.exp(log_likelihoods - log_likelihoods.max()) @ _noun_shares()
    uninformative = PLACE.uninformative_appearance_share
    result: Floats = np.log((1 - uninformative) * likely / likely.mean() + uninformative)
    return result


@lru_cache(maxsize=1)
def _log_place_likelihoods() -> Floats:
    """Return log P(noun | place) over its mean over places, (nouns, places), mixed with a uniform share."""
    shares = _noun_shares() / _noun_shares().sum(axis=1, keepdims=True)
    uniform = PLACE.uninformative_share
    logs: Floats = np.log((1 - uniform) * shares * len(PLACES) + uniform)
    return logs


def noun_priors(places: Floats) -> Floats:
    """Return P(noun) of an object given the probability of each kind of place, (nouns,)."""
    priors: Floats = _noun_shares() @ places
    return priors


@lru_cache(maxsize=1)
def _noun_shares() -> Floats:
    """Return P(noun | place), (nouns, places)."""
    counts = _load_table().counts + PLACE.count_elsewhere
    shares: Floats = counts / counts.sum(axis=0, keepdims=True)
    return shares


class Stance(NamedTuple):
    """Vertical extent of an object, and equality of its extents."""

    elevation_range: int | None
    """Index of the range of elevation; None if unknown."""
    upright: tuple[int, ...]
    """Extents that may be vertical, 0 the longest; empty if unknown."""
    equal: tuple[bool, bool]
    """Whether the long and middle extents are equal, and the middle and short ones."""
    is_nested: bool
    """Whether it is below another object in the stage's tree."""


def stance_of(seen: Appearance) -> Stance:
    """Return the stance of an object."""
    long, middle, short = (math.log(max(extent, SIZE.min_extent)) for extent in sorted(seen.size, reverse=True))
    upright: tuple[int, ...] = ()
    if seen.height is not None:
        height = math.log(max(seen.height, SIZE.min_extent))
        differences = abs(long - height), abs(middle - height), abs(short - height)
        limit = min(differences) + STANCE.vertical_tolerance
        upright = tuple(index for index, difference in enumerate(differences) if difference <= limit)
    return Stance(
        elevation_range=None if seen.elevation is None else bisect_right(STANCE.elevation_limits, seen.elevation),
        upright=upright,
        equal=(long - middle < STANCE.equal_extents, middle - short < STANCE.equal_extents),
        is_nested=seen.is_nested,
    )


@lru_cache(maxsize=256)
def log_stance_likelihoods(stance: Stance) -> Floats:
    """Return log P(stance | noun) for each everyday noun, natural logarithm, (nouns,), read-only."""
    table = _load_table()
    likely = table.nested if stance.is_nested else 1 - table.nested
    for share, is_equal in zip(table.equal, stance.equal, strict=True):
        likely = likely * (share if is_equal else 1 - share)
    if stance.elevation_range is not None:
        likely = likely * table.at_height[stance.elevation_range]
    if stance.upright:
        likely = likely * table.upright[list(stance.upright)].sum(axis=0)
    logs: Floats = np.log(likely)
    logs.flags.writeable = False
    return logs


@lru_cache(maxsize=1)
def _load_table() -> _PlaceTable:
    rows = everyday_object_rows()
    at_height = {
        "floor": STANCE.floor_heights,
        "surface": STANCE.surface_heights,
        "wall": STANCE.wall_heights,
        "ceiling": STANCE.ceiling_heights,
        "part": STANCE.part_heights,
    }
    supports = list(at_height)
    counts = np.zeros((len(rows), len(PLACES)))
    stands = np.zeros((len(rows), len(supports)))
    upright = np.zeros((3, len(rows)))
    for at, row in enumerate(rows):
        for place, count in (part.split("=") for part in row["places"].split()):
            counts[at, PLACES.index(place)] = float(count)
        for support, share in zip(row["stands"].split(), STANCE.order_shares, strict=False):
            stands[at, supports.index(support)] = share
        for extent, share in zip(row["up"], STANCE.order_shares, strict=False):
            upright["lms".index(extent), at] = share
    stands += STANCE.other_support_share
    stands /= stands.sum(axis=1, keepdims=True)
    upright += STANCE.other_upright_share
    extents = np.log([[float(row[side]) for side in ("long_m", "middle_m", "short_m")] for row in rows])
    is_equal = extents[:, :2] - extents[:, 1:] < STANCE.equal_typical_extents
    return _PlaceTable(
        counts=counts,
        at_height=(stands @ np.array(list(at_height.values()))).T,
        nested=stands @ np.array(STANCE.nested_shares),
        upright=upright / upright.sum(axis=0),
        equal=np.where(is_equal, STANCE.equal_share, STANCE.chance_equal_share).T,
    )
