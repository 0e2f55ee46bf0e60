"""The three kinds of picture: an object alone, an object in its surroundings, a scene."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.render.camera import Camera, aim
from usd2kg.render.cutaway import open_room, without_ground, without_strays
from usd2kg.render.raster import rasterise
from usd2kg.render.shade import blur, cast_shadow, draw, to_srgb
from usd2kg.render.soup import Soup

__all__ = ["Size", "picture_in_context", "picture_of_object", "picture_of_scene"]

Array = NDArray[np.float64]
Pixels = NDArray[np.uint8]
Size = tuple[int, int]

_BACKGROUND = np.array([0.66, 0.69, 0.72])
_HIGHLIGHT = np.array([1.0, 0.33, 0.03])
_FINE = 2
"""Samples per pixel each way."""
_FRONT = -90.0
"""Azimuth of the usual front: y points to the back, as z points to the front on a y-up stage."""
_QUARTERS = (-35.0, 55.0, 145.0, 235.0)
"""Three-quarter views, from the front to the right and round; the first is the usual one."""
_LARGE = 0.35
"""Share of the whole surroundings from which on an object is as large as a room."""
_ENOUGH_HIDDEN = 0.6
"""Share of an object from which on what is hidden of it shines through."""
_CLEARLY_MORE = 1.1
"""Another view of an object is taken only where it shows this many times as much."""
_MORE_OF_A_SCENE = 1.2
_MORE_OF_IT_SEEN = 1.08
_VIEWS_IN_CONTEXT = ((28.0, 1.0), (50.0, 1.0), (-18.0, 0.6))
"""Elevations, and what a pixel seen from there is worth: from below only where it helps much, as for lamps."""


def picture_of_object(soup: Soup, size: Size) -> Pixels:
    """Return the object by itself, from the three-quarter view that shows most of it, with its shadow."""
    points = soup.used_points()
    width, depth, height = np.ptp(points.astype(np.float64), axis=0)
    elevation = 42.0 if height < 0.2 * max(width, depth) else 24.0
    views = [aim(points, _FRONT + turn, elevation, size) for turn in _QUARTERS]
    # Doors and knobs are in front, and make more lines than a back does.
    camera = views[
        _first_clearly_best(
            [_detail(view.scaled(96 / max(size)), soup, is_smooth=True) for view in views], _CLEARLY_MORE
        )
    ]
    drawn = draw(camera.scaled(_FINE), soup)
    shadow = cast_shadow(camera, soup, points).repeat(_FINE, axis=0).repeat(_FINE, axis=1)
    ground = _BACKGROUND * (1 - shadow)[..., None]
    return _to_pixels(drawn.over(ground))


def picture_of_scene(soup: Soup, size: Size) -> Pixels:
    """Return the whole scene from a corner above, looked into: without ceiling and near walls."""
    soup = without_strays(soup)
    opened = [open_room(soup, _FRONT + turn) for turn in _QUARTERS]
    views = [
        aim(without_ground(part).used_points(), _FRONT + turn, 40.0, size, margin=0.03)
        for part, turn in zip(opened, _QUARTERS, strict=True)
    ]
    details = [
        _detail(view.scaled(160 / max(size)), part, is_smooth=False) for view, part in zip(views, opened, strict=True)
    ]
    best = _first_clearly_best(details, _MORE_OF_A_SCENE)
    return _to_pixels(draw(views[best].scaled(_FINE), opened[best]).over(_BACKGROUND))


def picture_in_context(soup: Soup, own_meshes: int, size: Size) -> Pixels:
    """Return the object in warm colours among grey surroundings, from where least of it is hidden.

    What is hidden of it all the same (a spoon in a closed drawer) shines through.

    Args:
        soup: the object and all that is near it.
        own_meshes: how many of the meshes, the first ones, are the object's.
        size: width and height in pixels.
    """
    camera, soup = _open_view(soup, own_meshes, size)
    camera = camera.scaled(_FINE)
    is_own = soup.mesh < own_meshes
    gray = soup.colors.astype(np.float64) @ np.array([0.2126, 0.7152, 0.0722])
    warm = 0.35 * soup.colors + (0.25 + 0.6 * gray[:, None]) * _HIGHLIGHT
    muted = 0.1 * soup.colors + 0.55 * gray[:, None] + 0.16
    tinted = soup.recolored(np.where(is_own[:, None], warm, muted))
    drawn = draw(camera, tinted)
    alone = draw(camera, tinted.part(is_own))
    light = drawn.over(_BACKGROUND)
    silhouette = alone.mesh >= 0
    hidden = silhouette & ((drawn.mesh < 0) | (drawn.mesh >= own_meshes))
    if hidden.sum() < _ENOUGH_HIDDEN * silhouette.sum():
        silhouette, hidden = silhouette & ~hidden, np.zeros_like(hidden)
    light[hidden] = 0.5 * light[hidden] + 0.5 * alone.over(_BACKGROUND)[hidden]
    light[(blur(silhouette.astype(np.float64), 1) > 1e-6) & ~silhouette] = 0.75 * _HIGHLIGHT
    return _to_pixels(light)


def _open_view(soup: Soup, own_meshes: int, size: Size) -> tuple[Camera, Soup]:
    """Return the view, of those around the object, in which most of it is seen, and what is drawn in it."""
    points = soup.part(soup.mesh < own_meshes).used_points()
    low, high = points.min(axis=0).astype(np.float64), points.max(axis=0).astype(np.float64)
    extent = float((high - low).max())
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    # What is as large as a room is looked at from outside, with the room opened up.
    is_large = extent > _LARGE * float(np.ptp(soup.used_points(), axis=0).max())
    room = 0.15 * extent if is_large else max(0.6 * extent, 0.1)
    framed = (low - room) + corners * (high - low + 2 * room)
    views, parts, seen = [], [], []
    for elevation, worth in ((40.0, 1.0),) if is_large else _VIEWS_IN_CONTEXT:
        for turn in _QUARTERS if is_large else (-35.0, 35.0, 80.0, -80.0, 125.0, -125.0, 170.0, -170.0):
            view = aim(framed, _FRONT + turn, elevation, size, margin=0.0)
            if is_large:
                part = open_room(soup, _FRONT + turn, own_meshes)
            else:
                # The wall, the fridge and the lamp between the viewer and the surroundings.
                view, part = view.cut_before(framed), soup
            hits = rasterise(view.scaled(72 / max(size)), part.points, part.triangles).triangle
            seen.append(worth * float((part.mesh[hits[hits >= 0]] < own_meshes).sum()))
            views.append(view)
            parts.append(part)
    best = _first_clearly_best(seen, _MORE_OF_IT_SEEN)
    return views[best], parts[best]


def _first_clearly_best(values: list[float], factor: float) -> int:
    """Return the place of the value that is left when a later one must be `factor` times as large to be taken.

    >>> _first_clearly_best([10, 11, 20, 21], 1.3)
    2
    """
    best = 0
    for i, value in enumerate(values):
        if value > values[best] * factor:
            best = i
    return best


def _detail(camera: Camera, soup: Soup, *, is_smooth: bool) -> float:
    """Return how many pixels differ from the one beside or below them, by colour or slope."""
    image = draw(camera, soup, is_smooth=is_smooth).light
    return float(sum((np.abs(np.diff(image, axis=axis)).max(axis=2) > 0.03).sum() for axis in (0, 1)))


def _to_pixels(light: Array) -> Pixels:
    """Return samples as pixels: the mean of each square of them."""
    offsets = [(y, x) for y in range(_FINE) for x in range(_FINE)]
    total: Array = sum((light[y::_FINE, x::_FINE] for y, x in offsets), np.zeros(()))
    return to_srgb(total / len(offsets))
