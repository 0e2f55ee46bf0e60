"""touching, next-to and near."""

import math

import pytest

from tests.graph.records import box_at, thing
from tests.relations.room_builder import FLOOR, HAIR, RULES, TABLE, Placed, artifact, cup, pairs, relate

CLOSE = ("touching", "next-to", "near")


def names(*pair: str) -> frozenset[str]:
    return frozenset(pair)


def cabinet(name: str, x: float, width: float = 0.6) -> Placed:
    return thing(f"/{name}", (x, 0, 0), (width, 0.6, 0.8)), "KitchenCabinet"


class TestTouching:
    def test_adjacent_cabinets_touch(self):
        (relation,) = relate(cabinet("a", 0), cabinet("b", 0.602), kinds=("touching",))
        assert (relation.kind, relation.target, relation.anchor) == ("touching", "/a", "/b")
        assert relation.numbers == pytest.approx({"gap": 0.002})

    @pytest.mark.parametrize(
        ("gap", "count"),
        [
            (RULES.touching.max_gap - HAIR, 1),
            (RULES.touching.max_gap + HAIR, 0),
            (-RULES.touching.max_sink + HAIR, 1),
            (-RULES.touching.max_sink - HAIR, 0),
        ],
    )
    def test_thresholds(self, gap: float, count: int):
        assert len(relate(cabinet("a", 0), cabinet("b", 0.6 + gap), kinds=("touching",))) == count

    def test_contact_at_an_edge_is_not_touching(self):
        corner = (thing("/c", (0.6, 0.55, 0), (0.6, 0.6, 0.8)), "KitchenCabinet")
        assert relate(cabinet("a", 0), corner, kinds=("touching",)) == ()

    def test_on_suppresses_touching(self):
        assert relate(FLOOR, TABLE, cup((0.4, 0.4, 0.7)), kinds=("touching",)) == ()

    def test_a_board_touches_an_object_below_that_does_not_support_it(self):
        # The slab rests on one of the two, and only grazes the lower part of the other by its side.
        slab = artifact("slab", (0, 0, 0.8), (0.6, 0.6, 0.04))
        tall = (thing("/tall", (0.6, 0, 0), (0.3, 0.6, 2)), "Wardrobe")
        assert pairs(relate(cabinet("a", 0), slab, tall, kinds=("touching",))) == {
            ("touching", names("a", "tall")),
            ("touching", names("slab", "tall")),
        }


class TestNextTo:
    def test_two_chairs_are_next_to_each_other(self):
        # 0.1 m between chairs 0.5 m wide and deep: half of 0.5 m is allowed, so 0.6 of the margin is left.
        one = (thing("/one", (0, 0, 0), (0.5, 0.5, 0.9)), "DesignedChair")
        other = (thing("/other", (0.6, 0, 0), (0.5, 0.5, 0.9)), "DesignedChair")
        (relation,) = relate(FLOOR, one, other, kinds=("next-to",))
        assert relation.numbers == pytest.approx({"distance": 0.1})
        assert relation.confidence == pytest.approx(0.6**2 * (3 - 2 * 0.6))

    @pytest.mark.parametrize(("extra", "count"), [(-HAIR, 1), (HAIR, 0)])
    def test_smaller_object_determines_the_distance_limit(self, extra: float, count: int):
        # A cup 0.2 m wide beside a wardrobe: half of 0.2 m.
        small = (thing("/small", (1.1 + extra, 0, 0), (0.2, 0.2, 0.5)), "Box")
        wardrobe = (thing("/wardrobe", (0, 0, 0), (1, 1, 2)), "Wardrobe")
        assert RULES.next_to.gap_share * 0.2 == pytest.approx(0.1)
        assert len(relate(small, wardrobe, kinds=("next-to",))) == count

    def test_different_heights_are_not_next_to_each_other(self):
        low = artifact("low", (0, 0, 0), (0.3, 0.3, 0.3))
        high = artifact("high", (0.35, 0, 0.25), (0.3, 0.3, 0.3))
        assert relate(low, high, kinds=("next-to",)) == ()
        assert pairs(relate(low, high, kinds=CLOSE)) == {("near", names("low", "high"))}

    def test_third_object_in_between_blocks_next_to(self):
        row = [artifact(name, (0.2 * i, 0, 0), (0.19, 0.5, 0.5)) for i, name in enumerate("abc")]
        found = pairs(relate(*row, kinds=("next-to",)))
        assert found == {("next-to", names("a", "b")), ("next-to", names("b", "c"))}

    def test_a_third_object_blocks_that_is_near_only_one_of_the_two(self):
        # The bench's nearest neighbours are the cups on its far side; the screen is among those of the stool.
        bench = artifact("bench", (0, 0, 0), (2.4, 0.5, 0.5))
        cups = [cup((0.05 + 0.2 * i, -0.12, 0), (0.1, 0.1, 0.1), f"c{i}") for i in range(RULES.blocking.most + 2)]
        screen, stool = (
            artifact("screen", (0.8, 0.6, 0), (0.8, 0.02, 0.8)),
            artifact("stool", (1, 0.75, 0), (0.6, 0.6, 0.5)),
        )
        found = pairs(relate(bench, *cups, screen, stool, kinds=("next-to",)))
        assert ("next-to", names("screen", "stool")) in found
        assert ("next-to", names("bench", "stool")) not in found

    def test_a_wall_blocks_adjacency(self):
        wall = (thing("/wall", (0.32, -2, 0), (0.06, 4, 2.5)), "Wall")
        here, there = artifact("here", (0, 0, 0), (0.3, 0.3, 0.3)), artifact("there", (0.4, 0, 0), (0.3, 0.3, 0.3))
        assert len(relate(here, there, kinds=CLOSE)) == 1
        assert relate(here, wall, there, kinds=CLOSE) == ()

    def test_walls_in_one_mesh_do_not_block_adjacency(self):
        walls = (thing("/walls", (-3, -3, 0), (6, 6, 2.5)), "Wall")
        here, there = artifact("here", (0, 0, 0), (0.3, 0.3, 0.3)), artifact("there", (0.4, 0, 0), (0.3, 0.3, 0.3))
        assert pairs(relate(walls, here, there, kinds=CLOSE)) == {("next-to", names("here", "there"))}

    def test_contents_are_not_next_to_objects_outside(self):
        cupboard = (thing("/cupboard", (0, 0, 0), (0.6, 0.4, 0.7)), "Cupboard")
        inner = [(thing(f"/in{i}", (0.05 + 0.12 * i, 0.1, 0.1), (0.1, 0.1, 0.12)), "Glass") for i in range(2)]
        outer = (thing("/out", (0.62, 0.1, 0.1), (0.1, 0.1, 0.12)), "Glass")
        found = pairs(relate(cupboard, *inner, outer, kinds=("next-to",)))
        assert found == {("next-to", names("in0", "in1")), ("next-to", names("cupboard", "out"))}

    def test_keeps_pairs_nearest_for_either_object(self):
        # Of a bench's twelve neighbours three are its nearest, but the bench is among the nearest of each.
        bench = artifact("bench", (0, 0, 0), (2.4, 0.3, 0.3))
        row = [cup((0.05 + 0.2 * i, 0.34, 0), (0.1, 0.1, 0.1), f"c{i}") for i in range(12)]
        found = pairs(relate(bench, *row, kinds=("next-to",)))
        assert found == {("next-to", names("bench", f"c{i}")) for i in range(12)}

    def test_dense_rows_have_few_links(self):
        crowd = [cup((0.11 * (i % 20), 0.11 * (i // 20), 0), (0.1, 0.1, 0.1), f"c{i}") for i in range(400)]
        found = relate(*crowd, kinds=("next-to",))
        assert 400 < len(found) <= RULES.next_to.most * 400

    def test_rooms_are_excluded_from_adjacency(self):
        wall = (thing("/wall", (0.52, -2, 0), (0.1, 4, 2.5)), "Wall")
        assert relate(FLOOR, wall, artifact("box", (0, 0, 0), (0.5, 0.5, 0.5)), kinds=CLOSE) == ()


class TestNear:
    def test_chair_is_near_a_desk(self):
        # The chair's mean extent is (0.5 + 0.5 + 0.9) / 3 = 0.6333 m; the desk is 0.4 m away.
        chair = (thing("/chair", (0, 0, 0), (0.5, 0.5, 0.9)), "DesignedChair")
        desk = (thing("/desk", (0.9, 0, 0), (1.6, 0.8, 0.7)), "Table")
        (relation,) = relate(chair, desk, kinds=("near",))
        share = 1 - 0.4 / ((0.5 + 0.5 + 0.9) / 3)
        assert relation.numbers == pytest.approx({"distance": 0.4})
        assert relation.confidence == pytest.approx(share**2 * (3 - 2 * share))

    @pytest.mark.parametrize(("extra", "count"), [(-HAIR, 1), (HAIR, 0)])
    def test_distance_limit_is_the_mean_extent_of_the_smaller_object(self, extra: float, count: int):
        one = artifact("one", (0, 0, 0), (0.3, 0.3, 0.3))
        other = artifact("other", (0.6 + extra, 0, 0), (0.3, 0.3, 0.3))
        assert len(relate(one, other, kinds=("near",))) == count

    def test_near_holds_in_any_direction(self):
        # Apart by 0.03 m, 0.04 m and 0.12 m: 0.13 m.
        one = artifact("one", (0, 0, 0), (0.3, 0.3, 0.3))
        other = artifact("other", (0.33, 0.34, 0.42), (0.3, 0.3, 0.3))
        (relation,) = relate(one, other, kinds=("near",))
        assert relation.numbers == pytest.approx({"distance": 0.13})

    def test_stronger_relations_suppress_near(self):
        one, other = cabinet("a", 0), cabinet("b", 0.6)
        assert {r.kind for r in relate(one, other, kinds=CLOSE)} == {"touching", "next-to"}
        assert {r.kind for r in relate(one, other, kinds=("near",))} == {"near"}
        assert relate(FLOOR, TABLE, cup((0.4, 0.4, 0.7)), kinds=CLOSE) == ()


class TestTurned:
    """A 1 m × 0.2 m board rotated by 45 degrees: its box is 0.8485 m wide and deep."""

    HALF = math.sqrt(0.5)

    def board(self, name: str, x: float, y: float, degrees: float = 45, **known: object) -> Placed:
        angle = math.radians(degrees)
        width = abs(math.cos(angle)) + 0.2 * abs(math.sin(angle))
        depth = abs(math.sin(angle)) + 0.2 * abs(math.cos(angle))
        turned = {
            "oriented_size": (1.0, 0.2, 0.5),
            "orientation": (0.0, 0.0, math.sin(angle / 2), math.cos(angle / 2)),
        }
        lower = (x - width / 2, y - depth / 2, 0)
        return thing(f"/{name}", lower, (width, depth, 0.5), **(turned | known)), "DesignedArtifact"

    def test_distance_uses_the_rotated_footprint(self):
        # Two parallel boards, their middles 0.3 m apart across: 0.1 m between them, though their boxes overlap.
        step = 0.3 * self.HALF
        found = relate(self.board("one", 0, 0), self.board("other", -step, step), kinds=("next-to",))
        assert [r.numbers for r in found] == [pytest.approx({"distance": 0.1})]

    def test_distance_between_rotated_and_aligned_footprints(self):
        # Its end is at 0.5 m along the diagonal, 0.1 m from each side: the corner farthest along x at 0.4243 m.
        post = artifact("post", (0.46, 0.25, 0), (0.1, 0.1, 0.5))
        corner = 0.5 * self.HALF + 0.1 * self.HALF
        (relation,) = relate(self.board("board", 0, 0), post, kinds=("next-to",))
        assert relation.numbers == pytest.approx({"distance": 0.46 - corner})

    def test_distance_falls_back_to_the_box_without_a_known_footprint(self):
        step = 0.3 * self.HALF
        tilted = self.board("one", 0, 0, orientation=(0.2, 0.0, math.sin(math.pi / 8), 0.9))
        assert relate(tilted, self.board("other", -step, step), kinds=("next-to",)) == ()
        box = box_at((-1, -1, 0), (2, 2, 1))
        with_more = self.board("one", 0, 0, box=box)
        assert relate(with_more, self.board("other", -step, step), kinds=("next-to",)) == ()

    @pytest.mark.parametrize("degrees", [0, 10, 30, 45, 60, 90, 123])
    def test_distance_is_invariant_under_common_rotation(self, degrees: float):
        angle = math.radians(degrees)
        x, y = -0.3 * math.sin(angle), 0.3 * math.cos(angle)
        one, other = self.board("one", 0, 0, degrees), self.board("other", x, y, degrees)
        (relation,) = relate(one, other, kinds=("next-to",))
        assert relation.numbers == pytest.approx({"distance": 0.1})
