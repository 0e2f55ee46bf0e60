"""add_legend: a picture with the legend of its colours to the right."""

import struct

from usd2kg.diagrams.coloring import Coloring
from usd2kg.diagrams.rasterize import to_png
from usd2kg.diagrams.settings import LEGEND, SHAPES, TEXT
from usd2kg.diagrams.svg import Canvas, shorten, text_width

__all__ = ["add_legend"]


def add_legend(png: bytes, coloring: Coloring, title: str) -> bytes:
    """Return a PNG with the picture, unchanged, and a column with its legend; it is higher if the legend needs it.

    Args:
        png: the picture.
        coloring: its colours.
        title: what the colours show.

    Raises:
        OutputError: resvg is not installed, or the system has no font.
    """
    width, height = struct.unpack(">II", png[16:24])
    heading = shorten(title, LEGEND.max_letters)
    rows = [(shorten(e.label, LEGEND.max_letters), str(len(e.prim_paths)), e.color) for e in coloring.legend]
    before = 2 * SHAPES.padding + LEGEND.swatch
    canvas = Canvas()
    canvas.image(png, width, height)
    y = SHAPES.padding + TEXT.label_size
    canvas.text(width + SHAPES.padding, y, heading, bold=True)
    for label, count, color in rows:
        y += SHAPES.row_height
        canvas.rectangle(width + SHAPES.padding, y - LEGEND.swatch + 1, LEGEND.swatch, LEGEND.swatch, color, radius=2)
        canvas.text(width + before, y, label, count)
    widths = [
        text_width(label, TEXT.label_measure) + TEXT.detail_gap + text_width(count, TEXT.detail_measure)
        for label, count, _ in rows
    ]
    column = max(text_width(heading, LEGEND.title_measure) + SHAPES.padding, before + max(widths)) + SHAPES.padding
    return to_png(canvas.document(width + column, max(height, y + SHAPES.padding), title), scale=1)
