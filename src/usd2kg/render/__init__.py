"""Pictures of objects and scenes, rendered deterministically on the CPU."""

from usd2kg.render.box_picture import ColoredBox, draw_boxes
from usd2kg.render.renderer import Renderer, render_object, render_objects, render_scene
from usd2kg.render.thumbnail import draw_stage_thumbnail, draw_thumbnail

__all__ = [
    "ColoredBox",
    "Renderer",
    "draw_boxes",
    "draw_stage_thumbnail",
    "draw_thumbnail",
    "render_object",
    "render_objects",
    "render_scene",
]
