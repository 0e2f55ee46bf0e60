"""Settings of the diagrams, from `knowledge/settings/diagrams.toml` and `coloring.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = ["COLORS", "CONFIDENCE", "LEGEND", "PNG", "ROOM", "SHAPES", "SURROUNDINGS", "TEXT"]


class _TextSettings(NamedTuple):
    """Section `text`."""

    title_size: float
    label_size: float
    small_size: float
    object_size: float
    object_detail_size: float
    detail_size_step: float
    detail_gap: float
    label_measure: float
    detail_measure: float
    baseline_drop: float
    max_label_letters: int
    max_object_letters: int
    max_title_letters: int
    max_tooltip_letters: int
    max_document_title_letters: int
    max_group_letters: int


class _ShapeSettings(NamedTuple):
    """Section `shapes`."""

    row_height: float
    indent: float
    padding: float
    dot_radius: float
    dot_column: float
    legend_row_height: float
    corner_radius: float
    line_width: float


class _RoomSettings(NamedTuple):
    """Section `room`."""

    gap: float
    aspect_ratio: float
    min_ground_share: float


class _SurroundingsSettings(NamedTuple):
    """Section `surroundings`."""

    gap: float
    panel_gap: float
    margin: float
    title_height: float
    object_height: float
    object_padding: float
    max_lines: int
    max_distance_m: float


class _PngSettings(NamedTuple):
    """Section `png`."""

    scale: float
    max_pixels: float


class _PaletteSettings(NamedTuple):
    """Section `palette` of `coloring.toml`."""

    categories: tuple[str, ...]
    rest: str
    answer: str


class _ConfidenceSettings(NamedTuple):
    """Section `confidence` of `coloring.toml`."""

    lower_bounds: tuple[float, ...]
    colors: tuple[str, ...]


class _LegendSettings(NamedTuple):
    """Section `legend` of `coloring.toml`."""

    swatch: float
    title_measure: float
    max_letters: int


TEXT = read_settings("diagrams", "text", _TextSettings)
SHAPES = read_settings("diagrams", "shapes", _ShapeSettings)
ROOM = read_settings("diagrams", "room", _RoomSettings)
SURROUNDINGS = read_settings("diagrams", "surroundings", _SurroundingsSettings)
PNG = read_settings("diagrams", "png", _PngSettings)
COLORS = read_settings("coloring", "palette", _PaletteSettings)
CONFIDENCE = read_settings("coloring", "confidence", _ConfidenceSettings)
LEGEND = read_settings("coloring", "legend", _LegendSettings)
