"""Free places: where a thing can be put on the level tops of objects."""

from collections.abc import Container, Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.assistant.sentences import count_phrase
from usd2kg.assistant.settings import PLACING
from usd2kg.assistant.usual_sizes import usual_size
from usd2kg.errors import GraphError
from usd2kg.knowledge import word_set
from usd2kg.query.body_table import Body
from usd2kg.query.lookup import Nouns, SceneFacts

__all__ = ["FreePlace", "PlacedThing", "find_free_places", "flat_tops", "thing_to_place"]


class FreePlace(NamedTuple):
    """A free spot on a surface."""

    surface: str
    """IRI of the object."""
    position: tuple[float, float, float]
    """Metres, world frame: centre of the thing's footprint."""
    occupied: float
    """Share of the surface that other things stand on."""


class PlacedThing(NamedTuple):
    """What is to be put somewhere."""

    text: str
    size: tuple[float, float, float]
    """Extents along x, y and z, metres."""
    moved: tuple[str, ...]
    """IRIs of the things that it is, which leave their place; empty for one that the scene lacks."""


def thing_to_place(nouns: Nouns, facts: SceneFacts, noun: str) -> PlacedThing:
    """Return what a noun means: the first of its things with a box, else a thing of usual size.

    Raises:
        GraphError: the size is not known, or “the thing” is not in the scene.
    """
    things = nouns.find(noun)
    is_definite = noun.split(maxsplit=1)[0].lower() in word_set("grammar", "definite")
    if not (things.iris or is_definite) and (usual := usual_size(things.text)) is not None:
        return PlacedThing(f"{count_phrase(1, things.text)} of usual size", usual, ())
    if not things.iris:
        raise GraphError(things.absence)
    for body in map(facts.body, things.iris):
        if body.lower is not None and body.upper is not None:
            width, depth, height = (float(side) for side in body.upper - body.lower)
            return PlacedThing(things.text, (width, depth, height), things.iris)
    raise GraphError(f"not known: the graph has no box for {things.text}, so its size is unknown")


def find_free_places(
    facts: SceneFacts,
    size: tuple[float, float, float],
    surfaces: Iterable[str],
    moved: Iterable[str] = (),
    flat: Container[str] = (),
) -> list[FreePlace]:
    """Return the surfaces with a free spot for a thing, the emptiest first.

    A surface is level where other things stand on it: the seat of a chair, not its back; the top board of a rack, since
    what stands on it says nothing of the room below. An empty table is level at the top of its box. A spot is free if
    the box of the thing, with a clearance, meets no other box. The footprint may be turned by a right angle.

    Args:
        facts: the scene.
        size: extents of the thing along x, y and z, metres.
        surfaces: IRIs of the objects to try.
        moved: IRIs of things that leave their place.
        flat: IRIs of objects, such as tables, whose tops are level by what they are.
    """
    table = facts.bodies.table
    rows = {iri: row for row, iri in enumerate(table.iris)}
    gone = [rows[iri] for iri in moved if iri in rows]
    found = []
    for iri in surfaces:
        row = rows.get(iri)
        bottoms = [table.lower[rows[one], 2] for one in facts.related("on", iri) if one in rows]
        level = _highest_level(bottoms)
        if row is not None and not bottoms and iri in flat:
            level = float(table.upper[row, 2])
        if row is None or np.isnan(table.lower[row]).any() or np.isnan(level):
            continue
        bearers = [rows[one] for name in ("on", "part") for one in facts.anchors(name, iri) if one in rows]
        for footprint in sorted({(size[0], size[1]), (size[1], size[0])}):
            spot = _free_spot(table.lower, table.upper, [row, *bearers, *gone], level, footprint, size[2])
            if spot is not None:
                found.append(FreePlace(iri, spot, _occupied(table.lower, table.upper, row, level)))
                break
    return sorted(found, key=lambda place: (round(place.occupied, 2), place.surface))


def flat_tops(nouns: Nouns, facts: SceneFacts) -> set[str]:
    """Return the things whose tops are level by what they are, such as tables, if they are within reach."""
    found = {iri for noun in sorted(word_set("assistant", "flat_tops")) for iri in nouns.known(noun)}
    floors = [float(body.upper[2]) for body in map(facts.body, nouns.floors) if body.upper is not None]
    return {iri for iri in found if _is_within_reach(facts.body(iri), floors)}


def _is_within_reach(body: Body, floors: list[float]) -> bool:
    if body.lower is None or body.upper is None:
        return False
    bottom, top = float(body.lower[2]), float(body.upper[2])
    # Of several storeys, the floor below the thing.
    floor = max((level for level in floors if level < bottom + PLACING.level), default=min(floors, default=0.0))
    return top - bottom <= PLACING.max_flat_top and top - floor <= PLACING.max_height


def _highest_level(bottoms: list[float]) -> float:
    """Return the height at which the highest things within reach stand on an object, their median; NaN without any."""
    known = np.array([bottom for bottom in bottoms if bottom <= PLACING.max_height])
    if not len(known):
        return float("nan")
    return float(np.median(known[known > known.max() - PLACING.level]))


def _free_spot(
    lower: NDArray[np.float64],
    upper: NDArray[np.float64],
    own: list[int],
    level: float,
    footprint: tuple[float, float],
    height: float,
) -> tuple[float, float, float] | None:
    """Return the free centre of a footprint that is nearest to the middle of a surface.

    `own` has the row of the surface, then those of what bears it and of what leaves.
    """
    row = own[0]
    half = np.array(footprint) / 2 + PLACING.clearance
    low, high = lower[row, :2] + half, upper[row, :2] - half
    if bool(np.any(low > high)):
        return None
    axes = [np.linspace(a, b, max(2, int((b - a) / PLACING.step) + 1)) for a, b in zip(low, high, strict=True)]
    centers = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    # What encloses the surface, such as walls of a room in one box, does not stand on it.
    # A sink or a hob ends where its worktop does.
    is_above = (upper[:, 2] > level - PLACING.clearance) & (lower[:, 2] < level + height)
    is_around = (lower[:, :2] < lower[row, :2]).all(axis=1) & (upper[:, :2] > upper[row, :2]).all(axis=1)
    is_near = ((lower[:, :2] < upper[row, :2]) & (upper[:, :2] > lower[row, :2])).all(axis=1)
    others = np.flatnonzero(is_above & is_near & ~is_around)
    others = others[~np.isin(others, own)]
    meets = ((centers[:, None, :] + half > lower[others, :2]) & (centers[:, None, :] - half < upper[others, :2])).all(
        axis=2
    )
    free = centers[~np.any(meets, axis=1)] if len(others) else centers
    if not len(free):
        return None
    middle = (lower[row, :2] + upper[row, :2]) / 2
    x, y = free[np.argmin(np.linalg.norm(free - middle, axis=1))]
    return round(float(x), 3), round(float(y), 3), round(level, 3)


def _occupied(lower: NDArray[np.float64], upper: NDArray[np.float64], row: int, level: float) -> float:
    """Return the share of a surface that boxes which stand on it cover, each for itself."""
    area = np.prod(upper[row, :2] - lower[row, :2])
    stands = np.abs(lower[:, 2] - level) < 2 * PLACING.clearance
    shared = np.minimum(upper[:, :2], upper[row, :2]) - np.maximum(lower[:, :2], lower[row, :2])
    covered = np.where(stands & (shared > 0).all(axis=1), shared.prod(axis=1), 0).sum()
    return float(min(covered / area, 1.0)) if area > 0 else 1.0
