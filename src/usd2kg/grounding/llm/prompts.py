"""The prompts of the study's strategies: pure functions of what is seen of the objects, the TBox and options.

Names, labels and comments come from strangers. Each is written as a JSON string on one line, inside a block that the
instructions declare to be data, and objects go by numbers, so that a name can neither end its row nor the block.
"""

import json
import random
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from importlib.resources import files
from itertools import islice
from string import Template
from typing import Any

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Request
from usd2kg.ontology import ClassIRI, OntologyClass, TBox, compact_iri
from usd2kg.scene import ObjectView

__all__ = [
    "Batch",
    "PromptOptions",
    "Strategy",
    "build_requests",
    "estimate_tokens",
    "fill_template",
    "name_classes",
    "quote",
]

_MOST_CHARACTERS = 200
_BYTES_PER_TOKEN = 4
_MARKUP = frozenset("<>`")


class Strategy(StrEnum):
    """How a model is asked, by the letters of the study."""

    NAME_ONLY = "A"
    """The name and the TBox."""
    CONTEXT = "B"
    """Geometry, position and hierarchy beside the name."""
    CHAIN_OF_THOUGHT = "C"
    """The same, and the reasoning is written out before the class."""


@dataclass(frozen=True, slots=True)
class PromptOptions:
    """What a prompt depends on beside the objects and the TBox.

    Raises:
        GroundingError: a prompt would ask about no object.
    """

    strategy: Strategy = Strategy.CONTEXT
    is_tree: bool = False
    """Whether the classes are listed as a tree instead of alphabetically."""
    shuffle_seed: int | None = None
    """Seed of a random order of the classes (in a tree, of those below one class); None keeps the alphabet."""
    objects_per_prompt: int = 1
    most_siblings: int = 48
    """Siblings that are named; the others are counted."""
    has_more_evidence: bool = False
    """Whether labels, documentation, own axes, asset, materials and parts are told too, which the study does not."""
    most_tokens: int = 4096
    """Output tokens after which the model is cut off."""
    temperature: float = 0.0
    is_thinking: bool = False

    def __post_init__(self) -> None:
        if self.objects_per_prompt < 1:
            raise GroundingError(f"{self.objects_per_prompt} objects in a prompt; expected 1 or more")


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
class _Offer:
    """The classes of a prompt: their block of text, and name → IRI."""

    text: str
    classes: Mapping[str, ClassIRI]


def build_requests(
    views: Sequence[ObjectView],
    tbox: TBox,
    options: PromptOptions,
    candidates: Sequence[Sequence[ClassIRI]] | None = None,
) -> list[Batch]:
    """Return the requests that ask about all views, in order.

    Args:
        views: what is known of the objects.
        tbox: the classes.
        options: how to ask.
        candidates: for each view the classes that are offered for it; the roots where it has none. A prompt lists
            those of all its objects, and its system part stays the same. None offers the whole TBox, in the system
            part, which servers can keep.
    """
    names = name_classes(tbox)
    system = fill_template("system", strategy=_template(f"strategy_{options.strategy}").template)
    whole = _offer(tbox, names, tbox.by_iri, options) if candidates is None else None
    if whole:
        system += "\n" + whole.text
    batches = []
    for start in range(0, len(views), options.objects_per_prompt):
        indices = tuple(range(start, min(start + options.objects_per_prompt, len(views))))
        user, offer = "", whole
        if offer is None:
            offered = {iri: None for i in indices for iri in (candidates or ())[i] or tbox.roots}
            offer = _offer(tbox, names, offered, options)
            user = offer.text + "\n"
        user += _describe([views[i] for i in indices], options)
        batches.append(_batch(system, user, indices, offer, options))
    return batches


def _batch(system: str, user: str, indices: tuple[int, ...], offer: _Offer, options: PromptOptions) -> Batch:
    request = Request(
        system=system,
        user=user,
        schema=_schema(len(indices), list(offer.classes), options.strategy),
        most_tokens=options.most_tokens,
        temperature=options.temperature,
        is_thinking=options.is_thinking,
    )
    return Batch(request, indices, offer.classes)


def _schema(count: int, names: list[str], strategy: Strategy) -> dict[str, Any]:
    properties: dict[str, Any] = {"class": {"type": "string", "enum": names}}
    if strategy is Strategy.CHAIN_OF_THOUGHT:
        # Before the class: models write properties in the order of the schema.
        properties = {"reasoning": {"type": "string"}} | properties
    return _record({str(number): _record(properties) for number in range(1, count + 1)})


def _record(properties: dict[str, Any]) -> dict[str, Any]:
    return {"type": "object", "properties": properties, "required": list(properties), "additionalProperties": False}


def name_classes(tbox: TBox) -> dict[ClassIRI, str]:
    """Return IRI → the name of the class in prompts, each of them different.

    That is the local name where no other class has it, else a CURIE with the known prefix or one made of the
    namespace's last word, numbered if need be. Characters that could be read as markup become `_`.
    """
    words = {cls.iri: re.sub(r"[^\w.\-]", "_", cls.local_name)[:_MOST_CHARACTERS] for cls in tbox.classes}
    counts = Counter(words.values())
    names: dict[ClassIRI, str] = {}
    taken: set[str] = set()
    for iri, word in words.items():
        base = name = word if counts[word] == 1 else f"{_prefix(iri)}:{word}"
        number = 2
        while name in taken:
            name, number = f"{base}_{number}", number + 1
        taken.add(name)
        names[iri] = name
    return names


def _prefix(iri: ClassIRI) -> str:
    curie = compact_iri(iri)
    if curie != iri:
        return curie.partition(":")[0]
    namespace = re.split(r"[#/:]", iri.rstrip("#/"))[-2:][0]
    return re.sub(r"\W", "_", re.sub(r"\.(owl|ttl|rdf)$", "", namespace)) or "ns"


def _offer(
    tbox: TBox, names: Mapping[ClassIRI, str], offered: Mapping[ClassIRI, Any], options: PromptOptions
) -> _Offer:
    order = sorted(offered, key=lambda iri: names[iri])
    if options.shuffle_seed is not None:
        random.Random(options.shuffle_seed).shuffle(order)
    parents = {iri: _parents(tbox, iri, offered) for iri in order}
    lines = _tree_lines if options.is_tree else _flat_lines
    text = fill_template("classes", classes="\n".join(lines(tbox, names, parents)))
    return _Offer(text, {names[iri]: iri for iri in order})


def _parents(tbox: TBox, iri: ClassIRI, offered: Mapping[ClassIRI, Any]) -> list[ClassIRI]:
    """Return the nearest of the offered classes above one."""
    direct = tbox.by_iri[iri].parents
    if all(parent in offered for parent in direct):
        return list(direct)
    above = [other for other in tbox.closure(iri) if other in offered and other != iri]
    return [one for one in above if not any(tbox.is_subclass(other, one) for other in above if other != one)]


def _flat_lines(tbox: TBox, names: Mapping[ClassIRI, str], parents: Mapping[ClassIRI, list[ClassIRI]]) -> Iterator[str]:
    for iri, above in parents.items():
        parent_names = ", ".join(sorted(names[parent] for parent in above))
        relation = f" (subClassOf: {parent_names})" if above else ""
        yield _titled(names[iri], tbox.by_iri[iri]) + relation + _comment(tbox.by_iri[iri])


def _tree_lines(tbox: TBox, names: Mapping[ClassIRI, str], parents: Mapping[ClassIRI, list[ClassIRI]]) -> Iterator[str]:
    """Yield classes indented below their superclasses; what is below a repeated class is written once."""
    children: dict[ClassIRI, list[ClassIRI]] = {iri: [] for iri in parents}
    for iri, above in parents.items():
        for parent in above:
            children[parent].append(iri)
    written: set[ClassIRI] = set()
    pending = [(iri, 0) for iri in reversed(list(parents)) if not parents[iri]]
    while pending:
        iri, depth = pending.pop()
        if iri in written:
            yield "  " * depth + names[iri] + " (see above)"
            continue
        written.add(iri)
        yield "  " * depth + _titled(names[iri], tbox.by_iri[iri]) + _comment(tbox.by_iri[iri])
        pending.extend((child, depth + 1) for child in reversed(children[iri]))


def _titled(name: str, cls: OntologyClass) -> str:
    """Return the name, with the label where it tells more: `OBO_0001 "coffee cup"`."""
    same = re.sub(r"[\W_]", "", cls.label).casefold() == re.sub(r"[\W_]", "", cls.local_name).casefold()
    return name if same or not cls.label else f"{name} {quote(cls.label)}"


def _comment(cls: OntologyClass) -> str:
    return f" -- {quote(cls.comment)}" if cls.comment else ""


def _describe(views: Sequence[ObjectView], options: PromptOptions) -> str:
    rows = []
    for number, view in enumerate(views, start=1):
        lines = [f"{key}: {value}" for key, value in _evidence(view, options) if value]
        rows.append("\n".join([f"object {number}", *(lines or ["nothing is known of it"])]))
    numbers = ", ".join(str(number) for number in range(1, len(views) + 1))
    return fill_template("objects", objects="\n\n".join(rows), numbers=numbers)


def _evidence(view: ObjectView, options: PromptOptions) -> Iterator[tuple[str, str]]:
    """Yield (key, value) of all that the strategy tells; the value is empty where it is unknown."""
    yield "name", quote(view.name) if view.name else ""
    if options.strategy is Strategy.NAME_ONLY:
        return
    if view.size is not None:
        # The world is z-up: the second axis is the depth.
        width, depth, height = view.size
        yield "box (w, h, d) in metres", " x ".join(map(_number, (width, height, depth)))
    if view.mass_kg is not None:
        yield "mass in kg", _number(view.mass_kg)
    if view.position is not None:
        yield "position (x, y, z) in metres", ", ".join(map(_number, view.position))
    yield "parent path, outermost first", " / ".join(map(quote, view.parents))
    left_out = len(view.siblings) - options.most_siblings
    more = f" and {left_out} more" if left_out > 0 else ""
    yield "siblings", ", ".join(map(quote, islice(view.siblings, options.most_siblings))) + more
    if options.has_more_evidence:
        yield from _more_evidence(view)


def _more_evidence(view: ObjectView) -> Iterator[tuple[str, str]]:
    yield "display name", quote(view.display_name) if view.display_name else ""
    yield "documentation", quote(view.documentation) if view.documentation else ""
    if view.oriented_size is not None:
        yield "extents along its own axes in metres", " x ".join(map(_number, view.oriented_size))
    for key in ("labels", "asset", "materials", "parts"):
        yield key, ", ".join(map(quote, getattr(view, key)))


def _number(value: float) -> str:
    """Return millimetres or grams exactly, and what is small to a hundredth of them.

    >>> [_number(value) for value in (1.9, 0.08125, 12.00049, -0.000001)]
    ['1.9', '0.08125', '12', '0']
    """
    decimals = 3 if abs(value) >= 0.1 else 5
    return f"{round(value, decimals) + 0.0:.{decimals}f}".rstrip("0").rstrip(".")


def quote(text: str, most: int = _MOST_CHARACTERS) -> str:
    r"""Return a stranger's text as a JSON string on one line, cut to `most` characters with an ellipsis.

    Escaped are also what cannot be seen (direction marks, separators of lines) and what could pass for a fence or tag.

    >>> print(quote('a "cup"\n</objects> ✓'))
    "a \"cup\"\n\u003c/objects\u003e ✓"
    """
    quoted = json.dumps(text if len(text) <= most else text[: most - 1] + "…", ensure_ascii=False)
    if quoted.isprintable() and not _MARKUP.intersection(quoted):
        return quoted
    return "".join(_escape(c) if c in _MARKUP or not c.isprintable() else c for c in quoted)


def _escape(character: str) -> str:
    return f"\\u{ord(character):04x}" if character in _MARKUP else json.dumps(character)[1:-1]


@lru_cache
def _template(name: str) -> Template:
    text = (files("usd2kg.grounding.llm") / "templates" / f"{name}.txt").read_text("utf-8")
    return Template(text.removesuffix("\n"))


def fill_template(name: str, **values: str) -> str:
    """Return the text of a template with its values, as they are: what they contain is not filled in again."""
    return _template(name).substitute(values) + "\n"


def estimate_tokens(text: str) -> int:
    """Return about how many tokens a text has: one for four bytes of UTF-8.

    That is within a quarter or so for English and JSON; names cut short and long numbers take more.
    """
    return -(-len(text.encode("utf-8", "replace")) // _BYTES_PER_TOKEN)
