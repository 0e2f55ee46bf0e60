"""Few-shot examples for prompts, chosen from a person's review decisions."""

from collections import Counter
from collections.abc import Mapping

from usd2kg.grounding.context.views import view_objects
from usd2kg.grounding.decisions import as_decision
from usd2kg.grounding.llm.prompts import Example
from usd2kg.grounding.model import Decision
from usd2kg.ontology import ClassIRI
from usd2kg.scene import Scene

__all__ = ["choose_examples"]


def choose_examples(scene: Scene, decisions: Mapping[str, ClassIRI | Decision], limit: int) -> list[Example]:
    """Return at most `limit` objects with a decided class: the first of each class, then the second, and so on."""
    seen: Counter[ClassIRI] = Counter()
    ranked: list[tuple[int, str, Example]] = []
    for obj, view in view_objects(scene):
        if (decision := decisions.get(obj.prim_path)) is not None:
            iri = as_decision(decision).class_iri
            if iri is None:
                continue
            seen[iri] += 1
            ranked.append((seen[iri], obj.prim_path, Example(view, iri)))
    return [example for _, _, example in sorted(ranked, key=lambda row: row[:2])[:limit]]
