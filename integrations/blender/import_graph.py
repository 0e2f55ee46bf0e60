"""Import a USD stage into Blender with the classes that usd2kg found.

Run inside Blender, whose Python needs no package:

    usd2kg ground kitchen.usda -o kitchen.csv
    blender --background --python import_graph.py -- kitchen.usda kitchen.csv -o kitchen.blend

Each object gets the custom properties `usd2kg_class`, `usd2kg_iri`, `usd2kg_confidence`, `usd2kg_concept` and
`usd2kg_prim_path`, and each class a collection with its objects and their parts.
"""

import argparse
import csv
import json
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

__all__ = [
    "PrimClass",
    "attach_classes",
    "import_stage",
    "local_name",
    "main",
    "nearest_object",
    "read_classes",
]

_PREFIX = "usd2kg_"
_ROOT_COLLECTION = "usd2kg classes"
_COLUMNS = ("path", "class", "label", "confidence")


class PrimClass(NamedTuple):
    """The class of one prim."""

    iri: str
    label: str
    """Label of the class, which names its collection."""
    confidence: float | None
    """Probability that the class is right; None if unknown."""
    concept: str
    """Noun for the concept of the object; empty if it has none."""


def read_classes(mapping: Path) -> dict[str, PrimClass]:
    """Return prim path → class from a file of `usd2kg ground`, `.csv` or `.json`; prims without a class are left out.

    Raises:
        ValueError: the file is not such a mapping.
    """
    text = mapping.read_text("utf-8-sig")
    rows = _json_rows(mapping, text) if mapping.suffix.lower() == ".json" else _csv_rows(mapping, text)
    return {path: found for path, found in rows if found.iri}


def _csv_rows(mapping: Path, text: str) -> Iterator[tuple[str, PrimClass]]:
    rows = csv.DictReader(text.splitlines())
    missing = [name for name in _COLUMNS if name not in (rows.fieldnames or ())]
    if missing:
        raise ValueError(f"{mapping}: no column {', '.join(missing)}; expected a file of usd2kg ground")
    for row in rows:
        confidence = float(row["confidence"]) if row["confidence"] else None
        yield row["path"], PrimClass(row["class"], row["label"], confidence, row.get("concept_label") or "")


def _json_rows(mapping: Path, text: str) -> Iterator[tuple[str, PrimClass]]:
    content = json.loads(text)
    if not isinstance(content, dict) or not str(content.get("format", "")).startswith("usd2kg-grounding/"):
        raise ValueError(f"{mapping}: no grounding; expected a file of usd2kg ground")
    concepts = content.get("concepts", {})
    for entry in content["predictions"]:
        iri, concept = entry["class_iri"] or "", concepts.get(entry.get("concept"), {})
        # The file has no labels of classes.
        yield entry["prim_path"], PrimClass(iri, local_name(iri), entry["confidence"], concept.get("label", ""))


def local_name(iri: str) -> str:
    """Return the last part of an IRI.

    >>> local_name("http://www.ease-crc.org/ont/SOMA.owl#Cup")
    'Cup'
    """
    return iri.rpartition("#" if "#" in iri else "/")[2]


def nearest_object(prim_path: str, classes: Mapping[str, PrimClass]) -> str | None:
    """Return the path of the object that a prim is or belongs to; None if it belongs to none.

    >>> nearest_object("/World/Mug/Handle", {"/World/Mug": PrimClass("#Cup", "cup", 0.9, "mug")})
    '/World/Mug'
    """
    while prim_path:
        if prim_path in classes:
            return prim_path
        prim_path = prim_path.rpartition("/")[0]
    return None


def import_stage(stage: Path) -> dict[str, list[Any]]:
    """Import a USD stage, and return prim path → objects of Blender.

    Blender renames objects whose names are taken, so only its importer knows which prim an object is of.

    Raises:
        RuntimeError: Blender cannot import the stage, or is older than 4.4.
    """
    import bpy  # noqa: PLC0415 - only inside Blender

    if bpy.app.version < (4, 4, 0):
        raise RuntimeError(f"Blender {bpy.app.version_string} does not say which prim an object is of; needs 4.4")
    # Blender as a Python package hides the OpenUSD that the hook needs.
    if hasattr(bpy.utils, "expose_bundled_modules"):
        bpy.utils.expose_bundled_modules()
    names: dict[str, list[str]] = {}

    class PrimPaths(bpy.types.USDHook):  # type: ignore[misc]
        """Notes the objects of each prim."""

        bl_idname = "usd2kg_prim_paths"
        bl_label = "usd2kg: prim paths"

        @staticmethod
        def on_import(context: Any) -> bool:
            for path, blocks in context.get_prim_map().items():
                names[str(path)] = [block.name for block in blocks if isinstance(block, bpy.types.Object)]
            return True

    bpy.utils.register_class(PrimPaths)
    try:
        # A merged prim would have no object of its own.
        bpy.ops.wm.usd_import(filepath=str(stage), merge_parent_xform=False)
    finally:
        # A registered hook keeps Blender from ending.
        bpy.utils.unregister_class(PrimPaths)
    return {path: [bpy.data.objects[name] for name in found] for path, found in names.items() if found}


def attach_classes(objects: Mapping[str, Iterable[Any]], classes: Mapping[str, PrimClass]) -> dict[str, int]:
    """Write the classes as custom properties, and link objects and their parts into a collection for each class.

    Returns:
        The label of each class → its number of objects in Blender.
    """
    import bpy  # noqa: PLC0415 - only inside Blender

    root = bpy.data.collections.new(_ROOT_COLLECTION)
    bpy.context.scene.collection.children.link(root)
    collections: dict[str, Any] = {}
    counts: dict[str, int] = {}
    # Blender's order differs between runs.
    for path in sorted(objects):
        owner = nearest_object(path, classes)
        if owner is None:
            continue
        found = classes[owner]
        if found.iri not in collections:
            collections[found.iri] = bpy.data.collections.new(found.label or local_name(found.iri))
            root.children.link(collections[found.iri])
        for obj in objects[path]:
            collections[found.iri].objects.link(obj)
            if path == owner:
                _set_properties(obj, path, found)
                counts[found.label] = counts.get(found.label, 0) + 1
    return counts


def _set_properties(obj: Any, prim_path: str, found: PrimClass) -> None:
    obj[f"{_PREFIX}prim_path"] = prim_path
    obj[f"{_PREFIX}class"] = found.label
    obj[f"{_PREFIX}iri"] = found.iri
    if found.confidence is not None:
        obj[f"{_PREFIX}confidence"] = found.confidence
    if found.concept:
        obj[f"{_PREFIX}concept"] = found.concept


def main(arguments: list[str]) -> int:
    """Import, attach, save if asked to, and print what was done; return the exit code."""
    parser = argparse.ArgumentParser(prog="import_graph.py", description="Import a USD stage with classes of usd2kg.")
    parser.add_argument("stage", type=Path, help="USD stage")
    parser.add_argument("mapping", type=Path, help="file of usd2kg ground: .csv or .json")
    parser.add_argument("-o", "--output", type=Path, help="Blender file to save; default: none")
    parser.add_argument("--keep", action="store_true", help="keep the objects of the open file; default: start empty")
    chosen = parser.parse_args(arguments)

    import bpy  # noqa: PLC0415 - only inside Blender

    try:
        classes = read_classes(chosen.mapping)
        if not chosen.keep:
            bpy.ops.wm.read_factory_settings(use_empty=True)
        objects = import_stage(chosen.stage.resolve())
    except (OSError, ValueError, RuntimeError) as error:
        print(f"import_graph.py: {error}", file=sys.stderr)
        return 2
    counts = attach_classes(objects, classes)
    missing = [path for path in classes if path not in objects]
    print(f"{sum(counts.values())} objects of {len(counts)} classes; {len(missing)} of the mapping are not in Blender")
    for path in missing:
        print(f"  not in Blender: {path}")
    if chosen.output is not None:
        bpy.ops.wm.save_as_mainfile(filepath=str(chosen.output.resolve()))
        print(f"written to {chosen.output}")
    return 0


if __name__ == "__main__":
    # Blender passes on its own arguments before the two hyphens.
    own = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    if code := main(own):
        sys.exit(code)
