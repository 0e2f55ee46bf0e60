"""Settings of the studio, read from `knowledge/settings/studio.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = [
    "AUDIT",
    "GEOMETRY",
    "PASSWORD_VARIABLE",
    "QUEUE",
    "SERVER",
    "TEXTURES",
    "AuditSettings",
    "GeometrySettings",
    "ReviewQueueSettings",
    "ServerSettings",
    "TextureSettings",
]

PASSWORD_VARIABLE = "USD2KG_STUDIO_PASSWORD"
"""Environment variable with the password of the studio."""


class ReviewQueueSettings(NamedTuple):
    """How groups are named, and how the time for the rest of a queue is estimated."""

    common_share: float
    pace_decisions: int
    longest_pause_s: float
    min_decisions: int


class AuditSettings(NamedTuple):
    """The random sample that measures how often suggestions are right."""

    sample: int
    seed: int


class GeometrySettings(NamedTuple):
    """How much geometry is sent to the page."""

    max_triangles: int
    min_mesh_triangles: int
    chunk_triangles: int
    first_chunk_objects: int
    chunk_objects: int


class TextureSettings(NamedTuple):
    """How images of textures are scaled down, and which are left out."""

    max_side: int
    max_lossless_side: int
    jpeg_quality: int
    max_file_bytes: int
    max_pixels: int
    max_scene_bytes: int


class ServerSettings(NamedTuple):
    """Limits of requests, and when files follow the decisions."""

    max_body_bytes: int
    max_objects_per_decision: int
    max_text: int
    max_label: int
    outputs_delay_s: float
    heartbeat_s: float
    thumbnail_size: tuple[int, int]
    min_password: int


QUEUE = read_settings("studio", "queue", ReviewQueueSettings)
AUDIT = read_settings("studio", "audit", AuditSettings)
GEOMETRY = read_settings("studio", "geometry", GeometrySettings)
TEXTURES = read_settings("studio", "textures", TextureSettings)
SERVER = read_settings("studio", "server", ServerSettings)
