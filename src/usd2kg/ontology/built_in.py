"""The built-in ontologies: names, IRIs and data files."""

from pathlib import Path

from usd2kg.knowledge import data_file

__all__ = ["BUILT_IN", "HOME", "PLACES", "PLACES_IRI", "SOMA_HOME", "built_in_document"]

HOME = "built-in home TBox"
PLACES = "built-in places TBox"
BUILT_IN = {HOME: "home.ttl", PLACES: "places.ttl"}
"""`TBox.source` of a built-in TBox → data file."""
PLACES_IRI = "https://w3id.org/usd2kg/places"
"""The built-in ontology of places; its classes have IRIs that begin with this."""
SOMA_HOME = "http://www.ease-crc.org/ont/SOMA-HOME.owl"
"""The ontology whose classes the home TBox has."""
_FILES = {SOMA_HOME: BUILT_IN[HOME], "https://w3id.org/usd2kg/home": BUILT_IN[HOME], PLACES_IRI: BUILT_IN[PLACES]}


def built_in_document(iri: str) -> Path | None:
    """Return the file that stands in for an imported ontology; None if none does."""
    name = _FILES.get(iri)
    return Path(str(data_file(name))) if name is not None else None
