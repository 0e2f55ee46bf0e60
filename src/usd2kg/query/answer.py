"""Answer: the result table of a query."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import pyoxigraph as ox

from usd2kg.rich_display import RichDisplay

__all__ = ["Answer", "Value", "join_answers", "join_scenes", "make_answer", "with_columns"]

Value = str | float | int | bool | None
"""A cell of a table."""


@dataclass(frozen=True)
class Answer(RichDisplay):
    """The result table of a query."""

    columns: tuple[str, ...]
    rows: tuple[tuple[str | None, ...], ...]
    """Cells as text; None for an unbound variable."""
    values: tuple[tuple[Value, ...], ...]
    """The same cells, with numbers and booleans not converted to text."""
    sparql: str
    """The query that was run."""

    def as_dicts(self) -> list[dict[str, Any]]:
        """Return the rows of values by column."""
        return [dict(zip(self.columns, row, strict=True)) for row in self.values]


def with_columns(answer: Answer, added: Mapping[str, str]) -> Answer:
    """Return an answer with additional columns that have the same value in all rows."""
    more = tuple(added.values())
    return replace(
        answer,
        columns=(*answer.columns, *added),
        rows=tuple((*row, *more) for row in answer.rows),
        values=tuple((*row, *more) for row in answer.values),
    )


def join_answers(answers: Sequence[Answer]) -> Answer:
    """Return the union of several answers to one question, without duplicate rows."""
    rows = {row: value for answer in answers for row, value in zip(answer.rows, answer.values, strict=True)}
    return replace(answers[0], rows=tuple(rows), values=tuple(rows.values()))


def join_scenes(answers: Mapping[str, Answer]) -> Answer:
    """Return the answers about several scenes to one question, each row with its scene in the first column."""
    first = next(iter(answers.values()))
    return replace(
        first,
        columns=("scene", *first.columns),
        rows=tuple((scene, *row) for scene, answer in answers.items() for row in answer.rows),
        values=tuple((scene, *row) for scene, answer in answers.items() for row in answer.values),
    )


def make_answer(columns: tuple[str, ...], rows: Sequence[tuple[Any, ...]], query: str) -> Answer:
    """Return query solutions (rows of terms) as a table of plain values; None is an unbound variable."""
    texts = tuple(tuple(_plain(term) for term in row) for row in rows)
    values = tuple(tuple(_value(term) for term in row) for row in rows)
    return Answer(columns, texts, values, query)


def _value(term: Any) -> Value:
    """Return a term as a JSON value: a number, a boolean, or else text."""
    datatype = term.datatype.value.rpartition("#")[2] if isinstance(term, ox.Literal) else ""
    if datatype in {"double", "float", "decimal"} and math.isfinite(float(term.value)):
        return float(term.value)
    if datatype in {"integer", "int", "long", "nonNegativeInteger"}:
        return int(term.value)
    if datatype == "boolean":
        return str(term.value) in {"true", "1"}
    return _plain(term)


def _plain(term: ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple | None) -> str | None:
    if term is None:
        return None
    return str(term) if isinstance(term, ox.Triple) else term.value
