"""The TBox's words: which terms name a class, and where each class lies in the noun taxonomy."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from usd2kg.grounding.lexical.alignment.class_labels import (
    SENSE_KEY,
    affixes_of,
    head_of,
    phrase_of,
    said_otherwise,
    wordings,
    words_of_label,
)
from usd2kg.grounding.lexical.alignment.home_vocabulary import borrowed_names, lent_names
from usd2kg.grounding.lexical.alignment.residual_class import GENERAL, anchor_default, default_class, residue_of
from usd2kg.grounding.lexical.alignment.terms import HEAD, LABEL, LENT, LESSER, SYNONYM, Anchor, Term, keep_best
from usd2kg.grounding.lexical.concepts.categories import members_of
from usd2kg.grounding.lexical.concepts.senses import sense_weight
from usd2kg.grounding.lexical.concepts.taxonomy import Sense, Taxonomy
from usd2kg.knowledge import read_rows
from usd2kg.ontology import ClassIRI, OntologyClass, TBox, load_home_tbox

__all__ = [
    "Counted",
    "Lexicon",
    "build_lexicon",
    "home_names",
    "things_of",
]

_UNMADE = frozenset(["animal", "object", "person", "plant"])
"""Domains of what nobody made, whose things stand in scenes out of doors."""
_TOP = frozenset("artifact|whole|object|physical entity|entity|abstraction|matter|thing|unit".split("|"))
"""What is above so many meanings that it sets none apart."""
_ABOVE_MANY = _TOP | {
    *("substance", "instrumentality", "part", "device", "equipment", "system", "medium", "series", "arrangement"),
    "group",
}
"""What is above a meaning, and is said in texts about any other too."""
_JOINING = frozenset(["and", "of", "or"])
_SHORTEST_CODE = 2
"""A word of so many letters is a code, in a term of several."""
_HAPPENINGS = frozenset("activity event action process state situation task".split())
"""Head words of classes that no thing belongs to: what is below them is not asked, though it be called `make_bed`."""
_UNTOLD = 0.8
"""The weight of senses of a kind with the one that is meant: two senses of a lamp are both lamps."""
_SOME_THINGS = 3000
"""What is supposed of a class that is known by its head alone."""
_PLAUSIBLE = 0.85
"""A sense that fits this share as well as the best one may be meant too."""


class Counted(NamedTuple):
    """A class that people count things among."""

    anchor: Anchor
    things: int
    """The number of meanings that they count so, of all nouns."""


@dataclass(frozen=True)
class Lexicon:
    """The words of one TBox."""

    terms: Mapping[str, Term]
    """Term without spaces → the class it names."""
    anchors: Mapping[int, Anchor]
    """Synset → the class aligned with it."""
    vocabulary: Mapping[str, int]
    """Single word → the number of terms that hold it."""
    default: ClassIRI | None
    """The class of what has no other, see `default_class`."""
    general: frozenset[ClassIRI]
    """The classes of which little is said by saying that something is of them: the roots, and the default."""
    borrowed: Mapping[str, Term]
    """Term without spaces → the class labelled as what the home vocabulary says is above the thing that is called so.

    For ontologies with other classes, where nothing else is known: that a charger is some appliance.
    """
    listed: frozenset[ClassIRI]
    """The classes whose further terms are known: those of the home vocabulary, if it is used."""
    counted: Mapping[int, Sequence[Counted]]
    """Synset → the classes that people count it among, though the taxonomy does not."""
    kingdoms: frozenset[str]
    """The domains of what nobody made in which the TBox has classes that the home vocabulary does not know."""


@lru_cache(maxsize=1)
def home_names() -> Mapping[ClassIRI, tuple[str, ...]]:
    """Return the names of things by the class of the built-in home TBox that people would choose for them.

    The TBox's own labels and synonyms, and those of `data/home_names.csv`, which is general knowledge of the same kind
    in bulk: what a thing that is called so is.
    """
    home = load_home_tbox()
    names = {cls.iri: [cls.label, *cls.alt_labels] for cls in home.classes}
    by_local_name = {cls.local_name: cls.iri for cls in home.classes}
    for row in read_rows("home_names.csv"):
        names[by_local_name[row["class"]]].append(row["name"])
    return {iri: tuple(found) for iri, found in names.items()}


def build_lexicon(tbox: TBox, taxonomy: Taxonomy, synonyms: Mapping[ClassIRI, tuple[str, ...]]) -> Lexicon:
    """Return the lexicon of a TBox.

    Args:
        tbox: the classes.
        taxonomy: what their terms are aligned with.
        synonyms: further terms by class IRI, beside the TBox's own labels.
    """
    terms = _terms(tbox, taxonomy, synonyms)
    anchors: dict[int, Anchor] = {}
    for key, term in terms.items():
        if key in taxonomy and _is_common_noun(term, taxonomy):
            _anchor(key, term, tbox, terms, taxonomy, anchors)
    for key, term in terms.items():
        if term.weight == LABEL and _is_common_noun(term, taxonomy):
            for noun in said_otherwise(term.text, taxonomy, is_noun=key in taxonomy):
                _anchor(noun, term._replace(weight=SYNONYM), tbox, terms, taxonomy, anchors)
    for key in [key for key, term in terms.items() if _is_lesser_meaning(key, term, taxonomy, anchors)]:
        terms[key] = terms[key]._replace(weight=LESSER)
    listed = frozenset(synonyms.keys() & tbox.by_iri.keys())
    default = default_class(tbox, taxonomy)
    anchor_default(default, tbox, taxonomy, anchors)
    # Last: where other ontologies have classes of their own for what these names say, theirs are meant.
    for class_iri, text in list(lent_names(tbox, terms, anchors, taxonomy, synonyms)):
        keep_best(terms, class_iri, phrase_of(text, taxonomy), LENT)
    _add_heads(terms)
    return Lexicon(
        terms=terms,
        anchors=anchors,
        vocabulary=Counter(" ".join(term.text for term in terms.values()).split()),
        default=default,
        general=frozenset([*tbox.roots, *filter(None, [default])]),
        borrowed=borrowed_names(tbox, terms, default, taxonomy, synonyms),
        listed=listed,
        counted={} if listed.issuperset(tbox.by_iri) else _counted(tbox, terms, anchors, default, taxonomy, listed),
        kingdoms=_kingdoms(terms, anchors, taxonomy, listed),
    )


def _terms(tbox: TBox, taxonomy: Taxonomy, synonyms: Mapping[ClassIRI, tuple[str, ...]]) -> dict[str, Term]:
    """Return term without spaces → the class it names, by the labels and synonyms of the classes alone."""
    affixes, depths = affixes_of(tbox, taxonomy), tbox.depths
    terms: dict[str, Term] = {}
    bare: dict[str, set[ClassIRI]] = {}
    for cls in sorted(things_of(tbox), key=lambda cls: (depths[cls.iri], cls.iri)):
        for text, weight in _texts(cls, synonyms.get(cls.iri, ())):
            said = phrase_of(text, taxonomy)
            keep_best(terms, cls.iri, said, weight)
            # Other furniture is furniture, but for that with a class of its own.
            keep_best(terms, cls.iri, residue_of(text, taxonomy) or "", min(weight, SYNONYM))
            first, _, rest = said.partition(" ")
            if rest and first in affixes:
                bare.setdefault(rest, set()).add(cls.iri)
    for rest, claimants in bare.items():
        if len(claimants) == 1 and rest not in _ABOVE_MANY | GENERAL:
            # The components of five vendors are no component as such, and a shading device is not what any device is.
            keep_best(terms, next(iter(claimants)), rest, LABEL)
    return terms


def _is_common_noun(term: Term, taxonomy: Taxonomy) -> bool:
    """Return whether a term is a common noun: a CT scanner is one, the SOLiD of a system's name is no solid.

    What is but a synonym and means anything at all (`artefact`) does not make the class that of all things.
    """
    words = [word for word in term.text.split() if word not in _JOINING]
    is_general = term.weight < LABEL and term.text in GENERAL
    is_spelled_out = len(words) == 1 or min(map(len, words)) > _SHORTEST_CODE
    return not is_general and (is_spelled_out or taxonomy.is_phrase(term.text.replace(" ", "")))


def _kingdoms(
    terms: Mapping[str, Term], anchors: Mapping[int, Anchor], taxonomy: Taxonomy, listed: frozenset[ClassIRI]
) -> frozenset[str]:
    return frozenset(
        sense.domain
        for key, term in terms.items()
        if term.weight == LABEL and term.class_iri not in listed
        for sense in taxonomy.senses(key)[:1]
        if sense.domain in _UNMADE and sense.synset in anchors and anchors[sense.synset].class_iri == term.class_iri
    )


def _is_lesser_meaning(key: str, term: Term, taxonomy: Taxonomy, anchors: Mapping[int, Anchor]) -> bool:
    """Return whether a label is meant as nothing made, though its word means that first: a screwdriver, the drink."""
    senses = taxonomy.senses(key)
    usual = max(senses, key=sense_weight, default=None)
    if term.weight != LABEL or usual is None or usual.domain != "artifact":
        return False
    own = [sense for sense in senses if sense.synset in anchors and anchors[sense.synset].class_iri == term.class_iri]
    return bool(own) and all(sense.domain != "artifact" for sense in own)


def _counted(
    tbox: TBox,
    terms: Mapping[str, Term],
    anchors: Mapping[int, Anchor],
    default: ClassIRI | None,
    taxonomy: Taxonomy,
    listed: frozenset[ClassIRI],
) -> dict[int, list[Counted]]:
    """Return synset → the classes whose names say that people count it among them, but for the default."""
    found: dict[int, list[Counted]] = {}
    placed = {anchor.class_iri for anchor in anchors.values()}
    for key, term in terms.items():
        if term.class_iri == default or SENSE_KEY.match(tbox.by_iri[term.class_iri].local_name):
            # What is a kind of a sense of WordNet is for WordNet to say.
            continue
        if term.weight == LABEL or (term.weight >= SYNONYM and term.class_iri not in listed):
            # Of the many names of things of the home vocabulary none is a kind that people count things among.
            told = next(filter(None, (list(members_of(said, taxonomy)) for said in wordings(term.text, taxonomy))), [])
            for synset, things in told:
                found.setdefault(synset, []).append(Counted(Anchor(term.class_iri, term.weight), things))
        elif term.weight == HEAD and term.class_iri not in placed:
            # Of a built structure nothing is known but that it is a structure.
            for sense in sorted(taxonomy.senses(key), key=sense_weight)[-1:]:
                found.setdefault(sense.synset, []).append(Counted(Anchor(term.class_iri, HEAD), _SOME_THINGS))
    return found


def things_of(tbox: TBox) -> Sequence[OntologyClass]:
    """Return the classes that things belong to: those of activities, events and the like are left out."""
    happenings = {cls.iri for cls in tbox.classes if head_of(cls.label) in _HAPPENINGS}
    return [cls for cls in tbox.classes if happenings.isdisjoint(tbox.closure(cls.iri))] or tbox.classes


def _texts(cls: OntologyClass, synonyms: tuple[str, ...]) -> Iterator[tuple[str, float]]:
    yield cls.label, LABEL
    yield cls.local_name, LABEL
    for text in (*cls.alt_labels, *synonyms):
        yield text, SYNONYM


def _add_heads(terms: dict[str, Term]) -> None:
    """Let the last word of a two-word label stand for the class, where no other label ends with it."""
    by_head: dict[str, list[Term]] = {}
    for term in terms.values():
        if term.weight == LABEL and " " in term.text:
            by_head.setdefault(term.text.split()[-1], []).append(term)
    for head, named in by_head.items():
        is_unique = len({term.class_iri for term in named}) == 1
        is_special = head not in terms and head not in _ABOVE_MANY | GENERAL
        if is_unique and is_special and len(named[0].text.split()) == 2:
            terms[head] = Term(named[0].class_iri, head, HEAD)


def _meant(key: str, term: Term, tbox: TBox, terms: Mapping[str, Term], taxonomy: Taxonomy) -> list[Sense]:
    """Return the senses of a term that the ontologist meant, if any can be told.

    Those below what the class's IRI names after the sense; else those below the label of a superclass; else those
    below something that the class's text speaks of; else those below any name of a superclass.
    """
    cls, above = tbox.by_iri[term.class_iri], tbox.closure(term.class_iri)
    names = {sense: [taxonomy.name(up) for up, _ in taxonomy.walk_up(sense.synset)] for sense in taxonomy.senses(key)}

    def below(*groups: Callable[[str], bool]) -> list[Sense]:
        found = ([sense for sense, up in names.items() if any(map(is_told, up))] for is_told in groups)
        return next(filter(None, found), [])

    def is_named(name: str) -> bool:
        named = terms.get(name.replace(" ", ""))
        return named is not None and named.class_iri in above and named.class_iri != cls.iri

    hint = SENSE_KEY.match(cls.local_name)
    told = hint and hint[2] and hint[2].replace("_", " ")
    said = _said_of(cls, tbox, taxonomy) if term.weight == LABEL else frozenset()
    return below(
        lambda name: name == told,
        lambda name: name not in _TOP and is_named(name) and terms[name.replace(" ", "")].weight == LABEL,
        lambda name: name not in _ABOVE_MANY and name.replace(" ", "") != key and said.issuperset(name.split()),
        is_named,
    )


def _said_of(cls: OntologyClass, tbox: TBox, taxonomy: Taxonomy) -> frozenset[str]:
    """Return the words, in the singular, of a class's text and of its superclasses' labels."""
    texts = [cls.comment, *(tbox.by_iri[iri].label for iri in tbox.closure(cls.iri) if iri != cls.iri)]
    words = {word for text in texts for word in words_of_label(text)}
    return frozenset(words | {taxonomy.singular(word) for word in words})


def _anchor(
    key: str, term: Term, tbox: TBox, terms: Mapping[str, Term], taxonomy: Taxonomy, anchors: dict[int, Anchor]
) -> None:
    """Align a term with its senses; those that fit much worse than the best are not meant."""
    senses = taxonomy.senses(key)

    def keep(sense: Sense, weight: float) -> None:
        known = anchors.get(sense.synset)
        # A bicycle is what people call a cycle by its first name: where both are classes, the one below is meant.
        is_closer = (
            known is not None
            and known.weight == weight
            and taxonomy.name(sense.synset).replace(" ", "") == key
            and tbox.is_subclass(term.class_iri, known.class_iri)
        )
        if known is None or known.weight < weight or is_closer:
            anchors[sense.synset] = Anchor(term.class_iri, weight)

    if len(senses) == 1:
        keep(senses[0], term.weight)
        return
    meant = _meant(key, term, tbox, terms, taxonomy) or list(senses)
    domains = {sense.domain for sense in meant}
    others = [sense for sense in senses if sense not in meant and sense.domain in domains]
    for group, trust in ((meant, 1.0), (others, _UNTOLD)):
        best = max((sense_weight(sense) for sense in group), default=1.0)
        for sense in group:
            # Rocks are stones first of all, though of what is found in homes the candy is likelier.
            is_first = group is meant and sense == senses[0] and sense.domain in _UNMADE
            share = 1.0 if is_first else sense_weight(sense) / best
            if share >= _PLAUSIBLE:
                keep(sense, term.weight * share * trust)
