"""instantiate: from a Scene and its Grounding to a knowledge graph, an ABox over the user's TBox."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.graph.iris import check_base, default_base, individual_iri
from usd2kg.graph.profiles import PlainProfile, Profile, SomaProfile, Triple, uses_soma
from usd2kg.graph.relation_terms import RELATION_ANNOTATIONS, describe_between, describe_room, measures
from usd2kg.graph.relations import Relation, RelationOptions, find_relations
from usd2kg.graph.vocabulary import OWL, PREFIXES, PROV, RDF, RDFS, SSSOM, U2K, number, text
from usd2kg.grounding import Grounding, Prediction
from usd2kg.ontology import TBox
from usd2kg.scene import Scene

__all__ = ["PROFILES", "KnowledgeGraph", "instantiate"]

PROFILES = ("auto", "soma", "plain")
"""How objects are written; `auto` is soma where the TBox is SOMA's, else plain."""

_ANNOTATION_PROPERTIES = (
    SSSOM.confidence,
    U2K.alternative,
    U2K.boxCenter,
    U2K.evidence,
    U2K.explanation,
    U2K.grounder,
    U2K.primPath,
    U2K.run,
    U2K.status,
    *RELATION_ANNOTATIONS,
)
_PROVENANCE_PROPERTIES = (PROV.used, PROV.wasAssociatedWith)
_ALTERNATIVES = 3


@dataclass(frozen=True)
class KnowledgeGraph:
    """The triples of one scene, in a fixed order, and what they count."""

    iri: str
    """IRI of the graph, an OWL ontology."""
    base: str
    """Where the individuals lie."""
    profile: str
    triples: tuple[ox.Triple, ...]
    prefixes: dict[str, str]
    relations: tuple[Relation, ...]
    individuals: int
    """Objects of the scene; their shapes, places and masses are not counted."""
    classes: dict[str, int]
    """Class IRI → number of objects of just that class."""


def instantiate(
    scene: Scene,
    tbox: TBox,
    grounding: Grounding,
    *,
    base: str | None = None,
    profile: str = "auto",
    relations: RelationOptions | None = None,
) -> KnowledgeGraph:
    """Return the knowledge graph of a grounded scene.

    Args:
        scene: the objects.
        tbox: the classes they were grounded to.
        grounding: the class of each object.
        base: IRI under which the individuals lie, ending in `/` or `#`; by default made from the file's name.
        profile: one of `PROFILES`.
        relations: which spatial relations are found, and how; default: the default set by the rules that ship.

    Raises:
        GraphError: the base is no IRI, or the profile or a kind of relation is unknown.
    """
    base = check_base(base or default_base(scene.source))
    found = find_relations(scene, tbox, grounding, relations)
    writer = _Writer(scene, tbox, grounding, base, _make_profile(profile, tbox), found)
    triples = tuple(ox.Triple(*triple) for triple in dict.fromkeys(writer.write()))
    counts = Counter(p.class_iri for p in grounding.predictions if p.class_iri)
    return KnowledgeGraph(
        iri=base.rstrip("#/"),
        base=base,
        profile=writer.profile.name,
        triples=triples,
        prefixes={**PREFIXES, "": base},
        relations=writer.relations,
        individuals=len(scene.objects),
        classes=dict(sorted(counts.items())),
    )


def _make_profile(name: str, tbox: TBox) -> Profile:
    if name not in PROFILES:
        raise GraphError(f"profile {name!r} is unknown; expected one of {', '.join(PROFILES)}")
    is_soma = name == "soma" or (name == "auto" and uses_soma(tuple(cls.iri for cls in tbox.classes)))
    return SomaProfile() if is_soma else PlainProfile()


class _Writer:
    """Yields the triples of one graph, section by section."""

    def __init__(
        self,
        scene: Scene,
        tbox: TBox,
        grounding: Grounding,
        base: str,
        profile: Profile,
        relations: tuple[Relation, ...],
    ) -> None:
        self.scene = scene
        self.tbox = tbox
        self.grounding = grounding
        self.base = base
        self.profile = profile
        self.relations = relations
        self.graph = ox.NamedNode(base.rstrip("#/"))
        self.stage = ox.NamedNode(f"{base}-stage")
        self.run = ox.NamedNode(f"{base}-run")
        self.axioms = 0

    def write(self) -> Iterator[Triple]:
        yield from self._header()
        yield from self._declarations()
        yield from self._used_classes()
        yield from self._provenance()
        yield from self._objects()
        yield from self._relations()

    def _header(self) -> Iterator[Triple]:
        yield self.graph, RDF.type, OWL.Ontology
        yield self.graph, RDFS.label, text(f"Knowledge graph of {Path(self.scene.source).name}")
        for iri in dict.fromkeys((self.tbox.ontology_iri, *self.profile.imports)):
            if not iri.startswith("file:"):
                yield self.graph, OWL.imports, ox.NamedNode(iri)

    def _declarations(self) -> Iterator[Triple]:
        for node in self.profile.classes:
            yield node, RDF.type, OWL.Class
        for node in (*self.profile.object_properties, *_PROVENANCE_PROPERTIES):
            yield node, RDF.type, OWL.ObjectProperty
        for node in self.profile.data_properties:
            yield node, RDF.type, OWL.DatatypeProperty
        for node in _ANNOTATION_PROPERTIES:
            yield node, RDF.type, OWL.AnnotationProperty

    def _used_classes(self) -> Iterator[Triple]:
        """Yield the used classes with all above them, so that the graph alone answers questions by class."""
        used = {p.class_iri for p in self.grounding.predictions if p.class_iri}
        closure = {iri for cls in used for iri in self.tbox.closure(cls)}
        for iri in sorted(closure):
            node = ox.NamedNode(iri)
            yield node, RDF.type, OWL.Class
            yield node, RDFS.label, text(self.tbox.by_iri[iri].label)
            for parent in self.tbox.by_iri[iri].parents:
                yield node, RDFS.subClassOf, ox.NamedNode(parent)

    def _provenance(self) -> Iterator[Triple]:
        """Yield the run that made the graph. It bears no time: the same input gives the same bytes."""
        agent = U2K.usd2kg
        ontology = ox.NamedNode(f"{self.base}-ontology")
        for node, cls in ((self.run, PROV.Activity), (agent, PROV.SoftwareAgent), (ontology, PROV.Entity)):
            yield node, RDF.type, OWL.NamedIndividual
            yield node, RDF.type, cls
        settings = ", ".join(f"{key}={value}" for key, value in sorted(self.grounding.settings.items()))
        calibration = "calibrated" if self.grounding.is_calibrated else "uncalibrated"
        grounder = f"grounder {self.grounding.grounder} ({settings}; confidence {calibration})"
        yield self.run, RDFS.comment, text(f"usd2kg {self.grounding.tool_version}, {grounder}")
        yield self.run, PROV.wasAssociatedWith, agent
        yield self.run, PROV.used, self.stage
        yield self.run, PROV.used, ontology
        yield agent, RDFS.label, text("usd2kg")
        version = f", version {self.tbox.version_iri}" if self.tbox.version_iri else ""
        yield ontology, RDFS.label, text(f"{self.tbox.ontology_iri}{version}, {self.tbox.content_hash}")
        yield from self.profile.stage(self.stage)
        yield self.stage, RDFS.label, text(f"{Path(self.scene.source).name}, {self.scene.content_hash}")

    def _objects(self) -> Iterator[Triple]:
        for obj in self.scene.objects:
            node = ox.NamedNode(individual_iri(self.base, obj.prim_path))
            prediction = self.grounding.by_path.get(obj.prim_path)
            yield node, RDF.type, OWL.NamedIndividual
            if prediction is not None and prediction.class_iri is not None:
                yield node, RDF.type, ox.NamedNode(prediction.class_iri)
            yield node, RDFS.label, text(obj.display_name or obj.name)
            yield node, U2K.primPath, text(obj.prim_path)
            yield from self.profile.describe(obj, self.base)
            yield from self.profile.member(self.stage, node)
            if prediction is not None:
                yield from self._justify(node, prediction)

    def _justify(self, node: ox.NamedNode, prediction: Prediction) -> Iterator[Triple]:
        """Yield why an object has its class, on the type assertion; on the object itself where it has none."""
        if prediction.class_iri is None:
            yield node, U2K.status, text(prediction.status.value)
            yield node, U2K.explanation, text(prediction.explanation)
            return
        yield from self._annotated(
            (node, RDF.type, ox.NamedNode(prediction.class_iri)),
            [
                *([(SSSOM.confidence, number(prediction.confidence))] if prediction.confidence is not None else []),
                (U2K.status, text(prediction.status.value)),
                (U2K.grounder, text(prediction.grounder)),
                *((U2K.evidence, text(group)) for group in prediction.evidence),
                (U2K.explanation, text(prediction.explanation)),
                *((U2K.alternative, ox.NamedNode(iri)) for iri in _alternatives(prediction)),
                (U2K.run, self.run),
            ],
        )

    def _relations(self) -> Iterator[Triple]:
        for path in dict.fromkeys(relation.anchor for relation in self.relations if relation.kind == "room"):
            if path not in self.scene.by_path:
                yield from describe_room(path, self.base)
                yield from self.profile.member(self.stage, ox.NamedNode(individual_iri(self.base, path)))
        for relation in self.relations:
            if relation.kind == "between":
                yield from describe_between(relation, self.base)
                continue
            target = ox.NamedNode(individual_iri(self.base, relation.target))
            anchor = ox.NamedNode(individual_iri(self.base, relation.anchor))
            triples = self.profile.relate(relation, target, anchor)
            yield from triples
            yield from self._annotated(triples[0], measures(relation))

    def _annotated(
        self, triple: Triple, annotations: list[tuple[ox.NamedNode, ox.NamedNode | ox.Literal]]
    ) -> Iterator[Triple]:
        """Yield OWL's annotation of an axiom (OWL 2 Mapping to RDF Graphs, section 2.3)."""
        self.axioms += 1
        axiom = ox.BlankNode(f"axiom{self.axioms}")
        subject, predicate, value = triple
        yield axiom, RDF.type, OWL.Axiom
        yield axiom, OWL.annotatedSource, subject
        yield axiom, OWL.annotatedProperty, predicate
        yield axiom, OWL.annotatedTarget, value
        for name, annotation in annotations:
            yield axiom, name, annotation


def _alternatives(prediction: Prediction) -> list[str]:
    others = [c.class_iri for c in prediction.candidates if c.class_iri != prediction.class_iri]
    return others[:_ALTERNATIVES]
