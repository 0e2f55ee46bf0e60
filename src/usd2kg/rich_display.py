"""RichDisplay: lets a record show itself in a notebook, by the display package."""

from importlib import import_module
from typing import Any

__all__ = ["RichDisplay"]


class RichDisplay:
    """A record that a notebook shows as a summary and a table, and IPython on a terminal as text."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        html: str = _display().to_html(self)
        return html

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        # IPython would take the repr for the text: all that a record holds, which is megabytes for a graph. It asks for
        # the HTML by itself, and not on a terminal.
        return {"text/plain": _display().to_text(self)}


def _display() -> Any:
    # The package knows all records and draws pictures, so it is above them; it is found by name when it is needed.
    return import_module("usd2kg.display")
