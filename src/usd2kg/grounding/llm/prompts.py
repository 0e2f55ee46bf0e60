"""build_requests: object views × TBox → the prompts of the study's strategies. Pure functions.

Names, labels and comments are untrusted. Each is written as a JSON string on one line, inside a block that the
instructions declare as data, and objects are identified by numbers. So a name can end neither its row nor the block.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.llm.class_lists import list_classes, name_classes
from usd2kg.grounding.llm.commands import commanding_texts
from usd2kg.grounding.llm.completion import Request
from usd2kg.grounding.llm.descriptions import describe_object
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompt_text import fill_template, read_template
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["Batch", "Example", "ObjectPictures", "build_requests", "object_schema"]


@dataclass(frozen=True, slots=True)
class Batch:
    """One request with the objects and classes that it is about."""

    request: Request
    indices: tuple[int, ...]
    """Indices of the objects in `views`; the first is object "1" in the prompt."""
    classes: Mapping[str, ClassIRI]
    """Name in the prompt → class, for all offered classes in the order of the prompt."""

    @property
    def numbers(self) -> tuple[str, ...]:
        """The numbers that identify the objects in prompt and answer."""
        return tuple(str(number) for number in range(1, len(self.indices) + 1))


@dataclass(frozen=True, slots=True)
class Example:
    """An object whose class a person decided, shown to the model as an example."""

    view: ObjectView
    class_iri: ClassIRI


class ObjectPictures(NamedTuple):
    """The PNG pictures of an object."""

    alone: bytes
    in_place: bytes
    """The object in warm colours in its grey surroundings."""


def build_requests(
    views: Sequence[ObjectView],
    tbox: TBox,
    options: PromptOptions,
    candidates: Sequence[Sequence[ClassIRI]] | None = None,
    *,
    examples: Sequence[Example] = (),
    pictures: Mapping[int, ObjectPictures] | None = None,
    rows: Sequence[Sequence[str]] | None = None,
) -> list[Batch]:
    """Return the requests about all views, grouped by strategy and otherwise in order.

    Args:
        views: the objects.
        tbox: the classes.
        options: strategy and format of the prompts.
        candidates: the classes to offer for each view; the roots for an empty list. A user prompt lists the classes of
            all its objects, so that system prompts stay equal. None offers the whole TBox in the system prompt, which
            servers can cache.
        examples: objects of the scene with known classes, shown in the system prompt unless their texts may command the
            model.
        pictures: index in `views` → the pictures that are sent with the prompt about that object.
        rows: the lines about each view; None for those of `describe_object`.
    """
    by_strategy: dict[Strategy, list[int]] = {}
    for index, view in enumerate(views):
        by_strategy.setdefault(options.strategy.for_name(view.name, is_thinking=options.is_thinking), []).append(index)
    batches = []
    for strategy, members in sorted(by_strategy.items()):
        writer = _PromptWriter(tbox, replace(options, strategy=strategy), examples, offers_all=candidates is None)
        for indices in _split(members, views, options):
            offered = [candidates[index] for index in indices] if candidates is not None else []
            shown = [(pictures or {}).get(index) for index in indices]
            lines = [rows[index] if rows is not None else writer.describe(views[index]) for index in indices]
            batches.append(writer.write_batch(indices, lines, offered, shown))
    return batches


def _split(members: Sequence[int], views: Sequence[ObjectView], options: PromptOptions) -> Iterator[tuple[int, ...]]:
    """Yield the objects of each prompt; an object whose texts may command the model gets its own prompt."""
    is_alone = {i for i in members if commanding_texts(views[i], has_more_evidence=options.has_more_evidence)}
    together = [index for index in members if index not in is_alone]
    for start in range(0, len(together), options.objects_per_prompt):
        yield tuple(together[start : start + options.objects_per_prompt])
    yield from ((index,) for index in members if index in is_alone)


class _PromptWriter:
    """Writes the prompts of one strategy, which share their system prompt."""

    def __init__(self, tbox: TBox, options: PromptOptions, examples: Sequence[Example], *, offers_all: bool) -> None:
        self._tbox = tbox
        self._options = options
        self._names = name_classes(tbox)
        # The system prompt is part of all prompts, so no text in it may command the model.
        self._examples = [
            one for one in examples if not commanding_texts(one.view, has_more_evidence=options.has_more_evidence)
        ]
        self._all_classes = list_classes(tbox, self._names, tbox.by_iri, options) if offers_all else None
        strategy = read_template(f"strategy_{options.strategy}").template
        parts = [fill_template("system", strategy=strategy)]
        if self._all_classes is not None:
            parts.append(self._all_classes.text)
        if self._examples:
            parts.append(fill_template("examples", examples="\n\n".join(self._example_rows())))
        self._system = "\n".join(parts)

    def _example_rows(self) -> Iterator[str]:
        for number, example in enumerate(self._examples, start=1):
            rows = describe_object(example.view, self._options)
            yield "\n".join([f"example {number}", *rows, f"class: {self._names[example.class_iri]}"])

    def describe(self, view: ObjectView) -> list[str]:
        """Return the lines about one object."""
        return list(describe_object(view, self._options))

    def write_batch(
        self,
        indices: tuple[int, ...],
        lines: Sequence[Sequence[str]],
        candidates: Sequence[Sequence[ClassIRI]],
        pictures: Sequence[ObjectPictures | None],
    ) -> Batch:
        """Return the request about some objects with the lines about them, candidate classes and pictures."""
        user, offer = "", self._all_classes
        if offer is None:
            offered = {iri: None for row in candidates for iri in row or self._tbox.roots}
            offered |= dict.fromkeys(example.class_iri for example in self._examples)
            offer = list_classes(self._tbox, self._names, offered, self._options)
            user = offer.text + "\n"
        user += _number_objects(lines, pictures)
        options = self._options
        request = Request(
            system=self._system,
            user=user,
            schema=_answer_schema(len(indices), list(offer.classes), options.strategy),
            max_tokens=options.max_tokens,
            temperature=options.temperature,
            is_thinking=options.is_thinking,
            images=tuple(image for pair in pictures if pair is not None for image in pair),
        )
        return Batch(request, indices, offer.classes)


def _number_objects(lines: Sequence[Sequence[str]], pictures: Sequence[ObjectPictures | None]) -> str:
    rows = []
    shown = 0
    for number, (known, pair) in enumerate(zip(lines, pictures, strict=True), start=1):
        row = [f"object {number}", *(known or ["nothing is known of it"])]
        if pair is not None:
            row.append(f"pictures: image {shown + 1} (alone), image {shown + 2} (coloured, in its grey surroundings)")
            shown += len(pair)
        rows.append("\n".join(row))
    numbers = ", ".join(str(number) for number in range(1, len(lines) + 1))
    return fill_template("objects", objects="\n\n".join(rows), numbers=numbers)


def _answer_schema(count: int, names: list[str], strategy: Strategy) -> dict[str, Any]:
    properties: dict[str, Any] = {"class": {"type": "string", "enum": names}}
    if strategy is Strategy.CHAIN_OF_THOUGHT:
        # First, since models write properties in the order of the schema.
        properties = {"reasoning": {"type": "string"}} | properties
    return object_schema({str(number): object_schema(properties) for number in range(1, count + 1)})


def object_schema(properties: Mapping[str, Any]) -> dict[str, Any]:
    """Return the JSON schema of an object with these properties and no others."""
    return {"type": "object", "properties": properties, "required": list(properties), "additionalProperties": False}
