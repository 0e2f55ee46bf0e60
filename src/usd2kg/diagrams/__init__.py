"""Diagrams of a graph: a room as cards, one object in its surroundings; colours and legends of pictures of a scene."""

from usd2kg.diagrams.color_modes import ColorMode, color_scene
from usd2kg.diagrams.coloring import Coloring, LegendEntry, color_by_answer
from usd2kg.diagrams.picture_legend import add_legend
from usd2kg.diagrams.rasterize import to_png
from usd2kg.diagrams.room_cards import draw_room
from usd2kg.diagrams.surroundings import draw_surroundings

__all__ = [
    "ColorMode",
    "Coloring",
    "LegendEntry",
    "add_legend",
    "color_by_answer",
    "color_scene",
    "draw_room",
    "draw_surroundings",
    "to_png",
]
