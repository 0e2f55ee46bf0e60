"""`on` and `inside` between boxes, with results computed by hand.

Lengths are metres. Thresholds that may be tuned are read from the rules; the tests try both sides of them.
"""

import time

import pytest

from tests.graph.records import box_at, related, thing
from tests.grounding.records import make_object
from tests.relations.room_builder import FLOOR, HAIR, RULES, TABLE, Placed, artifact, cup, home, relate
from tests.shapes.solids import boxes
from usd2kg.ontology import TBox
from usd2kg.scene import Box

ON, INSIDE, HOVERING = RULES.on, RULES.inside, RULES.hovering


class TestOn:
    def test_cup_is_on_a_table_on_the_floor(self):
        found = relate(FLOOR, TABLE, cup((0.4, 0.4, 0.7)))
        assert related(found) == {("table", "on", "floor"), ("cup", "on", "table")}

    def test_measurements(self):
        # The cup extends from x = 0.95 to 1.05; half of it, up to x = 1, is over the table. The gap is 0.704 m - 0.7 m.
        (relation,) = relate(TABLE, cup((0.95, 0.4, 0.704)))
        assert (relation.kind, relation.target, relation.anchor, relation.rule) == ("on", "/cup", "/table", ON.rule)
        assert relation.numbers == pytest.approx({"gap": 0.004, "overlapRatio": 0.5})

    def test_penetration_is_a_negative_gap(self):
        (relation,) = relate(TABLE, cup((0.4, 0.4, 0.695)))
        assert relation.numbers["gap"] == pytest.approx(-0.005)

    def test_a_book_on_a_tray_on_a_table_is_on_the_tray_only(self):
        tray = (thing("/tray", (0.2, 0.2, 0.7), (0.4, 0.3, 0.02)), "DesignedArtifact")
        book = (thing("/book", (0.25, 0.25, 0.72), (0.2, 0.15, 0.04)), "DesignedArtifact")
        assert related(relate(TABLE, tray, book)) == {("tray", "on", "table"), ("book", "on", "tray")}

    def test_stacked_objects_are_a_chain(self):
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
    def test_gap_tolerance(self, height: float):
        # The tolerance is a clamped share of the target's height; the three heights test the share and both bounds.
        allowed = min(max(ON.gap_share * height, ON.min_gap), ON.max_gap)
        near = cup((0.4, 0.4, 0.7 + allowed - HAIR), (0.1, 0.1, height))
        far = cup((0.4, 0.4, 0.7 + allowed + HAIR), (0.1, 0.1, height))
        (relation,) = relate(TABLE, near)
        assert (relation.anchor, relation.rule) == ("/table", ON.rule)
        assert ON.rule not in {relation.rule for relation in relate(TABLE, far)}

    def test_overlap_threshold(self):
        # `over` of the cup's 0.1 m along x are over the table, whose edge is at x = 1.
        enough = ON.min_overlap_ratio * 0.1
        more = cup((1 - enough - HAIR, 0.4, 0.7))
        less = cup((1 - enough + HAIR, 0.4, 0.7))
        assert related(relate(TABLE, more)) == {("cup", "on", "table")}
        assert relate(TABLE, less) == ()

    def test_a_target_much_larger_than_its_anchor_is_balanced(self):
        # The board's middle, 0.1 m from its end, is over the edge of the post.
        post = (thing("/post", (0, 0, 0), (0.1, 0.1, 1)), "DesignedComponent")
        fits = (thing("/board", (0, 0, 1), (0.2 - HAIR, 0.1, 0.02)), "DesignedArtifact")
        too_large = (thing("/board", (0, 0, 1), (0.2 + HAIR, 0.1, 0.02)), "DesignedArtifact")
        assert related(relate(post, fits)) == {("board", "on", "post")}
        assert relate(post, too_large) == ()

    def test_book_is_on_a_shelf_board(self):
        boards = tuple(box_at((0, 0, z), (1, 0.3, 0.02)) for z in (0.4, 0.9, 1.4))
        shelf = (thing("/shelf", (0, 0, 0), (1, 0.3, 1.42), part_boxes=boards), "DesignedFurniture")
        book = (thing("/book", (0.1, 0.05, 0.92), (0.15, 0.2, 0.25)), "DesignedArtifact")
        between = (thing("/between", (0.5, 0.05, 1.1), (0.15, 0.2, 0.2)), "DesignedArtifact")
        (relation,) = relate(shelf, book, between)
        assert related([relation]) == {("book", "on", "shelf")}
        # From the board's top, 0.9 m + 0.02 m, not from the shelf's.
        assert relation.numbers == pytest.approx({"gap": 0, "overlapRatio": 1})

    def test_cushion_is_on_the_seat_of_a_chair(self):
        seat, back = box_at((0, 0, 0.4), (0.4, 0.4, 0.05)), box_at((0, 0.35, 0.45), (0.4, 0.05, 0.5))
        chair = (thing("/chair", (0, 0, 0), (0.4, 0.4, 0.95), part_boxes=(seat, back)), "DesignedChair")
        cushion = (thing("/cushion", (0.02, 0.02, 0.45), (0.35, 0.3, 0.06)), "DesignedArtifact")
        assert related(relate(chair, cushion)) == {("cushion", "on", "chair")}

    @pytest.mark.parametrize("height", [0.02, 0.03, 0.05, 0.3])
    def test_an_object_may_be_slightly_below_a_rim(self, height: float):
        # The tray's box ends at its rim: the share of the thickness limits low rims, the bound high ones.
        tray = (thing("/tray", (0.2, 0.2, 0.7), (0.4, 0.3, height)), "DesignedArtifact")
        sink = min(ON.sink_share * height, ON.max_sink)
        little = cup((0.3, 0.3, 0.7 + height - sink + HAIR))
        much = cup((0.3, 0.3, 0.7 + height - sink - HAIR))
        assert ("cup", "on", "tray") in related(relate(tray, little))
        assert relate(tray, much) == ()

    def test_objects_below_beside_or_far_above_are_not_on(self):
        under = cup((0.4, 0.4, 0.3), name="under")
        beside = cup((1.2, 0.4, 0.7), name="beside")
        above = cup((0.4, 0.4, 1.5), name="above")
        assert relate(TABLE, under, beside, above) == ()

    def test_adjacent_objects_do_not_support_each_other(self):
        other = (thing("/other", (1, 0, 0), (1, 1, 0.7)), "Table")
        assert relate(TABLE, other) == ()

    def test_wall_mounted_objects_are_on_nothing(self):
        wall = (thing("/wall", (0, 1, 0), (4, 0.1, 2.5)), "Wall")
        # Slightly penetrating the wall, as is common, well above the table.
        picture = (thing("/picture", (0.2, 0.96, 1.2), (0.5, 0.05, 0.4)), "DesignedArtifact")
        cabinet = (thing("/cabinet", (2, 0.7, 1.4), (0.6, 0.35, 0.7)), "KitchenCabinet")
        assert related(relate(FLOOR, TABLE, wall, picture, cabinet)) == {("table", "on", "floor")}

    def test_walls_and_doors_support_nothing(self):
        wall = (thing("/wall", (0, 0, 0), (4, 0.3, 2.5)), "Wall")
        door = (thing("/door", (5, 0, 0), (1, 0.3, 2)), "Door")
        assert relate(wall, door, cup((1, 0.1, 2.5)), cup((5.2, 0.1, 2), name="cup2")) == ()

    def test_floor_walls_and_ceiling_rest_on_nothing(self):
        wall = (thing("/wall", (0, 0, 0), (4, 0.3, 2.5)), "Wall")
        ceiling = (thing("/ceiling", (0, 0, 2.5), (4, 4, 0.1)), "Ceiling")
        door = (thing("/door", (1, 0.5, 0), (1, 0.05, 2)), "Door")
        assert relate(FLOOR, wall, ceiling, door) == ()

    def test_flat_rug_is_on_the_floor_and_supports(self):
        rug = (thing("/rug", (0, 0, 0), (2, 2, 0)), "DesignedFurniture")
        assert ("rug", "on", "floor") in related(relate(FLOOR, rug))

    def test_accepts_boxes_without_area(self):
        poster = (thing("/poster", (0.5, 0.5, 0.7), (0.4, 0, 0.6)), "DesignedArtifact")
        point = (thing("/point", (0.5, 0.5, 0.7), (0, 0, 0)), "DesignedArtifact")
        assert not {r.anchor for r in relate(TABLE, poster, point)} & {"/poster", "/point"}


class TestInside:
    BOWL = (thing("/bowl", (0.4, 0.4, 0.7), (0.3, 0.3, 0.12)), "Bowl")

    def test_apple_is_inside_a_bowl_on_a_table(self):
        apple = (thing("/apple", (0.5, 0.5, 0.72), (0.08, 0.08, 0.08)), "DesignedArtifact")
        assert related(relate(TABLE, self.BOWL, apple)) == {("bowl", "on", "table"), ("apple", "inside", "bowl")}

    def test_measurement(self):
        # 0.1 m tall from 0.725, the bowl ends at 0.82: 0.095 of 0.1 is inside.
        apple = (thing("/apple", (0.5, 0.5, 0.725), (0.08, 0.08, 0.1)), "DesignedArtifact")
        (relation,) = (r for r in relate(self.BOWL, apple) if r.kind == "inside")
        assert (relation.target, relation.anchor, relation.rule) == ("/apple", "/bowl", INSIDE.rule)
        assert relation.numbers == pytest.approx({"insideRatio": 0.95})

    def test_volume_threshold(self):
        # A rod of 1 m along x in a crate that ends at x = 2.
        crate = (thing("/crate", (0, 0, 0), (2, 1, 1)), "Box")
        share = INSIDE.min_volume_ratio
        enough = (thing("/rod", (2 - share - HAIR, 0.4, 0.4), (1, 0.1, 0.1)), "DesignedArtifact")
        too_little = (thing("/rod", (2 - share + HAIR, 0.4, 0.4), (1, 0.1, 0.1)), "DesignedArtifact")
        assert related(relate(crate, enough)) == {("rod", "inside", "crate")}
        assert relate(crate, too_little) == ()

    def test_innermost_container_wins(self):
        cupboard = (thing("/cupboard", (0, 0, 1), (1, 0.5, 1)), "Cupboard")
        crate = (thing("/crate", (0.1, 0.1, 1.1), (0.6, 0.3, 0.4)), "Box")
        plate = (thing("/plate", (0.2, 0.12, 1.2), (0.25, 0.25, 0.02)), "DinnerPlate")
        room = (thing("/kitchen", (-2, -2, 0), (6, 6, 3)), "Kitchen")
        found = {pair for pair in related(relate(room, cupboard, crate, plate)) if pair[1] == "inside"}
        assert ("plate", "inside", "crate") in found
        assert ("crate", "inside", "cupboard") in found
        assert not {("plate", "inside", "cupboard"), ("plate", "inside", "kitchen")} & found

    def test_contents_are_not_on_their_container_or_its_supporter(self):
        apple = (thing("/apple", (0.5, 0.5, 0.71), (0.08, 0.08, 0.08)), "DesignedArtifact")
        assert {pair for pair in related(relate(TABLE, self.BOWL, apple)) if pair[0] == "apple"} == {
            ("apple", "inside", "bowl")
        }

    @pytest.mark.parametrize("cls", ["Spoon", "Plate", "Lid", "Table", "DesignedChair"])
    def test_classes_without_the_disposition_are_not_containers(self, cls: str):
        around = (thing("/around", (0, 0, 0), (1, 1, 1)), cls)
        crumb = (thing("/crumb", (0.4, 0.4, 0.4), (0.1, 0.1, 0.1)), "DesignedArtifact")
        assert ("crumb", "inside", "around") not in related(relate(around, crumb))

    @pytest.mark.parametrize("cls", ["Bowl", "Cupboard", "Refrigerator", "Box", "Drawer", "Sink", "TrashContainer"])
    def test_classes_with_the_disposition_are_containers(self, cls: str):
        around = (thing("/around", (0, 0, 0), (1, 1, 1)), cls)
        crumb = (thing("/crumb", (0.4, 0.4, 0.4), (0.1, 0.1, 0.1)), "DesignedArtifact")
        assert related(relate(around, crumb)) == {("crumb", "inside", "around")}

    def test_a_fitted_part_is_not_inside_its_whole(self):
        cabinet = (thing("/cabinet", (0, 0, 0), (0.6, 0.6, 0.9)), "KitchenCabinet")
        drawer = (thing("/cabinet/drawer", (0.02, 0.02, 0.5), (0.56, 0.5, 0.2), parent_path="/cabinet"), "Drawer")
        handle = (thing("/cabinet/handle", (0.2, 0.02, 0.6), (0.1, 0.02, 0.02)), "DesignedHandle")
        door = (thing("/cabinet/door", (0.02, 0.01, 0.1), (0.5, 0.02, 0.3)), "Door")
        # A drawer is both a part and inside.
        assert related(relate(cabinet, drawer, handle, door)) == {("drawer", "inside", "cabinet")}

    def test_a_fork_in_a_drawer_is_inside(self):
        cabinet = (thing("/cabinet", (0, 0, 0), (0.6, 0.6, 0.9)), "KitchenCabinet")
        drawer = (thing("/cabinet/drawer", (0.02, 0.02, 0.5), (0.56, 0.5, 0.2), parent_path="/cabinet"), "Drawer")
        fork = (thing("/fork", (0.2, 0.1, 0.55), (0.02, 0.2, 0.02)), "Fork")
        found = related(relate(cabinet, drawer, fork))
        assert found == {("fork", "inside", "drawer"), ("drawer", "inside", "cabinet")}

    def test_equal_boxes_do_not_contain_each_other(self):
        twin = (thing("/twin", (0.4, 0.4, 0.7), (0.3, 0.3, 0.12)), "Bowl")
        assert {r.kind for r in relate(self.BOWL, twin)} <= {"on"}

    def test_soma_classes_contain_as_soma_says_even_if_the_ontology_does_not(self):
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
        around = thing("/around", (0, 0, 0), (1, 1, 1))
        crumb = (thing("/crumb", (0.4, 0.4, 0.4), (0.1, 0.1, 0.1)), "DesignedArtifact")
        for chosen in (silent, tbox):
            assert related(relate((around, "Table"), crumb, tbox=chosen)) == set()
            assert related(relate((around, "Box"), crumb, tbox=chosen)) == {("crumb", "inside", "around")}

    def cabinets(self, *starts: float, cls: str = "KitchenCabinet", top: float = 0.86) -> list[Placed]:
        return [(thing(f"/cab{i}", (x, 0, 0), (0.6, 0.55, top)), cls) for i, x in enumerate(starts)]

    WORKTOP = (thing("/worktop", (0, 0, 0.86), (3, 0.6, 0.04)), "Countertop")

    def test_worktop_is_on_all_its_cabinets(self):
        found = relate(self.WORKTOP, *self.cabinets(0, 1.2, 2.4))
        assert related(found) == {("worktop", "on", f"cab{i}") for i in range(3)}
        # Each supports 0.6 m × 0.55 m of 3 m × 0.6 m.
        assert {relation.rule for relation in found} == {RULES.on_several.rule}
        assert found[0].numbers == pytest.approx({"gap": 0, "overlapRatio": 0.33 / 1.8})

    def test_lower_cabinets_do_not_support_the_worktop(self):
        lower = (thing("/low", (0.6, 0, 0), (0.6, 0.55, 0.7)), "KitchenCabinet")
        found = related(relate(self.WORKTOP, lower, *self.cabinets(0, 1.2, 2.4)))
        assert ("worktop", "on", "low") not in found
        assert len(found) == 3

    def test_built_in_appliances_do_not_support_the_worktop(self):
        dishwasher = (thing("/dishwasher", (0.6, 0, 0), (0.6, 0.55, 0.86)), "Dishwasher")
        found = related(relate(self.WORKTOP, dishwasher, *self.cabinets(0, 1.2, 2.4)))
        assert found == {("worktop", "on", f"cab{i}") for i in range(3)}

    def test_supporters_must_surround_the_centre(self):
        (balanced,) = relate(self.WORKTOP, *self.cabinets(1.2))
        assert balanced.rule == HOVERING.rule
        assert relate(self.WORKTOP, *self.cabinets(0, 0.6)) == ()
        assert len(relate(self.WORKTOP, *self.cabinets(0, 2.4))) == 2


class TestHovering:
    def test_slightly_hovering_lamp_is_on_the_table(self):
        (relation,) = relate(TABLE, cup((0.4, 0.4, 0.735)))
        assert (relation.anchor, relation.rule) == ("/table", HOVERING.rule)
        assert relation.numbers == pytest.approx({"gap": 0.035, "overlapRatio": 1})
        # Half of the tolerance of 0.07 m: half of the margin.
        assert relation.confidence == pytest.approx(0.5)

    def test_gap_limit(self):
        assert relate(TABLE, cup((0.4, 0.4, 0.7 + HOVERING.max_gap + HAIR))) == ()

    def test_wall_mounted_objects_do_not_hover(self):
        wall = (thing("/wall", (0, 1, 0), (4, 0.1, 2.5)), "Wall")
        radiator = artifact("radiator", (2, 0.9, 0.035), (1, 0.1, 0.7))
        in_the_room = artifact("heater", (2, -2, 0.035), (1, 0.1, 0.7))
        assert related(relate(FLOOR, wall, radiator, in_the_room)) == {("heater", "on", "floor")}

    def test_supported_objects_do_not_hover(self):
        tray = artifact("tray", (0.2, 0.2, 0.7), (0.4, 0.3, 0.02))
        book = artifact("book", (0.25, 0.25, 0.72), (0.2, 0.15, 0.04))
        assert related(relate(TABLE, tray, book)) == {("tray", "on", "table"), ("book", "on", "tray")}


class TestFeet:
    """A tap with a spout far over the basin: its foot decides."""

    FOOT, SPOUT = box_at((0.1, 0.1, 0.9), (0.05, 0.05, 0.1)), box_at((0.1, 0.1, 1.0), (0.05, 0.4, 0.2))
    TAP = (thing("/tap", (0.1, 0.1, 0.9), (0.05, 0.4, 0.3), part_boxes=(FOOT, SPOUT)), "Tap")

    def test_overlap_uses_the_foot(self):
        # The ledge is below half of the tap, but below all of its foot.
        ledge = (thing("/ledge", (0, 0, 0.8), (1, 0.3, 0.1)), "Countertop")
        (relation,) = relate(ledge, self.TAP)
        assert relation.numbers == pytest.approx({"gap": 0, "overlapRatio": 1})

    def test_only_the_feet_decide_what_supports_an_object(self):
        far_side = (thing("/far", (0, 0.2, 0.8), (1, 0.4, 0.1)), "Countertop")
        assert relate(far_side, self.TAP) == ()


class TestLevels:
    """Shelves in one mesh have their boards as level faces."""

    LEVELS = tuple(Box((0, 0, z), (1, 0.3, z)) for z in (0.4, 0.9, 1.4))
    SHELF = (thing("/shelf", (0, 0, 0), (1, 0.3, 1.8), support_levels=LEVELS), "DesignedFurniture")

    @pytest.mark.parametrize("height", [0.4, 0.9, 1.4])
    def test_books_are_on_each_board(self, height: float):
        book = artifact("book", (0.1, 0.05, height + 0.004), (0.15, 0.2, 0.25))
        (relation,) = relate(FLOOR, self.SHELF, book)[1:]
        assert (relation.target, relation.kind, relation.anchor) == ("/book", "on", "/shelf")
        assert relation.numbers == pytest.approx({"gap": 0.004, "overlapRatio": 1})

    def test_object_between_boards_is_not_on(self):
        assert relate(self.SHELF, artifact("book", (0.1, 0.05, 1.1), (0.15, 0.2, 0.2))) == ()

    def test_an_object_on_the_board_takes_precedence(self):
        tray = artifact("tray", (0.1, 0.05, 0.9), (0.4, 0.2, 0.02))
        jar = artifact("jar", (0.2, 0.1, 0.92), (0.1, 0.1, 0.15))
        assert related(relate(self.SHELF, tray, jar)) == {("tray", "on", "shelf"), ("jar", "on", "tray")}

    def test_jar_below_the_upstand_is_on_and_not_inside(self):
        # The worktop is at 0.9 m of 1.1 m, 0.82 of the height, below an upstand.
        top = (Box((0, 0, 0.9), (2, 0.6, 0.9)),)
        unit = (thing("/unit", (0, 0, 0), (2, 0.6, 1.1), support_levels=top), "KitchenCabinet")
        jar = (thing("/jar", (0.5, 0.2, 0.9), (0.1, 0.1, 0.15)), "Jar")
        assert related(relate(unit, jar)) == {("jar", "on", "unit")}
        closed = (thing("/unit", (0, 0, 0), (2, 0.6, 1.1)), "KitchenCabinet")
        assert related(relate(closed, jar)) == {("jar", "inside", "unit")}

    def test_object_on_a_board_is_inside_the_cupboard(self):
        boards = tuple(Box((0, 0, z), (1, 0.4, z)) for z in (0.1, 0.9, 1.2))
        cupboard = (thing("/cupboard", (0, 0, 0), (1, 0.4, 1.2), support_levels=boards), "Cupboard")
        high = (thing("/plate", (0.2, 0.1, 0.9), (0.25, 0.25, 0.02)), "DinnerPlate")
        on_top = (thing("/vase", (0.2, 0.1, 1.2), (0.1, 0.1, 0.2)), "DesignedContainer")
        assert related(relate(cupboard, high, on_top)) == {("plate", "inside", "cupboard"), ("vase", "on", "cupboard")}


class TestStandingIn:
    POT = (thing("/pot", (0, 0, 0.9), (0.14, 0.14, 0.15)), "DesignedContainer")
    TOP = (thing("/top", (-1, -1, 0.8), (2, 2, 0.1)), "Countertop")

    def test_protruding_ladle_is_inside_the_pot(self):
        # 0.14 of 0.3 m are below the rim at 1.05 m; half of the width is beyond it.
        ladle = (thing("/ladle", (0.09, 0.05, 0.91), (0.1, 0.05, 0.3)), "Spoon")
        found = relate(self.TOP, self.POT, ladle)
        assert related(found) == {("pot", "on", "top"), ("ladle", "inside", "pot")}
        assert (found[-1].rule, found[-1].numbers) == (
            RULES.standing_in.rule,
            pytest.approx({"insideRatio": 0.5 * 0.14 / 0.3}),
        )

    def test_flowers_may_be_larger_than_their_vase(self):
        vase = (thing("/vase", (0, 0, 0.9), (0.12, 0.12, 0.2)), "DesignedContainer")
        flowers = artifact("flowers", (-0.02, -0.02, 0.91), (0.16, 0.16, 0.4))
        assert ("flowers", "inside", "vase") in related(relate(self.TOP, vase, flowers))

    def test_plates_are_inside_a_bottomless_rack(self):
        rack = (thing("/rack", (0, 0, 0.9), (0.35, 0.25, 0.11)), "Rack")
        plate = (thing("/plate", (0.1, 0.03, 0.9), (0.02, 0.19, 0.19)), "DinnerPlate")
        assert ("plate", "inside", "rack") in related(relate(self.TOP, rack, plate))

    def test_an_object_beside_a_container_is_not_inside(self):
        # The bottle overlaps the pot's box by a third, as round objects may at corners, and starts at the same height.
        bottle = (thing("/bottle", (0.08, 0.08, 0.9), (0.09, 0.09, 0.3)), "Bottle")
        assert ("bottle", "inside", "pot") not in related(relate(self.TOP, self.POT, bottle))

    def test_closed_containers_contain_no_protruding_object(self):
        jar = (thing("/jar", (0, 0, 0.9), (0.14, 0.14, 0.15)), "Jar")
        spoon = (thing("/spoon", (0.05, 0.05, 0.91), (0.02, 0.03, 0.3)), "Spoon")
        assert ("spoon", "inside", "jar") not in related(relate(self.TOP, jar, spoon))

    def test_chair_over_a_bucket_is_not_inside(self):
        bucket = (thing("/bucket", (0.1, 0.1, 0), (0.28, 0.28, 0.3)), "DesignedContainer")
        chair = (thing("/chair", (0, 0, 0), (0.5, 0.5, 0.9)), "DesignedChair")
        assert related(relate(FLOOR, bucket, chair)) == {("bucket", "on", "floor"), ("chair", "on", "floor")}


class TestConsistency:
    def test_chair_under_a_table_is_not_inside(self):
        chair = (thing("/chair", (0.3, 0.3, 0), (0.4, 0.4, 0.65)), "DesignedChair")
        assert related(relate(FLOOR, TABLE, chair)) == {("table", "on", "floor"), ("chair", "on", "floor")}

    def test_on_is_asymmetric_for_overlapping_sheets(self):
        one = artifact("mat", (0, 0, 0.001), (1, 1, 0.004))
        other = artifact("towel", (0.2, 0.2, 0), (0.5, 0.5, 0.006))
        assert related(relate(one, other)) == {("towel", "on", "mat")}

    def test_table_penetrating_a_rug_is_on_it(self):
        rug = artifact("rug", (-1, -1, 0), (3, 3, 0.004))
        sunk = (thing("/table", (0, 0, -0.001), (1, 1, 0.7)), "Table")
        assert ("table", "on", "rug") in related(relate(FLOOR, rug, sunk))

    def test_nested_boxes_are_a_chain(self):
        nest = [(thing(f"/box{i}", (0.1 * i,) * 3, (1 - 0.2 * i,) * 3), "Box") for i in range(4)]
        assert related(relate(*nest)) == {(f"box{i + 1}", "inside", f"box{i}") for i in range(3)}


class TestConfidence:
    def test_confidence_of_on(self):
        # The gap is 0.0025 m of 0.01 m: the margin is 0.75, and 0.75² (3 - 2 · 0.75) = 0.84375.
        (relation,) = relate(TABLE, cup((0.4, 0.4, 0.7025)))
        assert relation.confidence == pytest.approx(0.84375)

    def test_smallest_margin_determines_the_confidence(self):
        # 0.65 of the footprint is over the table: halfway from 0.3 to 1. The gap is 0.
        (relation,) = relate(TABLE, cup((0.965, 0.4, 0.7), (0.1, 0.1, 0.1)))
        assert relation.numbers["overlapRatio"] == pytest.approx(0.35)
        (relation,) = relate(TABLE, cup((0.935, 0.4, 0.7), (0.1, 0.1, 0.1)))
        assert relation.numbers["overlapRatio"] == pytest.approx(0.65)
        assert relation.confidence == pytest.approx(0.5)

    def test_confidence_of_inside(self):
        # 0.8 of the apple is in the crate, halfway from 0.6 to 1.
        crate = (thing("/crate", (0, 0, 0), (1, 1, 1)), "Box")
        rod = artifact("rod", (0.8 - 0.64, 0.4, 0.4), (1.05, 0.1, 0.1))
        (relation,) = (r for r in relate(crate, rod) if r.kind == "inside")
        assert relation.numbers["insideRatio"] == pytest.approx(0.8)
        assert relation.confidence == pytest.approx(0.5)


class TestObjects:
    def test_object_nested_below_its_supporter_is_on_it(self):
        nested = thing("/table/cup", (0.4, 0.4, 0.7), (0.1, 0.1, 0.1), parent_path="/table")
        # The table's box is 0.8 m tall with the cup; its own box is used.
        whole = thing("/table", (0, 0, 0), (1, 1, 0.8))
        table = thing("/table", (0, 0, 0), (1, 1, 0.7), box=whole.box)
        assert related(relate((table, "Table"), (nested, "Cup"))) == {("cup", "on", "table")}

    def test_objects_without_a_box_have_no_relations(self):
        ghost = (make_object("/ghost"), "Cup")
        bare = (make_object("/bare", box=TABLE[0].box), "Cup")
        assert relate(TABLE, ghost, bare) == ()
        assert relate(ghost) == ()
        assert relate() == ()

    def test_ungrounded_objects_are_related_by_their_boxes(self):
        found = relate(TABLE, (thing("/unknown", (0.4, 0.4, 0.7), (0.1, 0.1, 0.1)), ""))
        assert related(found) == {("unknown", "on", "table")}

    def test_relations_are_in_scene_order(self):
        cups = [cup((0.1 + 0.2 * i, 0.4, 0.7), name=f"cup{i}") for i in (3, 1, 2)]
        assert [r.target for r in relate(TABLE, *cups)] == ["/cup3", "/cup1", "/cup2"]

    def test_order_of_objects_does_not_matter(self):
        placed = [FLOOR, TABLE, TestInside.BOWL, cup((0.1, 0.1, 0.7)), cup((0.45, 0.45, 0.72), (0.05,) * 3, "egg")]
        assert related(relate(*placed)) == related(relate(*reversed(placed)))


def test_three_thousand_objects_are_fast():
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


class TestPlants:
    """A pot with soil 4 cm below its rim."""

    POT = (thing("/pot", (0, 0, 0), (0.2, 0.2, 0.2)), "Pot")
    SURFACE = boxes(
        ((0, 0, 0), (0.2, 0.2, 0.16)),
        ((0, 0, 0.16), (0.02, 0.2, 0.2)),
        ((0.18, 0, 0.16), (0.2, 0.2, 0.2)),
        ((0, 0, 0.16), (0.2, 0.02, 0.2)),
        ((0, 0.18, 0.16), (0.2, 0.2, 0.2)),
    )

    @pytest.mark.parametrize(("depth", "is_in"), [(0.05, True), (0.02, False)])
    def test_a_plant_broader_than_its_pot_is_in_it(self, depth: float, is_in: bool):
        stem = box_at((0.09, 0.09, 0.2 - depth), (0.02, 0.02, 0.2))
        crown = box_at((-0.02, -0.02, 0.4 - depth), (0.24, 0.24, 0.2))
        plant = artifact("plant", (-0.02, -0.02, 0.2 - depth), (0.24, 0.24, 0.4), part_boxes=(stem, crown))
        shape = boxes(*((box.lower, box.upper) for box in (stem, crown)))
        found = relate(FLOOR, self.POT, plant, surfaces={"/pot": self.SURFACE, "/plant": shape})
        assert (("/plant", "inside", "/pot") in {(r.target, r.kind, r.anchor) for r in found}) == is_in

    def test_a_lid_as_broad_as_the_pot_is_not_in_it(self):
        lid = artifact("lid", (-0.01, -0.01, 0.17), (0.22, 0.22, 0.2))
        found = relate(FLOOR, self.POT, lid, surfaces={"/pot": self.SURFACE})
        assert ("/lid", "inside", "/pot") not in {(r.target, r.kind, r.anchor) for r in found}
