"""GraphObject: the objects of a graph in either profile as records."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import pyoxigraph as ox

from usd2kg.graph.literal_numbers import parse_numbers
from usd2kg.graph.vocabulary import DUL, OWL, RDF, RDFS, SOMA, SSSOM, U2K, USD

__all__ = ["GraphObject", "find_owner", "profile_of", "read_graph_objects", "values_of"]

Vector = tuple[float, float, float]
_GENERIC_CLASSES = {OWL.NamedIndividual, USD.Prim, U2K.Object}
_MAX_EXTENT = 100_000.0
"""Metres; the limit of the shapes in `shapes-*.ttl`."""
_MIN_CONCEPT_CONFIDENCE = 0.5
"""Concepts with a lower probability are ignored."""
_MAX_STEPS = 4
"""Number of properties between an object and the farthest nodes that belong to it: joint limits and box regions."""


@dataclass(frozen=True, slots=True)
class GraphObject:
    """The statements of a graph about one object; a malformed value is None, and violates a shape."""

    iri: str
    label: str
    prim_path: str
    classes: tuple[str, ...]
    """IRIs of the grounded classes, sorted, without the generic classes of every object."""
    size: Vector | None
    """Extents of the world box along x, y and z, metres."""
    center: Vector | None
    """Centre of the world box, metres, world frame."""
    oriented_size: Vector | None
    """Extents along the object's own axes, metres; None if those are the world's."""
    orientation: tuple[float, ...] | None
    """Quaternion x y z w."""
    mass_kg: float | None
    confidence: float | None
    """Confidence of the class, 0 to 1; None if not stated."""
    supporters: tuple[str, ...]
    """IRIs of the supporting objects, sorted."""
    containers: tuple[str, ...]
    """IRIs of the containing objects, sorted."""
    holders: tuple[str, ...]
    """IRIs of its wholes, of the objects it is attached to, and of the joints that move or fix it, sorted."""
    concept: str | None
    """IRI of the concept named by the object's words; None if there is none, or if it is probably wrong."""

    @property
    def own_size(self) -> Vector | None:
        """Extents along the object's own axes if known, else along the world's; metres."""
        return self.oriented_size or self.size


def profile_of(store: ox.Store) -> str | None:
    """Return the profile of a graph; None if it contains no objects."""
    for profile, cls in (("soma", USD.Prim), ("plain", U2K.Object)):
        if next(iter(store.quads_for_pattern(None, RDF.type, cls)), None) is not None:
            return profile
    return None


def values_of(store: ox.Store, name: ox.NamedNode) -> dict[Any, list[Any]]:
    """Return subject → values of a property, sorted."""
    found: dict[Any, list[Any]] = {}
    for quad in store.quads_for_pattern(None, name, None):
        found.setdefault(quad.subject, []).append(quad.object)
    for values in found.values():
        if len(values) > 1:
            values.sort(key=str)
    return found


def read_graph_objects(store: ox.Store) -> list[GraphObject]:
    """Return the objects of a graph in the order of their prim paths."""
    reader = _Reader(store)
    rooms = {quad.subject for quad in store.quads_for_pattern(None, RDF.type, U2K.RoomGroup)}
    paths = {
        node: [path for path in own if isinstance(path, ox.Literal)]
        for node, own in values_of(store, U2K.primPath).items()
        # Skip blank nodes: a finding could not refer to them.
        if isinstance(node, ox.NamedNode) and node not in rooms
    }
    objects = [reader.read(node, own[0]) for node, own in paths.items() if own]
    return sorted(objects, key=lambda obj: (obj.prim_path, obj.iri))


class _Reader:
    """Reads objects; each property is read once for all objects, which is faster than a query per object."""

    def __init__(self, store: ox.Store) -> None:
        self._store = store
        self._read: dict[ox.NamedNode, dict[Any, list[Any]]] = {}
        self._confidences = dict(_confidences(store))
        self._holders = _find_holders(store)

    def read(self, node: Any, path: Any) -> GraphObject:
        region = self._region_with(U2K.boxCenter, self._steps(node, SOMA.hasShape, DUL.hasRegion)) or node
        extents = ((SOMA.hasLength, U2K.width), (SOMA.hasWidth, U2K.depth), (SOMA.hasHeight, U2K.height))
        size = [self._number(region, *names) for names in extents]
        pose = self._vector(self._first(self._steps(node, SOMA.hasLocalization, DUL.hasRegion)), SOMA.hasPositionData)
        mass = self._number(self._first(self._steps(node, SOMA.hasMassAttribute)), SOMA.hasMassValue)
        types = self._values(node, RDF.type)
        classes = [cls for cls in types if cls not in _GENERIC_CLASSES and isinstance(cls, ox.NamedNode)]
        return GraphObject(
            iri=node.value,
            label=self._text(node, RDFS.label),
            prim_path=str(path.value),
            classes=tuple(cls.value for cls in classes),
            size=_triple(size) if all(0 <= side <= _MAX_EXTENT for side in size if side is not None) else None,
            center=_triple(self._vector(region, U2K.boxCenter)),
            oriented_size=_triple(self._vector(node, U2K.orientedSize)),
            orientation=pose[3:] if pose else self._vector(node, U2K.orientation),
            mass_kg=mass if mass is not None else self._number(node, U2K.mass),
            confidence=self._confidences.get(node),
            supporters=self._iris(node, SOMA.isOntopOf, U2K.on),
            containers=self._iris(node, SOMA.isInsideOf, U2K.inside),
            holders=tuple(sorted(self._holders.get(node, ()))),
            concept=self._concept(node),
        )

    def _concept(self, node: Any) -> str | None:
        confidence = self._number(node, U2K.conceptConfidence)
        concepts = self._iris(node, U2K.concept)
        return concepts[0] if concepts and (confidence is None or confidence >= _MIN_CONCEPT_CONFIDENCE) else None

    def _values(self, node: Any, name: ox.NamedNode) -> list[Any]:
        if name not in self._read:
            self._read[name] = values_of(self._store, name)
        return self._read[name].get(node, [])

    def _steps(self, node: Any, *names: ox.NamedNode) -> list[Any]:
        nodes = [node]
        for name in names:
            nodes = [value for each in nodes for value in self._values(each, name)]
        return nodes

    def _region_with(self, name: ox.NamedNode, regions: list[Any]) -> Any:
        return next((region for region in regions if self._values(region, name)), None)

    @staticmethod
    def _first(nodes: list[Any]) -> Any:
        return nodes[0] if nodes else None

    def _text(self, node: Any, name: ox.NamedNode) -> str:
        values = (value for value in self._values(node, name) if isinstance(value, ox.NamedNode | ox.Literal))
        return next((str(value.value) for value in values), "")

    def _number(self, node: Any, *names: ox.NamedNode) -> float | None:
        numbers = parse_numbers(" ".join(self._text(node, name) for name in names))
        return numbers[0] if len(numbers) == 1 else None

    def _vector(self, node: Any, name: ox.NamedNode) -> tuple[float, ...] | None:
        return parse_numbers(self._text(node, name)) or None

    def _iris(self, node: Any, *names: ox.NamedNode) -> tuple[str, ...]:
        return tuple(v.value for name in names for v in self._values(node, name) if isinstance(v, ox.NamedNode))


def _find_holders(store: ox.Store) -> dict[Any, set[str]]:
    """Return object → IRIs of what it is attached to or a part of, and of the joints that move or fix it."""
    found: dict[Any, set[str]] = {}
    for name in (U2K.attachedTo, U2K.partOf, SOMA.hasPhysicalComponent, SOMA.hasChildLink, U2K.childObject):
        for quad in store.quads_for_pattern(None, name, None):
            is_held = name in (U2K.attachedTo, U2K.partOf)
            held, holder = (quad.subject, quad.object) if is_held else (quad.object, quad.subject)
            if isinstance(holder, ox.NamedNode):
                found.setdefault(held, set()).add(holder.value)
    return found


def _triple(values: Any) -> Vector | None:
    if values is None or len(values) != 3 or None in values:
        return None
    x, y, z = values
    return x, y, z


def _confidences(store: ox.Store) -> Iterator[tuple[Any, float]]:
    """Yield each object with the confidence of its class, from OWL axiom annotations or RDF 1.2 reifiers."""
    typed = {q.subject for q in store.quads_for_pattern(None, OWL.annotatedProperty, RDF.type)}
    annotated = store.quads_for_pattern(None, OWL.annotatedSource, None)
    sources = {quad.subject: quad.object for quad in annotated if quad.subject in typed}
    for quad in store.quads_for_pattern(None, RDF.reifies, None):
        if isinstance(quad.object, ox.Triple) and quad.object.predicate == RDF.type:
            sources[quad.subject] = quad.object.subject
    for quad in store.quads_for_pattern(None, SSSOM.confidence, None):
        numbers = parse_numbers(str(getattr(quad.object, "value", "")))
        if quad.subject in sources and len(numbers) == 1:
            yield sources[quad.subject], numbers[0]


def find_owner(store: ox.Store, node: Any, objects: Mapping[str, GraphObject]) -> GraphObject | None:
    """Return the object that owns a node (its box, its mass, the annotation of its class); None if there is none."""
    seen, pending = {node}, [node]
    for _ in range(_MAX_STEPS):
        for each in pending:
            owner = objects.get(getattr(each, "value", ""))
            if owner is not None and isinstance(each, ox.NamedNode):
                return owner
        pending = [near for each in pending for near in _possible_owners(store, each) if near not in seen]
        seen.update(pending)
    return None


def _possible_owners(store: ox.Store, node: Any) -> list[Any]:
    """Return the nodes to which a node may directly belong."""
    if isinstance(node, ox.BlankNode):
        about = [quad.object for quad in store.quads_for_pattern(node, OWL.annotatedSource, None)]
        reified = (quad.object for quad in store.quads_for_pattern(node, RDF.reifies, None))
        return [*about, *(triple.subject for triple in reified if isinstance(triple, ox.Triple))]
    return sorted({quad.subject for quad in store.quads_for_pattern(None, None, node)}, key=str)
