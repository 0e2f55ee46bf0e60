"""What a user can say about which relations are found, and how."""

from dataclasses import dataclass

from usd2kg.relations.model import DEFAULT_KINDS, VIEWPOINT_KINDS, Viewpoint, check_kinds
from usd2kg.relations.rule_file import load_rules
from usd2kg.relations.thresholds import RelationRules

__all__ = ["RelationOptions"]


@dataclass(frozen=True, slots=True)
class RelationOptions:
    """Which relations are found, and by which rules; the defaults are those that ship with the package.

    Raises:
        GraphError: a kind is unknown, or needs a viewpoint and there is none.
    """

    kinds: tuple[str, ...] | None = None
    """Of `ALL_KINDS`; by default `DEFAULT_KINDS`, with a viewpoint the sides too."""
    viewpoint: Viewpoint | None = None
    """From where left, right, front and behind are stronger."""
    rules: RelationRules | None = None
    """Thresholds and class lists, see `load_rules`."""

    def __post_init__(self) -> None:
        check_kinds(self.chosen_kinds, self.viewpoint)

    @property
    def chosen_kinds(self) -> frozenset[str]:
        """The kinds that are found."""
        if self.kinds is not None:
            return frozenset(self.kinds)
        return frozenset((*DEFAULT_KINDS, *(VIEWPOINT_KINDS if self.viewpoint is not None else ())))

    @property
    def chosen_rules(self) -> RelationRules:
        """The rules that they are found by."""
        return self.rules or load_rules()
