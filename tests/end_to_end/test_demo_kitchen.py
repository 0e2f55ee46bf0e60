"""The demo kitchen from stage to answers, against its gold labels and true relations."""

import csv
import os
import subprocess
import sys
from pathlib import Path

import pytest

import usd2kg
from scenes.__main__ import main as write_scenes
from usd2kg.demo import demo_gold, demo_relations, demo_scene
from usd2kg.ontology import TBox
from usd2kg.pipeline import BuildResult

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def built() -> BuildResult:
    return usd2kg.build(demo_scene())


@pytest.fixture(scope="module")
def store(built: BuildResult, tmp_path_factory: pytest.TempPathFactory):
    path = tmp_path_factory.mktemp("demo") / "kitchen.ttl"
    usd2kg.write_graph(built.graph, path)
    return usd2kg.load_graph(path)


def _rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_objects_are_those_of_the_gold_labels(built: BuildResult) -> None:
    gold = {row["path"] for row in _rows(demo_gold())}
    found = {obj.prim_path for obj in built.scene.objects}
    assert found == gold
    assert len(gold) >= 120
    assert built.scene.left_out["camera"] == 2
    assert built.scene.left_out["light"] == 3
    assert built.scene.left_out["invisible"] == 1
    assert built.scene.left_out["inactive"] == 1


def test_classes_agree_with_the_gold_labels(built: BuildResult, home_tbox: TBox) -> None:
    # Limits well below the measured 0.96 and 1.00; benchmarks/accuracy holds the exact figures.
    strict = accepted = 0
    gold = _rows(demo_gold())
    for row in gold:
        right = home_tbox.resolve(row["class"])
        also = {home_tbox.resolve(name) for name in row["also"].split("|") if name}
        answer = built.grounding.by_path[row["path"]].class_iri
        strict += answer == right
        accepted += answer == right or answer in also
    assert strict / len(gold) >= 0.75
    assert accepted / len(gold) >= 0.90


def test_relations_agree_with_the_layout(built: BuildResult) -> None:
    true = {(row["subject"], row["relation"], row["object"]) for row in _rows(demo_relations())}
    kinds = {kind for _, kind, _ in true}
    found = {(r.target, r.kind, r.anchor) for r in built.graph.relations if r.kind in kinds}
    right = len(found & true)
    # Measured: precision and recall 1.00 on 245 relations.
    assert right / len(found) >= 0.96
    assert right / len(true) >= 0.96


def test_finds_objects_on_the_dining_table(store) -> None:
    labels = {row[0] for row in store.ask(["what", "is", "on", "the", "dining", "table?"]).rows}
    assert {"dinnerPlate_1", "wineGlass_01", "saladBowl", "breadBasket", "knife_3"} <= labels
    assert "diningTable" not in labels
    assert not labels & {"roll_1", "pastaBowl_1"}, "they are in the basket and on a plate"


def test_finds_objects_in_the_refrigerator(store) -> None:
    labels = {row[0] for row in store.ask(["in", "refrigerator"]).rows}
    assert {"milkCarton_1", "butterDish", "eggCarton"} <= labels
    assert "toaster" not in labels


def test_all_of_a_class_includes_subclasses(store) -> None:
    classes = {row[1] for row in store.ask(["all", "of", "crockery"]).rows}
    assert {"dinner plate", "cup", "wine glass", "pan"} <= classes
    assert "refrigerator" not in classes


def test_locates_an_object(store) -> None:
    answer = store.ask(["where", "is", "toaster"])
    row = dict(zip(answer.columns, answer.rows[0], strict=True))
    assert row["on"] == "Worktop"
    height = float((row["center_m"] or "").split()[2])
    # On a worktop at 0.90 m, with a height of 0.21 m.
    assert height == pytest.approx(1.0, abs=0.05)


def test_output_is_deterministic(built: BuildResult, tmp_path: Path) -> None:
    here, there = tmp_path / "here.ttl", tmp_path / "there.ttl"
    usd2kg.write_graph(built.graph, here)
    # Another hash seed than in this process, and no cache.
    code = (
        "import sys, usd2kg; from pathlib import Path; from usd2kg.demo import demo_scene;"
        "usd2kg.write_graph(usd2kg.build(demo_scene()).graph, Path(sys.argv[1]))"
    )
    seed = "2" if os.environ.get("PYTHONHASHSEED") == "1" else "1"
    environment = {"PYTHONHASHSEED": seed, "USD2KG_TABLE_CACHE": "off"}
    subprocess.run([sys.executable, "-c", code, str(there)], check=True, env=environment)
    assert here.read_bytes() == there.read_bytes()


def test_scripts_write_the_packaged_scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["scenes", "kitchen", "--out", str(tmp_path)])
    write_scenes()
    shipped = demo_scene().parent
    names = {str(path.relative_to(shipped)) for path in shipped.rglob("*") if path.is_file()}
    made = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*") if path.is_file()}
    assert made == names
    assert all((tmp_path / name).read_bytes() == (shipped / name).read_bytes() for name in names)
