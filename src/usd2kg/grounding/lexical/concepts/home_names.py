"""Names of objects by class of the built-in home TBox."""

from collections.abc import Mapping
from functools import lru_cache

from usd2kg.grounding.lexical.settings import READING
from usd2kg.knowledge import read_rows
from usd2kg.ontology import ClassIRI, load_home_tbox

__all__ = ["home_names", "short_home_names"]


@lru_cache(maxsize=1)
def home_names() -> Mapping[ClassIRI, tuple[str, ...]]:
    """Return the names of objects by class of the built-in home TBox: labels, synonyms, and `data/home_names.csv`."""
    home = load_home_tbox()
    names = {cls.iri: [cls.label, *cls.alt_labels] for cls in home.classes}
    by_local_name = {cls.local_name: cls.iri for cls in home.classes}
    for row in read_rows("home_names.csv"):
        names[by_local_name[row["class"]]] += row["names"].split("|")
    return {iri: tuple(found) for iri, found in names.items()}


@lru_cache(maxsize=1)
def short_home_names() -> frozenset[str]:
    """Return the names that are shorter than nouns usually must be: a TV, a PC."""
    names = (name.lower() for names in home_names().values() for name in names)
    return frozenset(name for name in names if len(name) < READING.min_noun_letters)
