"""Settings of pictures, documented in `knowledge/settings/render.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "CUTAWAY",
    "LIGHTING",
    "PICTURE",
    "VIEWPOINT",
    "CutawaySettings",
    "LightingSettings",
    "PictureSettings",
    "ViewpointSettings",
]


class LightingSettings(NamedTuple):
    """Light and edge lines."""

    key_light: tuple[float, float, float]
    fill_light: tuple[float, float, float]
    key_intensity: float
    fill_intensity: float
    sky: float
    ground: float
    gloss: float
    gloss_exponent: float
    rim: float
    lift: float
    line: float
    crease_cosine: float
    depth_step: float
    transparent_alpha: float


class ViewpointSettings(NamedTuple):
    """Positions of the camera."""

    vertical_view_angle: float
    front: float
    corner_turns: tuple[float, ...]
    context_turns: tuple[float, ...]
    context_elevations: tuple[float, ...]
    context_weights: tuple[float, ...]
    scene_elevation: float
    object_elevation: float
    flat_object_elevation: float
    flat_object_ratio: float
    object_gain: float
    scene_gain: float
    context_gain: float
    large_share: float
    surroundings: float
    min_surroundings: float
    scene_margin: float
    object_margin: float
    large_padding: float
    context_padding: float
    min_context_padding: float
    preview_size: tuple[int, int, int]
    detail_difference: float


class CutawaySettings(NamedTuple):
    """Geometry removed for a view into a scene."""

    stray_quantile: float
    stray_distance: float
    stray_extent: float
    flat_ratio: float
    ground_ratio: float
    wide_share: float
    ceiling_height: float
    top_height: float
    roof_height: float
    roof_steepness: float
    tall_share: float
    wall_thickness: float
    wall_width: float
    wall_distance: float
    wall_reach: float
    shell_share: float
    shell_depth: float
    shell_rise: float
    room_width: float
    room_height: float


class PictureSettings(NamedTuple):
    """Sizes, colours and quality of pictures."""

    thumbnail_size: tuple[int, int]
    scene_size: tuple[int, int]
    max_side: int
    samples: int
    background: tuple[float, float, float]
    highlight: tuple[float, float, float]
    occluded_share: float
    hidden_alpha: float
    outline_width: int
    outline_light: float
    smooth_angle: float
    max_faces_at_point: int


LIGHTING = read_settings("render", "lighting", LightingSettings)
VIEWPOINT = read_settings("render", "viewpoint", ViewpointSettings)
CUTAWAY = read_settings("render", "cutaway", CutawaySettings)
PICTURE = read_settings("render", "picture", PictureSettings)
