"""The three kinds of picture: an object alone, an object in its surroundings, a scene."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.render.camera import Camera, aim
from usd2kg.render.cutaway import open_room, without_ground, without_strays
from usd2kg.render.raster import rasterise
from usd2kg.render.settings import PICTURE, VIEWPOINT
from usd2kg.render.shade import draw, to_srgb
from usd2kg.render.triangle_soup import TriangleSoup

__all__ = [
    "Pixels",
    "SceneView",
    "Size",
    "choose_scene_view",
    "picture_in_context",
    "picture_of_object",
    "picture_of_scene",
]

Array = NDArray[np.float64]
Pixels = NDArray[np.uint8]
Size = tuple[int, int]

_BACKGROUND = np.array(PICTURE.background)
_HIGHLIGHT = np.array(PICTURE.highlight)
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""Luminance of linear RGB (ITU-R BT.709)."""
_OBJECT_PREVIEW, _SCENE_PREVIEW, _CONTEXT_PREVIEW = VIEWPOINT.preview_size


class SceneView(NamedTuple):
    """A camera, and the triangles that it shows."""

    camera: Camera
    soup: TriangleSoup


def picture_of_object(soup: TriangleSoup, size: Size) -> Pixels:
    """Return the object alone, from the three-quarter view that shows most detail."""
    points = soup.used_points()
    width, depth, height = np.ptp(points.astype(np.float64), axis=0)
    is_flat = height < VIEWPOINT.flat_object_ratio * max(width, depth)
    elevation = VIEWPOINT.flat_object_elevation if is_flat else VIEWPOINT.object_elevation
    views = [aim(points, VIEWPOINT.front + turn, elevation, size) for turn in VIEWPOINT.corner_turns]
    # The front has doors and knobs, and so more edges than the back.
    detail = [_detail(view.scaled(_OBJECT_PREVIEW / max(size)), soup, is_smooth=True) for view in views]
    camera = views[_first_clearly_best(detail, VIEWPOINT.object_gain)]
    return _downsample(draw(camera.scaled(PICTURE.samples), soup).over(_BACKGROUND))


def picture_of_scene(soup: TriangleSoup, size: Size) -> Pixels:
    """Return the whole scene from a corner above, without ceiling and near walls."""
    camera, visible = choose_scene_view(soup, size)
    return _downsample(draw(camera.scaled(PICTURE.samples), visible).over(_BACKGROUND))


def choose_scene_view(soup: TriangleSoup, size: Size) -> SceneView:
    """Return the corner view that shows most detail, with ceiling and near walls removed."""
    soup = without_strays(soup)
    views = []
    for turn in VIEWPOINT.corner_turns:
        visible = open_room(soup, VIEWPOINT.front + turn)
        points = without_ground(visible).used_points()
        views.append(
            SceneView(
                aim(points, VIEWPOINT.front + turn, VIEWPOINT.scene_elevation, size, margin=VIEWPOINT.scene_margin),
                visible,
            )
        )
    detail = [_detail(view.camera.scaled(_SCENE_PREVIEW / max(size)), view.soup, is_smooth=False) for view in views]
    return views[_first_clearly_best(detail, VIEWPOINT.scene_gain)]


def picture_in_context(soup: TriangleSoup, own_meshes: int, size: Size) -> Pixels:
    """Return the object in warm colours among grey surroundings, from the view that hides least of it.

    If most of it stays hidden (a spoon in a closed drawer), the hidden part is blended in.

    Args:
        soup: the object and everything near it.
        own_meshes: the number of meshes, first in `soup`, that belong to the object.
        size: width and height in pixels.
    """
    camera, soup = _choose_context_view(soup, own_meshes, size)
    camera = camera.scaled(PICTURE.samples)
    is_own = soup.mesh < own_meshes
    grey = soup.colors.astype(np.float64) @ _LUMINANCE
    warm = 0.35 * soup.colors + (0.25 + 0.6 * grey[:, None]) * _HIGHLIGHT
    muted = 0.1 * soup.colors + 0.55 * grey[:, None] + 0.16
    tinted = soup.recolored(np.where(is_own[:, None], warm, muted))
    drawn = draw(camera, tinted)
    alone = draw(camera, tinted.part(is_own))
    light = drawn.over(_BACKGROUND)
    silhouette = alone.mesh >= 0
    hidden = silhouette & ((drawn.mesh < 0) | (drawn.mesh >= own_meshes))
    if hidden.sum() < PICTURE.occluded_share * silhouette.sum():
        silhouette, hidden = silhouette & ~hidden, np.zeros_like(hidden)
    light[hidden] = (1 - PICTURE.hidden_alpha) * light[hidden] + PICTURE.hidden_alpha * alone.over(_BACKGROUND)[hidden]
    light[_dilate(silhouette, PICTURE.outline_width) & ~silhouette] = PICTURE.outline_light * _HIGHLIGHT
    return _downsample(light)


def _choose_context_view(soup: TriangleSoup, own_meshes: int, size: Size) -> SceneView:
    """Return the view around the object that shows most of it."""
    points = soup.part(soup.mesh < own_meshes).used_points()
    low, high = points.min(axis=0).astype(np.float64), points.max(axis=0).astype(np.float64)
    extent = float((high - low).max())
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    is_large = extent > VIEWPOINT.large_share * float(np.ptp(soup.used_points(), axis=0).max())
    padding = max(VIEWPOINT.context_padding * extent, VIEWPOINT.min_context_padding)
    if is_large:
        padding = VIEWPOINT.large_padding * extent
    framed = (low - padding) + corners * (high - low + 2 * padding)
    views, visible_pixels = [], []
    elevations = list(zip(VIEWPOINT.context_elevations, VIEWPOINT.context_weights, strict=True))
    for elevation, weight in [(VIEWPOINT.scene_elevation, 1.0)] if is_large else elevations:
        for turn in VIEWPOINT.corner_turns if is_large else VIEWPOINT.context_turns:
            azimuth = VIEWPOINT.front + turn
            camera = aim(framed, azimuth, elevation, size, margin=0.0)
            # Cut off the wall, fridge or lamp between the viewer and the surroundings.
            view = (
                SceneView(camera, open_room(soup, azimuth, own_meshes))
                if is_large
                else SceneView(camera.cut_before(framed), soup)
            )
            hits = rasterise(
                view.camera.scaled(_CONTEXT_PREVIEW / max(size)), view.soup.points, view.soup.triangles
            ).triangle
            visible_pixels.append(weight * float((view.soup.mesh[hits[hits >= 0]] < own_meshes).sum()))
            views.append(view)
    return views[_first_clearly_best(visible_pixels, VIEWPOINT.context_gain)]


def _first_clearly_best(values: list[float], factor: float) -> int:
    """Return the index of the best value; a later one must exceed the best so far by `factor` to replace it.

    >>> _first_clearly_best([10, 11, 20, 21], 1.3)
    2
    """
    best = 0
    for i, value in enumerate(values):
        if value > values[best] * factor:
            best = i
    return best


def _detail(camera: Camera, soup: TriangleSoup, *, is_smooth: bool) -> float:
    """Return the number of pixels that differ from the next pixel to the right or below."""
    image = draw(camera, soup, is_smooth=is_smooth).light
    return float(
        sum((np.abs(np.diff(image, axis=axis)).max(axis=2) > VIEWPOINT.detail_difference).sum() for axis in (0, 1))
    )


def _dilate(mask: NDArray[np.bool_], radius: int) -> NDArray[np.bool_]:
    """Return the mask grown by `radius` pixels (4-neighbourhood)."""
    for _ in range(radius):
        padded = np.pad(mask, 1)
        mask = padded[1:-1, 1:-1] | padded[:-2, 1:-1] | padded[2:, 1:-1] | padded[1:-1, :-2] | padded[1:-1, 2:]
    return mask


def _downsample(light: Array) -> Pixels:
    """Return samples as pixels: the mean of each block."""
    step = PICTURE.samples
    total: Array = sum((light[y::step, x::step] for y in range(step) for x in range(step)), np.zeros(()))
    return to_srgb(total / step**2)
