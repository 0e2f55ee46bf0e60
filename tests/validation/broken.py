"""A small valid room, and edits that each violate one rule."""

from typing import Any, NamedTuple

import pyoxigraph as ox

from tests.graph.records import BASE, build_graph, reread, thing
from tests.graph.test_joint_patterns import make_joint
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.ontology import TBox
from usd2kg.query import Dataset, GraphStore
from usd2kg.validation import Finding, validate_graph

UPRIGHT = (0.0, 0.0, 0.0, 1.0)
ROOM = [
    (thing("/Floor", (-3, -3, -0.1), (6, 6, 0.1)), "Floor"),
    (thing("/Table", (0, 0, 0), (1.2, 0.8, 0.75), mass_kg=20.0, position=(0, 0, 0), orientation=UPRIGHT), "Table"),
    (thing("/Cup", (0.2, 0.2, 0.75), (0.08, 0.08, 0.1), mass_kg=0.3), "Cup"),
    (thing("/Fork", (0.5, 0.2, 0.75), (0.2, 0.025, 0.02)), "Fork"),
    (thing("/Cupboard", (2, 0, 0), (0.8, 0.6, 0.8)), "Cupboard"),
    (thing("/Cupboard/Door", (2, 0, 0), (0.8, 0.02, 0.8)), "Door"),
    (thing("/Bowl", (2.2, 0.2, 0.1), (0.16, 0.16, 0.07)), "Bowl"),
]
HINGE = make_joint(prim_path="/Cupboard/hinge", body0="/Cupboard", body1="/Cupboard/Door")


class Break(NamedTuple):
    """An edit and the one rule that it violates."""

    rule: str
    profile: str
    update: str


def replaced(node: str, name: str, value: str) -> str:
    """Return an update that replaces the value of a property."""
    old = f"{node} {name} ?old"
    return f"DELETE {{ {old} }} INSERT {{ {node} {name} {value} }} WHERE {{ {old} }}"


def dropped(node: str, name: str) -> str:
    return f"DELETE WHERE {{ {node} {name} ?old }}"


def added(triples: str) -> str:
    return f"INSERT DATA {{ {triples} }}"


CONFIDENCE = (
    "DELETE {{ ?x sssom:confidence ?o }} INSERT {{ ?x sssom:confidence {} }} "
    "WHERE {{ ?x sssom:confidence ?o ; owl:annotatedSource k:Cup }}"
)
BOX = ("width", "depth", "height", "boxCenter")
OF_BOTH = [
    ("object-label", dropped("k:Fork", "rdfs:label")),
    ("object-prim-path", added('k:Fork u2k:primPath "/Spoon"')),
    ("prim-path-shared", replaced("k:Fork", "u2k:primPath", '"/Cup"')),
    ("object-class", dropped("k:Fork", "a") + ";" + "INSERT DATA { k:Fork a owl:NamedIndividual , OBJECT }"),
    ("confidence-range", CONFIDENCE.format("1.5")),
    ("confidence-range", CONFIDENCE.format('"high"')),
    ("joint-bodies", "; ".join(dropped("<JOINT>", n) for n in ("u2k:parentPrim", "u2k:childPrim", "PARENT", "CHILD"))),
]
SHAPES = [
    *(Break(rule, "soma", edit.replace("OBJECT", "usd:Prim").replace("PARENT", "soma:hasParentLink")
            .replace("CHILD", "soma:hasChildLink")) for rule, edit in OF_BOTH),
    *(Break(rule, "plain", edit.replace("OBJECT", "u2k:Object").replace("PARENT", "u2k:parentObject")
            .replace("CHILD", "u2k:childObject")) for rule, edit in OF_BOTH),
    Break("box-missing", "soma", dropped("k:Fork-shape", "dul:hasRegion")),
    Break("box-missing", "plain", "; ".join(dropped("k:Fork", f"u2k:{n}") for n in BOX)),
    Break("box-several", "soma", added(
        'k:Fork-shape dul:hasRegion k:b . k:b a soma:BoxShape ; soma:hasWidth 0.2 ; soma:hasDepth 0.025 ; '
        'soma:hasLength 0.025 ; soma:hasHeight 0.02 ; u2k:boxCenter "0.6 0.2125 0.76"')),
    Break("shape-several", "soma", added("k:Fork soma:hasShape k:s . k:s a soma:Shape")),
    Break("pose-several", "soma", added("k:Table soma:hasLocalization k:p . k:p a soma:Localization")),
    Break("mass-several", "soma",
          added("k:Cup soma:hasMassAttribute k:m . k:m a soma:MassAttribute ; soma:hasMassValue 0.2")),
    Break("box-width", "soma", replaced("k:Fork-box", "soma:hasWidth", "-0.2")),
    Break("box-width", "plain", replaced("k:Fork", "u2k:width", "-0.2")),
    Break("box-width", "plain", replaced("k:Fork", "u2k:width", '"INF"^^xsd:double')),
    Break("box-width", "plain", replaced("k:Fork", "u2k:width", '"NaN"^^xsd:double')),
    Break("box-width", "plain", replaced("k:Fork", "u2k:width", '"wide"')),
    Break("box-depth", "soma", dropped("k:Fork-box", "soma:hasDepth")),
    Break("box-depth", "plain", dropped("k:Fork", "u2k:depth")),
    Break("box-length", "soma", added("k:Fork-box soma:hasLength 0.3")),
    Break("box-height", "soma", replaced("k:Fork-box", "soma:hasHeight", "2000000.0")),
    Break("box-height", "plain", replaced("k:Fork", "u2k:height", "2000000.0")),
    Break("box-center", "soma", replaced("k:Fork-box", "u2k:boxCenter", '"0.6 0.2"')),
    Break("box-center", "plain", replaced("k:Fork", "u2k:boxCenter", '"0.6 nan 0.2"')),
    Break("pose-data", "soma", replaced("k:Table-pose", "soma:hasPositionData", '"0 0 0 1"')),
    Break("pose-frame", "soma", dropped("k:Table-pose", "soma:hasReferenceFrame")),
    Break("pose-position", "plain", replaced("k:Table", "u2k:position", '"0,0,0"')),
    Break("pose-orientation", "plain", replaced("k:Table", "u2k:orientation", '"0 0 1"')),
    Break("mass-value", "soma", replaced("k:Cup-mass", "soma:hasMassValue", "0.0")),
    Break("mass-value", "plain", replaced("k:Cup", "u2k:mass", "-1.0")),
    Break("shape-shared", "soma", added("k:other soma:hasShape k:Fork-shape")),
    Break("mass-shared", "soma", added("k:Fork soma:hasMassAttribute k:Cup-mass")),
    Break("place-shared", "soma", added("k:Fork soma:hasLocalization k:Table-place")),
    Break("region-shared", "soma", added("k:other dul:hasRegion k:Fork-box")),
    Break("color-shared", "soma", added("k:Fork usd:hasColor k:c . k:Cup usd:hasColor k:c")),
    Break("relation-anchor", "soma", added("k:Floor soma:isOntopOf k:Ghost")),
    Break("relation-anchor", "plain", added("k:Floor u2k:on k:Ghost")),
    Break("room-anchor", "soma", added("k:Floor u2k:inRoom k:Ghost")),
    Break("room-anchor", "plain", added("k:Floor u2k:inRoom k:Ghost")),
    Break("joint-limits", "soma", replaced("<JOINT-limit>", "soma:hasJointPositionMin", "2.0")),
    Break("joint-limits", "plain", replaced("<JOINT>", "u2k:lowerLimit", "2.0")),
]  # fmt: skip


def open_room(tbox: TBox, profile: str, update: str = "", placed: list[Any] | None = None) -> GraphStore:
    """Return the graph of the room after an update, in which JOINT is replaced by the hinge's IRI."""
    store: ox.Store = reread(build_graph(tbox, placed or ROOM, joints=[] if placed else [HINGE], profile=profile))
    if update:
        text = update.replace("JOINT", f"{BASE}Cupboard.hinge-joint")
        store.update(text, prefixes={**PREFIXES, "k": BASE})
    return GraphStore(Dataset(store), "room.ttl")


def found_in(graph: GraphStore, **options: Any) -> tuple[Finding, ...]:
    return validate_graph(graph, **options).findings


def rules_in(graph: GraphStore, **options: Any) -> list[str]:
    return [finding.rule for finding in found_in(graph, **options)]
