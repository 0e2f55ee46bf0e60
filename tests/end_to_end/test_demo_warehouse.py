"""The warehouse benchmark: scripts, scene and gold labels agree."""

import csv
import subprocess
import sys
from pathlib import Path

import pytest

import usd2kg
from tests.conftest import shared_file
from usd2kg.ontology import TBox

ROOT = Path(__file__).parents[2]
WAREHOUSE = ROOT / "benchmarks" / "scenes" / "warehouse"


@pytest.fixture(scope="module")
def scene() -> usd2kg.Scene:
    return usd2kg.read_scene(WAREHOUSE / "warehouse.usda")


@pytest.fixture(scope="module")
def gold() -> list[dict[str, str]]:
    with (WAREHOUSE / "gold.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_scripts_write_the_committed_scene(tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-m", "examples.demo_warehouse.make", str(tmp_path)], check=True, cwd=ROOT)
    names = {str(path.relative_to(WAREHOUSE)) for path in WAREHOUSE.rglob("*") if path.is_file()}
    made = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*") if path.is_file()}
    assert made == names
    assert all((tmp_path / name).read_bytes() == (WAREHOUSE / name).read_bytes() for name in names)


def test_scene_stays_small() -> None:
    assert sum(path.stat().st_size for path in WAREHOUSE.rglob("*") if path.is_file()) < 700 * 1024


def test_every_gold_path_is_an_object(scene: usd2kg.Scene, gold: list[dict[str, str]]) -> None:
    found = {obj.prim_path for obj in scene.objects}
    assert {row["path"] for row in gold} - found == set()


def test_every_object_has_a_gold_row(scene: usd2kg.Scene, gold: list[dict[str, str]]) -> None:
    paths = [row["path"] for row in gold]
    assert len(paths) == len(set(paths)) == 230
    assert {obj.prim_path for obj in scene.objects} - set(paths) == set()


def test_counts_left_out_prims_by_reason(scene: usd2kg.Scene) -> None:
    assert scene.left_out["camera"] == 2
    assert scene.left_out["light"] == 4
    assert scene.left_out["invisible"] == 1
    assert scene.left_out["inactive"] == 1
    assert not scene.diagnostics


def test_reads_masses_in_kilograms_and_sizes_in_metres(scene: usd2kg.Scene) -> None:
    objects = {obj.prim_path: obj for obj in scene.objects}
    assert objects["/Warehouse_Full/workshop/hammer_claw"].mass_kg == pytest.approx(0.72)
    assert objects["/Warehouse_Full/goods_in/Forklift_Main"].mass_kg == pytest.approx(3900)
    pallet = objects["/Warehouse_Full/PalletStorage/EUR_Pallet_01"]
    # 120 x 80 x 14.4 cm: skids 2, blocks 8, cross boards 2.2, top boards 2.2.
    assert sorted(pallet.box.size) == pytest.approx([0.144, 0.8, 1.2])


def test_gold_classes_resolve(gold: list[dict[str, str]], home_tbox: TBox) -> None:
    for row in gold:
        names = [row["class"], *filter(None, row["also"].split("|"))]
        assert len(names) == len(set(names))
        for name in names:
            home_tbox.resolve(name)


def test_gold_classes_are_in_the_scope(gold: list[dict[str, str]]) -> None:
    lines = shared_file("reference/soma_home_scope.txt").read_text(encoding="utf-8").split()
    scope = {iri.rsplit("#", 1)[1] for iri in lines}
    assert len(scope) == 102
    used = {row["class"] for row in gold} | {name for row in gold for name in row["also"].split("|") if name}
    assert used <= scope
