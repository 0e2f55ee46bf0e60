"""OBJ files are converted at reading: a prim for each object or group, materials from the library."""

from pathlib import Path

import pytest

from usd2kg.scene import ReadOptions, read_scene

pytest.importorskip("trimesh", reason="needs the extra convert")

FACES = """
f {0} {1} {2}
"""


def tetrahedron(first: int, x: float) -> str:
    """Return vertices and faces of a tetrahedron with edges of 1 along the axes, from vertex number `first` on."""
    corners = [(x, 0, 0), (x + 1, 0, 0), (x, 1, 0), (x, 0, 1)]
    a, b, c, d = range(first, first + 4)
    faces = [(a, c, b), (a, b, d), (a, d, c), (b, c, d)]
    lines = ["v {} {} {}".format(*corner) for corner in corners]
    return "\n".join(lines + ["f {} {} {}".format(*face) for face in faces]) + "\n"


def test_objects_are_prims_with_the_materials_of_the_library(tmp_path: Path):
    (tmp_path / "room.mtl").write_text("newmtl oak\nKd 0.6 0.4 0.2\nnewmtl red paint\nKd 1 0 0\n")
    text = (
        f"mtllib room.mtl\no Kitchen Table\nusemtl oak\n{tetrahedron(1, 0)}o Cup\nusemtl red paint\n{tetrahedron(5, 3)}"
    )
    path = tmp_path / "room.obj"
    path.write_text(text)
    scene = read_scene(path)
    found = {obj.prim_path: obj for obj in scene.objects}
    assert sorted(found) == ["/room/Cup", "/room/Kitchen_Table"]
    assert found["/room/Kitchen_Table"].display_name == "Kitchen Table"
    assert found["/room/Kitchen_Table"].materials == ("oak",)
    assert found["/room/Cup"].display_color == pytest.approx((1, 0, 0))
    box = found["/room/Cup"].box
    assert box is not None
    assert (box.lower, box.upper) == (pytest.approx((3, -1, 0)), pytest.approx((4, 0, 1)))
    assert [note.code for note in scene.diagnostics] == ["conversion"]
    assert "metres and y-up are assumed" in scene.diagnostics[0].message


def test_units_of_an_obj_file_can_be_given(tmp_path: Path):
    path = tmp_path / "cup.obj"
    path.write_text(tetrahedron(1, 0))
    (cup,) = read_scene(path, options=ReadOptions(metres_per_unit=0.01, up_axis="Z")).objects
    assert cup.name == "cup"
    assert cup.box is not None
    assert cup.box.size == pytest.approx((0.01, 0.01, 0.01))


def test_groups_are_prims_if_there_are_no_objects(tmp_path: Path):
    path = tmp_path / "room.obj"
    path.write_text(f"g Sofa\n{tetrahedron(1, 0)}g Lamp\n{tetrahedron(5, 3)}")
    assert sorted(obj.prim_path for obj in read_scene(path).objects) == ["/room/Lamp", "/room/Sofa"]
