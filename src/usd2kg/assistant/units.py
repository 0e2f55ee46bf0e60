"""Units of lengths and masses in questions."""

from usd2kg.knowledge import word_map

__all__ = ["UNIT_SIZES", "UNIT_SYMBOLS"]

UNIT_SIZES = {
    "m": ("m", 1.0),
    "cm": ("m", 0.01),
    "mm": ("m", 0.001),
    "in": ("m", 0.0254),
    "ft": ("m", 0.3048),
    "kg": ("kg", 1.0),
    "g": ("kg", 0.001),
    "lb": ("kg", 0.45359237),
}
"""Symbol → unit of the measures, and the size in it."""
UNIT_SYMBOLS = {**{symbol: symbol for symbol in UNIT_SIZES}, **word_map("assistant", "unit_words")}
"""Unit in a question, in lower case → symbol."""
