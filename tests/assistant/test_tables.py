"""Questions about several tables: which is meant, which are near, and where something may be put."""

import pytest

from tests.graph.records import build_graph, thing
from tests.grounding.records import make_class, make_tbox
from usd2kg.assistant import ask_offline
from usd2kg.errors import GraphError
from usd2kg.query import GraphStore

TBOX = make_tbox(
    make_class("Thing", label="thing"),
    *(make_class(name, "Thing", label=name.lower()) for name in ("Table", "Chair", "Floor", "Rack", "Plate")),
    make_class("Desk", "Table", label="desk"),
)


def open_rooms(base: float = 0.0) -> GraphStore:
    """Return two tables, a desk and a tall rack, all empty, and two chairs at the same distance from a plate."""
    placed = [
        (thing("/Floor", (0, 0, base - 0.1), (10, 10, 0.1)), "Floor"),
        (thing("/Table_1", (1, 1, base), (1.2, 0.8, 0.75)), "Table"),
        (thing("/Table_2", (4, 1, base), (0.3, 0.3, 0.7)), "Table"),
        (thing("/Desk_3", (7, 1, base), (1.2, 0.8, 0.75)), "Desk"),
        (thing("/Rack", (1, 7, base), (1.2, 0.5, 1.9)), "Rack"),
        (thing("/Plate", (5, 5, base), (0.3, 0.3, 0.03)), "Plate"),
        (thing("/Chair_1", (4, 5, base), (0.5, 0.5, 0.9)), "Chair"),
        (thing("/Chair_2", (5.8, 5, base), (0.5, 0.5, 0.9)), "Chair"),
    ]
    return GraphStore.from_triples(build_graph(TBOX, placed).triples, "tables")


@pytest.mark.parametrize("base", [0.0, 3.2])
def test_empty_tables_have_room_on_any_storey(base: float):
    asked = ask_offline(open_rooms(base), "where can I put a box of 60 by 40 cm?")
    assert set(asked.places) == {"/Table_1", "/Desk_3"}
    spot = dict(zip(asked.places, (row[-1] for row in asked.answer.rows), strict=True))["/Table_1"]
    assert [float(value) for value in spot.split()] == pytest.approx([1.6, 1.4, base + 0.75], abs=0.05)
    assert ask_offline(open_rooms(base), "does a box of 60 by 40 cm fit on table_1?").verdict is True
    assert ask_offline(open_rooms(base), "does a box of 60 by 40 cm fit on table_2?").verdict is False


def test_what_can_be_put_somewhere_is_not_yet_there():
    asked = ask_offline(open_rooms(), "can I put the plate on table_1?")
    assert (asked.verdict, asked.understood) == (True, "whether plate fits on table_1")


def test_the_top_of_a_tall_rack_is_not_known():
    with pytest.raises(GraphError, match="nothing stands on rack, so the height of its top is unknown"):
        ask_offline(open_rooms(), "does a box of 60 by 40 cm fit on the rack?")


def test_all_things_that_are_equally_near_are_named():
    asked = ask_offline(open_rooms(), "which chair is nearest to the plate?")
    assert {row[0] for row in asked.answer.rows} == {"Chair_1", "Chair_2"}


def test_what_else_may_be_meant_is_named():
    asked = ask_offline(open_rooms(), "where is the table?")
    assert asked.sentence.count("Table_") == 2
    assert "there is also Desk_3" in asked.sentence
