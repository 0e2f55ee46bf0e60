"""Non-ASCII names, instances and point instancers: every object has a unique IRI that maps back to its prim."""

import pyoxigraph as ox
import pytest

import usd2kg
from tests.scene.usda import METRES, component, cube, prim, xform
from usd2kg.graph import prim_path_of, serialize_graph
from usd2kg.graph.vocabulary import DUL, U2K
from usd2kg.scene import ReadOptions

BASE = "https://my.lab/k/"
INSTANCER = prim(
    "PointInstancer",
    "Books",
    "rel prototypes = [</World/Books/Prototypes/Book>]",
    "int[] protoIndices = [0, 0, 0]",
    "point3f[] positions = [(0, 0, 0), (1, 0, 0), (2, 0, 0)]",
    "int64[] ids = [7, 8, -1]",
    prim("Scope", "Prototypes", xform("Book", cube("pages", size=0.2))),
)
SHELF = prim("Xform", "_Shelf", component("Vase", cube("clay", size=0.2)), component("Cup", cube("clay", size=0.1)))


def shelf(name: str) -> str:
    return prim("", name, meta=["references = </_Shelf>", "instanceable = true", 'kind = "group"'])


STAGE = SHELF + xform(
    "World",
    shelf("Shelf_1"),
    shelf("Shelf_2"),
    INSTANCER,
    component("Küche", cube("geo")),
    component("Ku\u0308che", cube("geo")),
    component("杯子", cube("geo")),
    component("box", cube("geo"), component("box", cube("geo"))),
    component("stage", cube("geo")),
    kind="group",
)


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> usd2kg.BuildResult:
    path = tmp_path_factory.mktemp("special") / "scene.usda"
    path.write_text("#usda 1.0\n" + METRES + STAGE, encoding="utf-8")
    return usd2kg.build(path, base=BASE, options=ReadOptions(expand_instancers=True))


def test_stage_has_special_paths(built: usd2kg.BuildResult):
    paths = {obj.prim_path for obj in built.scene.objects}
    assert {"/World/Shelf_1/Vase", "/World/Shelf_2/Vase", "/World/Books[7]", "/World/Books[-1]"} <= paths
    assert {"/World/Küche", "/World/Ku\u0308che", "/World/杯子", "/World/stage"} <= paths


def test_iris_are_unique_and_map_back_to_prim_paths(built: usd2kg.BuildResult):
    data = serialize_graph(built.graph, ox.RdfFormat.TURTLE)
    triples = [quad.triple for quad in ox.parse(data, format=ox.RdfFormat.TURTLE)]
    members = [triple.object.value for triple in triples if triple.predicate == DUL.hasMember]
    paths = [obj.prim_path for obj in built.scene.objects]
    assert len(set(members)) == len(members) == len(paths)
    assert [prim_path_of(BASE, iri) for iri in members] == paths
    stated = {triple.subject.value: triple.object.value for triple in triples if triple.predicate == U2K.primPath}
    assert stated == dict(zip(members, paths, strict=True))


def test_other_nodes_do_not_use_iris_of_objects(built: usd2kg.BuildResult):
    members = {triple.object for triple in built.graph.triples if triple.predicate == DUL.hasMember}
    parts = {triple.subject for triple in built.graph.triples} - members
    assert not [node for node in parts if isinstance(node, ox.NamedNode) and node.value == f"{BASE}World.stage"]
    assert ox.NamedNode(f"{BASE}-stage") in parts
    assert ox.NamedNode(f"{BASE}World.box-box") in parts
    assert ox.NamedNode(f"{BASE}World.box.box") in members
