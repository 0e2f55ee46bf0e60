"""The benchmark scenes: scripts, stages and gold labels agree. The flat is a blind test: nothing here grounds it."""

import csv
import sys
from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import pytest

from scenes.__main__ import main as write_scenes
from scenes.flat.forms import PROFILES, make_parts, merge_parts
from tests.conftest import shared_file
from usd2kg.scene import Scene, SceneObject, read_scene

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Benchmark:
    """A committed scene with its gold labels."""

    name: str
    objects: int
    most_kib: int

    @property
    def folder(self) -> Path:
        return ROOT / "benchmarks" / "scenes" / self.name

    @cached_property
    def scene(self) -> Scene:
        return read_scene(self.folder / f"{self.name}.usda")

    @cached_property
    def gold(self) -> list[dict[str, str]]:
        with (self.folder / "gold.csv").open(encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def find(self, path: str) -> SceneObject:
        return self.scene.by_path[path]


OFFICE = Benchmark("office", 228, 700)
WAREHOUSE = Benchmark("warehouse", 230, 700)
FLAT = Benchmark("flat", 190, 300)
every_scene = pytest.mark.parametrize("benchmark", [OFFICE, WAREHOUSE, FLAT], ids=lambda benchmark: benchmark.name)


@every_scene
def test_scripts_write_the_committed_scene(benchmark: Benchmark, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr(sys, "argv", ["scenes", benchmark.name, "--out", str(tmp_path)])
    write_scenes()
    committed, made = (
        {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
        for folder in (benchmark.folder, tmp_path)
    )
    assert made == committed
    assert sum(map(len, committed.values())) < benchmark.most_kib * 1024


@every_scene
def test_objects_are_those_of_the_gold_labels(benchmark: Benchmark) -> None:
    paths = [row["path"] for row in benchmark.gold]
    assert len(paths) == len(set(paths)) == benchmark.objects
    assert {obj.prim_path for obj in benchmark.scene.objects} == set(paths)
    assert not benchmark.scene.diagnostics


@every_scene
def test_gold_classes_are_in_the_scope(benchmark: Benchmark) -> None:
    lines = shared_file("reference/soma_home_scope.txt").read_text(encoding="utf-8").split()
    scope = {iri.rsplit("#", 1)[1] for iri in lines}
    assert len(scope) == 102
    for row in benchmark.gold:
        names = [row["class"], *filter(None, row["also"].split("|"))]
        assert set(names) <= scope
        assert len(names) == len(set(names))


class TestOffice:
    def test_boxes_are_in_metres_with_z_up(self) -> None:
        floor = OFFICE.find("/OfficeFloor_02/Shell/Floor_Carpet_grey").box
        assert floor is not None
        # 13 m × 9.6 m, upper face at height 0.
        assert floor.lower == pytest.approx((-6.5, -4.8, -0.1), abs=1e-4)
        assert floor.upper == pytest.approx((6.5, 4.8, 0.0), abs=1e-4)

    def test_reference_scales_an_asset_in_centimetres(self) -> None:
        tap = next(obj.box for obj in OFFICE.scene.objects if obj.name == "tap_mixer")
        assert tap is not None
        # On a worktop at 0.90 m, with a height of 0.30 m plus the radius of its tube.
        assert tap.lower[2] == pytest.approx(0.90, abs=0.005)
        assert tap.size[2] == pytest.approx(0.31, abs=0.02)

    def test_only_objects_of_the_print_room_have_no_kind(self) -> None:
        without = {obj.prim_path for obj in OFFICE.scene.objects if not obj.kind}
        assert without == {obj.prim_path for obj in OFFICE.scene.objects if "/print_room/" in obj.prim_path}
        assert len(without) >= 15

    def test_copies_of_an_asset_have_the_same_label(self) -> None:
        labels = {row["path"]: (row["class"], row["also"]) for row in OFFICE.gold}
        by_asset: dict[tuple[str, ...], set[tuple[str, str]]] = {}
        for obj in OFFICE.scene.objects:
            by_asset.setdefault(tuple(obj.asset), set()).add(labels[obj.prim_path])
        assert len(by_asset) >= 70
        assert {asset for asset, rows in by_asset.items() if len(rows) > 1} == set()


class TestWarehouse:
    def test_counts_left_out_prims_by_reason(self) -> None:
        expected = {"camera": 2, "light": 4, "invisible": 1, "inactive": 1}
        assert {reason: WAREHOUSE.scene.left_out[reason] for reason in expected} == expected

    def test_reads_masses_in_kilograms_and_sizes_in_metres(self) -> None:
        assert WAREHOUSE.find("/Warehouse_Full/workshop/hammer_claw").mass_kg == pytest.approx(0.72)
        assert WAREHOUSE.find("/Warehouse_Full/goods_in/Forklift_Main").mass_kg == pytest.approx(3900)
        pallet = WAREHOUSE.find("/Warehouse_Full/PalletStorage/EUR_Pallet_01").box
        assert pallet is not None
        # 120 × 80 × 14.4 cm: skids 2, blocks 8, cross boards 2.2, top boards 2.2.
        assert sorted(pallet.size) == pytest.approx([0.144, 0.8, 1.2])


class TestFlat:
    def test_boxes_are_within_the_flat_in_metres(self) -> None:
        # Interior 7 m × 7 m, outer walls 10 cm and ceiling 12 cm thick.
        for obj in FLAT.scene.objects:
            assert obj.box is not None
            assert min(obj.box.lower) >= -0.1 - 1e-4
            assert max(obj.box.upper[:2]) <= 7.1 + 1e-4
            assert obj.box.upper[2] <= 2.72 + 1e-4
        worktop = FLAT.find("/StudentFlat/Kitchen_grp/Built_grp/worktop_beech").box
        assert worktop is not None
        assert worktop.lower == pytest.approx((0.64, -0.01, 0.86), abs=1e-4)
        assert worktop.upper == pytest.approx((3.0, 0.61, 0.9), abs=1e-4)

    def test_copies_of_an_object_have_the_same_size(self) -> None:
        chairs = [obj.box for obj in FLAT.scene.objects if obj.name.startswith("FoldingChair_")]
        assert len(chairs) == 2
        for box in chairs:
            assert box is not None
            assert box.size == pytest.approx((0.44, 0.46, 0.82), abs=1e-3)

    @pytest.mark.parametrize("form", ["table", "mug", "goblet", "bike", "tray"])
    def test_meshes_are_closed_and_face_outwards(self, form: str) -> None:
        for part in make_parts(form, (0.6, 0.4, 0.5)):
            edges = Counter((a, b) for face in part.faces for a, b in zip(face, face[1:] + face[:1], strict=True))
            assert set(edges.values()) == {1}
            assert {(b, a) for a, b in edges} == set(edges)
            assert _volume(part.points, part.faces) > 0

    def test_merged_parts_have_the_sum_of_the_volumes(self) -> None:
        parts = make_parts("table", (1.0, 1.0, 1.0))
        whole = merge_parts(parts, "geo")
        # Top 1 × 1 × 0.05, four legs 0.05 × 0.08 × 0.95.
        assert _volume(whole.points, whole.faces) == pytest.approx(0.05 + 4 * 0.05 * 0.08 * 0.95)
        assert not whole.is_block
        assert all(part.is_block for part in parts)

    def test_profiles_are_within_the_unit_box(self) -> None:
        assert all(0 <= value <= 1 for rings in PROFILES.values() for ring in rings for value in ring)


def _volume(points: list[tuple[float, float, float]], faces: list[tuple[int, ...]]) -> float:
    """Return the signed volume by the divergence theorem, positive if faces are counter-clockwise from outside."""
    total = 0.0
    for face in faces:
        (ax, ay, az) = points[face[0]]
        for second, third in pairwise(face[1:]):
            (bx, by, bz), (cx, cy, cz) = points[second], points[third]
            total += ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)
    return total / 6
