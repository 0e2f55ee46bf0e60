"""StaleExtents: meshes whose authored extent is not that of their points."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom, Vt

from usd2kg.scene.bounds import is_measurable, points_of
from usd2kg.scene.model import Diagnostic
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.settings import EXTENTS, MAX_COORDINATE
from usd2kg.scene.stage import read_value
from usd2kg.shapes.extent import extent_of

__all__ = ["StaleExtents"]

_Points = NDArray[np.float64]
_SKINNING = ("skel:", "primvars:skel:")


class StaleExtents:
    """Collects the meshes whose extent an editor left unchanged when it changed their points.

    Boxes are read from the extents, which is fast. Points are compared where they are read for another purpose.
    """

    def __init__(self, time: Usd.TimeCode) -> None:
        """Compare at a time."""
        self._time = time
        self._known: dict[int, bool] = {}
        """id of a record that others may have as their source → whether its extent is stale."""
        self._isolated_left = EXTENTS.max_isolated
        self.notes: list[Diagnostic] = []
        """A diagnostic for each stale extent found so far."""

    def __contains__(self, record: object) -> bool:
        return bool(self.notes) and isinstance(record, PrimRecord) and self._known.get(id(record.source), False)

    def compare(self, record: PrimRecord, points: _Points) -> None:
        """Compare the authored extent of a mesh with its points, (n, 3) in its own frame; each mesh once.

        Broken points are left to those who measure them.
        """
        source = record.source
        if id(source) in self._known or UsdGeom.Tokens.extent not in source.authored.names:
            return
        problem = self._problem(source, points)
        self._known[id(source)] = bool(problem)
        if problem:
            self.notes.append(Diagnostic("extent", problem, source.path))

    def compare_isolated(self, records: list[PrimRecord]) -> None:
        """Compare the extents of an object with no other near, which may only seem so; a limited number in all."""
        for record in records:
            if record.has_points and is_measurable(record) and self._isolated_left:
                self._isolated_left -= 1
                self.compare(record, points_of(record.source.prim, self._time))

    def _problem(self, record: PrimRecord, points: _Points) -> str:
        """Return what is wrong with an extent; empty if nothing is, or if only OpenUSD knows the points (skinning)."""
        extent: Any = read_value(record.prim, UsdGeom.Tokens.extent, self._time, Vt.Vec3fArray)
        is_skinned = any(name.startswith(_SKINNING) for name in record.authored.names)
        is_sound = extent is not None and len(extent) == 2 and len(points) and points.shape[1:] == (3,)
        if is_skinned or not is_sound:
            return ""
        authored = np.asarray(extent, dtype=float)
        actual = np.array(extent_of(points))
        is_comparable = (np.abs([authored, actual]) < MAX_COORDINATE).all() and (authored[0] <= authored[1]).all()
        if not is_comparable or not (
            np.abs(authored - actual).max() > EXTENTS.min_difference * (actual[1] - actual[0]).max()
        ):
            return ""
        return (
            f"its extent is {_sides(authored)} stage units about {_middle(authored)}, but its points are "
            f"{_sides(actual)} about {_middle(actual)}; the points are measured; author the extent again"
        )


def _sides(extent: _Points) -> str:
    return " × ".join(f"{side:.3g}" for side in extent[1] - extent[0])


def _middle(extent: _Points) -> str:
    return "({})".format(", ".join(f"{value:.3g}" for value in extent.mean(axis=0) + 0.0))
