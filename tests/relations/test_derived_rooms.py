"""room: rooms that no prim is, from walls and floors."""

import time

import numpy as np
import pytest

from tests.graph.records import thing
from tests.relations.room_builder import RULES, Placed, artifact, cup, relate
from usd2kg.relations import DerivedRoom, Relation
from usd2kg.shapes.surface import Surface, SurfacePiece

PLAN = RULES.room_plan


def wall(
    name: str, lower: tuple[float, float], upper: tuple[float, float], z: tuple[float, float] = (0, 2.5)
) -> Placed:
    size = (upper[0] - lower[0], upper[1] - lower[1], z[1] - z[0])
    return thing(f"/{name}", (*lower, z[0]), size), "Wall"


def door(name: str, lower: tuple[float, float, float], size: tuple[float, float, float]) -> Placed:
    return thing(f"/{name}", lower, size), "Door"


def shell(
    x: tuple[float, float] = (0, 8), y: tuple[float, float] = (0, 4), z: tuple[float, float] = (0, 2.5)
) -> list[Placed]:
    """Return four walls, 0.1 m thick, around a floor."""
    return [
        wall("south", (x[0] - 0.1, y[0] - 0.1), (x[1] + 0.1, y[0]), z),
        wall("north", (x[0] - 0.1, y[1]), (x[1] + 0.1, y[1] + 0.1), z),
        wall("west", (x[0] - 0.1, y[0]), (x[0], y[1]), z),
        wall("east", (x[1], y[0]), (x[1] + 0.1, y[1]), z),
    ]


FLAT = [
    *shell(),
    # A door opening of 0.9 m between the partition and the wall in the north.
    wall("partition", (5, 0), (5.1, 3.1)),
]
SOFA, BED = artifact("sofa", (1, 1, 0), (2, 1, 0.8)), artifact("bed", (6, 1, 0), (1.6, 2, 0.5))


def in_rooms(*placed: Placed, **options) -> dict[str, str]:
    return {r.target.lstrip("/"): r.anchor for r in found(*placed, **options)}


def found(*placed: Placed, **options) -> tuple[Relation, ...]:
    return relate(*placed, kinds=("room",), **options)


def rooms(*placed: Placed, **options) -> list[DerivedRoom]:
    known = {r.anchor: r.room for r in found(*placed, **options)}
    return [room for _, room in sorted(known.items()) if room is not None]


def test_walls_enclose_two_rooms():
    assert in_rooms(*FLAT, SOFA, BED) == {"sofa": "room 1", "bed": "room 2"}


def test_area_outline_and_confidence():
    one, two = rooms(*FLAT, SOFA, BED)
    assert (one.rule, one.height) == (PLAN.rule, 0)
    assert one.area == pytest.approx(5 * 4, rel=0.05)
    assert two.area == pytest.approx(2.9 * 4, rel=0.05)
    (outline,) = two.outline
    assert np.array(outline).min(axis=0) == pytest.approx([5.1, 0], abs=0.06)
    assert np.array(outline).max(axis=0) == pytest.approx([8, 4], abs=0.06)
    # 0.9 m of the 13.8 m around the room are taken to be a door.
    assert two.confidence == pytest.approx(1 - 0.9 / 13.8, abs=0.02)


def test_numbers_of_the_relation():
    # Most of the rug is in the first room, a quarter in the second: what lies in the opening counts for neither.
    (relation,) = found(*FLAT, artifact("rug", (3.05, 3.2, 0), (2.5, 0.7, 0.01)))
    assert relation.anchor == "room 1"
    assert relation.numbers == {"insideRatio": pytest.approx(0.8)}


def test_a_wide_gap_joins_two_rooms():
    walls = [*shell(), wall("partition", (5, 0), (5.1, 2.5))]
    assert set(in_rooms(*walls, SOFA, BED).values()) == {"room 1"}


def test_a_corridor_is_not_closed_where_a_partition_meets_it():
    # The partition ends at the wall of a corridor that is 1.2 m wide.
    corridor = [*shell(), wall("long", (0, 2.7), (8, 2.8)), wall("partition", (5, 0), (5.1, 2.7))]
    ends = [artifact("coat", (0.5, 3, 0), (0.4, 0.4, 1)), artifact("shoes", (7, 3, 0), (0.4, 0.3, 0.1))]
    placed = in_rooms(*corridor, SOFA, BED, *ends)
    assert placed["coat"] == placed["shoes"]
    assert len(set(placed.values())) == 3


def test_a_low_screen_is_no_wall():
    screen = wall("screen", (5, 0), (5.1, 3.1), (0, 1.85))
    assert set(in_rooms(*shell(), screen, SOFA, BED).values()) == {"room 1"}


def test_a_door_closes_its_opening_of_any_width():
    walls = [*shell(), wall("partition", (5, 0), (5.1, 2))]
    gate = door("gate", (5.02, 2, 0), (0.06, 2, 2.2))
    assert in_rooms(*walls, gate, SOFA, BED) == {"sofa": "room 1", "bed": "room 2"}


def test_an_open_terrace_is_no_room():
    # Three walls and a parapet.
    walls = [*shell()[:3], wall("parapet", (8, 0), (8.1, 4), (0, 1))]
    assert found(*walls, SOFA) == ()


def test_what_hangs_on_a_wall_is_in_its_room():
    picture = artifact("picture", (2, -0.02, 1.4), (0.6, 0.03, 0.4))
    assert in_rooms(*FLAT, picture)["picture"] == "room 1"


def test_walls_without_a_surface_at_the_height_of_the_plan_enclose_nothing():
    walls, surface = one_mesh(
        [wall("skirting", (0, 0), (8, 0.1), (0, 0.1)), wall("rail", (0, 0), (8, 0.1), (2.4, 2.5))]
    )
    assert found(walls, SOFA, surfaces={"/walls": surface}) == ()


def test_doors_are_in_no_room():
    leaf = door("leaf", (5.02, 3.1, 0), (0.06, 0.9, 2.1))
    assert "leaf" not in in_rooms(*FLAT, leaf, SOFA)


def test_walls_in_one_mesh_with_a_lintel():
    # The partition has an opening of 2 m below a lintel.
    pieces = [
        *shell(),
        wall("a", (5, 0), (5.1, 1)),
        wall("b", (5, 3), (5.1, 4)),
        wall("lintel", (5, 1), (5.1, 3), (2.1, 2.5)),
    ]
    walls, surface = one_mesh(pieces)
    assert in_rooms(walls, SOFA, BED, surfaces={"/walls": surface}) == {"sofa": "room 1", "bed": "room 2"}
    walls, surface = one_mesh(pieces[:-1])
    assert set(in_rooms(walls, SOFA, BED, surfaces={"/walls": surface}).values()) == {"room 1"}


def test_a_beam_across_a_room_does_not_divide_it():
    walls, surface = one_mesh([*shell(), wall("beam", (4, 0), (4.3, 4), (2.2, 2.5))])
    assert set(in_rooms(walls, SOFA, BED, surfaces={"/walls": surface}).values()) == {"room 1"}


def test_a_turned_house_has_the_same_rooms():
    walls, surface = one_mesh(FLAT, degrees=30)
    sofa, bed = (
        artifact(name, (*turned(at, 30), 0), (0.4, 0.4, 0.5)) for name, at in (("sofa", (2, 2)), ("bed", (6, 2)))
    )
    placed = in_rooms(walls, sofa, bed, surfaces={"/walls": surface})
    assert sorted(placed) == ["bed", "sofa"]
    assert placed["bed"] != placed["sofa"]
    areas = sorted(room.area for room in rooms(walls, sofa, bed, surfaces={"/walls": surface}))
    assert areas == pytest.approx([2.9 * 4, 5 * 4], rel=0.05)


def test_two_storeys():
    upper = [
        (thing(f"/upper{obj.prim_path}", (*obj.own_box.lower[:2], 2.7), obj.own_box.size), cls) for obj, cls in shell()
    ]
    floors = [(thing(f"/slab{i}", (-0.1, -0.1, z), (8.2, 4.2, 0.2)), "Floor") for i, z in enumerate((-0.2, 2.5))]
    placed = in_rooms(*FLAT, *upper, *floors, SOFA, BED, artifact("bath", (6, 1, 2.7), (1, 2, 0.6)))
    assert placed == {"sofa": "room 1", "bed": "room 2", "bath": "room 3"}


class TestFloors:
    """Without walls around them, separate floors are rooms."""

    def test_separate_floors(self):
        slabs = [(thing(f"/floor_{i}", (4.2 * i, 0, -0.1), (4, 4, 0.1)), "Floor") for i in range(2)]
        placed = found(*slabs, cup((1, 1, 0)), artifact("bed", (5, 1, 0), (1.6, 2, 0.5)))
        assert {(r.target, r.anchor, r.rule) for r in placed} == {
            ("/cup", "room 1", PLAN.floor_rule),
            ("/bed", "room 2", PLAN.floor_rule),
        }

    def test_tiles_of_one_floor_are_no_rooms(self):
        tiles = [(thing(f"/floor_{i}", (2 * i, 0, -0.1), (2, 2, 0.1)), "Floor") for i in range(4)]
        assert found(*tiles, cup((1, 1, 0))) == ()

    def test_names_of_floors_name_rooms(self):
        names = ["Floor_LivingRoom", "kitchen_floor"]
        slabs = [(thing(f"/{name}", (4 * i, 0, -0.1), (4, 4, 0.1)), "Floor") for i, name in enumerate(names)]
        placed = in_rooms(*slabs, cup((1, 1, 0)), artifact("stove", (5, 1, 0), (0.6, 0.6, 0.9)))
        assert placed == {"cup": "living room", "stove": "kitchen"}

    def test_names_divide_an_open_plan(self):
        slabs = [
            (thing("/BedroomFloor", (0, 0, -0.1), (4, 4, 0.1)), "Floor"),
            (thing("/HallFloor", (4, 0, -0.1), (4, 4, 0.1)), "Floor"),
        ]
        placed = in_rooms(*shell(), *slabs, SOFA, BED)
        assert placed == {"sofa": "bedroom", "bed": "hall"}


def test_rooms_that_are_prims_win():
    kitchen = (thing("/kitchen", (0, 0, 0), (8, 4, 2.5)), "Kitchen")
    assert set(in_rooms(*FLAT, kitchen, SOFA, BED).values()) == {"/kitchen"}
    grouped = [(thing(f"/bedroom{obj.prim_path}", obj.own_box.lower, obj.own_box.size), cls) for obj, cls in FLAT]
    assert {r.anchor for r in found(*grouped, SOFA, BED)} == {"/bedroom"}


def one_mesh(pieces: list[Placed], degrees: float = 0) -> tuple[Placed, Surface]:
    """Return walls as one mesh of boxes, turned about z."""
    corners = np.concatenate([box_corners(obj.own_box.lower, obj.own_box.upper) for obj, _ in pieces])
    corners[..., :2] = turned(corners[..., :2], degrees)
    points = corners.reshape(-1, 3)
    triangles = np.arange(len(points), dtype=np.int32).reshape(-1, 3)
    lower, upper = points.min(axis=0), points.max(axis=0)
    obj = thing("/walls", tuple(lower.tolist()), tuple((upper - lower).tolist()))
    return (obj, "Wall"), Surface((SurfacePiece(points.astype(np.float32), triangles, np.eye(4)),))


def turned(points, degrees: float) -> np.ndarray:
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.asarray(points) @ np.array([[cos, sin], [-sin, cos]])


def box_corners(lower, upper) -> np.ndarray:
    x, y, z = zip(lower, upper, strict=True)
    at = np.array([(a, b, c) for a in x for b in y for c in z], float)
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return np.array([at[list(half)] for a, b, c, d in sides for half in ((a, b, c), (a, c, d))])


def test_a_plan_that_is_a_million_metres_long_has_few_cells():
    before = time.process_time()
    relate(wall("long", (0, 0), (1e6, 0.1)), artifact("table", (0, 1, 0), (1, 1, 0.8)), kinds=("room",))
    assert time.process_time() - before < 10
