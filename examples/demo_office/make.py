"""Writes the demo office: `python -m examples.demo_office.make [OUT_DIR]`.

OUT_DIR (default `benchmarks/scenes/office`) receives `office.usda`, `assets/` and `gold.csv`. Two runs
write the same bytes.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

from . import (  # noqa: F401  (imported for the assets they register)
    assets_desk,
    assets_meeting,
    assets_room,
    assets_service,
    assets_supplies,
)
from .catalogue import SPECS, Office
from .labels import LABELS
from .place_desks import place_desks, place_storage
from .place_meeting import place_meeting, place_reception
from .place_service import place_kitchenette, place_print_room
from .place_shell import place_greenery, place_shell
from .write import write_asset, write_stage


def lay_out() -> Office:
    """The whole scene in memory."""
    scene = Office("/OfficeFloor_02")
    floor = place_shell(scene)
    place_desks(scene, floor)
    place_storage(scene, floor)
    place_meeting(scene, floor)
    place_reception(scene, floor)
    place_kitchenette(scene, floor)
    place_print_room(scene, floor)
    place_greenery(scene, floor)
    return scene


def write_scene(scene: Office, folder: Path) -> None:
    """Writes layers and gold labels; assets of an earlier run are removed."""
    assets = folder / "assets"
    assets.mkdir(parents=True, exist_ok=True)
    for stale in [*assets.glob("*.usdc"), folder / "office.usda"]:
        stale.unlink(missing_ok=True)
    for name in sorted(scene.assets):
        write_asset(scene.assets[name], assets / f"{SPECS[name].file}.usdc")
    write_stage(scene, folder / "office.usda")
    _write_gold(scene, folder / "gold.csv")


def _write_gold(scene: Office, path: Path) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("path", "class", "also"))
        for prim_path in sorted(scene.placed):
            label, *also = LABELS[scene.placed[prim_path].asset.name].split()
            writer.writerow((prim_path, label, "|".join(also)))


def main() -> None:
    """Command line entry."""
    parser = argparse.ArgumentParser(description="Write the demo office.")
    parser.add_argument("out_dir", nargs="?", default="benchmarks/scenes/office", type=Path)
    folder: Path = parser.parse_args().out_dir
    scene = lay_out()
    write_scene(scene, folder)
    size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
    print(f"{len(scene.placed)} objects of {len(scene.assets)} assets")
    print(f"{size / 1024:.0f} KiB in {folder}")


if __name__ == "__main__":
    main()
