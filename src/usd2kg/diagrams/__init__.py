"""SVG and PNG diagrams of a graph: a room as cards, or one object in its surroundings."""

from usd2kg.diagrams.rasterize import to_png
from usd2kg.diagrams.room_cards import draw_room
from usd2kg.diagrams.surroundings import draw_surroundings

__all__ = [
    "draw_room",
    "draw_surroundings",
    "to_png",
]
