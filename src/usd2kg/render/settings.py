"""Settings of pictures: light, viewpoint, quality. All were chosen by eye on the demo kitchen and on real scenes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["LIGHTING", "PICTURE", "VIEWPOINT", "LightingSettings", "PictureSettings", "ViewpointSettings"]

Array = NDArray[np.float64]


def _unit(*vector: float) -> Array:
    array = np.array(vector)
    unit: Array = array / np.linalg.norm(array)
    return unit


@dataclass(frozen=True)
class LightingSettings:
    """Light and edge lines. Directions are in camera axes (right, up, forward); intensities scale linear RGB."""

    key_light: Array
    """Direction to the key light: over the viewer's left shoulder."""
    fill_light: Array
    """Direction to the fill light."""
    key_intensity: float = 0.62
    fill_intensity: float = 0.1
    sky: float = 0.45
    """Ambient light on a surface that faces up."""
    ground: float = 0.25
    """Ambient light on a surface that faces down."""
    gloss: float = 0.1
    """Specular reflection of the key light; with the rim light, it gives black plastic and steel a shape."""
    gloss_exponent: float = 30
    rim: float = 0.05
    """Light on surfaces seen at a grazing angle."""
    lift: float = 0.012
    """Light added everywhere, so that black objects do not merge."""
    line: float = 0.42
    """Share of the light left on an edge line."""
    crease_cosine: float = 0.85
    """Neighbouring pixels whose normals differ by more than this cosine are separated by a line."""
    depth_step: float = 0.012
    """Relative second difference of inverse depth above which neighbouring pixels are separated by a line."""
    transparent_alpha: float = 0.35
    """Opacity with which transparent meshes are blended over solid ones."""


@dataclass(frozen=True)
class ViewpointSettings:
    """Where the camera stands. Angles are degrees; azimuth 0 is +x, counter-clockwise seen from above."""

    vertical_view_angle: float = 28
    """A long lens, which keeps verticals nearly parallel."""
    front: float = -90
    """Azimuth of the usual front: +y points to the back, as -z does on a y-up stage."""
    corner_turns: tuple[float, ...] = (-35, 55, 145, 235)
    """Three-quarter views relative to the front; the first is the default."""
    context_turns: tuple[float, ...] = (-35, 35, 80, -80, 125, -125, 170, -170)
    """Views tried for an object in its surroundings, relative to the front."""
    context_elevations: tuple[tuple[float, float], ...] = ((28, 1), (50, 1), (-18, 0.6))
    """(elevation, weight of a visible pixel): a view from below wins only where it shows much more, as for lamps."""
    scene_elevation: float = 40
    object_elevation: float = 24
    flat_object_elevation: float = 42
    flat_object_ratio: float = 0.2
    """Height over width below which an object is seen from higher up."""
    object_gain: float = 1.1
    """Another view of an object must show this many times the detail of the default view."""
    scene_gain: float = 1.2
    context_gain: float = 1.08
    large_share: float = 0.35
    """Share of the extent of its surroundings from which an object is viewed as a room is: cut open, from outside."""
    surroundings: float = 3.0
    """Radius of the surroundings that are drawn, in extents of the object."""
    least_surroundings: float = 0.6
    """Metres."""


@dataclass(frozen=True)
class PictureSettings:
    """Sizes, colours and quality of pictures. Colours are linear RGB."""

    thumbnail_size: tuple[int, int] = (256, 256)
    scene_size: tuple[int, int] = (800, 600)
    largest_side: int = 4096
    """Pixels."""
    samples: int = 2
    """Samples per pixel along each axis."""
    background: tuple[float, float, float] = (0.66, 0.69, 0.72)
    highlight: tuple[float, float, float] = (1.0, 0.33, 0.03)
    occluded_share: float = 0.6
    """Hidden share of an object above which its hidden part is blended in."""
    smooth_angle: float = 42
    """Degrees: faces that meet at a smaller angle share their normals."""
    most_faces_at_point: int = 64
    """A point shared by more faces keeps the faces' own normals: averaging them would take quadratic time."""


LIGHTING = LightingSettings(key_light=_unit(-0.5, 0.75, -0.9), fill_light=_unit(0.9, 0.1, -0.5))
VIEWPOINT = ViewpointSettings()
PICTURE = PictureSettings()
