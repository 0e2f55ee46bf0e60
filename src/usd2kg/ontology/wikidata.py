"""Wikidata items to which an ontology maps its classes."""

import re
from collections.abc import Iterable, Mapping

from usd2kg.ontology.namespaces import OWL, RDF, RDFS, SKOS

__all__ = ["EQUIVALENT_CLASS", "is_mapping", "item_in", "pick_items"]

EQUIVALENT_CLASS = f"{OWL}equivalentClass"
_SAME = (f"{SKOS}exactMatch", EQUIVALENT_CLASS, f"{OWL}sameAs", f"{SKOS}closeMatch", f"{RDFS}seeAlso")
"""Mapping properties, strongest first; other annotations rank last."""
_OTHER_ITEMS = tuple(f"{SKOS}{name}" for name in ("broadMatch", "narrowMatch", "relatedMatch", "mappingRelation"))
"""Properties whose item is not equivalent to the class."""
_ITEM = re.compile(
    r"(?:https?://(?:www\.)?wikidata\.org/(?:entity|wiki)/|(?:wd|wikidata):)(Q[1-9][0-9]*)", re.IGNORECASE
)


def item_in(text: str) -> str | None:
    """Return the Wikidata item that an IRI or a text denotes, else None.

    >>> item_in("http://www.wikidata.org/entity/Q81727")
    'Q81727'
    >>> item_in("Wikidata:Q81727")
    'Q81727'
    >>> item_in("see Q81727")
    """
    found = _ITEM.fullmatch(text.strip())
    return found[1].upper() if found else None


def is_mapping(property_iri: str) -> bool:
    """Return whether a property may map a class to an equivalent item."""
    if property_iri in _SAME:
        return True
    return not property_iri.startswith((OWL, RDF, RDFS)) and property_iri not in _OTHER_ITEMS


def pick_items(found: Mapping[str, Iterable[str]]) -> tuple[str, ...]:
    """Return the items of the strongest property, sorted by number.

    Args:
        found: property IRI → items.
    """
    ranked = sorted(found, key=lambda name: (_SAME.index(name) if name in _SAME else len(_SAME), name))
    items = next((set(found[name]) for name in ranked if found[name]), set())
    return tuple(sorted(items, key=lambda item: int(item[1:])))
