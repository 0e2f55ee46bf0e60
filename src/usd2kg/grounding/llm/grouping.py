"""Which objects are asked about once, and which classes each is offered."""

from collections.abc import Sequence
from dataclasses import replace

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["group_similar_views", "make_shortlists"]


def make_shortlists(views: Sequence[ObjectView], tbox: TBox, most: int) -> list[list[ClassIRI]]:
    """Return for each view the classes that the lexical grounder thinks of first, all above them, and the roots."""
    first = LexicalGrounder().ground_views([("", view) for view in views], tbox)
    likely = [[candidate.class_iri for candidate in found.candidates[:most]] for found in first]
    return [sorted({*tbox.roots, *(up for iri in iris for up in tbox.closure(iri))}) for iris in likely]


def group_similar_views(views: Sequence[ObjectView], options: PromptOptions) -> list[list[int]]:
    """Return the indices of views in groups that one answer serves: they differ in numbers and in where they stand.

    By strategy A only the name counts; by B and C also the names above and the size, to the centimetre. A masked view
    is always alone: that it looks like another may be the mask's doing.
    """
    groups: dict[object, list[int]] = {}
    for index, view in enumerate(views):
        strategy = options.strategy.for_name(view.name, is_thinking=options.is_thinking)
        key: object = index if view.is_masked else (strategy, _signature(view, strategy))
        groups.setdefault(key, []).append(index)
    return list(groups.values())


def _signature(view: ObjectView, strategy: Strategy) -> object:
    bare = replace(view, name=_stem(view.name), position=None, siblings=(), neighbourhood=None)
    if strategy is Strategy.NAME_ONLY:
        return bare.name
    size = tuple(round(side, 2) for side in sorted(view.own_size)) if view.own_size else None
    return bare.name, tuple(map(_stem, view.parents)), size, view.mass_kg, view.asset


def _stem(name: str) -> str:
    return name.rstrip("0123456789_")
