"""Time reading a stage against a bare loop that opens and traverses it and computes the same boxes and names.

Usage: python benchmarks/reading/run.py [PRIMS...] (default 1000 10000 100000)

Both run alternately in one process on the same file. Prints their ratio and the memory retained per object.
"""

import gc
import sys
import tempfile
import time
import tracemalloc
from collections.abc import Callable
from pathlib import Path

from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdShade, Vt

from usd2kg.scene import read_scene

PRIMS_PER_OBJECT = 4


def make_stage(path: Path, prims: int, *, instanced: bool) -> int:
    """Write a stage of about `prims` prims, components of two meshes and a scope; return the number of objects."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    world = UsdGeom.Xform.Define(stage, "/World")
    Usd.ModelAPI(world).SetKind(Kind.Tokens.group)
    material = UsdShade.Material.Define(stage, "/Looks/oak")
    layer = stage.GetRootLayer()
    count = prims // PRIMS_PER_OBJECT
    with Sdf.ChangeBlock():
        if instanced:
            _write_object(layer, "/Prototype", 0, Sdf.SpecifierClass)
        for index in range(count):
            place = f"/World/Thing_{index}"
            if instanced:
                _write_instance(layer, place, index)
            else:
                _write_object(layer, place, index, Sdf.SpecifierDef)
    assert material
    layer.Save()
    return count


def _write_object(layer: Sdf.Layer, path: str, index: int, specifier: Sdf.Specifier) -> None:
    prim = Sdf.CreatePrimInLayer(layer, path)
    prim.specifier, prim.typeName, prim.kind = specifier, "Xform", "component"
    _translate(prim, index)
    scope = Sdf.PrimSpec(prim, "geo", Sdf.SpecifierDef, "Xform")
    for name in ("body", "lid"):
        mesh = Sdf.PrimSpec(scope, name, Sdf.SpecifierDef, "Mesh")
        points = Sdf.AttributeSpec(mesh, "points", Sdf.ValueTypeNames.Point3fArray)
        points.default = Vt.Vec3fArray([Gf.Vec3f(0, 0, 0), Gf.Vec3f(1, 0, 0), Gf.Vec3f(1, 1, 1)])
        extent = Sdf.AttributeSpec(mesh, "extent", Sdf.ValueTypeNames.Float3Array)
        extent.default = Vt.Vec3fArray([Gf.Vec3f(0, 0, 0), Gf.Vec3f(1, 1, 1)])
        binding = Sdf.RelationshipSpec(mesh, "material:binding", custom=False)
        binding.targetPathList.explicitItems = ["/Looks/oak"]
        mesh.SetInfo("apiSchemas", Sdf.TokenListOp.CreateExplicit(["MaterialBindingAPI"]))


def _write_instance(layer: Sdf.Layer, path: str, index: int) -> None:
    prim = Sdf.CreatePrimInLayer(layer, path)
    prim.specifier, prim.instanceable, prim.kind = Sdf.SpecifierDef, True, "component"
    prim.inheritPathList.prependedItems = ["/Prototype"]
    _translate(prim, index)


def _translate(prim: Sdf.PrimSpec, index: int) -> None:
    place = Sdf.AttributeSpec(prim, "xformOp:translate", Sdf.ValueTypeNames.Double3)
    place.default = Gf.Vec3d(index % 300 * 2.0, index // 300 * 2.0, 0)
    order = Sdf.AttributeSpec(prim, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, Sdf.VariabilityUniform)
    order.default = Vt.TokenArray(["xformOp:translate"])


def bare_loop(path: Path) -> int:
    """Open and traverse a stage; compute box and asset of each component and the bound material of each gprim."""
    stage = Usd.Stage.Open(str(path))
    boxes = UsdGeom.BBoxCache(Usd.TimeCode.EarliestTime(), [UsdGeom.Tokens.default_, UsdGeom.Tokens.render])
    found = 0
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if Usd.ModelAPI(prim).GetKind() == Kind.Tokens.component:
            boxes.ComputeWorldBound(prim).ComputeAlignedRange()
            prim.GetAssetInfo()
            [spec.referenceList.GetAddedOrExplicitItems() for spec in prim.GetPrimStack()]
            found += 1
        if prim.IsA(UsdGeom.Gprim):
            UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    return found


def best_times(repeats: int, *actions: Callable[[], object]) -> list[float]:
    """Return the minimum time of each action in seconds; actions alternate, so that other load affects all alike."""
    times: list[list[float]] = [[] for _ in actions]
    for _ in range(repeats):
        for action, own in zip(actions, times, strict=True):
            gc.collect()
            start = time.perf_counter()
            action()
            own.append(time.perf_counter() - start)
    return [min(own) for own in times]


def repeats(prims: int) -> int:
    """Return the number of repetitions for a stage of this size."""
    return 9 if prims <= 10_000 else 3 if prims <= 100_000 else 1


def memory_of_scene(path: Path) -> float:
    """Return the bytes of Python memory per object that a scene retains after its stage is closed."""
    gc.collect()
    tracemalloc.start()
    scene = read_scene(path)
    gc.collect()
    held = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    return held / len(scene.objects)


def main() -> None:
    """Measure and print."""
    sizes = [int(argument) for argument in sys.argv[1:]] or [1_000, 10_000, 100_000]
    print("prims     layout     objects  read_scene s  bare loop s  ratio  bytes/object retained")
    with tempfile.TemporaryDirectory() as folder:
        for prims in sizes:
            for instanced in (False, True):
                path = Path(folder) / f"{prims}_{instanced}.usdc"
                objects = make_stage(path, prims, instanced=instanced)
                ours, bare = best_times(repeats(prims), lambda p=path: read_scene(p), lambda p=path: bare_loop(p))
                layout = "instanced" if instanced else "flat"
                line = f"{prims:<9} {layout:<10} {objects:<8} {ours:<13.3f} {bare:<12.3f} {ours / bare:<6.2f}"
                print(f"{line} {memory_of_scene(path):.0f}" if prims <= 100_000 else line)


if __name__ == "__main__":
    main()
