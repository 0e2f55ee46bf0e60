"""Faults of senses: classes that the default grounder aligns with no sense, or confuses."""

from collections.abc import Iterator, Mapping
from functools import cached_property

from usd2kg.grounding import ObjectView
from usd2kg.grounding.lexical.alignment.english_labels import in_english
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon, physical_classes
from usd2kg.grounding.lexical.alignment.terms import Term, TermKind, term_key
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import ClassIRI, OntologyClass, TBox, compact_iri
from usd2kg.readiness.labels import class_finding
from usd2kg.validation import Finding, Severity
from usd2kg.words import words_of

__all__ = ["ClassSenses", "find_sense_faults"]


class ClassSenses:
    """The senses that the default grounder aligns with the classes of a TBox."""

    def __init__(self, tbox: TBox) -> None:
        self._tbox = tbox
        self._english = in_english(tbox)
        self._taxonomy = load_taxonomy()
        self._lexicon = build_lexicon(self._english, self._taxonomy, home_names())
        self._aligned = {aligned.class_iri for aligned in self._lexicon.sense_classes.values()}
        self._categories = {
            member.aligned.class_iri
            for members in self._lexicon.category_members.values()
            for member in members
            if member.aligned.weight > TermKind.HEAD.weight
        }

    @property
    def default(self) -> ClassIRI | None:
        """The residual class, which an object without evidence gets."""
        return self._lexicon.default_class

    def is_known(self, iri: ClassIRI) -> bool:
        """Return whether a class is aligned with a synset, is a category of synsets, or has a list of names."""
        return iri in self._aligned or iri in self._categories or iri in self._lexicon.home_classes

    @cached_property
    def names(self) -> Mapping[ClassIRI, str]:
        """Class → best term as a prim name; classes that are not physical objects (activities…) have none."""
        best: dict[ClassIRI, Term] = {}
        for term in self._lexicon.terms.values():
            known = best.get(term.class_iri)
            if known is None or (-term.kind.weight, term.text) < (-known.kind.weight, known.text):
                best[term.class_iri] = term
        return {iri: _as_name(term.text) for iri, term in best.items()}

    @cached_property
    def answers(self) -> Mapping[ClassIRI, ClassIRI | None]:
        """Class with a term → class of an object whose only evidence is that name."""
        views = [(iri, ObjectView(name=name)) for iri, name in self.names.items()]
        found = LexicalGrounder().ground_views(views, self._tbox)
        return {prediction.prim_path: prediction.class_iri for prediction in found}

    def rival(self, cls: OntologyClass) -> Term | None:
        """Return the term of another class that takes precedence for the label of a class; None if there is none."""
        label = self._english.by_iri[cls.iri].label
        return None if cls.iri in self.names else self._lexicon.terms.get(term_key(label, self._taxonomy))

    def common_noun(self, cls: OntologyClass) -> str:
        """Return a noun of the taxonomy among the words of a class; empty if there is none."""
        english = self._english.by_iri[cls.iri]
        for text in (english.label, *english.alt_labels):
            for word in reversed(words_of(text)):
                if (noun := self._taxonomy.singular(word)) in self._taxonomy:
                    return noun
        return ""


def _as_name(text: str) -> str:
    return "".join(word.capitalize() for word in text.split())


def find_sense_faults(tbox: TBox, senses: ClassSenses) -> Iterator[Finding]:
    """Yield the classes that are never an answer, match only exact words, or lose their name to another class."""
    yield from _non_objects(tbox)
    for cls in tbox.classes:
        answer = senses.answers.get(cls.iri, cls.iri)
        if rival := senses.rival(cls):
            yield _lost(cls, _as_name(rival.text), tbox.by_iri[rival.class_iri])
        elif answer is not None and answer != cls.iri:
            yield _lost(cls, senses.names[cls.iri], tbox.by_iri[answer])
        elif cls.iri in senses.names and not senses.is_known(cls.iri):
            yield _no_sense(cls, senses.common_noun(cls))


def _non_objects(tbox: TBox) -> Iterator[Finding]:
    """Yield the topmost classes that are not physical objects: one finding per subtree."""
    physical = {cls.iri for cls in physical_classes(tbox)}
    for cls in tbox.classes:
        if cls.iri not in physical and physical.issuperset(cls.parents):
            below = sum(tbox.is_subclass(other.iri, cls.iri) for other in tbox.classes) - 1
            yield class_finding(
                cls,
                Severity.NOTE,
                "no-things",
                f"not a class of objects, by its name; nothing is grounded to it or to its {below} subclasses",
                "a scope of physical objects",
                "None, if that is correct; otherwise add labels with common nouns.",
            )


def _lost(cls: OntologyClass, name: str, won: OntologyClass) -> Finding:
    return class_finding(
        cls,
        Severity.WARNING,
        "lost-name",
        f"an object called {name} is grounded to “{won.label}” ({compact_iri(won.iri)})",
        "its own class",
        "Give it a label or a skos:altLabel that distinguishes it from the other class.",
    )


def _no_sense(cls: OntologyClass, noun: str) -> Finding:
    hint = f", such as “{noun}”" if noun else ""
    return class_finding(
        cls,
        Severity.NOTE,
        "no-sense",
        "no name is a noun in the taxonomy: only exact matches are grounded to it",
        "a common noun among its labels",
        f"Add a skos:altLabel with a common noun{hint}, if it fits all instances.",
    )
