"""describe_object: the lines about one object in a prompt."""

from collections.abc import Iterator
from itertools import islice

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.llm.commands import quote_other
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompt_text import quote

__all__ = ["describe_object", "format_measure"]


def describe_object(view: ObjectView, options: PromptOptions) -> Iterator[str]:
    """Yield one line per known property of an object, as far as the strategy includes it."""
    return (f"{key}: {value}" for key, value in _evidence(view, options) if value)


def _evidence(view: ObjectView, options: PromptOptions) -> Iterator[tuple[str, str]]:
    """Yield (key, value) of the properties that the strategy includes; unknown values are empty."""
    yield "name", quote(view.name) if view.name else ""
    if options.strategy is Strategy.NAME_ONLY:
        return
    if view.size is not None:
        # World coordinates are z-up, so the second axis is the depth.
        width, depth, height = view.size
        yield "box (w, h, d) in metres", " x ".join(map(format_measure, (width, height, depth)))
    if view.mass_kg is not None:
        yield "mass in kg", format_measure(view.mass_kg)
    if view.position is not None:
        yield "position (x, y, z) in metres", ", ".join(map(format_measure, view.position))
    yield "parent path, outermost first", " / ".join(map(quote_other, view.parents))
    omitted = len(view.siblings) - options.max_siblings
    more = f" and {omitted} more" if omitted > 0 else ""
    yield "siblings", ", ".join(map(quote_other, islice(view.siblings, options.max_siblings))) + more
    if options.has_more_evidence:
        yield from _more_evidence(view)


def _more_evidence(view: ObjectView) -> Iterator[tuple[str, str]]:
    yield "display name", quote(view.display_name) if view.display_name else ""
    yield "documentation", quote(view.documentation) if view.documentation else ""
    if view.oriented_size is not None:
        yield "extents along its own axes in metres", " x ".join(map(format_measure, view.oriented_size))
    for key in ("labels", "asset", "materials", "parts"):
        yield key, ", ".join(map(quote, getattr(view, key)))


def format_measure(value: float) -> str:
    """Return a length in metres or mass in kilograms to three decimals, below 0.1 to five.

    >>> [format_measure(value) for value in (1.9, 0.08125, 12.00049, -0.000001)]
    ['1.9', '0.08125', '12', '0']
    """
    decimals = 3 if abs(value) >= 0.1 else 5
    return f"{round(value, decimals) + 0.0:.{decimals}f}".rstrip("0").rstrip(".")
