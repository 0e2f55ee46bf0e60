"""Independent readers read every format with the same content, hostile names included."""

import csv
import gzip
import json
import math
from pathlib import Path
from typing import Any

import networkx as nx
import pyhornedowl
import pyoxigraph as ox
import pytest
import rdflib
from hypothesis import given, settings
from hypothesis import strategies as st
from rdflib.compare import to_isomorphic

from tests.graph.records import build_graph, thing
from tests.graph.test_joint_patterns import make_joint
from usd2kg.errors import GraphError
from usd2kg.graph import (
    GRAPH_FORMATS,
    RDF_FORMATS,
    GraphDocument,
    GraphOptions,
    GraphPart,
    KnowledgeGraph,
    document_of,
    read_document,
    read_property_graph,
    serialize_graph,
    write_graph,
    write_neo4j,
)
from usd2kg.graph.rdf_document import read_statements
from usd2kg.graph.vocabulary import OWL, PREFIXES, RDF, RDFS, U2K, XSD
from usd2kg.ontology import TBox
from usd2kg.query import load_graph

HOSTILE = 'a "quoted" ]]> <b>&amp;</b> \\ back\ttab\nline\r\nreturn =1+1 é 漢 🫖 #x | ; '
RDFLIB_FORMATS = {".ttl": "turtle", ".nt": "nt", ".trig": "trig", ".nq": "nquads", ".rdf": "xml", ".owl": "xml"}
PROFILES = ("soma", "plain")

pytestmark = [
    # Deprecations within rdflib.
    pytest.mark.filterwarnings("ignore:ConjunctiveGraph is deprecated:DeprecationWarning"),
    pytest.mark.filterwarnings("ignore:Dataset.default_context is deprecated:DeprecationWarning"),
]


def hostile_graph(tbox: TBox, profile: str = "soma", **options: Any) -> KnowledgeGraph:
    table = thing("/Room/Table", (0, 0, 0), (2, 1, 0.7), display_name=HOSTILE, documentation=HOSTILE)
    cup = thing("/Room/Table/Cup-1.b", (0.2, 0.3, 0.7), (0.1, 0.12, 0.09), mass_kg=0.25, materials=("=cmd", "a;b"))
    spoon = thing("/Room/Löffel", (0.21, 0.33, 0.7), (0.02, 0.02, 0.01), display_color=(1.0, 0.5, 0.0))
    bowl = thing("/Room/Bowl", (1.2, 0.3, 0.7), (0.2, 0.2, 0.08))
    joint = make_joint(prim_path="/Room/hinge", body0="/Room/Table", body1="/Room/Table/Cup-1.b", lower=0.0, upper=1.5)
    return build_graph(
        tbox,
        [(table, "Table"), (cup, "Cup"), (spoon, None), (bowl, "Bowl")],
        profile=profile,
        joints=[joint],
        **options,
    )


@pytest.fixture(params=PROFILES)
def graph(request: pytest.FixtureRequest, home_tbox: TBox) -> KnowledgeGraph:
    return hostile_graph(home_tbox, request.param)


def as_rdflib(data: bytes, syntax: str) -> rdflib.Dataset:
    found = rdflib.Dataset(default_union=True)
    found.parse(data=data, format=syntax)
    return found


class TestRdf:
    @pytest.mark.parametrize("ending", RDFLIB_FORMATS)
    def test_rdflib_reads_the_same_graph(self, tmp_path: Path, graph: KnowledgeGraph, ending: str):
        expected = rdflib.Graph().parse(data=serialize_graph(graph, ox.RdfFormat.N_TRIPLES), format="nt")
        write_graph(graph, tmp_path / f"graph{ending}")
        found = as_rdflib((tmp_path / f"graph{ending}").read_bytes(), RDFLIB_FORMATS[ending])
        plain = rdflib.Graph()
        for triple in found.triples((None, None, None)):
            plain.add(triple)
        assert len(expected) == len(set(graph.triples))
        assert to_isomorphic(plain) == to_isomorphic(expected)

    @pytest.mark.parametrize("ending", [ending for ending in RDF_FORMATS if ending != ".jsonld"])
    @pytest.mark.parametrize("packed", ["", ".gz"])
    def test_round_trip_preserves_triples_and_order(
        self, tmp_path: Path, graph: KnowledgeGraph, ending: str, packed: str
    ):
        path = tmp_path / f"graph{ending}{packed}"
        write_graph(graph, path)
        document = read_document(path)
        assert list(document.triples) == list(graph.triples)
        assert [part.iri for part in document.parts] == [graph.iri]
        assert document.prefixes[""] == graph.base
        write_graph(document, tmp_path / f"again{ending}{packed}")
        assert (tmp_path / f"again{ending}{packed}").read_bytes() == path.read_bytes()

    @pytest.mark.parametrize("ending", [".trig", ".nq"])
    def test_a_scene_is_one_named_graph_called_as_its_ontology(self, graph: KnowledgeGraph, ending: str):
        found = as_rdflib(serialize_graph(graph, RDF_FORMATS[ending]), RDFLIB_FORMATS[ending])
        assert {str(g.identifier) for g in found.graphs() if len(g)} == {"https://my.lab/k"}

    def test_named_graphs_stay_apart_and_questions_see_them_all(self, tmp_path: Path, home_tbox: TBox):
        first = build_graph(home_tbox, [(thing("/A", (0, 0, 0), (1, 1, 1)), "Table")])
        second = build_graph(home_tbox, [(thing("/B", (0, 0, 0), (1, 1, 1)), "Cup")], base="https://my.lab/two/")
        both = GraphDocument((*document_of(first).parts, *document_of(second).parts), PREFIXES, "both")
        write_graph(both, tmp_path / "both.trig")
        again = read_document(tmp_path / "both.trig")
        write_graph(again, tmp_path / "both.nq")
        found = as_rdflib((tmp_path / "both.nq").read_bytes(), "nquads")
        assert {str(g.identifier) for g in found.graphs() if len(g)} == {"https://my.lab/k", "https://my.lab/two"}
        for name in ("both.trig", "both.nq"):
            store = load_graph(tmp_path / name)
            assert [node.value for node in store.find("Cup")] == ["https://my.lab/two/B"]
            assert [node.value for node in store.find("/A")] == ["https://my.lab/k/A"]

    def test_packed_bytes_are_the_same_every_time_and_unpack(self, tmp_path: Path, graph: KnowledgeGraph):
        for name in ("a.ttl.gz", "b.ttl.gz", "a.ttl"):
            write_graph(graph, tmp_path / name)
        assert (tmp_path / "a.ttl.gz").read_bytes() == (tmp_path / "b.ttl.gz").read_bytes()
        assert gzip.decompress((tmp_path / "a.ttl.gz").read_bytes()) == (tmp_path / "a.ttl").read_bytes()
        assert load_graph(tmp_path / "a.ttl.gz").find("/Room/Table")

    def test_a_broken_file_is_one_line(self, tmp_path: Path):
        (tmp_path / "bad.rdf").write_text("<rdf", encoding="utf-8")
        with pytest.raises(GraphError, match=r"bad\.rdf: does not parse as RDF/XML .*build the graph again"):
            read_document(tmp_path / "bad.rdf")
        (tmp_path / "bad.ttl.gz").write_bytes(b"no gzip")
        with pytest.raises(GraphError, match=r"bad\.ttl\.gz: does not parse"):
            read_document(tmp_path / "bad.ttl.gz")


def document(*triples: ox.Triple) -> GraphDocument:
    return GraphDocument((GraphPart("", triples),), {**PREFIXES, "": "https://my.lab/k/"}, "test.ttl")


def say(predicate: str, value: ox.NamedNode | ox.Literal) -> ox.Triple:
    return ox.Triple(ox.NamedNode("https://my.lab/k/a"), ox.NamedNode(predicate), value)


class TestRdfXml:
    @pytest.mark.parametrize(
        "predicate", ["https://x.org/p/6DPose", "https://x.org/größe", "urn:a:b.c-d", "http://x#_"]
    )
    def test_any_property_that_ends_in_a_letter_has_an_element(self, predicate: str):
        data = serialize_graph(document(say(predicate, ox.Literal("x"))), ox.RdfFormat.RDF_XML)
        assert [str(p) for _, p, _ in rdflib.Graph().parse(data=data, format="xml")] == [predicate]

    @pytest.mark.parametrize("predicate", ["https://x.org/6", "https://x.org/", f"{RDF.iri}li"])
    def test_a_property_that_xml_cannot_name_is_an_error(self, predicate: str):
        with pytest.raises(GraphError, match=r"test\.ttl: the property <.*choose \.ttl"):
            serialize_graph(document(say(predicate, ox.Literal("x"))), ox.RdfFormat.RDF_XML)

    def test_a_control_character_is_an_error(self):
        with pytest.raises(GraphError, match=r"contains '\\x01'; XML cannot represent it"):
            serialize_graph(document(say("https://x.org/p", ox.Literal("a\x01"))), ox.RdfFormat.RDF_XML)

    def test_blank_nodes_stay_apart(self):
        nodes = [ox.BlankNode(name) for name in ("1", "b1", "b_1", "axiom1")]
        triples = [ox.Triple(node, RDFS.label, ox.Literal(str(i))) for i, node in enumerate(nodes)]
        found = rdflib.Graph().parse(data=serialize_graph(document(*triples), ox.RdfFormat.RDF_XML), format="xml")
        assert len(set(found.subjects())) == 4


class TestRdf12:
    @pytest.mark.parametrize("ending", [".ttl", ".nt", ".trig", ".nq"])
    def test_formats_that_have_triple_terms_keep_them(self, tmp_path: Path, home_tbox: TBox, ending: str):
        graph = hostile_graph(home_tbox, options=GraphOptions(annotations="rdf12"))
        write_graph(graph, tmp_path / f"a{ending}")
        assert list(read_document(tmp_path / f"a{ending}").triples) == list(graph.triples)

    @pytest.mark.parametrize(("ending", "name"), [(".rdf", "RDF/XML"), (".jsonld", "JSON-LD"), (".ofn", "OWL")])
    def test_formats_without_triple_terms_raise_and_write_nothing(
        self, tmp_path: Path, home_tbox: TBox, ending: str, name: str
    ):
        graph = hostile_graph(home_tbox, options=GraphOptions(annotations="rdf12"))
        with pytest.raises(GraphError, match=f"needs RDF 1.2, which {name} lacks; choose .ttl"):
            write_graph(graph, tmp_path / f"a{ending}")
        assert list(tmp_path.iterdir()) == []


class TestJsonLd:
    def test_pyoxigraph_and_rdflib_read_the_same_triples(self, graph: KnowledgeGraph):
        data = serialize_graph(graph, ox.RdfFormat.JSON_LD)
        assert [quad.triple for quad in ox.parse(data, format=ox.RdfFormat.JSON_LD)] == list(graph.triples)
        expected = rdflib.Graph().parse(data=serialize_graph(graph, ox.RdfFormat.N_TRIPLES), format="nt")
        assert to_isomorphic(rdflib.Graph().parse(data=data, format="json-ld")) == to_isomorphic(expected)

    def test_is_deterministic_standard_json_ld(self, home_tbox: TBox):
        first, second = (serialize_graph(hostile_graph(home_tbox), ox.RdfFormat.JSON_LD) for _ in range(2))
        assert first == second
        nodes = {node["@id"]: node for node in json.loads(first)}
        bowl = nodes["https://my.lab/k/Room.Bowl"]
        assert bowl["http://www.ease-crc.org/ont/SOMA.owl#isOntopOf"] == [{"@id": "https://my.lab/k/Room.Table"}]

    @settings(deadline=None, max_examples=60)
    @given(
        st.lists(
            st.tuples(
                st.sampled_from([str(U2K.gap.value), str(RDFS.label.value), "https://x.org/p#q", str(U2K.near.value)]),
                st.one_of(
                    st.builds(lambda v: ox.Literal(repr(v), datatype=XSD.double), st.floats(allow_nan=False)),
                    st.builds(lambda v: ox.Literal(repr(v), datatype=XSD["float"]), st.floats(-9, 9, width=16)),
                    st.builds(lambda v: ox.Literal(str(v), datatype=XSD.integer), st.integers(-(2**60), 2**60)),
                    st.builds(lambda v: ox.Literal(v, datatype=XSD.boolean), st.sampled_from(["true", "false", "1"])),
                    st.builds(ox.Literal, st.text(st.characters(exclude_categories=["Cs"]), max_size=9)),
                    st.builds(lambda v: ox.Literal(v, language="de"), st.text("ab", max_size=3)),
                    st.sampled_from(
                        [ox.NamedNode(iri) for iri in ("https://my.lab/k/a", "https://my.lab/k/", "urn:x:1", "u2k:z")]
                    ),
                ),
            ),
            max_size=8,
        )
    )
    def test_any_literal_survives_a_round_trip(self, said: list[tuple[str, Any]]):
        triples = tuple(dict.fromkeys(say(predicate, value) for predicate, value in said))
        data = serialize_graph(document(*triples), ox.RdfFormat.JSON_LD)
        assert [quad.triple for quad in ox.parse(data, format=ox.RdfFormat.JSON_LD)] == list(triples)


class TestFunctionalSyntax:
    def test_horned_owl_reads_the_same_axioms(self, tmp_path: Path, graph: KnowledgeGraph):
        write_graph(graph, tmp_path / "a.ofn")
        write_graph(graph, tmp_path / "a.rdf")
        found = pyhornedowl.open_ontology_from_file(str(tmp_path / "a.ofn"), serialization="ofn")
        expected = pyhornedowl.open_ontology_from_file(str(tmp_path / "a.rdf"), serialization="rdf")
        assert components(found) == components(expected)
        kinds = [type(item.component).__name__ for item in found.get_components()]
        types = [
            t for t in graph.triples if t.predicate == RDF.type and str(t.subject).startswith("<https://my.lab/k/")
        ]
        named = [t for t in types if t.object == OWL.NamedIndividual]
        assert kinds.count("ClassAssertion") == len(types) - len(named)
        assert kinds.count("Import") == len(graph.imports)

    def test_annotations_stay_on_their_axioms(self, tmp_path: Path, graph: KnowledgeGraph):
        write_graph(graph, tmp_path / "a.ofn")
        found = pyhornedowl.open_ontology_from_file(str(tmp_path / "a.ofn"), serialization="ofn")
        noted = [item for item in found.get_components() if item.ann]
        axioms = {t.subject for t in graph.triples if t.object == OWL.Axiom}
        assert len(noted) == len(axioms)
        cup = next(i for i in noted if "Cup" in str(i.component) and type(i.component).__name__ == "ClassAssertion")
        assert any("0.75" in str(note) for note in cup.ann)


def components(ontology: Any) -> list[str]:
    return sorted(f"{item.component} {sorted(map(str, item.ann))}" for item in ontology.get_components())


class TestPropertyGraph:
    def test_both_profiles_give_the_same(self, home_tbox: TBox):
        soma, plain = (read_property_graph(document_of(hostile_graph(home_tbox, name))) for name in PROFILES)
        assert soma == plain

    def test_an_object_is_one_node_with_its_numbers(self, home_tbox: TBox):
        found = read_property_graph(document_of(hostile_graph(home_tbox)))
        nodes = {node.properties["path"]: node for node in found.nodes}
        assert set(nodes) == {"/Room/Table", "/Room/Table/Cup-1.b", "/Room/Löffel", "/Room/Bowl", "/Room/hinge"}
        cup = nodes["/Room/Table/Cup-1.b"]
        assert cup.labels[:2] == ("Thing", "Object")
        assert cup.labels[-2:] == ("Crockery", "Cup")
        assert (cup.properties["width"], cup.properties["mass"], cup.properties["confidence"]) == (0.1, 0.25, 0.75)
        assert math.isclose(float(cup.properties["centerX"]), 0.25)
        assert cup.properties["material"] == "=cmd | a;b"
        spoon = nodes["/Room/Löffel"]
        assert spoon.labels == ("Thing", "Object")
        assert (spoon.properties["red"], spoon.properties["green"], spoon.properties["status"]) == (1.0, 0.5, "refused")
        assert nodes["/Room/hinge"].labels == ("Thing", "Joint", "RevoluteJoint")
        assert nodes["/Room/hinge"].properties["upperLimit"] == 1.5

    def test_relations_are_edges_each_once(self, home_tbox: TBox):
        found = read_property_graph(document_of(hostile_graph(home_tbox)))
        edges = {(e.start.rpartition("/")[2], e.type, e.end.rpartition("/")[2]): e.properties for e in found.edges}
        assert edges["Room.Bowl", "ON", "Room.Table"]["rule"] == "on/1"
        assert edges["Room.Table.Cup%2D1%2Eb", "PART_OF", "Room.Table"] == {"rule": "part-of/1"}
        assert edges["Room.hinge-joint", "PARENT", "Room.Table"] == {}
        assert ("Room.hinge-joint", "CHILD", "Room.Table.Cup%2D1%2Eb") in edges
        for start, kind, end in edges:
            assert kind not in {"NEXT_TO", "NEAR", "TOUCHING"} or (end, kind, start) not in edges
            assert kind != "BELOW"

    def test_triple_terms_say_the_same(self, home_tbox: TBox):
        owl, rdf12 = (hostile_graph(home_tbox, options=GraphOptions(annotations=kind)) for kind in ("owl", "rdf12"))
        assert read_property_graph(document_of(owl)) == read_property_graph(document_of(rdf12))

    def test_a_graph_without_objects_is_an_error(self):
        with pytest.raises(GraphError, match=r"test\.ttl: holds no object with a u2k:primPath"):
            read_property_graph(document(say("https://x.org/p", ox.Literal("x"))))

    def test_networkx_reads_the_graphml(self, tmp_path: Path, graph: KnowledgeGraph):
        write_graph(graph, tmp_path / "a.graphml")
        found = nx.read_graphml(tmp_path / "a.graphml", force_multigraph=True)
        expected = read_property_graph(document_of(graph))
        assert found.is_directed()
        assert set(found.nodes) == {node.id for node in expected.nodes}
        for node in expected.nodes:
            data = dict(found.nodes[node.id])
            assert data.pop("labels") == "".join(f":{name}" for name in node.labels)
            assert {"name": data.pop("label"), **data} == node.properties
        edges = [(a, b, data.pop("label"), data) for a, b, data in found.edges(data=True)]
        key = str
        assert sorted(edges, key=key) == sorted(
            ((e.start, e.end, e.type, dict(e.properties)) for e in expected.edges), key=key
        )

    def test_characters_that_xml_has_not_are_replaced_in_graphml(self, tmp_path: Path):
        node = ox.NamedNode("https://my.lab/k/a")
        triples = [ox.Triple(node, U2K.primPath, ox.Literal("/a")), ox.Triple(node, RDFS.label, ox.Literal("a\x01b"))]
        write_graph(document(*triples), tmp_path / "a.graphml")
        assert nx.read_graphml(tmp_path / "a.graphml").nodes[node.value]["label"] == "a\ufffdb"


class TestNeo4j:
    def test_the_files_hold_the_property_graph(self, tmp_path: Path, graph: KnowledgeGraph):
        expected = read_property_graph(document_of(graph))
        paths = write_neo4j(expected, tmp_path / "neo4j")
        assert [path.name for path in paths] == ["nodes.csv", "relationships.csv", "load.cypher"]
        nodes = rows(paths[0])
        assert [(row.pop("iri:ID"), row.pop(":LABEL")) for row in nodes] == [
            (node.id, ";".join(node.labels)) for node in expected.nodes
        ]
        assert [typed(row) for row in nodes] == [node.properties for node in expected.nodes]
        edges = rows(paths[1])
        assert [(row.pop(":START_ID"), row.pop(":END_ID"), row.pop(":TYPE")) for row in edges] == [
            (edge.start, edge.end, edge.type) for edge in expected.edges
        ]
        assert [typed(row) for row in edges] == [edge.properties for edge in expected.edges]

    def test_the_script_knows_every_column_label_and_type(self, tmp_path: Path, graph: KnowledgeGraph):
        found = read_property_graph(document_of(graph))
        nodes, edges, script = (path.read_text("utf-8") for path in write_neo4j(found, tmp_path))
        for name in (*nodes.splitlines()[0].split(","), *edges.splitlines()[0].split(",")):
            assert f"row.`{name}`" in script
        for label in {label for node in found.nodes for label in node.labels}:
            assert f"'{label}' IN labels" in script
        for kind in {edge.type for edge in found.edges}:
            assert f"[r:{kind}]" in script

    def test_a_label_cannot_leave_its_place(self, tmp_path: Path):
        node, cls = ox.NamedNode("https://my.lab/k/a"), ox.NamedNode("https://x.org/o#C'.();DROP")
        triples = [ox.Triple(node, U2K.primPath, ox.Literal("/a")), ox.Triple(node, RDF.type, cls)]
        found = read_property_graph(document(*triples))
        assert found.nodes[0].labels == ("Thing", "Object", "C_____DROP")


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def typed(row: dict[str, str]) -> dict[str, object]:
    casts = {"double": float, "long": int, "boolean": "true".__eq__, "": str}
    found = {}
    for column, text in row.items():
        name, _, kind = column.partition(":")
        if text:
            found[name] = casts[kind](text)
    return found


def test_every_format_has_a_row_in_the_documents():
    page = (Path(__file__).parents[3] / "docs" / "formats.md").read_text("utf-8")
    for ending, known in GRAPH_FORMATS.items():
        assert f"`{ending}`" in page, known.name


@pytest.mark.parametrize("read", [load_graph, read_document, read_statements])
def test_a_text_that_is_too_long_is_refused_in_one_line(tmp_path: Path, read):
    path = tmp_path / "long.ttl"
    path.write_text(f'<a:a> <a:b> "{"x" * 2**24}" .', encoding="utf-8")
    with pytest.raises(GraphError, match=r"^[^\n]*long\.ttl: holds a text that is too long .*at most 16 MiB[^\n]*$"):
        read(path)
