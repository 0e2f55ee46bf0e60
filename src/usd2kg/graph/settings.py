"""Settings of graph construction, read from `knowledge/settings/graph.toml`."""

from dataclasses import dataclass

from usd2kg.knowledge import read_settings

__all__ = ["JUSTIFICATION", "JustificationSettings"]


@dataclass(frozen=True, slots=True)
class JustificationSettings:
    """Annotations of type assertions."""

    max_alternatives: int


JUSTIFICATION = read_settings("graph", "justification", JustificationSettings)
