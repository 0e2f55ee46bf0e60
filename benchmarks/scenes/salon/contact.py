"""Where a thing that falls meets others."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Solid", "heights_below", "lift_onto", "solid"]

CHUNK = 2_000_000
STEP = 0.01
"""Metres between the points of long edges that are tested beside the corners."""


class Solid(NamedTuple):
    """A mesh in the world, in triangles."""

    points: NDArray[np.float64]
    """(n, 3) metres."""
    triangles: NDArray[np.int64]
    """(m, 3)."""


def solid(points: NDArray[np.float64], faces: Sequence[Sequence[int]]) -> Solid:
    """Return a mesh with its faces split into fans."""
    triangles = [(face[0], face[i], face[i + 1]) for face in faces for i in range(1, len(face) - 1)]
    return Solid(points, np.array(triangles))


def lift_onto(thing: Solid, supporters: Sequence[Solid], below: float = np.inf) -> float:
    """Return how far a thing moves up (or down, if negative) until it just stands on the supporters.

    Only points of the supporters below the height `below` count.
    """
    lifts = []
    for supporter in supporters:
        feet = _edge_points(thing)
        down = heights_below(feet, supporter, below) - feet[:, 2]
        corners = _edge_points(supporter, thing.points[:, :2])
        corners = corners[corners[:, 2] < below]
        up = corners[:, 2] + heights_below(corners, thing._replace(points=thing.points * [1, 1, -1]), np.inf)
        lifts += [float(np.max(a)) for a in (down, up) if len(a)]
    lift = max(lifts, default=-np.inf)
    if not np.isfinite(lift):
        raise ValueError("nothing is below it")
    return lift


def _edge_points(mesh: Solid, plan: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
    """Return the corners and points of the long edges; only those within the bounds of `plan`, if given."""
    ends = np.unique(np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    a, b = mesh.points[ends[:, 0]], mesh.points[ends[:, 1]]
    counts = np.clip(np.linalg.norm(b - a, axis=1) // STEP, 0, 200).astype(int)
    pieces = [mesh.points]
    for count in np.unique(counts[counts > 0]):
        shares = np.arange(1, count + 1)[:, None, None] / (count + 1)
        here = counts == count
        pieces.append((a[here] + shares * (b[here] - a[here])).reshape(-1, 3))
    points = np.concatenate(pieces)
    if plan is None:
        return points
    return points[((points[:, :2] >= plan.min(axis=0)) & (points[:, :2] <= plan.max(axis=0))).all(axis=1)]


def heights_below(points: NDArray[np.float64], mesh: Solid, below: float) -> NDArray[np.float64]:
    """Return for each point the highest z, less than `below`, of the mesh on its vertical line; else -inf."""
    heights = np.full(len(points), -np.inf)
    if not len(points):
        return heights
    a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    low, high = (f(mesh.points[mesh.triangles][:, :, :2], axis=1) for f in (np.min, np.max))
    near = (
        (np.abs(area) > 1e-12)
        & (high >= points[:, :2].min(axis=0)).all(axis=1)
        & (low <= points[:, :2].max(axis=0)).all(axis=1)
    )
    a, b, c, area = a[near], b[near], c[near], area[near]
    if not len(a):
        return heights
    step = max(1, CHUNK // len(a))
    for start in range(0, len(points), step):
        p = points[start : start + step, None]
        u = ((p[..., 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (p[..., 1] - a[:, 1]) * (c[:, 0] - a[:, 0])) / area
        v = ((b[:, 0] - a[:, 0]) * (p[..., 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (p[..., 0] - a[:, 0])) / area
        z = a[:, 2] + u * (b[:, 2] - a[:, 2]) + v * (c[:, 2] - a[:, 2])
        z[(u < -1e-9) | (v < -1e-9) | (u + v > 1 + 1e-9) | (z >= below)] = -np.inf
        heights[start : start + step] = z.max(axis=1)
    return heights
