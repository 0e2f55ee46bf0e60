"""Questions that boxes answer where the graph states no relation, and kinds that size and class show."""

from dataclasses import replace

import pytest

from tests.graph.records import build_graph, open_store, thing
from tests.query.test_questions import HINGE
from tests.query.test_questions import ROOM as HINGED_ROOM
from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore

# A room of 6 × 6 m, seen from above: x to the right, y away. A sideboard stands at the far wall (y = 3), with a vase on
# its left and a chair on its right as seen from the middle of the room; a lamp hangs above it.
ROOM = [
    (thing("/R/Floor", (-3, -3, -0.1), (6, 6, 0.1)), "Floor"),
    (thing("/R/Sideboard", (-0.5, 2.5, 0), (1, 0.4, 0.8)), "Cupboard"),
    (thing("/R/Vase", (-1.2, 2.6, 0), (0.2, 0.2, 0.6)), "DesignedArtifact"),
    (thing("/R/Chair", (1.0, 2.5, 0), (0.4, 0.4, 0.9)), "DesignedChair"),
    (thing("/R/Lamp", (-0.1, 2.6, 1.6), (0.2, 0.2, 0.2)), "DesignedArtifact"),
    (thing("/R/Table", (-0.4, 0, 0), (0.8, 0.8, 0.7)), "Table"),
    # A door in the near wall, with its lever, and a bin 0.5 m in front of it.
    (thing("/R/Door", (-2.5, -3.05, 0), (0.9, 0.05, 2)), "DesignedArtifact"),
    (thing("/R/Door_lever", (-1.8, -3.0, 1), (0.1, 0.05, 0.05)), "DesignedArtifact"),
    (thing("/R/Bin", (-2.2, -2.5, 0), (0.3, 0.3, 0.4)), "DesignedArtifact"),
    (thing("/R/Window", (1, -3.05, 1), (0.9, 0.05, 1)), "DesignedArtifact"),
    # A door in the right wall, in its frame, with a stool against it; a wall on either side.
    (thing("/R/Exit", (3.0, -2, 0), (0.05, 0.9, 2)), "DesignedArtifact"),
    (thing("/R/Exit_frame", (2.97, -2.05, 0), (0.11, 1, 2.05)), "DesignedArtifact"),
    (thing("/R/Exit_knob", (2.9, -1.2, 1), (0.1, 0.05, 0.05)), "DesignedArtifact"),
    (thing("/R/Wall_right", (3.0, -3, 0), (0.1, 6, 2.5)), "DesignedArtifact"),
    (thing("/R/Stool", (2.6, -1.7, 0), (0.4, 0.4, 0.5)), "DesignedArtifact"),
    (thing("/R/Crate", (-3, 1, 0), (0.5, 0.5, 0.5)), "DesignedArtifact"),
    # Between the boards of a rack.
    (thing("/R/Rack", (2.2, 0, 0), (0.4, 1, 1.5)), "Rack"),
    (thing("/R/Shoe", (2.3, 0.4, 0.7), (0.1, 0.25, 0.1)), "DesignedArtifact"),
]


@pytest.fixture(scope="module", params=["soma", "plain"])
def room(home_tbox: TBox, request: pytest.FixtureRequest) -> GraphStore:
    return open_store(build_graph(home_tbox, ROOM, profile=request.param))


def found(graph: GraphStore, question: str) -> list[str | None]:
    return sorted(row[0] or "" for row in ask_offline(graph, question).answer.rows)


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("what is to the left of the sideboard?", ["Vase"]),
        ("what is on the right of the Sideboard?", ["Chair"]),
        ("what stands right of the sideboard", ["Chair"]),
        ("was ist links von Sideboard?", ["Vase"]),
        ("what is between the Vase and the Chair?", ["Sideboard"]),
        ("what is between the table and the chair?", []),
        ("what is above the sideboard?", ["Lamp"]),
    ],
)
def test_places_beside_between_and_above(room: GraphStore, question: str, expected: list[str]):
    assert found(room, question) == expected


def test_the_sentence_says_where_one_looks_from(room: GraphStore):
    assert "as seen from among the surrounding objects" in ask_offline(room, "what is left of the sideboard?").sentence


def test_what_is_in_the_way_of_a_door_without_a_joint(room: GraphStore):
    asked = ask_offline(room, "is anything blocking Door?")
    assert (asked.verdict, [row[0] for row in asked.answer.rows]) == (True, ["Bin"])
    assert "by boxes: the stage has no joint" in asked.sentence
    assert ask_offline(room, "is anything blocking Window?").verdict is False
    assert found(room, "what is in the way of Exit?") == ["Stool"], "touches the door, as its frame and its knob do"
    with pytest.raises(GraphError, match="not known: the stage has no joint for crate"):
        ask_offline(room, "is anything blocking the Crate?")


def test_what_a_hinged_door_hits(home_tbox: TBox):
    graph = open_store(build_graph(home_tbox, HINGED_ROOM, joints=(HINGE,)))
    answered = ask_offline(graph, "what is in the way of the cabinet?")
    assert [row[1] for row in answered.answer.rows] == ["Crate"]
    assert answered.sentence.startswith(
        "The box Crate is in the way of the kitchen cabinet Cabinet, by boxes that move"
    )
    off_floor = ask_offline(graph, "what must be moved off the floor to open the cabinet?")
    assert [row[1] for row in off_floor.answer.rows] == ["Crate"]
    off_table = ask_offline(graph, "what must be moved off the table to open the cabinet?")
    assert off_table.answer.rows == ()
    assert off_table.sentence.startswith("Nothing on the table is in the way of the kitchen cabinet")
    blocked = ask_offline(graph, "is anything blocking the cabinet?")
    assert (blocked.verdict, blocked.sentence[:14]) == (True, "Yes. The box C")


def test_between_needs_one_pair(room: GraphStore):
    with pytest.raises(GraphError, match="expected the name of one each"):
        ask_offline(room, "what is between the Chair and the Chair?")


def test_a_remark_that_nothing_is_left_out_changes_nothing(room: GraphStore):
    for remark in (", all of them together", ", folding chairs included", ", including stools"):
        assert ask_offline(room, f"how many chairs are there{remark}?").number == 1


def test_what_is_inside_a_rack_is_on_it(room: GraphStore):
    assert found(room, "what's on the Rack?") == ["Shoe"]


# A forklift of 1.2 × 2.5 × 2.1 m stands oblique in a hall, so its box is wider. One of three pallets carries drums.
HALL = [
    (thing("/H/Floor", (-9, -9, -0.1), (18, 18, 0.1)), "Floor"),
    (thing("/H/Forklift", (3, 3, 0), (2.62, 2.62, 2.1), oriented_size=(1.2, 2.5, 2.1)), "DesignedArtifact"),
    *((thing(f"/H/Pallet_{n}", (-6 + 3 * n, -6, 0), (1.2, 0.8, 0.15)), "DesignedArtifact") for n in range(3)),
    *((thing(f"/H/Drum_{n}", (-5.9 + 0.5 * n, -5.8, 0.15), (0.4, 0.4, 0.9)), "DesignedContainer") for n in range(2)),
]


@pytest.fixture(scope="module")
def hall(home_tbox: TBox) -> GraphStore:
    return open_store(build_graph(home_tbox, HALL))


@pytest.mark.parametrize(
    ("question", "number"),
    [("how wide is the forklift?", 2.5), ("how deep is the forklift?", 1.2), ("how tall is the forklift?", 2.1)],
)
def test_sides_are_along_a_things_own_axes(hall: GraphStore, question: str, number: float):
    assert ask_offline(hall, question).number == pytest.approx(number)


def test_a_tilted_thing_is_measured_by_its_box(home_tbox: TBox):
    ladder = thing("/H/Ladder", (0, 0, 0), (1.1, 0.5, 1.9), oriented_size=(0.05, 0.5, 2.2))
    graph = open_store(build_graph(home_tbox, [(ladder, "DesignedArtifact")]))
    assert ask_offline(graph, "how wide is the ladder?").number == pytest.approx(1.1)


@pytest.mark.parametrize(
    ("question", "sentence"),
    [
        ("how many drums are on the pallet?", "Two containers are on the artifact Pallet_0."),
        ("what is the forklift on?", "Forklift is on the floor."),
        ("what is on the forklift?", "Nothing is on the artifact Forklift."),
    ],
)
def test_what_a_thing_is_on(hall: GraphStore, question: str, sentence: str):
    assert ask_offline(hall, question).sentence == sentence


def test_the_mass_of_a_whole_is_given_with_its_parts(home_tbox: TBox):
    cart = [
        (thing("/H/Floor", (-3, -3, -0.1), (6, 6, 0.1)), "Floor"),
        (thing("/H/Cart", (0, 0, 0.15), (1, 0.6, 0.5), mass_kg=50), "DesignedArtifact"),
        *((thing(f"/H/Cart/wheel_{n}", (n, 0, 0), (0.2, 0.05, 0.2), mass_kg=2), "DesignedComponent") for n in range(2)),
    ]
    joints = [replace(HINGE, prim_path=f"/H/joint_{n}", body0="/H/Cart", body1=f"/H/Cart/wheel_{n}") for n in range(2)]
    asked = ask_offline(open_store(build_graph(home_tbox, cart, joints=joints)), "how heavy is the cart?")
    assert (asked.number, asked.sentence) == (50, "Cart weighs 50 kg, 54 kg with two parts.")
