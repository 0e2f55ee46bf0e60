"""The office benchmark: scripts, scene and gold labels agree."""

import csv
import subprocess
import sys
from pathlib import Path

import pytest

from tests.conftest import shared_file
from usd2kg.scene import Scene, read_scene

ROOT = Path(__file__).parents[2]
OFFICE = ROOT / "benchmarks" / "scenes" / "office"


@pytest.fixture(scope="module")
def office() -> Scene:
    return read_scene(OFFICE / "office.usda")


def _gold() -> list[dict[str, str]]:
    with (OFFICE / "gold.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_objects_are_those_of_the_gold_labels(office: Scene) -> None:
    paths = [row["path"] for row in _gold()]
    assert len(paths) == len(set(paths)) >= 150
    assert {obj.prim_path for obj in office.objects} == set(paths)


def test_boxes_are_in_metres_with_z_up(office: Scene) -> None:
    boxes = {obj.prim_path: obj.box for obj in office.objects}
    floor = boxes["/OfficeFloor_02/Shell/Floor_Carpet_grey"]
    assert floor is not None
    # 13 m × 9.6 m, upper face at height 0.
    assert floor.lower == pytest.approx((-6.5, -4.8, -0.1), abs=1e-4)
    assert floor.upper == pytest.approx((6.5, 4.8, 0.0), abs=1e-4)
    desk = boxes["/OfficeFloor_02/OpenPlan/Desk_A1/Desk_160x80"]
    assert desk is not None
    assert desk.upper[2] - desk.lower[2] == pytest.approx(0.74, abs=1e-3)


def test_reference_scales_an_asset_in_centimetres(office: Scene) -> None:
    tap = next(obj for obj in office.objects if obj.name == "tap_mixer")
    assert tap.box is not None
    # On a worktop at 0.90 m, with a height of 0.30 m plus the radius of its tube.
    assert tap.box.lower[2] == pytest.approx(0.90, abs=0.005)
    assert tap.box.upper[2] - tap.box.lower[2] == pytest.approx(0.31, abs=0.02)


def test_only_objects_of_the_print_room_have_no_kind(office: Scene) -> None:
    without = {obj.prim_path for obj in office.objects if not obj.kind}
    assert without == {path for path in (o.prim_path for o in office.objects) if "/print_room/" in path}
    assert len(without) >= 15


def test_gold_classes_are_in_the_scope() -> None:
    lines = shared_file("reference/soma_home_scope.txt").read_text(encoding="utf-8").split()
    scope = {iri.rsplit("#", 1)[1] for iri in lines}
    used = {name for row in _gold() for name in [row["class"], *row["also"].split("|")] if name}
    assert used <= scope
    assert all(row["class"] not in row["also"].split("|") for row in _gold())


def test_copies_of_an_asset_have_the_same_label(office: Scene) -> None:
    labels = {row["path"]: (row["class"], row["also"]) for row in _gold()}
    by_asset: dict[tuple[str, ...], set[tuple[str, str]]] = {}
    for obj in office.objects:
        by_asset.setdefault(tuple(obj.asset), set()).add(labels[obj.prim_path])
    assert len(by_asset) >= 70
    assert {asset for asset, rows in by_asset.items() if len(rows) > 1} == set()


def test_scripts_write_the_committed_scene(tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-m", "examples.demo_office.make", str(tmp_path)], check=True, cwd=ROOT)
    names = {str(path.relative_to(OFFICE)) for path in OFFICE.rglob("*") if path.is_file()}
    made = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*") if path.is_file()}
    assert made == names
    assert all((tmp_path / name).read_bytes() == (OFFICE / name).read_bytes() for name in names)
    assert sum((OFFICE / name).stat().st_size for name in names) < 700 * 1024
