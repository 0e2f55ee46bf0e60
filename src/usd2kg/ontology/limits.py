"""Limits on untrusted documents: sizes, expansion of XML entities, and time to download."""

from dataclasses import dataclass

__all__ = ["DOWNLOAD", "XML_ENTITIES", "DownloadLimits", "EntityLimits"]


@dataclass(frozen=True, slots=True)
class EntityLimits:
    """Expansion of XML entities. Ontologies use entities for namespaces, which are short and not nested."""

    characters: int = 10_000
    """Length to which one entity may expand."""
    depth: int = 5
    """Nesting depth."""
    growth: int = 100
    """Ratio of the expanded to the original length of a document…"""
    small_document: int = 8_000_000
    """…if it expands to more characters than this."""
    file_bytes: int = 200_000_000
    """Size of a file that declares entities."""


@dataclass(frozen=True, slots=True)
class DownloadLimits:
    """Download of one document."""

    timeout_s: float = 60.0
    """Longest time without a response."""
    document_bytes: int = 200_000_000


XML_ENTITIES = EntityLimits()
DOWNLOAD = DownloadLimits()
