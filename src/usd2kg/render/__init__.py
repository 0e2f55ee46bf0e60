"""Pictures of objects and scenes, drawn on the processor: the same stage gives the same bytes each time."""

from usd2kg.render.renderer import Renderer, render_object, render_objects, render_scene

__all__ = [
    "Renderer",
    "render_object",
    "render_objects",
    "render_scene",
]
