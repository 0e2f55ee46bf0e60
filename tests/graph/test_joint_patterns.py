"""Joints in the graph: classes, axes, limits and connected objects."""

import math
from typing import Any

import pyoxigraph as ox
import pytest

from tests.conftest import shared_file
from tests.graph.records import BASE, ask, build_graph, reread, select, thing
from usd2kg.graph import instantiate
from usd2kg.grounding import ground
from usd2kg.ontology import TBox
from usd2kg.scene import Joint, read_scene

CABINET = thing("/Kitchen/Cabinet", (0, 0, 0), (1, 0.5, 1))
DOOR = thing("/Kitchen/Cabinet/Door", (0, 0, 0), (1, 0.02, 1))
PLACED = [(CABINET, "Cupboard"), (DOOR, "Door")]
# Oxigraph's SPARQL parser rejects prefixed names with several dots.
JOINT = f"<{BASE}Kitchen.Cabinet.hinge-joint>"
CABINET_NODE = f"<{BASE}Kitchen.Cabinet>"
DOOR_NODE = f"<{BASE}Kitchen.Cabinet.Door>"


def make_joint(**changes: Any) -> Joint:
    """Return the hinge of the door, with a range of 90° and at 45°."""
    known: dict[str, Any] = {
        "prim_path": "/Kitchen/Cabinet/hinge",
        "type": "revolute",
        "body0": "/Kitchen/Cabinet/carcass",
        "body1": "/Kitchen/Cabinet/Door",
        "axis": "Z",
        "axis_vector": (0.0, 0.0, 1.0),
        "origin": (0.0, 0.01, 0.5),
        "direction": "vertical",
        "lower": 0.0,
        "upper": math.pi / 2,
        "value": math.pi / 4,
        "is_enabled": True,
        "is_excluded_from_articulation": False,
    }
    return Joint(**(known | changes))


def graph_of(home_tbox: TBox, profile: str, **changes: Any) -> ox.Store:
    return reread(build_graph(home_tbox, PLACED, joints=[make_joint(**changes)], profile=profile))


def classes_of(store: ox.Store, node: str = JOINT) -> set[str]:
    rows = select(store, f"SELECT ?c {{ {node} a ?c . FILTER(?c != owl:NamedIndividual) }}")
    return {iri.rpartition("#")[2] if "SOMA" in iri else "u2k:" + iri.rpartition("#")[2] for (iri,) in rows if iri}


def test_hinge_in_soma_terms(home_tbox: TBox):
    store = graph_of(home_tbox, "soma")
    assert ask(
        store,
        f'{JOINT} a soma:RevoluteJoint ; rdfs:label "hinge" ; soma:hasParentLink {CABINET_NODE} ;'
        f" soma:hasChildLink {DOOR_NODE} ; soma:hasJointLimit ?l ; soma:hasJointState ?s ."
        ' ?l a soma:JointLimit ; soma:hasJointPositionMin "0"^^xsd:double ;'
        ' soma:hasJointPositionMax "1.570796"^^xsd:double .'
        ' ?s a soma:JointState ; soma:hasJointPosition "0.7853982"^^xsd:double',
    )
    assert ask(
        store,
        f'{JOINT} u2k:jointAxis "0 0 1" ; u2k:jointOrigin "0 0.01 0.5" ; u2k:definingPrim "/Kitchen/Cabinet/hinge" ;'
        ' u2k:parentPrim "/Kitchen/Cabinet/carcass" ; u2k:childPrim "/Kitchen/Cabinet/Door"',
    )


def test_hinge_in_u2k_terms(home_tbox: TBox):
    store = graph_of(home_tbox, "plain")
    assert ask(
        store,
        f'{JOINT} a u2k:RevoluteJoint ; rdfs:label "hinge" ; u2k:parentObject {CABINET_NODE} ;'
        f' u2k:childObject {DOOR_NODE} ; u2k:lowerLimit "0"^^xsd:double ;'
        ' u2k:upperLimit "1.570796"^^xsd:double ; u2k:jointPosition "0.7853982"^^xsd:double ;'
        ' u2k:jointAxis "0 0 1" ; u2k:jointOrigin "0 0.01 0.5"',
    )


@pytest.mark.parametrize(
    ("changes", "soma", "plain"),
    [
        ({}, {"RevoluteJoint"}, "u2k:RevoluteJoint"),
        # SOMA requires both limits of revolute and prismatic joints.
        ({"lower": None}, {"HingeJoint"}, "u2k:RevoluteJoint"),
        ({"lower": None, "upper": None}, {"ContinuousJoint"}, "u2k:RevoluteJoint"),
        ({"type": "prismatic"}, {"PrismaticJoint"}, "u2k:PrismaticJoint"),
        ({"type": "prismatic", "upper": None}, {"MovableJoint", "u2k:PrismaticJoint"}, "u2k:PrismaticJoint"),
        ({"type": "fixed", "lower": None, "upper": None, "value": None}, {"FixedJoint"}, "u2k:FixedJoint"),
        ({"type": "spherical"}, {"MovableJoint", "u2k:SphericalJoint"}, "u2k:SphericalJoint"),
        ({"type": "distance"}, {"MovableJoint", "u2k:DistanceJoint"}, "u2k:DistanceJoint"),
        ({"type": "other"}, {"Joint"}, "u2k:Joint"),
    ],
)
def test_joint_classes(home_tbox: TBox, changes: dict[str, Any], soma: set[str], plain: str):
    assert classes_of(graph_of(home_tbox, "soma", **changes)) == soma
    assert classes_of(graph_of(home_tbox, "plain", **changes)) == {plain}


def test_writes_only_authored_limits(home_tbox: TBox):
    above = graph_of(home_tbox, "soma", upper=None)
    assert select(above, "SELECT ?p ?v { ?l a soma:JointLimit ; ?p ?v . FILTER(isLiteral(?v)) }") == [
        ("http://www.ease-crc.org/ont/SOMA.owl#hasJointPositionMin", "0")
    ]
    none = graph_of(home_tbox, "soma", lower=None, upper=None, value=None)
    assert not ask(none, "?l a soma:JointLimit")
    assert not ask(none, "?s a soma:JointState")


@pytest.mark.parametrize(("profile", "has"), [("soma", "soma:hasPhysicalComponent"), ("plain", "u2k:hasJoint")])
def test_joint_within_an_object_belongs_to_it(home_tbox: TBox, profile: str, has: str):
    store = graph_of(home_tbox, profile, body0="/Kitchen/Cabinet/shelf", body1="/Kitchen/Cabinet/lamp/arm")
    assert ask(store, f"{CABINET_NODE} {has} {JOINT}")
    assert not ask(store, f"{JOINT} soma:hasParentLink|soma:hasChildLink|u2k:parentObject|u2k:childObject ?o")
    assert ask(store, f'{JOINT} u2k:parentPrim "/Kitchen/Cabinet/shelf" ; u2k:childPrim "/Kitchen/Cabinet/lamp/arm"')


def test_joint_to_the_world_has_one_object(home_tbox: TBox):
    world = graph_of(home_tbox, "plain", body0=None)
    assert ask(world, f"{JOINT} u2k:childObject {DOOR_NODE}")
    assert not ask(world, f"{JOINT} u2k:parentObject|u2k:parentPrim ?o")
    group = graph_of(home_tbox, "plain", body0="/Kitchen")
    assert not ask(group, f"{JOINT} u2k:parentObject ?o")
    assert ask(group, f'{JOINT} u2k:parentPrim "/Kitchen"')


def test_writes_flags_that_differ_from_the_default(home_tbox: TBox):
    usual = graph_of(home_tbox, "plain")
    assert not ask(usual, f"{JOINT} u2k:isEnabled|u2k:closesLoop ?v")
    unusual = graph_of(home_tbox, "plain", is_enabled=False, is_excluded_from_articulation=True)
    assert ask(unusual, f"{JOINT} u2k:isEnabled false ; u2k:closesLoop true")


def test_unknown_joint_values_are_omitted(home_tbox: TBox):
    store = graph_of(home_tbox, "plain", axis_vector=None, origin=None, value=None)
    assert not ask(store, f"{JOINT} u2k:jointAxis|u2k:jointOrigin|u2k:jointPosition ?v")


def test_joint_iris_do_not_clash_with_object_iris(home_tbox: TBox):
    # A user may select any prim as an object, including a joint.
    hinge = thing("/Kitchen/Cabinet/hinge", (0, 0, 0), (0.1, 0.1, 0.1))
    store = reread(build_graph(home_tbox, [*PLACED, (hinge, "Cup")], joints=[make_joint()]))
    assert ask(store, f"<{BASE}Kitchen.Cabinet.hinge> a soma:Cup")
    assert classes_of(store) == {"RevoluteJoint"}


def test_microwave_of_the_franka_kitchen(home_tbox: TBox):
    scene = read_scene(shared_file("scenes/franka_kitchen/franka_kitchen.usdc"))
    store = reread(instantiate(scene, home_tbox, ground(scene, home_tbox, "dictionary"), base=BASE))
    microwave = f"{BASE}franka_kitchen.Geometry.desk.microwave"
    # Authored: -120° (2.094 rad) to 0 about the vertical axis.
    assert ask(
        store,
        f"?j soma:hasParentLink <{microwave}> ; soma:hasChildLink <{microwave}.microroot.microdoorroot> ;"
        ' a soma:RevoluteJoint ; u2k:jointAxis "0 0 1" ; soma:hasJointLimit ?l .'
        ' ?l soma:hasJointPositionMin "-2.094001"^^xsd:double ; soma:hasJointPositionMax "0"^^xsd:double',
    )
    # The arm has seven revolute joints and two fingers.
    arm = f"<{BASE}franka_kitchen.Geometry.Body> soma:hasPhysicalComponent ?j . ?j a"
    assert len(select(store, f"SELECT ?j {{ {arm} soma:RevoluteJoint }}")) == 7
    assert len(select(store, f"SELECT ?j {{ {arm} soma:PrismaticJoint }}")) == 2


def test_drawers_of_the_apartment(home_tbox: TBox):
    scene = read_scene(shared_file("scenes/iai_apartment/apartment.usdc"))
    store = reread(instantiate(scene, home_tbox, ground(scene, home_tbox, "dictionary"), base=BASE, profile="plain"))
    ends = "?j a u2k:PrismaticJoint ; u2k:parentObject ?p ; u2k:childObject ?c ; u2k:upperLimit ?u"
    slides = select(store, f"SELECT ?p ?c ?u {{ {ends} }}")
    assert slides
    # Drawers slide at most 1.5 m.
    assert all(0 < float(str(upper)) < 1.5 for _, _, upper in slides)
    assert all(parent != child for parent, child, _ in slides)
