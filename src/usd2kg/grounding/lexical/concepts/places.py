"""Where everyday things are usually found and how they stand there: evidence where a name says nothing.

The columns `places`, `stands` and `up` of `data/everyday_objects.csv` are common sense, written down by hand.
"""

import math
from bisect import bisect_right
from collections.abc import Iterable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.context.placement import Look
from usd2kg.grounding.lexical.concepts.sizes import SMALLEST_EXTENT, thing_rows
from usd2kg.words import split_identifier

__all__ = [
    "PLACES",
    "PLACE_TEXTS",
    "Floats",
    "Stance",
    "log_stances",
    "place_of_look",
    "place_of_thing",
    "place_shares",
    "places_named",
    "stance_of",
    "thing_shares",
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
"""Kind of place, as the table calls it → what a person is told."""
PLACES = tuple(PLACE_TEXTS)
"""The kinds of places."""

_SPOKEN_OF = {
    "kitchen": "kitchen kitchenette cooking pantry galley",
    "dining": "dining dinette",
    "living": "living lounge sitting parlour parlor",
    "bedroom": "bedroom sleeping dormitory dorm",
    "bathroom": "bathroom bath toilet wc shower restroom washroom lavatory ensuite",
    "hall": "hall hallway entry entrance corridor foyer lobby stairs stairway vestibule",
    "utility": "laundry utility pantry storage cleaning scullery",
    "child": "nursery classroom playroom school kindergarten kids",
    "office": "office meeting conference reception desk cubicle study",
    "workshop": "workshop garage workbench toolroom",
    "warehouse": "warehouse factory logistics depot plant shopfloor packing",
    "laboratory": "lab laboratory hospital clinic surgery ward",
    "shop": "shop store supermarket cafe restaurant bar grocery market",
    "gym": "gym fitness sports",
    "outdoors": "street garden yard outdoor outdoors exterior patio terrace parking road park balcony backyard",
}
"""Kind of place → words of which one in the name of a prim above says that it is such a place."""
_NAMED = {
    word: tuple(place for place, words in _SPOKEN_OF.items() if word in words.split())
    for word in sorted({word for words in _SPOKEN_OF.values() for word in words.split()})
}

_ELSEWHERE = 0.003
"""How many of a thing are in a place that the table does not have for it."""
_DOUBT, _LOOK_DOUBT = 0.1, 0.3
"""How often a thing is anywhere, so that its being here says nothing of the place: of a known thing, of a look."""

_USUAL = (0.65, 0.25, 0.1)
"""Shares of the ways in which a thing stands or is turned, the usual one first."""
_OTHER_WAY, _OTHER_TURN = 0.02, 0.05
"""What each way counts that the table does not have."""
_HEIGHTS = (0.03, 0.3, 0.65, 1.15, 1.9)
"""Metres: where the ranges of elevation end."""
_AT_HEIGHT = {
    "floor": (0.80, 0.10, 0.03, 0.03, 0.02, 0.02),
    "surface": (0.06, 0.12, 0.20, 0.37, 0.18, 0.07),
    "wall": (0.06, 0.09, 0.12, 0.20, 0.33, 0.20),
    "ceiling": (0.01, 0.01, 0.01, 0.02, 0.15, 0.80),
    "part": (0.15, 0.20, 0.20, 0.25, 0.12, 0.08),
}
"""How a thing stands → share of the things that have their lowest point in each range of elevation."""
_NESTED = {"floor": 0.15, "surface": 0.3, "wall": 0.25, "ceiling": 0.15, "part": 0.8}
"""How a thing stands → share of the things that are below another object in the stage's tree."""
_SAME_EXTENT = 0.06
"""Extents whose logarithms differ by less may be taken for each other, to tell which one points up."""
_REGULAR, _TABLED = 0.03, 0.02
"""The same for extents that are equal because the thing is round or square: of an object, and in the table."""
_STAYS_REGULAR, _TURNS_REGULAR = 0.75, 0.07
"""How often extents are equal where the table has them so, and where it has not."""

Floats = npt.NDArray[np.float64]


class _Table(NamedTuple):
    counts: Floats
    """(things, places): how many there are in a place of the kind."""
    at_height: Floats
    """(ranges of elevation, things): share of the things that stand there."""
    nested: Floats
    """(things,): share of the things that are parts of others."""
    turned: Floats
    """(3, things): share of the things whose longest, middle or shortest extent points up."""
    regular: Floats
    """(2, things): share of the things with long and middle, and with middle and short extents equal."""


@lru_cache(maxsize=4096)
def places_named(names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the kinds of places that the names of prims speak of.

    >>> places_named(("KitchenDining", "shelf_02"))
    ('kitchen', 'dining')
    """
    words = (word.lower() for name in names for word in split_identifier(name))
    return tuple(place for word in words for place in _NAMED.get(word, ()))


def place_shares(logs: Floats, named: Iterable[str] = ()) -> Floats:
    """Return the probability of each kind of place, (places,).

    Args:
        logs: logarithm of how likely what was found there is in each kind of place, up to a constant, (places,).
        named: kinds of places that names above speak of, see `places_named`.
    """
    logs = logs.copy()
    for place in named:
        logs[PLACES.index(place)] -= math.log(_DOUBT)
    powers = np.exp(logs - logs.max())
    result: Floats = powers / powers.sum()
    return result


def place_of_thing(row: int) -> Floats:
    """Return log P(a thing is there | kind of place) up to a constant, (places,): of a row, see `thing_rows`."""
    logs: Floats = _shares_of_places()[row]
    return logs


def place_of_look(logs: Floats) -> Floats:
    """Return the same for something that is nameless.

    Args:
        logs: log P(what is seen of it | thing) for each thing, (things,).
    """
    likely = np.exp(logs - logs.max()) @ _shares_of_things()
    result: Floats = np.log((1 - _LOOK_DOUBT) * likely / likely.mean() + _LOOK_DOUBT)
    return result


@lru_cache(maxsize=1)
def _shares_of_places() -> Floats:
    """Return for each thing the logarithm of how often it is what one comes upon in each kind of place."""
    shares = _shares_of_things() / _shares_of_things().sum(axis=1, keepdims=True)
    logs: Floats = np.log((1 - _DOUBT) * shares * len(PLACES) + _DOUBT)
    return logs


def thing_shares(places: Floats) -> Floats:
    """Return the share of each thing among all those in a place, given the probability of each kind, (things,)."""
    shares: Floats = _shares_of_things() @ places
    return shares


@lru_cache(maxsize=1)
def _shares_of_things() -> Floats:
    counts = _load_table().counts + _ELSEWHERE
    shares: Floats = counts / counts.sum(axis=0, keepdims=True)
    return shares


class Stance(NamedTuple):
    """How an object stands and what is equal about its form, as far as it counts."""

    range: int | None
    """Number of the range of elevation; None if it is not known."""
    upright: tuple[int, ...]
    """Which of its extents, the longest 0, may point up; none if it is not known."""
    equal: tuple[bool, bool]
    """Whether the long and the middle extent are equal, and the middle and the short one."""
    is_nested: bool


def stance_of(look: Look) -> Stance:
    """Return how an object stands by its look."""
    long, middle, short = (math.log(max(extent, SMALLEST_EXTENT)) for extent in sorted(look.size, reverse=True))
    upright: tuple[int, ...] = ()
    if look.height is not None:
        height = math.log(max(look.height, SMALLEST_EXTENT))
        apart = abs(long - height), abs(middle - height), abs(short - height)
        least = min(apart) + _SAME_EXTENT
        upright = tuple(place for place, distance in enumerate(apart) if distance <= least)
    return Stance(
        range=None if look.elevation is None else bisect_right(_HEIGHTS, look.elevation),
        upright=upright,
        equal=(long - middle < _REGULAR, middle - short < _REGULAR),
        is_nested=look.is_nested,
    )


@lru_cache(maxsize=256)
def log_stances(stance: Stance) -> Floats:
    """Return log P(stance | thing) for each thing, natural logarithm, (things,); not to be written to."""
    table = _load_table()
    likely = table.nested if stance.is_nested else 1 - table.nested
    for regular, is_equal in zip(table.regular, stance.equal, strict=True):
        likely = likely * (regular if is_equal else 1 - regular)
    if stance.range is not None:
        likely = likely * table.at_height[stance.range]
    if stance.upright:
        likely = likely * table.turned[list(stance.upright)].sum(axis=0)
    logs: Floats = np.log(likely)
    logs.flags.writeable = False
    return logs


@lru_cache(maxsize=1)
def _load_table() -> _Table:
    rows = thing_rows()
    counts = np.zeros((len(rows), len(PLACES)))
    ways = list(_AT_HEIGHT)
    stands = np.zeros((len(rows), len(ways)))
    turned = np.zeros((3, len(rows)))
    for at, row in enumerate(rows):
        for place, count in (part.split("=") for part in row["places"].split()):
            counts[at, PLACES.index(place)] = float(count)
        for way, share in zip(row["stands"].split(), _USUAL, strict=False):
            stands[at, ways.index(way)] = share
        for extent, share in zip(row["up"], _USUAL, strict=False):
            turned["lms".index(extent), at] = share
    stands += _OTHER_WAY
    stands /= stands.sum(axis=1, keepdims=True)
    turned += _OTHER_TURN
    extents = np.log([[float(row[side]) for side in ("long_m", "middle_m", "short_m")] for row in rows])
    regular = np.where(extents[:, :2] - extents[:, 1:] < _TABLED, _STAYS_REGULAR, _TURNS_REGULAR)
    return _Table(
        counts=counts,
        at_height=(stands @ np.array([_AT_HEIGHT[way] for way in ways])).T,
        nested=stands @ np.array([_NESTED[way] for way in ways]),
        turned=turned / turned.sum(axis=0),
        regular=regular.T,
    )
