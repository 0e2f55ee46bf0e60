"""A table of results: what a question to a graph gives."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import pyoxigraph as ox

__all__ = ["Answer", "Value", "join_answers", "make_answer", "with_columns", "without_columns"]

Value = str | float | int | bool | None
"""A cell of a table."""


@dataclass(frozen=True)
class Answer:
    """A table of results."""

    columns: tuple[str, ...]
    rows: tuple[tuple[str | None, ...], ...]
    """Values as text; None where a row has none."""
    values: tuple[tuple[Value, ...], ...]
    """The same with numbers and truth values as such."""
    sparql: str
    """The query that was run."""


def without_columns(answer: Answer, left_out: set[str]) -> Answer:
    """Return an answer with some of its columns left out."""
    kept = [index for index, column in enumerate(answer.columns) if column not in left_out]
    return replace(
        answer,
        columns=tuple(answer.columns[i] for i in kept),
        rows=tuple(tuple(row[i] for i in kept) for row in answer.rows),
        values=tuple(tuple(row[i] for i in kept) for row in answer.values),
    )


def with_columns(answer: Answer, added: Mapping[str, str]) -> Answer:
    """Return an answer with more columns that are alike in all rows."""
    more = tuple(added.values())
    return replace(
        answer,
        columns=(*answer.columns, *added),
        rows=tuple((*row, *more) for row in answer.rows),
        values=tuple((*row, *more) for row in answer.values),
    )


def join_answers(answers: Sequence[Answer]) -> Answer:
    """Return the rows of several answers to one question, each once."""
    rows = {row: value for answer in answers for row, value in zip(answer.rows, answer.values, strict=True)}
    return replace(answers[0], rows=tuple(rows), values=tuple(rows.values()))


def make_answer(columns: tuple[str, ...], rows: Sequence[tuple[Any, ...]], query: str) -> Answer:
    """Return the rows of terms that a query gave as a table of plain values; None stands for an unbound variable."""
    texts = tuple(tuple(_plain(term) for term in row) for row in rows)
    values = tuple(tuple(_value(term) for term in row) for row in rows)
    return Answer(columns, texts, values, query)


def _value(term: Any) -> Value:
    """Return a term as a JSON value: numbers and truth values as such, all else as text."""
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
