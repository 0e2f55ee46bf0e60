"""Writes the demo warehouse: `python -m examples.demo_warehouse.make [OUT_DIR]`.

OUT_DIR (default `benchmarks/scenes/warehouse`) receives `warehouse.usda`, `assets/` and `gold.csv`.
Two runs write the same bytes.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

from . import (  # noqa: F401  (imported for the assets they register)
    assets_charging,
    assets_desk,
    assets_moving,
    assets_people,
    assets_shell,
    assets_storage,
    assets_workshop,
)
from .catalogue import ENTRIES
from .labels import LABELS
from .layout import Area, Layout
from .place_desk import place_office, place_packing
from .place_hall import place_goods_in, place_safety, place_services, place_shell
from .place_storage import place_bulk, place_racks, place_shelves
from .place_work import place_charging, place_workshop
from .stage import write_stage
from .writer import write_asset


def lay_out() -> Layout:
    """The whole scene in memory."""
    scene = Layout("/Warehouse_Full")
    root = Area(scene, scene.root)
    place_shell(root)
    place_services(root)
    place_safety(root)
    place_goods_in(root)
    place_racks(root)
    place_shelves(root)
    place_bulk(root)
    place_packing(root)
    place_workshop(root)
    place_charging(root)
    place_office(root)
    return scene


def write_scene(scene: Layout, folder: Path) -> None:
    """Writes layers and gold labels."""
    assets = folder / "assets"
    assets.mkdir(parents=True, exist_ok=True)
    for stale in [*assets.glob("*.usdc"), folder / "warehouse.usda"]:
        stale.unlink(missing_ok=True)
    for key in sorted(scene.assets):
        write_asset(scene.assets[key], ENTRIES[key], assets / f"{ENTRIES[key].file}.usdc")
    write_stage(scene, folder / "warehouse.usda")
    with (folder / "gold.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("path", "class", "also"))
        for path in sorted(scene.placed):
            label, *also = LABELS[scene.placed[path].key].split()
            writer.writerow((path, label, "|".join(also)))


def main() -> None:
    """Command line entry."""
    parser = argparse.ArgumentParser(description="Write the demo warehouse.")
    parser.add_argument("out_dir", nargs="?", default="benchmarks/scenes/warehouse", type=Path)
    folder: Path = parser.parse_args().out_dir
    scene = lay_out()
    write_scene(scene, folder)
    size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
    print(f"{len(scene.placed)} objects of {len(scene.assets)} assets, {size / 1024:.0f} KiB in {folder}")


if __name__ == "__main__":
    main()
