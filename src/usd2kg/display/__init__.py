"""Records as HTML for notebooks, and as text for IPython on a terminal."""

from usd2kg.display.html import to_html
from usd2kg.display.text import to_text
from usd2kg.display.views import View, make_view

__all__ = [
    "View",
    "make_view",
    "to_html",
    "to_text",
]
