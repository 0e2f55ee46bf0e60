"""From a model's text to classes: strict about what is a class, tolerant of how it is written."""

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

from usd2kg.errors import OntologyError
from usd2kg.grounding.llm.answer_rows import AnswerRow, read_answer_rows
from usd2kg.grounding.llm.completion import Request
from usd2kg.grounding.llm.prompt_text import fill_template, quote
from usd2kg.grounding.llm.prompts import Batch
from usd2kg.grounding.llm.token_logprobs import TokenLogprobs
from usd2kg.grounding.model import Status
from usd2kg.ontology import ClassIRI, TBox, compact_iri

__all__ = ["Answer", "is_degenerate", "parse_answers", "repair_request"]

_REFUSALS = frozenset({"none", "null", "unknown", "n/a"})
_MOST_QUOTED = 400
_SHORTEST_LOOP = 400
"""Characters at the end that must be of a loop."""
_TURNS = 4
"""Times that a fragment stands in a loop at least."""
_PERIOD_SCALES = (100, 400, 1600)
_MOST_FRAGMENTS = 3
_FRAGMENT_ENDS = (r"[\n.!?]+", r"[\n,;]+")
"""Ends of sentences, and of items."""
_GROWING = 12
_WINDOW = 8000


@dataclass(frozen=True, slots=True)
class Answer:
    """What a model said of one object."""

    class_iri: ClassIRI | None
    """None unless the status is grounded."""
    status: Status
    """Grounded, refused or unreadable."""
    reasoning: str = ""
    """What it wrote before the class, empty if nothing."""
    problem: str = ""
    """One sentence on what is wrong; empty where nothing is. Texts of the model are quoted in it."""
    logprob: float | None = None
    """Natural logarithm of the probability that the model gave to the name of its class, letter by letter.

    That is the sum over the tokens that spell the class in the JSON text, without its quotes: how it is quoted and what
    follows are choices of form. Tokens that reach over its ends count whole. None where the server tells no token
    probabilities, they do not join up to the text, or the row has no class.
    """


def parse_answers(text: str, batch: Batch, tbox: TBox, tokens: Sequence[tuple[str, float]] = ()) -> list[Answer]:
    """Return one answer for each object of the batch, in order.

    Read are a JSON object, alone, fenced or after prose, and the whole rows of one that breaks off. Of several JSON
    objects the last of those with most rows counts.

    Args:
        text: what the model said.
        batch: what it was asked.
        tbox: the classes.
        tokens: text and natural logarithm of the probability of each token of the text; empty where nobody told.
    """
    rows, sums = read_answer_rows(text, batch.numbers), TokenLogprobs(text, tokens)
    if not rows and not text.strip():
        problem = "the answer was empty"
    else:
        problem = "the answer has no row for it" if rows else "the answer has no readable JSON object"
    missing = Answer(None, Status.UNREADABLE, problem=problem)
    return [_read_row(rows[number], batch, tbox, sums) if number in rows else missing for number in batch.numbers]


def _read_row(row: AnswerRow, batch: Batch, tbox: TBox, sums: TokenLogprobs) -> Answer:
    answer = _read_value(row.value, batch, tbox)
    return replace(answer, logprob=sums.logprob(row.class_span)) if row.class_span is not None else answer


def _read_value(row: Any, batch: Batch, tbox: TBox) -> Answer:
    reasoning, value = "", row
    if isinstance(row, dict):
        reasoning = row["reasoning"] if isinstance(row.get("reasoning"), str) else ""
        if "class" not in row:
            return Answer(None, Status.UNREADABLE, reasoning, "its row has no class")
        value = row["class"]
    if value is None:
        return Answer(None, Status.REFUSED, reasoning, "the model named no class")
    if not isinstance(value, str):
        return Answer(None, Status.UNREADABLE, reasoning, f"{quote(json.dumps(value))} is no name of a class")
    class_iri, problem = _resolve(value.strip(), batch, tbox)
    if class_iri is None and value.strip().casefold() in _REFUSALS:
        return Answer(None, Status.REFUSED, reasoning, f"the model named no class but {quote(value)}")
    return Answer(class_iri, Status.GROUNDED if class_iri else Status.UNREADABLE, reasoning, problem)


def _resolve(name: str, batch: Batch, tbox: TBox) -> tuple[ClassIRI | None, str]:
    """Return the class that goes by a name, else None and why."""
    if name in batch.classes:
        return batch.classes[name], ""
    for is_exact in (True, False):
        meant = _meant(name, batch, tbox, is_exact=is_exact)
        if len(meant) > 1:
            return None, f"{quote(name)} may mean {' or '.join(meant)}"
        if meant:
            return batch.classes[meant[0]], ""
    try:
        iri = tbox.resolve(name)
    except OntologyError:
        return None, f"{quote(name)} is no class of the list"
    if iri in batch.classes.values():
        return iri, ""
    return None, f"{quote(name)} is a class, but not one of the list"


def _meant(name: str, batch: Batch, tbox: TBox, *, is_exact: bool) -> list[str]:
    """Return the names, in the prompt, of the offered classes that someone may call so."""
    fold = str if is_exact else str.casefold
    wanted = fold(name.removeprefix("<").removesuffix(">"))
    found = []
    for offered, iri in batch.classes.items():
        cls = tbox.by_iri[iri]
        if any(fold(known) == wanted for known in (offered, cls.local_name, cls.label, iri, compact_iri(iri))):
            found.append(offered)
    return found


def repair_request(batch: Batch, text: str, answers: Sequence[Answer]) -> Request:
    """Return the request that asks about the same objects once more and tells what was wrong with the answer.

    Args:
        batch: what was asked.
        text: what the model said; its beginning is quoted.
        answers: what was read from it.
    """
    problems = [
        f"object {number}: {answer.problem}"
        for number, answer in zip(batch.numbers, answers, strict=True)
        if answer.problem
    ]
    told = fill_template("repair", text=quote(text.strip(), _MOST_QUOTED), problems="\n".join(problems))
    return replace(batch.request, user=batch.request.user + "\n" + told)


def is_degenerate(text: str) -> bool:
    """Return whether a text, maybe not at its end yet, is empty or ends in a loop or in ever longer fragments.

    A loop is one fragment, or a mix of up to three, over 400 characters or more and four times each or more. Rows
    for many objects are none, as each has another number. A text that is still to start is empty, too.
    """
    tail = text[-_WINDOW:]
    if not text.strip() or _has_period(tail) or _is_growing(tail):
        return True
    return any(_has_few_fragments(re.split(ends, tail)) for ends in _FRAGMENT_ENDS)


def _has_period(tail: str) -> bool:
    for scale in _PERIOD_SCALES:
        # The nearest earlier place of the last characters is one period away, for periods up to their length.
        period = len(tail) - scale - tail.rfind(tail[-scale:], 0, len(tail) - 1)
        looped = max(_SHORTEST_LOOP, _TURNS * period)
        if 0 < period <= scale and len(tail) >= looped and tail[-looped:-period] == tail[period - looped :]:
            return True
    return False


def _has_few_fragments(pieces: list[str]) -> bool:
    """Return whether the last whole pieces are a few, over and over, in whatever order."""
    fragments: set[str] = set()
    length = count = 0
    # The first and the last may be cut.
    for piece in reversed(pieces[1:-1]):
        fragments.add(piece)
        if len(fragments) > _MOST_FRAGMENTS:
            return False
        length, count = length + len(piece) + 1, count + 1
        if length >= _SHORTEST_LOOP and count >= _TURNS * len(fragments):
            return True
    return False


def _is_growing(tail: str) -> bool:
    """Return whether it ends in words or lines each longer than the one before, or in a word without an end."""
    if len(tail) >= _SHORTEST_LOOP and re.fullmatch(r"\w+", tail[-_SHORTEST_LOOP:]):
        return True
    # The last may be cut.
    words = re.split(r"[\s,;]+", tail)[-_GROWING - 1 : -1]
    if len(words) == _GROWING and all(len(one) < len(other) for one, other in pairwise(words)):
        return True
    lines = tail.split("\n")[-_GROWING - 1 : -1]
    return len(lines) == _GROWING and all(other.startswith(one) and one != other for one, other in pairwise(lines))
