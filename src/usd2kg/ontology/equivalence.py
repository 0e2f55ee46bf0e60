"""Named classes that are stated to be the same, of which one is the candidate.

The others give it their labels and synonyms, and their IRIs lead to it.
"""

from usd2kg.ontology.axioms import LABELS, ClassAxioms
from usd2kg.ontology.scope import ancestors

__all__ = ["all_equivalents", "keep_one_of_each"]


def all_equivalents(iri: str, closure: ClassAxioms) -> set[str]:
    """Return the other named classes that are equivalent to a class, over any number of statements."""
    return ancestors(closure.equivalents, iri)


def keep_one_of_each(scope: set[str], ontology_iri: str, own: ClassAxioms, closure: ClassAxioms) -> set[str]:
    """Return `scope` with one class of each group of equivalents.

    It is chosen by the first of these that tells them apart: it is in the namespace of the named ontology, the named
    file declares it, the file makes it a subclass or superclass, it has a label, its IRI is the smallest.

    Args:
        scope: classes, equivalent ones among them.
        ontology_iri: of the named ontology; what begins with it and `#` or `/` is in its namespace.
        own: axioms of the named file.
        closure: axioms of the file with its imports.
    """
    stem = ontology_iri.rstrip("#/")
    namespaces = (f"{stem}#", f"{stem}/")
    linked = own.linked()

    def rank(iri: str) -> tuple[bool, bool, bool, bool, str]:
        has_label = bool(closure.annotations[iri].pick(LABELS))
        return (not iri.startswith(namespaces), iri not in own.declared, iri not in linked, not has_label, iri)

    return {min({iri, *all_equivalents(iri, closure)} & scope, key=rank) for iri in scope}
