"""Equivalent named classes: one represents the group.

The representative takes over the labels and synonyms of the others, and their IRIs resolve to it.
"""

from collections.abc import Mapping

from usd2kg.ontology.class_axioms import LABELS, ClassAxioms
from usd2kg.ontology.components import find_components

__all__ = ["choose_representatives", "equivalence_groups"]


def equivalence_groups(closure: ClassAxioms) -> dict[str, frozenset[str]]:
    """Return class → the named classes equivalent to it, transitively, itself included; only for classes with others.

    All members of a group have the same set, so that a long chain of equivalences stays linear.
    """
    groups = (frozenset(members) for members in find_components(closure.equivalents).members)
    return {iri: group for group in groups if len(group) > 1 for iri in group}


def choose_representatives(
    scope: set[str],
    ontology_iri: str,
    own: ClassAxioms,
    closure: ClassAxioms,
    groups: Mapping[str, frozenset[str]],
) -> set[str]:
    """Return `scope` with one representative per group of equivalent classes.

    The first criterion that distinguishes them decides: in the namespace of the ontology, declared in the file, used in
    a subclass axiom of the file, labelled, smallest IRI.

    Args:
        scope: classes, possibly equivalent ones among them.
        ontology_iri: IRI of the ontology; followed by `#` or `/`, it is the namespace.
        own: axioms of the file.
        closure: axioms of the file with its imports.
        groups: its `equivalence_groups`.
    """
    stem = ontology_iri.rstrip("#/")
    namespaces = (f"{stem}#", f"{stem}/")
    linked = own.linked()

    def rank(iri: str) -> tuple[bool, bool, bool, bool, str]:
        has_label = bool(closure.annotations[iri].preferred_text(LABELS))
        return (not iri.startswith(namespaces), iri not in own.declared, iri not in linked, not has_label, iri)

    distinct = {groups.get(iri, frozenset({iri})) for iri in scope}
    return {min(group & scope, key=rank) for group in distinct}
