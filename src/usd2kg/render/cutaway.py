"""Cutaway views: scenes without ceiling, near walls and stray meshes."""

import math

import numpy as np
from numpy.typing import NDArray

from usd2kg.render.settings import CUTAWAY
from usd2kg.render.triangle_soup import TriangleSoup

__all__ = ["open_room", "without_ground", "without_strays"]

Array = NDArray[np.float64]


def without_strays(soup: TriangleSoup) -> TriangleSoup:
    """Return the triangles without sky domes and far outliers, which would shrink the rest to a dot."""
    low, high = _mesh_boxes(soup)
    extent, middle = (high - low).max(axis=1), (low + high) / 2
    inner_low, center, inner_high = (
        np.nanquantile(middle, share, axis=0, method="nearest")
        for share in (CUTAWAY.stray_quantile, 0.5, 1 - CUTAWAY.stray_quantile)
    )
    reach = max(float((inner_high - inner_low).max()), float(np.nanmedian(extent)))
    is_far = np.abs(middle - center).max(axis=1) > CUTAWAY.stray_distance * reach
    is_stray = is_far | (extent > CUTAWAY.stray_extent * reach)
    kept = ~is_stray[soup.mesh]
    return soup.part(kept) if kept.any() else soup


def without_ground(soup: TriangleSoup) -> TriangleSoup:
    """Return the triangles without ground planes that extend far beyond all other meshes, for framing."""
    low, high = _mesh_boxes(soup)
    size = high - low
    is_flat = size[:, 2] < CUTAWAY.flat_ratio * size.max(axis=1)
    rest = ~is_flat & np.isfinite(size).all(axis=1)
    if not rest.any():
        return soup
    built = (high[rest].max(axis=0) - low[rest].min(axis=0))[:2].max()
    is_ground = is_flat & (size[:, :2].max(axis=1) > CUTAWAY.ground_ratio * built)
    return soup.part(~is_ground[soup.mesh])


def open_room(soup: TriangleSoup, azimuth: float, kept_meshes: int = 0) -> TriangleSoup:
    """Return the triangles without the ceiling and without the walls towards `azimuth` and objects on them.

    All triangles of what is no room: nothing hides a lamp, a table or a shelf that stands without walls. The first
    `kept_meshes` meshes are always kept.
    """
    low, high = _mesh_boxes(soup)
    size = high - low
    built = without_ground(soup).used_points().astype(np.float64)
    floor, top = built.min(axis=0), built.max(axis=0)
    span = np.maximum(top - floor, 1e-9)
    if not _is_room(low, high, floor, top):
        return soup
    corners = soup.points[soup.triangles].astype(np.float64)
    z0, z1, z2 = corners[..., 2].T
    bottom = np.minimum(np.minimum(z0, z1), z2)
    rise = np.maximum(np.maximum(z0, z1), z2) - bottom
    rules = CUTAWAY
    is_wide = (size[:, :2] > rules.wide_share * span[:2]).all(axis=1)
    is_out = bottom > floor[2] + np.where(is_wide[soup.mesh], rules.ceiling_height, rules.top_height) * span[2]
    # A roof may slope: remove flat-ish triangles high up in a mesh as wide as the scene.
    is_high = bottom > floor[2] + rules.roof_height * span[2]
    is_out |= is_wide[soup.mesh] & is_high & (_steepness(corners) < rules.roof_steepness)
    is_tall = size[:, 2] > rules.tall_share * span[2]
    for axis, toward in ((0, math.cos(math.radians(azimuth))), (1, math.sin(math.radians(azimuth)))):
        across = 1 - axis
        # Distance that each mesh extends into the scene from the near side, in metres.
        inward = top[axis] - low[:, axis] if toward > 0 else high[:, axis] - floor[axis]
        is_thin = size[:, axis] < rules.wall_thickness * span.max()
        is_near = inward < rules.wall_distance * span[axis]
        is_wall = is_tall & is_thin & is_near & (size[:, across] > rules.wall_width * span[across])
        if is_wall.any():
            is_out |= (inward < inward[is_wall].max() + rules.wall_reach * span[2])[soup.mesh]
        # A room shell in one mesh: cut out its near wall triangle by triangle.
        is_shell = is_tall & (size[:, :2] > rules.shell_share * span[:2]).all(axis=1)
        depth = top[axis] - corners[..., axis] if toward > 0 else corners[..., axis] - floor[axis]
        is_front = (depth < rules.shell_depth * span[2]).all(axis=1) & (rise > rules.shell_rise * span[2])
        is_out |= is_shell[soup.mesh] & is_front
    kept = ~is_out | (soup.mesh < kept_meshes)
    return soup.part(kept) if kept.any() else soup


def _is_room(low: Array, high: Array, floor: Array, top: Array) -> bool:
    """Return whether a scene is as large as a room and has a wall, a ceiling or both in one mesh.

    Args:
        low: (k, 3), metres, lower corners of the meshes.
        high: (k, 3), metres, upper corners of the meshes.
        floor: (3,), metres, lower corner of the scene without its ground.
        top: (3,), metres, upper corner of the scene without its ground.
    """
    rules, size, span = CUTAWAY, high - low, top - floor
    if (span[:2] < rules.room_width).any() or span[2] < rules.room_height:
        return False
    is_wide = (size[:, :2] > rules.wide_share * span[:2]).all(axis=1)
    # A ceiling, a roof, or a room shell.
    if (is_wide & (high[:, 2] > floor[2] + rules.ceiling_height * span[2])).any():
        return True
    is_tall = size[:, 2] > rules.tall_share * span[2]
    for axis in (0, 1):
        is_thin = size[:, axis] < rules.wall_thickness * span.max()
        margin = rules.wall_distance * span[axis]
        is_at_edge = (high[:, axis] - floor[axis] < margin) | (top[axis] - low[:, axis] < margin)
        if (is_tall & is_thin & is_at_edge & (size[:, 1 - axis] > rules.wide_share * span[1 - axis])).any():
            return True
    return False


def _steepness(corners: Array) -> Array:
    """Return the sine of the slope of each triangle: 0 for horizontal, 1 for vertical."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    steepness: Array = np.hypot(normal[:, 0], normal[:, 1]) / np.maximum(np.linalg.norm(normal, axis=1), 1e-30)
    return steepness


def _mesh_boxes(soup: TriangleSoup) -> tuple[Array, Array]:
    """Return the AABB corners (k, 3) of each mesh; NaN for a mesh without triangles."""
    count = int(soup.mesh.max(initial=-1)) + 1
    low, high = np.full((count, 3), np.nan), np.full((count, 3), np.nan)
    # Triangles are sorted by mesh.
    starts = np.flatnonzero(np.diff(soup.mesh, prepend=-1))
    here = soup.mesh[starts]
    corners = [soup.points[soup.triangles[:, i]] for i in range(3)]
    low[here] = np.min([np.minimum.reduceat(corner, starts, axis=0) for corner in corners], axis=0)
    high[here] = np.max([np.maximum.reduceat(corner, starts, axis=0) for corner in corners], axis=0)
    return low, high
