"""The flat benchmark: scripts, scene and gold labels agree. The flat is a blind test: nothing here grounds it."""

import csv
import subprocess
import sys
from collections import Counter
from itertools import pairwise
from pathlib import Path

import pytest

from examples.test_flat.forms import PROFILES, make_parts, merge
from tests.conftest import shared_file
from usd2kg.scene import Scene, read_scene

ROOT = Path(__file__).parents[2]
FLAT = ROOT / "benchmarks" / "scenes" / "flat"


@pytest.fixture(scope="module")
def flat() -> Scene:
    return read_scene(FLAT / "flat.usda")


@pytest.fixture(scope="module")
def gold() -> list[dict[str, str]]:
    with (FLAT / "gold.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_scripts_write_the_committed_scene(tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-m", "examples.test_flat.make", str(tmp_path)], check=True, cwd=ROOT)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["flat.usda", "gold.csv"]
    assert sorted(path.name for path in FLAT.iterdir()) == ["flat.usda", "gold.csv"]
    for made in tmp_path.iterdir():
        assert made.read_bytes() == (FLAT / made.name).read_bytes()
    assert (FLAT / "flat.usda").stat().st_size < 250 * 1024


def test_objects_are_those_of_the_gold_labels(flat: Scene, gold: list[dict[str, str]]) -> None:
    paths = [row["path"] for row in gold]
    assert len(paths) == len(set(paths)) == 190
    assert paths == sorted(paths)
    assert {obj.prim_path for obj in flat.objects} == set(paths)
    assert not flat.diagnostics


def test_boxes_are_within_the_flat_in_metres(flat: Scene) -> None:
    boxes = {obj.prim_path: obj.box for obj in flat.objects}
    # Interior 7 m × 7 m, outer walls 10 cm and ceiling 12 cm thick.
    for box in boxes.values():
        assert box is not None
        assert min(box.lower) >= -0.1 - 1e-4
        assert max(box.upper[:2]) <= 7.1 + 1e-4
        assert box.upper[2] <= 2.72 + 1e-4
    worktop = boxes["/StudentFlat/Kitchen_grp/Built_grp/worktop_beech"]
    assert worktop is not None
    assert worktop.lower == pytest.approx((0.64, -0.01, 0.86), abs=1e-4)
    assert worktop.upper == pytest.approx((3.0, 0.61, 0.9), abs=1e-4)


def test_copies_of_an_object_have_the_same_size(flat: Scene) -> None:
    chairs = [obj.box for obj in flat.objects if obj.name.startswith("FoldingChair_")]
    assert len(chairs) == 2
    for box in chairs:
        assert box is not None
        assert box.size == pytest.approx((0.44, 0.46, 0.82), abs=1e-3)


def test_gold_classes_are_in_the_scope(gold: list[dict[str, str]]) -> None:
    lines = shared_file("reference/soma_home_scope.txt").read_text(encoding="utf-8").split()
    scope = {iri.rsplit("#", 1)[1] for iri in lines}
    assert len(scope) == 102
    for row in gold:
        also = [name for name in row["also"].split("|") if name]
        assert {row["class"], *also} <= scope
        assert len({row["class"], *also}) == 1 + len(also)


@pytest.mark.parametrize("form", ["table", "mug", "goblet", "bike", "tray"])
def test_meshes_are_closed_and_face_outwards(form: str) -> None:
    for part in make_parts(form, (0.6, 0.4, 0.5)):
        edges = Counter((a, b) for face in part.faces for a, b in zip(face, face[1:] + face[:1], strict=True))
        assert set(edges.values()) == {1}
        assert {(b, a) for a, b in edges} == set(edges)
        assert _volume(part.points, part.faces) > 0


def test_merged_parts_have_the_sum_of_the_volumes() -> None:
    parts = make_parts("table", (1.0, 1.0, 1.0))
    whole = merge(parts, "geo")
    # Top 1 × 1 × 0.05, four legs 0.05 × 0.08 × 0.95.
    assert _volume(whole.points, whole.faces) == pytest.approx(0.05 + 4 * 0.05 * 0.08 * 0.95)
    assert not whole.is_block
    assert all(part.is_block for part in parts)


def test_profiles_are_within_the_unit_box() -> None:
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
