"""Build the lexicon of a TBox: the terms that name its classes, and the synsets that they are aligned with."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from usd2kg.grounding.lexical.alignment.english_labels import foreign_names_only, has_foreign_name
from usd2kg.grounding.lexical.alignment.home_vocabulary import lend_terms
from usd2kg.grounding.lexical.alignment.label_words import (
    SENSE_KEY,
    equivalent_nouns,
    head_noun_of,
    normalise_label,
    words_of_label,
)
from usd2kg.grounding.lexical.alignment.residual_class import (
    GENERAL_NOUNS,
    align_default,
    find_default_class,
    residue_of,
)
from usd2kg.grounding.lexical.alignment.terms import AlignedClass, Term, TermKind, keep_best, term_key
from usd2kg.grounding.lexical.concepts.categories import members_of
from usd2kg.grounding.lexical.concepts.senses import sense_weight, usual_sense
from usd2kg.grounding.lexical.concepts.taxonomy import Sense, Taxonomy
from usd2kg.grounding.lexical.settings import ALIGNMENT
from usd2kg.knowledge import word_set
from usd2kg.ontology import ClassIRI, OntologyClass, TBox

__all__ = [
    "CategoryMember",
    "Lexicon",
    "build_lexicon",
    "general_classes_of",
    "home_classes_of",
    "make_lexicon",
    "physical_classes",
]

_NATURAL_DOMAINS = frozenset(["animal", "object", "person", "plant"])
"""WordNet domains of natural objects."""
_TOP_NOUNS = word_set("lexical", "top_nouns")
_UNSPECIFIC_NOUNS = _TOP_NOUNS | word_set("lexical", "unspecific_nouns")
_WEIGHT_DIGITS = 4
"""Decimals of the weights of aligned classes."""
_CONJUNCTIONS = frozenset(["and", "of", "or"])
_EVENT_NOUNS = word_set("lexical", "event_nouns")


class CategoryMember(NamedTuple):
    """A class that has a synset as a member in common usage, although WordNet has it elsewhere."""

    aligned: AlignedClass
    synset_count: int
    """Number of synsets in the category."""


@dataclass(frozen=True)
class Lexicon:
    """The words of one TBox."""

    terms: Mapping[str, Term]
    """Term without spaces → the class it names."""
    sense_classes: Mapping[int, AlignedClass]
    """Synset → the class aligned with it."""
    vocabulary: Mapping[str, int]
    """Single word → number of terms that contain it."""
    default_class: ClassIRI | None
    """The class of objects without a more specific one, see `find_default_class`."""
    general_classes: frozenset[ClassIRI]
    """Uninformative classes: the roots and the default class."""
    home_classes: frozenset[ClassIRI]
    """Classes of the TBox that the home vocabulary has synonyms for."""
    category_members: Mapping[int, Sequence[CategoryMember]]
    """Synset → classes that have it as a member in common usage, though it is not their hyponym."""
    curated_synsets: frozenset[int] = frozenset()
    """Synsets whose class a person chose in an alignment file; the choice is final for them and their hyponyms."""
    listed_synsets: frozenset[int] = frozenset()
    """Synsets with a class from a list of members, shipped or by a language model."""
    excluded_classes: Mapping[int, frozenset[ClassIRI]] = field(default_factory=dict)
    """Synset → classes that, by a list or a person, neither it nor its hyponyms belong to by a hypernym further up."""


def build_lexicon(tbox: TBox, taxonomy: Taxonomy, synonyms: Mapping[ClassIRI, tuple[str, ...]]) -> Lexicon:
    """Return the lexicon of a TBox.

    Args:
        tbox: the classes.
        taxonomy: the nouns that their terms are aligned with.
        synonyms: class IRI → names in addition to the TBox's own labels; may have classes that the TBox lacks.
    """
    terms = _own_terms(tbox, taxonomy, synonyms)
    sense_classes = _align_terms(tbox, terms, taxonomy)
    home_classes = home_classes_of(tbox, synonyms)
    default = find_default_class(tbox, taxonomy)
    align_default(default, tbox, taxonomy, sense_classes)
    # After the ontology's own terms, which take precedence.
    for term in list(lend_terms(tbox, terms, sense_classes, taxonomy, synonyms)):
        keep_best(terms, term)
    _add_head_nouns(terms)
    members: Mapping[int, Sequence[CategoryMember]] = {}
    if not home_classes.issuperset(tbox.by_iri):
        members = _category_members(tbox, terms, sense_classes, default, taxonomy, home_classes)
    return make_lexicon(tbox, terms, sense_classes, members, default, home_classes)


def make_lexicon(
    tbox: TBox,
    terms: Mapping[str, Term],
    sense_classes: Mapping[int, AlignedClass],
    category_members: Mapping[int, Sequence[CategoryMember]],
    default_class: ClassIRI | None,
    home_classes: frozenset[ClassIRI],
) -> Lexicon:
    """Return a lexicon with the data derived from its terms and its default class."""
    return Lexicon(
        terms=terms,
        sense_classes=sense_classes,
        vocabulary=Counter(" ".join(term.text for term in terms.values()).split()),
        default_class=default_class,
        general_classes=general_classes_of(tbox, default_class),
        home_classes=home_classes,
        category_members={synset: sorted(set(members)) for synset, members in category_members.items()},
    )


def general_classes_of(tbox: TBox, default_class: ClassIRI | None) -> frozenset[ClassIRI]:
    """Return the uninformative classes of a TBox: its roots, and the default class if there is one."""
    return frozenset([*tbox.roots, *filter(None, [default_class])])


def home_classes_of(tbox: TBox, synonyms: Mapping[ClassIRI, tuple[str, ...]]) -> frozenset[ClassIRI]:
    """Return the classes of a TBox that the home vocabulary has synonyms for."""
    return frozenset(synonyms.keys() & tbox.by_iri.keys())


def _own_terms(tbox: TBox, taxonomy: Taxonomy, synonyms: Mapping[ClassIRI, tuple[str, ...]]) -> dict[str, Term]:
    """Return term without spaces → the class it names, by the labels and synonyms of the classes."""
    depths = tbox.depths
    classes = sorted(physical_classes(tbox), key=lambda cls: (depths[cls.iri], cls.iri))
    own = {(text, cls.iri) for cls in classes for text in cls.alt_labels}
    called = {text for text, _ in own}
    terms: dict[str, Term] = {}
    for cls in classes:
        # The class names of the ontology take precedence over memberships in the home vocabulary.
        names = [text for text in synonyms.get(cls.iri, ()) if text not in called or (text, cls.iri) in own]
        for text, kind in _texts_of(cls, names):
            keep_best(terms, Term(cls.iri, normalise_label(text, taxonomy), kind))
            if residue := residue_of(text, taxonomy):
                # “Other furniture” is the class of furniture, unless another class has that label.
                keep_best(terms, Term(cls.iri, residue, TermKind.SYNONYM))
    return terms


def _texts_of(cls: OntologyClass, synonyms: Iterable[str]) -> Iterator[tuple[str, TermKind]]:
    yield cls.label, TermKind.LABEL
    # A local name that is a number (EQP_0000001) says nothing.
    if cls.readable_name == cls.local_name and not has_foreign_name(cls, cls.local_name):
        yield cls.local_name, TermKind.LABEL
    for text in (*cls.alt_labels, *synonyms):
        yield text, TermKind.SYNONYM


def physical_classes(tbox: TBox) -> Sequence[OntologyClass]:
    """Return the classes except those of events, activities and the like; all classes if none are left."""
    events = {cls.iri for cls in tbox.classes if head_noun_of(cls.label) in _EVENT_NOUNS}
    return [cls for cls in tbox.classes if events.isdisjoint(tbox.closure(cls.iri))] or tbox.classes


def _align_terms(tbox: TBox, terms: Mapping[str, Term], taxonomy: Taxonomy) -> dict[int, AlignedClass]:
    """Return synset → class, by the terms and by nouns of the same meaning as labels."""
    sense_classes: dict[int, AlignedClass] = {}
    # “Regal” is a shelf, and no English noun.
    foreign = {term_key(name, taxonomy) for cls in tbox.classes for name in foreign_names_only(cls)}
    common = {key: term for key, term in terms.items() if key not in foreign and _is_common_noun(term, taxonomy)}
    for key, term in common.items():
        if key in taxonomy:
            _align_noun(key, term, tbox, terms, taxonomy, sense_classes)
    for key, term in common.items():
        if term.kind is TermKind.LABEL:
            synonym = term._replace(kind=TermKind.SYNONYM)
            for noun in equivalent_nouns(term.text, taxonomy, is_noun=key in taxonomy):
                _align_noun(noun, synonym, tbox, terms, taxonomy, sense_classes)
    return sense_classes


def _is_common_noun(term: Term, taxonomy: Taxonomy) -> bool:
    """Return whether a term is a common noun, like “CT scanner”, unlike the name “SOLiD system”.

    A synonym that means any object (“artefact”) does not align its class with all objects.
    """
    words = [word for word in term.text.split() if word not in _CONJUNCTIONS]
    is_general = term.kind is not TermKind.LABEL and term.text in GENERAL_NOUNS
    is_spelled_out = len(words) == 1 or min(map(len, words)) > ALIGNMENT.max_code_letters
    return not is_general and (is_spelled_out or taxonomy.is_phrase(term.text.replace(" ", "")))


def _align_noun(
    key: str,
    term: Term,
    tbox: TBox,
    terms: Mapping[str, Term],
    taxonomy: Taxonomy,
    sense_classes: dict[int, AlignedClass],
) -> None:
    """Align senses of a noun with the class of a term: those meant, and with less weight others of their domain."""

    def align(sense: Sense, weight: float) -> None:
        known = sense_classes.get(sense.synset)
        # A synset's first lemma names it best: a bicycle is the class bicycle rather than its superclass cycle.
        is_closer = (
            known is not None
            and known.weight == weight
            and taxonomy.name(sense.synset).replace(" ", "") == key
            and tbox.is_subclass(term.class_iri, known.class_iri)
        )
        if known is None or known.weight < weight or is_closer:
            sense_classes[sense.synset] = AlignedClass(term.class_iri, weight)

    senses = taxonomy.senses(key)
    if len(senses) == 1:
        align(senses[0], term.kind.weight)
        return
    meant = _meant_senses(key, term, tbox, terms, taxonomy) or list(senses)
    domains = {sense.domain for sense in meant}
    others = [sense for sense in senses if sense not in meant and sense.domain in domains]
    for group, trust in ((meant, 1.0), (others, ALIGNMENT.other_sense_weight)):
        best = max((sense_weight(sense) for sense in group), default=1.0)
        for sense in group:
            # The first sense of a natural object is meant, although made objects are more frequent in scenes.
            is_natural_first = group is meant and sense == senses[0] and sense.domain in _NATURAL_DOMAINS
            share = 1.0 if is_natural_first else sense_weight(sense) / best
            if share >= ALIGNMENT.min_sense_ratio:
                align(sense, round(term.kind.weight * share * trust, _WEIGHT_DIGITS))


def _meant_senses(key: str, term: Term, tbox: TBox, terms: Mapping[str, Term], taxonomy: Taxonomy) -> list[Sense]:
    """Return the senses of a term that the ontology means, by the first criterion that any sense meets; or none.

    The criteria: the sense is below the hypernym in the class's sense key; below the label of a superclass; below a
    noun in the class's comment or a superclass's label; below any name of a superclass.
    """
    cls, superclasses = tbox.by_iri[term.class_iri], tbox.closure(term.class_iri)
    hypernyms = {
        sense: [taxonomy.name(up) for up, _ in taxonomy.walk_up(sense.synset)] for sense in taxonomy.senses(key)
    }

    def first_met(*criteria: Callable[[str], bool]) -> list[Sense]:
        met = ([sense for sense, names in hypernyms.items() if any(map(is_met, names))] for is_met in criteria)
        return next(filter(None, met), [])

    def names_superclass(name: str) -> bool:
        named = terms.get(name.replace(" ", ""))
        return named is not None and named.class_iri in superclasses and named.class_iri != cls.iri

    def labels_superclass(name: str) -> bool:
        return name not in _TOP_NOUNS and names_superclass(name) and terms[name.replace(" ", "")].kind is TermKind.LABEL

    sense_key = SENSE_KEY.match(cls.local_name)
    hypernym = sense_key and sense_key[2] and sense_key[2].replace("_", " ")
    described = _description_words(cls, tbox, taxonomy) if term.kind is TermKind.LABEL else frozenset()
    return first_met(
        lambda name: name == hypernym,
        labels_superclass,
        lambda name: (
            name not in _UNSPECIFIC_NOUNS and name.replace(" ", "") != key and described.issuperset(name.split())
        ),
        names_superclass,
    )


def _description_words(cls: OntologyClass, tbox: TBox, taxonomy: Taxonomy) -> frozenset[str]:
    """Return the words of a class's comment and of its superclasses' labels, as written and in the singular."""
    texts = [cls.comment, *(tbox.by_iri[iri].label for iri in tbox.closure(cls.iri) if iri != cls.iri)]
    words = {word for text in texts for word in words_of_label(text)}
    return frozenset(words | {taxonomy.singular(word) for word in words})


def _category_members(
    tbox: TBox,
    terms: Mapping[str, Term],
    sense_classes: Mapping[int, AlignedClass],
    default: ClassIRI | None,
    taxonomy: Taxonomy,
    home_classes: frozenset[ClassIRI],
) -> dict[int, list[CategoryMember]]:
    """Return synset → classes that it is a member of, by `categories.csv` or by the head noun of the label."""
    members: dict[int, list[CategoryMember]] = {}
    aligned = {found.class_iri for found in sense_classes.values()}
    for key, term in terms.items():
        if term.class_iri == default or SENSE_KEY.match(tbox.by_iri[term.class_iri].local_name):
            # The hyponyms of a WordNet sense are those in WordNet.
            continue
        # The synonyms of a home class are kinds of objects, not categories.
        is_own_synonym = term.kind is TermKind.SYNONYM and term.class_iri not in home_classes
        if term.kind is TermKind.LABEL or is_own_synonym:
            for synset, count in members_of(key, taxonomy):
                found = AlignedClass(term.class_iri, term.kind.weight)
                members.setdefault(synset, []).append(CategoryMember(found, count))
        elif term.kind is TermKind.HEAD and term.class_iri not in aligned and (sense := usual_sense(key, taxonomy)):
            found = AlignedClass(term.class_iri, term.kind.weight)
            members.setdefault(sense.synset, []).append(CategoryMember(found, ALIGNMENT.assumed_category_size))
    return members


def _add_head_nouns(terms: dict[str, Term]) -> None:
    """Add the head noun of each two-word label as a term if it is specific and unique among the labels."""
    by_head: dict[str, list[Term]] = {}
    for term in terms.values():
        if term.kind is TermKind.LABEL and " " in term.text:
            by_head.setdefault(term.text.split()[-1], []).append(term)
    for head, named in by_head.items():
        is_unique = len({term.class_iri for term in named}) == 1
        is_specific = head not in terms and head not in _UNSPECIFIC_NOUNS | GENERAL_NOUNS
        if is_unique and is_specific and len(named[0].text.split()) == 2:
            terms[head] = Term(named[0].class_iri, head, TermKind.HEAD)
