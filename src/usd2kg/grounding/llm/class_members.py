"""Ask a language model which things belong to each class of an ontology: once per ontology, not per object."""

import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, NamedTuple

from usd2kg.errors import GroundingError
from usd2kg.grounding.lexical.alignment.member_rows import ClassMembers
from usd2kg.grounding.llm.answer_rows import read_answer_rows
from usd2kg.grounding.llm.batch_jobs.queue import DeferredError
from usd2kg.grounding.llm.class_lists import list_classes, name_classes
from usd2kg.grounding.llm.completion import Request
from usd2kg.grounding.llm.metered_client import MeteredClient
from usd2kg.grounding.llm.prompt_options import PromptOptions
from usd2kg.grounding.llm.prompt_text import fill_template
from usd2kg.grounding.llm.prompts import object_schema
from usd2kg.grounding.llm.settings import MEMBERS
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["MemberQuestion", "ask_members", "plan_questions"]


@dataclass(frozen=True, slots=True, eq=False)
class MemberQuestion:
    """One prompt."""

    request: Request
    classes: tuple[ClassIRI, ...]
    """The classes to ask about; the first is class "1" in the prompt."""


class _Answer(NamedTuple):
    members: list[ClassMembers]
    problem: str
    """Empty if the answer is complete."""


def plan_questions(tbox: TBox) -> list[MemberQuestion]:
    """Return the prompts about all classes, in the order of the class list."""
    names = name_classes(tbox)
    offered = list_classes(tbox, names, tbox.by_iri, PromptOptions(is_tree=True))
    system = fill_template("members", count=str(MEMBERS.nouns_per_class)) + offered.text
    return [
        MemberQuestion(_make_request(system, [names[iri] for iri in iris]), tuple(iris))
        for iris in _batched(list(offered.classes.values()), MEMBERS.classes_per_prompt)
    ]


def _batched(iris: Sequence[ClassIRI], size: int) -> Iterator[Sequence[ClassIRI]]:
    return (iris[start : start + size] for start in range(0, len(iris), size))


def _make_request(system: str, names: Sequence[str]) -> Request:
    rows = "\n".join(f"{number}. {name}" for number, name in enumerate(names, start=1))
    nouns = {"type": "array", "items": {"type": "string"}}
    row = object_schema({"belongs": nouns, "not": nouns})
    schema = object_schema({str(number): row for number in range(1, len(names) + 1)})
    return Request(system, fill_template("member_question", classes=rows), schema)


def ask_members(
    client: MeteredClient,
    questions: Sequence[MemberQuestion],
    *,
    workers: int,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[list[ClassMembers], list[str]]:
    """Return the answers, and the problems of prompts without a readable answer.

    Args:
        client: the client of the model, with its cache and budget.
        questions: the prompts.
        workers: prompts in flight at the same time.
        progress: called with the number of completed prompts and the total.
    """
    start = time.monotonic()
    client.report.prompts += len(questions)
    found: dict[MemberQuestion, _Answer] = {}
    left = list(questions)
    with ThreadPoolExecutor(max_workers=workers) as pool:
        while left:
            for question, answer in zip(left, pool.map(lambda one: _ask(client, one), left), strict=True):
                if answer is None:
                    continue
                found[question] = answer
                if progress is not None:
                    progress(len(found), len(questions))
            left = [question for question in left if question not in found]
            if left:
                client.submit_deferred()
                client.collect_deferred()
    client.report.seconds += time.monotonic() - start
    answers = [found[question] for question in questions]
    problems = [answer.problem for answer in answers if answer.problem]
    return [one for answer in answers for one in answer.members], problems


def _ask(client: MeteredClient, question: MemberQuestion) -> _Answer | None:
    """Return the answer to a question; None if the prompt is deferred to a batch job."""
    try:
        text = client.complete(question.request).text
    except DeferredError:
        return None
    except GroundingError as error:
        with client.lock:
            client.report.failed += 1
        return _Answer([], str(error))
    numbers = [str(number) for number in range(1, len(question.classes) + 1)]
    rows = read_answer_rows(text, numbers)
    found = [
        ClassMembers(iri, _read_nouns(rows[number].value, "belongs"), _read_nouns(rows[number].value, "not"))
        for number, iri in zip(numbers, question.classes, strict=True)
        if number in rows
    ]
    missing = len(numbers) - len(found)
    return _Answer(found, f"the answer has no row for {missing} of {len(numbers)} classes" if missing else "")


def _read_nouns(row: Any, key: str) -> tuple[str, ...]:
    """Return the distinct nouns of a list in a row; other values are ignored."""
    nouns = row.get(key) if isinstance(row, dict) else None
    texts = (noun.strip().lower() for noun in nouns if isinstance(noun, str)) if isinstance(nouns, list) else ()
    return tuple(dict.fromkeys(text for text in texts if 0 < len(text) <= MEMBERS.max_noun_characters))
