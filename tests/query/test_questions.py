"""Ready questions on a small room, checked by hand, and on the authored layout of the demo kitchen."""

import csv
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import usd2kg
from tests.graph.records import build_graph, open_store, thing
from tests.kitchen import kitchen_graph
from usd2kg.demo import demo_relations
from usd2kg.errors import GraphError
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.ontology import TBox
from usd2kg.query import Answer, GraphStore
from usd2kg.query.questions import list_questions, parse_number
from usd2kg.scene import Joint

# A table of 40 kg with a mug and an apple in a bowl, a lamp over it; a crate in front of a cabinet with a door.
ROOM = [
    (thing("/Room/Floor", (-5, -5, -0.1), (10, 10, 0.1)), "Floor"),
    (thing("/Room/Table", (0, 0, 0), (1.6, 0.8, 0.7), mass_kg=40.0), "Table"),
    (thing("/Room/Mug", (1, 0.4, 0.7), (0.1, 0.1, 0.1), mass_kg=0.3, asset=("mug",)), "Cup"),
    (thing("/Room/Bowl", (0.1, 0.2, 0.7), (0.3, 0.3, 0.1)), "Bowl"),
    (thing("/Room/Apple", (0.2, 0.3, 0.72), (0.08, 0.08, 0.08)), "DesignedArtifact"),
    (thing("/Room/Lamp", (0.5, 0.3, 1.7), (0.2, 0.2, 0.3)), "DesignedArtifact"),
    (thing("/Room/Cabinet", (3, 3, 0), (0.6, 0.5, 1)), "KitchenCabinet"),
    (thing("/Room/Door", (3, 2.98, 0.02), (0.6, 0.02, 0.96)), "Door"),
    (thing("/Room/Crate", (3.2, 2.6, 0), (0.2, 0.2, 0.2)), "Box"),
    (thing("/Room/OtherMug", (4, 2, 0), (0.1, 0.1, 0.101), asset=("mug",)), "Cup"),
]
HINGE = Joint(
    prim_path="/Room/hinge",
    type="revolute",
    body0="/Room/Cabinet",
    body1="/Room/Door",
    lower=-1.5708,
    upper=0.0,
    axis="Z",
    direction=None,
    value=None,
    is_enabled=True,
    is_excluded_from_articulation=False,
    axis_vector=(0.0, 0.0, 1.0),
    origin=(3.0, 2.99, 0.0),
)


@pytest.fixture(scope="module", params=["soma", "plain"])
def room(home_tbox: TBox, request: pytest.FixtureRequest) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM, joints=(HINGE,), profile=request.param))


@pytest.fixture(scope="module")
def kitchen(tmp_path_factory: pytest.TempPathFactory) -> GraphStore:
    path = tmp_path_factory.mktemp("demo") / "kitchen.ttl"
    usd2kg.write_graph(kitchen_graph(), path)
    return usd2kg.load_graph(path)


def named(answer: Answer, *columns: str) -> list[tuple[object, ...]]:
    return [tuple(dict(zip(answer.columns, row, strict=True))[c] for c in columns) for row in answer.values]


def objects(answer: Answer) -> list[object]:
    return [label for (label,) in named(answer, "object")] if answer.rows else []


class TestFiles:
    @pytest.mark.parametrize("question", list_questions(), ids=lambda question: question.id)
    def test_header_and_query_use_the_same_parameters(self, question):
        assert set(re.findall(r"{(\w+)}", question.text)) == {p.name for p in question.parameters}
        assert set(re.findall(r"\?(the_\w+)", question.sparql)) == {p.variable for p in question.parameters}
        assert all(p.kind in {"object", "class", "position", "m", "kg", "share"} for p in question.parameters)

    def test_the_id_is_the_file_name(self):
        folder = Path(usd2kg.query.questions.__file__).parent
        assert {path.stem for path in folder.glob("*.rq")} == {question.id for question in list_questions()}
        assert len(list_questions()) >= 16

    def test_uses_only_predefined_prefixes(self):
        for question in list_questions():
            body = "".join(line for line in question.sparql.splitlines(True) if not line.startswith("#"))
            used = set(re.findall(r"\b(\w+):\w", re.sub(r'"[^"]*"', "", body)))
            assert used <= {*PREFIXES, "u2kf"}


class TestRoom:
    def test_above_and_below_measure_the_clearance(self, room: GraphStore):
        # The bottom of the lamp is at 1.7 m, the top of the table at 0.7 m.
        assert named(room.answer("above", {"thing": "table"}), "object", "clearance_m") == [("Lamp", 1.0)]
        assert room.answer("above", {"thing": "table", "distance": "90 cm"}).rows == ()
        below = named(room.answer("below", {"thing": "lamp"}), "object", "clearance_m")
        assert below == [("Table", 1.0), ("Floor", 1.7)]

    def test_heavy_near_compares_mass_and_gap(self, room: GraphStore):
        # From the table's corner at (1.6, 0.8) to the crate's at (3.2, 2.6): 1.6 and 1.8.
        assert objects(room.answer("heavy-near", {"thing": "mug"})) == ["Table"]
        assert objects(room.answer("heavy-near", {"thing": "mug", "mass": "40"})) == []
        (row,) = named(room.answer("heavy-near", {"thing": "crate", "mass": "39999 g", "distance": "3"}), "gap_m")
        assert row[0] == pytest.approx((1.6**2 + 1.8**2) ** 0.5, abs=1e-4)

    def test_nearest_measures_gaps_between_boxes(self, room: GraphStore):
        (row,) = named(room.answer("nearest", {"thing": "bowl", "class": "cup"}), "object", "gap_m")
        assert row == ("Mug", pytest.approx(0.6, abs=1e-4))

    def test_follows_support_and_containment(self, room: GraphStore):
        chain = named(room.answer("support-chain", {"thing": "apple"}), "object", "step")
        assert chain == [("Bowl", 1), ("Table", 2), ("Floor", 3)]
        assert objects(room.answer("moves-along", {"thing": "table"})) == ["Apple", "Bowl", "Mug"]
        assert objects(room.answer("moves-along", {"thing": "cabinet"})) == ["Door"]
        assert objects(room.answer("same-surface", {"thing": "mug"})) == ["Bowl"]
        assert objects(room.answer("contents", {"thing": "bowl"})) == ["Apple"]

    def test_selects_graspable_objects_and_liquid_containers(self, room: GraphStore):
        assert objects(room.answer("graspable", {"thing": "table"})) == ["Apple", "Mug"]
        assert objects(room.answer("graspable", {"thing": "table", "mass": "200 g"})) == ["Apple"]
        assert objects(room.answer("graspable", {"thing": "table", "width": "9 cm"})) == ["Apple"]
        assert objects(room.answer("hold-liquid", {"thing": "table"})) == ["Bowl", "Mug"]

    def test_alike_finds_the_same_asset(self, room: GraphStore):
        (row,) = named(room.answer("alike", {"thing": "/Room/Mug", "tolerance": "0"}), "object", "asset")
        assert row == ("OtherMug", "mug")

    def test_reach_measures_from_a_position(self, room: GraphStore):
        near = named(room.answer("reach", {"position": "1.05 0.45 0.9", "radius": "15 cm"}), "object", "distance_m")
        assert near == [("Mug", 0.1)]

    def test_lists_joints_and_their_obstacles(self, room: GraphStore):
        (joint,) = named(room.answer("joints", {"thing": "door"}), "joint", "type", "moves", "range")
        assert joint == ("hinge", "RevoluteJoint", "Door", pytest.approx(1.5708))
        (row,) = named(room.answer("to-open", {"thing": "cabinet"}), "object", "reason", "opens_until")
        # The crate's corner (3.2, 2.8) is 0.19 below the hinge and 0.2 right of it: atan(0.19 / 0.2) = 0.76 rad. The
        # door hits the crate's other corner (3.4, 2.8) earlier: atan(0.19 / 0.4) = 0.44 rad.
        assert row[:2] == ("Crate", "in the way")
        assert row[2] == pytest.approx(0.44, abs=0.05)

    def test_counts_lists_and_filters_by_class(self, room: GraphStore):
        counts = dict(named(room.answer("count"), "class", "count"))
        assert (counts["cup"], counts["artifact"], counts["table"]) == (2, 2, 1)
        assert objects(room.answer("which-where", {"class": "crockery"})) == ["Bowl", "Mug", "OtherMug"]
        assert len(room.answer("unsure", {"confidence": "80 %"}).rows) == len(ROOM)
        assert room.answer("unsure", {"confidence": "0.75"}).rows == ()

    def test_an_ambiguous_name_adds_a_column(self, room: GraphStore):
        rows = named(room.answer("support-chain", {"thing": "cup"}), "object", "step", "thing")
        assert rows == [("Table", 1, "Mug"), ("Floor", 2, "Mug"), ("Floor", 1, "OtherMug")]


class TestGiven:
    @pytest.mark.parametrize(
        ("question", "given", "message"),
        [
            ("unicorn", {}, "question 'unicorn' is unknown; expected one of above, alike"),
            ("above", {}, "needs --with thing=OBJECT"),
            ("above", {"thing": "table", "size": "1"}, "has no parameter 'size'; expected thing, distance"),
            ("count", {"thing": "table"}, "has no parameter 'thing'; expected none"),
            ("above", {"thing": "helicopter"}, "there is no helicopter"),
            ("above", {"thing": "table", "distance": "far"}, "a number, without a unit or with one of m, cm, mm"),
            ("above", {"thing": "table", "distance": "3 kg"}, "is not a quantity; expected a number"),
            ("above", {"thing": "table", "distance": "nan"}, "is not a quantity; expected a number"),
            ("above", {"thing": "table", "distance": "1e999"}, "is not a quantity; expected a number"),
            ("nearest", {"thing": "table", "class": "helicopter"}, "no class or concept is named 'helicopter'"),
            ("reach", {"position": "1 2"}, "is not a position; expected x y z in metres"),
            ("reach", {"position": '1 2 3" . } #'}, "is not a position"),
        ],
    )
    def test_wrong_parameters_are_one_line_errors(self, room: GraphStore, question, given, message):
        with pytest.raises(GraphError) as error:
            room.answer(question, given)
        assert message in str(error.value)
        assert "\n" not in str(error.value)

    def test_a_default_that_the_graph_lacks_is_asked_for(self, home_tbox: TBox):
        table = (thing("/Room/Table", (0, 0, 0), (1, 1, 0.7)), "Table")
        store = open_store(build_graph(home_tbox, [table]))
        with pytest.raises(GraphError) as error:
            store.answer("which-where")
        assert str(error.value).startswith(
            "question which-where needs --with class=CLASS for this graph: room.ttl: no class or concept is named "
            "'appliance'; expected a noun that is a concept of an object, or one of the classes table"
        )
        assert objects(store.answer("which-where", {"class": "table"})) == ["Table"]

    @pytest.mark.parametrize("name", ['"} ; ?s ?p ?o . {"', "> } UNION { ?o ?p <http://evil", "?the_thing", "{thing}"])
    def test_labels_cannot_inject_sparql(self, home_tbox: TBox, name: str):
        placed = [
            (thing("/Room/Table", (0, 0, 0), (1, 1, 0.7), display_name=name), "Table"),
            (thing("/Room/Cup", (0.4, 0.4, 0.7), (0.1, 0.1, 0.1)), "Cup"),
            (thing("/Room/Apart", (5, 5, 0), (0.1, 0.1, 0.1)), "Cup"),
        ]
        store = open_store(build_graph(home_tbox, placed))
        assert objects(store.answer("moves-along", {"thing": name})) == ["Cup"]

    def test_converts_units(self):
        assert parse_number("5cm", "m") == pytest.approx(0.05)
        assert parse_number("-.5", "m") == -0.5
        assert parse_number("2e3 g", "kg") == pytest.approx(2)

    def test_functions_work_in_sparql_and_are_unbound_for_wrong_arguments(self, room: GraphStore):
        query = "SELECT (u2kf:gap(?a, ?b) AS ?d) { ?a rdfs:label 'Mug' . ?b rdfs:label 'Bowl' }"
        assert room.sparql(query).values == ((0.6,),)
        wrong = "SELECT (u2kf:gap('x', <urn:y>) AS ?d) (u2kf:distanceTo(?a, 'here') AS ?e) { ?a rdfs:label 'Mug' }"
        assert room.sparql(wrong).values == ((None, None),)


def _true(relation: str) -> Iterator[tuple[str, str]]:
    with demo_relations().open(encoding="utf-8") as file:
        yield from ((row["subject"], row["object"]) for row in csv.DictReader(file) if row["relation"] == relation)


class TestKitchen:
    def test_contents_match_the_authored_layout(self, kitchen: GraphStore):
        fridge = "/KitchenDining/coldStore/Fridge_01"
        true = {subject for subject, anchor in _true("inside") if anchor == fridge}
        found = {path for (path,) in named(kitchen.answer("contents", {"thing": fridge}), "path")}
        assert len(found & true) >= 12
        assert len(found & true) / len(found) >= 0.9

    def test_follows_an_apple_in_a_bowl_on_the_bar(self, kitchen: GraphStore):
        chain = objects(kitchen.answer("support-chain", {"thing": "apple_1"}))
        assert chain == ["fruitBowl", "barTable", "floor_tiles"]
        assert "apple_1" in objects(kitchen.answer("moves-along", {"thing": "fruitBowl"}))
        assert {"fruitBowl", "mug_large_04"} <= set(objects(kitchen.answer("hold-liquid", {"thing": "barTable"})))

    def test_the_refrigerator_opens_until_the_wall(self, kitchen: GraphStore):
        rows = named(kitchen.answer("to-open", {"thing": "refrigerator"}), "joint", "object", "opens_until")
        walls = [row for row in rows if row[1] == "Wall_W"]
        assert {row[0] for row in walls} == {"door_freezer_hinge", "door_upper_hinge"}
        assert all(1.57 < float(str(row[2])) < 1.745 for row in walls)
