"""load_tbox: ontology file → TBox."""

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from importlib.resources import as_file
from pathlib import Path

from usd2kg.errors import OntologyError
from usd2kg.knowledge import data_file
from usd2kg.ontology.built_in import BUILT_IN, HOME, PLACES, SOMA_HOME
from usd2kg.ontology.class_axioms import ALT_LABELS, DEFINITIONS, LABELS, ClassAxioms, foreign_texts, merge_axioms
from usd2kg.ontology.components import Components, find_components, reachable
from usd2kg.ontology.documents import Document, close_imports, parse_document
from usd2kg.ontology.equivalence import choose_representatives, equivalence_groups
from usd2kg.ontology.model import OntologyClass, OntologyNote, TBox, local_name
from usd2kg.ontology.prefixes import PREFIX_NAME, expand_curie
from usd2kg.ontology.scope import default_scope, isolated_classes, nearest_parents, rooted_scope
from usd2kg.ontology.wikidata import EQUIVALENT_CLASS, item_in, pick_items
from usd2kg.tracing import traced

__all__ = ["BUILT_IN_NAMES", "load_home_tbox", "load_places_tbox", "load_tbox"]

_NO_OTHER: frozenset[str] = frozenset()


@traced("ontology", lambda tbox: {"classes": len(tbox.classes)})
def load_tbox(source: Path | str, *, roots: Iterable[str] | None = None, classes: Iterable[str] | None = None) -> TBox:
    """Return the candidate classes of an ontology.

    Equivalent classes are represented by one of them, see `equivalence.choose_representatives`.

    Args:
        source: an ontology in functional syntax, RDF/XML, OWL/XML, Turtle, N-Triples, JSON-LD or Manchester
            syntax, detected by content. Imports are resolved by the catalog or in the folder of the file. `home` and
            `places` are the built-in TBoxes, unless a file has that name.
        roots: IRIs or CURIEs; the scope is these classes and all below them.
        classes: IRIs or CURIEs; the scope is exactly these classes.

    Raises:
        OntologyError: the file cannot be read, or no class is in scope.
    """
    if classes is None and str(source) in _LOADERS and not Path(source).is_file():
        return _LOADERS[str(source)](roots=roots)
    return _load(Path(source), str(source), roots, classes)


def load_home_tbox(*, roots: Iterable[str] | None = None) -> TBox:
    """Return the built-in TBox: the classes of SOMA-HOME with labels and synonyms written for this project.

    With `roots`, only these classes and their subclasses. The result is cached.
    """
    return _load_built_in(HOME, None if roots is None else tuple(roots))


def load_places_tbox(*, roots: Iterable[str] | None = None) -> TBox:
    """Return the built-in TBox for offices, shops, warehouses, hospitals, workshops, laboratories and streets.

    It extends the home TBox. With `roots`, only these classes and their subclasses. The result is cached.
    """
    return _load_built_in(PLACES, None if roots is None else tuple(roots))


_LOADERS = {"home": load_home_tbox, "places": load_places_tbox}
BUILT_IN_NAMES = frozenset(_LOADERS)
"""Names that `load_tbox` takes for built-in TBoxes."""


@lru_cache(maxsize=4)
def _load_built_in(name: str, roots: tuple[str, ...] | None) -> TBox:
    with as_file(data_file(BUILT_IN[name])) as path:
        tbox = _load(path, name, roots, None)
    # The classes of the home TBox are those of SOMA-HOME, so a graph over them imports SOMA-HOME.
    return replace(tbox, ontology_iri=SOMA_HOME) if name == HOME else tbox


def _load(path: Path, name: str, roots: Iterable[str] | None, classes: Iterable[str] | None) -> TBox:
    document = parse_document(path)
    documents, notes = close_imports(document)
    own = document.axioms
    closure = merge_axioms(doc.axioms for doc in documents)
    groups = equivalence_groups(closure)
    scope = choose_representatives(_scope(name, documents, closure, roots, classes), document.iri, own, closure, groups)
    superclasses = closure.superclasses()
    parents = nearest_parents(scope, superclasses)
    components = find_components({**dict.fromkeys(scope, ()), **superclasses})
    dispositions = _dispositions(components, superclasses, closure)
    return TBox(
        source=name,
        ontology_iri=document.iri,
        version_iri=document.version_iri,
        content_hash=_hash(documents),
        classes=tuple(
            _class(iri, groups.get(iri, _NO_OTHER), parents[iri], dispositions[components.component_of[iri]], closure)
            for iri in sorted(scope)
        ),
        imports=tuple(doc.iri for doc in documents[1:]),
        notes=(*notes, *_cycle_notes(scope, components, closure, groups)),
        prefixes=_prefixes(own, scope),
        isolated=tuple(sorted(isolated_classes(own, closure))) if roots is None and classes is None else (),
    )


def _prefixes(own: ClassAxioms, scope: Iterable[str]) -> dict[str, str]:
    """Return the document's prefixes for the namespaces of the classes in scope; the first prefix per namespace."""
    namespaces = {iri.removesuffix(local_name(iri)) for iri in scope}
    named = {
        namespace: name
        for name, namespace in sorted(own.prefixes.items(), reverse=True)
        if namespace in namespaces and PREFIX_NAME.fullmatch(name)
    }
    return {name: namespace for namespace, name in sorted(named.items(), key=lambda item: item[1])}


def _scope(
    name: str,
    documents: Sequence[Document],
    closure: ClassAxioms,
    roots: Iterable[str] | None,
    classes: Iterable[str] | None,
) -> set[str]:
    own, *imported = (document.axioms for document in documents)
    if classes is not None:
        scope = {_class_named(name, own, closure) for name in classes}
        unknown = sorted(scope - closure.classes)
        if unknown:
            raise OntologyError(f"{name}: <{unknown[0]}> is not a class of the ontology; check the list of classes")
    elif roots is not None:
        scope = rooted_scope([_class_named(name, own, closure) for name in roots], closure)
    else:
        scope = default_scope(own, closure, imported)
    if not scope:
        raise OntologyError(
            f"{name}: no class in scope ({len(closure.classes)} classes found, none placed in a hierarchy); "
            "expected an OWL ontology with classes below its roots; `usd2kg ontology show FILE --root IRI` tries others"
        )
    return scope


def _class_named(name: str, own: ClassAxioms, closure: ClassAxioms) -> str:
    """Return the IRI for an IRI, a CURIE, or a local name or else a label that one class has; other text as it is."""
    name = name.strip().removeprefix("<").removesuffix(">")
    iri = expand_curie(name, own.prefixes)
    if iri in closure.classes:
        return iri
    named = [one for one in closure.classes if local_name(one) == name]
    named = named or [one for one in closure.classes if _label(one, closure).casefold() == name.casefold()]
    return named[0] if len(named) == 1 else iri


def _hash(documents: Iterable[Document]) -> str:
    digests = sorted(document.digest for document in documents)
    return "sha256:" + hashlib.sha256("".join(digests).encode()).hexdigest()


def _class(
    iri: str, group: frozenset[str], parents: tuple[str, ...], dispositions: tuple[str, ...], closure: ClassAxioms
) -> OntologyClass:
    equivalents = sorted(group - {iri})
    annotations = [closure.annotations[same] for same in (iri, *equivalents)]
    label = _label(iri, closure)
    others = {text for each in annotations for text in each.all_texts((*LABELS, *ALT_LABELS))}
    others |= {_label(same, closure) for same in equivalents}
    foreign = foreign_texts(annotations, (*LABELS, *ALT_LABELS))
    return OntologyClass(
        iri=iri,
        label=label,
        alt_labels=tuple(sorted(others - {label})),
        comment=next((comment for each in annotations if (comment := each.preferred_text(DEFINITIONS))), ""),
        parents=parents,
        dispositions=dispositions,
        equivalents=tuple(equivalents),
        wikidata=_wikidata((iri, *equivalents), closure),
        foreign_names=tuple(sorted((tag, text) for text, tag in foreign.items())),
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
    return closure.annotations[iri].preferred_text(LABELS) or local_name(iri)


def _dispositions(
    components: Components, superclasses: Mapping[str, set[str]], closure: ClassAxioms
) -> list[tuple[str, ...]]:
    """Return the dispositions of the classes in each component, inherited ones included, sorted."""
    stated: list[frozenset[str]] = []
    for group, above in zip(components.members, components.above, strict=True):
        own = {up for iri in group for up in closure.dispositions.get(iri, ())}
        stated.append(frozenset(own).union(*(stated[up] for up in above)))
    # Many classes share the same set.
    inherited = {some: tuple(sorted(some | reachable(superclasses, some))) for some in set(stated)}
    return [inherited[some] for some in stated]


def _cycle_notes(
    scope: set[str], components: Components, closure: ClassAxioms, groups: Mapping[str, frozenset[str]]
) -> list[OntologyNote]:
    return [
        OntologyNote("cycle", f"<{iri}> is a subclass of itself; the edges of that cycle are ignored")
        for iri in sorted(scope)
        if any(
            components.component_of[iri] == components.component_of[parent]
            for parent in _other_parents(groups.get(iri, frozenset({iri})), closure)
        )
    ]


def _other_parents(group: frozenset[str], closure: ClassAxioms) -> set[str]:
    """Return the stated superclasses of equivalent classes, without those classes themselves."""
    return {parent for same in group for parent in closure.parents.get(same, ())} - group
