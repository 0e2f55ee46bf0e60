"""check_ontology: whether an ontology has what grounding needs."""

from collections.abc import Mapping
from dataclasses import dataclass

from usd2kg.ontology import TBox, read_closure
from usd2kg.readiness.class_senses import ClassSenses, find_sense_faults
from usd2kg.readiness.hierarchy import find_hierarchy_faults
from usd2kg.readiness.labels import LabelIndex, find_label_faults
from usd2kg.validation import AxiomIndex, Finding, sort_findings

__all__ = ["OntologyReport", "check_ontology"]


@dataclass(frozen=True)
class OntologyReport:
    """Counts and findings for an ontology; only classes in scope are counted, unless stated otherwise."""

    source: str
    classes: int
    """Classes in scope."""
    documents: int
    """The ontology and those of its imports that were found."""
    labelled: int
    """Classes with a label of their own."""
    described: int
    """Classes with a definition or comment."""
    with_synonyms: int
    """Classes with more than one name."""
    meant: int
    """Classes aligned with a synset, a category of synsets, or a list of names."""
    found_by_name: int
    """Classes that the default grounder returns for an object whose only evidence is the best name of the class."""
    roots: int
    depth: int
    """Number of edges of the longest path from a class to a root."""
    several_parents: int
    """Classes with more than one superclass."""
    deprecated: int
    """Deprecated classes in all documents; they are not candidates."""
    default: str | None
    """IRI of the residual class, which an object without evidence gets; None if there is none."""
    findings: tuple[Finding, ...]
    """Most severe first, grouped by rule."""

    def counts(self) -> Mapping[str, int]:
        """Return the counts by name."""
        return {name: value for name, value in self.__dict__.items() if isinstance(value, int)}


def check_ontology(tbox: TBox) -> OntologyReport:
    """Return a report on how well objects will ground to a TBox.

    The documents of the TBox are read again, for axioms that a TBox does not hold.

    Raises:
        OntologyError: a document can no longer be read.
    """
    closure = read_closure(tbox)
    axioms, labels, senses = AxiomIndex(closure.triples), LabelIndex(closure.triples), ClassSenses(tbox)
    findings = [*find_label_faults(tbox, labels), *find_hierarchy_faults(tbox, axioms, senses.default)]
    findings += find_sense_faults(tbox, senses)
    return OntologyReport(
        source=tbox.source,
        classes=len(tbox.classes),
        documents=len(closure.documents),
        labelled=sum(labels.has_label(cls) for cls in tbox.classes),
        described=sum(bool(cls.comment) for cls in tbox.classes),
        with_synonyms=sum(bool(cls.alt_labels) for cls in tbox.classes),
        meant=sum(senses.is_known(cls.iri) for cls in tbox.classes),
        found_by_name=sum(iri == answer for iri, answer in senses.answers.items()),
        roots=len(tbox.roots),
        depth=max(tbox.depths.values()),
        several_parents=sum(len(cls.parents) > 1 for cls in tbox.classes),
        deprecated=len(axioms.deprecated & axioms.classes),
        default=senses.default,
        findings=sort_findings(findings),
    )
