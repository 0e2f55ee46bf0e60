"""Leads: cables and hoses between two things, known by their form alone."""

import heapq
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import first_of_each_group, rounded
from usd2kg.relations.boxed_objects import BoxedObjects, ClassMembership
from usd2kg.relations.model import Links, margin_below, margin_score
from usd2kg.relations.thresholds import AttachedRule
from usd2kg.shapes import overlapping_pairs
from usd2kg.shapes.axis_rays import find_crossings
from usd2kg.shapes.mesh_distance import Solid, exact_distance
from usd2kg.shapes.surface import Surface, SurfacePiece
from usd2kg.shapes.welding import weld_points

__all__ = ["Leads", "find_leads"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_MIN_TRIANGLES = 16
"""A bent tube has at least two pieces with four sides each."""
_MAX_TRIANGLES = 5000
"""Triangles beyond which the ends of a tube are not looked for; bounds the running time."""
_BLOCK = 1000
"""Objects whose surfaces are measured together; affects only speed and memory."""
_MAX_COILS = 4.0
"""Length of a tube over the diagonal of its box; sheets seem to be much longer tubes."""
_MISFIT = 0.25
"""Share by which the way along a tube may differ from the length that follows from its area and its volume."""
_END = 2.0
"""Length of an end in thicknesses of the tube."""
_WELD_SHARE = 2.0**-20
"""Share of the extent of an object within which points coincide."""
_SUNK = 1e-4
"""Metres by which an end reaches into the box of what it is plugged into; it does not into what it lies on."""


_SMALLEST = 1e-12
"""Smallest divisor."""


class Leads(NamedTuple):
    """Cables and hoses, and what their ends are in."""

    links: Links
    """`attached-to`, from each lead to the larger of the two things at its ends."""
    lead: Indices
    """One row for each end."""
    thing: Indices
    """What the end is in."""

    def tie(self, links: Links, count: int) -> Mask:
        """Return for each link whether it is from a thing to the lead that ends in it."""
        keys = self.thing * count + self.lead
        return np.isin(links.target * count + links.anchor, keys)


class _Tube(NamedTuple):
    length: float
    """Along its bends, metres."""
    thickness: float


def find_leads(
    boxed: BoxedObjects, classes: ClassMembership, may_lead: Mask, holder: Indices, rule: AttachedRule
) -> Leads:
    """Return the thin tubes of one piece whose two ends are in two different things, but not in what they lie on or in.

    A tube that ends at a wall, a ceiling or a floor is fixed there.

    Args:
        boxed: the objects.
        classes: membership in class lists.
        may_lead: whether each object may be a lead.
        holder: the supporter or the container of each object, -1 for none.
        rule: the thresholds.
    """
    is_ground = (classes.are_in("mounts") | classes.are_in("not_mounts"))[boxed.scene_index]
    leads: list[int] = []
    ends: list[Solid] = []
    for index, tube in _find_tubes(boxed, np.flatnonzero(may_lead & boxed.has_surface & ~is_ground), rule).items():
        surface = boxed.surfaces[index]
        if surface is not None and (found := _find_ends(surface.corners, tube)) is not None:
            leads.append(index)
            ends.extend(map(_as_solid, found))
    owner = np.repeat(np.array(leads, np.int64), 2)
    number, thing, gap = _plugged(boxed, owner, ends, rule)
    is_around = thing == holder[owner[number]]
    number, thing, gap = number[~is_around], thing[~is_around], gap[~is_around]
    # Of several things around an end, the smallest is what it is plugged into.
    first = first_of_each_group(number, (boxed.rank[thing], rounded(boxed.volume[thing])))
    number, thing, gap = number[first], thing[first], gap[first]
    count = np.bincount(number // 2, minlength=len(leads))
    is_fixed = np.bincount(number[is_ground[thing]] // 2, minlength=len(leads)) > 0
    is_lead = (count == 2) & ~is_fixed
    some = np.flatnonzero(is_lead[number // 2])
    one, other = thing[some[::2]], thing[some[1::2]]
    some = some[np.repeat(one != other, 2)]
    lead, thing, gap = owner[number[some]], thing[some], gap[some]
    best = first_of_each_group(lead, (boxed.rank[thing], -rounded(boxed.volume[thing])))
    confidence = margin_score(margin_below(gap[best], np.full(len(best), rule.max_touch)))
    links = Links("attached-to", rule.rule, lead[best], thing[best], {"gap": gap[best]}, confidence)
    return Leads(links, lead, thing)


def _find_tubes(boxed: BoxedObjects, indices: Indices, rule: AttachedRule) -> dict[int, _Tube]:
    """Return object → the thin tube that its surface may be, in the order of the objects."""
    forms: dict[tuple[tuple[int, int, bytes], ...], list[int]] = {}
    for index in indices.tolist():
        surface = boxed.surfaces[index]
        if surface is not None and _MIN_TRIANGLES <= surface.triangle_count <= _MAX_TRIANGLES:
            forms.setdefault(_form_of(surface), []).append(index)
    # Moved copies have the form of the first.
    copies = list(forms.values())
    found: dict[int, _Tube] = {}
    for start in range(0, len(copies), _BLOCK):
        block = copies[start : start + _BLOCK]
        first = np.array([alike[0] for alike in block], np.int64)
        surfaces = [surface.corners for index in first.tolist() if (surface := boxed.surfaces[index]) is not None]
        tubes = _measure_tubes(surfaces, np.linalg.norm(boxed.size[first], axis=1), rule)
        found.update((index, tube) for alike, tube in zip(block, tubes, strict=True) if tube for index in alike)
    return dict(sorted(found.items()))


def _form_of(surface: Surface) -> tuple[tuple[int, int, bytes], ...]:
    """Return a key that is the same for moved copies of a surface."""
    return tuple([(id(piece.points), id(piece.triangles), piece.matrix[:3, :3].tobytes()) for piece in surface.pieces])


def _measure_tubes(surfaces: Sequence[Array], diagonals: Array, rule: AttachedRule) -> list[_Tube | None]:
    """Return the tubes of the same area πdl and volume πd²l/4; None for what is too thick, or coiled up like a sheet.

    Args:
        surfaces: the triangles (m, 3, 3) of each surface, at least one.
        diagonals: (n,), those of their boxes in metres.
        rule: the thresholds.
    """
    area, volume = _areas_and_volumes(surfaces)
    thickness = 4 * volume / np.maximum(area, _SMALLEST)
    length = area / (np.pi * np.maximum(thickness, _SMALLEST))
    is_tube = (thickness > 0) & (length >= rule.min_lead_slenderness * thickness) & (length <= _MAX_COILS * diagonals)
    rows = zip(length.tolist(), thickness.tolist(), is_tube.tolist(), strict=True)
    return [_Tube(*measured) if good else None for *measured, good in rows]


def _areas_and_volumes(surfaces: Sequence[Array]) -> tuple[Array, Array]:
    """Return the area (n,) and the enclosed volume (n,) of surfaces by their triangles, (m, 3, 3) each.

    Sums over the triangles of many surfaces are many times faster than those of one after the other.
    """
    counts = np.array([len(corners) for corners in surfaces], np.int64)
    starts = np.cumsum(counts) - counts
    corners = np.concatenate(surfaces)
    # About a point near each surface, which keeps the terms of the sums small.
    corners = corners - np.repeat(corners[starts, 0], counts, axis=0)[:, None]
    one, other, third = corners[:, 0], corners[:, 1], corners[:, 2]
    doubled = np.linalg.norm(np.cross(other - one, third - one), axis=1)
    signed = np.einsum("ij,ij->i", one, np.cross(other, third))
    return np.add.reduceat(doubled, starts) / 2, np.abs(np.add.reduceat(signed, starts)) / 6


def _find_ends(corners: Array, tube: _Tube) -> tuple[Array, Array] | None:
    """Return the triangles (n, 3, 3) at both ends: the points that are farthest from each other along the surface.

    None if the surface is not in one piece, or the way along it is not as long as the tube.
    """
    points = corners.reshape(-1, 3)
    extent = float((points.max(axis=0) - points.min(axis=0)).max())
    welded = weld_points(points - points.min(axis=0), extent * _WELD_SHARE)
    triangles = welded.group.reshape(-1, 3)
    edges = np.unique(
        np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])), axis=0
    )
    places = points[welded.first]
    lengths = np.linalg.norm(places[edges[:, 0]] - places[edges[:, 1]], axis=1)
    around: list[list[tuple[int, float]]] = [[] for _ in places]
    for (i, j), length in zip(edges.tolist(), lengths.tolist(), strict=True):
        around[i].append((j, length))
        around[j].append((i, length))
    start = _distances_from(0, around)
    if not np.isfinite(start).all():
        return None
    away = _distances_from(int(start.argmax()), around)
    farthest = float(away.max())
    if abs(farthest - tube.length) > _MISFIT * tube.length:
        return None
    back = _distances_from(int(away.argmax()), around)
    reach = _END * tube.thickness
    return _cut(corners, away[triangles], reach), _cut(corners, back[triangles], reach)


def _cut(corners: Array, away: Array, reach: float) -> Array:
    """Return the triangles (n, 3, 3) with a corner within reach, cut off there: a straight piece may be long.

    Args:
        corners: all triangles (m, 3, 3).
        away: how far each corner (m, 3) is from the end, along the surface.
        reach: metres.
    """
    some = (away <= reach).any(axis=1)
    corners, away = corners[some], away[some]
    first = corners[np.arange(len(corners)), away.argmin(axis=1)][:, None]
    steps = corners - first
    lengths = np.maximum(np.linalg.norm(steps, axis=2, keepdims=True), _SMALLEST)
    return np.asarray(first + steps * np.minimum(1.0, reach / lengths))


def _distances_from(start: int, around: list[list[tuple[int, float]]]) -> Array:
    """Return the length of the shortest way to each point along the edges (Dijkstra 1959); inf if there is none."""
    found = [np.inf] * len(around)
    found[start] = 0.0
    queue = [(0.0, start)]
    while queue:
        length, here = heapq.heappop(queue)
        if length > found[here]:
            continue
        for there, step in around[here]:
            if length + step < found[there]:
                found[there] = length + step
                heapq.heappush(queue, (length + step, there))
    return np.array(found)


def _as_solid(corners: Array) -> Solid:
    points = corners.reshape(-1, 3)
    if not len(points):
        return Solid(np.full(3, np.inf), np.full(3, -np.inf), None)
    triangles = np.arange(len(points), dtype=np.int32).reshape(-1, 3)
    surface = Surface((SurfacePiece(points.astype(np.float32), triangles, np.eye(4)),))
    return Solid(points.min(axis=0), points.max(axis=0), surface)


def _plugged(
    boxed: BoxedObjects, owner: Indices, ends: list[Solid], rule: AttachedRule
) -> tuple[Indices, Indices, Array]:
    """Return the numbers of ends, the objects that each of them reaches into, and the distances of the surfaces.

    That is 0 for an end within an object, however deep.
    """
    if not ends:
        none = np.zeros(0, np.int64)
        return none, none, np.zeros(0)
    lower, upper = np.array([end.lower for end in ends]), np.array([end.upper for end in ends])
    rows: list[tuple[int, int, float]] = []
    for i, j in overlapping_pairs(lower, upper, (boxed.lower, boxed.upper)):
        shared = np.minimum(upper[i], boxed.upper[j]) - np.maximum(lower[i], boxed.lower[j])
        is_sunk = (shared >= np.minimum(_SUNK, boxed.size[j])).all(axis=1) & (owner[i] != j)
        for number, thing in zip(i[is_sunk].tolist(), j[is_sunk].tolist(), strict=True):
            other = Solid(boxed.lower[thing], boxed.upper[thing], boxed.surfaces[thing])
            gap = exact_distance(ends[number], other, rule.max_touch)
            gap = 0.0 if gap > rule.max_touch and _is_within(ends[number], other) else gap
            if gap <= rule.max_touch:
                rows.append((number, thing, gap))
    table = np.array(sorted(rows), np.float64).reshape(-1, 3)
    return table[:, 0].astype(np.int64), table[:, 1].astype(np.int64), table[:, 2]


def _is_within(end: Solid, other: Solid) -> bool:
    """Return whether the middle of an end is within an object: a line upwards leaves it once more than it enters it."""
    if other.surface is None:
        return True
    middle = (end.lower + end.upper) / 2
    crossings = find_crossings([middle[None]], [other.surface], 2)
    return int((crossings.at > middle[2]).sum()) % 2 == 1
