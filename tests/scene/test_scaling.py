"""Time and memory of reading are linear in the size of the stage, measured by calls, bytes or the clock."""

import cProfile
import gc
import time
import tracemalloc

import pytest
from pxr import Sdf, Usd

from tests.scene.usda import METRES, component, cube, prim, rigid, xform
from usd2kg.scene import read_scene
from usd2kg.scene.outline import PrimRecord


def opened(*prims):
    layer = Sdf.Layer.CreateAnonymous(".usda")
    assert layer.ImportFromString("#usda 1.0\n" + METRES + "".join(prims))
    return Usd.Stage.Open(layer)


def calls_to_read(stage):
    """Return the scene and how many Python and C functions reading it called."""
    profile = cProfile.Profile()
    with profile:
        scene = read_scene(stage)
    return scene, sum(entry.callcount for entry in profile.getstats())


def growth(build, small, large):
    """Return how many times the calls are for a stage of `large` instead of `small`; 1.0 is in proportion."""
    (one, few), (other, many) = calls_to_read(build(small)), calls_to_read(build(large))
    assert len(other.objects) == len(one.objects) * large // small
    return many / few * small / large


# Calls at twice or four times the size are in proportion; what grows with the square would be 2 or 4 here.
IN_PROPORTION = pytest.approx(1, abs=0.1)


def siblings(count):
    return opened(xform("World", *(cube(f"box_{index}") for index in range(count))))


def test_calls_for_siblings_are_in_proportion():
    assert growth(siblings, 500, 2_000) == IN_PROPORTION


def nested(count, make=component):
    """Return a stage of nested objects with one mesh each."""
    tree = ""
    for index in reversed(range(count)):
        tree = make(f"thing_{index}", cube("mesh"), tree)
    return opened(xform("World", tree))


@pytest.mark.parametrize("make", [component, rigid])
def test_calls_for_objects_in_objects_are_in_proportion(make):
    assert growth(lambda count: nested(count, make), 75, 300) == IN_PROPORTION
    scene = read_scene(nested(300, make))
    assert len(list(scene.ancestors(scene.objects[-1]))) == 299
    assert {obj.parts for obj in scene.objects} == {("mesh",)}


def chain(depth):
    """Return a stage whose two objects lie below a long chain of frames."""
    tree = component("Chair", cube("seat")) + component("Table", cube("top"))
    for index in range(depth):
        tree = xform(f"frame_{index}", tree)
    return opened(tree)


def test_calls_for_a_deep_chain_are_in_proportion():
    (one, few), (other, many) = calls_to_read(chain(200)), calls_to_read(chain(800))
    assert len(one.objects) == len(other.objects) == 2
    assert many / few / 4 == pytest.approx(1, abs=0.2)


def labelled(count):
    label, apis = 'token[] semantics:labels:class = ["{}"]', ["SemanticsLabelsAPI:class"]
    things = [component(f"thing_{index}", cube("mesh")) for index in range(count)]
    inner = xform("Group", label.format("furniture"), *things, apis=apis)
    return opened(xform("World", label.format("room"), inner, apis=apis))


def test_calls_for_objects_that_inherit_labels_are_in_proportion():
    assert growth(labelled, 125, 500) == IN_PROPORTION
    actual = {tuple(label.value for label in obj.labels.inherited) for obj in read_scene(labelled(500)).objects}
    assert actual == {("furniture", "room")}


def instances(count):
    chair = prim("Xform", "Chair", *(cube(f"mesh_{index}") for index in range(8)), specifier="class")
    meta = ["references = </Chair>", "instanceable = true"]
    return opened(chair, xform("World", *(prim("Xform", f"Chair_{index}", meta=meta) for index in range(count))))


def test_calls_for_instances_are_in_proportion():
    assert growth(instances, 100, 400) == IN_PROPORTION


def robots(count):
    arms = []
    for number in range(count):
        bodies = [rigid(f"link{index}", cube("mesh")) for index in range(6)]
        where = f"/World/Arm_{number}/link"
        sides = [f"rel physics:body0 = <{where}{i}>\nrel physics:body1 = <{where}{i + 1}>" for i in range(5)]
        joints = [prim("PhysicsRevoluteJoint", f"joint{index}", lines) for index, lines in enumerate(sides)]
        arms.append(xform(f"Arm_{number}", *bodies, *joints))
    return opened(xform("World", *arms))


def test_calls_for_robots_are_in_proportion():
    assert growth(robots, 20, 80) == IN_PROPORTION


# --- memory ------------------------------------------------------------------------------------------


def bytes_held(stage):
    """Return the scene of a stage, and what stays in memory of reading it."""
    gc.collect()
    tracemalloc.start()
    try:
        scene = read_scene(stage)
        gc.collect()
        return scene, tracemalloc.get_traced_memory()[0]
    finally:
        tracemalloc.stop()


def furniture(meshes, count=40):
    things = [component(f"thing_{i}", *(cube(f"part_{j}", at=(j, i, 0)) for j in range(meshes))) for i in range(count)]
    return opened(xform("World", *things))


def test_a_scene_holds_objects_and_not_prims():
    read_scene(furniture(2, count=2))  # exclude what is loaded once
    (few, small), (many, large) = bytes_held(furniture(2)), bytes_held(furniture(40))
    assert (few.prim_count, many.prim_count) == (121, 1_641)
    # A part has a name, a place in two tuples, and a box: two tuples of three floats and the record. That is
    # 56 + 2 * 8 + 2 * 64 + 6 * 24 + 48 = 392 bytes; its prim or outline node would be another 300. The surface of a
    # cube has 8 points and 12 triangles of 12 bytes each.
    of_parts = 40 * 38 * (392 + 20 * 12)
    assert 0.5 * of_parts < large - small < 1.25 * of_parts
    assert small < 40 * 5_000


def test_no_outline_is_held_after_reading():
    gc.collect()
    gc.disable()
    try:
        # Without garbage collection, reference cycles would survive.
        scene = read_scene(furniture(20))
        assert not [thing for thing in gc.get_objects() if isinstance(thing, PrimRecord)]
    finally:
        gc.enable()
    assert len(scene.objects) == 40


# --- by the clock ------------------------------------------------------------------------------------


def seconds_to_read(stage):
    start = time.process_time()
    read_scene(stage)
    return time.process_time() - start


@pytest.mark.slow
def test_fifty_thousand_siblings_are_read_in_a_minute():
    assert seconds_to_read(siblings(50_000)) < 60


@pytest.mark.slow
def test_time_for_prims_that_are_left_out_is_in_proportion():
    def looks(count):
        return opened(cube("box"), prim("Scope", "Looks", *(prim("Material", f"m{index}") for index in range(count))))

    ratio = seconds_to_read(looks(32_000)) / seconds_to_read(looks(8_000))
    assert ratio < 7  # four times as many; the square would be 16
