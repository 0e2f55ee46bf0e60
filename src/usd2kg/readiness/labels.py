"""Faults of labels, synonyms and definitions: missing, meaningless or shared."""

from collections.abc import Iterable, Iterator

import pyoxigraph as ox

from usd2kg.ontology import LABELS, OntologyClass, TBox, compact_iri
from usd2kg.validation import Finding, Severity
from usd2kg.words import split_identifier

__all__ = ["LabelIndex", "class_finding", "find_label_faults"]


class LabelIndex:
    """The classes with a label of their own; a TBox falls back to the local name."""

    def __init__(self, triples: Iterable[ox.Triple]) -> None:
        self._labelled = {
            triple.subject.value
            for triple in triples
            if triple.predicate.value in LABELS and isinstance(triple.subject, ox.NamedNode)
        }

    def has_label(self, cls: OntologyClass) -> bool:
        """Return whether the class or one of its equivalents has a label."""
        return not self._labelled.isdisjoint((cls.iri, *cls.equivalents))


def class_finding(cls: OntologyClass, severity: Severity, rule: str, found: str, expected: str, advice: str) -> Finding:
    """Return a finding about a class."""
    return Finding(severity, rule, f"“{cls.label}” ({compact_iri(cls.iri)})", "", cls.iri, found, expected, advice)


def find_label_faults(tbox: TBox, labels: LabelIndex) -> Iterator[Finding]:
    """Yield the faults of labels and definitions."""
    for cls in tbox.classes:
        if not labels.has_label(cls):
            yield _unlabelled(cls)
        if not cls.comment:
            yield class_finding(
                cls,
                Severity.NOTE,
                "no-definition",
                "no definition or comment",
                "a sentence that defines the class",
                "Add a skos:definition or an rdfs:comment: it disambiguates the labels.",
            )
    yield from _shared(tbox)


def _unlabelled(cls: OntologyClass) -> Finding:
    parts = split_identifier(cls.local_name)
    letters = [part for part in parts if not part.isdigit()]
    is_number = len(letters) < len(parts) and all(len(part) == 1 or part.isupper() for part in letters)
    if parts and not is_number:
        found = f"no label; its IRI is read as “{' '.join(parts).lower()}”"
        advice = "Add an rdfs:label with the common name."
        return class_finding(cls, Severity.NOTE, "no-label", found, "an rdfs:label or a skos:prefLabel", advice)
    return class_finding(
        cls,
        Severity.ERROR,
        "no-name",
        f"no label, and the IRI ends in “{cls.local_name}”, which is meaningless",
        "an rdfs:label or a skos:prefLabel",
        "Add a label; if the labels are in another document, put it next to this one, or list it in catalog-v001.xml.",
    )


def _shared(tbox: TBox) -> Iterator[Finding]:
    """Yield the names that several classes share."""
    named: dict[str, list[OntologyClass]] = {}
    for cls in tbox.classes:
        for text in dict.fromkeys(" ".join(split_identifier(name)).lower() for name in (cls.label, *cls.alt_labels)):
            if text:
                named.setdefault(text, []).append(cls)
    for text, classes in sorted(named.items()):
        first, *others = classes
        if others:
            names = ", ".join(f"“{cls.label}” ({compact_iri(cls.iri)})" for cls in others)
            yield class_finding(
                first,
                Severity.WARNING,
                "shared-name",
                f"“{text}” is also a name of {names}",
                "unique names",
                "Keep it for one class, or state their equivalence: objects of this name get one of them.",
            )
