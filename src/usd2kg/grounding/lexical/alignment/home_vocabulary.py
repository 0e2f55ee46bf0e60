"""Names of the built-in home vocabulary that also apply to classes of other ontologies."""

from collections.abc import Container, Iterator, Mapping

from usd2kg.grounding.lexical.alignment.label_words import normalise_label
from usd2kg.grounding.lexical.alignment.terms import AlignedClass, Term, TermKind, term_key
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI, TBox, load_home_tbox

__all__ = ["lend_terms"]


def lend_terms(
    tbox: TBox,
    terms: Mapping[str, Term],
    sense_classes: Mapping[int, AlignedClass],
    taxonomy: Taxonomy,
    synonyms: Mapping[ClassIRI, tuple[str, ...]],
) -> Iterator[Term]:
    """Yield names of leaf classes of the home TBox as terms of the classes of another ontology with the same label.

    General classes lend nothing: what counts as furniture differs between ontologies. A name is left out if the
    ontology has another class for it or for its last words: where freezers are a class, a chest freezer is not a
    refrigerator.
    """
    home = load_home_tbox()
    aligned = {synset: found.class_iri for synset, found in sense_classes.items() if found.weight == 1.0}

    def names_another(phrase: str, own: Term) -> bool:
        key = phrase.replace(" ", "")
        classes = {aligned.get(sense.synset, own.class_iri) for sense in taxonomy.senses(key)}
        if key in terms and terms[key].kind is TermKind.LABEL:
            classes.add(terms[key].class_iri)
        return any(not tbox.is_subclass(own.class_iri, iri) for iri in classes)

    for iri, (label, *names) in synonyms.items():
        if iri in tbox.by_iri or home.children.get(iri) != ():
            continue
        own = terms.get(term_key(label, taxonomy))
        if own is not None and own.kind is TermKind.LABEL:
            phrases = [normalise_label(name, taxonomy) for name in names]
            others = frozenset(phrase for phrase in phrases if names_another(phrase, own))
            for phrase in phrases:
                if not _ends_with(phrase, others):
                    yield Term(own.class_iri, phrase, TermKind.LENT)


def _ends_with(phrase: str, endings: Container[str]) -> bool:
    words = phrase.split()
    return any(" ".join(words[start:]) in endings for start in range(len(words)))
