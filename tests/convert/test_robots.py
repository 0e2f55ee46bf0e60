"""URDF and MJCF files are converted by programs with an OpenUSD of their own."""

import os
import shutil
import sys
from pathlib import Path

import pytest

from usd2kg import build
from usd2kg.convert import converter_program
from usd2kg.convert.write import convert_file
from usd2kg.errors import SceneError
from usd2kg.scene import read_scene

DRAWERS = """<?xml version="1.0"?>
<robot name="kitchen cabinet">
  <material name="oak"><color rgba="0.6 0.4 0.2 1"/></material>
  <link name="cabinet">
    <inertial><mass value="20"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <visual><geometry><box size="0.6 0.6 0.8"/></geometry><material name="oak"/></visual>
    <collision><geometry><box size="0.6 0.6 0.8"/></geometry></collision>
  </link>
  <link name="top drawer">
    <inertial><mass value="3"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <visual><geometry><box size="0.5 0.5 0.2"/></geometry></visual>
  </link>
  <joint name="slide" type="prismatic">
    <parent link="cabinet"/><child link="top drawer"/><origin xyz="0 0.05 0.3"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.4" effort="10" velocity="1"/>
  </joint>
</robot>
"""
TABLE = """<mujoco model="breakfast">
  <worldbody>
    <geom name="floor" type="plane" size="5 5 0.1"/>
    <body name="table" pos="0 0 0.35"><geom type="box" size="0.6 0.4 0.35" mass="12"/></body>
    <body name="mug" pos="0.2 0.1 0.75"><freejoint/><geom type="cylinder" size="0.04 0.05" mass="0.3"/></body>
  </worldbody>
</mujoco>
"""
ARM = """<mujoco model="arm">
  <include file="shared/defaults.xml"/>
  <asset><mesh name="finger" file="finger.obj"/></asset>
  <worldbody>
    <body name="base">
      <geom type="cylinder" size="0.1 0.05" mass="2"/>
      <body name="upper arm" pos="0 0 0.1">
        <joint name="shoulder" type="ball"/>
        <geom class="visual" type="capsule" fromto="0 0 0 0 0 0.3" size="0.04" mass="1"/>
        <body name="forearm" pos="0 0 0.3">
          <joint name="elbow" class="bending"/>
          <geom class="visual" type="capsule" fromto="0 0 0 0 0 0.3" size="0.03" mass="1"/>
          <body name="finger" pos="0 0 0.3">
            <joint name="grip" type="slide" axis="1 0 0" range="0 0.04"/>
            <geom type="mesh" mesh="finger" mass="0.1"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
DEFAULTS = """<mujocoinclude>
  <compiler angle="radian" meshdir="meshes" autolimits="true"/>
  <default>
    <default class="visual"><geom contype="0" conaffinity="0" group="2" rgba="0.8 0.2 0.2 1"/></default>
    <default class="bending"><joint type="hinge" axis="0 1 0" range="-1.5 1.5"/></default>
  </default>
</mujocoinclude>
"""
TETRAHEDRON = "v 0 0 0\nv 0.05 0 0\nv 0 0.05 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
CONVERTERS = Path(os.environ["USD2KG_CONVERTERS"]) if "USD2KG_CONVERTERS" in os.environ else None
"""Environment of the converters, from make test-converters; tests of a program that is missing there fail."""


def needs(program: str) -> pytest.MarkDecorator:
    reason = f"needs the program {program} on the path: pipx install {program.replace('_', '-')}"
    return pytest.mark.skipif(CONVERTERS is None and shutil.which(program) is None, reason=reason)


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


@needs("urdf_usd_converter")
class TestURDF:
    def test_links_joints_and_masses(self, tmp_path: Path):
        scene = read_scene(write(tmp_path / "cabinet.urdf", DRAWERS))
        assert scene.frame.metres_per_unit == 1
        assert scene.frame.up_axis == "Z"
        (joint,) = [joint for joint in scene.joints if joint.type == "prismatic"]
        assert (joint.lower, joint.upper) == pytest.approx((0, 0.4))
        assert sum(obj.mass_kg or 0 for obj in scene.objects) == pytest.approx(23)
        assert scene.origin is not None
        assert scene.origin.format == "URDF"
        assert "URDF USD Converter v" in scene.origin.converter

    def test_the_stage_is_the_same_each_time(self, tmp_path: Path):
        path = write(tmp_path / "cabinet.urdf", DRAWERS)
        assert read_scene(path).content_hash == read_scene(path).content_hash

    def test_a_missing_mesh_is_a_note(self, tmp_path: Path):
        text = DRAWERS.replace('<box size="0.5 0.5 0.2"/>', '<mesh filename="package://lab/drawer.obj"/>')
        notes = [note.message for note in read_scene(write(tmp_path / "cabinet.urdf", text)).diagnostics]
        assert any("drawer.obj" in note for note in notes)

    def test_packages_beside_the_folders_above_are_found(self, tmp_path: Path):
        (tmp_path / "meshes_of_lab" / "meshes").mkdir(parents=True)
        mesh = tmp_path / "meshes_of_lab" / "meshes" / "drawer.obj"
        write(mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        text = DRAWERS.replace(
            '<box size="0.5 0.5 0.2"/>', '<mesh filename="package://meshes_of_lab/meshes/drawer.obj"/>'
        )
        folder = tmp_path / "robot" / "urdf"
        folder.mkdir(parents=True)
        notes = [note.message for note in read_scene(write(folder / "cabinet.urdf", text)).diagnostics]
        assert not any("drawer.obj" in note for note in notes)

    def test_undeclared_prefixes_are_declared(self, tmp_path: Path):
        folder = tmp_path / "it's & more"
        (folder / "meshes").mkdir(parents=True)
        write(folder / "meshes" / "drawer.obj", TETRAHEDRON)
        text = DRAWERS.replace('effort="10"', 'effort="10" drake:acceleration="2"')
        text = text.replace('<box size="0.5 0.5 0.2"/>', '<mesh filename="meshes/drawer.obj"/>')
        scene = read_scene(write(folder / "cabinet.urdf", text))
        assert sum(obj.mass_kg or 0 for obj in scene.objects) == pytest.approx(23)
        assert not any("drawer.obj" in note.message for note in scene.diagnostics)

    def test_broken_xml_is_one_clear_error(self, tmp_path: Path):
        path = write(tmp_path / "cabinet.urdf", "<robot>")
        with pytest.raises(SceneError, match=r"cannot be converted \(.+\), expected a URDF file"):
            read_scene(path)


@needs("mujoco_usd_converter")
class TestMJCF:
    def test_a_table_with_a_mug_becomes_a_graph(self, tmp_path: Path):
        result = build(write(tmp_path / "breakfast.xml", TABLE))
        found = {obj.name: obj for obj in result.scene.objects}
        assert {"table", "mug"} <= found.keys()
        assert found["mug"].mass_kg == pytest.approx(0.3)
        on = [(relation.target, relation.anchor) for relation in result.graph.relations if relation.kind == "on"]
        assert (found["mug"].prim_path, found["table"].prim_path) in on

    def test_joints_defaults_includes_and_meshes_of_an_arm(self, tmp_path: Path):
        for name in ("shared", "meshes"):
            (tmp_path / name).mkdir()
        write(tmp_path / "shared" / "defaults.xml", DEFAULTS)
        write(tmp_path / "meshes" / "finger.obj", TETRAHEDRON)
        scene = read_scene(write(tmp_path / "arm.xml", ARM))
        joints = {joint.prim_path.rpartition("/")[2]: joint for joint in scene.joints}
        assert joints["shoulder"].type == "spherical"
        assert joints["elbow"].type == "revolute"
        assert (joints["elbow"].lower, joints["elbow"].upper) == pytest.approx((-1.5, 1.5))
        assert joints["grip"].type == "prismatic"
        assert (joints["grip"].lower, joints["grip"].upper) == pytest.approx((0, 0.04))
        assert sum(obj.mass_kg or 0 for obj in scene.objects) == pytest.approx(4.1)
        (finger,) = (obj for obj in scene.objects if obj.name == "finger")
        assert finger.box is not None
        assert finger.box.size == pytest.approx((0.05, 0.05, 0.1))

    def test_a_missing_mesh_is_named(self, tmp_path: Path):
        (tmp_path / "shared").mkdir()
        write(tmp_path / "shared" / "defaults.xml", DEFAULTS)
        with pytest.raises(SceneError, match=r"cannot be converted \(Mesh finger file .*finger\.obj does not exist\)"):
            read_scene(write(tmp_path / "arm.xml", ARM))


PROGRAM = """#!{python}
import os, sys
assert "PYTHONPATH" not in os.environ
print("[Warning] [some.module] link 'a' has no mass")
print("[Warning] [usdex.core.deprecation] use another function")
print("[Warning] [some.module] link 'a' has no mass")
if "{failure}":
    print("[Warning] [some.module.run] Conversion failed: {failure}")
    sys.exit(1)
*options, source, folder = sys.argv[1:]
assert options[0] == "--no-layer-structure" and os.path.isabs(source)
with open(os.path.join(folder, "robot.usda"), "w") as file:
    file.write('''#usda 1.0
(
    customLayerData = {{ string creator = "Converter v1" }}
    doc = "made in /tmp/abc"
    metersPerUnit = 1
    upAxis = "Z"
    defaultPrim = "mug"
)
def Xform "mug"
{{
    def Cube "body"
    {{
    }}
    def Shader "texture"
    {{
        asset inputs:file = @./mug.png@
    }}
}}
''')
"""


def install(monkeypatch: pytest.MonkeyPatch, folder: Path, name: str, failure: str = "") -> None:
    """Put a program on the path that writes a mug, or fails."""
    folder.mkdir()
    program = write(folder / name, PROGRAM.format(python=sys.executable, failure=failure))
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(folder))


@pytest.mark.skipif(os.name != "posix", reason="installs a program with a #! line")
class TestProgram:
    def test_reads_what_the_program_writes(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        install(monkeypatch, tmp_path / "bin", "urdf_usd_converter")
        monkeypatch.setenv("PYTHONPATH", "/somewhere")
        source = write(tmp_path / "robot.urdf", "<robot/>")
        scene = read_scene(source)
        assert [obj.prim_path for obj in scene.objects] == ["/mug"]
        assert scene.origin is not None
        assert (scene.origin.format, scene.origin.converter) == ("URDF", "Converter v1")
        notes = [note.message for note in scene.diagnostics if note.code == "conversion"]
        assert notes == ["link 'a' has no mass", "textures are left out (1)"]
        convert_file(source, tmp_path / "robot.usda")
        text = (tmp_path / "robot.usda").read_text()
        assert "mug.png" not in text
        assert "/tmp/abc" not in text

    def test_a_failure_is_one_clear_error(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        install(monkeypatch, tmp_path / "bin", "mujoco_usd_converter", "line 3: no such element")
        with pytest.raises(SceneError, match=r"\(line 3: no such element\), expected an MJCF file") as caught:
            read_scene(write(tmp_path / "robot.xml", "<mujoco/>"))
        assert len(str(caught.value).splitlines()) == 1

    def test_a_program_that_does_not_end_is_stopped(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        install(monkeypatch, tmp_path / "bin", "urdf_usd_converter")
        (tmp_path / "bin" / "urdf_usd_converter").write_text(f"#!{sys.executable}\nimport time\ntime.sleep(60)\n")
        monkeypatch.setattr(converter_program, "_MAX_SECONDS", 0.2)
        with pytest.raises(SceneError, match=r"urdf_usd_converter did not end in 0\.2 s and was stopped"):
            read_scene(write(tmp_path / "robot.urdf", "<robot/>"))

    @pytest.mark.parametrize(("name", "package"), [("a.urdf", "urdf-usd-converter"), ("a.xml", "mujoco-usd-converter")])
    def test_a_missing_program_names_its_package(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, package: str
    ):
        monkeypatch.setenv("PATH", str(tmp_path))
        with pytest.raises(SceneError, match=f"not on the path; run: pipx install {package}"):
            read_scene(write(tmp_path / name, "<mujoco/>"))
