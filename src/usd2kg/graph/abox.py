"""Instantiate a grounded scene as a knowledge graph: an ABox over the user's TBox."""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.garbage import paused_collection
from usd2kg.graph.axiom_annotation import annotate_owl, annotate_rdf12
from usd2kg.graph.concept_hierarchy import concept_triples, state_concept
from usd2kg.graph.declarations import declare_classes, declare_terms
from usd2kg.graph.derived_rooms import derived_room_iri, describe_derived_room, room_classes
from usd2kg.graph.document_prefixes import document_prefixes
from usd2kg.graph.iris import check_base, default_base, individual_iri
from usd2kg.graph.joint_patterns import resolve_joints
from usd2kg.graph.justification import justify_class, justify_refusal
from usd2kg.graph.options import GraphOptions
from usd2kg.graph.packed_triples import PackedTriples
from usd2kg.graph.physical_properties import declare_individual
from usd2kg.graph.profiles import Profile, plain_profile, soma_profile, uses_soma
from usd2kg.graph.provenance import (
    declare_prefixes,
    describe_ontology,
    describe_origin,
    describe_run,
    describe_scene,
    describe_software,
)
from usd2kg.graph.relation_patterns import describe_between, describe_room, relation_annotations
from usd2kg.graph.stage_metadata import describe_labels_and_texts, describe_metadata
from usd2kg.graph.vocabulary import OWL, RDF, RDFS, U2K, Triple, text
from usd2kg.grounding import Grounding, Prediction
from usd2kg.ontology import TBox
from usd2kg.relations import ROOM_KINDS, Relation, find_relations
from usd2kg.rich_display import RichDisplay
from usd2kg.scene import Scene, SceneObject
from usd2kg.tracing import traced
from usd2kg.two_processes import compute_in_halves

__all__ = ["PROFILES", "KnowledgeGraph", "instantiate"]

PROFILES = ("auto", "soma", "plain")
"""Modelling patterns; `auto` is soma if the TBox uses SOMA or DUL, else plain."""

_SOMA_DOCUMENTS = "http://www.ease-crc.org/ont/SOMA"
_MANY_OBJECTS = 20_000
"""Objects from which a second process saves seconds."""


@dataclass(frozen=True)
class KnowledgeGraph(RichDisplay):
    """The triples of one scene in a fixed order, with counts."""

    iri: str
    """IRI of the named graph, which is an OWL ontology."""
    base: str
    """Namespace of the individuals."""
    profile: str
    imports: tuple[str, ...]
    """IRIs of the imported ontologies."""
    triples: Sequence[ox.Triple]
    """Ontology header and declarations, then one block per object; without duplicates."""
    prefixes: dict[str, str]
    relations: tuple[Relation, ...]
    individuals: int
    """Number of scene objects; shapes, poses and masses are not counted."""
    classes: dict[str, int]
    """Class IRI → number of objects asserted to have that class."""
    missing_imports: tuple[str, ...] = ()
    """IRIs of ontologies that could not be merged because they are unavailable."""


@traced("instantiate", lambda graph: {"triples": len(graph.triples)})
def instantiate(
    scene: Scene,
    tbox: TBox,
    grounding: Grounding,
    *,
    base: str | None = None,
    profile: str = "auto",
    options: GraphOptions | None = None,
    relations: Iterable[Relation] | None = None,
) -> KnowledgeGraph:
    """Return the knowledge graph of a grounded scene.

    Args:
        scene: the objects.
        tbox: the candidate classes.
        grounding: the class of each object.
        base: namespace of the individuals, ending in `/` or `#`; by default derived from the file name.
        profile: one of `PROFILES`.
        options: annotations, colours and time stamp.
        relations: the spatial relations; by default found from the boxes.

    Raises:
        GraphError: the base is not an absolute IRI, or the profile is unknown.
    """
    base = check_base(base or default_base(scene.source))
    options = options or GraphOptions()
    chosen = _make_profile(profile, tbox, options)
    found = tuple(find_relations(scene, tbox, grounding) if relations is None else relations)
    imports = tuple(_imports(tbox, chosen))
    prefixes = {**document_prefixes(tbox), "": base}
    with paused_collection():
        triples = _GraphBuilder(scene, tbox, grounding, base, chosen, imports, options, found).build(prefixes)
    counts = Counter(p.class_iri for p in grounding.predictions if p.class_iri)
    return KnowledgeGraph(
        iri=base.rstrip("#/"),
        base=base,
        profile=chosen.name,
        imports=imports,
        triples=triples,
        prefixes=prefixes,
        relations=found,
        individuals=len(scene.objects),
        classes=dict(sorted(counts.items())),
    )


def _make_profile(name: str, tbox: TBox, options: GraphOptions) -> Profile:
    if name not in PROFILES:
        raise GraphError(f"profile {name!r} is unknown; expected one of {', '.join(PROFILES)}")
    is_soma = name == "soma" or (name == "auto" and uses_soma(cls.iri for cls in tbox.classes))
    return soma_profile(options.colors) if is_soma else plain_profile()


def _imports(tbox: TBox, profile: Profile) -> Iterator[str]:
    own = tbox.ontology_iri
    if not own.startswith("file:"):
        yield own
    for iri in profile.imports:
        # SOMA's documents import the other ontologies that they need.
        is_imported = iri in tbox.imports or (iri.startswith(_SOMA_DOCUMENTS) and own.startswith(_SOMA_DOCUMENTS))
        if iri != own and not is_imported:
            yield iri


class _GraphBuilder:
    """Builds the triples of one graph, block by block."""

    def __init__(
        self,
        scene: Scene,
        tbox: TBox,
        grounding: Grounding,
        base: str,
        profile: Profile,
        imports: tuple[str, ...],
        options: GraphOptions,
        relations: tuple[Relation, ...],
    ) -> None:
        self.scene = scene
        self.tbox = tbox
        self.grounding = grounding
        self.base = base
        self.profile = profile
        self.imports = imports
        self.time = options.time
        self.annotate = annotate_rdf12 if options.annotations == "rdf12" else annotate_owl
        self.graph = ox.NamedNode(base.rstrip("#/"))
        self.stage, self.source, self.run, self.ontology, self.software = (
            ox.NamedNode(individual_iri(base, "/", part)) for part in ("stage", "source", "run", "ontology", "software")
        )
        self.relations: dict[str, list[Relation]] = {}
        for relation in relations:
            self.relations.setdefault(relation.target, []).append(relation)
        self.joints = list(resolve_joints(scene, base))
        self.joints_of: dict[ox.NamedNode, list[ox.NamedNode]] = {}
        for linked in self.joints:
            if linked.whole is not None:
                self.joints_of.setdefault(linked.whole, []).append(linked.node)
        self.rooms = {relation.anchor: relation.room for relation in relations if relation.room is not None}
        self.room_classes = room_classes(self.rooms, tbox)
        self.nodes = {name: ox.NamedNode(derived_room_iri(base, name)) for name in self.rooms}
        self.properties: set[ox.NamedNode] = set()
        self.classes: set[ox.NamedNode] = set()

    def build(self, prefixes: Mapping[str, str]) -> PackedTriples:
        """Return all triples without duplicates."""

        def pack(blocks: Iterable[Iterable[Triple]]) -> PackedTriples:
            return PackedTriples(chain.from_iterable(map(self._record, blocks)), prefixes)

        def pack_objects(objects: Sequence[SceneObject]) -> tuple[PackedTriples, set[ox.NamedNode], set[ox.NamedNode]]:
            return pack(map(self._object, objects)), self.properties, self.classes

        statements = pack(self._blocks_of_scene())
        for packed, properties, classes in compute_in_halves(pack_objects, self.scene.objects, least=_MANY_OBJECTS):
            statements += packed
            self.properties |= properties
            self.classes |= classes
        statements += pack(map(self.profile.describe_joint, self.joints))
        used = {p.class_iri for p in self.grounding.predictions if p.class_iri} | set(self.room_classes.values())
        declarations = declare_terms(self.properties, self.classes)
        head = dict.fromkeys((*self._header(), *declarations, *declare_classes(used, self.tbox)))
        return PackedTriples(head, prefixes) + statements

    def _record(self, block: Iterable[Triple]) -> Iterable[Triple]:
        """Return the triples of one block without duplicates, and record the terms they use."""
        stated = dict.fromkeys(block)
        self.properties |= {predicate for _, predicate, _ in stated}
        kind = RDF.type
        self.classes |= {v for _, p, v in stated if p == kind and isinstance(v, ox.NamedNode)}
        return stated

    def _blocks_of_scene(self) -> Iterator[Iterable[Triple]]:
        """Yield the blocks that are not about one object; no two blocks of a graph have a triple in common."""
        yield self._provenance()
        yield concept_triples(self.grounding.concepts.values())
        yield self._members()
        yield self._rooms()

    def _header(self) -> Iterator[Triple]:
        yield self.graph, RDF.type, OWL.Ontology
        yield self.graph, RDFS.label, text(f"Knowledge graph of {Path(self.scene.source).name}")
        yield self.graph, U2K.run, self.run
        for iri in self.imports:
            yield self.graph, OWL.imports, ox.NamedNode(iri)

    def _provenance(self) -> Iterator[Triple]:
        used = (self.stage, self.ontology)
        yield from describe_run(self.run, self.grounding, used, self.software, self.time)
        yield from describe_software(self.software, self.grounding.tool_version)
        yield from describe_ontology(self.ontology, self.tbox)
        yield from declare_prefixes(self.graph, self.base, self.tbox)

    def _members(self) -> Iterator[Triple]:
        yield from declare_individual(self.stage, self.profile.stage_class)
        yield from describe_scene(self.stage, self.scene)
        if self.scene.origin is not None:
            yield from describe_origin(self.stage, self.source, self.scene.origin)
        for obj in self.scene.objects:
            yield self.stage, self.profile.membership, self._node(obj.prim_path)

    def _object(self, obj: SceneObject) -> list[Triple]:
        """Return the block of one object: its statements, those of its quality nodes, then axiom annotations."""
        node = self._node(obj.prim_path)
        prediction = self.grounding.by_path.get(obj.prim_path)
        about: list[Triple] = []
        block: list[Triple] = list(self._type(node, prediction, about))
        if prediction is not None:
            block.extend(state_concept(node, prediction))
        block.extend(describe_metadata(obj, node))
        block.extend(self._relations(obj.prim_path, node, about))
        block.extend((node, self.profile.has_joint, joint) for joint in self.joints_of.get(node, ()))
        block.extend(self.profile.describe(obj, node))
        own = [triple for triple in block if triple[0] == node]
        others = [triple for triple in block if triple[0] != node]
        return [*own, *others, *about, *describe_labels_and_texts(obj, node, self.annotate)]

    def _node(self, prim_path: str) -> ox.NamedNode:
        node = self.nodes.get(prim_path)
        if node is None:
            node = self.nodes[prim_path] = ox.NamedNode(individual_iri(self.base, prim_path))
        return node

    def _type(self, node: ox.NamedNode, prediction: Prediction | None, about: list[Triple]) -> Iterator[Triple]:
        """Yield the type assertions; their annotations go to `about`, or onto the object if it has no class."""
        yield node, RDF.type, OWL.NamedIndividual
        yield node, RDF.type, self.profile.object_class
        if prediction is None:
            return
        if prediction.class_iri is None:
            yield from ((node, name, value) for name, value in justify_refusal(prediction))
            return
        statement = (node, RDF.type, ox.NamedNode(prediction.class_iri))
        yield statement
        about.extend(self.annotate(statement, justify_class(prediction, self.run)))

    def _relations(self, prim_path: str, target: ox.NamedNode, about: list[Triple]) -> Iterator[Triple]:
        for relation in self.relations.get(prim_path, ()):
            if relation.kind == "between":
                yield from describe_between(relation, self.base)
                continue
            triples = self.profile.describe_relation(relation, target, self._node(relation.anchor))
            yield from triples
            about.extend(self.annotate(triples[0], relation_annotations(relation)))

    def _rooms(self) -> Iterator[Triple]:
        """Yield the rooms that are not objects: group prims, and rooms without a prim."""
        anchors = (r.anchor for found in self.relations.values() for r in found if r.kind in ROOM_KINDS)
        for path in dict.fromkeys(anchors):
            if path not in self.scene.by_path and path not in self.rooms:
                yield from describe_room(path, self.base)
                yield self.stage, self.profile.membership, self._node(path)
        for name, room in sorted(self.rooms.items()):
            node = self._node(name)
            yield from describe_derived_room(room, node, self.room_classes.get(name), self.stage, self.run)
            yield self.stage, self.profile.membership, node
