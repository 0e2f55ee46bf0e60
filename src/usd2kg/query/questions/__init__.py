"""Ready questions for robot tasks: parameterised SPARQL, one file each.

A file begins with comments: `# id:`, `# question:` with the parameters in braces, `# parameter: NAME | KIND |
DEFAULT` for each parameter, `# candidates: DISTANCE | FROM` if only objects within a distance of an object or
position can be an answer, `# example: PATTERN`, and `# note:`. A kind is `object`, `class`, `position`, or the unit
of a number: `m`, `kg` or `share`. In the query, the parameter is the variable `?the_NAME`, outside SELECT. Values are
bound as terms in SPARQL's syntax, never inserted as text. The `?o` of the pattern is an object to ask about, the
better the more `?x` it has; a graph without a match has no example of the question.
"""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import pyoxigraph as ox

from usd2kg.errors import GraphError

__all__ = [
    "Parameter",
    "Question",
    "find_question",
    "list_questions",
    "parse_number",
]

_UNITS: dict[str, dict[str, float]] = {
    "m": {"m": 1.0, "cm": 0.01, "mm": 0.001},
    "kg": {"kg": 1.0, "g": 0.001},
    "share": {"": 1.0, "%": 0.01},
}
"""Unit of a parameter → accepted units → factor to the unit of the parameter."""


@dataclass(frozen=True)
class Parameter:
    """A parameter of a question."""

    name: str
    kind: str
    """`object`, `class`, `position` ("x y z", metres), or the unit of a number: m, kg, share."""
    default: str | None
    """None if the parameter is required."""

    @property
    def variable(self) -> str:
        """Name of the variable in the query."""
        return f"the_{self.name}"


@dataclass(frozen=True)
class Question:
    """A ready question."""

    id: str
    text: str
    """The question in English, with the parameters in braces."""
    parameters: tuple[Parameter, ...]
    note: str
    """Method and limits of the answer; may be empty."""
    sparql: str
    candidates: tuple[str, str] | None = None
    """Names of the parameters that limit the answer: all objects `?o` are within this distance of this object or
    position. None if other objects can be an answer."""
    example: str = ""
    """SPARQL pattern that a graph has to match for an example of the question; its `?o` is the object to ask about.
    Empty if any object will do."""

    def bind(
        self,
        terms: Mapping[Parameter, Sequence[ox.NamedNode | ox.Literal]],
        candidates: Iterable[ox.NamedNode] | None = None,
    ) -> str:
        """Return the query with terms in place of each parameter, without the comments of its file.

        Args:
            terms: the values; several for a class, which stands in VALUES, else one.
            candidates: the only objects that can be an answer; None for all.
        """
        written = {parameter.variable: " ".join(map(str, values)) for parameter, values in terms.items()}
        query = re.sub(r"\?(the_[a-z]+)", lambda found: written.get(found[1], found[0]), self.sparql)
        if candidates is None:
            return query
        return query.replace("WHERE {", f"WHERE {{\n  VALUES ?o {{ {' '.join(map(str, candidates))} }}", 1)

    def filled_text(self, given: Mapping[str, str]) -> str:
        """Return the question with values in place of its parameters, the defaults for those that are not given."""
        units = {parameter.name: f" {parameter.kind}" for parameter in self.parameters if parameter.kind in {"m", "kg"}}

        def value(found: re.Match[str]) -> str:
            parameter = next(one for one in self.parameters if one.name == found[1])
            if (known := given.get(parameter.name)) is not None:
                return known
            return found[0] if parameter.default is None else f"{parameter.default}{units.get(parameter.name, '')}"

        return re.sub(r"\{([a-z_]+)\}", value, self.text)

    def fill(self, given: Mapping[str, str]) -> dict[Parameter, str]:
        """Return parameter → value as text, with defaults for omitted parameters.

        Raises:
            GraphError: a parameter is unknown, or one without a default is missing.
        """
        names = [parameter.name for parameter in self.parameters]
        for name in given:
            if name not in names:
                expected = f"expected {', '.join(names)}" if names else "expected none"
                raise GraphError(f"question {self.id}: has no parameter {name!r}; {expected}")
        values = {p: given.get(p.name, p.default) for p in self.parameters}
        missing = [p for p, value in values.items() if value is None]
        if missing:
            wanted = " ".join(f"--with {p.name}={p.kind.upper()}" for p in missing)
            raise GraphError(f"question {self.id} ({self.text}) needs {wanted}")
        return {p: value for p, value in values.items() if value is not None}


@cache
def list_questions() -> tuple[Question, ...]:
    """Return all questions, by id."""
    folder = files("usd2kg.query.questions")
    found = [_parse(item.read_text("utf-8")) for item in folder.iterdir() if item.name.endswith(".rq")]
    return tuple(sorted(found, key=lambda question: question.id))


def find_question(question_id: str) -> Question:
    """Return a question by its id.

    Raises:
        GraphError: the id is unknown.
    """
    by_id = {question.id: question for question in list_questions()}
    if question_id not in by_id:
        raise GraphError(f"question {question_id!r} is unknown; expected one of {', '.join(by_id)}")
    return by_id[question_id]


def parse_number(text: str, unit: str) -> float:
    """Return a number, written with or without a unit, in the unit of the parameter.

    >>> parse_number("50 cm", "m"), parse_number("0.5", "m"), parse_number("80 %", "share")
    (0.5, 0.5, 0.8)

    Raises:
        GraphError: the text is not a finite number, or has another unit.
    """
    found = re.fullmatch(r"([-+]?[0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]+)?)\s*([a-z%]*)", text.strip())
    factor = _UNITS[unit].get(found.group(2) or ("" if unit == "share" else unit)) if found else None
    value = float(found.group(1)) * factor if found and factor is not None else math.inf
    if not math.isfinite(value):
        units = ", ".join(name for name in _UNITS[unit] if name)
        raise GraphError(f"{text!r} is not a quantity; expected a number, without a unit or with one of {units}")
    return value


def _parse(text: str) -> Question:
    head: dict[str, list[str]] = {}
    for line in text.splitlines():
        found = re.fullmatch(r"# (id|question|parameter|candidates|example|note): (.+)", line)
        if found:
            head.setdefault(found.group(1), []).append(found.group(2))
    parameters = tuple(_parse_parameter(line) for line in head.get("parameter", ()))
    distance, _, origin = "".join(head.get("candidates", ())).partition(" | ")
    candidates = (distance, origin) if origin else None
    query = "\n".join(line for line in text.splitlines() if not line.startswith("# "))
    note, example = (" ".join(head.get(key, ())) for key in ("note", "example"))
    return Question(head["id"][0], head["question"][0], parameters, note, query, candidates, example)


def _parse_parameter(line: str) -> Parameter:
    name, kind, *default = (part.strip() for part in line.split("|"))
    return Parameter(name, kind, default[0] if default else None)
