"""ShapeDescriptors: size, volume, proportions and capacity of a triangle mesh."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.bounding_boxes import face_normals, minimum_box, minimum_rectangle
from usd2kg.shapes.enclosed_volume import enclosed_volume
from usd2kg.shapes.hull import convex_hull, hull_area
from usd2kg.shapes.settings import MESH
from usd2kg.shapes.triangle_mesh import TriangleMesh, area_vectors
from usd2kg.shapes.vessels import NO_VESSEL, measure_vessel

__all__ = ["ShapeDescriptors", "describe_mesh"]

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ShapeDescriptors:
    """The shape of one object in its true size and pose.

    Computed from the object's own visible triangles. Lengths are metres, ratios dimensionless. All values are invariant
    under rotation, except `openness`, `capacity_m3` and `verticality`, which are invariant under rotation about z.
    """

    volume_m3: float | None
    """Enclosed volume by the divergence theorem (Zhang & Chen 2001, eq. 4): the sum over triangles of a·(b×c)/6.

    Disjoint parts are summed regardless of their winding; an overlap counts twice. A part inside the AABB of another
    with the opposite winding is a cavity and is subtracted. None if a part is not closed: after welding by position,
    the edges that are not traversed equally often in both directions may bound a gap of at most 0.1 % of the part's
    surface (length² / 4π). A part without thickness is not closed.
    """
    hull_volume_m3: float
    """Volume of the convex hull; 0 for a flat object."""
    surface_m2: float
    """Area of all triangles as authored: a double-sided sheet counts twice."""
    long_m: float
    """Longest side of the minimum bounding box in any orientation (L of Blott & Pye 2008).

    The box of least surface among those that stand on a large face of the convex hull, on the ground or across a
    principal axis. Extents along principal axes alone may be the diagonals of a square object.
    """
    middle_m: float
    """Middle side of that box (I)."""
    short_m: float
    """Shortest side of that box (S); 0 for a flat object."""
    elongation: float | None
    """1 - middle / long (Zingg 1935): 0 if as wide as long, towards 1 for a rod. None for a single point."""
    flatness: float | None
    """1 - short / middle (Zingg 1935): 0 if as thick as wide, 1 for a sheet. None for a line."""
    roundness: float | None
    """Sphericity of the convex hull (Wadell 1935): ∛(36π V²) / S.

    1 for a ball, 0.806 for a cube, 0 for a sheet. The hull makes a hollow ball round. None for a line.
    """
    verticality: float | None
    """h / (h + w): height over the longer side of the minimum bounding rectangle of the footprint.

    0 for a flat-lying object, 0.5 for a cube, towards 1 for a pole. None for a single point.
    """
    openness: float
    """`capacity_m3` / (area seen from above × height).

    0 for an object that holds no water, towards 1 for a thin-walled tub. A raised handle lowers it.
    """
    capacity_m3: float
    """Volume of the water that the object holds after vertical rain.

    Depressions of the height field on 128 × 128 cells are filled up to their spill level (Planchon & Darboux 2001;
    equivalent to priority flood, Barnes et al. 2014), but no higher than to where 64 × 64 × 64 voxels leak sideways.
    About 2 % too small for a cup. Only surfaces seen from above hold water: the inside of a bottle or a lidded pot
    does not count. Gaps below 1/64 of the extent count as tight; hollows narrower than 1/32 of it are ignored.
    """


def describe_mesh(mesh: TriangleMesh) -> ShapeDescriptors:
    """Return the shape of a mesh.

    Raises:
        SceneError: scipy is not installed.
    """
    principal = np.linalg.eigh(np.cov(mesh.points.T, ddof=0))[1].T
    planes = np.concatenate([[[0.0, 0.0, 1.0]], principal])
    hull = convex_hull(mesh.points, max(MESH.weld_distance * mesh.diagonal, mesh.noise))
    if hull is None:
        corners, hull_volume, hull_surface = mesh.points, 0.0, 2 * hull_area(mesh.points @ principal[1:].T)
        long, middle, _ = minimum_box(corners, planes)
        short = 0.0
    else:
        corners, hull_volume, hull_surface = hull.vertices, hull.volume, hull.surface
        long, middle, short = minimum_box(corners, np.concatenate([planes, face_normals(hull)]))
    height = float(np.ptp(mesh.points[:, 2]))
    plan, (width, depth) = minimum_rectangle(corners[:, :2])
    has_inside = min(width, depth, height) > MESH.noise_factor * mesh.noise
    vessel = measure_vessel(mesh.points, mesh.triangles, plan) if has_inside else NO_VESSEL
    return ShapeDescriptors(
        volume_m3=enclosed_volume(mesh),
        hull_volume_m3=hull_volume,
        surface_m2=float(np.linalg.norm(area_vectors(mesh.points, mesh.triangles), axis=1).sum()),
        long_m=long,
        middle_m=middle,
        short_m=short,
        elongation=1 - middle / long if long > 0 else None,
        flatness=1 - short / middle if middle > 0 else None,
        roundness=(36 * math.pi * hull_volume**2) ** (1 / 3) / hull_surface if hull_surface > 0 else None,
        verticality=height / (height + width) if height + width > 0 else None,
        openness=vessel.openness,
        capacity_m3=vessel.capacity_m3,
    )
