"""Awkward third-party files are read, or refused in one line; nothing is printed to the terminal."""

import pytest

from tests.conftest import SHARED, shared_file
from usd2kg.errors import SceneError
from usd2kg.scene import read_scene

FOLDER = SHARED / "scenes" / "awkward"
FILES = sorted(str(path.relative_to(FOLDER)) for path in FOLDER.rglob("*.usd*")) if FOLDER.is_dir() else []


@pytest.mark.parametrize("name", FILES)
def test_awkward_file_is_read_or_refused_in_one_line(name, capfd):
    path = FOLDER / name
    try:
        scene = read_scene(path)
    except SceneError as error:
        assert str(error).startswith(f"{path}: ")
        assert "\n" not in str(error)
    else:
        assert scene.prim_count == len(scene.objects) + sum(scene.left_out.values())
        for note in scene.diagnostics:
            assert note.message
            assert "\n" not in note.message
    assert capfd.readouterr() == ("", "")


def test_every_category_of_awkward_files_is_present():
    shared_file("scenes/awkward")
    assert len(FILES) > 100


def read(name):
    return read_scene(shared_file(f"scenes/awkward/{name}"))


def test_corrupt_crate_is_refused():
    with pytest.raises(SceneError, match="OpenUSD cannot read this layer"):
        read("must_fail/corrupt.usd")


def test_float_metres_per_unit_is_read_as_typed():
    assert read("float_metres_per_unit/suzanne.usdc").frame.is_authored


def test_a_point_instancer_with_70_000_copies_is_one_object():
    (grid,) = read("point_instancers/PointInstancer_Grid_70k.usda").objects
    # Every 1.5 units from 0 to 208.5 and from 0 to 748.5: 140 by 500. One prototype a colour of the rainbow.
    assert (grid.instances.count, len(grid.instances.prototypes)) == (70_000, 7)


@pytest.mark.parametrize("kind", ["references/reference", "payload/payload"])
def test_invalid_arcs_keep_the_object(kind):
    scene = read(f"composition/stage_composition/{kind}_invalid.usda")
    broken = {note.prim_path for note in scene.diagnostics if note.code == "composition"}
    assert broken
    assert broken <= set(scene.by_path)


@pytest.mark.parametrize("where", ["same", "child", "parent"])
def test_valid_arcs_have_no_diagnostics(where):
    assert read(f"composition/stage_composition/references/reference_{where}_folder.usda").diagnostics == ()
