"""usd2kg.open: stages, graph files and stores."""

from pathlib import Path

import pandas
import pytest

import usd2kg
from tests.scene.usda import METRES, box
from usd2kg.errors import GraphError, SceneError
from usd2kg.stores import make_named_graph, open_store
from usd2kg.world import ObjectRow, World

ROOM = METRES + "\n".join((box("table", (0, 0, 0.4), (1.2, 0.8, 0.8)), box("cup", (0.2, 0.1, 0.85), (0.1, 0.1, 0.1))))


@pytest.fixture
def stage(write_stage) -> Path:
    return write_stage(ROOM, "kitchen.usda")


@pytest.fixture
def saved(stage, tmp_path) -> Path:
    usd2kg.open(stage).save(tmp_path / "kitchen.ttl")
    return tmp_path / "kitchen.ttl"


def test_a_stage_is_built(stage):
    world = usd2kg.open(stage)
    assert world.built is not None
    assert (world.scene, world.grounding, world.graph) == (
        world.built.scene,
        world.built.grounding,
        world.built.graph,
    )
    assert [obj.name for obj in world.scene.objects] == ["table", "cup"]
    assert repr(world) == f"World(source='{stage}')"


def test_a_graph_is_loaded_and_answers_as_the_built_one(stage, saved):
    built, loaded = usd2kg.open(stage), usd2kg.open(saved)
    assert (loaded.built, loaded.scene, loaded.grounding, loaded.graph) == (None, None, None, None)
    assert loaded.objects == built.objects
    question = "what is on the table?"
    assert loaded.ask(question) == built.ask(question)
    assert "cup" in loaded.ask(question).sentence
    paths = "SELECT ?p { ?o u2k:primPath ?p } ORDER BY ?p"
    assert loaded.sparql(paths).rows == built.sparql(paths).rows == (("/cup",), ("/table",))


def test_objects_are_rows_with_sizes_in_metres(stage):
    world = usd2kg.open(stage)
    cup, table = world.objects
    assert cup._replace(confidence=None) == ObjectRow(
        "cup", "cup", None, pytest.approx(0.1), pytest.approx(0.1), pytest.approx(0.1), "on table", "/cup"
    )
    assert 0 < cup.confidence <= 1
    assert (table.class_label, table.size_x, table.relations) == ("table", pytest.approx(1.2), "")
    assert world.first_objects(1) == (cup,)


def test_objects_become_a_data_frame(stage):
    frame = pandas.DataFrame(usd2kg.open(stage).objects)
    assert list(frame.columns) == list(ObjectRow._fields)
    assert frame.set_index("name").size_z.round(2).to_dict() == {"cup": 0.1, "table": 0.8}


def test_options_are_those_of_build(stage, home_tbox):
    world = usd2kg.open(stage, ontology=home_tbox, base="https://example.org/k#")
    assert world.built.tbox is home_tbox
    assert world.graph.base == "https://example.org/k#"


def test_questions_about_changes_have_an_older_version(stage, write_stage):
    before = write_stage(METRES + box("table", (0, 0, 0.4), (1.2, 0.8, 0.8)), "before.usda")
    assert "cup" in str(usd2kg.open(stage).ask("what is new?", since=before).answer.rows)


def test_options_are_refused_for_a_graph(saved):
    with pytest.raises(
        GraphError, match=r"kitchen\.ttl: is a graph, which is loaded and not built; leave out ontology"
    ):
        usd2kg.open(saved, ontology="my.owl")


def test_a_saved_graph_is_the_same(saved, tmp_path):
    usd2kg.open(saved).save(tmp_path / "again.ttl")
    assert (tmp_path / "again.ttl").read_bytes() == saved.read_bytes()


@pytest.fixture
def make_store(write_stage, tmp_path):
    def make(*names: str) -> Path:
        for name in names:
            world = usd2kg.open(write_stage(ROOM, f"{name}.usda"), base=f"https://example.org/{name}/")
            open_store(str(tmp_path / "store")).load(make_named_graph(world.graph))
        return tmp_path / "store"

    return make


def test_the_only_scene_of_a_store_is_opened_and_saved(make_store, tmp_path):
    world = usd2kg.open(make_store("kitchen"))
    assert [row.name for row in world.objects] == ["cup", "table"]
    for name in ("saved.ttl", "again.ttl"):
        world.save(tmp_path / name)
    assert (tmp_path / "saved.ttl").read_bytes() == (tmp_path / "again.ttl").read_bytes()
    assert usd2kg.open(tmp_path / "saved.ttl").objects == world.objects


def test_a_scene_of_several_is_named(make_store):
    store = make_store("kitchen", "office")
    with pytest.raises(GraphError, match=r"has 2 scenes; expected scene= with one of them: kitchen, office"):
        usd2kg.open(store)
    assert usd2kg.open(store, scene="office").ask("where is the cup?").answer.rows[0][2] == "/cup"
    with pytest.raises(GraphError, match="no graph 'garage'"):
        usd2kg.open(store, scene="garage")


@pytest.mark.parametrize("name", ["kitchen.usda", "kitchen.ttl"])
def test_a_scene_is_only_chosen_from_a_store(saved, name):
    with pytest.raises(GraphError, match="is no store; leave out scene='kitchen'"):
        usd2kg.open(saved.with_name(name), scene="kitchen")


def test_options_are_refused_for_a_store(make_store):
    with pytest.raises(GraphError, match="loaded and not built; leave out base, profile"):
        usd2kg.open(make_store("kitchen"), base="https://example.org/", profile="soma")


@pytest.mark.parametrize(
    ("name", "error", "message"),
    [
        ("none.usda", SceneError, "none.usda"),
        ("none.ttl", GraphError, "no such file"),
        (
            "kitchen.fbx",
            GraphError,
            r"the ending '\.fbx' names neither a stage nor a graph; expected .*\.usdz.*\.glb.*\.ttl",
        ),
        ("kitchen", GraphError, "the ending '' names neither"),
        ("kitchen.graphml.gz", GraphError, "an export format"),
    ],
)
def test_what_cannot_be_opened_is_explained(tmp_path, name, error, message):
    with pytest.raises(error, match=message):
        usd2kg.open(tmp_path / name)


def test_a_world_is_immutable(saved):
    with pytest.raises(AttributeError):
        World("a", usd2kg.load_graph(saved)).source = "b"
