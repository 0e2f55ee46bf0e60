"""to_html: record → a summary, a picture and a table as HTML."""

from base64 import b64encode
from collections.abc import Iterator
from html import escape

from usd2kg.display.cells import format_cell
from usd2kg.display.pictures import PICTURE_SIZE, Picture, draw_picture
from usd2kg.display.views import make_view

__all__ = ["to_html"]


def to_html(record: object) -> str:
    """Return a record as HTML, with all text escaped.

    The picture is left out where the record is too large or cannot be drawn.
    """
    view = make_view(record)
    title, *notes = view.lines
    parts = [f"<p><b>{escape(title)}</b></p>", *(f"<p>{escape(note)}</p>" for note in notes)]
    if view.pictured is not None and (picture := draw_picture(view.pictured)) is not None:
        parts += _picture_lines(picture)
    if view.columns:
        rows = [_row("th", view.columns), *(_row("td", row) for row in view.rows)]
        parts += ["<table>", *rows, "</table>"]
    if more := view.count - len(view.rows):
        parts.append(f"<p>and {more} more</p>")
    return "\n".join(["<div>", *parts, "</div>"])


def _picture_lines(picture: Picture) -> Iterator[str]:
    width, height = PICTURE_SIZE
    source = f"data:image/png;base64,{b64encode(picture.png).decode()}"
    yield f'<img alt="{escape(picture.caption)}" width="{width}" height="{height}" src="{source}">'
    if picture.legend:
        entries = (
            f'<span style="white-space:nowrap"><span style="color:{color}">■</span> '
            f"{escape(format_cell(label))} {count}</span>"
            for color, label, count in picture.legend
        )
        yield f"<p>{' · '.join(entries)}</p>"


def _row(tag: str, cells: tuple[object, ...]) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(format_cell(cell))}</{tag}>' for cell in cells)}</tr>"
