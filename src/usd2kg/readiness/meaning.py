"""Classes that the default grounder does not understand, or confuses."""

from collections.abc import Iterator, Mapping
from functools import cached_property

from usd2kg.grounding import ObjectView
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon, home_names, things_of
from usd2kg.grounding.lexical.alignment.terms import HEAD, Term, term_key
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import ClassIRI, OntologyClass, TBox, compact_iri
from usd2kg.readiness.texts import about
from usd2kg.validation import Finding, Severity
from usd2kg.words import words_of

__all__ = ["Meaning", "find_unmeant"]


class Meaning:
    """What the default grounder makes of the classes of a TBox."""

    def __init__(self, tbox: TBox) -> None:
        self._tbox = tbox
        self._taxonomy = load_taxonomy()
        self._lexicon = build_lexicon(tbox, self._taxonomy, home_names())
        self._anchored = {anchor.class_iri for anchor in self._lexicon.anchors.values()}
        self._counted = {
            counted.anchor.class_iri
            for among in self._lexicon.counted.values()
            for counted in among
            if counted.anchor.weight > HEAD
        }

    @property
    def default(self) -> ClassIRI | None:
        """The class that a thing gets of which nothing is known."""
        return self._lexicon.default

    def is_known(self, iri: ClassIRI) -> bool:
        """Return whether a class is aligned with a sense of a noun, or what it is of is known by its name."""
        return iri in self._anchored or iri in self._counted or iri in self._lexicon.listed

    @cached_property
    def names(self) -> Mapping[ClassIRI, str]:
        """Class → its best term as the name of a prim; classes that no thing belongs to (activities…) have none."""
        best: dict[ClassIRI, Term] = {}
        for term in self._lexicon.terms.values():
            known = best.get(term.class_iri)
            if known is None or (-term.weight, term.text) < (-known.weight, known.text):
                best[term.class_iri] = term
        return {iri: _as_name(term.text) for iri, term in best.items()}

    @cached_property
    def answers(self) -> Mapping[ClassIRI, ClassIRI | None]:
        """Class with a term → the class of an object that bears nothing but that name."""
        views = [(iri, ObjectView(name=name)) for iri, name in self.names.items()]
        found = LexicalGrounder().ground_views(views, self._tbox)
        return {prediction.prim_path: prediction.class_iri for prediction in found}

    def rival(self, cls: OntologyClass) -> Term | None:
        """Return the term of another class that has taken a class's name; None if it has one, or nobody took it."""
        return None if cls.iri in self.names else self._lexicon.terms.get(term_key(cls.label, self._taxonomy))

    def common_noun(self, cls: OntologyClass) -> str:
        """Return a noun of the taxonomy that may say what the class is; empty if none is at hand."""
        for text in (cls.label, *cls.alt_labels):
            for word in reversed(words_of(text)):
                if (noun := self._taxonomy.singular(word)) in self._taxonomy:
                    return noun
        return ""


def _as_name(text: str) -> str:
    return "".join(word.capitalize() for word in text.split())


def find_unmeant(tbox: TBox, meaning: Meaning) -> Iterator[Finding]:
    """Yield the classes that nothing is grounded to, that are known by their exact words alone, or lose their name."""
    yield from _never_asked(tbox)
    for cls in tbox.classes:
        answer = meaning.answers.get(cls.iri, cls.iri)
        if taken := meaning.rival(cls):
            yield _lost(cls, _as_name(taken.text), tbox.by_iri[taken.class_iri])
        elif answer is not None and answer != cls.iri:
            yield _lost(cls, meaning.names[cls.iri], tbox.by_iri[answer])
        elif cls.iri in meaning.names and not meaning.is_known(cls.iri):
            yield _unmeant(cls, meaning.common_noun(cls))


def _never_asked(tbox: TBox) -> Iterator[Finding]:
    """Yield the topmost of the classes that no thing belongs to: one finding for all below them."""
    things = {cls.iri for cls in things_of(tbox)}
    for cls in tbox.classes:
        if cls.iri not in things and things.issuperset(cls.parents):
            below = sum(tbox.is_subclass(other.iri, cls.iri) for other in tbox.classes) - 1
            yield about(
                cls,
                Severity.NOTE,
                "no-things",
                f"no kind of object, by its name; nothing is grounded to it nor to the {below} classes below",
                "a scope of things",
                "Nothing, if that is so; otherwise give it labels with the nouns that people use.",
            )


def _lost(cls: OntologyClass, name: str, won: OntologyClass) -> Finding:
    return about(
        cls,
        Severity.WARNING,
        "lost-name",
        f"an object called {name} is grounded to “{won.label}” ({compact_iri(won.iri)})",
        "its own class",
        "Give it a label or a skos:altLabel that tells it from the other.",
    )


def _unmeant(cls: OntologyClass, noun: str) -> Finding:
    hint = f", such as “{noun}”" if noun else ""
    return about(
        cls,
        Severity.NOTE,
        "no-sense",
        "no name of it is a noun that the taxonomy knows: only its exact words lead to it",
        "a common noun among its labels",
        f"Add as skos:altLabel what people call such a thing in a word{hint}, if that is true of all of them.",
    )
