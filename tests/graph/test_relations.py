"""What is on what and what is inside what, on boxes whose answers can be worked out by hand.

Lengths are metres. Thresholds that may be tuned are read from the rules; the tests try both sides of them.
"""

import time
import tomllib
from functools import cache
from importlib.resources import files

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.graph.records import Corner, box_at, ground_as, related, thing
from tests.grounding.records import make_object, make_scene
from usd2kg.graph.relations import Relation, find_relations
from usd2kg.ontology import TBox, load_home_tbox
from usd2kg.scene import SceneObject

RULES = tomllib.loads((files("usd2kg.graph") / "data" / "spatial.toml").read_text("utf-8"))
ON, INSIDE = RULES["on"], RULES["inside"]
HAIR = 1e-4
"""Far above rounding, far below every threshold."""

Placed = tuple[SceneObject, str]

FLOOR = (thing("/floor", (-5, -5, -0.1), (10, 10, 0.1)), "Floor")
TABLE = (thing("/table", (0, 0, 0), (1, 1, 0.7)), "Table")


home = cache(load_home_tbox)


def relate(*placed: Placed, tbox: TBox | None = None) -> tuple[Relation, ...]:
    tbox = tbox or home()
    scene = make_scene(*(obj for obj, _ in placed))
    return find_relations(scene, tbox, ground_as(tbox, scene, {obj.prim_path: cls for obj, cls in placed if cls}))


def cup(lower: Corner, size: Corner = (0.1, 0.1, 0.1), name: str = "cup") -> Placed:
    return thing(f"/{name}", lower, size), "Cup"


class TestOn:
    def test_a_cup_on_a_table_on_the_floor(self):
        found = relate(FLOOR, TABLE, cup((0.4, 0.4, 0.7)))
        assert related(found) == {("table", "on", "floor"), ("cup", "on", "table")}

    def test_its_numbers(self):
        # The cup's footprint is 0.1 m × 0.1 m; x from 0.95 to 1.05, of which 0.95 to 1 is over the table: one half.
        # It hovers by 0.704 m - 0.7 m.
        (relation,) = relate(TABLE, cup((0.95, 0.4, 0.704)))
        assert (relation.kind, relation.target, relation.anchor, relation.rule) == ("on", "/cup", "/table", ON["rule"])
        assert relation.numbers == pytest.approx({"gap": 0.004, "overlapRatio": 0.5})

    def test_what_sinks_in_a_little_has_a_negative_gap(self):
        (relation,) = relate(TABLE, cup((0.4, 0.4, 0.695)))
        assert relation.numbers["gap"] == pytest.approx(-0.005)

    def test_a_book_on_a_tray_on_a_table_is_on_the_tray_only(self):
        tray = (thing("/tray", (0.2, 0.2, 0.7), (0.4, 0.3, 0.02)), "DesignedArtifact")
        book = (thing("/book", (0.25, 0.25, 0.72), (0.2, 0.15, 0.04)), "DesignedArtifact")
        assert related(relate(TABLE, tray, book)) == {("tray", "on", "table"), ("book", "on", "tray")}

    def test_a_stack_is_a_chain(self):
        plates = [
            (thing(f"/plate{i}", (0.4, 0.4, 0.7 + 0.02 * i), (0.25, 0.25, 0.02)), "DinnerPlate") for i in range(4)
        ]
        assert related(relate(TABLE, *plates)) == {
            ("plate0", "on", "table"),
            ("plate1", "on", "plate0"),
            ("plate2", "on", "plate1"),
            ("plate3", "on", "plate2"),
        }

    @pytest.mark.parametrize("height", [0.02, 0.2, 5.0])
    def test_hovering_by_just_less_and_just_more_than_the_tolerance(self, height: float):
        # The tolerance is a share of the target's height between two bounds; the three heights meet each of them.
        allowed = min(max(ON["gap_share"] * height, ON["min_gap"]), ON["max_gap"])
        near = cup((0.4, 0.4, 0.7 + allowed - HAIR), (0.1, 0.1, height))
        far = cup((0.4, 0.4, 0.7 + allowed + HAIR), (0.1, 0.1, height))
        assert related(relate(TABLE, near)) == {("cup", "on", "table")}
        assert relate(TABLE, far) == ()

    def test_overlap_of_just_more_and_just_less_than_is_asked(self):
        # Of the cup's 0.1 m along x, `over` metres lie over the table, whose edge is at x = 1.
        enough = ON["min_overlap_ratio"] * 0.1
        more = cup((1 - enough - HAIR, 0.4, 0.7))
        less = cup((1 - enough + HAIR, 0.4, 0.7))
        assert related(relate(TABLE, more)) == {("cup", "on", "table")}
        assert relate(TABLE, less) == ()

    def test_larger_than_what_carries_it(self):
        # A board of the post's width: its length makes the ratio of the two footprints.
        post = (thing("/post", (0, 0, 0), (0.1, 0.1, 1)), "DesignedComponent")
        ratio = ON["max_area_ratio"]
        fits = (thing("/board", (0, 0, 1), (0.1 * ratio - HAIR, 0.1, 0.02)), "DesignedArtifact")
        too_large = (thing("/board", (0, 0, 1), (0.1 * ratio + HAIR, 0.1, 0.02)), "DesignedArtifact")
        assert related(relate(post, fits)) == {("board", "on", "post")}
        assert relate(post, too_large) == ()

    def test_on_a_board_of_a_shelf(self):
        boards = tuple(box_at((0, 0, z), (1, 0.3, 0.02)) for z in (0.4, 0.9, 1.4))
        shelf = (thing("/shelf", (0, 0, 0), (1, 0.3, 1.42), part_boxes=boards), "DesignedFurniture")
        book = (thing("/book", (0.1, 0.05, 0.92), (0.15, 0.2, 0.25)), "DesignedArtifact")
        between = (thing("/between", (0.5, 0.05, 1.1), (0.15, 0.2, 0.2)), "DesignedArtifact")
        (relation,) = relate(shelf, book, between)
        assert related([relation]) == {("book", "on", "shelf")}
        # From the board's top, 0.9 m + 0.02 m, not from the shelf's.
        assert relation.numbers == pytest.approx({"gap": 0, "overlapRatio": 1})

    def test_on_the_seat_of_a_chair_below_the_top_of_its_back(self):
        seat, back = box_at((0, 0, 0.4), (0.4, 0.4, 0.05)), box_at((0, 0.35, 0.45), (0.4, 0.05, 0.5))
        chair = (thing("/chair", (0, 0, 0), (0.4, 0.4, 0.95), part_boxes=(seat, back)), "DesignedChair")
        cushion = (thing("/cushion", (0.02, 0.02, 0.45), (0.35, 0.3, 0.06)), "DesignedArtifact")
        assert related(relate(chair, cushion)) == {("cushion", "on", "chair")}

    @pytest.mark.parametrize("height", [0.02, 0.03, 0.05, 0.3])
    def test_a_thing_may_sink_below_a_rim_but_not_far(self, height: float):
        # A tray whose box ends at its rim: low rims are met by the share of their height, high ones by the bound.
        tray = (thing("/tray", (0.2, 0.2, 0.7), (0.4, 0.3, height)), "DesignedArtifact")
        sink = min(ON["sink_share"] * height, ON["max_sink"])
        little = cup((0.3, 0.3, 0.7 + height - sink + HAIR))
        much = cup((0.3, 0.3, 0.7 + height - sink - HAIR))
        assert ("cup", "on", "tray") in related(relate(tray, little))
        assert relate(tray, much) == ()

    def test_under_beside_and_far_above_are_not_on(self):
        under = cup((0.4, 0.4, 0.3), name="under")
        beside = cup((1.2, 0.4, 0.7), name="beside")
        above = cup((0.4, 0.4, 1.5), name="above")
        assert relate(TABLE, under, beside, above) == ()

    def test_two_things_side_by_side_carry_neither_each_other(self):
        other = (thing("/other", (1, 0, 0), (1, 1, 0.7)), "Table")
        assert relate(TABLE, other) == ()

    def test_what_hangs_on_a_wall_is_on_nothing(self):
        wall = (thing("/wall", (0, 1, 0), (4, 0.1, 2.5)), "Wall")
        # Sunk into the wall a little, as meshes are, well above the table.
        picture = (thing("/picture", (0.2, 0.96, 1.2), (0.5, 0.05, 0.4)), "DesignedArtifact")
        cabinet = (thing("/cabinet", (2, 0.7, 1.4), (0.6, 0.35, 0.7)), "KitchenCabinet")
        assert related(relate(FLOOR, TABLE, wall, picture, cabinet)) == {("table", "on", "floor")}

    def test_nothing_is_on_a_wall_or_a_door_even_at_its_top(self):
        wall = (thing("/wall", (0, 0, 0), (4, 0.3, 2.5)), "Wall")
        door = (thing("/door", (5, 0, 0), (1, 0.3, 2)), "Door")
        assert relate(wall, door, cup((1, 0.1, 2.5)), cup((5.2, 0.1, 2), name="cup2")) == ()

    def test_the_shell_of_a_room_is_on_nothing(self):
        wall = (thing("/wall", (0, 0, 0), (4, 0.3, 2.5)), "Wall")
        ceiling = (thing("/ceiling", (0, 0, 2.5), (4, 4, 0.1)), "Ceiling")
        door = (thing("/door", (1, 0.5, 0), (1, 0.05, 2)), "Door")
        assert relate(FLOOR, wall, ceiling, door) == ()

    def test_a_rug_of_no_height_lies_on_the_floor_and_carries(self):
        rug = (thing("/rug", (0, 0, 0), (2, 2, 0)), "DesignedFurniture")
        assert ("rug", "on", "floor") in related(relate(FLOOR, rug))

    def test_boxes_of_no_area_do_no_harm(self):
        poster = (thing("/poster", (0.5, 0.5, 0.7), (0.4, 0, 0.6)), "DesignedArtifact")
        point = (thing("/point", (0.5, 0.5, 0.7), (0, 0, 0)), "DesignedArtifact")
        assert not {r.anchor for r in relate(TABLE, poster, point)} & {"/poster", "/point"}


class TestInside:
    BOWL = (thing("/bowl", (0.4, 0.4, 0.7), (0.3, 0.3, 0.12)), "Bowl")

    def test_an_apple_in_a_bowl_on_a_table(self):
        apple = (thing("/apple", (0.5, 0.5, 0.72), (0.08, 0.08, 0.08)), "DesignedArtifact")
        assert related(relate(TABLE, self.BOWL, apple)) == {("bowl", "on", "table"), ("apple", "inside", "bowl")}

    def test_its_number(self):
        # 0.1 m tall from 0.725, the bowl ends at 0.82: 0.095 of 0.1 is inside.
        apple = (thing("/apple", (0.5, 0.5, 0.725), (0.08, 0.08, 0.1)), "DesignedArtifact")
        (relation,) = (r for r in relate(self.BOWL, apple) if r.kind == "inside")
        assert (relation.target, relation.anchor, relation.rule) == ("/apple", "/bowl", INSIDE["rule"])
        assert relation.numbers == pytest.approx({"insideRatio": 0.95})

    def test_just_enough_and_just_not_enough_of_it_inside(self):
        # A rod 1 m long along x in a crate that ends at x = 2.
        crate = (thing("/crate", (0, 0, 0), (2, 1, 1)), "Box")
        share = INSIDE["min_volume_ratio"]
        enough = (thing("/rod", (2 - share - HAIR, 0.4, 0.4), (1, 0.1, 0.1)), "DesignedArtifact")
        too_little = (thing("/rod", (2 - share + HAIR, 0.4, 0.4), (1, 0.1, 0.1)), "DesignedArtifact")
        assert related(relate(crate, enough)) == {("rod", "inside", "crate")}
        assert relate(crate, too_little) == ()

    def test_of_containers_around_it_the_innermost(self):
        cupboard = (thing("/cupboard", (0, 0, 1), (1, 0.5, 1)), "Cupboard")
        crate = (thing("/crate", (0.1, 0.1, 1.1), (0.6, 0.3, 0.4)), "Box")
        plate = (thing("/plate", (0.2, 0.12, 1.2), (0.25, 0.25, 0.02)), "DinnerPlate")
        room = (thing("/kitchen", (-2, -2, 0), (6, 6, 3)), "Kitchen")
        found = {pair for pair in related(relate(room, cupboard, crate, plate)) if pair[1] == "inside"}
        assert ("plate", "inside", "crate") in found
        assert ("crate", "inside", "cupboard") in found
        assert not {("plate", "inside", "cupboard"), ("plate", "inside", "kitchen")} & found

    def test_what_is_in_a_bowl_is_not_on_it_nor_on_its_table(self):
        apple = (thing("/apple", (0.5, 0.5, 0.71), (0.08, 0.08, 0.08)), "DesignedArtifact")
        assert {pair for pair in related(relate(TABLE, self.BOWL, apple)) if pair[0] == "apple"} == {
            ("apple", "inside", "bowl")
        }

    @pytest.mark.parametrize("cls", ["Spoon", "Plate", "Lid", "Table", "DesignedChair"])
    def test_what_holds_nothing_is_no_container(self, cls: str):
        around = (thing("/around", (0, 0, 0), (1, 1, 1)), cls)
        crumb = (thing("/crumb", (0.4, 0.4, 0.4), (0.1, 0.1, 0.1)), "DesignedArtifact")
        assert ("crumb", "inside", "around") not in related(relate(around, crumb))

    @pytest.mark.parametrize("cls", ["Bowl", "Cupboard", "Refrigerator", "Box", "Drawer", "Sink", "TrashContainer"])
    def test_what_holds_things_is(self, cls: str):
        around = (thing("/around", (0, 0, 0), (1, 1, 1)), cls)
        crumb = (thing("/crumb", (0.4, 0.4, 0.4), (0.1, 0.1, 0.1)), "DesignedArtifact")
        assert related(relate(around, crumb)) == {("crumb", "inside", "around")}

    def test_a_fitted_part_is_not_inside_what_it_belongs_to(self):
        cabinet = (thing("/cabinet", (0, 0, 0), (0.6, 0.6, 0.9)), "KitchenCabinet")
        drawer = (thing("/cabinet/drawer", (0.02, 0.02, 0.5), (0.56, 0.5, 0.2), parent_path="/cabinet"), "Drawer")
        handle = (thing("/cabinet/handle", (0.2, 0.02, 0.6), (0.1, 0.02, 0.02)), "DesignedHandle")
        door = (thing("/cabinet/door", (0.02, 0.01, 0.1), (0.5, 0.02, 0.3)), "Door")
        assert relate(cabinet, drawer, handle, door) == ()

    def test_but_a_fork_in_that_drawer_is(self):
        cabinet = (thing("/cabinet", (0, 0, 0), (0.6, 0.6, 0.9)), "KitchenCabinet")
        drawer = (thing("/cabinet/drawer", (0.02, 0.02, 0.5), (0.56, 0.5, 0.2), parent_path="/cabinet"), "Drawer")
        fork = (thing("/fork", (0.2, 0.1, 0.55), (0.02, 0.2, 0.02)), "Fork")
        assert related(relate(cabinet, drawer, fork)) == {("fork", "inside", "drawer")}

    def test_two_equal_boxes_are_in_neither(self):
        twin = (thing("/twin", (0.4, 0.4, 0.7), (0.3, 0.3, 0.12)), "Bowl")
        assert {r.kind for r in relate(self.BOWL, twin)} <= {"on"}

    def test_anything_may_contain_where_the_ontology_does_not_tell(self):
        tbox = home()
        silent = TBox(
            source="silent",
            ontology_iri=tbox.ontology_iri,
            version_iri=None,
            content_hash="",
            classes=tuple(
                type(cls)(cls.iri, cls.label, cls.alt_labels, cls.comment, cls.parents) for cls in tbox.classes
            ),
        )
        around = (thing("/around", (0, 0, 0), (1, 1, 1)), "Table")
        crumb = (thing("/crumb", (0.4, 0.4, 0.4), (0.1, 0.1, 0.1)), "DesignedArtifact")
        assert related(relate(around, crumb, tbox=silent)) == {("crumb", "inside", "around")}
        assert related(relate(around, crumb, tbox=tbox)) == set()


class TestObjects:
    def test_a_thing_nested_under_its_support_is_on_it(self):
        nested = thing("/table/cup", (0.4, 0.4, 0.7), (0.1, 0.1, 0.1), parent_path="/table")
        # With the cup the table's box is 0.8 m tall; its own box is what counts.
        whole = thing("/table", (0, 0, 0), (1, 1, 0.8))
        table = thing("/table", (0, 0, 0), (1, 1, 0.7), box=whole.box)
        assert related(relate((table, "Table"), (nested, "Cup"))) == {("cup", "on", "table")}

    def test_without_a_box_there_is_no_relation(self):
        ghost = (make_object("/ghost"), "Cup")
        bare = (make_object("/bare", box=TABLE[0].box), "Cup")
        assert relate(TABLE, ghost, bare) == ()
        assert relate(ghost) == ()
        assert relate() == ()

    def test_without_a_class_boxes_decide_alone(self):
        found = relate(TABLE, (thing("/unknown", (0.4, 0.4, 0.7), (0.1, 0.1, 0.1)), ""))
        assert related(found) == {("unknown", "on", "table")}

    def test_relations_come_in_scene_order(self):
        cups = [cup((0.1 + 0.2 * i, 0.4, 0.7), name=f"cup{i}") for i in (3, 1, 2)]
        assert [r.target for r in relate(TABLE, *cups)] == ["/cup3", "/cup1", "/cup2"]

    def test_the_order_of_the_objects_makes_no_difference(self):
        placed = [FLOOR, TABLE, TestInside.BOWL, cup((0.1, 0.1, 0.7)), cup((0.45, 0.45, 0.72), (0.05,) * 3, "egg")]
        assert related(relate(*placed)) == related(relate(*reversed(placed)))


GRID = 1 / 64
"""Multiples of a power of two add up without rounding, so that moving a room changes no digit of any number."""


@st.composite
def rooms(draw: st.DrawFn) -> list[Placed]:
    """Return a table on a floor and some things of random place and size, close together."""
    classes = st.sampled_from(["Table", "Bowl", "Cup", "Box", "DesignedArtifact", "Cupboard", "Wall", "Drawer"])
    corners = st.tuples(*[st.integers(0, 64)] * 3)
    sizes = st.tuples(*[st.integers(1, 64)] * 3)
    room = [(thing("/floor", (-8, -8, -1), (16, 16, 1)), "Floor"), (thing("/table", (0, 0, 0), (1, 1, 0.75)), "Table")]
    for i in range(draw(st.integers(1, 6))):
        lower, size = ([GRID * step for step in draw(steps)] for steps in (corners, sizes))
        # Every second thing begins where the table ends, or a little off.
        lower[2] = 0.75 + GRID * draw(st.integers(-2, 2)) if i % 2 else lower[2]
        room.append((thing(f"/thing{i}", tuple(lower), tuple(size)), draw(classes)))
    return room


def moved(placed: Placed, by: Corner) -> Placed:
    obj, cls = placed
    lower = tuple(a + b for a, b in zip(obj.own_box.lower, by, strict=True))
    return thing(obj.prim_path, lower, obj.own_box.size), cls


@settings(deadline=None, max_examples=60)
@given(rooms(), st.tuples(*[st.integers(-4096, 4096)] * 3))
def test_moving_the_whole_room_changes_nothing(room: list[Placed], steps: tuple[int, int, int]):
    by = tuple(GRID * step for step in steps)
    assert relate(*(moved(placed, by) for placed in room)) == relate(*room)


@settings(deadline=None, max_examples=30)
@given(st.tuples(*[st.floats(-1000, 1000)] * 3))
def test_nor_does_moving_it_by_any_length(by: Corner):
    room = [FLOOR, TABLE, TestInside.BOWL, cup((0.1, 0.1, 0.702)), cup((0.45, 0.45, 0.72), (0.05,) * 3, "egg")]
    found = relate(*(moved(placed, by) for placed in room))
    assert related(found) == {
        ("table", "on", "floor"),
        ("bowl", "on", "table"),
        ("cup", "on", "table"),
        ("egg", "inside", "bowl"),
    }
    # 1,000 m away a number has 13 digits left behind the point.
    gap = next(r.numbers["gap"] for r in found if r.target == "/cup")
    assert gap == pytest.approx(0.002, abs=1e-9)


@settings(deadline=None, max_examples=60)
@given(rooms())
def test_what_holds_for_every_room(room: list[Placed]):
    relations = relate(*room)
    by_kind = [(r.kind, r.target) for r in relations]
    assert len(by_kind) == len(set(by_kind)), "on one thing at most, and inside one at most"
    boxes = {obj.prim_path: obj.own_box for obj, _ in room}
    for r in relations:
        assert r.target != r.anchor
        target, anchor = boxes[r.target], boxes[r.anchor]
        if r.kind == "on":
            assert anchor.lower[2] < target.lower[2]
            assert ON["min_overlap_ratio"] < r.numbers["overlapRatio"] <= 1
            assert r.numbers["gap"] == pytest.approx(target.lower[2] - anchor.upper[2])
        else:
            assert anchor.volume > target.volume
            assert INSIDE["min_volume_ratio"] <= r.numbers["insideRatio"] <= 1
    pairs = {(r.kind, r.target, r.anchor) for r in relations}
    assert not any((kind, anchor, target) in pairs for kind, target, anchor in pairs)


def test_three_thousand_objects_take_seconds():
    # 30 × 10 tables with 9 cups each: 300 tables on the floor, 2,700 cups on tables.
    floor = (thing("/floor", (-1, -1, -0.1), (70, 30, 0.1)), "Floor")
    placed = [floor]
    for i in range(30):
        for j in range(10):
            placed.append((thing(f"/table_{i}_{j}", (2 * i, 2 * j, 0), (1, 1, 0.7)), "Table"))
            placed.extend(
                cup((2 * i + 0.1 + 0.3 * (k % 3), 2 * j + 0.1 + 0.3 * (k // 3), 0.7), name=f"cup_{i}_{j}_{k}")
                for k in range(9)
            )
    start = time.perf_counter()
    relations = relate(*placed)
    assert time.perf_counter() - start < 10
    assert len(relations) == 3000
    assert {r.anchor for r in relations if r.target.startswith("/table")} == {"/floor"}
    assert all(r.anchor == r.target.replace("cup", "table")[: -len("_0")] for r in relations if "cup" in r.target)
