"""Robots and scenes that packages on PyPI ship, read by the converters of URDF and MJCF.

`make test-converters` installs both: airo-models (MIT) and gymnasium-robotics (MIT).
"""

from collections import Counter
from pathlib import Path

import pytest

from tests.convert.test_robots import CONVERTERS
from usd2kg import build
from usd2kg.scene import Scene, read_scene

pytestmark = pytest.mark.skipif(CONVERTERS is None, reason="run by make test-converters")

PACKAGES = next(iter(sorted(CONVERTERS.glob("lib/python3*/site-packages"))), CONVERTERS) if CONVERTERS else Path()
AIRO = PACKAGES / "airo_models"
GYMNASIUM = PACKAGES / "gymnasium_robotics" / "envs"
URDF_FILES = sorted(path.relative_to(AIRO).as_posix() for path in AIRO.rglob("*.urdf"))


def joints_of(scene: Scene) -> Counter[str]:
    return Counter(joint.type for joint in scene.joints)


def limits_of(scene: Scene, name: str) -> tuple[float | None, float | None]:
    (joint,) = (joint for joint in scene.joints if joint.prim_path.endswith(f"/{name}"))
    return joint.lower, joint.upper


class TestURDF:
    def test_all_files_of_the_package_are_found(self):
        assert len(URDF_FILES) == 16

    @pytest.mark.parametrize("name", URDF_FILES)
    def test_every_file_is_read(self, name: str):
        scene = read_scene(AIRO / name)
        assert scene.objects
        assert scene.frame.up_axis == "Z"
        assert scene.frame.metres_per_unit == 1

    def test_an_arm_whose_limits_have_an_undeclared_prefix(self):
        scene = read_scene(AIRO / "arms" / "ur5e" / "ur5e.urdf")
        (arm,) = scene.objects
        assert joints_of(scene) == {"revolute": 6, "fixed": 1}
        assert limits_of(scene, "shoulder_pan_joint") == pytest.approx((-6.283185, 6.283185))
        assert limits_of(scene, "elbow_joint") == pytest.approx((-3.141593, 3.141593))
        assert arm.mass_kg == pytest.approx(20.994, abs=0.001)
        # Its meshes are found, though the converter reads a corrected copy of the file in another folder.
        assert not any("not found" in note.message or "does not exist" in note.message for note in scene.diagnostics)
        assert arm.box is not None
        assert max(arm.box.size) > 0.9

    def test_a_gripper_with_fingers_that_slide(self):
        scene = read_scene(AIRO / "grippers" / "schunk_egk40_magneto" / "schunk_egk40_magneto.urdf")
        assert joints_of(scene) == {"prismatic": 2, "fixed": 6}
        assert limits_of(scene, "right_finger_mount_joint") == pytest.approx((-0.05, 0))

    def test_a_table_becomes_a_graph(self):
        result = build(AIRO / "environment" / "tables" / "table8080.urdf")
        assert result.scene.origin is not None
        assert result.scene.origin.converter == "URDF USD Converter v0.3.4"
        assert result.graph.triples


class TestMJCF:
    def test_a_kitchen_with_an_arm(self):
        result = build(GYMNASIUM / "assets" / "kitchen_franka" / "kitchen_assets" / "kitchen_env_model.xml")
        scene = result.scene
        assert scene.origin is not None
        assert scene.origin.converter == "MuJoCo USD Converter v0.8.0"
        assert joints_of(scene) == {"revolute": 15, "prismatic": 8, "fixed": 19}
        assert limits_of(scene, "slide_cabinet") == pytest.approx((0, 0.44))
        assert limits_of(scene, "left_hinge_cabinet") == pytest.approx((-1.57, 0))
        found = {obj.name: obj for obj in scene.objects}
        assert {"kettle", "microwave", "slidecabinet", "hingecabinet", "countertop"} <= found.keys()
        assert found["kettle"].box is not None
        assert found["kettle"].box.size == pytest.approx((0.31, 0.25, 0.29), abs=0.01)
        classes = {one.prim_path: one.class_iri or "" for one in result.grounding.predictions}
        # The nearest class of the built-in ontology.
        assert classes[found["microwave"].prim_path].endswith("#Oven")

    def test_includes_defaults_and_meshes_of_a_mobile_robot(self):
        scene = read_scene(GYMNASIUM / "assets" / "fetch" / "pick_and_place.xml")
        assert joints_of(scene) == {"revolute": 9, "prismatic": 6, "fixed": 19}
        (table,) = (obj for obj in scene.objects if obj.name == "table0")
        assert table.box is not None
        assert table.box.size == pytest.approx((0.5, 0.7, 0.4))

    def test_a_hand_with_24_joints(self):
        scene = read_scene(GYMNASIUM / "assets" / "hand" / "manipulate_egg.xml")
        assert joints_of(scene)["revolute"] == 24

    @pytest.mark.parametrize("name", ["ant", "half_cheetah", "hopper", "humanoid", "pusher", "reacher", "walker2d"])
    def test_models_of_shapes(self, name: str):
        assert read_scene(GYMNASIUM / "mujoco" / "assets" / f"{name}.xml").objects
