"""Amounts in questions: numbers with units of lengths and masses."""

import re

from usd2kg.errors import GraphError
from usd2kg.knowledge import word_map

__all__ = ["NUMBER_NAMES", "NUMBER_WORDS", "UNIT_SIZES", "UNIT_SYMBOLS", "is_amount", "read_amount", "read_sides"]

NUMBER_NAMES = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")
NUMBER_WORDS = {word: number for number, word in enumerate(NUMBER_NAMES) if number}

_AMOUNT = re.compile(
    rf"(?P<number>\d*\.?\d+|half an?|half|an?|{'|'.join(NUMBER_WORDS)}) ?(?P<unit>[a-z\"]*)", re.IGNORECASE
)
_AND_A_HALF = re.compile(
    r"(?P<number>\d+) (?:and a half (?P<unit>[a-z]+)|(?P<before>[a-z]+) and a half)", re.IGNORECASE
)
_ARTICLES = {"a": 1.0, "an": 1.0, "half": 0.5, "half a": 0.5, "half an": 0.5}

UNIT_SIZES = {
    "m": ("m", 1.0),
    "cm": ("m", 0.01),
    "mm": ("m", 0.001),
    "in": ("m", 0.0254),
    "ft": ("m", 0.3048),
    "yd": ("m", 0.9144),
    "km": ("m", 1000.0),
    "kg": ("kg", 1.0),
    "g": ("kg", 0.001),
    "t": ("kg", 1000.0),
    "lb": ("kg", 0.45359237),
    "oz": ("kg", 0.028349523125),
}
"""Symbol → unit of the measures, and the size in it."""
UNIT_SYMBOLS = {**{symbol: symbol for symbol in UNIT_SIZES}, **word_map("query", "unit_words")}
"""Unit in a question, in lower case → symbol."""


def is_amount(text: str) -> bool:
    """Return whether a text begins like an amount: with a number in digits or words.

    >>> is_amount("2 kg"), is_amount("two metres"), is_amount("metre"), is_amount("chair")
    (True, True, True, False)
    """
    found = _AMOUNT.fullmatch(_with_number(text))
    return found is not None and (found["number"][-1].isdigit() or found["unit"].lower() in UNIT_SYMBOLS)


def read_amount(text: str) -> tuple[float, str]:
    """Return a quantity in metres or kilograms, and that unit.

    >>> read_amount("40 cm"), read_amount("500 g"), read_amount("two metres")
    ((0.4, 'm'), (0.5, 'kg'), (2.0, 'm'))
    >>> read_amount("three and a half metres"), read_amount("a metre and a half")
    ((3.5, 'm'), (1.5, 'm'))
    """
    found = _AMOUNT.fullmatch(_with_number(text))
    symbol = UNIT_SYMBOLS.get(found["unit"].lower()) if found is not None else None
    if found is None or symbol is None:
        raise GraphError(
            f"{text!r} is not understood as an amount; expected a number with a unit, such as 40 cm or 2 kg"
        )
    unit, size = UNIT_SIZES[symbol]
    number = found["number"].lower()
    count = {**NUMBER_WORDS, **_ARTICLES}.get(number)
    return (float(number) if count is None else count) * size, unit


def _spell_number(text: str) -> str:
    """Return an amount with its first number in digits."""
    first, _, rest = text.partition(" ")
    number = {**NUMBER_WORDS, "a": 1, "an": 1}.get(first.lower())
    return text if number is None or not rest or "half" not in rest.lower() else f"{number} {rest}"


def _with_number(text: str) -> str:
    """Return an amount with its number, which the article of a unit may have been: `a metre`."""
    # Three and a half metres; a metre and a half.
    text = _AND_A_HALF.sub(
        lambda found: f"{found['number']}.5 {found['unit'] or found['before']}", _spell_number(text.strip())
    )
    word = text.lower()
    return f"1 {word}" if word in UNIT_SYMBOLS and len(word) > 2 else text.strip()


def read_sides(text: str) -> tuple[float, float, float]:
    """Return width, depth and height in metres; a unit after the last number holds for all.

    Two sides have no height.

    >>> read_sides("40 by 30 by 20 cm"), read_sides("30 x 30 cm")
    ((0.4, 0.3, 0.2), (0.3, 0.3, 0.0))
    """
    parts = re.split(r" ?(?:by|x|×) ?", text.strip())
    unit = re.sub(r"[\d. ]", "", parts[-1])
    sides = [read_amount(part if re.search(r"[a-z\"]", part) else f"{part} {unit}") for part in parts]
    if len(sides) not in {2, 3} or any(unit != "m" for _, unit in sides):
        raise GraphError(
            f"{text!r} is not understood as a size; expected two or three lengths, such as 40 by 30 by 20 cm"
        )
    width, depth, height = (*(side for side, _ in sides), 0.0)[:3]
    return width, depth, height
