"""Groups of similar objects that share one answer, and shortlists of classes from the lexical grounder."""

from collections.abc import Sequence

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.llm.commands import commanding_texts
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["group_similar_views", "make_shortlists", "signature_of"]


def make_shortlists(views: Sequence[ObjectView], tbox: TBox, size: int) -> list[list[ClassIRI]]:
    """Return for each view the best `size` candidates of the lexical grounder, their superclasses, and the roots.

    The candidates come first, the best one before the others, then the superclasses and the roots.
    """
    predictions = LexicalGrounder().ground_views([("", view) for view in views], tbox)
    likely = [[candidate.class_iri for candidate in prediction.candidates[:size]] for prediction in predictions]
    return [
        list(dict.fromkeys([*iris, *(up for iri in iris for up in sorted(tbox.closure(iri))), *tbox.roots]))
        for iris in likely
    ]


def group_similar_views(views: Sequence[ObjectView], options: PromptOptions) -> list[list[int]]:
    """Return groups of view indices; the views of a group share one answer and differ only in number and position.

    For strategy A the name alone counts; for B and C also the names of the parents, the size to the centimetre, the
    mass and the asset. A masked view is a group by itself, since masking can make different objects look alike. An
    object whose texts may command the model shares an answer only with objects of the same texts.
    """
    groups: dict[object, list[int]] = {}
    for index, view in enumerate(views):
        strategy = options.strategy.for_name(view.name, is_thinking=options.is_thinking)
        commands = commanding_texts(view, has_more_evidence=options.has_more_evidence)
        key: object = index if view.is_masked else (strategy, signature_of(view, strategy), commands)
        groups.setdefault(key, []).append(index)
    return list(groups.values())


def signature_of(view: ObjectView, strategy: Strategy) -> object:
    """Return a hashable key that is equal for objects that share an answer."""
    name = _without_number(view.name)
    if strategy is Strategy.NAME_ONLY:
        return name
    size = tuple(round(side, 2) for side in sorted(view.own_size)) if view.own_size else None
    return name, tuple(map(_without_number, view.parents)), size, view.mass_kg, view.asset


def _without_number(name: str) -> str:
    return name.rstrip("0123456789_")
