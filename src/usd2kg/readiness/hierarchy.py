"""A hierarchy that is flat, cyclic, without a general class, or that nothing can belong to."""

from collections.abc import Iterator

from usd2kg.ontology import ClassIRI, OntologyClass, TBox, compact_iri, local_name
from usd2kg.readiness.texts import about
from usd2kg.validation import Axioms, Finding, Severity

__all__ = ["find_hierarchy_faults"]

_FEW = 8
"""Classes of which a list may be flat."""
_NAMED = 20
"""Classes that are named where many are meant."""
_NOTHING = "http://www.w3.org/2002/07/owl#Nothing"


def find_hierarchy_faults(tbox: TBox, axioms: Axioms, default: ClassIRI | None) -> Iterator[Finding]:
    """Yield what is wrong with the hierarchy.

    Args:
        tbox: the classes.
        axioms: what the documents state.
        default: the class that a thing gets of which nothing is known, if any.
    """
    for note in tbox.notes:
        yield _told(note.code, note.message)
    if len(tbox.classes) >= _FEW and not any(cls.parents for cls in tbox.classes):
        yield _whole(
            tbox,
            "flat",
            f"{len(tbox.classes)} classes, none below another",
            "general classes above special ones",
            "Add rdfs:subClassOf: most things have no class of their own and are grounded to a general one.",
        )
    elif default_fault := _narrow_default(tbox, default):
        yield default_fault
    if tbox.standing_alone:
        yield _left_out(tbox)
    for cls in tbox.classes:
        yield from _unsatisfiable(cls, axioms)
        if cls.iri in axioms.deprecated:
            yield about(
                cls,
                Severity.WARNING,
                "deprecated",
                "a deprecated class in the scope",
                "classes that are in use",
                "Leave it out of the scope: name other roots with --root.",
            )


def _told(code: str, message: str) -> Finding:
    advice = {
        "cycle": "Remove one of the rdfs:subClassOf statements, or state that the classes are equivalent.",
        "missing-import": "Put the document beside the ontology, or name it in catalog-v001.xml.",
    }.get(code, "Mend the ontology.")
    severity = Severity.ERROR if code == "cycle" else Severity.WARNING
    return Finding(severity, code, "", "", "", message, "an ontology that is whole and acyclic", advice)


def _left_out(tbox: TBox) -> Finding:
    named = [local_name(iri) for iri in tbox.standing_alone]
    more = f" and {len(named) - _NAMED} more" if len(named) > _NAMED else ""
    which = f"class{'es' if len(named) > 1 else ''}, neither below nor above another"
    return _whole(
        tbox,
        "stands-alone",
        f"{len(named)} {which}: {', '.join(named[:_NAMED])}{more}",
        "a place in the hierarchy for each class that objects may get",
        "Add rdfs:subClassOf to those that are kinds of things: no object gets one that stands alone.",
        Severity.NOTE,
    )


def _whole(
    tbox: TBox, rule: str, found: str, expected: str, advice: str, severity: Severity = Severity.WARNING
) -> Finding:
    return Finding(severity, rule, tbox.source, "", tbox.ontology_iri, found, expected, advice)


def _narrow_default(tbox: TBox, default: ClassIRI | None) -> Finding | None:
    """Return a finding where a thing of which nothing is known gets no class, or one that most are not below."""
    if default is None:
        gets = f"no class: none of the {len(tbox.roots)} roots is true of things of all kinds"
    else:
        below = sum(tbox.is_subclass(cls.iri, default) for cls in tbox.classes)
        if 2 * below >= len(tbox.classes):
            return None
        name = f"“{tbox.by_iri[default].label}” ({compact_iri(default)})"
        gets = f"{name}, which is above {below} of {len(tbox.classes)} classes"
    return _whole(
        tbox,
        "no-general-class",
        f"a thing that fits nowhere gets {gets}",
        "a general class, such as Artifact, above most others",
        "Add one, or name the branches that objects belong to with --root.",
    )


def _unsatisfiable(cls: OntologyClass, axioms: Axioms) -> Iterator[Finding]:
    clash = axioms.clash(cls.iri, cls.iri)
    if clash is not None:
        found = f"below {axioms.named(clash.first)} and {axioms.named(clash.second)}, which are disjoint"
    elif _NOTHING in axioms.closure(cls.iri):
        found = "stated to be below owl:Nothing"
    else:
        return
    yield about(
        cls,
        Severity.ERROR,
        "unsatisfiable",
        found,
        "a class that something can belong to",
        "Remove one of the superclasses, or the disjointness: an object of this class contradicts the ontology.",
    )
