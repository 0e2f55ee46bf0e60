"""TriangleCounter: an estimate of the number of triangles below a prim, without reading points."""

from collections.abc import Container
from typing import Any

from pxr import Tf, Usd, UsdGeom

from usd2kg.scene.settings import MESHES

__all__ = ["TriangleCounter"]

_SOLID = 200
"""Approximate number of triangles of a sphere or cylinder."""


class TriangleCounter:
    """Counts triangles; the triangles of a prototype are counted once."""

    def __init__(self, stage: Any, time: Usd.TimeCode) -> None:
        self._stage = stage
        self._time = time
        self._known: dict[Any, int] = {}
        """Path of a prototype → its triangles."""

    def count(self, prim_path: str, without: Container[str] = frozenset()) -> int:
        """Return the triangles at and below a prim; those that are hidden or broken are counted, too.

        Args:
            prim_path: where to start; a path that is not on the stage has none.
            without: paths of prims that are left out with all that is below them.
        """
        prim = self._stage.GetPrimAtPath(prim_path)
        return self._below(prim, without) if prim else 0

    def _below(self, root: Any, without: Container[str] = frozenset()) -> int:
        total = 0
        prims = iter(Usd.PrimRange(root))
        for prim in prims:
            if without and str(prim.GetPath()) in without:
                prims.PruneChildren()
            elif prim.IsInstance():
                total += self._shared(prim.GetPrototype())
            elif prim.IsA(UsdGeom.PointInstancer):
                prims.PruneChildren()
                total += self._copies(UsdGeom.PointInstancer(prim))
            elif prim.IsA(UsdGeom.Gprim):
                total += self._triangles(prim)
        return total

    def _shared(self, prototype: Any) -> int:
        path = prototype.GetPath()
        if path not in self._known:
            self._known[path] = 0  # A prototype below itself adds nothing.
            self._known[path] = self._below(prototype)
        return self._known[path]

    def _copies(self, instancer: Any) -> int:
        prototypes = [self._stage.GetPrimAtPath(path) for path in instancer.GetPrototypesRel().GetForwardedTargets()]
        each = max((self._shared(prim) for prim in prototypes if prim), default=0)
        copies = len(instancer.GetProtoIndicesAttr().Get(self._time) or ())
        return min(each * min(copies, MESHES.max_copies), MESHES.max_copied_triangles)

    def _triangles(self, prim: Any) -> int:
        if not prim.IsA(UsdGeom.Mesh):
            return _SOLID
        mesh = UsdGeom.Mesh(prim)
        try:
            corners = len(mesh.GetFaceVertexIndicesAttr().Get(self._time) or ())
            faces = len(mesh.GetFaceVertexCountsAttr().Get(self._time) or ())
        except (Tf.ErrorException, TypeError):
            return 0
        # A polygon of n corners is a fan of n - 2 triangles.
        return max(0, corners - 2 * faces)
