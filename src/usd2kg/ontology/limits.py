"""Limits on untrusted documents: sizes, nesting, expansion of XML entities, and time to download."""

from dataclasses import dataclass

__all__ = ["DOWNLOAD", "NESTING", "XML_ENTITIES", "DownloadLimits", "EntityLimits", "NestingLimits"]


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
class NestingLimits:
    """Depth to which a document may be nested.

    The parsers of OWL, JSON-LD and triple terms were measured to overflow a stack of 8 MiB between 1,000 and 20,000
    levels. Published ontologies have fewer than 50.
    """

    owl_levels: int = 300
    """Class expressions in functional and Manchester syntax; elements in OWL/XML."""
    json_levels: int = 1_000
    """Objects and arrays of JSON-LD."""
    rdf_xml_levels: int = 10_000
    """Elements of RDF/XML, which nests list items in each other; the parser takes 0.5 s at this depth."""
    term_levels: int = 1_000
    """Nested triple terms in Turtle, TriG, N-Triples and N-Quads."""


@dataclass(frozen=True, slots=True)
class DownloadLimits:
    """Download of one document."""

    timeout_s: float = 60.0
    """Longest time without a response."""
    document_bytes: int = 200_000_000


NESTING = NestingLimits()
XML_ENTITIES = EntityLimits()
DOWNLOAD = DownloadLimits()
