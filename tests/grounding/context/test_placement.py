"""Placement of objects: elevation above the ground around them, and nearest neighbours in space."""

import numpy as np
import pytest

from tests.grounding.records import make_object, make_scene
from usd2kg.grounding import NamingRegime, view_objects
from usd2kg.grounding.context import Appearance, PlacedObject
from usd2kg.grounding.context.placement import BoxGrid, Placement
from usd2kg.scene import Box, Scene


def thing(path: str, lower: tuple[float, float, float], size: tuple[float, float, float], **known):
    upper = tuple(low + extent for low, extent in zip(lower, size, strict=True))
    return make_object(path, box=Box(lower, upper), **known)


FLOOR = thing("/Room/floor", (-3, -3, -0.1), (6, 6, 0.1))
TABLE = thing("/Room/table", (0, 0, 0), (1.6, 0.8, 0.75))
CUP = thing("/Room/cup", (0.2, 0.2, 0.75), (0.1, 0.08, 0.1))
LAMP = thing("/Room/lamp", (0.6, 0.3, 2.2), (0.3, 0.3, 0.3))
ROOM = make_scene(FLOOR, TABLE, CUP, LAMP)


def elevation(scene: Scene, path: str) -> float | None:
    return BoxGrid(scene).elevation([obj.prim_path for obj in scene.objects].index(path))


class Names:
    """A judge that numbers the objects it is asked about."""

    def __init__(self) -> None:
        self.asked: list[PlacedObject] = []

    def __call__(self, neighbour: PlacedObject) -> np.ndarray:
        self.asked.append(neighbour)
        return np.array([len(self.asked), neighbour.appearance.size[0]])


# --- elevation ---------------------------------------------------------------------------------------


def test_elevation_is_measured_from_the_top_of_the_floor():
    assert elevation(ROOM, "/Room/table") == 0
    assert elevation(ROOM, "/Room/cup") == pytest.approx(0.75)
    assert elevation(ROOM, "/Room/lamp") == pytest.approx(2.2)
    assert elevation(ROOM, "/Room/floor") == 0


def test_without_a_floor_the_lowest_object_nearby_is_the_ground():
    room = make_scene(thing("/table", (0, 0, 5), (1, 1, 0.75)), thing("/cup", (0.4, 0.4, 5.75), (0.1, 0.1, 0.1)))
    assert elevation(room, "/cup") == pytest.approx(0.75)
    assert elevation(room, "/table") == 0


def test_each_storey_has_its_own_ground():
    upstairs = thing("/bed", (0, 0, 3.1), (2, 1.4, 0.5))
    shelf = thing("/shelf", (1, 1, 4.4), (1, 0.3, 0.05))
    house = make_scene(FLOOR, TABLE, upstairs, shelf)
    assert elevation(house, "/bed") == 0
    assert elevation(house, "/shelf") == pytest.approx(1.3)


def test_objects_far_away_are_no_ground():
    cellar = thing("/far/pit", (40, 40, -1), (1, 1, 1))
    assert elevation(make_scene(FLOOR, TABLE, CUP, cellar), "/Room/cup") == pytest.approx(0.75)


def test_without_a_box_elevation_and_neighbours_are_unknown():
    scene = make_scene(FLOOR, make_object("/Room/x"))
    assert elevation(scene, "/Room/x") is None
    assert Placement(BoxGrid(scene), 1, is_anonymous=False).around(Names(), 5)[1].tolist() == []


def test_a_library_of_assets_at_the_origin_has_no_layout():
    sizes = [(0.1 + i / 50, 0.1 + i / 60, 0.1 + i / 30) for i in range(20)]
    library = make_scene(*(thing(f"/a{i}", (-x / 2, -y / 2, 0), (x, y, z)) for i, (x, y, z) in enumerate(sizes)))
    plan = BoxGrid(library)
    assert not plan.is_laid_out
    assert plan.elevation(3) is None
    assert plan.nearest(3, 8)[0].tolist() == []
    for (_, view), (*_, height) in zip(view_objects(library), sizes, strict=True):
        assert view.appearance is not None
        assert view.appearance.height is None
        # The extents are known.
        assert view.appearance.size[2] == pytest.approx(height)
    assert BoxGrid(ROOM).is_laid_out
    assert BoxGrid(make_scene()).is_laid_out


# --- neighbours --------------------------------------------------------------------------------------


def test_neighbours_are_sorted_by_the_distance_of_centres():
    others, metres = BoxGrid(ROOM).nearest(2, 2)
    # Cup (0.25, 0.24, 0.8); table (0.8, 0.4, 0.375), floor (0, 0, -0.05), lamp (0.75, 0.45, 2.35).
    assert others.tolist() == [1, 0]
    assert metres.tolist() == pytest.approx([0.71325, 0.91793], abs=1e-5)


def test_descendants_of_the_target_are_no_neighbours():
    drawer = thing("/Room/table/drawer", (0.5, 0.2, 0.5), (0.4, 0.4, 0.1), parent_path="/Room/table")
    scene = make_scene(TABLE, drawer, CUP)
    assert BoxGrid(scene).nearest(0, 5)[0].tolist() == [2]
    assert set(BoxGrid(scene).nearest(1, 5)[0].tolist()) == {0, 2}


def test_each_object_is_judged_once():
    plan, judge = BoxGrid(ROOM), Names()
    rows = [Placement(plan, index, is_anonymous=False).around(judge, 3)[0] for index in range(4)]
    assert len(judge.asked) == 4
    assert [row.shape for row in rows] == [(3, 2)] * 4
    assert sorted({size for row in rows for _, size in row.tolist()}) == pytest.approx([0.1, 0.3, 1.6, 6])


def test_anonymous_neighbours_have_a_look_but_no_name():
    for is_anonymous, names in ((False, {"floor", "table", "lamp"}), (True, {""})):
        judge = Names()
        Placement(BoxGrid(ROOM), 2, is_anonymous=is_anonymous).around(judge, 8)
        assert {neighbour.name for neighbour in judge.asked} == names
        assert {neighbour.parents for neighbour in judge.asked} == {() if is_anonymous else ("Room",)}
        assert Appearance((1.6, 0.8, 0.75), 0.75, 0.0, False) in [neighbour.appearance for neighbour in judge.asked]


def test_the_look_has_oriented_extents_and_nesting():
    turned = thing("/Room/x", (0, 0, 1), (1, 1, 2), oriented_size=(1.2, 0.1, 2), parent_path="/Room")
    judge = Names()
    Placement(BoxGrid(make_scene(TABLE, turned)), 0, is_anonymous=True).around(judge, 8)
    assert judge.asked == [PlacedObject("", (), Appearance((1.2, 0.1, 2), 2, 1.0, True))]


# --- views -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("groups", "look"),
    [
        ({"geometry", "position", "hierarchy"}, Appearance((0.1, 0.08, 0.1), 0.1, 0.75, False)),
        ({"geometry", "hierarchy"}, Appearance((0.1, 0.08, 0.1), 0.1, None, False)),
        ({"position", "hierarchy"}, None),
    ],
)
def test_the_look_has_only_the_evidence_that_is_shown(groups, look):
    *_, (_, view), _ = view_objects(ROOM, groups=frozenset(groups))
    if look is None:
        assert view.appearance is None
    else:
        assert view.appearance is not None
        assert view.appearance.size == pytest.approx(look.size)
        assert view.appearance.height == pytest.approx(look.height)
        assert view.appearance.elevation == pytest.approx(look.elevation)


def test_the_anonymous_regime_hides_names_of_neighbours():
    for regime, is_named in ((NamingRegime.OPAQUE, True), (NamingRegime.OPAQUE_ANONYMOUS, False)):
        *_, (_, view), _ = view_objects(ROOM, regime)
        judge = Names()
        assert view.placement is not None
        view.placement.around(judge, 8)
        assert any(neighbour.name for neighbour in judge.asked) == is_named


def test_the_search_is_local_in_a_large_scene():
    shelf = [thing(f"/S/box_{x}_{y}", (x * 1.5, y * 1.5, 0), (0.3, 0.2, 0.2)) for x in range(60) for y in range(60)]
    plan = BoxGrid(make_scene(*shelf))
    others, metres = plan.nearest(1830, 8)
    assert metres.tolist() == pytest.approx([1.5] * 4 + [1.5 * 2**0.5] * 4)
    assert max(len(cell) for cell in plan._cells.values()) <= 9
    assert 1830 not in others.tolist()


def test_a_dense_crowd_is_searched_in_part():
    crowd = [
        thing(f"/B/part_{x}_{y}", (x * 0.01, y * 0.01, 0), (0.008, 0.008, 0.008)) for x in range(90) for y in range(90)
    ]
    plan = BoxGrid(make_scene(*crowd))
    others, metres = plan.nearest(4000, 48)
    assert len(set(others.tolist())) == 48
    assert metres.tolist() == sorted(metres.tolist())
    # A fifth of the 8,100 are searched, so the nearest found is near the nearest.
    assert 0.01 <= metres[0] < 0.05
