"""The Blender script: its inputs without Blender, and the whole script where Blender is installed as a package."""

import importlib
import json
import os
import subprocess
import sys
from collections import Counter
from types import ModuleType, SimpleNamespace

import pytest

from tests.integrations.conftest import INTEGRATIONS, SCENE
from tests.kitchen import kitchen_scene
from usd2kg.demo import demo_scene
from usd2kg.grounding import format_mapping, ground

FOLDER = INTEGRATIONS / "blender"
SCRIPT = FOLDER / "import_graph.py"
PYTHON = os.environ.get("USD2KG_BPY_PYTHON", sys.executable)
"""The interpreter that has bpy."""


@pytest.fixture
def script(monkeypatch):
    monkeypatch.syspath_prepend(str(FOLDER))
    yield importlib.import_module("import_graph")
    del sys.modules["import_graph"]


@pytest.fixture(scope="module")
def kitchen(home_tbox):
    """The grounding of the demo kitchen."""
    return ground(kitchen_scene(), home_tbox)


# Inputs


def test_both_files_of_ground_have_the_same_classes(script, kitchen, home_tbox, tmp_path):
    found = {}
    for ending in ("csv", "json"):
        path = tmp_path / f"kitchen.{ending}"
        path.write_text(format_mapping(kitchen, home_tbox, ending), "utf-8")
        found[ending] = script.read_classes(path)
    grounded = {p.prim_path: p.class_iri for p in kitchen.predictions if p.class_iri is not None}
    for classes in found.values():
        assert {path: entry.iri for path, entry in classes.items()} == grounded
    path = next(iter(grounded))
    from_csv, from_json = found["csv"][path], found["json"][path]
    assert from_csv.label == home_tbox.by_iri[grounded[path]].label
    assert from_json.label == script.local_name(grounded[path])
    assert (from_csv.confidence, from_csv.concept) == (from_json.confidence, from_json.concept)
    assert from_csv.concept


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("x.csv", "path,class\n/A,#B\n", "no column label, confidence; expected a file of usd2kg ground"),
        ("x.json", "{}", "no grounding; expected a file of usd2kg ground"),
    ],
)
def test_other_files_are_refused(script, tmp_path, name, text, message):
    (tmp_path / name).write_text(text, "utf-8")
    with pytest.raises(ValueError, match=message):
        script.read_classes(tmp_path / name)


def test_a_prim_belongs_to_the_nearest_object(script):
    classes = dict.fromkeys(["/W/Table", "/W/Table/Mug"])
    assert script.nearest_object("/W/Table/Mug/Body", classes) == "/W/Table/Mug"
    assert script.nearest_object("/W/Table/Top", classes) == "/W/Table"
    assert script.nearest_object("/W/Tables", classes) is None


# Properties and collections, with a stand-in for bpy


class Collection(SimpleNamespace):
    """Stands in for a collection of Blender."""

    def __init__(self, name):
        super().__init__(name=name, linked=[])
        self.objects = self.children = SimpleNamespace(link=self.linked.append)


def test_properties_and_collections(script, monkeypatch):
    bpy, made = ModuleType("bpy"), []

    def new(name):
        made.append(Collection(name))
        return made[-1]

    bpy.data = SimpleNamespace(collections=SimpleNamespace(new=new))
    bpy.context = SimpleNamespace(scene=SimpleNamespace(collection=Collection("scene")))
    monkeypatch.setitem(sys.modules, "bpy", bpy)
    classes = {
        "/W/Mug": script.PrimClass("http://x#Cup", "cup", 0.9, "mug"),
        "/W/Glass": script.PrimClass("http://x#Cup", "cup", None, ""),
    }
    objects = {path: [{}] for path in ("/W", "/W/Mug", "/W/Mug/Body", "/W/Glass")}
    assert script.attach_classes(objects, classes) == {"cup": 2}
    assert objects["/W/Mug"] == [
        {
            "usd2kg_prim_path": "/W/Mug",
            "usd2kg_class": "cup",
            "usd2kg_iri": "http://x#Cup",
            "usd2kg_confidence": 0.9,
            "usd2kg_concept": "mug",
        }
    ]
    assert objects["/W/Glass"][0].keys() == {"usd2kg_prim_path", "usd2kg_class", "usd2kg_iri"}
    assert objects["/W"] == objects["/W/Mug/Body"] == [{}]
    root, cups = made
    assert (root.name, root.linked, cups.name, len(cups.linked)) == ("usd2kg classes", [cups], "cup", 3)


# Blender


@pytest.fixture(scope="module")
def run_in_blender():
    """A function that runs a program with arguments in an interpreter that has bpy, and returns its output."""
    # The packages of this environment are not Blender's.
    env = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def run(*arguments, check=True):
        return subprocess.run(
            [PYTHON, *map(str, arguments)], check=check, capture_output=True, text=True, env=env, timeout=120
        )

    if run("-c", "import bpy", check=False).returncode:
        pytest.skip(
            f"Blender's package bpy is not installed for {PYTHON}; install bpy 4.5 in an environment of Python 3.11 "
            "and name its interpreter in USD2KG_BPY_PYTHON"
        )
    return run


_DUMP = """
import bpy, json, sys
bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
own = [o for o in bpy.data.objects if "usd2kg_iri" in o]
objects = {o["usd2kg_prim_path"]: [o["usd2kg_iri"], o["usd2kg_confidence"]] for o in own}
root = bpy.data.collections["usd2kg classes"]
json.dump({"objects": objects, "collections": {c.name: len(c.objects) for c in root.children}}, open(sys.argv[2], "w"))
"""


@pytest.mark.slow
@pytest.mark.parametrize("ending", ["csv", "json"])
def test_the_demo_kitchen_in_blender(run_in_blender, kitchen, home_tbox, tmp_path, ending):
    mapping, blend, dump = (tmp_path / name for name in (f"kitchen.{ending}", "kitchen.blend", "dump.json"))
    mapping.write_text(format_mapping(kitchen, home_tbox, ending), "utf-8")
    output = run_in_blender(SCRIPT, "--", demo_scene(), mapping, "-o", blend).stdout
    assert "294 objects of 71 classes; 0 of the mapping are not in Blender" in output
    run_in_blender("-c", _DUMP, blend, dump)
    found = json.loads(dump.read_text("utf-8"))
    expected = {p.prim_path: p.class_iri for p in kitchen.predictions}
    assert {path: iri for path, (iri, _) in found["objects"].items()} == expected
    for prediction in kitchen.predictions:
        assert found["objects"][prediction.prim_path][1] == pytest.approx(prediction.confidence, abs=1e-4)
    collections = found["collections"]
    assert len(collections) == len(Counter(expected.values()))
    # The cups and their parts.
    assert all(number > 0 for number in collections.values())


@pytest.mark.slow
def test_errors_in_blender(run_in_blender, write_stage, tmp_path):
    mapping = tmp_path / "x.csv"
    mapping.write_text("a,b\n", "utf-8")
    done = run_in_blender(SCRIPT, "--", write_stage(SCENE), mapping, check=False)
    assert done.returncode == 2
    assert "import_graph.py: " in done.stderr and "no column path, class, label, confidence" in done.stderr
