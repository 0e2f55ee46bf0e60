"""Graphs of scenes, re-read and queried with SPARQL."""

from collections import Counter
from dataclasses import replace

import pyhornedowl
import pyoxigraph as ox
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.graph.records import BASE, ask, build_graph, ground_as, reread, select, thing
from tests.grounding.records import make_class, make_object, make_scene, make_tbox
from usd2kg.errors import GraphError
from usd2kg.graph import KnowledgeGraph, instantiate
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.grounding import Candidate, Prediction, Status, ground
from usd2kg.ontology import TBox, load_home_tbox
from usd2kg.scene import Scene

UPRIGHT = (0.0, 0.0, 0.0, 1.0)

TABLE = thing("/Room/Table_1", (0, 0, 0), (1.6, 0.8, 0.7), position=(0.8, 0.4, 0.0), orientation=UPRIGHT)
CUP = thing(
    "/Room/Cup_3", (1, 0.4, 0.7), (0.09, 0.12, 0.1), position=(1.0, 0.4, 0.81), orientation=UPRIGHT, mass_kg=0.25
)
APPLE = thing("/Room/Apple", (0.3, 0.3, 0.72), (0.08, 0.08, 0.08))
BOWL = thing("/Room/Bowl", (0.2, 0.2, 0.7), (0.3, 0.3, 0.1))
GHOST = make_object("/Room/Ghost")

ROOM = [(TABLE, "Table"), (CUP, "Cup"), (BOWL, "Bowl"), (APPLE, "DesignedArtifact"), (GHOST, None)]


@pytest.fixture(scope="module")
def graph(home_tbox: TBox) -> KnowledgeGraph:
    return build_graph(home_tbox, ROOM)


@pytest.fixture(scope="module")
def store(graph: KnowledgeGraph) -> ox.Store:
    return reread(graph)


@pytest.fixture(scope="module")
def plain(home_tbox: TBox) -> ox.Store:
    return reread(build_graph(home_tbox, ROOM, profile="plain"))


def parse_as_owl(graph: KnowledgeGraph) -> list[object]:
    """Return the axioms that an OWL parser finds in the graph, converted to RDF/XML."""
    data = ox.serialize(graph.triples, format=ox.RdfFormat.RDF_XML, prefixes=graph.prefixes)
    return list(pyhornedowl.open_ontology_from_string(data.decode(), serialization="rdf").get_components())


class TestObjects:
    def test_class_prim_label_and_path(self, store: ox.Store):
        assert select(store, "SELECT ?t { k:Room.Cup_3 a ?t }") == [
            ("http://www.ease-crc.org/ont/SOMA.owl#Cup",),
            ("http://www.w3.org/2002/07/owl#NamedIndividual",),
            ("https://ease-crc.org/ont/USD.owl#Prim",),
        ]
        assert ask(store, 'k:Room.Cup_3 rdfs:label "Cup_3" ; u2k:primPath "/Room/Cup_3"')

    def test_objects_are_members_of_the_stage(self, store: ox.Store):
        members = select(store, "SELECT ?o { ?s a usd:Stage ; dul:hasMember ?o }")
        assert members == [(f"{BASE}Room.{name}",) for name in ("Apple", "Bowl", "Cup_3", "Ghost", "Table_1")]
        assert not ask(store, "?s dul:hasPart ?o")
        assert not ask(store, "?s a usd:Stage, dul:PhysicalObject")

    def test_display_name_is_the_label(self, home_tbox: TBox):
        named = make_object("/a/obj_1", display_name="Omas Tasse")
        found = reread(build_graph(home_tbox, [(named, "Cup")]))
        assert ask(found, 'k:a.obj_1 rdfs:label "Omas Tasse" ; u2k:primPath "/a/obj_1"')

    def test_includes_the_superclasses(self, store: ox.Store):
        above = select(store, "SELECT ?c { soma:Cup rdfs:subClassOf* ?c }")
        names = {iri.rpartition("#")[2] for (iri,) in above}
        assert {"Cup", "Crockery", "Tableware", "DesignedContainer", "DesignedArtifact"} <= names
        assert ask(store, 'soma:Cup a owl:Class ; rdfs:label "cup"')
        assert not ask(store, "soma:Refrigerator ?p ?o"), "classes without instances are omitted"

    def test_an_object_without_a_class_has_status_and_explanation_only(self, store: ox.Store):
        assert select(store, "SELECT ?p ?v { k:Room.Ghost ?p ?v }") == sorted(
            [
                ("http://www.w3.org/1999/02/22-rdf-syntax-ns#type", "http://www.w3.org/2002/07/owl#NamedIndividual"),
                ("http://www.w3.org/1999/02/22-rdf-syntax-ns#type", "https://ease-crc.org/ont/USD.owl#Prim"),
                ("http://www.w3.org/2000/01/rdf-schema#label", "Ghost"),
                ("https://w3id.org/usd2kg#primPath", "/Room/Ghost"),
                ("https://w3id.org/usd2kg#status", "refused"),
                ("https://w3id.org/usd2kg#explanation", "not labelled"),
            ],
            key=str,
        )

    def test_counts(self, graph: KnowledgeGraph):
        assert (graph.individuals, graph.profile, graph.base, graph.iri) == (5, "soma", BASE, BASE.rstrip("/"))
        assert {iri.rpartition("#")[2]: count for iri, count in graph.classes.items()} == {
            "Table": 1,
            "Cup": 1,
            "Bowl": 1,
            "DesignedArtifact": 1,
        }
        assert len(graph.triples) == len(set(graph.triples))


class TestShape:
    def test_soma_box_pattern(self, store: ox.Store):
        found = store.query(
            "SELECT ?w ?l ?d ?h { k:Room.Cup_3 soma:hasShape ?s . ?s a soma:Shape ; dul:hasRegion ?b ."
            " ?b a soma:BoxShape ; soma:hasWidth ?w ; soma:hasLength ?l ; soma:hasDepth ?d ; soma:hasHeight ?h }",
            prefixes={**PREFIXES, "k": BASE},
        )
        ((width, length, depth, height),) = [tuple(row) for row in found]
        # The cup is 0.09 m along x, 0.12 m along y and 0.1 m tall.
        assert [node.value for node in (width, length, depth, height)] == ["0.12", "0.09", "0.09", "0.1"]
        xsd_float = "http://www.w3.org/2001/XMLSchema#float"
        assert {node.datatype.value for node in (width, length, depth, height)} == {xsd_float}

    def test_each_object_with_a_box_has_its_own_shape(self, store: ox.Store):
        pairs = select(store, "SELECT ?o ?s { ?o soma:hasShape ?s }")
        assert [o.rpartition(".")[2] for o, _ in pairs] == ["Apple", "Bowl", "Cup_3", "Table_1"]
        assert all(shape == f"{owner}-shape" for owner, shape in pairs)
        regions = select(store, "SELECT ?s ?b { ?s a soma:Shape ; dul:hasRegion ?b }")
        assert len({shape for shape, _ in regions}) == len({box for _, box in regions}) == len(regions) == 4

    def test_each_extent_is_written_once(self, store: ox.Store):
        for name in ("hasWidth", "hasLength", "hasDepth", "hasHeight"):
            counts = Counter(box for box, _ in select(store, f"SELECT ?b ?v {{ ?b soma:{name} ?v }}"))
            assert set(counts.values()) == {1}
            assert len(counts) == 4

    def test_box_centre(self, store: ox.Store):
        # 1 + 0.09/2, 0.4 + 0.12/2, 0.7 + 0.1/2
        assert ask(store, 'k:Room.Cup_3-box u2k:boxCenter "1.045 0.46 0.75"')

    def test_flat_object_has_height_zero(self, home_tbox: TBox):
        rug = thing("/rug", (0, 0, 0), (2, 1.5, 0))
        found = reread(build_graph(home_tbox, [(rug, "DesignedFurniture")]))
        assert ask(found, 'k:rug-box soma:hasHeight "0"^^xsd:float')


class TestPoseAndMass:
    def test_position_then_quaternion_in_the_world_frame(self, store: ox.Store):
        assert select(
            store,
            "SELECT ?d ?f { k:Room.Cup_3 soma:hasLocalization ?p . ?p a soma:Localization ; dul:hasRegion ?r ."
            " ?r a soma:6DPose ; soma:hasPositionData ?d ; soma:hasReferenceFrame ?f }",
        ) == [("1 0.4 0.81 0 0 0 1", "world")]

    def test_pose_needs_an_orientation(self, home_tbox: TBox):
        sheared = thing("/a", (0, 0, 0), (1, 1, 1), position=(0.0, 0.0, 0.0))
        found = reread(build_graph(home_tbox, [(sheared, "Cup")]))
        assert not ask(found, "?o soma:hasLocalization ?p")
        assert ask(found, "k:a soma:hasShape ?s")

    def test_mass_in_kilograms(self, store: ox.Store):
        assert ask(
            store,
            'k:Room.Cup_3 soma:hasMassAttribute ?m . ?m a soma:MassAttribute ; soma:hasMassValue "0.25"^^xsd:double',
        )

    def test_missing_mass_pose_or_box_gives_no_quality_node(self, store: ox.Store):
        assert select(store, "SELECT ?o { ?o soma:hasMassAttribute ?m }") == [(f"{BASE}Room.Cup_3",)]
        assert not ask(store, "k:Room.Apple soma:hasLocalization ?p")
        assert not ask(store, "k:Room.Ghost soma:hasShape|soma:hasLocalization|soma:hasMassAttribute ?x")


class TestJustification:
    QUERY = (
        "SELECT ?p ?v {{ ?x a owl:Axiom ; owl:annotatedSource k:Room.{0} ; owl:annotatedProperty {1} ;"
        " owl:annotatedTarget {2} ; ?p ?v . FILTER(!STRSTARTS(STR(?p), STR(owl:)) && ?p != rdf:type) }}"
    )

    def test_type_assertions_are_annotated(self, store: ox.Store):
        found = dict(select(store, self.QUERY.format("Cup_3", "rdf:type", "soma:Cup")))
        assert found == {
            "https://w3id.org/sssom/confidence": "0.75",
            "https://w3id.org/sssom/mapping_justification": "https://w3id.org/semapv/vocab/UnspecifiedMatching",
            "https://w3id.org/usd2kg#status": "grounded",
            "https://w3id.org/usd2kg#grounder": "by-hand",
            "https://w3id.org/usd2kg#evidence": "name",
            "https://w3id.org/usd2kg#explanation": "it is a Cup",
            "https://w3id.org/usd2kg#run": f"{BASE}-run",
        }

    def test_each_grounded_type_is_justified_once(self, store: ox.Store):
        rows = select(store, "SELECT ?o ?x { ?x owl:annotatedProperty rdf:type ; owl:annotatedSource ?o }")
        assert [o.rpartition(".")[2] for o, _ in rows] == ["Apple", "Bowl", "Cup_3", "Table_1"]

    def test_keeps_three_alternatives(self, home_tbox: TBox):
        scene = make_scene(CUP)
        names = ["Cup", "Glass", "Bowl", "Plate", "Pot"]
        iris = [home_tbox.resolve(name) for name in names]
        prediction = Prediction(
            CUP.prim_path, iris[0], 0.5, Status.GROUNDED, "by-hand", "", (), tuple(Candidate(i, 0.1) for i in iris)
        )
        grounding = replace(ground_as(home_tbox, scene, {}), predictions=(prediction,))
        found = reread(instantiate(scene, home_tbox, grounding, base=BASE))
        others = select(found, "SELECT ?c { ?x u2k:alternative ?c }")
        assert {iri.rpartition("#")[2] for (iri,) in others} == {"Glass", "Bowl", "Plate"}

    def test_relations_are_annotated_with_rule_and_measurements(self, store: ox.Store):
        on = dict(select(store, self.QUERY.format("Cup_3", "soma:isOntopOf", "k:Room.Table_1")))
        assert on == {
            "https://w3id.org/usd2kg#rule": "on/1",
            "https://w3id.org/usd2kg#gap": "0",
            "https://w3id.org/sssom/confidence": "1",
            "https://w3id.org/usd2kg#overlapRatio": "1",
        }
        inside = dict(select(store, self.QUERY.format("Apple", "soma:isInsideOf", "k:Room.Bowl")))
        assert inside == {
            "https://w3id.org/usd2kg#rule": "inside/1",
            "https://w3id.org/usd2kg#insideRatio": "1",
            "https://w3id.org/sssom/confidence": "1",
        }

    def test_graph_has_no_time_stamp(self, graph: KnowledgeGraph):
        assert not any("dateTime" in str(triple) for triple in graph.triples)


class TestRelations:
    def test_on_includes_supported_by(self, store: ox.Store):
        on = select(store, "SELECT ?t ?a { ?t soma:isOntopOf ?a }")
        assert on == [(f"{BASE}Room.{t}", f"{BASE}Room.Table_1") for t in ("Bowl", "Cup_3")]
        assert select(store, "SELECT ?t ?a { ?t soma:isSupportedBy ?a }") == on

    def test_inside_is_written(self, store: ox.Store):
        assert select(store, "SELECT ?t ?a { ?t soma:isInsideOf ?a }") == [(f"{BASE}Room.Apple", f"{BASE}Room.Bowl")]


class TestConsistency:
    def test_avoids_inconsistent_terms(self, graph: KnowledgeGraph):
        used = {node.value for triple in graph.triples for node in triple if isinstance(node, ox.NamedNode)}
        local = {iri.rpartition("#")[2] for iri in used}
        assert not local & {"Color", "hasColor", "isPhysicallyContainedIn", "hasPart", "matrix4d", "vector3f"}

    def test_properties_have_one_declaration(self, home_tbox: TBox):
        kinds = ("owl:ObjectProperty", "owl:DatatypeProperty", "owl:AnnotationProperty")
        for profile in ("soma", "plain"):
            found = reread(build_graph(home_tbox, ROOM, profile=profile))
            declared = [row for kind in kinds for row in select(found, f"SELECT ?p {{ ?p a {kind} }}")]
            assert len(declared) == len(set(declared))
            used = select(found, "SELECT DISTINCT ?p { ?s ?p ?o }")
            built_in = ("http://www.w3.org/1999/02/22-rdf-syntax-ns#", "http://www.w3.org/2000/01/rdf-schema#")
            own = {row for row in used if not row[0].startswith((*built_in, "http://www.w3.org/2002/07/owl#"))}
            assert own <= set(declared), sorted(own - set(declared))

    def test_every_class_of_an_individual_is_declared(self, home_tbox: TBox):
        for profile in ("soma", "plain"):
            found = reread(build_graph(home_tbox, ROOM, profile=profile))
            assert not ask(
                found,
                "?i a owl:NamedIndividual, ?c . FILTER NOT EXISTS { ?c a owl:Class } FILTER(?c != owl:NamedIndividual)",
            )

    def test_aspect_iris_do_not_clash_with_prim_iris(self, home_tbox: TBox):
        # A cup with a child prim called `box`, both objects.
        child = thing("/Room/Cup_3/box", (1, 0.4, 0.7), (0.01, 0.01, 0.01))
        found = reread(build_graph(home_tbox, [(CUP, "Cup"), (child, "Box")]))
        assert ask(found, f"<{BASE}Room.Cup_3.box> a soma:Box")
        assert not ask(found, f"<{BASE}Room.Cup_3.box> a soma:BoxShape")
        assert not ask(found, f"<{BASE}Room.Cup_3-box> a usd:Prim")


class TestOwl:
    @pytest.mark.parametrize("profile", ["soma", "plain"])
    def test_owl_parser_reads_all_axioms(self, home_tbox: TBox, profile: str):
        graph = build_graph(home_tbox, ROOM, profile=profile)
        components = parse_as_owl(graph)
        kinds = Counter(type(item.component).__name__ for item in components)
        # At least one class assertion per grounded object.
        assert kinds["ClassAssertion"] >= 4
        assert kinds["ObjectPropertyAssertion"] >= 3
        assert kinds["DataPropertyAssertion"] >= 4
        assert kinds["SubClassOf"] >= 4

    def test_owl_parser_reads_axiom_annotations(self, graph: KnowledgeGraph):
        annotated = [
            item
            for item in parse_as_owl(graph)
            if type(item.component).__name__ == "ClassAssertion"
            and any("confidence" in str(annotation.ap.first) for annotation in item.ann)
        ]
        assert len(annotated) == 4


class TestProfiles:
    def test_plain_profile_writes_data_properties(self, plain: ox.Store):
        assert ask(
            plain,
            'k:Room.Cup_3 a u2k:Object, soma:Cup ; u2k:width "0.09"^^xsd:double ; u2k:depth "0.12"^^xsd:double ;'
            ' u2k:height "0.1"^^xsd:double ; u2k:mass "0.25"^^xsd:double ; u2k:position "1 0.4 0.81" ;'
            ' u2k:orientation "0 0 0 1" ; u2k:boxCenter "1.045 0.46 0.75" ; u2k:on k:Room.Table_1',
        )
        assert ask(plain, "k:Room.Apple u2k:inside k:Room.Bowl")
        assert len(select(plain, "SELECT ?o { ?s a u2k:Stage ; u2k:hasObject ?o }")) == 5

    def test_plain_profile_uses_no_external_properties(self, plain: ox.Store):
        used = select(plain, "SELECT DISTINCT ?p { ?s ?p ?o }")
        assert not [p for (p,) in used if "ease-crc" in p or "ontologydesignpatterns" in p]

    def test_auto_profile_depends_on_the_classes(self, home_tbox: TBox):
        lab = make_tbox(make_class("Cup"))
        assert build_graph(home_tbox, [(CUP, "Cup")]).profile == "soma"
        assert build_graph(lab, [(CUP, "Cup")]).profile == "plain"
        assert build_graph(lab, [(CUP, "Cup")], profile="soma").profile == "soma"

    def test_imports_ontologies_by_iri(self, home_tbox: TBox, store: ox.Store):
        assert select(store, "SELECT ?i { ?o owl:imports ?i }") == [
            ("http://www.ease-crc.org/ont/SOMA-HOME.owl",),
            ("https://ease-crc.org/ont/USD.owl",),
        ]
        nameless = replace(make_tbox(make_class("Cup")), ontology_iri="file:///somewhere/lab.ttl")
        assert not ask(reread(build_graph(nameless, [(CUP, "Cup")])), "?o owl:imports ?i")

    def test_rejects_an_unknown_profile(self, home_tbox: TBox):
        with pytest.raises(GraphError, match="profile 'owl' is unknown; expected one of auto, soma, plain"):
            build_graph(home_tbox, ROOM, profile="owl")

    def test_rejects_an_invalid_base(self, home_tbox: TBox):
        with pytest.raises(GraphError, match="base 'kitchen'"):
            build_graph(home_tbox, ROOM, base="kitchen")

    def test_default_base_is_derived_from_the_file_name(self, home_tbox: TBox):
        assert build_graph(home_tbox, ROOM, base=None).base == "https://example.org/room%20one/"


HOSTILE = [
    'a "quoted" cup',
    "back\\slash",
    "two\nlines\r\nand\ttab",
    "<script>alert('x')</script> & <b>bold</b>",
    '" . } ; DROP ALL ; { "',
    "}\n<http://evil> <http://evil> <http://evil> .",
    "Tasse für 杯子 🍵",
    "\u202eright to left",
    "",
]


class TestHostileText:
    @pytest.mark.parametrize("label", HOSTILE)
    @pytest.mark.parametrize("ending", [".ttl", ".nt"])
    def test_labels_round_trip(self, home_tbox: TBox, label: str, ending: str):
        cup = make_object("/Room/Cup", display_name=label)
        found = reread(build_graph(home_tbox, [(cup, "Cup")]), ending)
        assert select(found, "SELECT ?l { k:Room.Cup rdfs:label ?l }") == [(label or "Cup",)]
        assert not ask(found, "<http://evil> ?p ?o")

    def test_control_characters_become_the_replacement_character(self, home_tbox: TBox):
        cup = make_object("/Room/Cup", display_name="a\x00b\x1bc\x08d\x1fe")
        graph = build_graph(home_tbox, [(cup, "Cup")])
        assert select(reread(graph), "SELECT ?l { k:Room.Cup rdfs:label ?l }") == [("a\ufffdb\ufffdc\ufffdd\ufffde",)]
        assert parse_as_owl(graph)

    @pytest.mark.parametrize("code", [0xD800, 0xDFFF])
    def test_lone_surrogates_become_the_replacement_character(self, home_tbox: TBox, code: int):
        cup = make_object("/Room/Cup", display_name=f"a{chr(code)}b")
        found = reread(build_graph(home_tbox, [(cup, "Cup")]))
        assert select(found, "SELECT ?l { k:Room.Cup rdfs:label ?l }") == [("a\ufffdb",)]

    @settings(deadline=None, max_examples=40)
    @given(st.text(st.characters(exclude_categories=["Cs", "Cc"], exclude_characters="\ufffe\uffff"), min_size=1))
    def test_printable_text_round_trips(self, label: str):
        lab = make_tbox(make_class("Cup"))
        cup = make_object("/Room/Cup", display_name=label)
        for ending in (".ttl", ".nt"):
            found = reread(build_graph(lab, [(cup, "Cup")]), ending)
            assert select(found, "SELECT ?l { k:Room.Cup rdfs:label ?l }") == [(label,)]

    def test_unicode_paths_and_file_names(self, home_tbox: TBox):
        scene = make_scene(make_object("/Küche/杯子"), source='a "b" <c>\n.usda')
        graph = instantiate(scene, home_tbox, ground_as(home_tbox, scene, {"/Küche/杯子": "Cup"}))
        found = reread(graph)
        assert select(found, "SELECT ?p { ?o u2k:primPath ?p }") == [("/Küche/杯子",)]


def one_triple_each(graph: KnowledgeGraph, ending: str) -> set[str]:
    """Return the triples of the re-read graph, with blank nodes labelled by content."""
    store = reread(graph, ending)
    about: dict[object, set[str]] = {}
    for quad in store:
        about.setdefault(quad.subject, set()).add(f"{quad.predicate} {quad.object}")
    blank = {f"[{'; '.join(sorted(said))}]" for node, said in about.items() if isinstance(node, ox.BlankNode)}
    return blank | {str(quad) for quad in store if not isinstance(quad.subject, ox.BlankNode)}


class TestFormats:
    def test_turtle_and_n_triples_are_equivalent(self, graph: KnowledgeGraph):
        turtle, n_triples = (one_triple_each(graph, ending) for ending in (".ttl", ".nt"))
        assert turtle == n_triples
        assert len(reread(graph, ".ttl")) == len(reread(graph, ".nt")) == len(graph.triples)


def test_empty_grounding_writes_the_objects():
    tbox = load_home_tbox()
    scene: Scene = make_scene(CUP, TABLE)
    grounding = replace(ground_as(tbox, scene, {}), predictions=())
    found = reread(instantiate(scene, tbox, grounding, base=BASE))
    assert ask(found, "k:Room.Cup_3 a usd:Prim ; soma:hasShape ?s ; soma:isOntopOf k:Room.Table_1")


@pytest.fixture(scope="module", params=["soma", "plain"])
def with_concepts(home_tbox: TBox, request: pytest.FixtureRequest) -> ox.Store:
    scene = make_scene(make_object("/Room/couch_3"), make_object("/Room/Cube_7"))
    found = ground(scene, home_tbox)
    return reread(instantiate(scene, home_tbox, found, base=BASE, profile=request.param))


class TestConcepts:
    WORDNET = "http://wordnet-rdf.princeton.edu/id/"

    def test_an_object_has_the_concept_and_its_confidence(self, with_concepts: ox.Store):
        assert select(with_concepts, "SELECT ?o ?l { ?o u2k:concept/skos:prefLabel ?l }") == [
            (f"{BASE}Room.couch_3", "sofa")
        ]
        ((confidence,),) = select(with_concepts, "SELECT ?c { k:Room.couch_3 u2k:conceptConfidence ?c }")
        assert confidence is not None
        assert 0.5 < float(confidence) < 1

    def test_hypernyms_lead_to_the_root(self, with_concepts: ox.Store):
        above = select(with_concepts, "SELECT ?l { k:Room.couch_3 u2k:concept/skos:broader*/skos:prefLabel ?l }")
        assert {("sofa",), ("seat",), ("furniture",), ("artifact",), ("entity",)} <= {*above}
        assert ask(
            with_concepts, f"<{self.WORDNET}04263630-n> a skos:Concept ; skos:broader <{self.WORDNET}04169042-n>"
        )

    def test_every_hypernym_is_described(self, with_concepts: ox.Store):
        assert (
            select(with_concepts, "SELECT ?c { ?x skos:broader ?c . FILTER NOT EXISTS { ?c skos:prefLabel ?l } }") == []
        )
