"""The prompts of the study's strategies: pure functions of what is seen of the objects, the TBox and options.

Names, labels and comments come from strangers. Each is written as a JSON string on one line, inside a block that the
instructions declare to be data, and objects go by numbers, so that a name can neither end its row nor the block.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.llm.class_lists import list_classes, name_classes
from usd2kg.grounding.llm.completion import Request
from usd2kg.grounding.llm.descriptions import describe
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompt_text import fill_template, read_template
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["Batch", "Example", "build_requests"]


@dataclass(frozen=True, slots=True)
class Batch:
    """One request, and what its answer is about."""

    request: Request
    indices: tuple[int, ...]
    """Places in `views` of the objects that are asked about; the first is object "1" in the prompt."""
    classes: Mapping[str, ClassIRI]
    """Name in the prompt → class, for all classes that are offered, in the order of the prompt."""

    @property
    def numbers(self) -> tuple[str, ...]:
        """The numbers by which the objects go in prompt and answer."""
        return tuple(str(number) for number in range(1, len(self.indices) + 1))


@dataclass(frozen=True, slots=True)
class Example:
    """An object that a person has named, shown to the model as an example."""

    view: ObjectView
    class_iri: ClassIRI


def build_requests(
    views: Sequence[ObjectView],
    tbox: TBox,
    options: PromptOptions,
    candidates: Sequence[Sequence[ClassIRI]] | None = None,
    *,
    examples: Sequence[Example] = (),
    pictures: Mapping[int, bytes] | None = None,
) -> list[Batch]:
    """Return the requests that ask about all views, those of one strategy in order.

    Args:
        views: what is known of the objects.
        tbox: the classes.
        options: how to ask.
        candidates: for each view the classes that are offered for it; the roots where it has none. A prompt lists
            those of all its objects, and its system part stays the same. None offers the whole TBox, in the system
            part, which servers can keep.
        examples: objects of the scene with their classes, told in the system part.
        pictures: PNG pictures of objects, by their place in `views`; sent with the prompts about them.
    """
    by_strategy: dict[Strategy, list[int]] = {}
    for index, view in enumerate(views):
        by_strategy.setdefault(options.strategy.for_name(view.name, is_thinking=options.is_thinking), []).append(index)
    batches = []
    for strategy, members in sorted(by_strategy.items()):
        writer = _Writer(tbox, replace(options, strategy=strategy), examples, offers_all=candidates is None)
        for start in range(0, len(members), options.objects_per_prompt):
            indices = tuple(members[start : start + options.objects_per_prompt])
            offered = [candidates[index] for index in indices] if candidates is not None else []
            shown = [(pictures or {}).get(index) for index in indices]
            batches.append(writer.batch(indices, [views[index] for index in indices], offered, shown))
    return batches


class _Writer:
    """Writes the prompts of one strategy; they share their system part."""

    def __init__(self, tbox: TBox, options: PromptOptions, examples: Sequence[Example], *, offers_all: bool) -> None:
        self._tbox = tbox
        self._options = options
        self._names = name_classes(tbox)
        self._examples = examples
        self._whole = list_classes(tbox, self._names, tbox.by_iri, options) if offers_all else None
        strategy = read_template(f"strategy_{options.strategy}").template
        parts = [fill_template("system", strategy=strategy)]
        if self._whole is not None:
            parts.append(self._whole.text)
        if examples:
            parts.append(fill_template("examples", examples="\n\n".join(self._example_rows())))
        self._system = "\n".join(parts)

    def _example_rows(self) -> Iterator[str]:
        for number, example in enumerate(self._examples, start=1):
            rows = describe(example.view, self._options)
            yield "\n".join([f"example {number}", *rows, f"class: {self._names[example.class_iri]}"])

    def batch(
        self,
        indices: tuple[int, ...],
        views: Sequence[ObjectView],
        candidates: Sequence[Sequence[ClassIRI]],
        pictures: Sequence[bytes | None],
    ) -> Batch:
        """Return the request about some objects, each with the classes that are offered for it and its picture."""
        user, offer = "", self._whole
        if offer is None:
            offered = {iri: None for row in candidates for iri in row or self._tbox.roots}
            offered |= dict.fromkeys(example.class_iri for example in self._examples)
            offer = list_classes(self._tbox, self._names, offered, self._options)
            user = offer.text + "\n"
        user += self._describe(views, pictures)
        options = self._options
        request = Request(
            system=self._system,
            user=user,
            schema=_schema(len(indices), list(offer.classes), options.strategy),
            max_tokens=options.max_tokens,
            temperature=options.temperature,
            is_thinking=options.is_thinking,
            images=tuple(picture for picture in pictures if picture is not None),
        )
        return Batch(request, indices, offer.classes)

    def _describe(self, views: Sequence[ObjectView], pictures: Sequence[bytes | None]) -> str:
        rows = []
        shown = 0
        for number, (view, picture) in enumerate(zip(views, pictures, strict=True), start=1):
            lines = list(describe(view, self._options))
            if picture is not None:
                shown += 1
                lines.append(f"picture: image {shown}")
            rows.append("\n".join([f"object {number}", *(lines or ["nothing is known of it"])]))
        numbers = ", ".join(str(number) for number in range(1, len(views) + 1))
        return fill_template("objects", objects="\n\n".join(rows), numbers=numbers)


def _schema(count: int, names: list[str], strategy: Strategy) -> dict[str, Any]:
    properties: dict[str, Any] = {"class": {"type": "string", "enum": names}}
    if strategy is Strategy.CHAIN_OF_THOUGHT:
        # Before the class: models write properties in the order of the schema.
        properties = {"reasoning": {"type": "string"}} | properties
    return _record({str(number): _record(properties) for number in range(1, count + 1)})


def _record(properties: dict[str, Any]) -> dict[str, Any]:
    return {"type": "object", "properties": properties, "required": list(properties), "additionalProperties": False}
