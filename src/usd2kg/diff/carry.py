"""carry_decisions: apply decisions about an earlier scene to the same objects under their new prim paths."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from usd2kg.diff.match import match_objects
from usd2kg.diff.match_description import describe_match
from usd2kg.diff.object_state import ObjectState
from usd2kg.diff.tolerances import DEFAULT_TOLERANCES, Tolerances
from usd2kg.grounding import Decision, DecisionOrigin, as_decision
from usd2kg.ontology import ClassIRI

__all__ = ["CarriedDecisions", "UnplacedDecision", "carry_decisions"]


@dataclass(frozen=True, slots=True)
class UnplacedDecision:
    """A decision that applies to no object of the new scene."""

    prim_path: str
    """The path in the decision."""
    class_iri: ClassIRI | None
    """None if no class fits."""
    reason: str
    """Why it does not apply."""


@dataclass(frozen=True, slots=True)
class CarriedDecisions:
    """Decisions for a new scene, and those that do not apply to it."""

    decisions: Mapping[str, ClassIRI | Decision]
    """Prim path in the new scene → decision."""
    carried: Mapping[str, DecisionOrigin]
    """Prim path in the new scene → origin, for decisions about another path."""
    unplaced: tuple[UnplacedDecision, ...]
    """In the order of the decisions."""


def carry_decisions(
    decisions: Mapping[str, ClassIRI | Decision],
    old: Sequence[ObjectState],
    new: Sequence[ObjectState],
    tolerances: Tolerances = DEFAULT_TOLERANCES,
) -> CarriedDecisions:
    """Return decisions about old objects as decisions about the new objects that match them.

    A decision about a path that only the new scene has is kept, and takes precedence over a carried decision.

    Args:
        decisions: prim path in either scene → decision, or class alone.
        old: the objects of the earlier scene.
        new: the objects of the new scene.
        tolerances: limits of the matching.
    """
    matches = {match.old.prim_path: match for match in match_objects(old, new, tolerances).matches}
    old_paths, new_paths = ({state.prim_path for state in states} for states in (old, new))
    placed = {path: decision for path, decision in decisions.items() if path in new_paths - old_paths}
    carried: dict[str, DecisionOrigin] = {}
    unplaced: list[UnplacedDecision] = []
    for path, decision in decisions.items():
        iri = as_decision(decision).class_iri
        match = matches.get(path)
        if match is None:
            if path not in placed:
                unplaced.append(UnplacedDecision(path, iri, _absence_reason(path, old_paths, new_paths)))
            continue
        target = match.new.prim_path
        if target in placed:
            reason = f"is now {target}, which has a decision of its own"
            unplaced.append(UnplacedDecision(path, iri, reason))
            continue
        placed[target] = decision
        if target != path:
            carried[target] = DecisionOrigin(path, describe_match(match, tolerances))
    return CarriedDecisions(placed, carried, tuple(unplaced))


def _absence_reason(path: str, old_paths: set[str], new_paths: set[str]) -> str:
    if path not in old_paths:
        return "in neither scene"
    return "removed; its path now belongs to another object" if path in new_paths else "removed"
