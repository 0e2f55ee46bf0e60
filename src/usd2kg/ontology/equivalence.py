"""Equivalent named classes: one represents the group.

The representative takes over the labels and synonyms of the others, and their IRIs resolve to it.
"""

from usd2kg.ontology.class_axioms import LABELS, ClassAxioms
from usd2kg.ontology.scope import ancestors

__all__ = ["all_equivalents", "choose_representatives"]


def all_equivalents(iri: str, closure: ClassAxioms) -> set[str]:
    """Return the other named classes that are equivalent to a class, transitively."""
    return ancestors(closure.equivalents, iri)


def choose_representatives(scope: set[str], ontology_iri: str, own: ClassAxioms, closure: ClassAxioms) -> set[str]:
    """Return `scope` with one representative per group of equivalent classes.

    The first criterion that distinguishes them decides: in the namespace of the ontology, declared in the file, used in
    a subclass axiom of the file, labelled, smallest IRI.

    Args:
        scope: classes, possibly equivalent ones among them.
        ontology_iri: IRI of the ontology; followed by `#` or `/`, it is the namespace.
        own: axioms of the file.
        closure: axioms of the file with its imports.
    """
    stem = ontology_iri.rstrip("#/")
    namespaces = (f"{stem}#", f"{stem}/")
    linked = own.linked()

    def rank(iri: str) -> tuple[bool, bool, bool, bool, str]:
        has_label = bool(closure.annotations[iri].preferred_text(LABELS))
        return (not iri.startswith(namespaces), iri not in own.declared, iri not in linked, not has_label, iri)

    return {min({iri, *all_equivalents(iri, closure)} & scope, key=rank) for iri in scope}
