"""to_html: record → a summary, a picture and a table as HTML."""

import logging
from base64 import b64encode
from collections.abc import Hashable
from html import escape

from usd2kg.display.cells import format_cell
from usd2kg.display.views import make_view
from usd2kg.render import draw_thumbnail
from usd2kg.scene import Scene

__all__ = ["to_html"]

logger = logging.getLogger(__name__)

_PICTURE_SIZE = (280, 210)
"""Width and height in pixels: 40 kB of PNG for a furnished room."""
_MAX_KEPT = 8
_pictures: dict[Hashable, bytes | None] = {}
"""What a picture depends on → PNG, or None where there is no picture."""


def to_html(record: object) -> str:
    """Return a record as HTML, with all text escaped.

    The picture is left out where the scene is too large or cannot be drawn.
    """
    view = make_view(record)
    title, *notes = view.lines
    parts = [f"<p><b>{escape(title)}</b></p>", *(f"<p>{escape(note)}</p>" for note in notes)]
    picture = None if view.pictured is None else _picture(view.pictured)
    if picture is not None:
        width, height = _PICTURE_SIZE
        source = f"data:image/png;base64,{b64encode(picture).decode()}"
        parts.append(f'<img alt="the scene" width="{width}" height="{height}" src="{source}">')
    if view.columns:
        rows = [_row("th", view.columns), *(_row("td", row) for row in view.rows)]
        parts += ["<table>", *rows, "</table>"]
    if more := view.count - len(view.rows):
        parts.append(f"<p>and {more} more</p>")
    return "\n".join(["<div>", *parts, "</div>"])


def _row(tag: str, cells: tuple[object, ...]) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(format_cell(cell))}</{tag}>' for cell in cells)}</tr>"


def _picture(scene: Scene) -> bytes | None:
    """Return a picture of a scene; those of the last few are kept, since a notebook shows a scene again and again."""
    key = (scene.source, scene.content_hash, scene.frame, scene.time)
    if key not in _pictures:
        while len(_pictures) >= _MAX_KEPT:
            _pictures.pop(next(iter(_pictures)))
        _pictures[key] = _draw(scene)
    return _pictures[key]


def _draw(scene: Scene) -> bytes | None:
    try:
        return draw_thumbnail(scene, _PICTURE_SIZE)
    except Exception as error:  # A record has to be shown, whatever drawing its stage raises.
        logger.info("%s: no picture: %s", scene.source, error)
        return None
