"""Robots and their chargers, as imported from a simulator; centimetres, y up, front towards +z."""

import numpy as np

from scenes.writer.assets import Asset, asset
from scenes.writer.forms import block, disc, rod, turned
from scenes.writer.mesh import merge
from scenes.writer.shapes import bend, tube


@asset("amr_base_v3", "amr", is_model=True)
def amr(a: Asset) -> None:
    """Flat mobile robot, 90 long."""
    a.documentation = "Differential drive, lift plate, payload 100 kg."
    a.add("chassis", block((60, 22, 90), (0, 4, 0), 4), "plastic_white")
    a.add("lift_plate", block((50, 3, 70), (0, 26, 0), 1), "plastic_black")
    a.add("bumper", block((62, 6, 92), (0, 7, 0), 2), "lambert1")
    a.add("lidar", turned([(4, 0), (4, 5), (3, 6)], (0, 26, 40), 10), "plastic_black")
    a.add("wheels", merge(*(disc((x, 7, 0), 7, 4) for x in (-26.0, 26.0))), "rubber_black")


@asset("dock_02", "mesh", looks="", is_model=True)
def dock(a: Asset) -> None:
    """Charging dock with contact plate."""
    a.add("mesh", block((50, 60, 18), bevel=2), "plastic_grey")
    a.add("mesh_001", merge(*(block((3, 10, 2), (x, 12, 10)) for x in (-5.0, 5.0))), "brass")
    a.add("mesh_002", block((30, 2, 40), (0, 0, 26)), "plastic_black")
    a.add("mesh_003", block((20, 1.4, 0.6), (0, 50, 9)), "hi_vis")


@asset("BatteryCharger_48V", has_kind=False)
def charger(a: Asset) -> None:
    """Wall charger for traction batteries with looped cable."""
    a.add("case", block((40, 56, 24), bevel=1.5), "steel_orange")
    a.add("panel", block((18, 12, 0.6), (0, 36, 12)), "screen")
    a.add("fins", merge(*(block((30, 1, 2), (0, 6.0 + 4 * k, 12)) for k in range(5))), "plastic_black")
    loop = [*bend((10, 2, 10), (12, -30, 12), (20, -8, 12), 5), (20, 20, 13.5)]
    a.add("cable", tube([(x, max(y, -14), z) for x, y, z in loop], 1.3), "rubber_black")


@asset("arm_6dof", "robot", is_model=True)
def robot_arm(a: Asset) -> None:
    """Six-axis arm with gripper on a plinth."""
    a.add("plinth", block((46, 50, 46), bevel=1), "steel_grey")
    a.add("link_0", turned([(15, 0), (15, 14), (12, 22)], (0, 50, 0)), "steel_orange")
    a.add("link_1", merge(disc((0, 84, 0), 11, 24, "x"), rod((0, 84, 0), (0, 140, 14), 8, 10)), "steel_orange")
    a.add("link_2", merge(disc((0, 142, 15), 9, 22, "x"), rod((0, 142, 15), (0, 132, 68), 6, 10)), "steel_orange")
    a.add("link_3", merge(disc((0, 131, 72), 6, 14, "x"), rod((0, 130, 72), (0, 112, 74), 4)), "plastic_black")
    fingers = [block((1.6, 9, 2.4), (x, 94, 74)) for x in (-4.0, 4.0)]
    a.add("gripper", merge(block((11, 8, 7), (0, 103, 74), 0.8), *fingers), "galvanised")


@asset("CableReel_Yellow", is_model=True)
def cable_reel(a: Asset) -> None:
    """Cable drum on a tube frame."""
    a.add("flanges", merge(*(disc((x, 18, 0), 14, 1, "x", 16) for x in (-7.0, 7.0))), "MI_SafetyYellow")
    a.add("cable", disc((0, 18, 0), 10, 13, "x", 16), "rubber_black")
    bow = [(0, 0, 12), (0, 18, 13), (0, 36, 4), (0, 36, -4), (0, 18, -13), (0, 0, -12)]
    frame = [tube([(s * 9 + x, y, z) for x, y, z in bow], 0.9) for s in (-1, 1)]
    a.add("frame", merge(*frame, rod((-9, 36, 0), (9, 36, 0), 1.2)), "galvanised")


@asset("hs_25", looks="", has_kind=False)
def hose(a: Asset) -> None:
    """Coiled hose on the floor."""
    angles = np.linspace(0, 6 * np.pi, 43)
    coil = [(float(24 * np.cos(t)), 1.5 + 0.16 * float(t), float(24 * np.sin(t))) for t in angles]
    a.add("hose", tube([*coil, (30.0, 3.0, 20.0), (46.0, 1.5, 34.0)], 1.3, 5), "plastic_green")
    a.add("coupling", rod((46, 1.6, 34), (51, 1.6, 38), 1.6), "brass")
