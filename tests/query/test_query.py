"""Short questions and SPARQL queries over a graph."""

from pathlib import Path

import pytest

from tests.conftest import shared_file
from tests.graph.records import BASE, build_graph, open_store, thing
from tests.grounding.records import LAB, make_class, make_object, make_scene, make_tbox
from usd2kg.errors import GraphError
from usd2kg.graph import instantiate, write_graph
from usd2kg.grounding import ground
from usd2kg.ontology import TBox
from usd2kg.query import Answer, GraphStore, load_graph
from usd2kg.scene import read_scene

# A table with a mug, a plate, and an apple in a bowl on it; a wardrobe away from it.
ROOM = [
    (thing("/Room/Floor", (-5, -5, -0.1), (10, 10, 0.1)), "Floor"),
    (thing("/Room/DiningTable", (0, 0, 0), (1.6, 0.8, 0.7), display_name="dining table"), "Table"),
    (thing("/Room/mug_red", (1, 0.4, 0.7), (0.1, 0.1, 0.1)), "Cup"),
    (thing("/Room/plate_1", (0.6, 0.4, 0.7), (0.2, 0.2, 0.02)), "DinnerPlate"),
    (thing("/Room/FruitBowl", (0.1, 0.2, 0.7), (0.3, 0.3, 0.1)), "Bowl"),
    (thing("/Room/Apple", (0.2, 0.3, 0.72), (0.08, 0.08, 0.08)), "DesignedArtifact"),
    (thing("/Room/Wardrobe", (3, 3, 0), (1, 0.6, 2)), "Wardrobe"),
    (make_object("/Room/Ghost"), None),
]


@pytest.fixture(scope="module")
def store(home_tbox: TBox) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM))


@pytest.fixture(scope="module")
def plain(home_tbox: TBox) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM, profile="plain"))


def column(answer: Answer, name: str) -> list[str | None]:
    at = answer.columns.index(name)
    return [row[at] for row in answer.rows]


class TestOnAndIn:
    ON_TABLE = (
        ("FruitBowl", "bowl", "/Room/FruitBowl", "dining table", "0"),
        ("mug_red", "cup", "/Room/mug_red", "dining table", "0"),
        ("plate_1", "dinner plate", "/Room/plate_1", "dining table", "0"),
    )

    @pytest.mark.parametrize(
        "question",
        [
            "on dining table",
            "on the dining table",
            "What is on the dining table?",
            "what stands on the dining table ?",
            "what lies on top of the dining table",
            "ON DINING TABLE",
            "on table",
            "on /Room/DiningTable",
            "on the DiningTable",
        ],
    )
    def test_what_is_on_the_table(self, store: GraphStore, question: str):
        answer = store.ask(question.split())
        assert answer.columns == ("object", "class", "path", "anchor", "gap_m")
        assert answer.rows == self.ON_TABLE

    @pytest.mark.parametrize(
        "question",
        ["in fruit bowl", "what is in the bowl?", "inside of FruitBowl", "inside bowl"],
    )
    def test_what_is_in_the_bowl(self, store: GraphStore, question: str):
        answer = store.ask(question.split())
        assert answer.columns == ("object", "class", "path", "anchor", "inside_ratio")
        assert answer.rows == (("Apple", "artifact", "/Room/Apple", "FruitBowl", "1"),)

    def test_returns_no_rows_if_nothing_is_there(self, store: GraphStore):
        assert store.ask(["on", "wardrobe"]).rows == ()
        assert store.ask(["in", "wardrobe"]).rows == ()
        assert store.ask(["on", "Ghost"]).rows == ()

    def test_a_class_name_selects_all_its_objects(self, store: GraphStore):
        # Furniture: the table and the wardrobe.
        assert column(store.ask(["on", "furniture"]), "object") == ["FruitBowl", "mug_red", "plate_1"]

    def test_both_profiles_give_the_same_answers(self, store: GraphStore, plain: GraphStore):
        for question in ("on dining table", "in bowl", "where is mug", "all of crockery"):
            assert plain.ask(question.split()).rows == store.ask(question.split()).rows

    def test_methods_and_short_questions_agree(self, store: GraphStore):
        assert store.on("dining table") == store.ask(["on", "dining table"])
        assert store.inside("bowl") == store.ask(["in", "bowl"])
        assert store.where_is("mug") == store.ask(["where", "is", "mug"])
        assert store.all_of("cup") == store.ask(["all", "of", "cup"])


class TestWhere:
    @pytest.mark.parametrize("question", ["where is the mug?", "Where is mug_red", "where's mug red", "where mug"])
    def test_locates_an_object_on_another(self, store: GraphStore, question: str):
        answer = store.ask(question.split())
        assert answer.columns == ("object", "class", "path", "center_m", "on", "inside", "attached_to", "room")
        # The middle of the box: 1 + 0.05, 0.4 + 0.05, 0.7 + 0.05.
        assert answer.rows == (
            ("mug_red", "cup", "/Room/mug_red", "1.05 0.45 0.75", "dining table", None, None, "Room"),
        )

    def test_locates_an_object_in_a_container(self, store: GraphStore):
        (row,) = store.ask(["where", "is", "the", "apple"]).rows
        assert row == ("Apple", "artifact", "/Room/Apple", "0.24 0.34 0.76", None, "FruitBowl", None, "Room")

    def test_lists_an_object_without_box_and_class(self, store: GraphStore):
        (row,) = store.ask(["where", "is", "ghost"]).rows
        assert row == ("Ghost", None, "/Room/Ghost", None, None, None, None, None)

    def test_locates_all_objects_of_a_class(self, store: GraphStore):
        assert column(store.ask(["where", "are", "crockery"]), "object") == ["FruitBowl", "mug_red", "plate_1"]


class TestAllOf:
    def test_includes_subclasses(self, store: GraphStore):
        answer = store.ask(["all", "of", "crockery"])
        assert answer.columns == ("object", "class", "concept", "path", "confidence")
        assert answer.rows == (
            ("FruitBowl", "bowl", None, "/Room/FruitBowl", "0.75"),
            ("mug_red", "cup", None, "/Room/mug_red", "0.75"),
            ("plate_1", "dinner plate", None, "/Room/plate_1", "0.75"),
        )

    def test_excludes_superclasses(self, store: GraphStore):
        assert column(store.ask(["all", "of", "plate"]), "object") == ["plate_1"]
        assert column(store.ask(["all", "of", "dinner plate"]), "object") == ["plate_1"]

    @pytest.mark.parametrize(
        "name", ["dinner plate", "DinnerPlate", "Dinner Plate", "http://www.ease-crc.org/ont/SOMA.owl#DinnerPlate"]
    )
    def test_accepts_label_local_name_and_iri(self, store: GraphStore, name: str):
        assert column(store.all_of(name), "object") == ["plate_1"]

    def test_an_unknown_class_lists_the_known_ones(self, store: GraphStore):
        with pytest.raises(GraphError) as error:
            store.ask(["all", "of", "helicopter"])
        assert "no class or concept is named 'helicopter'" in str(error.value)
        assert "one of the classes artifact, bowl, cup, dinner plate, floor, table, wardrobe" in str(error.value)


class TestFinding:
    def found(self, store: GraphStore, thing: str) -> list[str]:
        return [node.value.removeprefix(f"{BASE}Room.") for node in store.find(thing)]

    def test_finds_by_path_label_class_and_words(self, store: GraphStore):
        assert self.found(store, "/Room/mug_red") == ["mug_red"]
        assert self.found(store, "DINING table") == ["DiningTable"]
        assert self.found(store, "plate") == ["plate_1"]
        assert self.found(store, "red mug") == ["mug_red"]
        assert self.found(store, "fruit") == ["FruitBowl"]

    def test_ignores_articles(self, store: GraphStore):
        assert self.found(store, "the  wardrobe") == self.found(store, "a wardrobe") == ["Wardrobe"]

    def test_prefers_labels_to_classes_and_classes_to_words(self, home_tbox: TBox):
        room = [
            (make_object("/a/cup", display_name="Cup"), "DesignedArtifact"),
            (make_object("/a/thing1"), "Cup"),
            (make_object("/a/cup_holder"), "DesignedArtifact"),
        ]
        store = open_store(build_graph(home_tbox, room))
        assert [node.value for node in store.find("cup")] == [f"{BASE}a.cup"]
        store = open_store(build_graph(home_tbox, room[1:]))
        assert [node.value for node in store.find("cup")] == [f"{BASE}a.thing1"]
        store = open_store(build_graph(home_tbox, room[2:]))
        assert [node.value for node in store.find("cup")] == [f"{BASE}a.cup_holder"]

    def test_requires_all_words(self, store: GraphStore):
        with pytest.raises(GraphError):
            store.find("green mug")

    @pytest.mark.parametrize(
        ("thing", "message"),
        [
            ("helicopter", "there is no helicopter; expected a label, a class, a noun or a prim path"),
            ("bwl", "'bwl' is not understood; did you mean bowl?"),
            ("flurbl", "'flurbl' is not a word that this graph or the lexicon knows"),
            ("?", "'?' names no thing"),
            ("the", "'the' names no thing"),
            ("", "'' names no thing"),
            ("/Room/None", "'/Room/None' is not a word"),
            ("''", "\"''\" is not a word"),
        ],
    )
    def test_rejects_an_unknown_name(self, store: GraphStore, thing: str, message: str):
        with pytest.raises(GraphError) as error:
            store.find(thing)
        assert str(error.value).startswith("room.ttl: ")
        assert message in str(error.value)

    def test_reads_misspelt_and_foreign_words_and_says_so(self, store: GraphStore, caplog: pytest.LogCaptureFixture):
        assert self.found(store, "wardobe") == ["Wardrobe"]
        assert "“wardobe” was read as “wardrobe”" in caplog.text
        assert self.found(store, "Schüssel") == ["FruitBowl"]
        assert "“schüssel” was read as “bowl”" in caplog.text

    def test_a_noun_phrase_may_have_a_relation(self, store: GraphStore):
        expected = ["FruitBowl", "mug_red", "plate_1"]
        assert self.found(store, "crockery on the dining table") == expected
        assert self.found(store, "crockery atop the dining table") == expected

    def test_numbers_distinguish_labels(self, home_tbox: TBox):
        room = [(make_object(f"/a/box_{number}"), "Box") for number in ("1", "02", "12")]
        store = open_store(build_graph(home_tbox, room))
        assert [node.value for node in store.find("box 2")] == [f"{BASE}a.box_02"]
        assert len(store.find("boxes")) == 3

    @pytest.mark.parametrize(
        "name",
        [
            '"} ; ?s ?p ?o . {"',
            "> } UNION { ?o ?p <http://evil",
            "'; DROP ALL; --",
            "\\u003e } { ?s ?p ?o }",
            "{anchors} {things} {0}",
            "%s %(x)s",
        ],
    )
    def test_labels_cannot_inject_sparql(self, home_tbox: TBox, name: str):
        room = [
            (thing("/Room/Table", (0, 0, 0), (1, 1, 0.7), display_name=name), "Table"),
            (thing("/Room/Cup", (0.4, 0.4, 0.7), (0.1, 0.1, 0.1)), "Cup"),
            (thing("/Room/Apart", (5, 5, 0), (0.1, 0.1, 0.1)), "Cup"),
        ]
        store = open_store(build_graph(home_tbox, room))
        assert store.on(name).rows == (("Cup", "cup", "/Room/Cup", name, "0"),)
        assert column(store.where_is(name), "object") == [name]

    def test_prim_paths_and_class_labels_cannot_inject_sparql(self):
        iri_like = make_tbox(make_class("Cup", label='cup"> } #'))
        store = open_store(build_graph(iri_like, [(make_object("/Küche/Cup"), "Cup")]))
        assert column(store.all_of('cup"> } #'), "path") == ["/Küche/Cup"]


class TestQuestions:
    @pytest.mark.parametrize(
        "question", ["", "?", "on", "in ", "where", "all", "how many cups", "table", "is it on", "from X"]
    )
    def test_an_unknown_question_lists_the_known_ones(self, store: GraphStore, question: str):
        with pytest.raises(GraphError) as error:
            store.ask(question.split())
        for known in ("'on X'", "'in X'", "'where is X'", "'all of KIND'", "--sparql"):
            assert known in str(error.value)

    def test_the_answer_contains_its_query(self, store: GraphStore):
        answer = store.ask(["on", "dining table"])
        assert store.sparql(answer.sparql).rows == answer.rows


class TestSparql:
    def test_select_keeps_column_and_row_order(self, store: GraphStore):
        answer = store.sparql("SELECT ?l ?o { ?o a soma:Cup ; rdfs:label ?l }")
        row = ("mug_red", f"{BASE}Room.mug_red")
        assert answer == Answer(("l", "o"), (row,), (row,), answer.sparql)

    def test_values_are_typed_and_rows_are_text(self, store: GraphStore):
        query = "SELECT (1 AS ?i) (2.5e0 AS ?d) (true AS ?b) ('07' AS ?t) ?none WHERE {}"
        answer = store.sparql(query)
        assert answer.values == ((1, 2.5, True, "07", None),)
        assert answer.rows[0][0] == "1"
        down = store.sparql("SELECT ?p { ?o u2k:primPath ?p } ORDER BY DESC(?p)")
        assert column(down, "p") == sorted(column(down, "p"), reverse=True)

    def test_unbound_variables_are_none(self, store: GraphStore):
        answer = store.sparql("SELECT ?o ?x { ?o a soma:Cup OPTIONAL { ?o soma:hasMassAttribute ?x } }")
        assert answer.rows == ((f"{BASE}Room.mug_red", None),)

    def test_ask(self, store: GraphStore):
        assert store.sparql("ASK { ?o a soma:Cup }").rows == (("true",),)
        assert store.sparql("ASK { ?o a soma:Oven }").rows == (("false",),)

    def test_construct_and_describe(self, store: GraphStore):
        answer = store.sparql("CONSTRUCT { ?o rdfs:comment ?l } WHERE { ?o a soma:Cup ; rdfs:label ?l }")
        assert answer.columns == ("subject", "predicate", "object")
        assert answer.rows == ((f"{BASE}Room.mug_red", "http://www.w3.org/2000/01/rdf-schema#comment", "mug_red"),)
        assert store.sparql(f"DESCRIBE <{BASE}Room.mug_red>").rows

    def test_superclass_queries_need_no_reasoner(self, store: GraphStore):
        answer = store.sparql("SELECT ?l { ?o a/rdfs:subClassOf* soma:Tableware ; rdfs:label ?l } ORDER BY ?l")
        assert column(answer, "l") == ["FruitBowl", "mug_red", "plate_1"]

    @pytest.mark.parametrize(
        "query",
        ["DELETE WHERE { ?s ?p ?o }", "INSERT DATA { <urn:a> <urn:b> <urn:c> }", "DROP ALL", "CLEAR DEFAULT"],
    )
    def test_refuses_updates(self, store: GraphStore, query: str):
        before = len(store.store)
        with pytest.raises(GraphError, match="expected SELECT, ASK, CONSTRUCT or DESCRIBE"):
            store.sparql(query)
        assert len(store.store) == before > 0

    @pytest.mark.parametrize(
        ("query", "message"),
        [
            ("", "query: is empty; expected SELECT, ASK, CONSTRUCT or DESCRIBE"),
            ("SELECT", "query: not valid SPARQL at line 1, column 7, at the end"),
            ("what is on the table", "query: begins with 'what'; expected SELECT, ASK, CONSTRUCT or DESCRIBE"),
            ("DROP ALL", "query: begins with DROP, which changes data; expected SELECT, ASK, CONSTRUCT or DESCRIBE"),
            (
                "PREFIX a: <urn:a#>\n# b:c\nSELECT * {\n ?x a:b ?y .\n ?y nope:y 'c:d' }",
                "line 5, column 5: the prefix nope: ",
            ),
            ("SELECT * {\n  ?x ?p ?o LIMIT 3 }", "at line 2, column 20, before '}'"),
            ("ASK { <http://a b> ?p ?o }", "at line 1, column 19, before '?p ?o }': IRI parsing failed"),
            ("SELECT ?s { ?s ?p ?o", "at line 1, column 21, at the end; expected one of , . ; { {| } ~"),
        ],
    )
    def test_a_syntax_error_is_one_line_with_its_place(self, store: GraphStore, query: str, message: str):
        with pytest.raises(GraphError) as error:
            store.sparql(query)
        assert message in str(error.value)
        assert "\n" not in str(error.value)
        assert "\\u{" not in str(error.value)

    def test_an_unknown_function_is_one_line(self, store: GraphStore):
        with pytest.raises(GraphError, match=r"query: cannot be answered .*<urn:f> is not supported"):
            store.sparql("SELECT (<urn:f>(?p) AS ?x) { ?o u2k:primPath ?p }")

    def test_hints_at_names_that_the_graph_lacks(self, store: GraphStore):
        query = "SELECT * { ?o u2k:primpath ?p ; a soma:Cups, u2k:Nothing ; rdfs:label 'u2k:text' } # u2k:comment"
        assert store.hints(query) == [
            "u2k:primpath is not in the graph; did you mean u2k:primPath?",
            "soma:Cups is not in the graph; did you mean soma:Cup?",
            "u2k:Nothing is not in the graph",
        ]
        assert store.hints("SELECT * { ?o u2k:primPath ?p FILTER(u2kf:gap(?o, ?o) < 1) }") == []

    @pytest.mark.parametrize(
        "query",
        [
            "SELECT ?s { SERVICE <http://127.0.0.1:9/> { ?s ?p ?o } }",
            "ASK { SERVICE <http://127.0.0.1:9/> { ?s ?p ?o } }",
            "CONSTRUCT { ?s ?p ?o } WHERE { SERVICE <http://127.0.0.1:9/> { ?s ?p ?o } }",
        ],
    )
    def test_refuses_service_clauses(self, store: GraphStore, query: str):
        with pytest.raises(GraphError, match="SERVICE contacts another server"):
            store.sparql(query)


class TestLoading:
    @pytest.mark.parametrize("ending", [".ttl", ".nt", ".TTL"])
    def test_loads_a_written_graph(self, tmp_path: Path, home_tbox: TBox, ending: str):
        path = tmp_path / f"room{ending}"
        graph = build_graph(home_tbox, ROOM)
        write_graph(graph, path)
        store = load_graph(path)
        assert len(store.store) == len(graph.triples)
        assert store.ask(["on", "dining table"]).rows == TestOnAndIn.ON_TABLE

    def test_loads_named_graphs_as_their_union(self, tmp_path: Path):
        path = tmp_path / "two.trig"
        path.write_text("<urn:g> { <urn:a> <urn:b> 'x' } <urn:h> { <urn:a> <urn:b> 'y' }", encoding="utf-8")
        assert load_graph(path).sparql("SELECT ?o { ?s ?p ?o } ORDER BY ?o").rows == (("x",), ("y",))

    @pytest.mark.parametrize(
        ("name", "data", "message"),
        [
            ("none.ttl", None, "no such file"),
            ("graph.txt", b"", "the ending '.txt' names no RDF format; expected one of .ttl, .nt"),
            ("graph", b"", "the ending '' names no RDF format"),
            ("graph.ttl", b"this is not turtle", "does not parse as Turtle"),
            ("graph.nt", b"<urn:a> <urn:b> .", "does not parse as N-Triples"),
            ("graph.ttl", b"\xff\xfe\x00binary", "does not parse as Turtle"),
            ("graph.ttl", b"<urn:a> <urn:b> 'never closed", "does not parse as Turtle"),
        ],
    )
    def test_an_unreadable_file_is_a_one_line_error_with_its_path(
        self, tmp_path: Path, name: str, data: bytes | None, message: str
    ):
        path = tmp_path / name
        if data is not None:
            path.write_bytes(data)
        with pytest.raises(GraphError) as error:
            load_graph(path)
        assert str(path) in str(error.value)
        assert message in str(error.value)
        assert "\n" not in str(error.value)

    def test_rejects_a_folder(self, tmp_path: Path):
        folder = tmp_path / "graph.ttl"
        folder.mkdir()
        with pytest.raises(GraphError, match=r"graph\.ttl"):
            load_graph(folder)

    def test_an_empty_graph_has_no_objects(self, tmp_path: Path):
        path = tmp_path / "empty.ttl"
        path.write_text("", encoding="utf-8")
        store = load_graph(path)
        assert len(store.store) == 0
        with pytest.raises(GraphError, match="there is no table"):
            store.ask(["on", "table"])


@pytest.fixture(scope="module")
def hall() -> GraphStore:
    tbox = make_tbox(make_class("Asset"), make_class("Table", "Asset", label="table"))
    scene = make_scene(
        thing("/Hall/couch_1", (0, 0, 0), (2, 0.9, 0.8)),
        thing("/Hall/BookE_01", (4, 0, 0.7), (0.15, 0.2, 0.03)),
        thing("/Hall/coffee_table", (4, 0, 0), (1, 1, 0.7)),
    )
    return open_store(instantiate(scene, tbox, ground(scene, tbox), base=BASE))


class TestKinds:
    """Concepts are found whatever the classes are."""

    @pytest.mark.parametrize("noun", ["couch", "sofa", "sofas", "seats", "a couch", "Couches"])
    def test_all_of_a_noun(self, hall: GraphStore, noun: str):
        assert column(hall.ask(["all", "of", noun.removeprefix("a ")]), "path") == ["/Hall/couch_1"]
        assert column(hall.ask(["where", "is", noun]), "path") == ["/Hall/couch_1"]

    def test_the_answer_has_class_concept_and_confidence_of_what_matched(self, hall: GraphStore):
        answer = hall.ask(["all", "of", "book"])
        assert answer.columns == ("object", "class", "concept", "path", "confidence")
        ((name, label, concept, _, confidence),) = answer.values
        assert (name, label, concept) == ("BookE_01", "Asset", "book")
        ((stated,),) = hall.sparql("SELECT ?c { ?o u2k:conceptConfidence ?c ; rdfs:label 'BookE_01' }").values
        assert confidence == stated

    def test_an_object_of_a_class_and_a_concept_has_the_confidence_of_the_class(self, hall: GraphStore):
        answer = hall.ask(["all", "of", "table"])
        ((_, label, _, _, confidence),) = answer.values
        stated = hall.sparql("SELECT ?c { ?x owl:annotatedTarget ?t ; sssom:confidence ?c . ?t rdfs:label 'table' }")
        assert (label, confidence) == ("table", stated.values[0][0])

    def test_furniture_is_of_two_classes(self, hall: GraphStore):
        answer = hall.ask(["all", "of", "furniture"])
        assert column(answer, "path") == ["/Hall/coffee_table", "/Hall/couch_1"]
        assert column(answer, "class") == ["table", "Asset"]

    def test_relations_are_asked_with_nouns(self, hall: GraphStore):
        assert column(hall.ask(["on", "the", "coffee", "table"]), "path") == ["/Hall/BookE_01"]
        assert column(hall.ask(["on", "furniture"]), "path") == ["/Hall/BookE_01"]

    def test_ready_questions_take_nouns(self, hall: GraphStore):
        nearest = hall.answer("nearest", {"thing": "/Hall/BookE_01", "class": "sofa"})
        assert column(nearest, "path") == ["/Hall/couch_1"]

    def test_a_name_means_class_and_concept(self):
        # The class has the label of a concept. One table is of another class, and one has no name.
        tbox = make_tbox(make_class("Asset"), make_class("Desk", "Asset", label="table"))
        scene = make_scene(*(make_object(f"/Hall/{name}") for name in ("table_1", "thing_2", "table_3")))
        grounding = ground(scene, tbox, decisions={"/Hall/thing_2": LAB + "Desk", "/Hall/table_3": LAB + "Asset"})
        store = open_store(instantiate(scene, tbox, grounding, base=BASE))
        paths = column(store.ask(["all", "of", "table"]), "path")
        assert paths == ["/Hall/table_1", "/Hall/table_3", "/Hall/thing_2"]

    def test_an_unknown_noun_is_an_error(self, hall: GraphStore):
        with pytest.raises(GraphError, match="no class or concept is named 'dragon'; expected a noun"):
            hall.ask(["all", "of", "dragon"])


def test_the_books_of_a_real_scene(home_tbox: TBox):
    scene = read_scene(shared_file("scenes/aws_robomaker/bookstore.usdc"))
    found = open_store(instantiate(scene, home_tbox, ground(scene, home_tbox), base=BASE)).ask(["all", "of", "book"])
    assert len(found.rows) == 39
    assert {*column(found, "class")} == {"artifact"}
