"""Which classes are candidates for objects.

By default: every class that the named file itself places in the hierarchy, as child, as parent or as the
equivalent of another, and that is a physical thing. "The file's own classes" would be wrong: SOMA-HOME uses
Appliance, Room and the Designed… classes that SOMA declares.
"""

from collections.abc import Iterable, Mapping

from usd2kg.errors import OntologyError
from usd2kg.ontology.axioms import ClassAxioms

__all__ = ["ancestors", "default_scope", "nearest_parents", "rooted_scope"]

PHYSICAL_ROOTS = (
    "http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#PhysicalObject",
    "http://purl.obolibrary.org/obo/BFO_0000040",  # material entity
    "https://spec.industrialontologies.org/ontology/core/Core/MaterialArtifact",
)
"""Upper-level classes below which physical things lie."""


def ancestors(superclasses: Mapping[str, set[str]], iri: str) -> set[str]:
    """Return all superclasses of a class, itself left out; cycles do no harm."""
    found: set[str] = set()
    pending = [iri]
    while pending:
        for parent in superclasses.get(pending.pop(), ()):
            if parent not in found:
                found.add(parent)
                pending.append(parent)
    return found - {iri}


def default_scope(own: ClassAxioms, closure: ClassAxioms) -> set[str]:
    """Return the classes that `own` places in the hierarchy and that `closure` says are physical.

    Where nothing that the file places lies below a known upper-level class of physical things, all are kept.
    """
    # A flat list of classes has no hierarchy to place them in.
    placed = (own.linked() or own.classes) | set(own.equivalents)
    placed = {iri for iri in placed if not closure.annotations[iri].is_deprecated}
    superclasses = closure.superclasses()
    # What is the same as an upper-level class is as general as that, and no more a candidate.
    upper = {root: {root, *ancestors(superclasses, root)} for root in PHYSICAL_ROOTS}
    return {iri for iri in placed if _is_below(iri, upper, superclasses)} or placed


def _is_below(iri: str, roots: Mapping[str, set[str]], superclasses: Mapping[str, set[str]]) -> bool:
    """Return whether a class is below one of `roots` (root → it with all above it) and not the same as it."""
    above = ancestors(superclasses, iri)
    return any(root in above and iri not in stem for root, stem in roots.items())


def rooted_scope(roots: Iterable[str], closure: ClassAxioms) -> set[str]:
    """Return the given classes with everything below them.

    Raises:
        OntologyError: a root is no class of the ontology.
    """
    wanted = set(roots)
    unknown = sorted(wanted - closure.classes)
    if unknown:
        raise OntologyError(
            f"scope: <{unknown[0]}> is no class of the ontology; expected the IRI of one of its classes"
        )
    superclasses = closure.superclasses()
    return wanted | {
        iri
        for iri in closure.classes
        if not closure.annotations[iri].is_deprecated and not ancestors(superclasses, iri).isdisjoint(wanted)
    }


def nearest_parents(scope: set[str], superclasses: Mapping[str, set[str]]) -> dict[str, tuple[str, ...]]:
    """Return for each class in scope its nearest superclasses in scope, sorted.

    Superclasses outside the scope are passed through. Edges of a cycle are dropped, so the result is acyclic.
    """
    above = {iri: ancestors(superclasses, iri) & scope for iri in scope}
    strict = {iri: {up for up in ups if iri not in above[up]} for iri, ups in above.items()}
    return {
        iri: tuple(sorted(up for up in ups if not any(up in strict[other] for other in ups - {up})))
        for iri, ups in strict.items()
    }
