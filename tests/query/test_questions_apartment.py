"""Ready questions on the IAI apartment; answers were checked against renderings and prim counts."""

import pytest

import usd2kg
from tests.conftest import shared_file
from tests.query.test_questions import named, objects
from usd2kg.query import GraphStore
from usd2kg.query.questions import list_questions

ROOT = "/apartment/Geometry/apartment_root"
ASKED = {
    "above", "alike", "below", "close-to", "connects", "contents", "count", "graspable", "heavy-near", "hold-liquid",
    "joints", "moves-along", "nearest", "reach", "route", "same-surface", "support-chain", "to-open", "unsure",
    "ways-into", "which-where",
}  # fmt: skip


@pytest.fixture(scope="module", params=["soma", "plain"])
def apartment(tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> GraphStore:
    scene = shared_file("scenes/iai_apartment/apartment.usdc")
    path = tmp_path_factory.mktemp("apartment") / "apartment.ttl"
    usd2kg.write_graph(usd2kg.build(scene, profile=request.param).graph, path)
    return usd2kg.load_graph(path)


def ask(store: GraphStore, question: str, **given: str) -> list[object]:
    return objects(store.answer(question, given))


def test_covers_every_question():
    assert {question.id for question in list_questions()} == ASKED


class TestPlaces:
    def test_the_wall_cabinet_is_above_the_coffee_machine(self, apartment: GraphStore):
        rows = named(apartment.answer("above", {"thing": "coffe_machine"}), "object", "clearance_m")
        # The bottom of the cabinet is at 1.4233 m, the top of the machine at 1.3138 m.
        assert rows[0][0] == "cabinet4"
        assert float(str(rows[0][1])) == pytest.approx(0.1095, abs=1e-3)
        assert {name for name, _ in rows[1:]} == {"cabinet4_door_top", "cabinet4_door_bottom"}
        assert ask(apartment, "above", thing="island_countertop") == []

    def test_the_coffee_machine_is_below_the_wall_cabinet(self, apartment: GraphStore):
        found = ask(apartment, "below", thing="cabinet4_door_bottom", distance="30 cm")
        assert set(found) == {"coffe_machine", "countertop", "cabinet5"}
        assert "cabinet8" in ask(apartment, "below", thing="tap_body")

    def test_finds_objects_close_to_seats(self, apartment: GraphStore):
        # The walls are one L-shaped mesh, whose box encloses the flat, but they are farther away.
        assert ask(apartment, "close-to", thing="armchair") == ["bedside_table"]
        assert ask(apartment, "close-to", thing="sofa", distance="60 cm") == ["walls", "coffee_table"]

    def test_finds_the_nearest_object_of_a_class(self, apartment: GraphStore):
        assert ask(apartment, "nearest", thing="armchair", **{"class": "table"}) == ["bedside_table"]
        assert ask(apartment, "nearest", thing="sofa", **{"class": "coffee table"}) == ["coffee_table"]
        assert ask(apartment, "nearest", thing="cooktop", **{"class": "sink"}) == ["sink"]

    def test_doors_of_furniture_connect_no_rooms(self, apartment: GraphStore):
        # The flat has no doors or windows in its walls.
        assert ask(apartment, "ways-into", thing=f"{ROOT}/kitchen_root") == []
        assert ask(apartment, "connects", thing="cabinet4_door_bottom") == []
        assert ask(apartment, "route", thing=f"{ROOT}/kitchen_root", other="coffee_table") == []

    def test_reaches_objects_from_above_the_coffee_table(self, apartment: GraphStore):
        found = ask(apartment, "reach", position="16.6 2.8 0.5", radius="50 cm")
        assert found == ["coffee_table", "coffee_table_drawer"]

    def test_lists_the_contents_of_a_cabinet_and_a_room(self, apartment: GraphStore):
        assert set(ask(apartment, "contents", thing="cabinet2")) == {"cabinet2_drawer_big", "cabinet2_drawer_small"}
        assert ask(apartment, "contents", thing="coffee_table") == ["coffee_table_drawer"]
        kitchen = ask(apartment, "contents", thing=f"{ROOT}/kitchen_root")
        assert {"cooktop", "sink", "coffe_machine", "cabinet12"} <= set(kitchen)
        assert not {"sofa", "armchair", "wardrobe"} & set(kitchen)
        assert set(objects(apartment.inside(f"{ROOT}/kitchen_root"))) == set(kitchen)


class TestSupport:
    def test_follows_the_support_of_the_coffee_machine_and_the_island(self, apartment: GraphStore):
        rows = named(apartment.answer("support-chain", {"thing": "coffe_machine"}), "object", "step")
        # The scene has no floor; the stage nests the countertop below cabinet5, whose part it is.
        steps = [(name, int(str(step))) for name, step in rows]
        # The panel `side_A_rb` below it is grounded to a door, by its shape, and doors support nothing.
        assert steps == [("countertop", 1), ("cabinet6", 2)]
        chain = ask(apartment, "support-chain", thing="island_countertop")
        assert {f"cabinet{n}" for n in (7, 8, 9, 10, 11)} <= set(chain)
        assert not [name for name in chain if "drawer" in str(name)]

    def test_handles_doors_and_supported_objects_move_along(self, apartment: GraphStore):
        assert ask(apartment, "moves-along", thing="countertop") == ["coffe_machine"]
        assert ask(apartment, "moves-along", thing="cabinet9_drawer_top") == ["handle_cab9_t"]
        found = ask(apartment, "moves-along", thing="wardrobe")
        doors = {"wardrobe_door_left", "wardrobe_door_right"}
        assert set(found) == doors | {f"{door}_handle" for door in doors}
        assert set(ask(apartment, "moves-along", thing="sink")) == {"tap_body", "tap_handle_open"}

    def test_bare_worktops_have_no_graspable_objects(self, apartment: GraphStore):
        # Only the coffee machine is on a worktop; it is too large to grasp, and no prim has a mass.
        assert ask(apartment, "graspable", thing="countertop") == []
        assert ask(apartment, "graspable", thing="cabinet2") == []
        assert ask(apartment, "hold-liquid", thing="island_countertop") == []
        assert ask(apartment, "same-surface", thing="coffe_machine") == []
        assert ask(apartment, "heavy-near", thing="coffe_machine", mass="10 g", distance="2 m") == []


class TestJoints:
    def test_lists_the_ranges_of_doors_and_drawers(self, apartment: GraphStore):
        rows = named(apartment.answer("joints", {"thing": "wardrobe"}), "moves", "type", "range")
        assert [row[:2] for row in rows] == [
            ("wardrobe_door_left", "RevoluteJoint"),
            ("wardrobe_door_right", "RevoluteJoint"),
        ]
        assert [float(str(row[2])) for row in rows] == pytest.approx([1.5708, 1.5708], abs=1e-4)
        drawers = named(apartment.answer("joints", {"thing": "cabinet5"}), "type", "range")
        assert [kind for kind, _ in drawers] == ["PrismaticJoint"] * 3
        assert [float(str(far)) for _, far in drawers] == pytest.approx([0.45] * 3)

    def test_a_door_is_in_the_way_of_the_drawers_behind_it(self, apartment: GraphStore):
        rows = named(apartment.answer("to-open", {"thing": "cabinet2"}), "joint", "object")
        door = "cabinet2_door_out_fancy"
        assert rows == [("cabinet2_drawer_big_joint", door), ("cabinet2_drawer_small_joint", door)]
        drawer = named(apartment.answer("to-open", {"thing": "cabinet2_drawer_big"}), "object", "reason")
        assert drawer == [(door, "in the way")]
        assert ask(apartment, "to-open", thing="cabinet7") == ["cabinet7_door_bottom_left"]
        assert ask(apartment, "to-open", thing="wardrobe") == []


class TestClasses:
    def test_counts_match_the_prims(self, apartment: GraphStore):
        counts = {name: int(str(n)) for name, n in named(apartment.answer("count", {}), "class", "count")}
        # By the names of the prims; 27 handles of furniture and one of the tap.
        assert (counts["drawer"], counts["kitchen cabinet"], counts["handle"], counts["hotplate"]) == (23, 12, 28, 4)
        assert (counts["sofa"], counts["armchair"], counts["wardrobe"], counts["sink"]) == (1, 1, 1, 1)

    def test_locates_tables_and_drawers(self, apartment: GraphStore):
        rows = named(apartment.answer("which-where", {"class": "table"}), "object", "on", "inside")
        assert rows == [("bedside_table", None, None), ("coffee_table", None, None)]
        drawers = named(apartment.answer("which-where", {"class": "drawer"}), "object", "inside")
        assert len(drawers) == 23
        assert ("cabinet8_drawer_middle", "cabinet8") in drawers

    def test_finds_objects_of_the_same_size(self, apartment: GraphStore):
        assert ask(apartment, "alike", thing="cabinet8") == ["cabinet9"]
        assert len(ask(apartment, "alike", thing="handle_cab5_b")) == 23

    def test_side_panels_are_uncertain(self, apartment: GraphStore):
        found = ask(apartment, "unsure", confidence="0.7")
        assert {"side_A_left", "side_A_rb"} <= set(found)
        assert not {"sofa", "cooktop", "coffee_table"} & set(found)
