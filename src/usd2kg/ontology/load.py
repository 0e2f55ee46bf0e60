"""load_tbox: from an ontology file to a TBox."""

import hashlib
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from importlib.resources import as_file
from pathlib import Path

from usd2kg.errors import OntologyError
from usd2kg.knowledge import data_file
from usd2kg.ontology.axioms import ALT_LABELS, DEFINITIONS, LABELS, ClassAxioms, merge_axioms
from usd2kg.ontology.documents import Document, close_imports, parse_document
from usd2kg.ontology.equivalence import all_equivalents, keep_one_of_each
from usd2kg.ontology.levels import Levels, level, reachable
from usd2kg.ontology.model import OntologyClass, OntologyNote, TBox, local_name
from usd2kg.ontology.prefixes import expand_curie
from usd2kg.ontology.scope import default_scope, nearest_parents, rooted_scope, standing_alone
from usd2kg.ontology.wikidata import EQUIVALENT_CLASS, item_in, pick_items

__all__ = ["HOME", "load_home_tbox", "load_tbox"]

HOME = "built-in home TBox"
"""`TBox.source` of the TBox that ships with usd2kg."""
_SOMA_HOME = "http://www.ease-crc.org/ont/SOMA-HOME.owl"


def load_tbox(source: Path | str, *, roots: Iterable[str] | None = None, classes: Iterable[str] | None = None) -> TBox:
    """Return the classes of an ontology that objects can be grounded to.

    Args:
        source: an ontology in functional syntax, RDF/XML, OWL/XML, Turtle, N-Triples, JSON-LD or Manchester
            syntax, told apart by content. Imports are read from the catalog or folder beside it.
        roots: IRIs or CURIEs; the scope is these classes and all below them.
        classes: IRIs or CURIEs; the scope is exactly these classes.

    Of equivalent classes in the scope one stays, which `equivalence.keep_one_of_each` chooses.

    Raises:
        OntologyError: the file cannot be read, or no class is in scope.
    """
    return _load(Path(source), str(source), roots, classes)


def load_home_tbox(*, roots: Iterable[str] | None = None) -> TBox:
    """Return the TBox that ships with usd2kg: SOMA-HOME's classes with labels and synonyms of our own.

    With `roots`, only these classes and those below them. It is read once.
    """
    return _load_home(None if roots is None else tuple(roots))


@lru_cache(maxsize=4)
def _load_home(roots: tuple[str, ...] | None) -> TBox:
    with as_file(data_file("home.ttl")) as path:
        # The classes are SOMA-HOME's own, so that is what a graph over them imports.
        return replace(_load(path, HOME, roots, None), ontology_iri=_SOMA_HOME)


def _load(path: Path, name: str, roots: Iterable[str] | None, classes: Iterable[str] | None) -> TBox:
    document = parse_document(path)
    documents, notes = close_imports(document)
    own = document.axioms
    closure = merge_axioms(doc.axioms for doc in documents)
    scope = keep_one_of_each(_scope(name, own, closure, roots, classes), document.iri, own, closure)
    superclasses = closure.superclasses()
    parents = nearest_parents(scope, superclasses)
    levels = level({**dict.fromkeys(scope, ()), **superclasses})
    dispositions = _dispositions(levels, superclasses, closure)
    return TBox(
        source=name,
        ontology_iri=document.iri,
        version_iri=document.version_iri,
        content_hash=_hash(documents),
        classes=tuple(_class(iri, parents[iri], dispositions[levels.group_of[iri]], closure) for iri in sorted(scope)),
        imports=tuple(doc.iri for doc in documents[1:]),
        notes=(*notes, *_cycle_notes(scope, levels, closure)),
        standing_alone=tuple(sorted(standing_alone(own, closure))) if roots is None and classes is None else (),
    )


def _scope(
    name: str,
    own: ClassAxioms,
    closure: ClassAxioms,
    roots: Iterable[str] | None,
    classes: Iterable[str] | None,
) -> set[str]:
    if classes is not None:
        scope = {expand_curie(iri) for iri in classes}
        unknown = sorted(scope - closure.classes)
        if unknown:
            raise OntologyError(f"{name}: <{unknown[0]}> is no class of the ontology; check the list of classes")
    elif roots is not None:
        scope = rooted_scope([expand_curie(iri) for iri in roots], closure)
    else:
        scope = default_scope(own, closure)
    if not scope:
        raise OntologyError(
            f"{name}: no class in scope ({len(closure.classes)} classes found, none placed in a hierarchy); "
            "expected an OWL ontology with classes below its roots; `usd2kg ontology show FILE --root IRI` tries others"
        )
    return scope


def _hash(documents: Iterable[Document]) -> str:
    digests = sorted(document.digest for document in documents)
    return "sha256:" + hashlib.sha256("".join(digests).encode()).hexdigest()


def _class(iri: str, parents: tuple[str, ...], dispositions: tuple[str, ...], closure: ClassAxioms) -> OntologyClass:
    equivalents = sorted(all_equivalents(iri, closure))
    texts = [closure.annotations[same] for same in (iri, *equivalents)]
    label = _label(iri, closure)
    others = {text for said in texts for text in said.all((*LABELS, *ALT_LABELS))}
    others |= {_label(same, closure) for same in equivalents}
    return OntologyClass(
        iri=iri,
        label=label,
        alt_labels=tuple(sorted(others - {label})),
        comment=next((comment for said in texts if (comment := said.pick(DEFINITIONS))), ""),
        parents=parents,
        dispositions=dispositions,
        equivalents=tuple(equivalents),
        wikidata=_wikidata((iri, *equivalents), closure),
    )


def _wikidata(same: Iterable[str], closure: ClassAxioms) -> tuple[str, ...]:
    found: dict[str, set[str]] = {}
    for iri in same:
        item = item_in(iri)
        if item is not None:
            found.setdefault(EQUIVALENT_CLASS, set()).add(item)
        for name, items in closure.annotations[iri].items.items():
            found.setdefault(name, set()).update(items)
    return pick_items(found)


def _label(iri: str, closure: ClassAxioms) -> str:
    return closure.annotations[iri].pick(LABELS) or local_name(iri)


def _dispositions(levels: Levels, superclasses: Mapping[str, set[str]], closure: ClassAxioms) -> list[tuple[str, ...]]:
    """Return for each group of classes the dispositions of its members, inherited ones among them, sorted."""
    stated: list[frozenset[str]] = []
    for group, above in zip(levels.groups, levels.above, strict=True):
        own = {up for iri in group for up in closure.dispositions.get(iri, ())}
        stated.append(frozenset(own).union(*(stated[up] for up in above)))
    # Many classes have the same ones.
    inherited = {some: tuple(sorted(some | reachable(superclasses, some))) for some in set(stated)}
    return [inherited[some] for some in stated]


def _cycle_notes(scope: set[str], levels: Levels, closure: ClassAxioms) -> list[OntologyNote]:
    return [
        OntologyNote("cycle", f"<{iri}> is stated to be a subclass of itself; the edges of that cycle are left out")
        for iri in sorted(scope)
        if any(levels.group_of[iri] == levels.group_of[parent] for parent in _other_parents(iri, closure))
    ]


def _other_parents(iri: str, closure: ClassAxioms) -> set[str]:
    """Return the stated superclasses of a class and its equivalents that are not among them."""
    group = {iri, *all_equivalents(iri, closure)}
    return {parent for same in group for parent in closure.parents.get(same, ())} - group
