"""Scope: the classes that are candidates for objects.

The default scope holds every class that the given file itself places in the hierarchy (as subclass, superclass or
equivalent) and that is a physical object, and those of an import that it extends. The classes declared in the file
would be the wrong set: SOMA-HOME uses Appliance, Room and the Designed… classes, which SOMA declares.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping

from usd2kg.errors import OntologyError
from usd2kg.knowledge import word_set
from usd2kg.ontology.class_axioms import TOP_CLASSES, ClassAxioms
from usd2kg.ontology.components import find_components, reachable
from usd2kg.ontology.model import local_name
from usd2kg.ontology.namespaces import DUL, OBO

__all__ = ["ancestors", "default_scope", "isolated_classes", "nearest_parents", "rooted_scope"]

_GENERAL_NOUNS = word_set("lexical", "general_nouns")
PHYSICAL_ROOTS = (
    f"{DUL}PhysicalObject",
    f"{OBO}BFO_0000040",  # material entity
    "https://spec.industrialontologies.org/ontology/core/Core/MaterialArtifact",
)
"""Classes of physical objects in upper ontologies."""


def ancestors(superclasses: Mapping[str, set[str]], iri: str) -> set[str]:
    """Return all proper superclasses of a class; the hierarchy may be cyclic."""
    return reachable(superclasses, [iri]) - {iri}


def default_scope(own: ClassAxioms, closure: ClassAxioms, imported: Iterable[ClassAxioms] = ()) -> set[str]:
    """Return the classes that `own` places in the hierarchy and that `closure` classifies as physical objects.

    If none is below a class of `PHYSICAL_ROOTS`, all are kept. A document extends an import that places more classes,
    one of which it uses; the classes of that import are then in scope, too.
    """
    superclasses = closure.superclasses()
    subclasses = _invert(superclasses)
    physical: set[str] = set()
    for root in PHYSICAL_ROOTS:
        # Equivalents of a root are as general as the root, and not candidates.
        physical |= reachable(subclasses, [root]) - {root, *ancestors(superclasses, root)}
    placed = _placed(own, closure)
    scope = placed & physical or placed
    others = [_placed(axioms, closure) & physical if physical else _placed(axioms, closure) for axioms in imported]
    extended = (found for found in others if len(found) > len(scope) and (not scope or found & scope))
    return scope.union(*extended)


def _placed(axioms: ClassAxioms, closure: ClassAxioms) -> set[str]:
    # A flat list of classes has no subclass axioms.
    placed = (axioms.linked() or axioms.classes) | set(axioms.equivalents) | _general_classes(axioms)
    return {iri for iri in placed if not closure.annotations[iri].is_deprecated}


def _general_classes(own: ClassAxioms) -> set[str]:
    """Return the classes of objects in general (`bot:Element`) in a namespace of the hierarchy.

    They cover what no other class does, and have no subclasses where these are left to other ontologies.
    """
    namespaces = {iri.removesuffix(local_name(iri)) for iri in own.linked()}
    return {
        iri
        for iri in own.declared - own.linked()
        if local_name(iri).lower() in _GENERAL_NOUNS and iri.removesuffix(local_name(iri)) in namespaces
    }


def isolated_classes(own: ClassAxioms, closure: ClassAxioms) -> set[str]:
    """Return the classes that `default_scope` excludes because no document of the closure places them.

    Dispositions are not reported: they belong to the objects that have them.
    """
    if not own.linked():
        return set()
    placed = own.linked().union(
        own.equivalents, _general_classes(own), closure.superclasses(), *closure.dispositions.values()
    )
    isolated = own.classes - placed - TOP_CLASSES
    return {iri for iri in isolated if not closure.annotations[iri].is_deprecated}


def _invert(superclasses: Mapping[str, set[str]]) -> dict[str, set[str]]:
    """Return class → direct subclasses."""
    subclasses: dict[str, set[str]] = defaultdict(set)
    for iri, parents in superclasses.items():
        for parent in parents:
            subclasses[parent].add(iri)
    return subclasses


def rooted_scope(roots: Iterable[str], closure: ClassAxioms) -> set[str]:
    """Return the given classes and all their subclasses.

    Raises:
        OntologyError: a root is not a class of the ontology.
    """
    wanted = set(roots)
    unknown = sorted(wanted - closure.classes)
    if unknown:
        raise OntologyError(
            f"scope: <{unknown[0]}> is not a class of the ontology; expected the IRI, CURIE, local name or label "
            "of one of its classes, as `usd2kg ontology scope FILE` lists them"
        )
    below = reachable(_invert(closure.superclasses()), wanted) & closure.classes
    return wanted | {iri for iri in below if not closure.annotations[iri].is_deprecated}


def nearest_parents(scope: set[str], superclasses: Mapping[str, set[str]]) -> dict[str, tuple[str, ...]]:
    """Return for each class in scope its nearest superclasses in scope, sorted.

    Superclasses outside the scope are skipped. Edges within a cycle are dropped, so the result is acyclic.
    """
    components = find_components({**dict.fromkeys(scope, ()), **superclasses})
    inside = [tuple(iri for iri in members if iri in scope) for members in components.members]
    nearest: dict[int, set[int]] = {}
    for component, above in enumerate(components.above):
        # Components are sorted top-down, so the nearest ones above are known.
        found: set[int] = set().union(*({up} if inside[up] else nearest[up] for up in above))
        higher = reachable(nearest, found) if len(found) > 1 else set()
        nearest[component] = found - higher
    return {
        iri: tuple(sorted(up for near in nearest[component] for up in inside[near]))
        for component, members in enumerate(inside)
        for iri in members
    }
