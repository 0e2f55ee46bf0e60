"""Pictures of objects and scenes, rendered deterministically on the CPU."""

from usd2kg.render.renderer import Renderer, render_object, render_objects, render_scene

__all__ = [
    "Renderer",
    "render_object",
    "render_objects",
    "render_scene",
]
