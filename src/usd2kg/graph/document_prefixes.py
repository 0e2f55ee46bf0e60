"""document_prefixes: the prefixes of files about one scene and ontology."""

from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.ontology import TBox

__all__ = ["document_prefixes"]


def document_prefixes(tbox: TBox) -> dict[str, str]:
    """Return prefix → namespace: those of this project, and those that the ontology declares for its classes.

    The prefixes of this project take precedence over those of an ontology.
    """
    return {**tbox.prefixes_beside(PREFIXES), **PREFIXES}
