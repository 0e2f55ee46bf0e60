"""to_html: record → a summary, a picture and a table as HTML."""

import logging
from base64 import b64encode
from functools import lru_cache
from html import escape

from usd2kg.display.cells import format_cell
from usd2kg.display.views import make_view
from usd2kg.render import draw_thumbnail
from usd2kg.scene import Scene

__all__ = ["to_html"]

logger = logging.getLogger(__name__)

_PICTURE_SIZE = (280, 210)
"""Width and height in pixels: 40 kB of PNG for a furnished room."""


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
        parts.append(f"<table>\n{chr(10).join(rows)}\n</table>")
    if more := view.count - len(view.rows):
        parts.append(f"<p>and {more} more</p>")
    return f"<div>\n{chr(10).join(parts)}\n</div>"


def _row(tag: str, cells: tuple[object, ...]) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(format_cell(cell))}</{tag}>' for cell in cells)}</tr>"


def _picture(scene: Scene) -> bytes | None:
    try:
        return _cached_picture(_ByContent(scene))
    except Exception as error:  # A record has to be shown, whatever drawing its stage raises.
        logger.info("%s: no picture: %s", scene.source, error)
        return None


class _ByContent:
    """A scene, equal to others that look the same; comparing all objects would take long."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._key = (scene.source, scene.content_hash, scene.frame, scene.time)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _ByContent) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)


@lru_cache(maxsize=8)
def _cached_picture(shown: _ByContent) -> bytes | None:
    return draw_thumbnail(shown.scene, _PICTURE_SIZE)
