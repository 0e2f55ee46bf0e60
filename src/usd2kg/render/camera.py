"""Pinhole cameras: framing, projection and view rays."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from usd2kg.render.settings import VIEWPOINT

__all__ = ["Camera", "aim"]

Array = NDArray[np.float64]

_VIEW_ANGLE = math.radians(VIEWPOINT.vertical_view_angle)


@dataclass(frozen=True)
class Camera:
    """A pinhole camera in the z-up world frame; lengths in metres."""

    eye: Array
    """(3,): position of the camera."""
    axes: Array
    """(3, 3): rows are the unit vectors right, up and forward."""
    width: int
    """Pixels."""
    height: int
    focal: float
    """Focal length in pixels."""
    near: float
    """Near clipping distance along the view direction, in metres."""

    def to_view(self, points: NDArray[np.floating]) -> Array:
        """Return world points in camera axes (right, up, forward)."""
        return (points.astype(np.float64) - self.eye) @ self.axes.T

    def to_pixels(self, view: Array) -> Array:
        """Return points in camera axes as (x, y, 1 / forward), x and y in pixels from the top left corner."""
        inverse = 1.0 / view[..., 2]
        x = self.width / 2 + view[..., 0] * inverse * self.focal
        y = self.height / 2 - view[..., 1] * inverse * self.focal
        return np.stack([x, y, inverse], axis=-1)

    def rays(self, x: NDArray[np.floating], y: NDArray[np.floating]) -> Array:
        """Return the view direction (right, up, 1) of image points, in camera axes."""
        right = (x - self.width / 2) / self.focal
        up = (self.height / 2 - y) / self.focal
        rays: Array = np.stack([right, up, np.ones_like(right)], axis=-1)
        return rays

    def cut_before(self, points: NDArray[np.floating]) -> "Camera":
        """Return the same view, clipped in front of the nearest of `points`."""
        return replace(self, near=max(self.near, float(self.to_view(points)[:, 2].min())))

    def scaled(self, factor: float) -> "Camera":
        """Return the same view with `factor` times the pixels along each axis."""
        width, height = max(1, round(self.width * factor)), max(1, round(self.height * factor))
        return Camera(self.eye, self.axes, width, height, self.focal * height / self.height, self.near)


def aim(
    points: NDArray[np.floating],
    azimuth: float,
    elevation: float,
    size: tuple[int, int],
    margin: float = VIEWPOINT.object_margin,
) -> Camera:
    """Return a camera that frames all `points` from a direction.

    Args:
        points: (n, 3), world, at least one.
        azimuth: direction from the points to the camera, degrees from the x axis, counter-clockwise seen from above.
        elevation: degrees of that direction above the horizon.
        size: width and height of the picture in pixels.
        margin: empty border, as a share of the shorter side of the picture.
    """
    width, height = size
    axes = _axes(math.radians(azimuth), math.radians(elevation))
    local = points.astype(np.float64) @ axes.T
    middle = (local.min(axis=0) + local.max(axis=0)) / 2
    extent = max(float(np.ptp(local, axis=0).max()), 1e-6)
    # Tangents of the half angles that leave a border of equal width in pixels on all sides.
    border = margin * min(width, height)
    up = math.tan(_VIEW_ANGLE / 2) * (1 - 2 * border / height)
    right = math.tan(_VIEW_ANGLE / 2) * (width - 2 * border) / height
    distance = 0.0
    for _ in range(3):
        offset = local - middle
        # |x| ≤ right · (distance + z) and |y| ≤ up · (distance + z) for all points.
        distance = float((np.maximum(np.abs(offset[:, 0]) / right, np.abs(offset[:, 1]) / up) - offset[:, 2]).max())
        distance = max(distance, extent * 0.05)
        # Perspective shifts the projected centre: move the camera so that the borders are even.
        seen = offset[:, :2] / (distance + offset[:, 2:])
        middle[:2] += (seen.min(axis=0) + seen.max(axis=0)) / 2 * distance
    eye = (middle - np.array([0.0, 0.0, distance])) @ axes
    focal = height / 2 / math.tan(_VIEW_ANGLE / 2)
    return Camera(eye, axes, width, height, focal, near=max(extent, distance) * 1e-3)


def _axes(azimuth: float, elevation: float) -> Array:
    forward = -np.array(
        [math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation)]
    )
    right = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
    return np.stack([right, np.cross(right, forward), forward])
