"""Settings of graph construction, read from `knowledge/settings/graph.toml`."""

from typing import NamedTuple

from usd2kg.knowledge import read_settings

__all__ = ["JUSTIFICATION", "JustificationSettings"]


class JustificationSettings(NamedTuple):
    """Annotations of type assertions."""

    max_alternatives: int


JUSTIFICATION = read_settings("graph", "justification", JustificationSettings)
