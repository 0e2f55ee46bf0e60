"""Units: the unit that a question asks for, and the quantities of its answer in that unit."""

import re
from collections.abc import Sequence

from usd2kg.assistant.sentences import number_text
from usd2kg.errors import GraphError
from usd2kg.query.lookup.amounts import UNIT_SIZES, UNIT_SYMBOLS

__all__ = ["Units"]

_SPELLED = "|".join(sorted(map(re.escape, UNIT_SYMBOLS), key=lambda word: (-len(word), word)))
_UNIT = rf"(?P<square>square |sq\.? ?)?(?P<unit>{_SPELLED})(?P<power>2|²|\^2)?"
_END = r"(?=\W*$|[,;.!?]| (?:please|pls)\b)"
_VERB = r"(?:(?:is|are) (?:it |there )?)?"
_MEASURED = r"(?P<rest>tall|high|wide|broad|deep|long|thick|far|apart)\b"
_REWORDED = (
    (re.compile(rf",?\s*\b(?:(?:measured|given|expressed) )?(?:in|as) {_UNIT}{_END}", re.IGNORECASE), ""),
    (re.compile(rf"\bhow many {_UNIT} (?=(?:do|does) .+ weigh\b)", re.IGNORECASE), "how much "),
    (re.compile(rf"\bhow many {_UNIT} {_MEASURED}", re.IGNORECASE), r"how \g<rest>"),
    (re.compile(rf"\bhow many {_UNIT} (?=(?:is|are) .+ (?:from|to)\b)", re.IGNORECASE), "how far "),
    (
        re.compile(rf"\bhow many {_UNIT} {_VERB}(?=(?:between|from)\b)", re.IGNORECASE),
        "distance ",
    ),
)
"""Pattern of a unit, and what the question has in its place without it."""
_AREA = "m²"


class Units:
    """The unit that a question asks for, if any."""

    def __init__(self, text: str) -> None:
        """Read the unit in a question: `how high is the table in inches?`

        Args:
            text: the question.
        """
        self._asked = ""
        self._symbol = ""
        self.question = text
        """The question without the unit."""
        for pattern, words in _REWORDED:
            if found := pattern.search(text):
                self._read(found)
                self.question = f"{text[: found.start()]}{found.expand(words)}{text[found.end() :]}"
                break

    def _read(self, found: re.Match[str]) -> None:
        symbol = UNIT_SYMBOLS[found["unit"].lower()]
        unit, size = UNIT_SIZES[symbol]
        is_square = bool(found["square"] or found["power"])
        self._asked = found[0].strip(" ,")
        self._symbol = f"{symbol}²" if is_square else symbol
        self._unit, self._size = (_AREA, size**2) if is_square else (unit, size)

    @property
    def is_area(self) -> bool:
        """Whether the unit is one of areas."""
        return bool(self._symbol) and self._unit == _AREA

    def text(self, value: float, unit: str) -> str:
        """Return a quantity in the unit that is asked for, else in a suitable one.

        >>> Units("how high is the table in inches?").text(0.75, "m"), Units("how high is it?").text(0.75, "m")
        ('29.5 in', '75 cm')
        """
        if not self._symbol or unit != self._unit:
            return number_text(value, unit)
        amount = value / self._size
        return f"{amount:,.0f} {self._symbol}" if abs(amount) >= 1000 else f"{amount:.3g} {self._symbol}"

    def sides(self, sides: Sequence[float]) -> str:
        """Return the sides of a box in metres, or in the unit that is asked for."""
        size, symbol = (self._size, self._symbol) if self._symbol and self._unit == "m" else (1.0, "m")
        return f"{' × '.join(f'{side / size:.2f}' for side in sides)} {symbol}"

    def check(self, sentence: str) -> None:
        """Check that an answer is in the unit that is asked for.

        Raises:
            GraphError: it has no quantity in that unit.
        """
        if self._symbol and re.search(rf"[\d)] {re.escape(self._symbol)}(?!\w)", sentence) is None:
            raise GraphError(f"{self._asked!r} is not understood: the answer has no quantity in {self._symbol}")
