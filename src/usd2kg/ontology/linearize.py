"""Linearise a TBox: the flat list of the study, and an indented tree."""

from collections.abc import Iterable

from usd2kg.ontology.model import OntologyClass, TBox

__all__ = ["linearize_flat", "linearize_tree"]


def linearize_flat(tbox: TBox) -> str:
    """Return one class per line, sorted by name: `Bowl (subClassOf: Crockery) -- A dish for…`.

    A class whose IRI ends in a number is shown with its label: `coffee cup [OBO_0001234]`.
    """
    lines = [_flat_line(cls, tbox) for cls in sorted(tbox.classes, key=lambda cls: (cls.readable_name, cls.iri))]
    return "\n".join(lines) + "\n"


def _flat_line(cls: OntologyClass, tbox: TBox) -> str:
    parents = ", ".join(sorted(tbox.by_iri[parent].readable_name for parent in cls.parents))
    line = f"{_title(cls)} (subClassOf: {parents})" if parents else _title(cls)
    return f"{line} -- {cls.comment}" if cls.comment else line


def _title(cls: OntologyClass) -> str:
    name = cls.readable_name
    return name if name == cls.local_name else f"{name} [{cls.local_name}]"


def linearize_tree(tbox: TBox, *, with_comments: bool = False) -> str:
    """Return the classes indented below their superclasses.

    A class with several superclasses appears below each; its subclasses are written once, and later occurrences end in
    `(see above)`.
    """

    def by_name(iris: Iterable[str]) -> list[tuple[str, str]]:
        return sorted((tbox.by_iri[iri].readable_name, iri) for iri in iris)

    lines: list[str] = []
    written: set[str] = set()
    pending = [(iri, 0) for _, iri in reversed(by_name(tbox.roots))]
    while pending:
        iri, depth = pending.pop()
        cls = tbox.by_iri[iri]
        is_repeated = iri in written and bool(tbox.children[iri])
        comment = f" -- {cls.comment}" if with_comments and cls.comment and iri not in written else ""
        lines.append("  " * depth + _title(cls) + comment + (" (see above)" if is_repeated else ""))
        if not is_repeated:
            written.add(iri)
            pending.extend((child, depth + 1) for _, child in reversed(by_name(tbox.children[iri])))
    return "\n".join(lines) + "\n"
