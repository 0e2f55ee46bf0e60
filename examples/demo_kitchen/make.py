"""Writes the demo kitchen: `python -m examples.demo_kitchen.make [OUT_DIR]`.

OUT_DIR (default `src/usd2kg/demo/kitchen`) receives `kitchen.usda`, `assets/`, `gold.csv` and
`relations.csv`. Two runs write the same bytes.
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Iterable, Sequence
from pathlib import Path

from . import (  # noqa: F401  (imported for the assets they register)
    assets_appliances,
    assets_cookware,
    assets_furniture,
    assets_household,
    assets_pantry,
    assets_room,
    assets_tableware,
    assets_units,
)
from .asset import write_asset
from .labels import LABELS
from .layout import Layout
from .place_counter import place_counter
from .place_dining import place_bar, place_dining
from .place_shell import place_corners, place_shell, place_sideboard, place_wall_decor
from .place_storage import place_fridge, place_pantry, place_wall_units
from .stage import write_stage


def lay_out() -> Layout:
    """The whole scene in memory."""
    scene = Layout("/KitchenDining")
    floor = place_shell(scene)
    place_counter(scene, floor)
    place_fridge(scene, floor)
    place_wall_units(scene)
    place_pantry(scene, floor)
    place_bar(scene, floor)
    place_dining(scene, floor)
    place_sideboard(scene, floor)
    place_corners(scene, floor)
    place_wall_decor(scene)
    return scene


def write_scene(scene: Layout, folder: Path) -> None:
    """Writes layers, gold labels and true relations."""
    assets = folder / "assets"
    assets.mkdir(parents=True, exist_ok=True)
    for stale in [*assets.glob("*.usdc"), folder / "kitchen.usda"]:
        stale.unlink(missing_ok=True)
    for name in sorted(scene.assets):
        write_asset(scene.assets[name], assets / f"{name}.usdc")
    write_stage(scene, folder / "kitchen.usda")
    gold = []
    for path in sorted(scene.placed):
        label, *also = LABELS[scene.placed[path].asset.name].split()
        gold.append((path, label, "|".join(also)))
    _write_csv(folder / "gold.csv", ("path", "class", "also"), gold)
    _write_csv(folder / "relations.csv", ("subject", "relation", "object"), sorted(scene.relations))


def _write_csv(path: Path, header: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def main() -> None:
    """Command line entry."""
    parser = argparse.ArgumentParser(description="Write the demo kitchen.")
    parser.add_argument("out_dir", nargs="?", default="src/usd2kg/demo/kitchen", type=Path)
    folder: Path = parser.parse_args().out_dir
    scene = lay_out()
    write_scene(scene, folder)
    size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
    print(f"{len(scene.placed)} objects of {len(scene.assets)} assets, {len(scene.relations)} relations")
    print(f"{size / 1024:.0f} KiB in {folder}")


if __name__ == "__main__":
    main()
