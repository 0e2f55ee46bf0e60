"""Write the things as a stage: Z up, centimetres, groups with their own transforms."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from pxr import Gf, Kind, Sdf, Usd, UsdGeom

from benchmarks.scenes.bicycle_shop.parts import Mesh, Part, Primitive, Scatter, Vector, height
from benchmarks.scenes.prims import draw, write_instance, write_mesh, write_root

__all__ = ["Asset", "Group", "Shop"]

ROOT = "/Bicycle_shop"
ASSETS = "/_assets"
SLIPS = (0.0, 0.0, 0.1, -0.1, 0.2, -0.1, 0.2, -0.2, 0.3, -0.4)
"""Centimetres by which a thing stands too high or too low, one of which is drawn by its path."""


class Asset(NamedTuple):
    """Parts that several things share."""

    name: str
    parts: tuple[Part, ...]


class Shop:
    """The stage that is being written."""

    def __init__(self, out: Path) -> None:
        self.stage = Usd.Stage.CreateNew(str(out))
        write_root(self.stage, ROOT, up="Z", unit=0.01)
        self.things: list[str] = []

    def group(self, name: str, at: Vector = (0.0, 0.0, 0.0), yaw: float = 0.0) -> "Group":
        """Return a new group directly or deeper below the root, turned about the vertical."""
        path = f"{ROOT}/{name}"
        for parent in [ROOT + "/" + "/".join(name.split("/")[: i + 1]) for i in range(name.count("/") + 1)]:
            if not self.stage.GetPrimAtPath(parent):
                Usd.ModelAPI(UsdGeom.Xform.Define(self.stage, parent)).SetKind(Kind.Tokens.group)
        xform = UsdGeom.Xform(self.stage.GetPrimAtPath(path))
        if any(at) or yaw:
            xform.AddTranslateOp().Set(Gf.Vec3d(*at))
            xform.AddRotateZOp().Set(yaw)
        return Group(self, path)


class Group(NamedTuple):
    """A group in whose frame things are placed."""

    shop: Shop
    path: str

    def put(
        self,
        name: str,
        what: Asset | Part | Sequence[Part],
        at: Vector = (0.0, 0.0, 0.0),
        turn: Vector = (0.0, 0.0, 0.0),
        scale: float = 1.0,
    ) -> None:
        """Add a thing: first scaled, then turned about x, y and z, then moved."""
        stage, path = self.shop.stage, f"{self.path}/{name}"
        if stage.GetPrimAtPath(path):
            raise ValueError(f"{path} is placed twice")
        self.shop.things.append(path)
        if isinstance(what, Asset):
            prim = self._refer(path, what)
            ops = _ops(at, turn, scale)
        elif isinstance(what, Mesh | Primitive):
            # Many stages make the only gprim of a model the model itself.
            prim, ops = _define(stage, path, what, _ops(at, turn, scale))
        else:
            parts = [what] if isinstance(what, Scatter) else list(what)
            prim = UsdGeom.Xform.Define(stage, path).GetPrim()
            _define_all(stage, path, parts)
            ops = _ops(at, turn, scale)
        _write_ops(prim, ops)
        Usd.ModelAPI(prim).SetKind(Kind.Tokens.component)

    def rest(
        self,
        name: str,
        what: Asset | Part | Sequence[Part],
        at: Vector,
        turn: Vector = (0.0, 0.0, 0.0),
        scale: float = 1.0,
    ) -> None:
        """Add a thing that stands at a height, up to 3 mm too high or 4 mm too low."""
        parts = (
            what.parts if isinstance(what, Asset) else [what] if isinstance(what, Mesh | Primitive | Scatter) else what
        )
        tall = max(height(part) for part in parts)
        slip = max(draw(f"{self.path}/{name}", SLIPS), -0.25 * tall)
        if tall > 60:
            # Furniture stands nearly exactly, since other things are placed on it.
            slip /= 4
        self.put(name, what, (at[0], at[1], at[2] + slip), turn, scale)

    def _refer(self, path: str, asset: Asset) -> Any:
        stage = self.shop.stage
        source = Sdf.Path(f"{ASSETS}/{asset.name}")
        return write_instance(stage, path, source, lambda path: _define_all(stage, str(path), asset.parts))


Op = tuple[str, str, Any]


def _ops(at: Vector, turn: Vector, scale: float) -> list[Op]:
    ops: list[Op] = [("translate", "", Gf.Vec3d(*at))]
    if any(turn):
        ops.append(("rotateXYZ", "", Gf.Vec3f(*turn)))
    if scale != 1.0:
        ops.append(("scale", "", Gf.Vec3f(scale)))
    return ops


def _write_ops(prim: Any, ops: list[Op]) -> None:
    xform = UsdGeom.Xformable(prim)
    adders = {
        "translate": lambda suffix: xform.AddTranslateOp(opSuffix=suffix),
        "rotateXYZ": lambda suffix: xform.AddRotateXYZOp(opSuffix=suffix),
        "orient": lambda suffix: xform.AddOrientOp(opSuffix=suffix),
        "scale": lambda suffix: xform.AddScaleOp(opSuffix=suffix),
    }
    for name, suffix, value in ops:
        adders[name](suffix).Set(value)


def _define_all(stage: Any, path: str, parts: Sequence[Part]) -> None:
    for number, part in enumerate(parts):
        prim, ops = _define(stage, f"{path}/geo_{number}", part, [])
        _write_ops(prim, ops)


def _define(stage: Any, path: str, part: Part, ops: list[Op]) -> tuple[Any, list[Op]]:
    """Write a part; return its prim, and its own operations after others."""
    if isinstance(part, Scatter):
        return _define_instancer(stage, path, part), ops
    if isinstance(part, Mesh):
        return write_mesh(stage, path, part.points, part.faces).GetPrim(), ops
    gprim = getattr(UsdGeom, part.kind).Define(stage, path)
    own: list[Op] = [("translate", "part", Gf.Vec3d(*part.centre))]
    if part.kind == "Cube":
        gprim.CreateSizeAttr(1.0)
        gprim.CreateExtentAttr([(-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)])
        own.append(("scale", "part", Gf.Vec3f(*part.size)))
    else:
        gprim.CreateRadiusAttr(part.radius)
        if part.kind != "Sphere":
            gprim.CreateHeightAttr(part.length)
            gprim.CreateAxisAttr(UsdGeom.Tokens.z)
        gprim.CreateExtentAttr(UsdGeom.Boundable.ComputeExtentFromPlugins(gprim, Usd.TimeCode.Default()))
        if part.way != (0.0, 0.0, 1.0):
            turn = Gf.Rotation(Gf.Vec3d(0, 0, 1), Gf.Vec3d(*part.way)).GetQuat()
            own.append(("orient", "part", Gf.Quatf(turn)))
    return gprim.GetPrim(), [*ops, *own]


def _define_instancer(stage: Any, path: str, part: Scatter) -> Any:
    instancer = UsdGeom.PointInstancer.Define(stage, path)
    prototype = f"{path}/prototypes/copy"
    prim, ops = _define(stage, prototype, part.copy, [])
    _write_ops(prim, ops)
    instancer.CreatePrototypesRel().AddTarget(prototype)
    instancer.CreateProtoIndicesAttr([0] * len(part.places))
    instancer.CreatePositionsAttr([Gf.Vec3f(*place) for place in part.places])
    return instancer.GetPrim()
