"""PNG rendering of the diagrams with resvg and the fonts of the system."""

import re
from functools import cache

from usd2kg.diagrams.settings import PNG
from usd2kg.diagrams.svg import FONT
from usd2kg.errors import OutputError

__all__ = ["to_png"]

_SANS_SERIF = (
    "Arial", "DejaVu Sans", "Liberation Sans", "Noto Sans", "Open Sans", "Roboto", "Ubuntu", "Cantarell", "FreeSans",
    "Segoe UI", "Verdana", "Lucida Grande",
)  # fmt: skip
"""Fallbacks for the generic sans-serif family."""
_SIZE = re.compile(r'<svg [^>]*?width="(\d+)" height="(\d+)"')


def to_png(svg: str, scale: float = PNG.scale) -> bytes:
    """Return a diagram of this package as PNG, scaled down if it has too many pixels.

    Raises:
        OutputError: resvg is not installed, or the system has no sans-serif font.
    """
    family = _sans_serif()
    if family is None:
        raise OutputError(
            "PNG: the system has no sans-serif font, so the picture would have no text; install one (on Debian: "
            "apt-get install fonts-dejavu-core), or write SVG, which uses the fonts of the viewer"
        )
    found = _SIZE.match(svg)
    assert found is not None, "the size comes first in the SVG of this package"
    width, height = (int(side) for side in found.groups())
    scale = min(scale, (PNG.max_pixels / max(width * height, 1)) ** 0.5)
    return _draw(svg, family, max(1, round(width * scale)))


def _draw(svg: str, family: str, width: int) -> bytes:
    try:
        import resvg_py  # noqa: PLC0415 - an extra
    except ImportError as error:
        raise OutputError("PNG needs resvg: pip install 'usd2kg[pictures]', or write SVG") from error
    return bytes(resvg_py.svg_to_bytes(svg_string=svg, width=width, sans_serif_family=family))


@cache
def _sans_serif() -> str | None:
    """Return the first installed sans-serif family, or None.

    resvg omits text without an error if the font is missing, so each family is probed.
    """
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="20" height="20" font-family="{FONT}">'
    for family in _SANS_SERIF:
        drawn, empty = (_draw(f'{head}<text y="16">{text}</text></svg>', family, 20) for text in ("M", ""))
        if drawn != empty:
            return family
    return None
