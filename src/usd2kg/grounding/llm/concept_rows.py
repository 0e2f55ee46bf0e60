"""describe_group: the lines about objects that share a concept in a prompt."""

import statistics
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.llm.commands import may_command
from usd2kg.grounding.llm.concept_groups import ConceptGroup, reading_of
from usd2kg.grounding.llm.descriptions import describe_object, format_measure
from usd2kg.grounding.llm.prompt_options import PromptOptions
from usd2kg.grounding.llm.prompt_text import quote
from usd2kg.grounding.llm.settings import CONCEPTS
from usd2kg.ontology import ClassIRI

__all__ = ["describe_group"]


def describe_group(
    group: ConceptGroup, views: Sequence[ObjectView], names: Mapping[ClassIRI, str], options: PromptOptions
) -> list[str]:
    """Return one line per known property of a group.

    Args:
        group: the objects.
        views: all views; the group has indices of them.
        names: class → name in the prompt.
        options: the format of the prompt.
    """
    members = [views[index] for index in group.members]
    first = members[0]
    if first.is_masked or not first.name:
        rows = list(describe_object(first, options))
    else:
        rows = [f"{key}: {value}" for key, value in _evidence(group, members, options) if value]
    candidates = ", ".join(names[iri] for iri in group.candidates if iri in names)
    return [*rows, *([f"candidates: {candidates}"] if candidates else [])]


def _evidence(group: ConceptGroup, members: Sequence[ObjectView], options: PromptOptions) -> Iterator[tuple[str, str]]:
    """Yield (key, value) of the known properties of the objects; unknown values are empty."""
    first = members[0]
    yield "names", _list_frequent((reading_of(view.name) for view in members), CONCEPTS.max_readings)
    if group.concept is not None:
        broader = f", a kind of {', '.join(map(quote, group.broader))}" if group.broader else ""
        yield "probable meaning", quote(group.concept.label) + broader
    sizes = [view.size for view in members if view.size is not None]
    if sizes:
        # World coordinates are z-up, so the second axis is the depth.
        width, depth, height = map(statistics.median, zip(*sizes, strict=True))
        yield "box (w, h, d) in metres", " x ".join(map(format_measure, (width, height, depth)))
    masses = [view.mass_kg for view in members if view.mass_kg is not None]
    yield "mass in kg", format_measure(statistics.median(masses)) if masses else ""
    yield (
        "parents",
        _list_frequent(
            (reading_of(v.parents[-1]) for v in members if v.parents and not may_command(v.parents[-1])),
            CONCEPTS.max_parents,
        ),
    )
    own = {reading_of(view.name) for view in members}
    siblings = dict.fromkeys(
        reading_of(name) for name in first.siblings[: options.max_siblings] if not may_command(name)
    )
    yield "siblings", ", ".join(quote(name) for name in [s for s in siblings if s not in own][: CONCEPTS.max_siblings])
    yield "assets", _list_frequent((asset for view in members for asset in view.asset), CONCEPTS.max_assets)
    if options.has_more_evidence:
        yield "display name", quote(first.display_name) if first.display_name else ""
        yield "documentation", quote(first.documentation) if first.documentation else ""
        for key in ("labels", "materials", "parts"):
            yield key, ", ".join(map(quote, getattr(first, key)))


def _list_frequent(texts: Iterable[str], limit: int) -> str:
    """Return the most frequent texts with their counts, then the number of omitted texts."""
    counts = Counter(texts).most_common()
    rows = [f"{quote(text)} ({count} times)" if count > 1 else quote(text) for text, count in counts[:limit]]
    return ", ".join(rows) + (f" and {len(counts) - limit} more" if len(counts) > limit else "")
