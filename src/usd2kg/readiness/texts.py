"""Labels, synonyms and definitions that are missing, say nothing, or are shared."""

from collections.abc import Iterable, Iterator

import pyoxigraph as ox

from usd2kg.ontology import LABELS, OntologyClass, TBox, compact_iri
from usd2kg.validation import Finding, Severity
from usd2kg.words import split_identifier

__all__ = ["Texts", "about", "find_text_faults"]


class Texts:
    """Which classes have a label of their own: a TBox takes the end of the IRI where there is none."""

    def __init__(self, triples: Iterable[ox.Triple]) -> None:
        self._labelled = {
            triple.subject.value
            for triple in triples
            if triple.predicate.value in LABELS and isinstance(triple.subject, ox.NamedNode)
        }

    def has_label(self, cls: OntologyClass) -> bool:
        """Return whether the class or one of its equivalents has a label."""
        return not self._labelled.isdisjoint((cls.iri, *cls.equivalents))


def about(cls: OntologyClass, severity: Severity, rule: str, found: str, expected: str, advice: str) -> Finding:
    """Return a finding about a class."""
    return Finding(severity, rule, f"“{cls.label}” ({compact_iri(cls.iri)})", "", cls.iri, found, expected, advice)


def find_text_faults(tbox: TBox, texts: Texts) -> Iterator[Finding]:
    """Yield what is wrong with the texts of classes."""
    for cls in tbox.classes:
        if not texts.has_label(cls):
            yield _unlabelled(cls)
        if not cls.comment:
            yield about(
                cls,
                Severity.NOTE,
                "no-definition",
                "no definition or comment",
                "a sentence that says what the class holds",
                "Add a skos:definition or an rdfs:comment: it tells grounders which sense of a word is meant.",
            )
    yield from _shared(tbox)


def _unlabelled(cls: OntologyClass) -> Finding:
    parts = split_identifier(cls.local_name)
    letters = [part for part in parts if not part.isdigit()]
    is_number = len(letters) < len(parts) and all(len(part) == 1 or part.isupper() for part in letters)
    if parts and not is_number:
        found = f"no label; its IRI is read as “{' '.join(parts).lower()}”"
        advice = "Add an rdfs:label, with the words that people use for the thing."
        return about(cls, Severity.NOTE, "no-label", found, "an rdfs:label or a skos:prefLabel", advice)
    return about(
        cls,
        Severity.ERROR,
        "no-name",
        f"no label, and the IRI ends in “{cls.local_name}”, which says nothing",
        "an rdfs:label or a skos:prefLabel",
        "Add a label; if the labels are in another document, put it beside this one, or name it in catalog-v001.xml.",
    )


def _shared(tbox: TBox) -> Iterator[Finding]:
    """Yield the names that several classes have, none of which is above the others."""
    named: dict[str, list[OntologyClass]] = {}
    for cls in tbox.classes:
        for text in dict.fromkeys(" ".join(split_identifier(name)).lower() for name in (cls.label, *cls.alt_labels)):
            if text:
                named.setdefault(text, []).append(cls)
    for text, classes in sorted(named.items()):
        first, *others = classes
        if others:
            names = ", ".join(f"“{cls.label}” ({compact_iri(cls.iri)})" for cls in others)
            yield about(
                first,
                Severity.WARNING,
                "shared-name",
                f"“{text}” is a name of {names} too",
                "names of its own",
                "Keep it for one of them, or state that they are equivalent: objects called so go to one of them.",
            )
