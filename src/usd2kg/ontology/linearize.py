"""The TBox as text: the study's flat list, and a tree that keeps the hierarchy."""

from usd2kg.ontology.model import OntologyClass, TBox

__all__ = ["linearize_flat", "linearize_tree"]


def linearize_flat(tbox: TBox) -> str:
    """Return one class a line, alphabetical: `Bowl (subClassOf: Crockery) -- A dish for…`."""
    lines = [_flat_line(cls, tbox) for cls in sorted(tbox.classes, key=lambda cls: (cls.local_name, cls.iri))]
    return "\n".join(lines) + "\n"


def _flat_line(cls: OntologyClass, tbox: TBox) -> str:
    parents = ", ".join(sorted(tbox.by_iri[parent].local_name for parent in cls.parents))
    line = f"{cls.local_name} (subClassOf: {parents})" if parents else cls.local_name
    return f"{line} -- {cls.comment}" if cls.comment else line


def linearize_tree(tbox: TBox, *, with_comments: bool = False) -> str:
    """Return the classes indented below their superclasses.

    A class with several superclasses stands under each; what is below it is written out once, and later
    occurrences end in `(see above)`.
    """
    lines: list[str] = []
    written: set[str] = set()

    def write(iri: str, depth: int) -> None:
        cls = tbox.by_iri[iri]
        repeats = iri in written and bool(tbox.children[iri])
        comment = f" -- {cls.comment}" if with_comments and cls.comment and iri not in written else ""
        lines.append("  " * depth + cls.local_name + comment + (" (see above)" if repeats else ""))
        if not repeats:
            written.add(iri)
            for child in sorted(tbox.children[iri], key=lambda key: tbox.by_iri[key].local_name):
                write(child, depth + 1)

    for root in sorted(tbox.roots, key=lambda key: tbox.by_iri[key].local_name):
        write(root, 0)
    return "\n".join(lines) + "\n"
