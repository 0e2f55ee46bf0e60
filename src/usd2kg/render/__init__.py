"""Pictures of objects and scenes, rendered deterministically on the CPU."""

from usd2kg.render.renderer import Renderer, render_object, render_objects, render_scene
from usd2kg.render.thumbnail import draw_thumbnail

__all__ = [
    "Renderer",
    "draw_thumbnail",
    "render_object",
    "render_objects",
    "render_scene",
]
