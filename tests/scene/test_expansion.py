"""Small stages that stand for very many prims, or for very many objects in one place."""

from time import process_time

import pytest

from tests.scene.usda import METRES, component, xform
from usd2kg.errors import SceneError
from usd2kg.grounding import ground, make_grounder
from usd2kg.relations import find_relations
from usd2kg.scene import read_scene


def nested_instances(levels: int, leaf: str = ' def Cube "c{}"\n {{\n }}\n') -> str:
    """Return a stage with ten instances in each of `levels` prototypes."""
    instance = ' def Xform "i{}" (\n  instanceable = true\n  prepend references = </P{}>\n )\n {{\n }}\n'
    text = "#usda 1.0\n" + METRES + xform("World", instance.format("top", levels - 1))
    for level in range(levels):
        inside = "".join(instance.format(i, level - 1) if level else leaf.format(i) for i in range(10))
        text += f'class Xform "P{level}"\n{{\n{inside}}}\n'
    return text


def write(tmp_path, text):
    path = tmp_path / "stage.usda"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_billion_nested_instances_are_refused_at_once(tmp_path):
    path = write(tmp_path, nested_instances(9))
    assert path.stat().st_size < 8_000
    start = process_time()
    with pytest.raises(SceneError) as caught:
        read_scene(path)
    assert process_time() - start < 2
    assert str(caught.value) == (
        f"{path}: its instances stand for 1,111,111,112 prims, expected at most 5,000,000; instances such as "
        "/World/itop hold 1,111,111,110 each; deactivate or flatten nested instances"
    )


def test_some_nested_instances_are_read(tmp_path):
    scene = read_scene(write(tmp_path, nested_instances(2)))
    assert scene.prim_count == 1 + 1 + 110 + 2


def coincident(count):
    cubes = (component(f"thing_{index}", ' def Cube "g"\n {\n }\n') for index in range(count))
    return "#usda 1.0\n" + METRES + xform("World", *cubes)


def relations_of(scene, tbox):
    return find_relations(scene, tbox, ground(scene, tbox, make_grounder("lexical")))


def test_objects_in_one_place_beyond_a_limit_have_no_relations(tmp_path, home_tbox):
    scene = read_scene(write(tmp_path, coincident(1_000)))
    assert len(scene.objects) == 1_000
    notes = [note for note in scene.diagnostics if note.code == "coincident"]
    assert [(note.prim_path, note.message) for note in notes] == [
        (
            "/World/thing_50",
            "950 objects have the box of more than 50 others; they have no spatial relations; move the copies apart, "
            "or deactivate them",
        )
    ]
    found = relations_of(scene, home_tbox)
    assert 0 < len(found) < 50 * 49
    assert {int(path.rpartition("_")[2]) for link in found for path in (link.target, link.anchor)} <= set(range(50))


def test_few_objects_in_one_place_keep_their_relations(tmp_path, home_tbox):
    scene = read_scene(write(tmp_path, coincident(3)))
    assert not [note for note in scene.diagnostics if note.code == "coincident"]
    assert relations_of(scene, home_tbox)
