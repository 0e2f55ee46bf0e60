"""Settings of reading a stage, documented in `knowledge/settings/scene.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "EXTENTS",
    "JOINTS",
    "LABELS",
    "LEVELS",
    "LIMITS",
    "MAX_COORDINATE",
    "MESHES",
    "ROBOTS",
    "SANITY",
    "SETS",
    "SOLIDS",
    "SURFACES",
    "TEXTS",
    "UNNAMED",
    "ExtentSettings",
    "JointSettings",
    "LabelSettings",
    "LevelSettings",
    "LimitSettings",
    "MeshSettings",
    "RobotSettings",
    "SanitySettings",
    "SetSettings",
    "SolidSettings",
    "SurfaceSettings",
    "TextSettings",
    "UnnamedSettings",
]

MAX_COORDINATE = 1e30
"""OpenUSD marks empty ranges, infinite planes and unlimited joints with numbers of this magnitude or larger."""


class LimitSettings(NamedTuple):
    """Limits on evidence, messages, stage units and the number of prims."""

    max_prims: int
    max_coincident: int
    coincident_distance: float
    max_part_boxes: int
    max_part_labels: int
    max_texts: int
    max_text_length: int
    max_message_length: int
    max_openusd_message: int
    max_openusd_text: int
    same_message_length: int
    min_unit: float
    max_unit: float


class SolidSettings(NamedTuple):
    """Tessellation of round solids."""

    segments: int
    box_segments: int


class MeshSettings(NamedTuple):
    """Limits on rendering."""

    max_display_colors: int
    max_copies: int
    max_copied_triangles: int
    max_instancer_depth: int


class LevelSettings(NamedTuple):
    """Support levels within meshes."""

    margin: float
    min_overlap_ratio: float
    min_normal_z: float
    max_step: float
    max_bulge: float
    min_footprint_share: float
    min_filled_share: float
    max_points: int
    max_levels: int


class SurfaceSettings(NamedTuple):
    """Surfaces that are kept for the spatial relations."""

    reach: float
    min_shell_side: float
    max_gprims: int
    max_points: int
    max_total_points: int


class SetSettings(NamedTuple):
    """Which prims hold several objects; lengths are metres."""

    min_objects: int
    max_gap: float
    max_gap_share: float
    min_room: float


class ExtentSettings(NamedTuple):
    """Comparison of authored extents with points."""

    min_difference: float
    max_isolated: int


class UnnamedSettings(NamedTuple):
    """Pieces without meaningful names."""

    max_extent: float
    max_gap: float
    max_pieces: int


class RobotSettings(NamedTuple):
    """Recognition of robot arms."""

    min_turning_joints: int


class JointSettings(NamedTuple):
    """Directions of joint axes."""

    max_axis_angle: float


class LabelSettings(NamedTuple):
    """Checks of labels."""

    min_similarity: float


class TextSettings(NamedTuple):
    """Free text in attributes and metadata."""

    min_word_share: float


class SanitySettings(NamedTuple):
    """Checks of the extent and the names of a scene."""

    min_objects: int
    min_extent: float
    max_extent: float
    far_factor: float
    min_far_distance: float
    min_unnamed: int
    min_unnamed_share: float


LIMITS = read_settings("scene", "limits", LimitSettings)
SOLIDS = read_settings("scene", "solids", SolidSettings)
MESHES = read_settings("scene", "meshes", MeshSettings)
LEVELS = read_settings("scene", "levels", LevelSettings)
SURFACES = read_settings("scene", "surfaces", SurfaceSettings)
SETS = read_settings("scene", "sets", SetSettings)
EXTENTS = read_settings("scene", "extents", ExtentSettings)
UNNAMED = read_settings("scene", "unnamed", UnnamedSettings)
ROBOTS = read_settings("scene", "robots", RobotSettings)
JOINTS = read_settings("scene", "joints", JointSettings)
LABELS = read_settings("scene", "labels", LabelSettings)
TEXTS = read_settings("scene", "texts", TextSettings)
SANITY = read_settings("scene", "sanity", SanitySettings)
