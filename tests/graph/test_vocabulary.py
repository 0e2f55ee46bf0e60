"""The u2k vocabulary defines exactly the terms in use, and OWL tools read it."""

from dataclasses import replace

import pyhornedowl
import pyoxigraph as ox
import pytest

from tests.graph.records import BASE, box_at, ground_as
from tests.graph.test_joint_patterns import make_joint
from tests.grounding.records import make_class, make_object, make_scene, make_tbox
from usd2kg.graph import VOCABULARY_IRI, GraphOptions, KnowledgeGraph, instantiate, vocabulary_text
from usd2kg.graph.declarations import declare_terms, vocabulary_triples
from usd2kg.graph.vocabulary import OWL, QUDT, RDF, RDFS, SKOS, SOMA, U2K
from usd2kg.grounding import Candidate, Concept
from usd2kg.relations import Relation
from usd2kg.scene import Instances, Label, MaterialDetails, ObjectLabels

SPATIAL = frozenset(
    """
    Between RoomGroup above anchor angle behind below betweenRatio distance inFrontOf inRoom leftOf margin near nextTo
    partOf rightOf target touching
    """.split()
)
"""Terms of relations that depend on the scene."""

ALIGNMENT = frozenset({"categorySize", "defaultClass", "termKind"})
"""Terms of alignment files."""

JOURNAL = frozenset(
    {
        "action",
        "decidedConcept",
        "event",
        "isAudit",
        "proposedSubclass",
        "revertedEvent",
        "seenEvent",
        "suggestedClass",
        "suggestedConfidence",
        "verdict",
        "verdictBefore",
    }
)
"""Terms of journals of decisions."""

KINDS = {OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty}
TBOX = replace(
    make_tbox(
        make_class("Thing"), make_class("Cup", "Thing"), make_class("Glass", "Thing"), make_class("Table", "Thing")
    ),
    version_iri="https://lab.example/onto/1",
)

VESSEL_CONCEPT = Concept("http://wordnet-rdf.princeton.edu/id/03216670-n", "vessel")
CUP_CONCEPT = Concept("https://w3id.org/usd2kg/concept/tea_cup", "tea cup", (VESSEL_CONCEPT.iri,))


def local_names(triples: list[ox.Triple] | tuple[ox.Triple, ...]) -> set[str]:
    """Return the local names of u2k terms in subjects, predicates, objects and datatypes."""
    nodes = [node for triple in triples for node in triple]
    return {node.value.removeprefix(U2K.iri) for node in nodes if _is_ours(node)}


def _is_ours(node: object) -> bool:
    return isinstance(node, ox.NamedNode) and node.value.startswith(U2K.iri)


def rich_graph(profile: str) -> KnowledgeGraph:
    """Return a graph with every kind of statement."""
    box = box_at((0, 0, 0), (0.1, 0.1, 0.1))
    labels = ObjectLabels(
        (Label("/Cup", "UsdSemantics", "wikidata_qcode", "Q81727"),), (), (Label("/Cup/h", "Isaac", "class", "handle"),)
    )
    cup = make_object(
        "/Cup",
        box=box,
        own_box=box,
        position=(0.0, 0.0, 0.0),
        orientation=(0.0, 0.0, 0.0, 1.0),
        oriented_size=(0.1, 0.1, 0.1),
        shell_boxes=(box, box),
        mass_kg=0.2,
        center_of_mass=(0.0, 0.0, 0.0),
        display_name="a cup",
        documentation="of porcelain",
        asset=("cup",),
        geometry_file="cup.usda",
        materials=("Enamel",),
        material_details=(MaterialDetails("Enamel", "/Looks/Enamel", base_color=(1.0, 0.0, 0.0)),),
        variants=(("color", "red"),),
        texts=(("note", "from grandmother"),),
        labels=labels,
        instances=Instances(3, ("A",)),
    )
    joints = [
        make_joint(prim_path=f"/Cup/{kind}", type=kind, body0="/Table", body1="/Cup")
        for kind in ("revolute", "prismatic", "spherical", "distance", "other")
    ]
    still = {"lower": None, "upper": None, "value": None}
    joints.append(make_joint(prim_path="/Cup/fixed", type="fixed", body0="/Cup", body1="/Cup/handle", **still))
    joints.append(make_joint(prim_path="/Cup/x", is_enabled=False, is_excluded_from_articulation=True))
    joints.append(make_joint(prim_path="/Cup/slide", type="prismatic", lower=None))
    scene = replace(make_scene(cup, make_object("/Table"), make_object("/Ghost")), joints=tuple(joints), time=1.0)
    grounding = ground_as(TBOX, scene, {"/Cup": "Cup", "/Table": "Table"})
    first, *others = grounding.predictions
    first = replace(first, candidates=(Candidate(TBOX.resolve("Glass"), 0.1), *first.candidates))
    first = first.reviewed(TBOX.resolve("Table"), "Ada", comment="a small one", time="2026-07-15T12:00:00Z")
    first = replace(first, decided_for="/OldCup", concept=CUP_CONCEPT.iri, concept_confidence=0.9)
    concepts = {CUP_CONCEPT.iri: CUP_CONCEPT, VESSEL_CONCEPT.iri: VESSEL_CONCEPT}
    grounding = replace(grounding, predictions=(first, *others), concepts=concepts)
    numbers = {"gap": 0.0, "overlapRatio": 1.0, "insideRatio": 1.0}
    relations = [Relation(kind, "/Cup", "/Table", f"{kind}/1", numbers) for kind in ("on", "inside", "attached-to")]
    return instantiate(scene, TBOX, grounding, base=BASE, profile=profile, relations=relations, options=GraphOptions())


WRITTEN = {profile: rich_graph(profile) for profile in ("soma", "plain")}


def defined() -> dict[str, ox.NamedNode]:
    """Return local name → entity type of each defined term."""
    rows = [triple for triple in vocabulary_triples() if triple.predicate == RDF.type and triple.object in KINDS]
    return {t.subject.value.removeprefix(U2K.iri): t.object for t in rows if _is_ours(t.subject)}


@pytest.mark.parametrize("profile", WRITTEN)
def test_terms_are_declared_with_their_defined_entity_type(profile: str):
    graph = WRITTEN[profile]
    assert local_names(graph.triples) <= set(defined())
    for triple in graph.triples:
        if _is_ours(triple.subject) and triple.predicate == RDF.type:
            assert triple.object == defined()[triple.subject.value.removeprefix(U2K.iri)]


def test_all_defined_terms_are_used():
    written = set().union(*(local_names(graph.triples) for graph in WRITTEN.values()))
    assert set(defined()) - written - ALIGNMENT - JOURNAL <= SPATIAL
    assert set(defined()) >= SPATIAL | ALIGNMENT | JOURNAL


@pytest.mark.parametrize("profile", WRITTEN)
def test_declares_exactly_the_terms_in_use(profile: str):
    triples = WRITTEN[profile].triples
    declared = {t.subject for t in triples if t.predicate == RDF.type and t.object in KINDS}
    built_in = (RDF.iri, RDFS.iri, OWL.iri)
    used = {t.predicate for t in triples if not t.predicate.value.startswith(built_in)}
    used |= {t.object for t in triples if t.predicate == RDF.type and not t.object.value.startswith(built_in)}
    above = {node for t in triples if t.predicate == RDFS.subClassOf for node in (t.subject, t.object)}
    assert declared == used | above


def test_every_term_has_label_comment_and_subject():
    said: dict[str, set[str]] = {name: set() for name in defined()}
    for triple in vocabulary_triples():
        if _is_ours(triple.subject):
            said[triple.subject.value.removeprefix(U2K.iri)].add(triple.predicate.value)
    needed = {term.value for term in (RDFS.label, RDFS.comment, SKOS.scopeNote)}
    assert [name for name, properties in said.items() if not needed <= properties] == []


def test_lengths_and_masses_have_a_unit():
    units = {
        t.subject.value.removeprefix(U2K.iri): t.object.value
        for t in vocabulary_triples()
        if t.predicate == QUDT.hasUnit
    }
    metres, kilograms = "http://qudt.org/vocab/unit/M", "http://qudt.org/vocab/unit/KiloGM"
    assert {name for name, unit in units.items() if unit == kilograms} == {"mass"}
    assert {"width", "depth", "height", "position", "boxCenter", "centerOfMass", "gap", "distance"} <= set(units)
    assert {name for name, unit in units.items() if unit not in {metres, kilograms}} == {"angle"}
    for triple in vocabulary_triples():
        if triple.predicate == RDFS.comment and "metres" in triple.object.value and _is_ours(triple.subject):
            name = triple.subject.value.removeprefix(U2K.iri)
            # The unit of a joint's position depends on its type.
            assert name in units or "radians" in triple.object.value, name


def test_symmetric_relations_are_symmetric_properties():
    facts = {(t.subject, t.predicate, t.object) for t in vocabulary_triples()}
    for name in ("near", "nextTo", "touching"):
        assert (U2K[name], RDF.type, OWL.SymmetricProperty) in facts
    assert (U2K.above, OWL.inverseOf, U2K.below) in facts
    for name in ("leftOf", "rightOf", "inFrontOf", "behind"):
        assert not [fact for fact in facts if fact[0] == U2K[name] and fact[1] == OWL.inverseOf], "it has a viewpoint"


def test_owl_parser_reads_the_vocabulary():
    data = ox.serialize(vocabulary_triples(), format=ox.RdfFormat.RDF_XML)
    assert data is not None
    found = list(pyhornedowl.open_ontology_from_string(data.decode(), serialization="rdf").get_components())
    (identity,) = [item.component for item in found if type(item.component).__name__ == "OntologyID"]
    assert str(identity.iri) == VOCABULARY_IRI
    declared = [item for item in found if type(item.component).__name__.startswith("Declare")]
    assert len(declared) >= len(defined())
    assert vocabulary_text().isascii()


def test_undefined_terms_raise():
    with pytest.raises(KeyError, match="hasNothing"):
        list(declare_terms([SOMA.hasNothing], []))
