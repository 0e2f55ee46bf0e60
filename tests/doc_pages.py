"""What the code blocks of each documentation page need: scenes, ontologies and files beside them."""

import shutil
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest
import trimesh
from pxr import Gf, Sdf, Usd, UsdGeom

import usd2kg
from tests.conftest import shared_file
from usd2kg.demo import demo_gold, demo_scene

__all__ = ["GENERATED", "GUIDES", "PAGES", "ROOT", "all_pages"]

ROOT = Path(__file__).parents[1]
_AWS = "scenes/aws_robomaker"
_SOMA = "ontologies/soma"


def all_pages() -> list[str]:
    """Return the paths of the README and of all documents in docs."""
    return ["README.md", *sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").rglob("*.md"))]


def _nothing(_folder: Path) -> None:
    """Prepare nothing."""


def _small_house(folder: Path) -> None:
    shutil.copy(shared_file(f"{_AWS}/small_house.usdc"), folder)


def _labels(folder: Path) -> None:
    shutil.copy(shared_file(f"{_AWS}/small_house.usdc"), folder / "house.usdc")


def _ontologies(folder: Path) -> None:
    _small_house(folder)
    shutil.copy(shared_file(f"{_AWS}/bookstore.usdc"), folder)
    shutil.copy(ROOT / "examples/pantry.ttl", folder / "my.owl")


def _validation(folder: Path) -> None:
    _kitchen(folder)
    shutil.copytree(shared_file(_SOMA), folder, dirs_exist_ok=True)


def _evaluation(folder: Path) -> None:
    shutil.copytree(shared_file(_SOMA), folder, dirs_exist_ok=True)
    shutil.copy(shared_file(f"{_AWS}/small_house.usdc"), folder / "scene.usd")
    shutil.copy(shared_file(f"{_AWS}/small_house.gold.csv"), folder / "gold.csv")


def _kitchen(folder: Path) -> None:
    shutil.copytree(demo_scene().parent, folder, dirs_exist_ok=True)


def _formats(folder: Path) -> None:
    _kitchen(folder)
    usd2kg.write_graph(usd2kg.build(demo_scene()).graph, folder / "kitchen.jsonld")


def _studio(folder: Path) -> None:
    _small_house(folder)
    _two_kitchens(folder)


def _kitchen_graph(folder: Path) -> None:
    usd2kg.write_graph(usd2kg.build(demo_scene()).graph, folder / "kitchen.ttl")


def _robots(folder: Path) -> None:
    if shutil.which("swipl") is None:
        pytest.skip("needs SWI-Prolog: apt-get install swi-prolog-nox")
    _kitchen(folder)
    shutil.copy(ROOT / "integrations/knowrob/questions.pl", folder)


def _rooms(folder: Path) -> None:
    for name in ("kitchen.usda", "kitchen.usd", "office.usd"):
        _write_room(folder / name)


def _stores(folder: Path) -> None:
    _rooms(folder)
    usd2kg.write_graph(usd2kg.build(folder / "kitchen.usd").graph, folder / "kitchen.ttl")


def _folder_of_rooms(folder: Path) -> None:
    for name in ("kitchen.usd", "hall/east.usd"):
        _write_room(folder / "scenes" / name)


def _write_room(path: Path) -> None:
    """Write a room with a cup on a table, in the format that the ending states."""
    parts = (("table", "0 0 0", "1.2 0.8 0.75"), ("cup", "0.2 0.2 0.75", "0.08 0.08 0.1"))
    path.parent.mkdir(parents=True, exist_ok=True)
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    for label, lower, size in parts:
        prim = UsdGeom.Xform.Define(stage, f"/Room/{label}").GetPrim()
        Usd.ModelAPI(prim).SetKind("component")
        cube = UsdGeom.Cube.Define(stage, f"/Room/{label}/shape")
        cube.CreateSizeAttr(1.0)
        corner, sides = ([float(word) for word in text.split()] for text in (lower, size))
        cube.AddTranslateOp().Set(tuple(low + side / 2 for low, side in zip(corner, sides, strict=True)))
        cube.AddScaleOp().Set(tuple(sides))
    stage.Save()


def _project(folder: Path) -> None:
    _write_room(folder / "scenes/kitchen.usdc")
    (folder / "ontology").mkdir()
    shutil.copy(ROOT / "examples/pantry.ttl", folder / "ontology/twin.ttl")


def _glb(folder: Path) -> None:
    scene = trimesh.Scene()
    for name, size, z in (("table", (1.2, 0.75, 0.8), 0.375), ("cup", (0.08, 0.1, 0.08), 0.8)):
        scene.add_geometry(
            trimesh.creation.box(size), name, name, transform=trimesh.transformations.translation_matrix((0, z, 0))
        )
    scene.export(folder / "kitchen.glb")


def _inputs(folder: Path) -> None:
    _glb(folder)
    (folder / "flat").mkdir()
    for name in ("table", "cup"):
        trimesh.creation.box((1, 1, 1)).export(folder / "flat" / f"{name}.obj")


def _two_kitchens(folder: Path) -> None:
    """Write the demo kitchen, a changed copy, graphs of both, and decisions about the first one."""
    _kitchen(folder)
    shutil.copy(folder / "kitchen.usda", folder / "kitchen2.usda")
    layer = Sdf.Layer.FindOrOpen(str(folder / "kitchen2.usda"))
    area = "/KitchenDining/diningArea"
    edit = Sdf.BatchNamespaceEdit()
    edit.Add(Sdf.NamespaceEdit.Rename("/KitchenDining/pantry", "larder"))
    edit.Add(Sdf.NamespaceEdit.Rename(f"{area}/glass_1", "waterGlass_A"))
    edit.Add(Sdf.NamespaceEdit.Rename(f"{area}/napkin_1", "serviette_1"))
    edit.Add(Sdf.NamespaceEdit.Remove(f"{area}/toyCar"))
    assert layer.Apply(edit)
    Sdf.CopySpec(layer, f"{area}/glass_2", layer, f"{area}/glass_7")
    stage = Usd.Stage.Open(layer)
    _move(stage.GetPrimAtPath(f"{area}/glass_7"), (0, 0, 12))
    _move(stage.GetPrimAtPath("/KitchenDining/cleaningCorner"), (0, 0, -30))
    for name in ("CuttingBoard", "breadLoaf", "bread_knife"):
        _move(stage.GetPrimAtPath(f"/KitchenDining/counterRun/worktopRight/{name}"), (-15, 0, 0))
    UsdGeom.Xformable(stage.GetPrimAtPath(f"{area}/saladBowl")).AddScaleOp(opSuffix="grow").Set((1.2, 1.2, 1.2))
    UsdGeom.Xformable(stage.GetPrimAtPath(f"{area}/chair_04")).AddRotateYOp(opSuffix="turn").Set(30)
    stage.Save()
    for name, scene in (("old.ttl", "kitchen.usda"), ("new.ttl", "kitchen2.usda")):
        graph = usd2kg.build(folder / scene, base="https://my.lab/kitchen/").graph
        usd2kg.write_graph(graph, folder / name)
    usd2kg.write_graph(usd2kg.build(folder / "kitchen.usda").graph, folder / "kitchen.ttl")
    soma = "http://www.ease-crc.org/ont/SOMA.owl#"
    rows = [("glass_1", "WaterGlass"), ("glass_2", "WaterGlass"), ("saladBowl", "SaladBowl"), ("toyCar", "Cup")]
    lines = ["path,decision", *(f"{area}/{name},{soma}{cls}" for name, cls in rows)]
    (folder / "decisions.csv").write_text("\n".join(lines) + "\n", "utf-8")


def _move(prim: Usd.Prim, offset: tuple[float, float, float]) -> None:
    """Move a prim by centimetres of the demo kitchen, along the axes of its parent."""
    xformable = UsdGeom.Xformable(prim)
    operations = xformable.GetOrderedXformOps()
    for operation in operations:
        if operation.GetOpType() == UsdGeom.XformOp.TypeTranslate:
            operation.Set(Gf.Vec3d(*np.add(operation.Get(), offset).tolist()))
            return
    xformable.AddTranslateOp().Set(Gf.Vec3d(*offset))
    xformable.SetXformOpOrder([xformable.GetOrderedXformOps()[-1], *operations])


def _demo_files(folder: Path) -> None:
    _kitchen(folder)
    shutil.copy(demo_gold(), folder / "kitchen.gold.csv")
    shutil.copy(ROOT / "examples/pantry.ttl", folder / "my.owl")


PAGES: Mapping[str, Callable[[Path], None]] = {
    "README.md": _small_house,
    "docs/assistants.md": _kitchen_graph,
    "docs/batch.md": _folder_of_rooms,
    "docs/change.md": _two_kitchens,
    "docs/evaluation.md": _evaluation,
    "docs/formats.md": _formats,
    "docs/grounding.md": _nothing,
    "docs/inputs.md": _inputs,
    "docs/labels.md": _labels,
    "docs/llm.md": _nothing,
    "docs/ontologies.md": _ontologies,
    "docs/project_file.md": _project,
    "docs/python.md": _nothing,
    "docs/relations.md": _rooms,
    "docs/robots.md": _robots,
    "docs/stores.md": _stores,
    "docs/studio.md": _studio,
    "docs/validation.md": _validation,
    "docs/vocabulary.md": _nothing,
}
"""Page → function that prepares the folder in which its code blocks run."""
GUIDES: Mapping[str, Callable[[Path], None]] = {
    "docs/extending.md": _demo_files,
    "docs/guides/digital_twin.md": _two_kitchens,
    "docs/guides/ontology_engineer.md": _ontologies,
    "docs/guides/researcher.md": _demo_files,
    "docs/guides/robotics.md": _demo_files,
    "docs/tutorial.md": _nothing,
}
"""The same for the tutorial and the guides."""
GENERATED = ("docs/cli.md", "docs/questions.md")
"""Pages whose code blocks a program writes from real runs; test_docs.py compares them."""
