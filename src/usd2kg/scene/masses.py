"""MassReader: masses and centres of mass of objects."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from pxr import Gf, Usd

from usd2kg.scene.model import Diagnostic, StageFrame, Vector
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.stage import read_value

__all__ = ["Mass", "MassReader"]


class Mass(NamedTuple):
    """The authored mass of an object."""

    kg: float | None
    """Mass of the object's prim, or the sum over its parts; None if not authored."""
    center: Vector | None
    """Centre of mass, in the frame that it was asked for; None unless authored on every prim with a mass."""


PointReader = Callable[[PrimRecord, Any], Vector | None]
"""Returns a point of a prim's own frame in another frame; None if it is not finite."""


class MassReader:
    """Reads masses, and collects what is wrong with them."""

    def __init__(self, frame: StageFrame) -> None:
        """Read masses in the units of a stage."""
        self._frame = frame
        self._notes: list[Diagnostic] = []
        self._with_density: list[str] = []
        """Path of the first prim with a density, of each rigid body without a mass."""

    def read(self, records: list[PrimRecord], read_point: PointReader) -> Mass:
        """Return mass and centre of mass of the object's prim or, if it has none, of its parts together.

        UsdPhysics: a mass of 0 or a centre that is not finite means "not authored".

        Args:
            records: the object's prim and the prims below it without nested objects.
            read_point: gives the frame of the centre, such as `BoxReader.read_point` for the world.
        """
        own = self._mass(records[0])
        masses = [(records[0], own)] if own else self._masses(records[1:])
        # The product may overflow or underflow.
        total = sum(mass for _, mass in masses) * self._frame.kilograms_per_unit
        weights = masses or [(records[0], 1.0)]
        centers = [(center, mass) for record, mass in weights if (center := _center(record, read_point))]
        is_known = len(centers) == max(len(masses), 1)
        # What never moves, such as a floor, needs no mass.
        if not masses and any(record.is_body for record in records):
            self._with_density += [record.path for record in records if _has_density(record)][:1]
        return Mass(total if 0 < total < math.inf else None, _weighted_mean(centers) if is_known else None)

    @property
    def notes(self) -> list[Diagnostic]:
        """Diagnostics for the masses that were read so far and cannot be used, and one for all densities."""
        if not self._with_density:
            return self._notes
        count = len(self._with_density)
        message = (
            f"{count} {'object has' if count == 1 else 'objects have'} a density (physics:density) and no mass; "
            "densities are not evaluated, so there is no mass in the graph; author physics:mass"
        )
        return [*self._notes, Diagnostic("mass", message, self._with_density[0])]

    def _masses(self, records: list[PrimRecord]) -> list[tuple[PrimRecord, float]]:
        return [(record, mass) for record in records if (mass := self._mass(record))]

    def _mass(self, record: PrimRecord) -> float | None:
        if not record.has_mass:
            return None
        mass = read_value(record.prim, "physics:mass", Usd.TimeCode.Default(), int, float)
        if mass and not 0 < mass < math.inf:
            message = f"its mass is {mass:g}, expected a positive number; it is left out; correct physics:mass"
            self._notes.append(Diagnostic("mass", message, record.path))
            return None
        return float(f"{mass:.7g}") if mass else None


def _has_density(record: PrimRecord) -> bool:
    if not record.has_mass:
        return False
    density = read_value(record.prim, "physics:density", Usd.TimeCode.Default(), int, float)
    return density is not None and 0 < density < math.inf


def _center(record: PrimRecord, read_point: PointReader) -> Vector | None:
    if not record.has_mass:
        return None
    time = Usd.TimeCode.Default()
    center = read_value(record.prim, "physics:centerOfMass", time, Gf.Vec3f, Gf.Vec3d, Gf.Vec3h)
    return read_point(record, center) if center is not None else None


def _weighted_mean(points: list[tuple[Vector, float]]) -> Vector | None:
    total = sum(weight for _, weight in points)
    x, y, z = (sum(point[axis] * weight for point, weight in points) / total for axis in range(3))
    return (x, y, z) if math.isfinite(x + y + z) else None
