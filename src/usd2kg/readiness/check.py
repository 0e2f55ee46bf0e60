"""check_ontology: what an ontology has of what grounding needs."""

from collections.abc import Mapping
from dataclasses import dataclass

from usd2kg.ontology import TBox, read_closure
from usd2kg.readiness.hierarchy import find_hierarchy_faults
from usd2kg.readiness.meaning import Meaning, find_unmeant
from usd2kg.readiness.texts import Texts, find_text_faults
from usd2kg.validation import Axioms, Finding, sort_findings

__all__ = ["OntologyReport", "check_ontology"]


@dataclass(frozen=True)
class OntologyReport:
    """What was counted and found in an ontology."""

    source: str
    classes: int
    """Classes in scope."""
    documents: int
    """The ontology's own and those that it imports, as far as they are at hand."""
    labelled: int
    """Classes with a label of their own."""
    described: int
    """Classes with a definition or comment."""
    with_synonyms: int
    """Classes with more than one name."""
    meant: int
    """Classes aligned with a sense of the noun taxonomy, or of which a list of names is known."""
    found_by_name: int
    """Classes that the default grounder answers for an object that bears nothing but their best name."""
    roots: int
    depth: int
    """Steps from the deepest class up to its root."""
    several_parents: int
    """Classes with more than one superclass."""
    deprecated: int
    """Deprecated classes of all documents; they are no candidates."""
    default: str | None
    """IRI of the class that a thing gets of which nothing is known, if it gets one."""
    findings: tuple[Finding, ...]
    """Most serious first, those of one rule together."""

    def counts(self) -> Mapping[str, int]:
        """Return what was counted, by name."""
        return {name: value for name, value in self.__dict__.items() if isinstance(value, int)}


def check_ontology(tbox: TBox) -> OntologyReport:
    """Return how well objects will ground to a TBox.

    The documents that it was read from are read again, for what a TBox does not keep.

    Raises:
        OntologyError: a document cannot be read any more.
    """
    closure = read_closure(tbox)
    axioms, texts, meaning = Axioms(closure.triples), Texts(closure.triples), Meaning(tbox)
    findings = [*find_text_faults(tbox, texts), *find_hierarchy_faults(tbox, axioms, meaning.default)]
    findings += find_unmeant(tbox, meaning)
    return OntologyReport(
        source=tbox.source,
        classes=len(tbox.classes),
        documents=len(closure.documents),
        labelled=sum(texts.has_label(cls) for cls in tbox.classes),
        described=sum(bool(cls.comment) for cls in tbox.classes),
        with_synonyms=sum(bool(cls.alt_labels) for cls in tbox.classes),
        meant=sum(meaning.is_known(cls.iri) for cls in tbox.classes),
        found_by_name=sum(iri == answer for iri, answer in meaning.answers.items()),
        roots=len(tbox.roots),
        depth=max(tbox.depths.values()),
        several_parents=sum(len(cls.parents) > 1 for cls in tbox.classes),
        deprecated=len(axioms.deprecated & axioms.classes),
        default=meaning.default,
        findings=sort_findings(findings),
    )
