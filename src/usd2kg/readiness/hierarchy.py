"""Faults of a hierarchy: flat, cyclic, without a general class, or with unsatisfiable classes."""

from collections.abc import Iterator

from usd2kg.ontology import ClassIRI, OntologyClass, TBox, compact_iri, local_name
from usd2kg.ontology.namespaces import OWL
from usd2kg.readiness.labels import class_finding
from usd2kg.readiness.settings import HIERARCHY
from usd2kg.validation import AxiomIndex, Finding, Severity

__all__ = ["find_hierarchy_faults"]

_NOTHING = f"{OWL}Nothing"


def find_hierarchy_faults(tbox: TBox, axioms: AxiomIndex, default: ClassIRI | None) -> Iterator[Finding]:
    """Yield the faults of a hierarchy.

    Args:
        tbox: classes and hierarchy.
        axioms: axioms of all documents.
        default: the residual class, if there is one.
    """
    for note in tbox.notes:
        yield _note_finding(note.code, note.message)
    if len(tbox.classes) >= HIERARCHY.min_flat_classes and not any(cls.parents for cls in tbox.classes):
        yield _ontology_finding(
            tbox,
            "flat",
            f"{len(tbox.classes)} classes without subclass axioms",
            "general classes above specific ones",
            "Add rdfs:subClassOf: most objects have no class of their own and are grounded to a general one.",
        )
    elif default_fault := _narrow_default(tbox, default):
        yield default_fault
    if tbox.isolated:
        yield _isolated(tbox)
    for cls in tbox.classes:
        yield from _unsatisfiable(cls, axioms)
        if cls.iri in axioms.deprecated:
            yield class_finding(
                cls,
                Severity.WARNING,
                "deprecated",
                "a deprecated class in scope",
                "classes that are in use",
                "Exclude it: choose other roots with --root.",
            )


def _note_finding(code: str, message: str) -> Finding:
    advice = {
        "cycle": "Remove one of the rdfs:subClassOf statements, or state that the classes are equivalent.",
        "missing-import": "Put the document next to the ontology, or list it in catalog-v001.xml.",
    }.get(code, "Fix the ontology.")
    severity = Severity.ERROR if code == "cycle" else Severity.WARNING
    return Finding(severity, code, "", "", "", message, "a complete, acyclic ontology", advice)


def _isolated(tbox: TBox) -> Finding:
    named = [local_name(iri) for iri in tbox.isolated]
    omitted = len(named) - HIERARCHY.max_names
    more = f" and {omitted} more" if omitted > 0 else ""
    which = f"class{'es' if len(named) > 1 else ''} without subclass axioms"
    return _ontology_finding(
        tbox,
        "stands-alone",
        f"{len(named)} {which}: {', '.join(named[: HIERARCHY.max_names])}{more}",
        "a place in the hierarchy for each candidate class",
        "Add rdfs:subClassOf to classes of physical objects: no object is grounded to an isolated class.",
        Severity.NOTE,
    )


def _ontology_finding(
    tbox: TBox, rule: str, found: str, expected: str, advice: str, severity: Severity = Severity.WARNING
) -> Finding:
    return Finding(severity, rule, tbox.source, "", tbox.ontology_iri, found, expected, advice)


def _narrow_default(tbox: TBox, default: ClassIRI | None) -> Finding | None:
    """Return a finding if there is no residual class, or if most classes are not below it."""
    if default is None:
        gets = f"no class: none of the {len(tbox.roots)} roots fits objects of all kinds"
    else:
        below = sum(tbox.is_subclass(cls.iri, default) for cls in tbox.classes)
        if below >= HIERARCHY.min_general_share * len(tbox.classes):
            return None
        name = f"“{tbox.by_iri[default].label}” ({compact_iri(default)})"
        gets = f"{name}, which is above {below} of {len(tbox.classes)} classes"
    return _ontology_finding(
        tbox,
        "no-general-class",
        f"an object that fits no class gets {gets}",
        "a general class, such as Artifact, above most others",
        "Add one, or choose the branches that objects belong to with --root.",
    )


def _unsatisfiable(cls: OntologyClass, axioms: AxiomIndex) -> Iterator[Finding]:
    clash = axioms.clash(cls.iri, cls.iri)
    if clash is not None:
        found = f"below {axioms.named(clash.first)} and {axioms.named(clash.second)}, which are disjoint"
    elif _NOTHING in axioms.closure(cls.iri):
        found = "stated to be below owl:Nothing"
    else:
        return
    yield class_finding(
        cls,
        Severity.ERROR,
        "unsatisfiable",
        found,
        "a satisfiable class",
        "Remove one of the superclasses or the disjointness: any instance contradicts the ontology.",
    )
