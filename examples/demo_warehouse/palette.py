"""Materials of the demo warehouse, named as several studios would."""

from __future__ import annotations

from examples.demo_kitchen.palette import Surface

PALETTE: dict[str, Surface] = {
    "concrete_floor": Surface((0.42, 0.42, 0.40), 0.8),
    "floor_marking_yellow": Surface((0.85, 0.62, 0.04), 0.7),
    "M_WallPanel": Surface((0.66, 0.68, 0.68), 0.8),
    "M_RoofSheet": Surface((0.58, 0.60, 0.62), 0.7),
    "steel_blue": Surface((0.06, 0.16, 0.42), 0.5, 0.4),
    "steel_orange": Surface((0.80, 0.26, 0.03), 0.5, 0.4),
    "steel_grey": Surface((0.30, 0.31, 0.33), 0.5, 0.5),
    "galvanised": Surface((0.55, 0.57, 0.58), 0.45, 0.9),
    "chrome": Surface((0.72, 0.73, 0.75), 0.12, 1.0),
    "cast_iron": Surface((0.07, 0.07, 0.075), 0.6, 0.6),
    "brass": Surface((0.70, 0.48, 0.18), 0.3, 1.0),
    "lacquer_red": Surface((0.58, 0.03, 0.03), 0.3),
    "lacquer_green": Surface((0.04, 0.30, 0.12), 0.4),
    "lacquer_white": Surface((0.82, 0.82, 0.80), 0.4),
    "lacquer_cream": Surface((0.74, 0.70, 0.58), 0.4),
    "MI_SafetyYellow": Surface((0.88, 0.62, 0.02), 0.4),
    "MI_CardBox": Surface((0.50, 0.34, 0.18), 0.9),
    "MI_PackTape": Surface((0.64, 0.50, 0.30), 0.4),
    "wood_pallet": Surface((0.56, 0.40, 0.22), 0.9),
    "wood_beech": Surface((0.68, 0.48, 0.28), 0.6),
    "wood_ply": Surface((0.60, 0.46, 0.28), 0.8),
    "rubber_black": Surface((0.03, 0.03, 0.03), 0.9),
    "plastic_black": Surface((0.05, 0.05, 0.055), 0.5),
    "plastic_grey": Surface((0.34, 0.35, 0.36), 0.5),
    "plastic_white": Surface((0.80, 0.80, 0.80), 0.4),
    "plastic_blue": Surface((0.04, 0.20, 0.55), 0.4),
    "plastic_red": Surface((0.62, 0.05, 0.04), 0.4),
    "plastic_green": Surface((0.08, 0.38, 0.14), 0.4),
    "plastic_orange": Surface((0.88, 0.26, 0.02), 0.4),
    "hi_vis": Surface((0.72, 0.88, 0.05), 0.8),
    "reflex_silver": Surface((0.75, 0.76, 0.78), 0.3),
    "fabric_grey": Surface((0.20, 0.21, 0.23), 0.95),
    "glove_leather": Surface((0.58, 0.42, 0.24), 0.9),
    "paper": Surface((0.86, 0.85, 0.82), 0.9),
    "film_clear": Surface((0.72, 0.80, 0.82), 0.2, 0.0, 0.6),
    "window_glass": Surface((0.66, 0.80, 0.88), 0.05, 0.0, 0.35),
    "screen": Surface((0.03, 0.06, 0.10), 0.1),
    "light_panel": Surface((0.95, 0.93, 0.86), 0.4),
    "lambert1": Surface((0.45, 0.45, 0.45), 0.7),
}
"""Name to UsdPreviewSurface inputs."""
