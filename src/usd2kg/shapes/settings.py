"""Settings of shape descriptors, documented in `knowledge/settings/shapes.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "BOUNDING_BOX",
    "MESH",
    "SHELL",
    "VESSEL",
    "BoundingBoxSettings",
    "ShellSettings",
    "TriangleMeshSettings",
    "VesselSettings",
]


class TriangleMeshSettings(NamedTuple):
    """Tolerances of triangle meshes."""

    weld_distance: float
    same_shape: float
    min_diagonal: float
    noise_factor: float
    max_gap_share: float
    min_thickness: float


class BoundingBoxSettings(NamedTuple):
    """Candidate orientations of the minimum bounding box."""

    min_face_share: float
    max_faces: int
    normal_steps: int


class VesselSettings(NamedTuple):
    """Resolution and limits of the capacity measurement."""

    cells: int
    coarse_factor: int
    min_cells: int
    min_depth: float
    wall_cosine: float
    max_samples: int
    max_rows: int


class ShellSettings(NamedTuple):
    """Division of a surface into boxes."""

    cells: int
    min_cell: float
    max_blocks: int
    max_boxes: int
    max_growth: float
    min_saving: float


MESH = read_settings("shapes", "mesh", TriangleMeshSettings)
BOUNDING_BOX = read_settings("shapes", "bounding_box", BoundingBoxSettings)
SHELL = read_settings("shapes", "shell", ShellSettings)
VESSEL = read_settings("shapes", "vessel", VesselSettings)
