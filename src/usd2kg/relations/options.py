"""User options of relation finding."""

from dataclasses import dataclass

from usd2kg.relations.model import DEFAULT_KINDS, VIEWPOINT_KINDS, Viewpoint, check_kinds
from usd2kg.relations.rule_file import load_rules
from usd2kg.relations.thresholds import RelationRules

__all__ = ["RelationOptions"]


@dataclass(frozen=True, slots=True)
class RelationOptions:
    """Kinds, viewpoint and rules of relation finding.

    Raises:
        GraphError: a kind is unknown, or a side lacks a viewpoint.
    """

    kinds: tuple[str, ...] | None = None
    """Kinds to find; by default `DEFAULT_KINDS`, plus the sides if there is a viewpoint."""
    viewpoint: Viewpoint | None = None
    """Viewer of left, right, front and behind."""
    rules: RelationRules | None = None
    """Thresholds and class lists; by default the packaged ones, see `load_rules`."""

    def __post_init__(self) -> None:
        check_kinds(self.chosen_kinds, self.viewpoint)

    @property
    def chosen_kinds(self) -> frozenset[str]:
        """Kinds to find, with defaults resolved."""
        if self.kinds is not None:
            return frozenset(self.kinds)
        return frozenset((*DEFAULT_KINDS, *(VIEWPOINT_KINDS if self.viewpoint is not None else ())))

    @property
    def chosen_rules(self) -> RelationRules:
        """Rules, with the default resolved."""
        return self.rules or load_rules()
