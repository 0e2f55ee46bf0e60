"""SVG 1.1 shapes and escaped text, with upper bounds of text widths."""

import base64
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from xml.sax.saxutils import escape, quoteattr

from usd2kg.diagrams.settings import SHAPES, TEXT

__all__ = ["FONT", "PALETTE", "Canvas", "colors_of", "shorten", "text_width"]

FONT = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"
PALETTE = ("#3b76af", "#d98032", "#4f9a55", "#c05a9e", "#8a63b8", "#2f9c9c", "#b8912a", "#c3504c")
"""Eight distinguishable hues of similar lightness; grey is for the rest."""
_GREY = "#8a8f98"
INK, PALE_INK, PAPER, LINE = "#1d2330", "#5d6675", "#ffffff", "#c3cad6"


def text_width(text: str, size: float) -> float:
    """Return an upper bound of the width of a text in a sans-serif font.

    The fonts of the viewer are unknown, so exact metrics would be wrong.
    """
    return sum(_em(c) for c in text) * size


def _em(c: str) -> float:
    if unicodedata.east_asian_width(c) in "WF":
        return 1.05
    if c in "W@%—…\ufffd":
        return 1.05
    if c in "#&+<=>^~":
        return 0.88
    if c in "MWmw×" or c.isupper():
        return 0.86 if c in "Mmw" else 0.72
    return 0.36 if c in "iljtf.,:;|!'()[] I" else 0.61


def shorten(text: str, limit: int = TEXT.max_label_letters) -> str:
    """Return a text elided in the middle if longer than `limit`; unprintable characters become U+FFFD."""
    text = "".join(c if c.isprintable() else "\ufffd" for c in text)
    return text if len(text) <= limit else f"{text[: limit // 2]}…{text[len(text) - limit + limit // 2 + 1 :]}"


def colors_of(families: Iterable[str]) -> dict[str, str]:
    """Return family → colour in alphabetical order; "other" is last and grey."""
    named = sorted({family for family in families if family != "other"})
    colors = {family: PALETTE[i] if i < len(PALETTE) else _GREY for i, family in enumerate(named)}
    return {**colors, "other": _GREY}


class Canvas:
    """An SVG document under construction."""

    def __init__(self) -> None:
        self._parts: list[str] = []

    def rectangle(
        self,
        x: float,
        y: float,
        width: float,
        height: float,
        fill: str,
        stroke: str = "none",
        radius: float = SHAPES.corner_radius,
    ) -> None:
        """Draw a rectangle with rounded corners."""
        self._parts.append(
            f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" rx="{radius:g}" '
            f'fill="{fill}" stroke="{stroke}"/>'
        )

    def image(self, png: bytes, width: float, height: float) -> None:
        """Draw a PNG in the upper left corner."""
        data = base64.b64encode(png).decode()
        self._parts.append(f'<image width="{width:g}" height="{height:g}" href="data:image/png;base64,{data}"/>')

    def path(self, points: Sequence[tuple[float, float]], stroke: str = LINE, dashed: bool = False) -> None:
        """Draw a polyline."""
        steps = " L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        dash = ' stroke-dasharray="3 3"' if dashed else ""
        self._parts.append(
            f'<path d="M{steps}" fill="none" stroke="{stroke}" stroke-width="{SHAPES.line_width:g}"{dash}/>'
        )

    def dot(self, x: float, y: float, fill: str) -> None:
        """Draw a dot."""
        self._parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{SHAPES.dot_radius:g}" fill="{fill}"/>')

    def text(
        self,
        x: float,
        y: float,
        text: str,
        detail: str = "",
        *,
        size: float = TEXT.label_size,
        bold: bool = False,
        title: str = "",
        fill: str = INK,
        middle: bool = False,
    ) -> None:
        """Draw a text, with a smaller, paler detail after it and `title` as its tooltip."""
        weight = ' font-weight="600"' if bold else ""
        anchor = ' text-anchor="middle"' if middle else ""
        tip = f"<title>{escape(shorten(title, TEXT.max_tooltip_letters))}</title>" if title else ""
        after = ""
        if detail:
            smaller = size - TEXT.detail_size_step
            style = f'dx="{TEXT.detail_gap:g}" font-size="{smaller:g}" font-weight="400" fill="{PALE_INK}"'
            after = f"<tspan {style}>{escape(detail)}</tspan>"
        self._parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size:g}" fill="{fill}"{weight}{anchor}>'
            f"{tip}{escape(text)}{after}</text>"
        )

    def legend(self, x: float, y: float, colors: Mapping[str, str], width: float) -> float:
        """Draw the legend in as many rows as needed; return its height."""
        at, row = x, 0
        for name, color in colors.items():
            needed = text_width(name, TEXT.small_size) + 2 * SHAPES.dot_column
            if at + needed > x + width and at > x:
                at, row = x, row + 1
            middle = y + row * SHAPES.legend_row_height + 8
            self.dot(at + 5, middle, color)
            self.text(at + SHAPES.dot_column, middle + 4, name, size=TEXT.small_size)
            at += needed
        return (row + 1) * SHAPES.legend_row_height

    def document(self, width: float, height: float, title: str) -> str:
        """Return the SVG document."""
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" '
            f'viewBox="0 0 {width:.0f} {height:.0f}" font-family={quoteattr(FONT)}>\n'
            f"<title>{escape(shorten(title, TEXT.max_document_title_letters))}</title>\n"
            f'<rect width="100%" height="100%" fill="#f5f7fa"/>\n' + "\n".join(self._parts) + "\n</svg>\n"
        )
