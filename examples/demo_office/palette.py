"""Materials of the office: those of the kitchen and a few of its own."""

from __future__ import annotations

from examples.demo_kitchen.palette import PALETTE as KITCHEN
from examples.demo_kitchen.palette import Surface

PALETTE: dict[str, Surface] = {
    **KITCHEN,
    "carpet_grey": Surface((0.20, 0.22, 0.25), 1.0),
    "rug_teal": Surface((0.08, 0.26, 0.28), 1.0),
    "mesh_fabric": Surface((0.05, 0.055, 0.06), 0.9),
    "fabric_petrol": Surface((0.05, 0.20, 0.26), 0.95),
    "fabric_grey": Surface((0.34, 0.35, 0.36), 0.95),
    "laminate_white": Surface((0.78, 0.78, 0.76), 0.35),
    "laminate_maple": Surface((0.66, 0.50, 0.32), 0.4),
    "steel_light": Surface((0.62, 0.64, 0.66), 0.4, 0.4),
    "steel_dark": Surface((0.12, 0.13, 0.14), 0.45, 0.4),
    "screen_blue": Surface((0.04, 0.16, 0.34), 0.1),
    "sign_green": Surface((0.02, 0.36, 0.16), 0.4),
    "led_panel": Surface((0.95, 0.96, 0.92), 0.5),
    "bin_blue": Surface((0.05, 0.20, 0.48), 0.5),
    "board_white": Surface((0.90, 0.90, 0.90), 0.15),
    "note_yellow": Surface((0.92, 0.84, 0.26), 0.9),
}
