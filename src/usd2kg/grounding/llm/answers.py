"""parse_answers: completion → one answer per object. Lenient about the form of the JSON, strict about the class."""

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any, NamedTuple

from usd2kg.errors import OntologyError
from usd2kg.grounding.llm.answer_rows import AnswerRow, read_answer_rows
from usd2kg.grounding.llm.completion import Request
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.prompt_text import fill_template, quote
from usd2kg.grounding.llm.prompts import Batch
from usd2kg.grounding.llm.token_logprobs import TokenLogprobs
from usd2kg.grounding.model import Status
from usd2kg.ontology import ClassIRI, TBox, compact_iri

__all__ = ["Defect", "ParsedAnswer", "parse_answers", "repair_request"]

_REFUSALS = frozenset({"none", "null", "unknown", "n/a"})
"""Class names that count as a refusal unless a class is called so."""


class Defect(StrEnum):
    """Kind of an answer without a class, as distinguished in the study."""

    HALLUCINATED = "hallucinated class"
    """The answer names a class that was not offered."""
    DEGENERATE = "degenerate output"
    """The completion is empty, repeats itself or was truncated before it named a class."""


@dataclass(frozen=True, slots=True)
class ParsedAnswer:
    """The model's answer for one object."""

    class_iri: ClassIRI | None
    """None unless the status is grounded."""
    status: Status
    """Grounded, refused or unreadable."""
    reasoning: str = ""
    """Text that the model wrote before the class; empty if none."""
    problem: str = ""
    """The problem in one sentence with quotes from the completion; empty if there is none."""
    defect: Defect | None = None
    """None for an answer with a class, and for other problems, such as a refusal."""
    logprob: float | None = None
    """Natural log-probability of the class name.

    The sum over the tokens that spell the class in the JSON text, without its quotes, since quotation is a matter of
    format. Tokens that cross its boundaries count in full. None if the server returns no token probabilities, the
    tokens do not spell the text, or the row has no class.
    """


def parse_answers(text: str, batch: Batch, tbox: TBox, tokens: Sequence[tuple[str, float]] = ()) -> list[ParsedAnswer]:
    """Return one answer for each object of the batch, in order.

    Args:
        text: the completion, read by `read_answer_rows`.
        batch: the request and its objects.
        tbox: the classes.
        tokens: text and natural log-probability of each token of the completion; empty if unknown.
    """
    rows, logprobs = read_answer_rows(text, batch.numbers), TokenLogprobs(text, tokens)
    if not rows and not text.strip():
        problem = "the answer was empty"
    else:
        problem = "the answer has no row for it" if rows else "the answer has no readable JSON object"
    missing = ParsedAnswer(None, Status.UNREADABLE, problem=problem)
    return [_read_row(rows[number], batch, tbox, logprobs) if number in rows else missing for number in batch.numbers]


def _read_row(row: AnswerRow, batch: Batch, tbox: TBox, logprobs: TokenLogprobs) -> ParsedAnswer:
    answer = _read_value(row.value, batch, tbox)
    return replace(answer, logprob=logprobs.sum_over(row.class_span)) if row.class_span is not None else answer


def _read_value(row: Any, batch: Batch, tbox: TBox) -> ParsedAnswer:
    reasoning, value = "", row
    if isinstance(row, dict):
        reasoning = row["reasoning"] if isinstance(row.get("reasoning"), str) else ""
        if "class" not in row:
            return ParsedAnswer(None, Status.UNREADABLE, reasoning, "its row has no class")
        value = row["class"]
    if value is None:
        return ParsedAnswer(None, Status.REFUSED, reasoning, "the model named no class")
    if not isinstance(value, str):
        return ParsedAnswer(None, Status.UNREADABLE, reasoning, f"{quote(json.dumps(value))} is not a class name")
    class_iri, problem, defect = _resolve(value.strip(), batch, tbox)
    if class_iri is None and value.strip().casefold() in _REFUSALS:
        return ParsedAnswer(None, Status.REFUSED, reasoning, f"the model named no class but {quote(value)}")
    return ParsedAnswer(class_iri, Status.GROUNDED if class_iri else Status.UNREADABLE, reasoning, problem, defect)


class _Resolution(NamedTuple):
    class_iri: ClassIRI | None
    problem: str = ""
    defect: Defect | None = None


def _resolve(name: str, batch: Batch, tbox: TBox) -> _Resolution:
    """Return the offered class called `name`, or the reason why there is none."""
    if name in batch.classes:
        return _Resolution(batch.classes[name])
    for is_exact in (True, False):
        matches = _match_offered(name, batch, tbox, is_exact=is_exact)
        if len(matches) > 1:
            return _Resolution(None, f"{quote(name)} may mean {' or '.join(matches)}")
        if matches:
            return _Resolution(batch.classes[matches[0]])
    try:
        iri = tbox.resolve(name)
    except OntologyError:
        return _Resolution(None, f"{quote(name)} is not a class of the list", Defect.HALLUCINATED)
    if iri in batch.classes.values():
        return _Resolution(iri)
    return _Resolution(None, f"{quote(name)} is a class, but not one of the list", Defect.HALLUCINATED)


def _match_offered(name: str, batch: Batch, tbox: TBox, *, is_exact: bool) -> list[str]:
    """Return the prompt names of the offered classes whose name, label or IRI is `name`."""
    fold = str if is_exact else str.casefold
    wanted = fold(name.removeprefix("<").removesuffix(">"))
    matches = []
    for offered, iri in batch.classes.items():
        cls = tbox.by_iri[iri]
        if any(fold(known) == wanted for known in (offered, cls.local_name, cls.label, iri, compact_iri(iri))):
            matches.append(offered)
    return matches


def repair_request(batch: Batch, text: str, answers: Sequence[ParsedAnswer]) -> Request:
    """Return a request that repeats the question and lists what was wrong with the first completion.

    Args:
        batch: the request to repeat.
        text: the first completion; its beginning is quoted.
        answers: the answers parsed from it.
    """
    problems = [
        f"object {number}: {answer.problem}"
        for number, answer in zip(batch.numbers, answers, strict=True)
        if answer.problem
    ]
    quoted = quote(text.strip(), LIMITS.max_quoted_answer_characters)
    repair = fill_template("repair", text=quoted, problems="\n".join(problems))
    return replace(batch.request, user=batch.request.user + "\n" + repair)
