"""Class axioms of an ontology as plain dictionaries, independent of its syntax."""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from usd2kg.ontology.namespaces import DCTERMS, OBO, OWL, RDFS, SKOS, SOMA
from usd2kg.ontology.wikidata import is_mapping, item_in

__all__ = [
    "ALT_LABELS",
    "DEFINITIONS",
    "DEPRECATED",
    "HAS_DISPOSITION",
    "LABELS",
    "TOP_CLASSES",
    "Annotations",
    "ClassAxioms",
    "foreign_texts",
    "merge_axioms",
]

_OIO = "http://www.geneontology.org/formats/oboInOwl#"

LABELS = (f"{SKOS}prefLabel", f"{RDFS}label")
ALT_LABELS = (
    f"{SKOS}altLabel",
    f"{SKOS}hiddenLabel",
    f"{OBO}IAO_0000118",
    f"{_OIO}hasExactSynonym",
    f"{_OIO}hasRelatedSynonym",
    f"{_OIO}hasNarrowSynonym",
)
DEFINITIONS = (
    f"{SKOS}definition",
    f"{OBO}IAO_0000115",
    f"{DCTERMS}description",
    "http://purl.org/dc/elements/1.1/description",
    f"{RDFS}comment",
)
DEPRECATED = f"{OWL}deprecated"
HAS_DISPOSITION = f"{SOMA}hasDisposition"
TOP_CLASSES = frozenset({f"{OWL}Thing", f"{RDFS}Resource"})
_NOTHING = f"{OWL}Nothing"


@dataclass
class Annotations:
    """Annotations of one class."""

    texts: dict[str, set[tuple[str, str]]] = field(default_factory=lambda: defaultdict(set))
    """Property IRI → pairs of language tag (may be empty) and text."""
    items: dict[str, set[str]] = field(default_factory=lambda: defaultdict(set))
    """Property IRI → Wikidata items."""
    is_deprecated: bool = False

    def preferred_text(self, properties: Iterable[str]) -> str:
        """Return the text of the first property that has one: English first, then untagged, then any language."""
        for name in properties:
            if self.texts.get(name):
                return min(self.texts[name], key=_language_rank)[1]
        return ""

    def all_texts(self, properties: Iterable[str]) -> set[str]:
        """Return the texts of the properties in all languages."""
        return {text for name in properties for _, text in self.texts.get(name, ())}


def foreign_texts(several: Iterable[Annotations], properties: Sequence[str]) -> dict[str, str]:
    """Return text → tag of those that are tagged with other languages than English, and with no other tag."""
    found: dict[str, set[str]] = defaultdict(set)
    for annotations in several:
        for name in properties:
            for language, text in annotations.texts.get(name, ()):
                found[text].add(language)
    return {text: min(tags) for text, tags in found.items() if all(map(_is_foreign, tags))}


def _is_foreign(tag: str) -> bool:
    return bool(tag) and tag.lower().split("-")[0] != "en"


def _language_rank(tagged: tuple[str, str]) -> tuple[int, str, str]:
    language, text = tagged
    rank = 0 if language.lower().split("-")[0] == "en" else 1 if not language else 2
    return (rank, language, text)


@dataclass
class ClassAxioms:
    """Axioms over named classes."""

    parents: dict[str, set[str]] = field(default_factory=lambda: defaultdict(set))
    """Class → stated named superclasses; class expressions contribute their named conjuncts."""
    equivalents: dict[str, set[str]] = field(default_factory=lambda: defaultdict(set))
    """Class → named classes stated to be equivalent; symmetric, not transitively closed."""
    annotations: dict[str, Annotations] = field(default_factory=lambda: defaultdict(Annotations))
    dispositions: dict[str, set[str]] = field(default_factory=lambda: defaultdict(set))
    """Class → dispositions stated by `hasDisposition some …`."""
    classes: set[str] = field(default_factory=set)
    """All named classes, declared or used."""
    declared: set[str] = field(default_factory=set)
    """The declared ones among them."""
    prefixes: dict[str, str] = field(default_factory=dict)
    """Prefix → namespace, as the document declares them; not merged."""
    ontology_iri: str | None = None
    version_iri: str | None = None
    imports: set[str] = field(default_factory=set)

    def declare(self, iri: str) -> None:
        """Add a class declaration."""
        self.classes.add(iri)
        self.declared.add(iri)

    def add_parent(self, child: str, parent: str) -> None:
        """Add a subclass axiom."""
        self.classes.update({child, parent} - TOP_CLASSES)
        if child != parent and parent not in TOP_CLASSES:
            self.parents[child].add(parent)

    def add_equivalents(self, names: Iterable[str]) -> None:
        """Add an equivalence axiom over named classes."""
        # Equivalence to owl:Thing or owl:Nothing would merge unrelated classes.
        same = set(names) - TOP_CLASSES - {_NOTHING}
        self.classes |= same
        if len(same) > 1:
            # Pairs with the first class suffice: equivalence is transitive, and all pairs would be quadratic.
            first = min(same)
            for name in same - {first}:
                self.equivalents[first].add(name)
                self.equivalents[name].add(first)

    def linked(self) -> set[str]:
        """Return the classes that occur in a subclass axiom."""
        return {iri for child, parents in self.parents.items() for iri in (child, *parents)}

    def superclasses(self) -> dict[str, set[str]]:
        """Return class → its stated superclasses and equivalents.

        C ≡ D is C ⊑ D and D ⊑ C (OWL 2 Structural Specification, section 9.1.2).
        """
        edges = {cls: set(parents) for cls, parents in self.parents.items()}
        for cls, equivalents in self.equivalents.items():
            edges.setdefault(cls, set()).update(equivalents)
        return edges

    def annotate(self, subject: str, name: str, text: str, language: str) -> None:
        """Add an annotation; white space is collapsed."""
        notes = self.annotations[subject]
        if name == DEPRECATED:
            notes.is_deprecated = text.strip().lower() in {"true", "1"}
        else:
            notes.texts[name].add((language, " ".join(text.split())))
            self.link(subject, name, text)

    def link(self, subject: str, name: str, target: str) -> None:
        """Add the IRI that an annotation links to; only Wikidata items that may denote the same class are kept."""
        item = item_in(target)
        if item is not None and is_mapping(name):
            self.annotations[subject].items[name].add(item)


def merge_axioms(several: Iterable[ClassAxioms]) -> ClassAxioms:
    """Return the union of the axioms of several documents."""
    merged = ClassAxioms()
    for axioms in several:
        merged.classes |= axioms.classes
        merged.declared |= axioms.declared
        for cls, parents in axioms.parents.items():
            merged.parents[cls] |= parents
        for cls, equivalents in axioms.equivalents.items():
            merged.equivalents[cls] |= equivalents
        for cls, dispositions in axioms.dispositions.items():
            merged.dispositions[cls] |= dispositions
        for cls, notes in axioms.annotations.items():
            known = merged.annotations[cls]
            known.is_deprecated |= notes.is_deprecated
            for name, texts in notes.texts.items():
                known.texts[name] |= texts
            for name, items in notes.items.items():
                known.items[name] |= items
    return merged
