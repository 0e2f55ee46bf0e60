"""What the names of the home vocabulary say in other ontologies."""

from collections.abc import Container, Iterator, Mapping

from usd2kg.grounding.lexical.alignment.class_labels import phrase_of
from usd2kg.grounding.lexical.alignment.terms import BORROWED, LABEL, Anchor, Term, keep_best, term_key
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI, TBox, load_home_tbox

__all__ = ["borrowed_names", "lent_names"]

_HOLDER, _HELD, _HELD_TOO = "DesignedContainer", "Building", frozenset(["Appliance", "DesignedFurniture"])
"""Buildings are below the containers in SOMA, and so are ovens and cupboards: those are appliances and furniture."""


def lent_names(
    tbox: TBox,
    terms: Mapping[str, Term],
    anchors: Mapping[int, Anchor],
    taxonomy: Taxonomy,
    synonyms: Mapping[ClassIRI, tuple[str, ...]],
) -> Iterator[tuple[ClassIRI, str]]:
    """Yield names of things for classes of other ontologies that have the label of a class of the home TBox.

    Only for those without classes below: what counts as furniture or a tool differs from ontology to ontology. Where
    freezers are a class of their own, a chest freezer is no refrigerator.
    """
    home = load_home_tbox()
    meant = {synset: anchor.class_iri for synset, anchor in anchors.items() if anchor.weight == LABEL}

    def names_another(phrase: str, own: Term) -> bool:
        key = phrase.replace(" ", "")
        claimed = {meant.get(sense.synset, own.class_iri) for sense in taxonomy.senses(key)}
        if key in terms and terms[key].weight == LABEL:
            claimed.add(terms[key].class_iri)
        return any(not tbox.is_subclass(own.class_iri, iri) for iri in claimed)

    for iri, (label, *names) in synonyms.items():
        if iri not in tbox.by_iri and home.children.get(iri) == ():
            own = terms.get(term_key(label, taxonomy))
            if own is not None and own.weight == LABEL:
                phrases = [phrase_of(name, taxonomy) for name in names]
                elsewhere = frozenset(filter(lambda phrase: names_another(phrase, own), phrases))
                yield from ((own.class_iri, phrase) for phrase in phrases if not _ends_with(phrase, elsewhere))


def _ends_with(phrase: str, endings: Container[str]) -> bool:
    words = phrase.split()
    return any(" ".join(words[start:]) in endings for start in range(len(words)))


def borrowed_names(
    tbox: TBox,
    terms: Mapping[str, Term],
    default: ClassIRI | None,
    taxonomy: Taxonomy,
    synonyms: Mapping[ClassIRI, tuple[str, ...]],
) -> dict[str, Term]:
    """Return the names of things for the class that is labelled as what the home vocabulary has above them."""
    home = load_home_tbox()
    found: dict[str, Term] = {}
    for iri, names in synonyms.items():
        if iri in tbox.by_iri or iri not in home.by_iri or home.by_iri[iri].local_name == _HELD:
            continue
        above = {home.by_iri[up].local_name: up for up in home.closure(iri)}
        if not _HELD_TOO.isdisjoint(above):
            above.pop(_HOLDER, None)
        nearest = sorted(above.values(), key=lambda up: (-home.depths[up], up))
        labelled = (terms.get(term_key(home.by_iri[up].label, taxonomy)) for up in nearest)
        own = next((term for term in labelled if term is not None and term.weight == LABEL), None)
        if own is not None and own.class_iri != default:
            for name in names:
                keep_best(found, own.class_iri, phrase_of(name, taxonomy), BORROWED)
    return found
