"""Labels on the demo scene and on shared scenes, checked by reading them again and by OpenUSD's validators."""

import hashlib
import os
from pathlib import Path

import pytest
from pxr import Usd

from tests.conftest import shared_file
from tests.labels.conftest import ENCODINGS, SOMA, class_label
from usd2kg.demo import demo_scene
from usd2kg.labels import LabelOptions, write_labels
from usd2kg.scene import read_scene

SCENES = [
    "aws_robomaker/small_house.usdc",
    "dlr_kitchen/tagged_flattened.usda",
    "awkward/legacy_labels/cube_cylinder.usda",
    "awkward/float_metres_per_unit/suzanne.usdc",
    "awkward/point_instancers/PointInstancer_Grid_70k.usda",
]


def open_scene(name: str) -> Path:
    return demo_scene() if name == "demo" else shared_file(f"scenes/{name}")


@pytest.mark.parametrize("name", ["demo", *SCENES])
def test_labelled_scene_has_the_same_objects_and_the_labels(name, tmp_path):
    source, target = open_scene(name), tmp_path / "labels.usda"
    digest = hashlib.sha256(source.read_bytes()).hexdigest()
    scene = read_scene(source)
    labels = {obj.prim_path: class_label(ancestors=("Crockery",)) for obj in scene.objects}
    report = write_labels(source, labels, target, LabelOptions(ENCODINGS, "overwrite", de_instances=True))
    assert hashlib.sha256(source.read_bytes()).hexdigest() == digest
    assert "left out" not in report.counts
    again = read_scene(target)
    assert [(obj.prim_path, obj.box) for obj in again.objects] == [(obj.prim_path, obj.box) for obj in scene.objects]
    for obj in again.objects:
        assert {label.iri for label in obj.labels.own if label.iri and label.strength == "label"} == {f"{SOMA}Cup"}
    assert not [note for note in again.diagnostics if note.code == "label"]


def validation_errors(path) -> set[tuple[str, str]]:
    """Return (name, message) of the errors that OpenUSD's validators find, without the path of the stage."""
    from pxr import UsdValidation  # noqa: PLC0415 - usd-core 25.02 or later

    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    stage = Usd.Stage.Open(str(path))
    return {(error.GetName(), error.GetMessage().replace(str(path), "")) for error in context.Validate(stage)}


@pytest.mark.skipif(Usd.GetVersion() < (0, 25, 2), reason="usd-core has validators since 25.02")
@pytest.mark.parametrize("name", ["demo", "awkward/legacy_labels/cube_cylinder.usda"])
def test_labels_add_no_validation_errors(name, tmp_path):
    source, target = open_scene(name), Path(os.path.realpath(tmp_path)) / "labels.usda"
    labels = {obj.prim_path: class_label() for obj in read_scene(source).objects}
    write_labels(source, labels, target, LabelOptions(ENCODINGS, "overwrite"))
    assert {error for error, _ in validation_errors(target)} <= {error for error, _ in validation_errors(source)}
