"""Write a scene: assets, root layer, gold labels and, where wanted, relations."""

from pathlib import Path

from scenes.writer.asset_file import write_asset
from scenes.writer.gold import read_labels, write_gold, write_table
from scenes.writer.layout import AuthoredScene, read_layout
from scenes.writer.root_layer import AddExtras, write_root_layer


def write_scene(spec: AuthoredScene, add_extras: AddExtras, folder: Path) -> str:
    """Write `FOLDER/{NAME.usda,assets,gold.csv}`, where NAME is that of the table folder; return a summary."""
    layout = read_layout(spec)
    assets = folder / "assets"
    assets.mkdir(parents=True, exist_ok=True)
    for stale in assets.glob("*.usdc"):
        stale.unlink()
    for key in sorted(layout.assets):
        file = layout.files[key]
        write_asset(layout.assets[key], file, spec, assets / f"{file.file}.usdc")
    write_root_layer(layout, folder / f"{spec.tables.name}.usda", add_extras)
    labels = read_labels(spec.tables / "labels.csv")
    write_gold(folder / "gold.csv", {path: labels[placement.asset] for path, placement in layout.placed.items()})
    if spec.writes_relations:
        write_table(folder / "relations.csv", ("subject", "relation", "object"), sorted(layout.relations))
    return f"{len(layout.placed)} objects, {len(layout.assets)} assets"
