"""carry_decisions: what people decided about things that have other prim paths now."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from usd2kg.diff.match import match_objects
from usd2kg.diff.match_description import describe_match
from usd2kg.diff.object_state import ObjectState
from usd2kg.diff.tolerances import Tolerances
from usd2kg.grounding import Carried
from usd2kg.ontology import ClassIRI

__all__ = ["CarriedDecisions", "UnplacedDecision", "carry_decisions"]


@dataclass(frozen=True, slots=True)
class UnplacedDecision:
    """A decision about what is no longer there."""

    prim_path: str
    """The path that the person decided about."""
    class_iri: ClassIRI
    reason: str
    """Why it has no place, in words."""


@dataclass(frozen=True, slots=True)
class CarriedDecisions:
    """Decisions for a new scene; none is lost."""

    decisions: Mapping[str, ClassIRI]
    """Prim path in the new scene → class."""
    carried: Mapping[str, Carried]
    """Prim path in the new scene → where the decision comes from, of those whose path is another now."""
    unplaced: tuple[UnplacedDecision, ...]
    """Those that belong to nothing in the new scene, in their order."""


def carry_decisions(
    decisions: Mapping[str, ClassIRI],
    old: Sequence[ObjectState],
    new: Sequence[ObjectState],
    tolerances: Tolerances | None = None,
) -> CarriedDecisions:
    """Return decisions about old things as decisions about the new things that they are.

    A decision about a path that only the new scene has stays, and goes before one that would be carried there.
    """
    became = {match.old.prim_path: match for match in match_objects(old, new, tolerances).matches}
    old_paths, new_paths = ({thing.prim_path for thing in things} for things in (old, new))
    placed = {path: iri for path, iri in decisions.items() if path in new_paths - old_paths}
    carried: dict[str, Carried] = {}
    unplaced: list[UnplacedDecision] = []
    for path, iri in decisions.items():
        match = became.get(path)
        if match is None:
            if path not in placed:
                is_taken = path in new_paths
                why = "gone, and its path is another thing's now" if is_taken else "gone"
                unplaced.append(UnplacedDecision(path, iri, why if path in old_paths else "in neither scene"))
            continue
        target = match.new.prim_path
        if target in placed:
            unplaced.append(UnplacedDecision(path, iri, f"is {target} now, which has a decision of its own"))
            continue
        placed[target] = iri
        if target != path:
            carried[target] = Carried(path, describe_match(match, tolerances))
    return CarriedDecisions(placed, carried, tuple(unplaced))
