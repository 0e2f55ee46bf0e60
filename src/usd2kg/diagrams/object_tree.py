"""Tree of the objects in a graph, and its lines in a diagram."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from usd2kg.diagrams.settings import TEXT
from usd2kg.diagrams.svg import PALETTE
from usd2kg.query.graph_store import GraphStore

__all__ = ["CardLine", "TreeObject", "class_families", "group_similar", "read_object_tree", "single_line"]

_OBJECTS = """
SELECT ?o ?path ?label ?c ?class ?confidence ?on ?in ?whole ?jointed ?held ?w ?d ?h WHERE {
  ?o u2k:primPath ?path ; rdfs:label ?label .
  FILTER NOT EXISTS { ?o a u2k:RoomGroup }
  OPTIONAL {
    ?o a ?c . ?c rdfs:label ?class . FILTER(?c NOT IN (u2k:Object, usd:Prim))
    OPTIONAL { ?x owl:annotatedSource ?o ; owl:annotatedTarget ?c ; sssom:confidence ?confidence }
  }
  OPTIONAL { ?o soma:isOntopOf|u2k:on ?on }
  OPTIONAL { ?o soma:isInsideOf|u2k:inside ?in }
  OPTIONAL { ?o u2k:partOf|^soma:hasPhysicalComponent ?whole . ?whole u2k:primPath [] }
  OPTIONAL { ?o u2k:attachedTo ?held }
  OPTIONAL { ?j soma:hasChildLink|u2k:childObject ?o ; soma:hasParentLink|u2k:parentObject ?jointed }
  OPTIONAL {
    ?o (soma:hasShape/dul:hasRegion/soma:hasDepth)|u2k:width ?w ;
       (soma:hasShape/dul:hasRegion/soma:hasWidth)|u2k:depth ?d ;
       (soma:hasShape/dul:hasRegion/soma:hasHeight)|u2k:height ?h .
  }
} ORDER BY ?path ?on ?in ?whole ?jointed ?held"""

_COLUMNS = (
    *("o", "path", "label", "c", "class", "confidence"),
    *("on", "in", "whole", "jointed", "held", "w", "d", "h"),
)

_CLASSES = """
SELECT DISTINCT ?c ?label ?parent WHERE {
  ?c a owl:Class ; rdfs:label ?label .
  OPTIONAL { ?c rdfs:subClassOf ?parent }
}"""

_OTHER = "other"


@dataclass
class TreeObject:
    """An object; its parent is its container, else its supporter, whole, jointed object or holder."""

    iri: str
    path: str
    label: str
    class_iri: str | None
    class_label: str
    confidence: float | None
    size: str
    """`width × depth × height cm` of the world box; empty without one."""
    parent: str | None
    tie: str
    """Relation to the parent: in, on, part, joint or attached; empty for a root."""
    family: str = _OTHER
    children: list["TreeObject"] = field(default_factory=list)


@dataclass(frozen=True)
class CardLine:
    """A line of a diagram: one object, or a group of similar ones."""

    text: str
    detail: str
    tie: str
    family: str
    names: str
    """Tooltip."""
    children: tuple["CardLine", ...] = ()


def read_object_tree(store: GraphStore) -> dict[str, TreeObject]:
    """Return IRI → object in the order of prim paths, linked to parents and children."""
    objects: dict[str, TreeObject] = {}
    for values in store.sparql(_OBJECTS).values:
        row = dict(zip(_COLUMNS, values, strict=True))
        if str(row["o"]) not in objects:
            objects[str(row["o"])] = _tree_object(row)
    families = class_families(store, [obj.class_iri for obj in objects.values() if obj.class_iri])
    for obj in objects.values():
        obj.family = families.get(obj.class_iri or "", _OTHER)
        if obj.parent not in objects or _is_own_ancestor(obj, objects):
            obj.parent, obj.tie = None, ""
    for obj in objects.values():
        if obj.parent is not None:
            objects[obj.parent].children.append(obj)
    return objects


def _tree_object(row: Mapping[str, str | float | int | bool | None]) -> TreeObject:
    ties = (
        ("in", row["in"]),
        ("on", row["on"]),
        ("part", row["whole"]),
        ("joint", row["jointed"]),
        ("attached", row["held"]),
    )
    tie, parent = next(((name, str(iri)) for name, iri in ties if iri), ("", None))
    sides = [row[name] for name in ("w", "d", "h")]
    size = " × ".join(f"{float(side) * 100:.3g}" for side in sides if side is not None)
    confidence = row["confidence"]
    return TreeObject(
        iri=str(row["o"]),
        path=str(row["path"]),
        label=str(row["label"]),
        class_iri=str(row["c"]) if row["c"] else None,
        class_label=str(row["class"] or "no class"),
        confidence=None if confidence is None else float(confidence),
        size=f"{size} cm" if size else "",
        parent=parent,
        tie=tie,
    )


def _is_own_ancestor(obj: TreeObject, objects: Mapping[str, TreeObject]) -> bool:
    """Return whether the chain of parents is cyclic."""
    seen = {obj.iri}
    above = obj.parent
    while above is not None and above in objects:
        if above in seen:
            return True
        seen.add(above)
        above = objects[above].parent
    return False


def class_families(store: GraphStore, used: Iterable[str]) -> dict[str, str]:
    """Return class IRI → label of its family; the smallest families are merged into "other".

    A family is a superclass with its subclasses. The largest families are split until there are as many as colours.
    """
    labels: dict[str, str] = {}
    parent_of: dict[str, str] = {}
    for iri, label, parent in sorted(store.sparql(_CLASSES).rows, key=str):
        labels.setdefault(iri or "", label or "")
        if parent and iri not in parent_of:
            parent_of[iri or ""] = parent
    chains = {iri: _chain(iri, parent_of, labels) for iri in set(used)}
    counts: dict[str, int] = {}
    for iri in used:
        counts[iri] = counts.get(iri, 0) + 1
    depth = dict.fromkeys(chains, 0)
    while True:
        groups: dict[str, list[str]] = {}
        for iri in sorted(chains):
            groups.setdefault(chains[iri][min(depth[iri], len(chains[iri]) - 1)], []).append(iri)
        sizes = {name: sum(counts[iri] for iri in members) for name, members in groups.items()}
        splittable = [n for n, members in groups.items() if any(depth[iri] < len(chains[iri]) - 1 for iri in members)]
        if len(groups) >= len(PALETTE) or not splittable:
            break
        for iri in groups[max(splittable, key=lambda name: (sizes[name], name))]:
            depth[iri] += 1
    kept = sorted(groups, key=lambda name: (-sizes[name], name))[: len(PALETTE)]
    return {iri: labels[name] if name in kept else _OTHER for name, members in groups.items() for iri in members}


def _chain(iri: str, parent_of: Mapping[str, str], labels: Mapping[str, str]) -> list[str]:
    """Return a class and its first superclasses, the root first."""
    chain = [iri]
    while (above := parent_of.get(chain[0])) and above in labels and above not in chain:
        chain.insert(0, above)
    return chain


def group_similar(objects: Iterable[TreeObject]) -> tuple[CardLine, ...]:
    """Return objects as lines; leaves with the same class and tie share one."""
    single: list[tuple[str, CardLine]] = []
    alike: dict[tuple[str, str], list[TreeObject]] = {}
    for obj in objects:
        if obj.children:
            single.append((obj.path, single_line(obj, group_similar(obj.children))))
        else:
            alike.setdefault((obj.class_label, obj.tie), []).append(obj)
    for (class_label, tie), group in alike.items():
        if len(group) == 1:
            single.append((group[0].path, single_line(group[0])))
        else:
            labels = [obj.label for obj in group]
            text = f"{len(group)} × {class_label}"
            line = CardLine(text, _join_labels(labels), tie, group[0].family, ", ".join(labels))
            single.append((group[0].path, line))
    return tuple(line for _, line in sorted(single, key=lambda pair: (not pair[1].children, pair[0])))


def _join_labels(labels: list[str]) -> str:
    """Return as many labels as fit into a line, with an ellipsis for the others."""
    shown = labels[:1]
    for label in labels[1:]:
        if len(", ".join((*shown, label))) > TEXT.max_group_letters:
            return f"{', '.join(shown)}, …"
        shown.append(label)
    return ", ".join(shown)


def single_line(obj: TreeObject, children: tuple[CardLine, ...] = ()) -> CardLine:
    """Return the line of one object: label, class and confidence."""
    confidence = "" if obj.confidence is None else f" {obj.confidence:.2f}"
    names = f"{obj.path} {obj.size}".strip()
    return CardLine(obj.label, f"{obj.class_label}{confidence}", obj.tie, obj.family, names, children)
