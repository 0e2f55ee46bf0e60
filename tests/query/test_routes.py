"""Routes through doors, worked by hand."""

from functools import partial

import pyoxigraph as ox
import pytest

from tests.graph.records import BASE, ground_as, thing
from tests.grounding.records import make_scene
from tests.relations.test_derived_rooms import door
from usd2kg.graph import instantiate
from usd2kg.ontology import load_home_tbox
from usd2kg.query import GraphStore
from usd2kg.query.dataset import Dataset

WALL = 0.1
room = partial(thing, size=(4, 4, 2.5))
PLAN = [
    # hall | bath
    # -----+-----
    # bed  | study
    (room("/House/hall", (0, 4 + WALL, 0)), "Room"),
    (room("/House/bath", (4 + WALL, 4 + WALL, 0)), "Room"),
    (room("/House/bed", (0, 0, 0)), "Room"),
    (room("/House/study", (4 + WALL, 0, 0)), "Room"),
    (thing("/House/wall_x", (0, 4, 0), (8 + WALL, WALL, 2.5)), "Wall"),
    (thing("/House/wall_y", (4, 0, 0), (WALL, 8 + WALL, 2.5)), "Wall"),
    door("House/hall_bath", (4.02, 6, 0), (0.06, 1, 2)),
    door("House/bath_study", (6, 4.02, 0), (1, 0.06, 2)),
    door("House/study_bed", (4.02, 0.5, 0), (0.06, 1, 2)),
    (thing("/House/desk", (6, 1, 0), (1, 1, 0.7)), "Table"),
]


@pytest.fixture(scope="module", params=["soma", "plain"])
def house(request: pytest.FixtureRequest) -> GraphStore:
    return store(PLAN, request.param)


def store(placed, profile: str = "soma") -> GraphStore:
    tbox = load_home_tbox()
    scene = make_scene(*(obj for obj, _ in placed))
    grounding = ground_as(tbox, scene, {obj.prim_path: cls for obj, cls in placed})
    graph = instantiate(scene, tbox, grounding, base=BASE, profile=profile)
    triples = ox.Store()
    triples.extend(ox.Quad(*triple) for triple in graph.triples)
    return GraphStore(Dataset(triples), "house")


def route(graph: GraphStore, start: str, end: str) -> list[tuple[str | None, ...]]:
    found = graph.answer("route", {"thing": start, "other": end})
    chosen = [found.columns.index(name) for name in ("step", "object", "room", "length_m")]
    return [tuple(row[place] for place in chosen) for row in found.rows]


def test_rooms_and_distances_from_door_to_door(house: GraphStore):
    # The doors are at (4.05, 6.5), (6.5, 4.05) and (4.05, 1) m.
    steps = route(house, "hall", "bed")
    assert [row[:3] for row in steps] == [
        ("1", "hall_bath", "bath"), ("2", "bath_study", "study"), ("3", "study_bed", "bed"),
    ]  # fmt: skip
    lengths = [float(row[3] or "nan") for row in steps]
    assert lengths == pytest.approx([0, 3.4648, 3.4648 + 3.9124], abs=1e-3)


def test_a_route_begins_and_ends_at_things(house: GraphStore):
    assert [row[1:3] for row in route(house, "desk", "hall")] == [("bath_study", "bath"), ("hall_bath", "hall")]


def test_a_shorter_way_wins():
    direct = door("House/hall_bed", (2, 4.02, 0), (1, 0.06, 2))
    assert [row[1] for row in route(store([*PLAN, direct]), "hall", "bed")] == ["hall_bed"]


def test_nobody_walks_through_a_window():
    low = door("House/hatch", (2, 4.02, 1), (1, 0.06, 1))
    assert len(route(store([*PLAN, low]), "hall", "bed")) == 3
