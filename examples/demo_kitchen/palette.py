"""Materials of the demo kitchen: artist names and UsdPreviewSurface inputs."""

from __future__ import annotations

from typing import NamedTuple


class Surface(NamedTuple):
    """UsdPreviewSurface inputs."""

    colour: tuple[float, float, float]
    """Linear RGB, 0-1."""
    roughness: float = 0.5
    metallic: float = 0.0
    opacity: float = 1.0


PALETTE: dict[str, Surface] = {
    "ceramic_white": Surface((0.85, 0.84, 0.81), 0.2),
    "ceramic_blue": Surface((0.10, 0.22, 0.42), 0.25),
    "ceramic_sage": Surface((0.36, 0.46, 0.36), 0.3),
    "ceramic_ochre": Surface((0.70, 0.42, 0.10), 0.3),
    "terracotta": Surface((0.58, 0.24, 0.12), 0.8),
    "brushed_steel": Surface((0.56, 0.57, 0.58), 0.35, 1.0),
    "chrome": Surface((0.72, 0.73, 0.75), 0.1, 1.0),
    "cast_iron": Surface((0.06, 0.06, 0.065), 0.6, 0.6),
    "brass": Surface((0.72, 0.50, 0.20), 0.3, 1.0),
    "copper": Surface((0.78, 0.40, 0.24), 0.3, 1.0),
    "enamel_red": Surface((0.58, 0.05, 0.04), 0.2),
    "enamel_cream": Surface((0.82, 0.75, 0.58), 0.25),
    "enamel_teal": Surface((0.07, 0.34, 0.35), 0.25),
    "plastic_black": Surface((0.03, 0.03, 0.03), 0.4),
    "plastic_white": Surface((0.82, 0.82, 0.82), 0.4),
    "plastic_grey": Surface((0.32, 0.33, 0.34), 0.5),
    "plastic_blue": Surface((0.08, 0.25, 0.60), 0.4),
    "plastic_yellow": Surface((0.85, 0.62, 0.05), 0.4),
    "plastic_green": Surface((0.12, 0.42, 0.16), 0.4),
    "plastic_bag": Surface((0.07, 0.09, 0.08), 0.35),
    "glass_clear": Surface((0.80, 0.88, 0.88), 0.05, 0.0, 0.28),
    "glass_green": Surface((0.05, 0.18, 0.06), 0.08, 0.0, 0.9),
    "glass_black": Surface((0.015, 0.015, 0.02), 0.05),
    "window_glass": Surface((0.70, 0.84, 0.92), 0.05, 0.0, 0.3),
    "screen_dark": Surface((0.02, 0.03, 0.05), 0.1),
    "oak_light": Surface((0.62, 0.43, 0.24), 0.5),
    "oak_dark": Surface((0.26, 0.14, 0.07), 0.5),
    "beech": Surface((0.72, 0.52, 0.32), 0.5),
    "wicker": Surface((0.50, 0.32, 0.14), 0.8),
    "cork": Surface((0.52, 0.34, 0.18), 0.9),
    "lacquer_white": Surface((0.80, 0.80, 0.77), 0.3),
    "lacquer_sage": Surface((0.30, 0.40, 0.33), 0.4),
    "stone_dark": Surface((0.13, 0.13, 0.14), 0.3),
    "wall_paint": Surface((0.80, 0.76, 0.67), 0.9),
    "ceiling_paint": Surface((0.88, 0.88, 0.86), 0.9),
    "tile_warm": Surface((0.52, 0.42, 0.33), 0.4),
    "tile_light": Surface((0.62, 0.52, 0.42), 0.4),
    "fabric_linen": Surface((0.72, 0.66, 0.54), 0.95),
    "fabric_rust": Surface((0.52, 0.18, 0.08), 0.95),
    "fabric_navy": Surface((0.06, 0.09, 0.20), 0.95),
    "fabric_check": Surface((0.65, 0.16, 0.14), 0.95),
    "wool_rug": Surface((0.45, 0.36, 0.30), 1.0),
    "wool_border": Surface((0.28, 0.12, 0.09), 1.0),
    "paper_white": Surface((0.88, 0.87, 0.84), 0.9),
    "paper_kraft": Surface((0.52, 0.38, 0.22), 0.9),
    "carton_blue": Surface((0.14, 0.32, 0.66), 0.6),
    "carton_red": Surface((0.72, 0.10, 0.08), 0.6),
    "carton_yellow": Surface((0.88, 0.64, 0.08), 0.6),
    "carton_grey": Surface((0.45, 0.46, 0.44), 0.9),
    "leaf_green": Surface((0.10, 0.30, 0.06), 0.7),
    "petal_red": Surface((0.75, 0.08, 0.12), 0.6),
    "soil": Surface((0.08, 0.05, 0.03), 1.0),
    "apple_red": Surface((0.60, 0.06, 0.05), 0.3),
    "apple_green": Surface((0.40, 0.55, 0.08), 0.3),
    "orange_peel": Surface((0.90, 0.38, 0.03), 0.5),
    "lemon_peel": Surface((0.92, 0.76, 0.08), 0.5),
    "banana_peel": Surface((0.88, 0.68, 0.10), 0.5),
    "crust": Surface((0.52, 0.27, 0.09), 0.8),
    "cream": Surface((0.88, 0.80, 0.66), 0.6),
    "jam_red": Surface((0.36, 0.02, 0.05), 0.2),
    "jam_orange": Surface((0.75, 0.30, 0.03), 0.2),
    "honey": Surface((0.70, 0.38, 0.03), 0.15),
    "cocoa": Surface((0.16, 0.07, 0.03), 0.4),
    "sponge_yellow": Surface((0.86, 0.70, 0.12), 1.0),
    "soap_green": Surface((0.30, 0.60, 0.38), 0.2, 0.0, 0.8),
    "print_landscape": Surface((0.26, 0.42, 0.46), 0.8),
    "print_fruit": Surface((0.62, 0.34, 0.14), 0.8),
    "chalk_board": Surface((0.05, 0.08, 0.07), 0.9),
    "lamp_glow": Surface((0.95, 0.88, 0.70), 0.5),
}
