"""Bounds of prims, measured by OpenUSD."""

from pxr import Usd, UsdGeom

__all__ = ["bounds"]


def bounds(stage: Usd.Stage, path: str) -> list[float]:
    """Return the lowest and the highest corner of a prim in the world, in units of the stage."""
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), [UsdGeom.Tokens.default_])
    box = cache.ComputeWorldBound(stage.GetPrimAtPath(path)).ComputeAlignedRange()
    return [*box.GetMin(), *box.GetMax()]
