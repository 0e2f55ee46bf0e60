"""Companions of an object: which, how near, and never with the target's own name."""

import math
import time
from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.grounding.records import make_object, make_scene, neighbours_of, words_written
from usd2kg.grounding.context import Nearness, Neighbour, Neighbourhood, neighbours
from usd2kg.grounding.context.neighbours import neighbourhoods, size_distance
from usd2kg.scene import Box, Scene
from usd2kg.words import words_of

NEXT, SIBLING, TWIN, ALIKE = Nearness.NEXT, Nearness.SIBLING, Nearness.SAME_SIZE, Nearness.SIMILAR_SIZE


def thing(path: str, size=None, **known):
    """Return an object with a box of `size` at the origin, or none."""
    return make_object(path, box=size and Box((0, 0, 0), size), **known)


def things(*objects) -> Scene:
    return make_scene(*(thing(o) if isinstance(o, str) else thing(*o) for o in objects))


def company_of(scene: Scene, path: str) -> Neighbourhood:
    index = [obj.prim_path for obj in scene.objects].index(path)
    return neighbourhoods(scene)[index]


def seen(scene: Scene, path: str) -> dict[str, Nearness]:
    """Return path → nearness of the companions of an object."""
    found = neighbours_of(company_of(scene, path))
    listed = {path_of(companion): companion.nearness for companion in found}
    assert len(listed) == len(found)
    return listed


def path_of(companion: Neighbour) -> str:
    return "/".join(("", *companion.parents, companion.name))


# --- difference in size ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        ((1, 2, 3), (3, 1, 2), 0),  # the same box, turned
        ((1, 1, 1), (1, 1, math.e), math.sqrt(1 / 3)),  # one extent off by a factor of e
        ((0.5, 0.5, 0.5), (0.55, 0.55, 0.55), math.log(1.1)),  # a tenth longer all round: 0.0953
        ((1, 1, 4), (2, 2, 2), math.sqrt(3) * math.log(2) / math.sqrt(3)),  # ln 2 off in each
        ((0.3, 0.2, 0), (0.3, 0.2, 0.002), 0),  # a sheet counts as 2 mm thick
        ((0.3, 0.2, 0.0001), (0.3, 0.2, 0.004), math.log(2) / math.sqrt(3)),
        ((0, 0, 0), (0, 0, 0), 0),
    ],
)
def test_size_distance(one, other, expected):
    assert size_distance(one, other) == pytest.approx(expected, abs=1e-12)


extents = st.floats(0, 100)
boxes = st.tuples(extents, extents, extents)


@settings(max_examples=100, deadline=None)
@given(boxes, boxes, boxes)
def test_size_distance_is_a_distance(one, other, third):
    there = size_distance(one, other)
    assert there >= 0
    assert there == size_distance(other, one)
    assert size_distance(one, one) == 0
    assert there <= size_distance(one, third) + size_distance(third, other) + 1e-9


# --- nearness ----------------------------------------------------------------------------------------


def test_two_siblings_on_each_side_are_next():
    scene = things(*(f"/W/a{i}" for i in range(7)), "/V/b")
    found = seen(scene, "/W/a3")
    assert found == {
        "/W/a0": SIBLING,
        "/W/a1": NEXT,
        "/W/a2": NEXT,
        "/W/a4": NEXT,
        "/W/a5": NEXT,
        "/W/a6": SIBLING,
    }
    assert list(found) == sorted(found)  # in the order of the stage
    assert seen(scene, "/W/a0") == {f"/W/a{i}": NEXT if i < 3 else SIBLING for i in range(1, 7)}


def test_objects_below_other_parents_are_not_between_siblings():
    # In traversal order the cabinet's drawers come between the cabinet and the oven.
    scene = things("/W/cabinet", "/W/cabinet/a", "/W/cabinet/b", "/W/cabinet/c", "/W/oven")
    assert seen(scene, "/W/cabinet") == {"/W/oven": NEXT}
    assert seen(scene, "/W/cabinet/a") == {"/W/cabinet/b": NEXT, "/W/cabinet/c": NEXT}


def test_companions_have_their_parents_and_no_distance_without_sizes():
    scene = things("/World/Kitchen/cup", "/World/Kitchen/plate")
    (plate,) = neighbours_of(company_of(scene, "/World/Kitchen/cup"))
    assert plate == Neighbour("plate", ("World", "Kitchen"), NEXT, None, None)


def test_companions_have_their_oriented_size():
    scene = make_scene(
        make_object("/W/cup", box=Box((0, 0, 0), (0.1, 0.1, 0.1))),
        make_object("/W/oven", box=Box((0, 0, 0), (0.9, 0.6, 0.6)), oriented_size=(0.6, 0.6, 0.6)),
    )
    (oven,) = neighbours_of(company_of(scene, "/W/cup"))
    assert oven.size == (0.6, 0.6, 0.6)


def test_objects_at_the_root_are_siblings():
    assert seen(things("/a", "/b"), "/a") == {"/b": NEXT}
    assert neighbours_of(company_of(things("/a", "/b"), "/a"))[0].parents == ()


def test_objects_elsewhere_are_twins_or_alike_by_size():
    scene = things(
        ("/A/target", (1, 1, 1)),
        ("/B/turned", (1, 1, 1)),
        ("/B/nearly", (1.009, 1.009, 1.009)),  # ln 1.009 = 0.00896, less than 0.01
        ("/B/about", (1.011, 1.011, 1.011)),  # 0.01094
        ("/B/sizeless",),
    )
    assert seen(scene, "/A/target") == {"/B/turned": TWIN, "/B/nearly": TWIN, "/B/about": ALIKE}
    distances = {c.name: c.distance for c in neighbours_of(company_of(scene, "/A/target"))}
    expected = {"turned": 0, "nearly": math.log(1.009), "about": math.log(1.011)}
    assert distances == pytest.approx(expected, abs=1e-12)


def test_a_twin_next_to_the_target_is_listed_once_as_next():
    scene = things(("/A/target", (1, 2, 3)), ("/A/copy", (3, 2, 1)), ("/B/copy", (2, 1, 3)))
    assert seen(scene, "/A/target") == {"/A/copy": NEXT, "/B/copy": TWIN}
    assert [c.distance for c in neighbours_of(company_of(scene, "/A/target"))] == pytest.approx([0, 0])


def test_companions_elsewhere_are_sorted_by_difference_in_size():
    factors = [1.3, 1.05, 2, 1.1, 1]
    scene = things(("/A/target", (1, 1, 1)), *((f"/B/x{i}", (f, f, f)) for i, f in enumerate(factors)))
    assert list(seen(scene, "/A/target")) == ["/B/x4", "/B/x1", "/B/x3", "/B/x0", "/B/x2"]


def test_the_oriented_size_counts_where_it_is_known():
    # A box of 1 × 1 m turned by 45 degrees fills 1.414 × 1.414 m of the world.
    turned = thing("/A/turned", (math.sqrt(2), math.sqrt(2), 1), oriented_size=(1, 1, 1))
    scene = make_scene(turned, thing("/B/straight", (1, 1, 1)), thing("/B/larger", (math.sqrt(2), math.sqrt(2), 1)))
    found = {c.name: (c.nearness, c.distance) for c in neighbours_of(company_of(scene, "/A/turned"))}
    assert found["straight"] == (TWIN, 0)
    # Two extents of three are off by ln √2.
    assert found["larger"] == (ALIKE, pytest.approx(math.log(2) / 2 * math.sqrt(2 / 3)))


def test_without_a_size_only_siblings_are_companions():
    scene = things("/A/target", ("/A/beside", (1, 1, 1)), ("/B/elsewhere", (1, 1, 1)))
    assert seen(scene, "/A/target") == {"/A/beside": NEXT}
    assert neighbours_of(company_of(scene, "/A/target"))[0].distance is None


def test_a_single_object_has_no_companions():
    lonely = company_of(things(("/A", (1, 1, 1))), "/A")
    assert neighbours_of(lonely) == []
    assert words_written(lonely, "a", lambda word: [(word, 0.0)]) == []
    assert neighbourhoods(things()) == []


# --- limits ------------------------------------------------------------------------------------------


def test_only_the_nearest_of_many_siblings_are_neighbours():
    scene = things(*(f"/W/a{i:03d}" for i in range(200)))
    found = seen(scene, "/W/a100")
    assert {f"/W/a{i:03d}" for i in range(77, 124) if i != 100} <= set(found)
    assert len(found) <= 48
    assert [path for path, nearness in found.items() if nearness is NEXT] == [
        f"/W/a{i}" for i in ("098", "099", 101, 102)
    ]
    assert set(seen(scene, "/W/a000")) <= {f"/W/a{i:03d}" for i in range(1, 25)}
    assert set(seen(scene, "/W/a199")) <= {f"/W/a{i}" for i in range(175, 199)}


@pytest.mark.parametrize("position", [0, 50, 99])
def test_at_most_sixteen_objects_of_equal_size_are_neighbours(position):
    scene = things(*((f"/G{i:02d}/x", (1, 1, 1)) for i in range(100)))
    found = seen(scene, f"/G{position:02d}/x")
    assert Counter(found.values())[TWIN] == 16
    assert len(found) <= 40


def test_the_twin_is_found_among_thousands_of_other_sizes():
    others = [(f"/B/x{i}", (1 + i / 100, 0.5, 0.5)) for i in range(3000)]
    found = seen(things(("/A/target", (7, 0.5, 0.5)), *others), "/A/target")
    assert found["/B/x600"] is TWIN


# --- judgements ---------------------------------------------------------------------------------------


def test_each_object_is_judged_once_with_its_parents_and_size():
    scene = things(("/World/Kitchen/cabinet", (0.6, 0.6, 0.9)), "/World/Kitchen/x", "/World/Kitchen/y")
    asked = []

    def judge(name, parents, size):
        asked.append((name, parents, size))
        return name.upper() if name == "cabinet" else None

    of_cabinet, of_x, of_y = (its.votes(judge) for its in neighbourhoods(scene))
    # Without a judgement a companion is left out; the last number is its index in the scene.
    assert (of_cabinet, of_x, of_y) == ([], [("CABINET", NEXT, None, 0)], [("CABINET", NEXT, None, 0)])
    above = ("World", "Kitchen")
    assert sorted(asked) == [("cabinet", above, (0.6, 0.6, 0.9)), ("x", above, None), ("y", above, None)]


# --- words -------------------------------------------------------------------------------------------


def initials(word: str) -> list[tuple[str, float]]:
    """Return two forms of a word: its first letter, and the word in full."""
    return [(word[0], -2.0), (word, -1.0)]


def test_words_have_the_share_of_objects_whose_names_contain_them():
    scene = things("/W/CoffeeCup_1", "/W/CoffeePot", "/W/Lamp", "/W/cup_cup")
    lamp = company_of(scene, "/W/Lamp")
    # Two of four names contain coffee and two cup; a repeated word counts once.
    assert words_written(lamp, "c", initials) == [("coffee", 0.5, -2.0), ("cup", 0.5, -2.0)]
    assert words_written(lamp, "pot", initials) == [("pot", 0.25, -1.0)]
    assert words_written(lamp, "nothing", initials) == []


def test_words_of_the_target_itself_do_not_count():
    scene = things("/W/CoffeeCup_1", "/W/CoffeePot", "/W/Lamp", "/W/cup_cup")
    assert words_written(company_of(scene, "/W/Lamp"), "l", initials) == []
    # Without the target's own name, coffee is left in one name and pot in none.
    assert words_written(company_of(scene, "/W/CoffeePot"), "coffee", initials) == [("coffee", 0.25, -1.0)]
    assert words_written(company_of(scene, "/W/CoffeePot"), "p", initials) == []


def test_numbers_and_production_tokens_are_no_words():
    scene = things("/W/SM_Cup_01_LOD0", "/W/x")
    everything = [words_written(company_of(scene, "/W/x"), form, initials) for form in ("sm", "01", "lod", "l", "cup")]
    assert everything == [[], [], [], [], [("cup", 0.5, -1.0)]]


names = st.sampled_from(["cup", "Cup_1", "CoffeeCup", "plate", "cup_plate", "SM_Oven", "x", "cup1", "Küche", "1"])
sizes = st.none() | st.sampled_from([(1, 1, 1), (1, 1, 1.005), (0.4, 1, 2), (0, 0, 0), (5, 5, 5)])


@st.composite
def scenes(draw) -> Scene:
    """Scenes of leaves, some in nested groups, no path twice."""
    parents = st.sampled_from(["", "/W", "/W/Kitchen", "/W/cup", "/V"])
    listed = draw(st.lists(st.tuples(parents, names, sizes), min_size=1, max_size=14))
    by_path = {f"{parent}/{index}_{name}": size for index, (parent, name, size) in enumerate(listed)}
    return make_scene(*(thing(path, size) for path, size in by_path.items()))


@settings(max_examples=50, deadline=None)
@given(scenes())
def test_the_target_is_never_its_own_companion(scene: Scene):
    for obj, its in zip(scene.objects, neighbourhoods(scene), strict=True):
        found = neighbours_of(its)
        paths = [path_of(companion) for companion in found]
        assert obj.prim_path not in paths
        assert len(set(paths)) == len(paths)
        assert set(paths) <= {other.prim_path for other in scene.objects}
        assert all(companion.distance is None or companion.distance >= 0 for companion in found)


@settings(max_examples=50, deadline=None)
@given(scenes())
def test_words_are_those_of_the_other_objects(scene: Scene):
    every = {word for obj in scene.objects for word in words_of(obj.name)}
    for obj, its in zip(scene.objects, neighbourhoods(scene), strict=True):
        found = {word: share for form in every for word, share, _ in words_written(its, form, initials)}
        others = Counter(word for other in scene.objects if other is not obj for word in set(words_of(other.name)))
        assert found == pytest.approx({word: count / len(scene.objects) for word, count in others.items()})


@settings(max_examples=40, deadline=None)
@given(scenes(), st.data())
def test_renaming_the_target_changes_nothing(scene: Scene, data):
    at = data.draw(st.integers(0, len(scene.objects) - 1))
    old = scene.objects[at]
    path = old.prim_path.rpartition("/")[0] + "/Zebra_77"
    renamed = make_scene(*scene.objects[:at], thing(path, old.box and old.box.size), *scene.objects[at + 1 :])
    before, after = neighbourhoods(scene)[at], neighbourhoods(renamed)[at]
    assert neighbours_of(before) == neighbours_of(after)
    for word in {word for obj in scene.objects for word in words_of(obj.name)} | {"zebra"}:
        assert words_written(before, word, initials) == words_written(after, word, initials)


def test_descendants_of_the_target_are_no_companions():
    # The body has the oven's name among its parents, so it would give the name away.
    scene = things(
        ("/Kitchen/Oven", (0.6, 0.6, 0.9)),
        ("/Kitchen/Oven/Body", (0.58, 0.58, 0.88)),
        ("/Kitchen/Oven/Body/Case", (0.6, 0.6, 0.9)),
        ("/Kitchen/OvenTop", (0.6, 0.6, 0.9)),
        ("/Hall/Body", (0.6, 0.6, 0.9)),
    )
    assert seen(scene, "/Kitchen/Oven") == {"/Kitchen/OvenTop": NEXT, "/Hall/Body": TWIN}
    assert "/Kitchen/Oven" in seen(scene, "/Kitchen/Oven/Body")


# --- time --------------------------------------------------------------------------------------------


def large_scene(count: int) -> Scene:
    return things(*((f"/W/Book_{i}", (0.2 + i * 1e-5, 0.15, 0.03)) for i in range(count)))


def test_the_cost_of_a_target_does_not_depend_on_the_scene(monkeypatch):
    compared: Counter[int] = Counter()
    real = neighbours._distance

    def counted(one, other):
        compared[count] += 1
        return real(one, other)

    monkeypatch.setattr(neighbours, "_distance", counted)
    for count in (400, 4000):
        everyone = neighbourhoods(large_scene(count))
        for its in everyone[count // 2 : count // 2 + 20]:
            assert len(neighbours_of(its)) <= 48 + 40
    # At most one comparison for each neighbour by volume and one for each companion.
    assert compared[400] == compared[4000] <= 20 * (48 + 88)


def test_time_is_not_quadratic_in_the_number_of_siblings():
    scene = large_scene(10_000)
    asked: Counter[str] = Counter()

    def ways(word: str) -> list[tuple[str, float]]:
        asked[word] += 1
        return initials(word)

    start = time.process_time()
    everyone = neighbourhoods(scene)
    found = [words_written(its, "book", ways) for its in everyone]
    companions = [len(neighbours_of(its)) for its in everyone[::50]]
    assert time.process_time() - start < 5
    assert found == [[("book", 9_999 / 10_000, -1.0)]] * 10_000
    # The index of words is built once, not for each target.
    assert asked == {"book": 1}
    assert max(companions) <= 48 + 40
