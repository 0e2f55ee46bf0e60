"""Which classes are candidates for objects.

By default: every class that the named file itself places in the hierarchy, as child, as parent or as the
equivalent of another, and that is a physical thing. "The file's own classes" would be wrong: SOMA-HOME uses
Appliance, Room and the Designed… classes that SOMA declares.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping

from usd2kg.errors import OntologyError
from usd2kg.ontology.axioms import TOP_CLASSES, ClassAxioms
from usd2kg.ontology.levels import level, reachable

__all__ = ["ancestors", "default_scope", "nearest_parents", "rooted_scope", "standing_alone"]

PHYSICAL_ROOTS = (
    "http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#PhysicalObject",
    "http://purl.obolibrary.org/obo/BFO_0000040",  # material entity
    "https://spec.industrialontologies.org/ontology/core/Core/MaterialArtifact",
)
"""Upper-level classes below which physical things lie."""


def ancestors(superclasses: Mapping[str, set[str]], iri: str) -> set[str]:
    """Return all superclasses of a class, itself left out; cycles do no harm."""
    return reachable(superclasses, [iri]) - {iri}


def default_scope(own: ClassAxioms, closure: ClassAxioms) -> set[str]:
    """Return the classes that `own` places in the hierarchy and that `closure` says are physical.

    Where nothing that the file places lies below a known upper-level class of physical things, all are kept.
    """
    # A flat list of classes has no hierarchy to place them in.
    placed = (own.linked() or own.classes) | set(own.equivalents)
    placed = {iri for iri in placed if not closure.annotations[iri].is_deprecated}
    superclasses = closure.superclasses()
    subclasses = _turned(superclasses)
    physical: set[str] = set()
    for root in PHYSICAL_ROOTS:
        # What is the same as an upper-level class is as general as that, and no more a candidate.
        physical |= reachable(subclasses, [root]) - {root, *ancestors(superclasses, root)}
    return placed & physical or placed


def standing_alone(own: ClassAxioms, closure: ClassAxioms) -> set[str]:
    """Return the classes that `default_scope` leaves out because no document of the closure says where they belong.

    Those that are said to be dispositions belong to the things that have them.
    """
    if not own.linked():
        return set()
    placed = own.linked().union(own.equivalents, closure.superclasses(), *closure.dispositions.values())
    unplaced = own.classes - placed - TOP_CLASSES
    return {iri for iri in unplaced if not closure.annotations[iri].is_deprecated}


def _turned(superclasses: Mapping[str, set[str]]) -> dict[str, set[str]]:
    """Return class → its direct subclasses."""
    subclasses: dict[str, set[str]] = defaultdict(set)
    for iri, parents in superclasses.items():
        for parent in parents:
            subclasses[parent].add(iri)
    return subclasses


def rooted_scope(roots: Iterable[str], closure: ClassAxioms) -> set[str]:
    """Return the given classes with everything below them.

    Raises:
        OntologyError: a root is no class of the ontology.
    """
    wanted = set(roots)
    unknown = sorted(wanted - closure.classes)
    if unknown:
        raise OntologyError(
            f"scope: <{unknown[0]}> is no class of the ontology; expected the IRI or CURIE of one of its "
            "classes, as `usd2kg ontology scope FILE` lists them"
        )
    below = reachable(_turned(closure.superclasses()), wanted) & closure.classes
    return wanted | {iri for iri in below if not closure.annotations[iri].is_deprecated}


def nearest_parents(scope: set[str], superclasses: Mapping[str, set[str]]) -> dict[str, tuple[str, ...]]:
    """Return for each class in scope its nearest superclasses in scope, sorted.

    Superclasses outside the scope are passed through. Edges of a cycle are dropped, so the result is acyclic.
    """
    levels = level({**dict.fromkeys(scope, ()), **superclasses})
    inside = [tuple(iri for iri in group if iri in scope) for group in levels.groups]
    nearest: dict[int, set[int]] = {}
    for group, above in enumerate(levels.above):
        # Those above come first, so what lies nearest to a group outside the scope is known.
        found: set[int] = set().union(*({up} if inside[up] else nearest[up] for up in above))
        higher = reachable(nearest, found) if len(found) > 1 else set()
        nearest[group] = found - higher
    return {
        iri: tuple(sorted(up for near in nearest[group] for up in inside[near]))
        for group, members in enumerate(inside)
        for iri in members
    }
